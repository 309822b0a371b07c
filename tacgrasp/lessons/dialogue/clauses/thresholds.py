"""Thresholds that one sentence sets, and another one asks whether they are kept.

    I want no more than 800 mN on this tissue. Have we exceeded that?      force_n > 0.8
    The plaster may bear 0.9 N at the very most; are we beneath it?         force_n < 0.9
    It weighs 250 g. Will the grip surely hold that?                        holds_g >= 250
    I'm aiming for a depth of 0.4 to 1.2 mm; do we meet that?               0.4 <= depth_mm <= 1.2

Not here: rules that are stated and judged in one (``tacgrasp.lessons.dialogue.clauses.verdicts``).
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

from tacgrasp.lessons.dialogue.calculations.asked import usual, usual_unit
from tacgrasp.lessons.dialogue.calculations.quantity_names import UNIT
from tacgrasp.lessons.dialogue.calculations.terms import TermReader, alike
from tacgrasp.lessons.dialogue.clauses.comparing import compared
from tacgrasp.lessons.dialogue.clauses.plain_clause import numbered
from tacgrasp.lessons.dialogue.clauses.word_sets import words_of
from tacgrasp.lessons.dialogue.meaning import Calculated

_PARTS = re.compile(
    r"\s*(?:[.;:!?–—]|,? (?:so|and|but)(?=,? (?:is|are|have|has|do|does|did|am|will)\b)|,)\s+"
)
_SETTING = words_of(
    "want wants wanted need needs allow allows allowed permit permits permitted tolerate tolerates "
    "tolerated accept accepts accepted bear bears take takes stand stands withstand withstands "
    "survive survives handle handles endure endures limit threshold spec specification says tops "
    "rule cap ceiling set ordered told customer boss supervisor client budget aim aiming target "
    "asked agreed demand demands require requires required requirement promised bruise bruises "
    "break breaks crack cracks burst bursts tear tears damage damaged damages fragile delicate "
    "maximum minimum max min drawing calls calling must should order sheet says manual data that "
    "though although while was "
    "were i me we this prefer insist insists strict strictly hard upper lower per"
)
_IT = (
    r"(?:it|that|this|those|them|the (?:limit|mark|figure|number|value|line|threshold|cap|ceiling|"
    r"rule|amount|level|spec|bound|target|maximum|minimum|requirement)|that (?:limit|mark|figure|"
    r"number|value|line|threshold|cap|ceiling|rule|amount|level|spec|bound|target|maximum|minimum|"
    r"much|requirement))"
)
_WE = (
    r"(?:we|you|i|it|this|(?:the|this|that) (?:grip|force|contact|touch|gripper|robot|squeeze|"
    r"reading|press))"
)
_VERB = r"(?:is|are|am|have|has|do|does|did|was|were|will|would|can|could)"
_STILL = (
    r"(?:still |in fact |measure |feel |measuring |feeling |now |already |currently |really |"
    r"staying |being |gone |been |indeed |both )*"
)
_OVER = re.compile(
    rf"(?:{_VERB} {_WE} )?{_STILL}(?:exceed(?:ed|ing)?|over|above|past|beyond|surpass(?:ed|ing)?|"
    rf"passed|overshot|more than|higher than|gone over|topping)(?: {_IT})?(?: (?:now|already|yet))*"
)
_UNDER = re.compile(
    rf"(?:{_VERB} {_WE} )?{_STILL}(?:under|below|beneath|less than|lower than|short of|"
    rf"shy of)(?: {_IT})?(?: (?:now|already|yet))*"
)
_KEPT = re.compile(
    r"pass or fail|ok(?:ay)? or not|good or bad|in or out|"
    rf"(?:{_VERB} (?:{_WE}|{_IT}) )?{_STILL}(?:(?:in|within) (?:spec|tolerance|range|limits|"
    rf"bounds)|"
    r"within|inside|in|keeping (?:to|within)|"
    r"respect(?:ed|ing)?|kept|met|meet(?:ing)?|ok|okay|fine|safe|good|alright|satisfied|obeyed|"
    r"observed|"
    rf"compl(?:y|ying|iant)|pass(?:ing|es)?|held|sticking to|all right)(?: (?:to |"
    rf"with )?{_IT})?(?: (?:now|here|then|so far))*|(?:have|are|did|do|does|is|has) {_WE}"
)
_BROKEN = re.compile(
    rf"(?:{_VERB} (?:{_WE}|{_IT}) )?{_STILL}(?:violat(?:e|ed|ing)|broken|breach(?:ed|ing)?|"
    r"break(?:ing)?|out(?:side)? of (?:spec|tolerance|range|limits|bounds)|out|off|"
    rf"overstepp(?:ed|ing)|crossed|outside|fail(?:ed|ing)?|miss(?:ed|ing)?)(?: {_IT})?"
)
_REACHED = re.compile(
    rf"(?:{_VERB} (?:{_WE}|{_IT}) )?{_STILL}(?:reach(?:ed|ing)?|hit|there|at|got to|"
    r"got(?= (?:that much|it|that))|"
    rf"made)(?: {_IT})?"
    r"(?: (?:now|already|yet))*"
)
_HOLDS = re.compile(
    rf"(?:{_VERB}) (?:{_WE}|the \w+) (?:surely |safely |certainly |definitely |be able to |really |"
    r"reliably |sure to |certain to |guaranteed to )*(?:hold|carry|lift|keep|support|bear|"
    r"enough for|suffice|"
    rf"manage)(?: (?:{_IT}|the \w+|on to (?:it|that)))?"
    r"(?: (?:for (?:sure|certain)|safely|surely|without (?:slipping|a slip|dropping it)|securely|"
    r"now))*"
)
_SLIPS = re.compile(
    rf"(?:{_VERB}) (?:{_WE}|the \w+) (?:going to |likely to |gonna )?(?:slip|drop|fall|lose|slide)"
    r"(?: (?:it|away|out|off|down|through|from \w+))*"
)
_WEIGHS = re.compile(
    r"(?:(?:it|this|that|(?:the|this|that|my|our) (?:\w+ )?\w+)(?: (?:here|"
    r"one))? (?:weighs?(?: in)?|has a (?:mass|weight) of|is|comes (?:to|in)|brings)(?: (?:in at|at|"
    r"about|to|on the scale))*|(?:(?:the|its) )?(?:mass|weight)(?: of \w+(?: \w+)?)? is|mass|"
    r"weight) #(?P<n>\d+) (?P<unit>g|grams?|kg|kilos?|kilograms?)(?: heavy)?|"
    r"#(?P<n2>\d+) (?P<unit2>g|grams?|kg|kilos?|kilograms?)(?: \w+)?"
)
_FLIPPED = {">": "<=", "<=": ">", "<": ">=", ">=": "<"}
_NAMED = re.compile(
    r"(?!.*\b(?:temperature|speed|torque|friction|shear)\b)(?:[a-z]+ ){1,4}(?=(?:survives?|bears?|"
    r"takes?|stands?|withstands?|tolerates?|endures?|handles?|allows?|says?|breaks?|cracks?|"
    r"bursts?|tears?|bruises?|wants?|needs?) )"
)
"""Whatever it is that bears so much: 'grandma's vase survives'."""

_HARMS = re.compile(
    r"(?:anything|everything|whatever|all|whoever) (?:is )?(?:(?P<more>above|over|beyond|past|"
    r"more than|higher than|exceeding)|below|under|less than) (?P<number>#1 (?:n|mn|newtons?|"
    r"millinewtons?)) (?:(?:will|would|can|could|is|gets|may|might) )*(?:bruis\w+|break\w*|"
    r"crack\w*|crush\w*|ruin\w*|damag\w+|spoil\w*|tear\w*|burst\w*|kill\w*|destroy\w*|too (?:much|"
    r"little|hard|weak|strong)|forbidden|out|not allowed|a reject|rejected|useless|unsafe|"
    r"dent\w*)(?: \w+){0,3}"
)
_TOLD = re.compile(r"(?P<what>.+) (?P<sign>>=|<=|>|<) (?P<number>-?[\d.]+)")
_AT = re.compile(
    r"(?P<a>.*\b(?:limit|maximum|max|cap|ceiling|threshold|most|minimum|least|bruises?|breaks?|"
    r"cracks?|bursts?|tears?|damaged?)\b.*?) (?:is|at|of|from|was)? ?(?=#1)"
)


_RANGE = re.compile(
    rf"(?P<before>(?:(?!#).)*?)(?:between |from )?(?P<low>#1)(?: (?:{UNIT}))? (?:to|and|through|"
    rf"up to) "
    rf"(?P<high>#2 (?P<unit>{UNIT}))(?P<after>(?: [a-z]+)*)"
)
_AROUND = re.compile(
    rf"(?P<before>(?:(?!#).)*?)(?P<mid>#1)(?: (?P<mid_unit>{UNIT}))?(?: [a-z]+){{0,3}}? "
    r"(?:plus minus|tolerance|tolerances|with|within|give or take|allowing|allow)"
    r"(?: (?:of|an?|plus|minus|or|the|tolerance|is|be))* "
    rf"(?P<by>#2 (?P<unit>{UNIT}))(?P<after>(?: [a-z]+)*)"
)
"""'0.6 mm with 10 % allowed either way'."""

_ONLY_A_TAG = re.compile(rf"{_VERB}(?: not)? {_WE}")
_NO_RANGE = re.compile(
    r"\b(?:not|never|except|x|y|offset|center|middle|limit|off|edge|apart|difference|if|or)\b"
)
_OF_FORCE = re.compile(r"\b(?:force|grip|squeeze|press\w*|push\w*|hold\w*|clamp\w*)\b")
_NUMBERED_RULE = re.compile(r"(?<=\w) [A-Z]{1,4}-?\d+(?:\.\d+)*\b(?! ?(?:N|mN|mm|g|%)\b)")
"""'Requirement R-12': a name with a number, which measures nothing."""

_ON_SOMETHING = re.compile(r" (?:on|for|with) (?:(?:this|that|the|such|my|our|an?) )?[a-z]+$")
_SHARE_OF_LIMIT = re.compile(
    r"(?:.* )?#1 percent of (?:(?:the|its|our|your|that) )?(?:(?:force )?(?:limit|ceiling|cap)|"
    r"(?:maximum|max)(?: (?:allowed|permitted|allowable))?(?: force)?|"
    r"(?:allowed|permitted|allowable) (?:maximum|force))(?: .*)?"
)


def kept(question: str) -> Calculated | None:
    """Whether a threshold that a sentence sets is kept or passed; None of other questions."""
    return _judged(question, _truth)


def range_kept(question: str) -> Calculated | None:
    """Whether a range that a sentence aims at is kept or missed; None of other questions."""
    return _judged(question, _in_range)


def _judged(question: str, read: Callable[[str, tuple[float, ...], str], str]) -> Calculated | None:
    """What is read of a sentence that sets something, its numbers, and the one that asks."""
    text = _NUMBERED_RULE.sub("", " ".join(question.split()))
    for joint in reversed(list(_PARTS.finditer(text))):
        asked = numbered(text[joint.end() :])[0]
        if "#" in asked or not asked:
            continue
        setting, numbers = numbered(text[: joint.start()])
        if truth := read(setting, numbers, asked):
            return Calculated(truth=truth, unit=None)
    return None


def _in_range(setting: str, numbers: tuple[float, ...], asked: str) -> str:
    """Whether a range that somebody aims at is kept or missed; '' of other questions."""
    if _NO_RANGE.search(setting) or len(numbers) != 2 or _ONLY_A_TAG.fullmatch(asked):
        return ""
    if (found := _RANGE.fullmatch(setting) or _AROUND.fullmatch(setting)) is None:
        return ""
    reader, unit, is_around = TermReader(numbers), found["unit"], found.re is _AROUND
    first = reader.read(f"#1 {(is_around and found['mid_unit']) or unit}")
    second = reader.read(f"#2 {unit}")
    if first and is_around and unit == "percent" and found["mid_unit"]:
        second = replace(first, expression=f"{numbers[1] / 100:g} * {first.factor}")
    if first is None or second is None or not usual_unit(second.dimension):
        return ""
    is_force = second.dimension == "mass" and _OF_FORCE.search(setting)
    felt = usual("force" if is_force else second.dimension)
    pairs = alike(felt, first), alike(felt, second)
    if pairs[0] is None or pairs[1] is None:
        return ""
    value, one, other = pairs[0][0].expression, pairs[0][1].factor, pairs[1][1].factor
    inside = f"abs({value} - {one}) <= {other}" if is_around else f"{one} <= {value} <= {other}"
    asked, denied = _undenied(asked)
    is_missed = _BROKEN.fullmatch(asked) is not None
    if not (is_missed or _KEPT.fullmatch(asked) or _REACHED.fullmatch(asked)):
        return ""
    return f"not ({inside})" if is_missed != denied else inside


def _truth(setting: str, numbers: tuple[float, ...], asked: str) -> str:
    if weighs := _WEIGHS.fullmatch(setting):
        is_kilos = (weighs["unit"] or weighs["unit2"]).startswith("k")
        grams = numbers[int(weighs["n"] or weighs["n2"]) - 1] * (1000 if is_kilos else 1)
        if _HOLDS.fullmatch(asked):
            return f"holds_g >= {grams:g}"
        return f"holds_g < {grams:g}" if _SLIPS.fullmatch(asked) else ""
    if named := _NAMED.match(setting):
        setting = f"it {setting[named.end() :]}"
    if broken := _HARMS.fullmatch(setting):
        setting = f"force {'at most' if broken['more'] else 'at least'} {broken['number']}"
        setting = setting if " n" in broken["number"] or " mn" in broken["number"] else ""
    rule = compared(setting, numbers, known=_SETTING)
    if not rule and (found := _AT.match(setting)):
        least = re.search(r"\b(?:minimum|least)\b", found["a"]) is not None
        rule = compared(
            f"{setting[: found.end()]}at {'least' if least else 'most'} {setting[found.end() :]}",
            numbers, known=_SETTING,
        )  # fmt: skip
    if not rule and (shorter := _ON_SOMETHING.sub("", setting)) != setting:
        rule = compared(shorter, numbers, known=_SETTING)
    if not rule and len(numbers) == 1 and _SHARE_OF_LIMIT.fullmatch(setting):
        rule = f"100 * force_n / limit_n <= {numbers[0]:g}"
    told = _TOLD.fullmatch(rule)
    if told is None:
        return ""
    asked, denied = _undenied(asked)
    what, sign, number = told["what"], told["sign"], told["number"]
    for pattern, meant in (
        (_OVER, ">"), (_UNDER, "<"), (_KEPT, sign), (_BROKEN, _FLIPPED[sign]), (_REACHED, ">="),
    ):  # fmt: skip
        if pattern.fullmatch(asked):
            return f"{what} {_FLIPPED[meant] if denied else meant} {number}"
    return ""


def _undenied(words: str) -> tuple[str, bool]:
    """Words without 'not', and whether they had it."""
    denied = re.search(r"\bnot\b", words) is not None
    return " ".join(re.sub(r"\bnot\b", "", words).split()), denied
