"""Follow-ups about another mass, or about the force that a mass needs.

    Will it slip at this weight?    And for 80 g?           the question for 80 g
    Will it slip at this weight?    And if it were twice as heavy?
    Is the grip strong enough?      What does it need?      How much force is needed for its mass?

Not here: the mass that a person tells (``tacgrasp.lessons.turns.told``).
"""

from __future__ import annotations

import re

from tacgrasp.lessons.dialogue.meaning import (
    Amount,
    AnswerKind,
    Calculated,
    Check,
    Meaning,
    kind_of,
    truth_of,
)
from tacgrasp.lessons.dialogue.scene import PER_GRAM
from tacgrasp.lessons.turns.leads import END, LEAD, without_lead
from tacgrasp.lessons.turns.units import (
    ANOTHER_NUMBER,
    NUMBER,
    STATED,
    TIMES,
    dimension_of,
    with_last_number,
)

_NEEDED = re.compile(
    r"(?=.*\b(?:force|grip|squeeze|newtons?|hard|strong|strongly|n|(?:the )?(?:least|minimum)(?: "
    r"that)? (?:i|we|you|it))\b)(?!.*\b(?:gravity|pull|pulls|weigh|weighs|push|apply|applying|"
    r"pressing|is it|is that|are we|have|limit|heaviest|grams?|still|more|less|heavier|lighter|"
    r"times|twice|double|half|another|extra|now)\b)(?=.*\b(?:needs?|needed|wants?|requires?|required|minimum|min|least|enough|takes?|"
    r"surely|sure|safely|do|holds?)\b)(?:(?:and|so|but|then)[, ]+)*(?:(?:with )?how (?:much|many|"
    r"strong|hard)|what|which|(?:the )?(?:minimum|least|needed|required|grip|force))\b.*",
    re.I,
)
_ANOTHER_THING = re.compile(
    rf"{LEAD}(?:for |with |of )?(?:an?|the|one|my|our) (?:[a-z'-]+ ){{0,3}}?[a-z'-]+,? "
    rf"(?:(?:of|with|at|that weighs|weighing) )?(?:about )?{NUMBER}"
    rf"(?:,? would (?:that(?: one)?|it) (?:hold|slip|stay|work))?{END}",
    re.I,
)
"""'And an ostrich egg, 1400 g?'"""
_HEAVIER = re.compile(
    r"(?:(?:what )?if )?(?:it|that|this|the \w+) (?:were|was|is|weighed|weighs|had)(?: really)? "
    r"(?P<times>twice|half|double|three times|ten times|\d+(?:\.\d+)? times)"
    r"(?: (?:as (?:heavy|much)|heavier|the (?:mass|weight)|that))*|"
    r"(?:(?:would|will|does) (?:it|that|this|the grip) (?:still )?(?:do|hold|suffice|work|be "
    r"enough) )?(?:for |with )?(?:one (?P<one>twice|half) as heavy|"
    r"(?P<that>twice|double|half|three times) (?:that|the|this) (?:mass|weight))",
    re.I,
)
_SEVERAL = re.compile(
    r"(?:(?:would|will|does|do|can) (?:it|that|the grip|this|they|we) (?:still |also )?(?:hold|do|"
    r"work|suffice|stay|carry|be enough)(?: for| if there were)? |if there were |what about |how "
    r"about |and )?(?P<count>two|three|four|five|\d)(?: of (?:them|these|those|it))?(?: stuck "
    r"together| together| at once| instead)?",
    re.I,
)
_GRAMS = re.compile(rf"\b(?P<each>{PER_GRAM}) \* (?P<grams>\d+(?:\.\d+)?)")
_HOLDING = re.compile(r"\b(?:hold|do|work|suffice|stay|carry|enough)\b", re.I)
_COUNTS = {"two": 2, "three": 3, "four": 4, "five": 5}


def needed(question: str, before: str, meant: Meaning | None) -> str:
    """What force the mass needs that was asked about before."""
    truth = "" if meant is None else truth_of(meant)
    is_of_mass = any(name in truth for name in ("mass_g", "gram_n", "holds_g"))
    is_fate = isinstance(meant, Check) and bool(meant.needed_n)
    if not (is_of_mass or is_fate) or _NEEDED.match(question) is None:
        return ""
    told = (*STATED.finditer(before), *STATED.finditer(question))
    masses = [each for each in told if dimension_of(each["unit"]) == "mass"]
    named = f"{masses[-1]['number']} {masses[-1]['unit']}" if masses else "its mass"
    return f"How much force is needed for {named}?"


def of_a_mass(question: str, before: str, meant: Meaning | None) -> str:
    """The question before, of another mass than the one that was told."""
    asked = ANOTHER_NUMBER.fullmatch(with_last_number(question))
    asked = asked or _ANOTHER_THING.fullmatch(question)
    if asked is None or meant is None or dimension_of(asked["unit"] or "g") != "mass":
        return ""
    truth = truth_of(meant)
    is_of_mass = "mass_g" in truth and not STATED.search(before)
    mass = f"{asked['number']} {asked['unit'] or 'g'}"
    return f"{before.rstrip('?.! ')} for {mass}?" if is_of_mass else ""


def of_another_mass(question: str, asked: Meaning | None) -> Calculated | None:
    """What was asked before, of an object that is twice as heavy; None of other questions."""
    words = without_lead(question).rstrip("?.! ")
    found, several = _HEAVIER.fullmatch(words), _SEVERAL.fullmatch(words)
    if asked is None or (found is None and several is None):
        return None
    truth = truth_of(asked) if isinstance(asked, Amount | Check | Calculated) else ""
    if "mass_g" not in truth and _GRAMS.search(truth) is None:
        return None
    if found:
        times = (found["times"] or found["one"] or found["that"]).lower()
        factor = TIMES.get(times) or float(times.split()[0])
    else:
        assert several is not None
        count = several["count"].lower()
        factor = float(_COUNTS.get(count) or count)
    if several and _HOLDING.search(words) and kind_of(asked) is not AnswerKind.YES_NO:
        return Calculated(truth=f"force_n >= gram_n * {factor:g} * mass_g", unit=None)
    unit = asked.unit if isinstance(asked, Amount | Calculated) else None
    if "mass_g" in truth:
        truth = re.sub(r"\bmass_g\b", f"({factor:g} * mass_g)", truth)
    else:
        truth = _GRAMS.sub(
            lambda mass: f"{mass['each']} * {factor * float(mass['grams']):g}", truth
        )
    return Calculated(truth=truth, unit=unit)
