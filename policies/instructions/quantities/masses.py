"""What a text says of the object's mass: it is no force, and asks for none.

'The egg is about 60 grams', 'a 15 gram strawberry', 'it weighs 20 g, er, 25 g', 'twice as heavy as the
last one'. Not here: grams and pounds that a grip is asked for with ('at most 200 g'), which are forces
(``spans``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from policies.instructions.english import words
from policies.instructions.quantities.force import MARK
from policies.instructions.quantities.force_units import ALONE, GRAM_N, MASSES, NUMBER, number
from policies.instructions.quantities.force_units import UNIT as FORCE

UNITS: tuple[tuple[str, float], ...] = (
    *((unit, weight_n / GRAM_N) for unit, weight_n in MASSES),
    (r"(?:milligram(?:me)?s?|mgs?)", 1e-3),
    (r"(?:(?:metric )?tonn?es?|tons?)", 1e6),
)
"""Units of mass and their size [g]."""

SAME = 0.1
"""Two masses of one object that differ by less, as a fraction, are one. Our choice: people round."""

_UNIT = "|".join(unit for unit, _ in UNITS)
_ONE = (
    rf"(?:(?:between |from )?(?:{NUMBER})[ -]*(?:(?:{_UNIT})\b)? ?(?:-|–|to|and|or) ?)?"
    rf"(?P<a>{NUMBER.removeprefix(ALONE)})[ -]*(?!(?:{FORCE})\b)(?P<u>(?:{_UNIT})\b)"
)
"""A mass; of a range the larger end."""

_PRONOUN = r"(?:it|this|that|they|these|those)"
OBJECT = rf"(?!{_PRONOUN}\b)(?:{words.any_of('fruit')}|plums?|apples?|kiwis?|figs?)\b"
_NOUN = rf"(?!{_PRONOUN}\b)(?:\w+ ){{0,2}}?{OBJECT}"
_KIND = rf"(?:(?!(?:on|onto|of|to|for|with|in|at|by|from|and|or|the|an?|{_PRONOUN}|my|our|your)\b)\w+ ){{0,2}}?{OBJECT}"
"""An object without an article: '15 gram red strawberry', but not '200 grams on the egg'."""
_FORCES = (
    r"(?:force|grip|press|squeez|push|pinch|hold|clamp|load|limit|max|min|bound|ceiling|cap\b|floor|range|band|top|end|peak|thresh|"
    r"cut|target|aim|goal|setting|strength|effort|number|amount|figure|answer|value|least|most|best|rest|usual|default|point|wish)"
)
_THE = r"(?:the|this|that|my|our|your|each|every)"
_THING = rf"(?:{_PRONOUN}(?: (?:here|one|there))?|{_NOUN}|{_THE}(?: (?!{_FORCES})\w+){{1,3}})"
_IS = r"(?: (?:now|only|also|actually|really|probably|usually|normally|still|just|here))*(?:'s| (?:is|are|was|were|will be|comes? (?:in at|out at|to)|clocks? in at))"
_WEIGHS = (
    r"(?:weigh(?:s|ed|ing)?(?: in)?(?: at)?|mass(?: of| is| was|:| =)?|(?:tips?|tipped|tipping) the scales? at|"
    r"(?:scales?|balance)\b[^.;#\d]{0,40}?(?:reads?|says?|shows?|showed|said|gives?|gave|at|:)|(?:its|whose|with a|has a|net|gross) weight(?: of| is| was|:)?)"
)
_ABOUT = r"(?:(?:about|around|roughly|approximately|exactly|only|just|almost|nearly|some|maybe|over|under|a good|a mere|a bit[,:]?) )*"
_STATED = re.compile(rf"\b(?:(?P<subject>{_THING}){_IS}|{_WEIGHS}) {_ABOUT}{_ONE}(?! too\b)")
_NAMED = re.compile(rf"{_ONE}(?:[ -](?:heavy )?(?:of )?(?={_KIND})|(?= (?:heavy|in weight)\b))")
_BESIDE = re.compile(rf"\b{_NOUN}(?:, | \(){_ABOUT}{_ONE}(?=\)|, (?!please))")
"""'That berry, roughly 21 grams, is the one'."""
_FIRST = re.compile(rf"^{_ONE},? (?={_THE} {_NOUN}[^.;]{{0,12}}[ .!]*$)")
_CORRECTED = re.compile(
    rf"(?<={MARK})[\s,;.–—-]*\b(?:(?:er+|um+|uh+|no|sorry|wait|actually|make (?:that|it)|{words.any_of('correction')})\b[ ,]*)+{_ONE}"
)
_OF_FORCE = r"\b(?:force|pressure|load|limit|maximum|minimum|strength|(?:the|your|my|a) (?:grip|squeeze|hold)|want)\b"
_FORCE_BEFORE = re.compile(rf"{_OF_FORCE}[^.;,]*$|\b(?:on|onto|to|for|against) $")
_FORCE_OF_IT = re.compile(rf"{_OF_FORCE}[^.;]*$")
"""Before 'it is 100 grams': 'it' is no object."""
_COMPARED = re.compile(
    rf"\b(?:is|are|was|weighs?)(?: \w+)?? (?:(?:twice|half|double|{NUMBER} times)(?: as (?:heavy|much) as| the (?:weight|mass) of)|"
    rf"(?:{NUMBER}\s*(?:%|percent|times) )?(?:heavier|lighter) than (?=(?:{_THE}|an?|its) ))"
)
"""'Twice as heavy as the 55 gram egg' doubles no force."""
_TELLS = re.compile(
    r"(?:^|\b(?:here is|you are \w+ing|you will be \w+ing|(?:it|this|that) is)) ?(?:an? |your )?$"
)
"""Before 'a 15 gram strawberry': a sentence that says no more than this."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Masses:
    """What a text says of the masses of objects.

    Attributes:
        is_told: Whether a sentence is about the object's mass ('it weighs 20 g').
        conflict: Words of two masses of one object; '' for none.
    """

    is_told: bool = False
    conflict: str = ""


def without_masses(text: str) -> tuple[str, Masses]:
    """A text with ``MARK`` for each mass of an object, and these masses.

    Args:
        text: Plain text, its numbers in digits.
    """
    is_about = re.search(rf"\b{words.any_of('fruit')}\b", text) is not None
    is_told, conflict = False, ""
    rest, end, last, last_g = "", 0, "", 0.0
    for match in _found(text):
        before, mass_g = text[end : match.start("a")], _grams(match)
        named = re.findall(rf"\b(?:\w+ )?{OBJECT}", before)
        subject = named[-1] if named else last
        if match.re is _STATED and last_g and subject == last:
            is_other = abs(last_g / mass_g - 1) > SAME
            conflict = f"{last_g:g} g and {mass_g:g} g" if is_other else conflict
        last = subject
        if match.re in (_NAMED, _BESIDE):
            is_told = is_told or bool(_TELLS.search(text[: match.start()]))
        else:
            is_told = is_told or is_about
        rest, end, last_g = f"{rest}{before}{MARK}", match.end("u"), mass_g
    rest, compared = _COMPARED.subn(f"is {MARK} ", rest + text[end:])
    return rest, Masses(is_told=is_told or (is_about and compared > 0), conflict=conflict)


def _found(text: str) -> Iterator[re.Match[str]]:
    """Masses in their order; behind one, what corrects it."""
    at = 0
    while at < len(text):
        masked = f"{text[: max(0, at - 1)]}{MARK}{text[at:]}" if at else text
        corrected = _CORRECTED.match(masked, at)
        found = [corrected] if corrected else []
        found = found or [
            match
            for pattern in (_STATED, _FIRST, _BESIDE, _NAMED)
            if (match := _next(pattern, text, at))
        ]
        if not found:
            return
        match = min(found, key=lambda each: each.start("a"))
        yield match
        at = match.end("u")


def _next(pattern: re.Pattern[str], text: str, at: int) -> re.Match[str] | None:
    for match in pattern.finditer(text, at):
        subject, before = match.groupdict().get("subject"), text[: match.start()]
        is_force = subject and _FORCE_BEFORE.search(before)
        if subject and re.match(rf"{_PRONOUN}\b", subject):
            is_force = is_force or _FORCE_OF_IT.search(before)
        if not is_force:
            return match
    return None


def _grams(match: re.Match[str]) -> float:
    size = next(size for pattern, size in UNITS if re.fullmatch(pattern, match["u"]))
    return number(match["a"]) * size
