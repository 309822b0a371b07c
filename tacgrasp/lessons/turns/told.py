"""What a person tells in a dialogue: the object's mass, the force band, the limit.

    The object weighs 50 g.
    If the band is 1 to 2 N, is it safe to lift?
    Suppose it weighs 70 g. How many newtons are missing?

Not here: a mass or bound that a question compares with what is felt, which the grammar reads.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from tacgrasp.lessons.dialogue.quantities import UNITS
from tacgrasp.lessons.dialogue.scene import AskedScene, band_contract
from tacgrasp.lessons.turns.rewriting import dimension_of, unit_symbol

_N = r"(?P<{}>\d+(?:[.,]\d+)?)"
_UNIT = r"(?P<{}>[a-zA-Zµ]+)"
_IF = (
    r"(?P<if>(?:(?:if|suppose|supposing|assuming|assume|say|given(?: that)?|let us say|and|what)"
    r"[,:]? )*)(?:(?:note|ok|no)[,:]? )*"
)
_THING = (
    r"(?:it|this|that|the (?:object|berry|strawberry|fruit|egg|tomato|part|thing|piece|peg|mass|"
    r"weight))"
)
_TOLD = re.compile(
    rf"{_IF}(?:"
    rf"{_THING} ?(?:weighs|weighed|is|was|'s|has a mass of) (?:about |only |actually )?"
    rf"{_N.format('mass')} ?{_UNIT.format('mass_unit')}(?:,? not [^,.?]+)?|"
    rf"(?:the|my|our) (?:hard |force )?limit (?:is|was|were|=) {_N.format('limit')} ?"
    rf"{_UNIT.format('limit_unit')}|"
    rf"(?:the|my|our) (?:force )?(?:band|goal|range|target) (?:is|was|were|=|goes from) "
    rf"(?:from )?{_N.format('low')}(?: ?{_UNIT.format('low_unit')})? ?(?:to|-|–|and) ?"
    rf"{_N.format('high')} ?{_UNIT.format('high_unit')}"
    rf")(?P<end>[.!]?$|[,.;:] (?P<asked>.+))",
    re.I,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Told:
    """What was told.

    Attributes:
        mass_g: Mass of the object [g]; None where it was not told.
        band_n: Force band [N]; None likewise.
        limit_n: Limit of the force [N]; None likewise.
        is_supposed: Whether it counts for one question alone: 'if it weighs 50 g'.
    """

    mass_g: float | None = None
    band_n: tuple[float, float] | None = None
    limit_n: float | None = None
    is_supposed: bool = False

    @property
    def text(self) -> str:
        """It in words."""
        if self.mass_g is not None:
            return f"the object weighs {self.mass_g:g} g"
        if self.band_n is not None:
            return f"the force band is {self.band_n[0]:g} to {self.band_n[1]:g} N"
        return f"the limit is {self.limit_n:g} N"


def told_in(text: str) -> tuple[Told, str] | None:
    """What a text tells, and what it asks besides, or ''; None where it tells nothing."""
    found = _TOLD.fullmatch(text.strip())
    if found is None:
        return None
    mass_g = _number(found, "mass", "mass")
    limit_n = _number(found, "limit", "force")
    high_n = _number(found, "high", "force")
    low_n = _number(found, "low", "force") if found["low_unit"] else None
    if high_n is not None and low_n is None:
        low_n = _float(found["low"]) * high_n / _float(found["high"])
    band_n = None if low_n is None or high_n is None else (low_n, high_n)
    if mass_g is None and limit_n is None and band_n is None:
        return None
    told = Told(mass_g=mass_g, band_n=band_n, limit_n=limit_n, is_supposed=bool(found["if"]))
    return told, found["asked"] or ""


def _number(found: re.Match[str], name: str, dimension: str) -> float | None:
    """A number in its dimension's own unit; None where there is none, or of another dimension."""
    unit = found[f"{name}_unit"]
    if found[name] is None or dimension_of(unit) != dimension:
        return None
    return _float(found[name]) * UNITS[unit_symbol(unit)].size


def _float(number: str) -> float:
    return float(number.replace(",", "."))


def with_told(scene: AskedScene, told: Told) -> AskedScene:
    """A scene with what was told.

    Raises:
        ValueError: It can't be so: a mass of 0, a band that is upside down, a limit without a band.
        LimitError: The contract would be refused.
    """
    if told.mass_g is not None:
        scene = replace(scene, mass_g=told.mass_g)
    if told.band_n is None and told.limit_n is None:
        return scene
    if told.band_n is not None:
        return replace(scene, contract=band_contract(*told.band_n))
    if scene.contract is None:
        raise ValueError("a limit needs a force band; tell me the band too")
    return replace(scene, contract=replace(scene.contract, limit_n=told.limit_n))
