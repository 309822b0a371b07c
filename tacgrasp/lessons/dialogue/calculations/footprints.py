"""Questions for the contact's mean pressure, for a circle or square of its area, what it leaves.

    What is the mean pressure in kPa?                       force_n / area_mm2
    What volume is the area times the depth?                area_mm2 * depth_mm
    How many mm² of the pad are free?                       ... - area_mm2
    As a circle of equal area, what diameter has it?        2 * sqrt(area_mm2 / 3.14159)

Not here: areas and forces alone (``tacgrasp.lessons.dialogue.families``).
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.calculations.asked import AskedWords
from tacgrasp.lessons.dialogue.calculations.phrases import AGAINST, is_made_of, sign_of
from tacgrasp.lessons.dialogue.calculations.quantity_names import UNIT
from tacgrasp.lessons.dialogue.calculations.terms import Term, is_near
from tacgrasp.lessons.dialogue.meaning import Calculated
from tacgrasp.lessons.dialogue.quantities import MEAN_PRESSURE, UNITS

_ROUND = re.compile(r"\b(?:circle|circular|disc|disk|round|dot|coin)\b")
_SQUARE = re.compile(r"\bsquare\b")
_DIAMETER = re.compile(r"\b(?:diameter|across|wide|width|breadth)\b")
_RADIUS = re.compile(r"\bradius\b")
_AROUND = re.compile(r"\b(?:circumference|perimeter)\b")
_SIDE = re.compile(r"\b(?:sides?|edge|edges|wide|width|across)\b")
_AREA = re.compile(
    r"\b(?:area|patch|footprint|contact|contact patch|print|imprint|spot|region|size|touched|"
    r"surface)\b"
)
_OF_FORM = (
    r"(?:if|suppose|supposing|pretend|imagine|assume|assuming|say|were|was|the|a|an|my|our|that|"
    r"this|it|"
    r"contact|patch|footprint|area|print|imprint|spot|region|touched|part|surface|size|pad|gel|"
    r"redrawn|drawn|redraw|draw|replace|replaced|replacing|made|turned|reshaped|rounded|replaced|"
    r"modelled|treated|taken|"
    r"thought|squashed|squeezed|moulded|into|as|to|by|with|of|on|in|for|being|one|perfect|"
    r"perfectly|"
    r"true|exact|exactly|ideal|simple|plain|single|neat|full|same|equal|equivalent|identical|"
    r"circle|circular|disc|disk|round|dot|coin|square|shape|shaped|form|diameter|across|wide|"
    r"width|breadth|radius|circumference|perimeter|side|sides|edge|length|long|what|which|how|"
    r"big|large|would|will|is|are|be|does|do|has|have|had|you|we|i|get|give|gives|its|"
    r"covering|covers|covered|having|whose|equals|matches|matching|and|then|there|come|comes|"
    r"out|amount|us|me|tell|much|picture|tile|neat|like|many|millimetre|treat|treating|turn|each|"
    r"every|imagined|equivalently|regard|"
    r"regarded|seen|just|measure|measures|large)"
)
_PRESSURE = re.compile(
    r"\b(?:pressure|stress|force (?:per|divided by|over|spread|shared|distributed)|"
    r"(?:divide|dividing|spread|spreading|distribute|distributing)\b.*\b(?:force|push|squeeze))\b"
)
_PER_SQUARE = re.compile(
    r"\b(?:how much|newtons?) (?:.*\b(?:on|for|over|load|loads|per|does|do) (?:each|every|an?|"
    r"one)|per) "
    r"(?:square|sq) "
    r"(?:(?P<mm>mm|millimet(?:re|er))|cm|centimet(?:re|er))\b"
)
_AREA_OR_PRESSURE = re.compile(r"\b(?:area|patch|footprint|pressure|stress)\b")
_OF_CONTACT = re.compile(
    r"\b(?:contact|patch|touch\w*|pad|gel|footprint|area|grip|force|mean|average|averaged)\b"
)
_ELSEWHERE = re.compile(
    r"\b(?:air|blood|water|oil|gas|hydraulic|pneumatic|suction|vacuum|atmospher\w+|barometric|room|"
    r"weather|outside)\b"
)
"""What other pressures are of."""

_IS_MEAN = re.compile(
    r"\b(?:mean|average|averaged|divid\w+|spread\w*|over|per|distribut\w+|shared|uniform\w*|"
    r"even\w*)\b"
)
_OF_PRESSURE = (
    r"(?:what|which|how|much|is|are|be|would|will|does|do|did|the|a|an|of|in|on|onto|over|across|"
    r"by|"
    r"per|for|to|from|it|this|that|we|i|you|get|gives?|giving|given|come|comes|make|makes|work|"
    r"works|out|if|when|with|and|then|there|here|under|at|against|contact|patch|area|"
    r"footprint|pad|gel|region|touched|pressed|covered|part|unit|surface|grip|gripping|"
    r"clamp|clamping|squeeze|squeezing|normal|force|load|pressure|stress|mean|average|averaged|"
    r"felt|present|current|currently|now|measured|divide|divided|dividing|spread|spreading|"
    r"distribute|distributed|distributing|shared|uniform|uniformly|evenly|even|all|whole|entire|"
    r"resulting|exerted|applied|express|expressed|assuming|my|our|its|object|equally|"
    r"press|presses|pressing|push|pushes|with|figure|value|put|take|result|results|tell|me|"
    r"fingertip|finger|as|want|need|touching|experiences?|sees?|feels?|undergoes|undergo|bears?|"
    r"footprint|sense|sensed)"
)


_FREE = re.compile(
    r"\b(?:free|untouched|uncovered|unpressed|bare|clear|empty|outside (?:the )?contact|not "
    r"(?:being )?(?:touched|covered|"
    r"pressed|in contact))\b"
)
_OF_FREE = (
    rf"(?:{_OF_PRESSURE}|free|untouched|uncovered|unpressed|bare|clear|empty|not|being|any|touch|"
    rf"outside|centimetres?|"
    r"stay|stays|remain|remains|left|have|has|mm2|cm²|square|millimetres?|pad's|gel's|sensing|"
    r"sensor|right|x|surface|still|large|big|total|many|aren't)"
)


def free_area(asked: AskedWords) -> Term | None:
    """The area of the pad that nothing touches; of a pad of the size that the question gives."""
    words, numbers = asked.words, asked.numbers
    unit = asked.unit or next(iter(re.findall(r"\b(?:mm2|cm²)\b", words)), "")
    if not unit and not re.search(r"\bhow many #\d+|\bsquare (?:milli|centi)", words):
        return None
    if unit not in ("", "mm2", "mm²", "cm²") or not _FREE.search(words) or len(numbers) > 2:
        return None
    if not is_made_of(re.sub(r"#\d+", "", words), _OF_FREE):
        return None
    whole = " * ".join(f"{number:g}" for number in numbers) or "pad_width_mm * pad_height_mm"
    return Term(expression=f"{whole} - area_mm2", dimension="area", words="", is_sum=True)


_DEEP = re.compile(r"\b(?:depth|deep|deepest|indentation|dent|penetration|height|everywhere)\b")
_FILLED = re.compile(r"\b(?:volume|displaced|fill|honey|water|wax|poured)\b")


def volume(asked: AskedWords) -> Term | None:
    """The area of contact times the largest depth."""
    unit = UNITS.get(asked.unit)
    is_asked = unit is not None and unit.dimension == "volume"
    if asked.numbers or not (is_asked or re.search(r"\bvolume\b", asked.words)):
        return None
    if not _DEEP.search(asked.words):
        return None
    if not (_AREA.search(asked.words) or _FILLED.search(asked.words)):
        return None
    return Term(expression="area_mm2 * depth_mm", dimension="volume", words="")


_SUPPOSES = re.compile(r"\b(?:doubl\w+|halv\w+|half|twice|tripl\w+|times)\b")
"""What makes another pressure of the force or the area that is felt."""

_AGAINST_PRESSURE = re.compile(rf"\b(?:{AGAINST}) (?P<by>#\d+ (?:{UNIT}))(?= |$)")
_ABOUT_PRESSURE = re.compile(
    rf"(?:is|are|would) (?:the |this |that )?(?:(?:mean|average|contact) )?pressure(?: not)?(?: "
    rf"(?:about|around|roughly|approximately|exactly|close to|near))? (?P<by>#\d+ (?:{UNIT}))"
)
_BESIDE_PRESSURE = re.compile(r"\b(?:pressure|push\w*|press\w*|force|squeez\w*|load|stress)\b")


def pressure(asked: AskedWords) -> Term | None:
    """The force over the area of contact."""
    unit = UNITS.get(asked.unit)
    is_asked = unit is not None and unit.dimension == "pressure"
    words = re.sub(r" ?on average$", "", asked.words)
    if asked.numbers or _ELSEWHERE.search(words) or _SUPPOSES.search(words):
        return None
    if not is_asked and (found := _PER_SQUARE.search(words)):
        per = "N/mm²" if found["mm"] else "N/cm²"
        return Term(expression=MEAN_PRESSURE, dimension=per, words="")
    is_made = is_made_of(words, _OF_PRESSURE)
    if is_asked:
        is_meant = is_made or _OF_CONTACT.search(words) is not None
    else:
        said = (_PRESSURE, _IS_MEAN, _AREA_OR_PRESSURE)
        is_meant = is_made and not asked.unit and all(each.search(words) for each in said)
    return Term(expression=MEAN_PRESSURE, dimension="pressure", words="") if is_meant else None


def pressure_check(asked: AskedWords) -> Calculated | None:
    """Whether the force over the area of contact is more or less than so much, or about that."""
    found = _AGAINST_PRESSURE.search(asked.words)
    if about := _ABOUT_PRESSURE.fullmatch(asked.words):
        bound = asked.term(about["by"])
        if bound is None or bound.dimension != "pressure":
            return None
        truth = is_near(MEAN_PRESSURE, bound, denied=" not" in about[0])
        return Calculated(truth=truth, unit=None)
    if found is None or len(asked.numbers) > 1 or _ELSEWHERE.search(asked.words):
        return None
    if not _BESIDE_PRESSURE.search(asked.words):
        return None
    bound = asked.term(found["by"])
    if bound is None or bound.dimension != "pressure":
        return None
    return Calculated(truth=f"{MEAN_PRESSURE} {sign_of(found)} {bound.factor}", unit=None)


def circle(asked: AskedWords) -> Term | None:
    """Diameter, radius or circumference of a circle of the contact's area, or a square's side."""
    words = asked.words
    if asked.numbers or not _AREA.search(words) or not is_made_of(words, _OF_FORM):
        return None
    area = asked.term("area")
    of = area.factor.replace("area_percent", "area_mm2") if area else "area_mm2"
    if _ROUND.search(words):
        if _RADIUS.search(words):
            expression = f"sqrt({of} / 3.14159)"
        elif _AROUND.search(words):
            expression = f"2 * sqrt(3.14159 * {of})"
        elif _DIAMETER.search(words):
            expression = f"2 * sqrt({of} / 3.14159)"
        else:
            return None
    elif _SQUARE.search(words) and _SIDE.search(words):
        expression = f"sqrt({of})"
    else:
        return None
    return Term(expression=expression, dimension="length", words="")
