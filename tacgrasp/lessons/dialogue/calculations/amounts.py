"""Questions for a calculated number.

    What is 40 % of the limit?                  0.4 * limit_n
    What does the object weigh, in N?           0.00980665 * mass_g

Not here: suppositions (``tacgrasp.lessons.dialogue.calculations.suppositions``).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import replace

from tacgrasp.lessons.dialogue.calculations.asked import AskedWords, usual, usual_unit
from tacgrasp.lessons.dialogue.calculations.borders import to_border
from tacgrasp.lessons.dialogue.calculations.differences import (
    apart,
    before_leaving,
    error,
    from_point,
    into_band,
    missing,
    signed_offset,
    taken,
)
from tacgrasp.lessons.dialogue.calculations.footprints import circle, free_area, pressure, volume
from tacgrasp.lessons.dialogue.calculations.loads import as_many_as, load, needed, safety_factor
from tacgrasp.lessons.dialogue.calculations.quantity_names import THING, UNIT, unit_of
from tacgrasp.lessons.dialogue.calculations.scales import on_scale
from tacgrasp.lessons.dialogue.calculations.shares import (
    ratio,
    share,
    stiffness,
    unused,
    whole_share,
)
from tacgrasp.lessons.dialogue.calculations.terms import PLAIN, UNSAID, Term, in_mm2, in_newtons
from tacgrasp.lessons.dialogue.meaning import Calculated
from tacgrasp.lessons.dialogue.quantities import GRAVITY_N_PER_G, UNITS

_WEIGHS = re.compile(
    r"(?:how much|what|how many #?[a-z]+) (?:does|do|would|will) (?:(?:the|that|this) )?"
    r"(?:(?:held|gripped|grasped) )?[a-z]+(?: (?:(?:that|which) is )?(?:being )?(?:held|gripped|"
    r"grasped))? "
    r"weigh|(?:with )?(?:how much|what|"
    r"how many [a-z]+)(?: force)? "
    r"(?:does|do) gravity pull (?:on |at )?(?:(?:the|that|this) )?[a-z]+(?: with| down| at)*|"
    r"(?:with )?(?:how much|how hard|how strongly|what|how many [a-z]+)(?: force)? "
    r"(?:does|do|is) gravity "
    r"(?:pull|pulling|tug|act) (?:with )?(?:on|at) (?:(?:the|that|this) )?[a-z]+"
    r"(?: with| down| at)*|"
    r"(?:(?:how much|what|which|specify|state|give) )?(?:(?:is|does|would) )?(?:the )?"
    r"(?:gravitational|gravity) (?:load|force|pull)(?: (?:acts|act|acting|is|works|on|of|at))*"
    r"(?: (?:the|that|this|declared|told|held|given))* [a-z]+(?: (?:have|feel|exert))?|"
    r"gravity (?:pulls|acts|tugs) (?:on|at) (?:(?:the|that|this) )?(?:declared |given |told |"
    r"stated |lifted |held |"
    r"gripped )?[a-z]+ "
    r"with (?:how much|what|how many [a-z]+)"
)
_AS_FORCE = re.compile(r"\b(?:force|strongly|hard)\b")
_MASS_OF = re.compile(
    r"(?:what|which|how much|how large a) (?:mass|weight)(?: would| does)? "
    r"(?:weighs?|be|is)(?: (?:exactly|just))? (?:as much as|the same as|equal to) "
    r"(?P<a>.+?)(?: here on earth| on earth| take g .*)?"
)
_COUNT = re.compile(
    r"(?:(?:if|given) .+ )?(?:what|how much)(?: (?:mass|weight))? (?:would|do|does|will) "
    r"(?P<n>#\d+) (?:of (?:them|these|those|it)|such \w+|"
    r"(?:of )?(?:these |the )?(?:objects|things|pieces|items|berries))(?: "
    r"(?:have|weigh|together|be|come to|amount to))+"
)
_AT = re.compile(
    r"at how much (?:would|will|do|should) (?:we|i|it|you) (?:stand|be)(?: at)? (?P<a>.+)"
)
_ALONE = re.compile(
    r"(?:(?:what|how (?:much|large|big|great|long|wide|heavy)|(?:what|which) (?:force|depth|mass|"
    r"area)) "
    r"(?:is|are|would be|makes?) )?(?P<a>.+?)(?: (?:(?:what|how much) is (?:it|that|the .+)|"
    r"(?:would |will )?(?:comes?|come|amounts?|total|weigh|add up) (?:to )?(?:what|how much)|(?:is|"
    r"makes|equals) (?:what|how much)|"
    r"under earth gravity.*|given the (?:stated |told )?mass))*"
)


_WOULD_BE = re.compile(
    r"^(?:what|how much) (?:would|will) (?P<a>(?:#\d+ times|#\d+ percent of|\w+ of) .+?) be$"
)
_ON_SCALE = re.compile(
    r"(?:what|how much) (?:would|will|does|should|might) (?:a|the|my|our) (?:\w+ )?"
    r"(?:scales?|balance) (?:show|read|say|display|indicate|report)s?"
    r"(?: (?:if|when|under|with|for|at) .*)?"
)
_ON_GAUGE = re.compile(
    rf"(?:(?:an?|the|my|our) )?(?:\w+ )?(?:scales?|gauge|balance|meter|display) (?:reads?|shows?|"
    rf"is in|"
    rf"uses?|displays?) (?:in )?(?P<unit>{UNIT}) (?:and |so )?(?:what|how much) (?:would|will|"
    rf"does) it "
    r"(?:show|read|say|display)(?: (?:for|of|at|with|here|now) ?.*)?"
)
_OF_FORCE = re.compile(rf"(?P<unit>{UNIT}) of (?:force|grip|squeeze|push|pull)")
_OWN_UNITS: Mapping[str, str] = {"area": "mm²", "volume": "mm³"}
"""Units in which answers give what only a calculation has."""


_HELD_BY = re.compile(
    r"\b(?:would|could|can|will) (?:it|we|you|i|the grip|the gripper) (?:then |still )?(?:hold|"
    r"carry|lift|support|bear)$"
)
"""'How many grams would it hold?', which is what the force holds and not what weighs as much."""


def calculated_amount(asked: AskedWords) -> Calculated | None:
    """The number that a question asks to calculate; None where it asks for none."""
    if alone := _OF_FORCE.fullmatch(asked.words) or _ON_GAUGE.fullmatch(
        asked.words
    ):  # 'kilos of force, please'
        asked = replace(asked, words="force", unit=unit_of(alone["unit"]))
    if not asked.numbers and _ON_SCALE.fullmatch(asked.words):
        asked = replace(asked, words="force", unit=asked.unit or "g")
    readers: tuple[Callable[[AskedWords], Term | None], ...] = (
        to_border, pressure, stiffness, circle, free_area, volume, as_many_as, on_scale,
        safety_factor, needed, load, unused, share, ratio, missing, signed_offset, error, apart,
        taken, from_point, whole_share, into_band, before_leaving, _counted, _pulls_down, _weight,
        _stood_at, _alone,
    )  # fmt: skip
    for reader in readers:
        if (term := reader(asked)) and (amount := amount_of(term, asked)):
            return amount
    return None


def amount_of(term: Term, asked: AskedWords) -> Calculated | None:
    """A term as the answer; None where it can't be given in the unit that is asked for."""
    if not term.has_quantity or term.dimension == UNSAID:
        return None
    expression = term.expression
    if asked.is_unsigned:
        expression = f"abs({expression})"
    if asked.has_floor:
        expression = f"max(0, {expression})"
    unit = asked.unit or usual_unit(term.dimension) or _OWN_UNITS.get(term.dimension, "")
    if term.dimension == PLAIN:
        if "/" in asked.unit:
            return None
        is_percent = asked.unit == "%"
        return Calculated(
            truth=f"100 * {expression}" if is_percent else expression,
            unit="%" if is_percent else "",
        )
    if "/" in term.dimension:
        return Calculated(truth=expression, unit=term.dimension)
    if unit not in UNITS:
        return None
    if UNITS[unit].dimension == "force" and term.dimension == "mass":
        return Calculated(truth=in_newtons(term).expression, unit=unit)
    if UNITS[unit].dimension == "mass" and term.dimension == "force":
        if _HELD_BY.search(asked.words):
            return Calculated(truth=f"{term.factor} / gram_n", unit=unit)
        return Calculated(truth=f"{term.factor} / {GRAVITY_N_PER_G:g}", unit=unit)
    if UNITS[unit].dimension == "area" and "area_percent" in expression:
        in_area = in_mm2(replace(term, expression=expression))
        return Calculated(truth=in_area.expression, unit=unit)
    if UNITS[unit].dimension != term.dimension:
        return None
    return Calculated(truth=expression, unit=unit)


def _weight(asked: AskedWords) -> Term | None:
    """The object's weight in newtons, and the mass that weighs as much as a force."""
    if _WEIGHS.fullmatch(asked.words):
        mass = Term(expression="mass_g", dimension="mass", words="", is_weight=True)
        if asked.unit in ("N", "mN"):
            return mass
        return in_newtons(mass) if not asked.unit and _AS_FORCE.search(asked.words) else None
    found = _MASS_OF.fullmatch(asked.words)
    force = asked.term(found["a"], beside=usual("force")) if found else None
    if force is None or force.dimension != "force":
        return None
    return Term(expression=f"{force.factor} / {GRAVITY_N_PER_G:g}", dimension="mass", words="")


_PULLS_DOWN = re.compile(
    r"(?:with )?(?:what|how much|how many [a-z]+)(?: force)? (?:does|would|will|do) (?P<a>.+?) "
    r"(?:pull|tug|hang|weigh|press|drag)(?: down| downwards?| with| at)*|"
    r"(?P<b>.+?) (?:pull|tug|hang|press|drag)s? down(?:wards?)? with (?:what|how much)(?: force)?"
)
_BODY = re.compile(rf"(?:the|this|that|our|my) {THING}")


def _pulls_down(asked: AskedWords) -> Term | None:
    """The weight of a named mass: 'what does a 200 g pear pull down with'."""
    found = _PULLS_DOWN.fullmatch(asked.words)
    named = (found["a"] or found["b"]) if found else ""
    mass = asked.term("mass" if _BODY.fullmatch(named) else named) if named else None
    if mass is None or mass.dimension != "mass" or mass.expression == "holds_g":
        return None
    return in_newtons(mass)


def _counted(asked: AskedWords) -> Term | None:
    found = _COUNT.fullmatch(asked.words)
    count = asked.term(found["n"]) if found else None
    if count is None:
        return None
    return Term(expression=f"{count.expression} * mass_g", dimension="mass", words="")


def _stood_at(asked: AskedWords) -> Term | None:
    """The term that a question asks to stand at: 'at how many newtons are 80 % of the limit'."""
    found = _AT.fullmatch(asked.words)
    return asked.term(found["a"]) if found else None


def _alone(asked: AskedWords) -> Term | None:
    """A term that is itself what is asked for, where it is more than a quantity."""
    found = _ALONE.fullmatch(_WOULD_BE.sub(r"what is \g<a>", asked.words))
    term = asked.term(found["a"]) if found else None
    if term is None:
        return None
    is_simple = re.fullmatch(r"\w+", term.expression) is not None
    is_place = term.expression in ("x_mm", "y_mm") and "coordinate" not in term.words
    if is_simple and asked.unit and not is_place and term.expression != "100":
        return term
    in_force = term.is_weight and asked.unit in ("N", "mN")
    return term if in_force or not is_simple else None
