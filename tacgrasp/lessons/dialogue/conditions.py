"""Conditions that a yes or a no tells, by their words in a query.

    depth > 300 µm      force 1 - 2 N       offset_x <= 2 mm
    shape ring          depth >= deep       force within        left        cut left
    slips 30 g          stays given         needed 30 g <= 0.5 N
    twice force over    half force within   force 1.2 +- 0.1 N
    half depth > 0.2 mm        force about 1.2 N

Not here: wordings (``tacgrasp.lessons.dialogue.families``), queries
(``tacgrasp.lessons.dialogue.query``).
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from cltp.tactile.states import CLASSES, Position, Side
from tacgrasp.lessons.dialogue.meaning import Check, Length, grams_of
from tacgrasp.lessons.dialogue.quantities import MULTIPLIED, QUANTITIES, TIMES
from tacgrasp.lessons.dialogue.scene import HOLDING_N_PER_G

IN_BAND = "band_low_n <= force_n <= band_high_n"
OUTSIDE_BAND = "max(0, band_low_n - force_n, force_n - band_high_n)"
"""How far the force is outside of its band [N]."""

_BAND_MIDDLE = QUANTITIES["band_middle"].truth
_FORCE_STATES: Mapping[str, tuple[str, str]] = {
    "force within": (IN_BAND, "force_band"),
    "force below": ("force_n < band_low_n", "force_band"),
    "force above": ("force_n > band_high_n", "force_band"),
    "force enough": ("force_n >= band_low_n", "force_band"),
    "force over": ("force_n > limit_n", "force"),
    "force under": ("force_n <= limit_n", "force"),
}
STATES: Mapping[str, tuple[str, str]] = {
    "touched": ("contact", "contact"),
    "empty": ("not contact", "contact"),
    "cut": ("cut", "cut"),
    "whole": ("not cut", "cut"),
    "left": ("x_mm < 0", "x"),
    "right": ("x_mm > 0", "x"),
    "top": ("y_mm > 0", "y"),
    "bottom": ("y_mm < 0", "y"),
    "wider": ("abs(x_mm) > abs(y_mm)", "x"),
    "higher": ("abs(y_mm) > abs(x_mm)", "y"),
    **_FORCE_STATES,
    "force upper": (f"force_n > {_BAND_MIDDLE}", "band_middle"),
    "force lower": (f"force_n < {_BAND_MIDDLE}", "band_middle"),
    **{
        f"{name} {state}": (condition.replace("force_n", f"{factor:g} * force_n"), "force")
        for name, factor in TIMES.items()
        for state, (condition, _) in _FORCE_STATES.items()
    },
}
"""Expression of each state, and the fact that an answer names."""

EDGE_STATES: Mapping[str, tuple[str, str]] = {
    **{f"cut {side}": (f"cut_{side}", "cut_sides") for side in Side},
    **{
        f"near {side}": (
            " or ".join(f"position == '{each}'" for each in Position if side in each.split("-")),
            "position",
        )
        for side in Side
    },
}
"""The same of one edge of the pad: that it cuts the contact, and that the contact is near it. Rules
alone come to them (``tacgrasp.lessons.dialogue.rules``)."""

_MEASURED: Mapping[str, Mapping[str, str]] = {
    "depth": {"mm": "", "µm": " / 1000", "cm": " * 10"},
    "force": {"N": "", "mN": " / 1000", "cN": " / 100", "g": " * 0.00981"},
    "area": {"%": "", "mm²": ""},
    "distance": {"mm": ""},
    "x": {"mm": ""},
    "y": {"mm": ""},
    "offset_x": {"mm": ""},
    "offset_y": {"mm": ""},
    "mass": {"g": "", "kg": " * 1000"},
    "limit": {"N": "", "mN": " / 1000", "cN": " / 100", "g": " * 0.00981"},
    "band_low": {"N": ""},
    "band_high": {"N": ""},
    "headroom": {"N": "", "mN": " / 1000"},
    "used": {"%": ""},
    "holds": {"g": "", "kg": " * 1000"},
    "free_area": {"%": ""},
    "spare": {"g": ""},
}
MEASURED: Mapping[str, Mapping[str, str]] = {
    **_MEASURED,
    **{f"{times} {name}": _MEASURED[name] for name in MULTIPLIED for times in TIMES},
}
"""Factor behind a number, by compared quantity (``QUANTITIES``) and unit."""

SIGNS = (">", "<", ">=", "<=")

ABOUT = 0.1
"""Distance from a number, as a fraction of it, up to which a quantity is about that number. Our
choice: as far as a said number may be off."""

ORDERED: Mapping[str, Sequence[str]] = {"depth": CLASSES["depth"], "area": CLASSES["area"]}
"""Words that have an order: 'depth >= deep'."""

FATES: Mapping[str, str] = {"slips": "<", "stays": ">="}
"""Sign of the force against the one that is needed."""

GIVEN = "given"
"""Stands for the mass that somebody told."""

WORD_FACTS = {
    name: {"depth": "depth_word", "area": "area_word"}.get(name, name) for name in CLASSES
}
"""Fact of each dimension's word."""

_TIMES = rf"(?:(?:{'|'.join(TIMES)}) )?"
_COMPARED = re.compile(rf"({_TIMES}\w+) (>=|<=|>|<) (\S+) (\S+)")
_RANKED = re.compile(r"(depth|area) (>=|<=|>|<) ([a-z ]+)")
_BETWEEN = re.compile(rf"({_TIMES}\w+) (\S+) - (\S+) (\S+)")
_NEAR = re.compile(rf"({_TIMES}\w+) (\S+) \+- (\S+) (\S+)")
_ABOUT = re.compile(r"(depth|force) about (\S+) (\S+)")
_FATE = re.compile(rf"({'|'.join(FATES)}) (?:{GIVEN}|(\S+) (\S+))")
_SUFFICES = re.compile(r"needed (\S+) (g|kg) (<=|>) (\S+) (N|mN)")


def check_of(test: str, *, denied: bool = False, length: Length = Length.FREE) -> Check:
    """The meaning of a question for yes or no.

    Args:
        test: The condition, in the words above.
        denied: Whether the question asks if it is not so.
        length: How long the answer is to be.

    Raises:
        ValueError: There is no such condition.
    """
    needed_n = ""
    name, _, word = test.partition(" ")
    if state := STATES.get(test) or EDGE_STATES.get(test):
        condition, shows = state
    elif suffices := _SUFFICES.fullmatch(test):
        mass, mass_unit, sign, force, unit = suffices.groups()
        needed_n = f"{HOLDING_N_PER_G} * {_mass(mass, mass_unit)}"
        condition = (
            f"gram_n * {_mass(mass, mass_unit)} {sign} {_plain(force)}{MEASURED['force'][unit]}"
        )
        shows = ""
    elif word in CLASSES.get(name, ()):
        condition, shows = f"{name} {'!=' if denied else '=='} '{word}'", WORD_FACTS[name]
    elif fate := _FATE.fullmatch(test):
        needed_n = f"{HOLDING_N_PER_G} * {_mass(fate[2], fate[3])}"
        condition, shows = f"force_n {FATES[fate[1]]} {needed_n}", "force"
    elif (ranked := _RANKED.fullmatch(test)) and ranked[3] in ORDERED[ranked[1]]:
        condition, shows = f"{ranked[1]} {ranked[2]} '{ranked[3]}'", WORD_FACTS[ranked[1]]
    elif compared := _COMPARED.fullmatch(test):
        name, sign, number, unit = compared.groups()
        expression, factor = _measured(name, unit)
        condition, shows = f"{expression} {sign} {_plain(number)}{factor}", name
    elif between := _BETWEEN.fullmatch(test):
        name, *ends, unit = between.groups()
        expression, factor = _measured(name, unit)
        low, high = sorted(ends, key=float)
        condition = f"{_plain(low)}{factor} <= {expression} <= {_plain(high)}{factor}"
        shows = name
    elif near := _NEAR.fullmatch(test):
        name, middle, away, unit = near.groups()
        expression, factor = _measured(name, unit)
        condition = (
            f"abs({expression} - {_plain(middle)}{factor}) <= {_plain(away.lstrip('-'))}{factor}"
        )
        shows = name
    elif about := _ABOUT.fullmatch(test):
        name, middle, unit = about.groups()
        expression, factor = _measured(name, unit)
        away = number_text(ABOUT * float(middle))
        condition = f"abs({expression} - {_plain(middle)}{factor}) <= {away}{factor}"
        shows = name
    else:
        raise ValueError(f"there is no condition {test!r}")
    if denied and word not in CLASSES.get(name, ()):
        condition = f"not ({condition})"
    return Check(
        test=test,
        denied=denied,
        condition=condition,
        shows=(shows,) if shows else (),
        needed_n=needed_n,
        length=length,
    )


def taken(quantity: str, number: float, unit: str) -> str:
    """A number that is taken from a quantity, with the factor to the quantity's own unit."""
    return f"{number_text(number)}{MEASURED[quantity][unit]}"


def number_text(number: float) -> str:
    """A number with as few digits as it needs."""
    return f"{number:.6g}"


def _mass(number: str | None, unit: str | None) -> str:
    if number is None or unit is None:
        return "mass_g"
    return grams_of(f"{number} {unit}")


def _measured(name: str, unit: str) -> tuple[str, str]:
    if unit not in MEASURED.get(name, {}):
        raise ValueError(f"there is no {name} in {unit}")
    expression = "area_mm2" if unit == "mm²" else QUANTITIES[name].truth
    return expression, MEASURED[name][unit]


def _plain(number: str) -> str:
    return number_text(float(number))
