"""Follow-ups that the meaning of the question before them completes.

    Is the force above the limit?  By how much?         abs(force_n - limit_n)
    How much is missing?           In grams?            the same in another unit
    How deep is it in microns?     Is that more than 50? Is the depth more than 50 µm?
    What next?                     Is that a move?      action in ['move_up', ...]
    Two conditions.                Are both true?       both of them

Not here: what is written anew in words (``tacgrasp.lessons.turns.rewriting``), what is supposed
(``tacgrasp.lessons.turns.supposed``), the number before (``tacgrasp.lessons.turns.references``).
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import replace

from tacgrasp.lessons.dialogue.conditions import IN_BAND, OUTSIDE_BAND
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.facts import FACT_OF
from tacgrasp.lessons.dialogue.meaning import (
    FACTS,
    Amount,
    Calculated,
    Check,
    Meaning,
    Several,
    Which,
    Why,
    truth_of,
)
from tacgrasp.lessons.dialogue.quantities import GRAVITY_N_PER_G, QUANTITIES, UNITS, unit_of_name
from tacgrasp.lessons.dialogue.rules.advised import is_step_advised
from tacgrasp.lessons.dialogue.scene import HOLDING_N_PER_G
from tacgrasp.lessons.turns.leads import without_lead
from tacgrasp.lessons.turns.units import unit_symbol

_BY_HOW_MUCH = re.compile(
    r"(?:with how much to spare(?:,? or missing)?|by (?:how much|how many \w+|what|which margin|"
    r"what margin|what amount)|how (?:much|many \w+)(?: (?:over|under|above|below|more|less|too "
    r"(?:much|little|high|low)))?(?: (?:is|are)(?: there)? (?:still )?(?:missing|lacking|left|"
    r"short|to spare|in hand))?|how (?:much|far|many \w+) (?:off|away|short|over|apart)?(?: "
    r"(?:are|is) (?:we|it|that|they|the two))?(?: (?:off|away|short|over|apart))?|how (?:much|far|"
    r"large|big) is the (?:difference|gap|margin)|(?:how (?:much|far|many \w+)|what) (?:lies?|is|"
    r"are|separates?)(?: there)? (?:in )?between (?:the two|them|these(?: two)?|those(?: two)?|"
    r"both)|what(?:['’]s| is) (?:still )?(?:missing|lacking)|"
    r"by how (?:much|many \w+) do (?:we|i) differ(?: from it)?"
    r")(?: (?:is (?:it|that)|exactly|precisely|roughly|"
    r"about))*(?: from (?:the )?(?:middle|cent(?:er|re)|midline|it))?(?P<floor>[ ,(–-]+(?:zero|0|"
    r"nothing) (?:if|when|for) .+)?[?.! )]*",
    re.I,
)
_COMPARED = re.compile(r"(?:not \()?(?P<a>[^<>='\"]+?) [<>]=? (?P<b>[^<>='\"]+?)\)?")
_SHARE = re.compile(r"(?:[\d.]+ \* )?\(?100 \* ")
"""A side that is a percentage: '0.5 * (100 * force_n / limit_n)'."""
_CALLED_SO = ("depth", "force", "area", "mass", "limit")
"""Quantities that a pronoun may stand for: questions call them by these names."""
_PRONOUN = re.compile(r"\b(?:it|that|this)\b", re.I)
_BARE_NUMBER = re.compile(r"(?<=\s)(?P<number>\d+(?:\.\d+)?)(?=[?.! ]*$)")
_IN_UNIT = re.compile(
    r"(?:(?:how (?:much|many)|what(?: (?:weight|force|mass|length))?)"
    r"(?:(?: is|['’]s| would)(?: (?:it|that|this))?(?: be)?)?[, ]+)?"
    r"(?:(?:can|could) (?:i|you) (?:have|give me|get|say|express) (?:that|it)(?: again)? )?"
    r"(?:(?:i (?:wanted|want|meant|mean|need)|give me|make (?:it|that)|say it) )?"
    r"(?:as an? (?:weight|force|mass) )?(?:in |as )?(?:plain )?(?P<unit>[^\d\s?.!,]+2?(?: "
    r"[a-z]+)?)(?: of (?:weight|force))?"
    r"(?: (?:is|would) (?:it|that|this)(?: be)?)?(?:, not \w+)?[?.! ]*",
    re.I,
)
LONGEST_STEP = 16
"""Longest follow-up that asks for a step [words]. Our choice."""
_OPENS = re.compile(r"(?:what|which|how|where|why|when|who)\b", re.I)
_OF_SIDE = {"side_x": "x_mm", "side_y": "y_mm"}
"""Offsets behind the word for a side."""
_BOTH = re.compile(
    r"(?:are |is |do |does )?(?P<all>both|all|the two|all of (?:them|those|these)|both of (?:them|"
    r"those|these))(?: (?:conditions|things|checks))?(?: (?:true|met|hold|holds|fulfilled|"
    r"satisfied|fine|ok|okay|the case|given))?|(?:is |are )?(?:at least one|either|one)(?: of "
    r"(?:them|those|these|the two|those two))?(?: (?:true|met|fulfilled|the case))?|"
    r"(?P<none>neither)(?: of (?:them|those))?",
    re.I,
)


def asks_by_how_much(question: str) -> bool:
    """Whether a follow-up asks for the difference behind a yes or a no."""
    return _BY_HOW_MUCH.fullmatch(without_lead(question)) is not None


def difference_of(asked: Meaning, question: str) -> Calculated | None:
    """How far apart the two sides of a comparison are; None of what compares no two numbers.

    Args:
        asked: The comparison.
        question: The follow-up, which may want zero in place of what is not missing.
    """
    if isinstance(asked, Which) and asked.name in _OF_SIDE:
        return Calculated(truth=f"abs({_OF_SIDE[asked.name]})", unit="mm")
    if not isinstance(asked, Check | Calculated):
        return None
    if isinstance(asked, Calculated) and Expression(asked.truth).choices:
        names = Expression(asked.truth).names
        is_side = names in (("x_mm",), ("y_mm",))
        return Calculated(truth=f"abs({names[0]})", unit="mm") if is_side else None
    condition = asked.condition if isinstance(asked, Check) else asked.truth
    if condition.removeprefix("not (").removesuffix(")") == IN_BAND:
        return Calculated(truth=OUTSIDE_BAND, unit="N")
    if (found := _COMPARED.fullmatch(condition)) is None:
        return None
    by_how_much = _BY_HOW_MUCH.fullmatch(without_lead(question))
    truth = f"abs({found['a']} - ({found['b']}))"
    if by_how_much and by_how_much["floor"]:
        truth = f"max(0, {found['b']} - ({found['a']}))"
    try:
        names = Expression(truth).names
    except ValueError:  # it has several comparisons
        return None
    units = {unit_of_name(name) for name in names}
    if _SHARE.match(found["a"]):
        units = {"%"}
    if f"{HOLDING_N_PER_G} * mass_g" in truth or "gram_n" in truth:
        units = {"N"}  # a mass there stands for the force that surely holds it
    return Calculated(truth=truth, unit=units.pop()) if len(units) == 1 else None


def leaves_unit_out(question: str) -> bool:
    """Whether a question is about 'it' and ends with a number that has no unit."""
    return bool(_BARE_NUMBER.search(question) and _PRONOUN.search(question))


def with_quantity_of(question: str, asked: Meaning) -> str:
    """A follow-up that leaves the unit out, in the words of the number before it; '' of others."""
    if not isinstance(asked, Amount) or asked.quantity not in _CALLED_SO:
        return ""
    about = _PRONOUN.sub(f"the {asked.quantity}", question, count=1)
    return _BARE_NUMBER.sub(rf"\g<number> {asked.unit}", about)


def _measured(asked: Meaning) -> Meaning:
    """The depth or the area behind a word for it; anything else as it is."""
    shown: tuple[str, ...] = ()
    if isinstance(asked, Which):
        shown = (asked.name,)
    elif isinstance(asked, Check):
        shown = asked.shows
    name = {"depth": "depth", "depth_word": "depth", "area": "area", "area_word": "area"}
    quantity = name.get(shown[0], "") if len(shown) == 1 else ""
    return Amount(quantity=quantity, unit=QUANTITIES[quantity].unit) if quantity else asked


def in_another_unit(question: str, asked: Meaning) -> Meaning | None:
    """The number that was asked for before, in the unit that a follow-up names; None of others.

    A force becomes the mass that weighs as much, and the reverse.
    """
    found = _IN_UNIT.fullmatch(without_lead(question))
    symbol = unit_symbol(found["unit"]) if found else ""
    is_length = bool(symbol) and UNITS[symbol].dimension == "length"
    if is_length and isinstance(asked, Which) and asked.name == "position":
        return Several(parts=tuple(Amount(quantity=axis, unit=symbol) for axis in "xy"))
    asked = _measured(asked)
    if not symbol or not isinstance(asked, Amount | Calculated) or not asked.unit:
        return None
    own, other = UNITS[asked.unit].dimension, UNITS[symbol].dimension
    if own == other:
        return replace(asked, unit=symbol)
    truth = f"({truth_of(asked)})"
    if isinstance(asked, Amount):
        own = UNITS[QUANTITIES[asked.quantity].unit].dimension
    if isinstance(asked, Amount) and (own, other) == ("fraction", "area"):
        return replace(asked, unit=symbol)
    if (own, other) == ("force", "mass"):
        return Calculated(truth=f"{truth} / {GRAVITY_N_PER_G}", unit=symbol)
    if (own, other) == ("mass", "force"):
        return Calculated(truth=f"{truth} * {GRAVITY_N_PER_G}", unit=symbol)
    return None


def of_advice(question: str, asked: Meaning) -> Calculated | None:
    """Whether a step that a follow-up names is the one advised before; None of others."""
    is_advice = isinstance(asked, Which) and asked.name == "action"
    is_step = isinstance(asked, Calculated) and Expression(asked.truth).names == ("action",)
    if not (is_advice or is_step) or len(question.split()) > LONGEST_STEP:
        return None
    step = without_lead(question)
    return None if _OPENS.match(step) else is_step_advised(step)


def of_both(question: str, last: Meaning | None, earlier: Meaning | None) -> Calculated | None:
    """Whether the last two conditions hold, both or one of them; None of other questions."""
    found = _BOTH.fullmatch(without_lead(question).rstrip("?.! "))
    if found is None or last is None or earlier is None:
        return None
    joint = " and " if found["all"] else " or "
    truth = joint.join(f"({truth_of(each)})" for each in (earlier, last))
    return Calculated(truth=f"not ({truth})" if found["none"] else truth, unit=None)


def reason_of(asked: Meaning) -> Why | None:
    """The reason of an answer; None of what has none but itself."""
    shown: Iterable[str] = ()
    match asked:
        case Check(shows=shows):
            shown = (name for name in shows if name in FACTS)
        case Which(name="action"):
            return Why()
        case Amount(quantity=quantity) if quantity in FACTS:
            shown = (quantity,)
        case Calculated(truth=truth) if "action" in (names := Expression(truth).names):
            return Why()
        case Calculated(truth=truth):
            names = Expression(truth).names
            shown = (FACT_OF[name] for name in names if name in FACT_OF)
    facts = tuple(dict.fromkeys(shown))
    return Why(shows=facts) if facts else None
