"""Named shapes or textures, or none of them: 'disc, ring or something else?'.

    Edge, corner or neither: what is it?    'edge' if shape == 'edge' else ... else 'neither'
    Is it a cylinder or not a cylinder?     'cylinder' if shape == 'cylinder' else 'not a cylinder'

Not here: alternatives that are all named ('an edge or a corner?'), which the grammar and the
language model read, and ``tacgrasp.lessons.dialogue.choices.own_words`` answers.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from cltp.tactile.states import CLASSES
from tacgrasp.lessons.dialogue.calculations.asked import AskedWords, asked_words
from tacgrasp.lessons.dialogue.choices.conditions import choice_of
from tacgrasp.lessons.dialogue.choices.rest import rest_of
from tacgrasp.lessons.dialogue.choices.scales import GAP
from tacgrasp.lessons.dialogue.families.classes.lexicon import named, words_pattern
from tacgrasp.lessons.dialogue.meaning import Calculated
from tacgrasp.lessons.dialogue.plainer import AUXILIARY

NamedClass = tuple[str, Mapping[str, str]]
"""A word of a question, with the classes that it names by dimension."""

_DIMENSIONS = ("shape", "texture")
_SURFACE = re.compile(r"\b(?:texture|surface|finish|relief|feels?)\b")
_KIND = (
    r"(?:shape|form|one|kind|category|type|label|texture|finish|surface|thing|outline|pattern|"
    r"class)"
)
_NONE = re.compile(
    rf" ?(?:or|and) (?:(?:is it |more |rather |is this |it is |just )*(?:like )?)"
    rf"(?P<said>none(?: of (?:(?:these|those)(?: #\d+)?|them|the (?:above|lot|#\d+)))?|"
    rf"neither(?: of (?:these|those|them|both|(?:the )?#\d+))?|"
    rf"(?:something|anything) (?:else|different|other)|some(?: (?:other|different) {_KIND})|"
    rf"(?:another|other|others|a different|different)(?: {_KIND})?|"
    r"(?P<denied>(?:not|anything but|other than) (?:(?:an?|the) )?(?P<same>[a-z]+(?: shaped?)?)))"
    r"(?: (?:altogether|entirely|instead))?(?= |$)"
)
_JOINT = re.compile(
    r"(?: (?:or|and|or is it|or maybe|or perhaps|or rather|like|or like|or of|"
    r"it is|is it))* ?"
)
_EITHER = re.compile(rf"{AUXILIARY} .*\beither .+ or ", re.I)
_ARTICLE = re.compile(r"(?:\b(?:an?|the|no|any|some) )?$")
_OBJECT = re.compile(
    r"\b(?:the|this|that|my|our|your) (?!force|grip|depth|limit|band|mass|load|weight)[a-z]+"
    r"(?= (?:is|are|has)\b|$)"
)
_NEUTRAL = re.compile(
    rf"\b(?:(?:looks?|feels?|seems?|felt) like|like|match(?:es)?|resembles?|belongs? to|"
    r"which is it|that you feel|pick|choose|select|(?:have|has) (?:i|we|you) got|got|category|"
    rf"dealing with|against|make of|pressed|pressing|imprint|shape|form|{_KIND}|"
    r"would fit|fits?|describes?|"
    r"call(?:ed)?|names?|best|which of (?:these|those|them|the following)|relief)\b"
)


def either_named(question: str) -> Calculated | None:
    """Whether it is one of some named classes: 'is it of either a triangle or a hexagon?'."""
    if _EITHER.match(question) is None:
        return None
    asked = asked_words(question)  # without 'either'
    listed, end = _listed(asked.words, len(asked.words))
    dimension = _dimension(listed, asked.words)
    if len(listed) < 2 or dimension is None or not _is_beside(asked, listed, end):
        return None
    truth = " or ".join(f"{dimension} == '{means[dimension]}'" for _, means in listed)
    return Calculated(truth=truth, unit=None)


def named_or_none(asked: AskedWords) -> str | None:
    """A choice between named classes and none of them; None where a question is no such one."""
    words = asked.words
    out = _NONE.search(words)
    if out is None:
        return None
    listed, end = _listed(words, out.start())
    dimension = _dimension(listed, words)
    if dimension is None or words[end : out.start()].strip() not in ("", "here", "now", "there"):
        return None
    if out["denied"] and (len(listed) > 1 or out["same"] != listed[0][0]):
        return None
    if not _is_beside(asked, listed, out.end()):
        return None
    cases = [(word, f"{dimension} == '{means[dimension]}'") for word, means in listed]
    return choice_of(*cases, (re.split(r"(?: of the)? #", out["said"])[0], ""))


_OFFERED_NONE = re.compile(
    r"\b(?P<said>none(?: of (?:these|those|them|the (?:above|lot|#\d+)))?|neither(?: of (?:these|"
    rf"those|them|both|(?:the )?#\d+))?|(?:something|anything) (?:else|different|other)|"
    rf"some other {_KIND}|"
    rf"(?:another|a different) {_KIND})\b"
)
_IF_NONE = re.compile(
    r"\bif (?:it|they|both|all|that)\b(?: \w+){0,6}? (?:say|answer|call it|reply) (?=\|)"
)
_LIKE = re.compile(
    r" like an? [a-z]+(?: [a-z]+(?=(?: or)? ?\|))?|\bon (?=(?:an?|the)\b)|(?<=or) on(?= ?\|)"
)
_OF_OTHERS = re.compile(
    r"#|\b(?:not|than|force|forces|newtons?|mm|depth|deep|deeper|limit|band|mass|weighs?|grams?|"
    r"area|percent|left|right|top|bottom|upper|lower|cent(?:er|re)|middle|why|how|where|either)\b"
)
"""What a question with named classes says of something else."""

_GRADES: Mapping[str, re.Pattern[str]] = {
    name: re.compile(rf"\b(?:{'|'.join(sorted(CLASSES[name], key=len, reverse=True))})\b")
    for name in ("depth", "area")
}
"""Words for the depth and for the area, 'very deep' before 'deep'."""

_GRADED = {"deep", "depth", "area"}
_OF_SIZE = {"depth": r"\b(?:area|patch|footprint|print)\b", "area": r"\b(?:depth|press|dent)\b"}


def loosely_named(question: str) -> Calculated | None:
    """A choice between two or more named classes and none, whatever else is said.

    'Help me settle it: cylinder or cuboid? Say neither should both be wrong.'
    """
    asked = asked_words(question)
    out = _OFFERED_NONE.search(asked.words)
    if out is None:
        return None
    words = _IF_NONE.sub(" ", f"{asked.words[: out.start()]}|{asked.words[out.end() :]}")
    if truth := _graded(words, out["said"]) or _named(words, asked.words, out["said"]):
        return Calculated(truth=truth, unit=None)
    return None


def _named(words: str, whole: str, none: str) -> str | None:
    """A choice between named shapes, or textures, and none of them."""
    if _OF_OTHERS.search(words):
        return None
    runs = _runs(_LIKE.sub("", words))
    lists = [run for run in runs if len(run) > 1]
    dimension = _dimension(lists[-1], whole) if lists else None
    offered = [{means.get(dimension or "") for _, means in each} for each in lists]
    if dimension is None or any(each != offered[-1] for each in offered):
        return None
    listed = lists[-1]
    cases = [(word, f"{dimension} == '{means[dimension]}'") for word, means in listed]
    return choice_of(*cases, (none.split(" of the #")[0], ""))


def _graded(words: str, none: str) -> str | None:
    """A choice between words for the depth, or for the area, and none of them."""
    others = {found[0] for found in _OF_OTHERS.finditer(words)} - _GRADED
    if others or " or " not in words:
        return None
    for name, pattern in _GRADES.items():
        said = list(dict.fromkeys(pattern.findall(words)))
        if len(said) > 1 and not re.search(_OF_SIZE[name], words):
            cases = [(word, f"{name} == '{word}'") for word in said]
            return choice_of(*cases, (none, ""))
    return None


def _classes(word: str) -> Mapping[str, str]:
    """The class that a word names in each dimension where it names one."""
    return {each.dimension: each.classes[0] for each in named(word) if len(each.classes) == 1}


def _runs(words: str) -> Sequence[Sequence[NamedClass]]:
    """Named classes, those together that nothing but a joint parts."""
    runs: list[list[NamedClass]] = []
    last = -1
    for match in words_pattern().finditer(words):
        means = _classes(match[1])
        if means and last >= 0 and _JOINT.fullmatch(words[last : match.start()]):
            runs[-1].append((match[1], means))
        elif means:
            runs.append([(match[1], means)])
        last = match.end() if means else -1
    return runs


def _listed(words: str, end: int) -> tuple[Sequence[NamedClass], int]:
    """Named classes up to a place that nothing but a joint parts, with where the last one ends.

    Each has its classes by dimension: stripes and dots are both shapes and textures.
    """
    listed: list[NamedClass] = []
    last = 0
    for match in words_pattern().finditer(words, 0, end):
        means = _classes(match[1])
        if not means or (listed and not _JOINT.fullmatch(words[last : match.start()])):
            return (), 0
        listed.append((match[1], means))
        last = match.end()
    return listed, last


def _dimension(listed: Sequence[NamedClass], words: str) -> str | None:
    """What all of some named classes are of."""
    shared = [each for each in _DIMENSIONS if listed and all(each in means for _, means in listed)]
    is_surface = "texture" in shared and _SURFACE.search(words)
    return "texture" if is_surface else next(iter(shared), None)


def _is_beside(asked: AskedWords, listed: Sequence[NamedClass], end: int) -> bool:
    """Whether nothing else is said before named classes and behind an end.

    An object may have any name.
    """
    before = _ARTICLE.sub("", asked.words[: asked.words.index(listed[0][0])])
    words = _NEUTRAL.sub(GAP, f"{before}{GAP}{asked.words[end:]}")
    told = (rest_of(asked, each) for each in (words, _OBJECT.sub(GAP, words)))
    rest = next((each for each in told if each is not None), None)
    return rest is not None and not rest.terms and rest.has_only("place", "area")
