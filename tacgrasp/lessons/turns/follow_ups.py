"""Follow-ups that the meaning of the question before them completes.

    Is the force above the limit?  By how much?         abs(force_n - limit_n)
    How much is missing?           In grams?            the same in another unit
    How deep is it in microns?     Is that more than 50? Is the depth more than 50 µm?
    What would twice that be?      Is that too much?    2 * force_n > limit_n

Not here: what is written anew in words (``tacgrasp.lessons.turns.rewriting``).
"""

from __future__ import annotations

import re
from dataclasses import replace

from tacgrasp.lessons.dialogue.conditions import IN_BAND, OUTSIDE_BAND
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.facts import FACT_OF
from tacgrasp.lessons.dialogue.meaning import (
    FACTS,
    Amount,
    AnswerKind,
    Calculated,
    Check,
    Meaning,
    Which,
    Why,
    kind_of,
    truth_of,
)
from tacgrasp.lessons.dialogue.plainer import in_words
from tacgrasp.lessons.dialogue.quantities import GRAVITY_N_PER_G, QUANTITIES, UNITS, unit_of_name
from tacgrasp.lessons.dialogue.rules.advised import is_step_advised
from tacgrasp.lessons.turns.leads import without_lead
from tacgrasp.lessons.turns.rewriting import supposed_in, unit_symbol
from tacgrasp.lessons.understanding import understood_by_grammar

_BY_HOW_MUCH = re.compile(
    r"(?:by (?:how much|how many \w+|what|which margin|what margin|what amount)|how (?:much|many "
    r"\w+)"
    r"(?: (?:over|under|above|below|more|less|too (?:much|little|high|low)))?"
    r"(?: (?:is|are)(?: there)? (?:still )?(?:missing|lacking|left|short|to spare|in hand))?|"
    r"how (?:much|far|many \w+) (?:off|away|short|over|apart)?(?: (?:are|is) (?:we|it|that|they|"
    r"the two))?(?: (?:off|away|short|over|apart))?|"
    r"how (?:much|far|large|big) is the (?:difference|gap|margin))"
    r"(?: (?:is (?:it|that)|exactly|precisely|roughly|about))*"
    r"(?P<floor>[ ,(–-]+(?:zero|0|nothing) (?:if|when|for) .+)?[?.! )]*",
    re.I,
)
_COMPARED = re.compile(r"(?:not \()?(?P<a>[^<>='\"]+?) [<>]=? (?P<b>[^<>='\"]+?)\)?")

_CALLED_SO = ("depth", "force", "area", "mass", "limit")
"""Quantities that a pronoun may stand for: questions call them by these names."""

_PRONOUN = re.compile(r"\b(?:it|that|this)\b", re.I)
_BARE_NUMBER = re.compile(r"(?<=\s)(?P<number>\d+(?:\.\d+)?)(?=[?.! ]*$)")
_IN_UNIT = re.compile(
    r"(?:(?:how (?:much|many)|what(?: (?:weight|force|mass|length))?)"
    r"(?:(?: is|['’]s| would)(?: (?:it|that|this))?(?: be)?)?[, ]+)?"
    r"(?:(?:i (?:wanted|want|meant|mean|need)|give me|make (?:it|that)|say it) )?"
    r"(?:as an? (?:weight|force|mass) )?(?:in |as )?(?:plain )?(?P<unit>[^\d\s?.!,]+(?: "
    r"[a-z]+)?)(?: of (?:weight|force))?"
    r"(?: (?:is|would) (?:it|that|this)(?: be)?)?(?:, not \w+)?[?.! ]*",
    re.I,
)


LONGEST_STEP = 16
"""Longest follow-up that asks for a step [words]. Our choice."""

_OPENS = re.compile(r"(?:what|which|how|where|why|when|who)\b", re.I)


_OF_SIDE = {"side_x": "x_mm", "side_y": "y_mm"}
"""Offsets behind the word for a side."""


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
    if asked.unit is None if isinstance(asked, Calculated) else False:
        names = Expression(truth_of(asked)).names
        if Expression(truth_of(asked)).choices and names in (("x_mm",), ("y_mm",)):
            return Calculated(truth=f"abs({names[0]})", unit="mm")
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
    asked = _measured(asked)
    if not symbol or not isinstance(asked, Amount | Calculated) or not asked.unit:
        return None
    own, other = UNITS[asked.unit].dimension, UNITS[symbol].dimension
    if own == other:
        return replace(asked, unit=symbol)
    truth = f"({truth_of(asked)})"
    if isinstance(asked, Amount):
        own = UNITS[QUANTITIES[asked.quantity].unit].dimension
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
    return (
        is_step_advised(without_lead(question))
        if not _OPENS.match(without_lead(question))
        else None
    )


_HEAVIER = re.compile(
    r"(?:(?:what )?if )?(?:it|that|this|the \w+) (?:were|was|is|weighed|weighs|had)(?: really)? "
    r"(?P<times>twice|half|double|three times|ten times|\d+(?:\.\d+)? times)"
    r"(?: (?:as (?:heavy|much)|the (?:mass|weight)|that))*|"
    r"(?:for )?one (?P<one>twice|half) as heavy",
    re.I,
)
_SEVERAL = re.compile(
    r"(?:(?:would|will|does|do|can) (?:it|that|the grip|this|they|we) (?:still |also )?(?:hold|"
    r"do|work|"
    r"suffice|stay|carry|be enough)(?: for| if there were)? |if there were |what about |how "
    r"about |and )?"
    r"(?P<count>two|three|four|five|\d)(?: of (?:them|these|those|it))?(?: stuck together| "
    r"together| "
    r"at once| instead)?",
    re.I,
)
_HOLDING = re.compile(r"\b(?:hold|do|work|suffice|stay|carry|enough)\b", re.I)
_COUNTS = {"two": 2, "three": 3, "four": 4, "five": 5}
_SO_HEAVY = {"twice": 2.0, "double": 2.0, "half": 0.5, "three times": 3.0, "ten times": 10.0}


def of_another_mass(question: str, asked: Meaning | None) -> Calculated | None:
    """What was asked before, of an object that is twice as heavy; None of other questions."""
    words = without_lead(question).rstrip("?.! ")
    found, several = _HEAVIER.fullmatch(words), _SEVERAL.fullmatch(words)
    truth = truth_of(asked) if isinstance(asked, Amount | Check | Calculated) else ""
    if (found is None and several is None) or "mass_g" not in truth:
        return None
    if found:
        times = (found["times"] or found["one"]).lower()
        factor = _SO_HEAVY.get(times) or float(times.split()[0])
    else:
        assert several is not None
        count = several["count"].lower()
        factor = float(_COUNTS.get(count) or count)
    if several and _HOLDING.search(words) and kind_of(asked) is not AnswerKind.YES_NO:
        return Calculated(truth=f"force_n >= gram_n * {factor:g} * mass_g", unit=None)
    unit = asked.unit if isinstance(asked, Amount | Calculated) else None
    return Calculated(truth=re.sub(r"\bmass_g\b", f"({factor:g} * mass_g)", truth), unit=unit)


_WITH_FORCE = re.compile(
    r"(?:if (?:i|we|you) )?(?:with |at |assume |suppose |assuming )?(?:(?:add|adding|squeeze|press|"
    r"grip) )?(?P<number>\d+(?:\.\d+)?)(?: ?(?P<unit>N|newtons?|mN|millinewtons?))? "
    r"(?P<way>more|less|extra|harder|softer|on top|off|added|fewer)"
    r"(?: (?:force|grip|than(?: (?:now|that|measured|at present))?|squeeze))*(?:[, ]+instead)?",
    re.I,
)
_TIMES_FORCE = re.compile(
    r"(?:with |at |if (?:i|we) (?:had|used|applied) )?(?:squeezing |gripping |pressing )?"
    r"(?P<times>twice|double|half|three times) "
    r"(?:(?:the|that|this|our|my) (?:force|grip|squeeze)|as (?:hard|firmly|strongly|tight))",
    re.I,
)
_FEWER = ("less", "softer", "off", "fewer")
_TAKING = re.compile(
    r"(?:what (?:if|about) |how about |with )?(?:(?:i|we) )?(?:taking|take|easing|ease|letting|let|"
    r"backing|back)(?: off)? (?P<number>\d+(?:\.\d+)?) ?(?P<unit>N|newtons?|mN|millinewtons?)"
    r"(?: off| away)?(?:[, ]+instead)?",
    re.I,
)
_LETTING = re.compile(r"if (?:i|we|you) .+", re.I)
MADE = {"twice": "2", "double": "2", "half": "0.5", "three times": "3"}


def changed_force(question: str) -> str:
    """The force that a follow-up supposes, as an expression: 'and with 0.4 N less'; '' of none."""
    words = in_words(without_lead(question)).strip(" ?.!")
    if found := _WITH_FORCE.fullmatch(words):
        newtons = float(found["number"]) * UNITS[unit_symbol(found["unit"] or "N")].size
        return f"(force_n {'-' if found['way'].lower() in _FEWER else '+'} {newtons:.6g})"
    if found := _TAKING.fullmatch(words):
        newtons = float(found["number"]) * UNITS[unit_symbol(found["unit"])].size
        return f"(force_n - {newtons:.6g})"
    if found := _TIMES_FORCE.fullmatch(words):
        return f"({MADE[found['times'].lower()]} * force_n)"
    if _LETTING.fullmatch(words) and (read := understood_by_grammar(f"What {words}?")):
        is_force = isinstance(read.meaning, Calculated) and read.meaning.unit == "N"
        names = Expression(truth_of(read.meaning)).names if is_force else ()
        return f"({truth_of(read.meaning)})" if names == ("force_n",) else ""
    return ""


def unsupposed(asked: Meaning, text: str) -> Meaning | None:
    """What a question asks under a supposition, of the force that is felt; None where it has none.

    Args:
        asked: What it asks.
        text: Its words: 'if I add 0.3 N, are we over the limit?'.
    """
    supposed = supposed_in(text)
    force = changed_force(supposed[0]).strip("()") if supposed else ""
    if not force or not isinstance(asked, Calculated) or force not in asked.truth:
        return None
    return replace(asked, truth=asked.truth.replace(force, "force_n"))


_BOTH = re.compile(
    r"(?:are |is |do |does )?(?P<all>both|all|the two|all of (?:them|those|these)|both of "
    r"(?:them|those|"
    r"these))(?: (?:conditions|things|checks))?(?: (?:true|met|hold|holds|fulfilled|satisfied|"
    r"fine|ok|"
    r"okay|the case|given))?|(?:is |are )?(?:at least one|either|one)(?: of (?:them|those|these|"
    r"the two|"
    r"those two))?(?: (?:true|met|fulfilled|the case))?|(?P<none>neither)(?: of (?:them|those))?",
    re.I,
)


def of_both(question: str, last: Meaning | None, earlier: Meaning | None) -> Calculated | None:
    """Whether the last two conditions hold, both or one of them; None of other questions."""
    found = _BOTH.fullmatch(without_lead(question).rstrip("?.! "))
    if found is None or last is None or earlier is None:
        return None
    joint = " and " if found["all"] else " or "
    truth = joint.join(f"({truth_of(each)})" for each in (earlier, last))
    return Calculated(truth=f"not ({truth})" if found["none"] else truth, unit=None)


def of_changed_force(force: str, asked: Meaning | None) -> Calculated | None:
    """What was asked before, of another force; None of what has no force.

    Args:
        force: The other force.
        asked: What was asked of the felt one.
    """
    if not isinstance(asked, Amount | Check | Calculated):
        return None
    truth = re.sub(r"\bholds_g\b", "force_n / gram_n", truth_of(asked))
    if "force_n" not in truth:
        return None
    unit = None if isinstance(asked, Check) else asked.unit
    return Calculated(truth=re.sub(r"\bforce_n\b", force, truth), unit=unit)


def of_supposed_force(asked: Meaning, supposed: Meaning) -> Calculated | None:
    """A condition of the force, of the force that was worked out before; None of others."""
    if not isinstance(supposed, Amount | Calculated) or not isinstance(asked, Check | Calculated):
        return None
    unit, force = supposed.unit or "", truth_of(supposed)
    is_force = unit in UNITS and UNITS[unit].dimension == "force"
    if not is_force or force == "force_n" or re.search(r"limit_n|band_|abs|max", force):
        return None  # what is felt itself, or how far it is from something
    if isinstance(asked, Calculated) and asked.unit is not None:
        return None
    condition = asked.condition if isinstance(asked, Check) else asked.truth
    if "force_n" not in condition:
        return None
    return Calculated(truth=re.sub(r"\bforce_n\b", f"({force})", condition), unit=None)


def reason_of(asked: Meaning) -> Why | None:
    """The reason of an answer; None of what has none but itself."""
    match asked:
        case Check(shows=shows):
            return Why(shows=tuple(name for name in shows if name in FACTS))
        case Which(name="action"):
            return Why()
        case Amount(quantity=quantity) if quantity in FACTS:
            return Why(shows=(quantity,))
        case Calculated(truth=truth):
            shown = (FACT_OF[name] for name in Expression(truth).names if name in FACT_OF)
            return Why(shows=tuple(dict.fromkeys(shown)))
    return None
