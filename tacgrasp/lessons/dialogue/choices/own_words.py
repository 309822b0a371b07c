"""What was read of a question that names alternatives, answered with the question's word.

    Which way is she off more, sideways or lengthwise?   choice worse_axis: 'sideways' if ...
    An avocado: are we under or over 1 mm deep?          check depth <= #1 mm: 'under' if ...
    Is it an edge or a corner?                           choice shape: neither, where it is a rod

Not here: reading the question (``tacgrasp.lessons.dialogue.choices.choosing``, the grammar, the
language model).
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace

from tacgrasp.lessons.dialogue.calculations.asked import asked_words
from tacgrasp.lessons.dialogue.choices import scales
from tacgrasp.lessons.dialogue.choices.choosing import chosen_by
from tacgrasp.lessons.dialogue.choices.conditions import band_part, choice_of
from tacgrasp.lessons.dialogue.choices.scales import Offer, WordScale
from tacgrasp.lessons.dialogue.choices.spelling import is_one_way, spelled
from tacgrasp.lessons.dialogue.conditions import check_of
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.families.classes import words as names
from tacgrasp.lessons.dialogue.meaning import Calculated, Check, Meaning, Several, Which

_WORDS: Mapping[str, tuple[WordScale, str, str]] = {
    "side_x": (scales.SIDE_X, "left", "right"),
    "side_y": (scales.SIDE_Y, "palm", "fingertip"),
    "worse_axis": (scales.AXIS, "horizontal", "vertical"),
    "wholeness": (scales.CUT, "cut", "whole"),
    "position": (scales.CENTER, "centered", "off"),
}
"""Scales of names of a scene, with their words."""

_FIRST_IF: Mapping[str, str] = {
    "side_x": "x_mm < 0",
    "side_y": "y_mm > 0",
    "worse_axis": "abs(x_mm) > abs(y_mm)",
    "wholeness": "wholeness == 'cut'",
    "position": "position == 'centered'",
}
"""When the first of them is true."""

_STATES: Mapping[str, tuple[WordScale, str, str]] = {
    "touched": (scales.TOUCH, "touched", "free"),
    "empty": (scales.TOUCH, "free", "touched"),
    "left": (scales.SIDE_X, "left", "right"),
    "right": (scales.SIDE_X, "right", "left"),
    "top": (scales.SIDE_Y, "palm", "fingertip"),
    "bottom": (scales.SIDE_Y, "fingertip", "palm"),
    "wider": (scales.AXIS, "horizontal", "vertical"),
    "higher": (scales.AXIS, "vertical", "horizontal"),
    "cut": (scales.CUT, "cut", "whole"),
    "whole": (scales.CUT, "whole", "cut"),
    "force over": (scales.LIMIT, "over", "under"),
    "force under": (scales.LIMIT, "under", "over"),
    "force upper": (scales.ENDS, "high", "low"),
    "force lower": (scales.ENDS, "low", "high"),
    "force within": (scales.IN_BAND, "within", "outside"),
}
"""Conditions whose truth chooses between two words of a scale."""

_FATES = {"stays": ("stays", "slips"), "slips": ("slips", "stays")}
_NUMBERED = re.compile(
    r"(?:\w+ )?(?P<name>\w+) (?P<sign>>=|<=|>|<|about) (?P<number>\S+) (?P<unit>\S+)"
)
_COMPARED_MEANT = {"least": ">=", "more": ">", "less": "<", "most": "<="}
_ELSE = re.compile(
    r"\b(?:else|other|another|different|what|which (?:class|shape|of your)|none|name)\b"
)
_OTHER_TEXTURE = r"textured|structured|patterned|uneven|not smooth"
_TEXTURED = re.compile(
    rf"\bsmooth,? (?:or|and|/) (?:is it |an? )?(?P<a>{_OTHER_TEXTURE})\b|"
    rf"\b(?P<b>{_OTHER_TEXTURE}),? (?:or|and|/) (?:is it )?smooth\b",
    re.I,
)
_VERDICT = re.compile(
    r"\b(?P<yes>pass|true|go|ok|okay|accept)(?: or |/| / )(?P<no>fail|false|no[ -]?go|not ok|"
    r"not okay|"
    r"reject)\b",
    re.I,
)
"""Two words that stand for yes and no."""

_CLASSES: Mapping[str, tuple[names.Words, ...]] = {
    "shape": (names.SHAPE_NOUNS, names.BARE_SHAPES, names.SHAPE_ADJECTIVES, names.SHAPES_OF_MANY),
    "texture": (names.TEXTURES,),
}


def in_its_words(question: str, meaning: Meaning) -> Meaning:
    """A meaning whose answer has the word of the question, where that names alternatives.

    Any other meaning is returned as it is.
    """
    if truth := _smooth_or_not(question, meaning):
        return chosen_by(truth, question) or meaning
    if isinstance(meaning, Which) and not meaning.is_open and meaning.name in _CLASSES:
        offered = _offered_classes(asked_words(question).words, meaning.name)
        return replace(meaning, offered=offered)
    if verdict := _VERDICT.search(question):
        return _judged(meaning, verdict)
    words = asked_words(spelled(question)).words
    if not re.search(r"\bor\b", words) or is_one_way(words):
        return meaning
    truth = None
    if isinstance(meaning, Which):
        truth = _word(words, meaning)
    elif isinstance(meaning, Check) and meaning.test:
        truth = _verdict(words, meaning)
    elif isinstance(meaning, Several):
        truth = _one_of_both(words, meaning)
    return (chosen_by(truth, question) if truth else None) or meaning


def _smooth_or_not(question: str, meaning: Meaning) -> str | None:
    """Smooth, or a word for every other texture: 'is it smooth or textured?'."""
    if not (found := _TEXTURED.search(question)):
        return None
    is_texture = isinstance(meaning, Which) and meaning.name == "texture"
    if not is_texture and not (isinstance(meaning, Check) and meaning.test == "texture smooth"):
        return None
    return f"'smooth' if texture == 'smooth' else '{(found['a'] or found['b']).lower()}'"


def _judged(meaning: Meaning, verdict: re.Match[str]) -> Meaning:
    """A yes or no by the two words that stand for them."""
    condition = meaning.condition if isinstance(meaning, Check) else ""
    if isinstance(meaning, Calculated) and meaning.unit is None:
        condition = "" if Expression(meaning.truth).choices else meaning.truth
    if not condition or (isinstance(meaning, Check) and meaning.needed_n):
        return meaning
    return Calculated(
        truth=f"'{verdict['yes'].lower()}' if {condition} else '{verdict['no'].lower()}'", unit=None
    )


def _word(words: str, which: Which) -> str | None:
    """A word of a scene's name by the question's word for it."""
    if which.name == "force_band":
        offer = scales.BAND.offered(words)
        said = offer.said if offer else {}
        if not said or all(word == value for value, word in said.items()):
            return None
        return band_part(said.get("below"), said.get("within"), said.get("above"))
    if which.name not in _WORDS:
        return None
    scale, first, second = _WORDS[which.name]
    offer = scale.offered(words)
    if offer is None or all(value == word for value, word in offer.said.items()):
        return None
    return choice_of((offer.said[first], _FIRST_IF[which.name]), (offer.said[second], ""))


def _verdict(words: str, check: Check) -> str | None:
    """A yes or no by the alternative that it chooses."""
    if state := _STATES.get(check.test):
        scale, holds, fails = state
        return _by(scale.offered(words), holds, fails, check.condition)
    fate, _, mass = check.test.partition(" ")
    if fate in _FATES and mass:
        holds, fails = _FATES[fate]
        return _by(scales.SLIP.offered(words), holds, fails, check.condition)
    compared = _NUMBERED.fullmatch(check.test)
    offer = scales.COMPARED.offered(words) if compared else None
    if compared is None or offer is None or len(offer.options) != 2:
        return None
    values = set(offer.said)
    if values not in ({"more", "less"}, {"least", "less"}, {"more", "most"}):
        return None
    upper = "least" if "least" in values else "more"
    lower = "most" if "most" in values else "less"
    name = check.test[: compared.start("sign")].strip()
    test = f"{name} {_COMPARED_MEANT[upper]} {compared['number']} {compared['unit']}"
    return _by(offer, upper, lower, check_of(test).condition)


def _by(offer: Offer | None, holds: str, fails: str, condition: str) -> str | None:
    if offer is None or set(offer.said) != {holds, fails}:
        return None
    return choice_of((offer.said[holds], condition), (offer.said[fails], ""))


def _one_of_both(words: str, several: Several) -> str | None:
    """The alternative of two conditions that are each other's denial: 'below 5 %, or above'."""
    checks = [part for part in several.parts if isinstance(part, Check) and part.test]
    if len(checks) != 2 or len(several.parts) != 2:
        return None
    told = {_verdict(words, check) for check in checks}
    return told.pop() if len(told) == 1 else None


def _offered_classes(words: str, name: str) -> tuple[str, ...]:
    """The classes that a question lets choose from; empty where it leaves a way out."""
    found = {
        match.start(): value
        for table in _CLASSES[name]
        for value, pattern in table.items()
        for match in re.finditer(rf"\b(?:{_as_said(pattern)})\b", words)
    }
    values = tuple(dict.fromkeys(value for _, value in sorted(found.items())))
    joint = re.search(r"\bor\b", words)
    is_choice = joint and found and min(found) < joint.start() < max(found)
    return values if is_choice and len(values) > 1 and not _ELSE.search(words) else ()


def _as_said(pattern: str) -> str:
    """A pattern of a table of names as one of plain words without article."""
    plain = re.sub(r"(?<=[(|])(?:an?|the|several) ", "", pattern).replace("-", " ")
    return re.sub(r"\[(.*?)\]", r"(?:\1)?", plain)
