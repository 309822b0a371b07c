"""Quantities that can be asked for, their units, and numbers as text.

Numbers have the digits of the captions (``cltp.texts.captions``): mm and N with two, x and y with
one, percent with two figures or so. Other units follow from these digits, so that 0.19 mm and
190 µm are the same answer.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass

from tacgrasp.lessons.dialogue.scene import AskedScene

GRAVITY_N_PER_G = 9.80665e-3
"""Weight of a gram [N/g]."""


MEAN_PRESSURE = "force_n / area_mm2"
"""Mean pressure of the contact, as an expression [N/mm²]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Unit:
    """A unit.

    Attributes:
        symbol: As queries write it.
        dimension: What it measures: length, force, fraction, area, volume, mass or pressure.
        size: Its size in mm, N, percent, mm², mm³, g or N/mm².
        written: As answers write it; '' for the symbol.
    """

    symbol: str
    dimension: str
    size: float
    written: str = ""


UNITS: Mapping[str, Unit] = {
    unit.symbol: unit
    for unit in (
        Unit(symbol="mm", dimension="length", size=1.0),
        Unit(symbol="µm", dimension="length", size=1e-3),
        Unit(symbol="cm", dimension="length", size=10.0),
        Unit(symbol="nm", dimension="length", size=1e-6),
        Unit(symbol="N", dimension="force", size=1.0),
        Unit(symbol="mN", dimension="force", size=1e-3),
        Unit(symbol="cN", dimension="force", size=1e-2),
        Unit(symbol="%", dimension="fraction", size=1.0),
        Unit(symbol="mm²", dimension="area", size=1.0),
        Unit(symbol="g", dimension="mass", size=1.0),
        Unit(symbol="kg", dimension="mass", size=1000.0),
        Unit(symbol="m", dimension="length", size=1000.0),
        Unit(symbol="in", dimension="length", size=25.4),
        Unit(symbol="thou", dimension="length", size=0.0254),
        Unit(symbol="kN", dimension="force", size=1000.0),
        Unit(symbol="kgf", dimension="force", size=9.80665),
        Unit(symbol="lbf", dimension="force", size=4.4482216),
        Unit(symbol="ozf", dimension="force", size=0.27801385),
        Unit(symbol="dyn", dimension="force", size=1e-5),
        Unit(symbol="cm²", dimension="area", size=100.0),
        Unit(symbol="in²", dimension="area", size=645.16),
        Unit(symbol="mg", dimension="mass", size=1e-3),
        Unit(symbol="lb", dimension="mass", size=453.59237),
        Unit(symbol="oz", dimension="mass", size=28.349523),
        Unit(symbol="mm³", dimension="volume", size=1.0),
        Unit(symbol="µL", dimension="volume", size=1.0),
        Unit(symbol="cm³", dimension="volume", size=1000.0),
        Unit(symbol="mL", dimension="volume", size=1000.0),
        Unit(symbol="dmm", dimension="length", size=0.1, written="tenths of a mm"),
        Unit(symbol="cmm", dimension="length", size=0.01, written="hundredths of a mm"),
        Unit(symbol="dN", dimension="force", size=0.1, written="tenths of a newton"),
        Unit(symbol="N/mm²", dimension="pressure", size=1.0),
        Unit(symbol="N/cm²", dimension="pressure", size=1e-2),
        Unit(symbol="Pa", dimension="pressure", size=1e-6),
        Unit(symbol="hPa", dimension="pressure", size=1e-4),
        Unit(symbol="kPa", dimension="pressure", size=1e-3),
        Unit(symbol="MPa", dimension="pressure", size=1.0),
        Unit(symbol="mbar", dimension="pressure", size=1e-4),
        Unit(symbol="bar", dimension="pressure", size=0.1),
        Unit(symbol="psi", dimension="pressure", size=6.8947573e-3),
        Unit(symbol="mmHg", dimension="pressure", size=1.33322387e-4),
        Unit(symbol="atm", dimension="pressure", size=0.101325),
        Unit(symbol="daN", dimension="force", size=10.0),
    )
}
"""Units by symbol. Grams also stand for the force that they weigh."""

_UNIT_OF_ENDING = {"mm": "mm", "mm2": "mm²", "n": "N", "percent": "%", "g": "g"}


_MEASURED = (
    (r"m?n|(?:milli)?newtons?", "the force"),
    (r"mm|[µu]m|cm|microns?|(?:milli|micro|centi)met(?:re|er)s?", "the depth"),
    (r"%|per ?cent|mm²|mm2", "the contact area"),
)


def measured_by(number: str) -> str:
    """What a unit measures of a contact, in words; '' of other units.

    Args:
        number: The unit as people write it, with or without a number before it: 'mm', '2.5 N'.
    """
    unit = re.sub(r"^[\d.,]+ ?", "", number)
    return next((what for units, what in _MEASURED if re.fullmatch(units, unit, re.I)), "")


def unit_of_name(name: str) -> str:
    """Unit of a name of ``AskedScene.values``, which ends with it; '' of a word."""
    return _UNIT_OF_ENDING.get(name.rpartition("_")[2], "")


@dataclass(frozen=True, slots=True, kw_only=True)
class Quantity:
    """A number that can be asked for.

    Attributes:
        truth: Its expression (``tacgrasp.lessons.dialogue.expression``).
        unit: Unit of that expression.
        noun: What it is.
        decimals: Digits after the point in that unit.
        is_signed: Whether answers show a plus.
        article: What stands before its noun.
    """

    truth: str
    unit: str
    noun: str
    decimals: int = 2
    is_signed: bool = False
    article: str = "the "

    @property
    def name(self) -> str:
        """Its noun with its article."""
        return f"{self.article}{self.noun}"


TIMES: Mapping[str, float] = {"half": 0.5, "twice": 2.0, "thrice": 3.0}
"""Multiples by their names in queries."""

_SAID_TIMES = {"half": "half", "twice": "twice", "thrice": "three times"}


def _multiples(name: str, quantity: Quantity) -> Mapping[str, Quantity]:
    """Multiples of a quantity by their names: 'twice force'."""
    return {
        f"{times} {name}": Quantity(
            truth=f"{factor:g} * {quantity.truth}",
            unit=quantity.unit,
            noun=quantity.noun,
            decimals=quantity.decimals,
            article=f"{_SAID_TIMES[times]} the ",
        )
        for times, factor in TIMES.items()
    }


_QUANTITIES: Mapping[str, Quantity] = {
    "depth": Quantity(truth="depth_mm", unit="mm", noun="depth"),
    "x": Quantity(truth="x_mm", unit="mm", noun="x", decimals=1, is_signed=True, article=""),
    "y": Quantity(truth="y_mm", unit="mm", noun="y", decimals=1, is_signed=True, article=""),
    "offset_x": Quantity(
        truth="abs(x_mm)", unit="mm", noun="distance from the vertical midline", decimals=1
    ),
    "offset_y": Quantity(
        truth="abs(y_mm)", unit="mm", noun="distance from the horizontal midline", decimals=1
    ),
    "leftward": Quantity(
        truth="-x_mm", unit="mm", noun="offset to the left", decimals=1, is_signed=True
    ),
    "tipward": Quantity(
        truth="-y_mm", unit="mm", noun="offset to the fingertip", decimals=1, is_signed=True
    ),
    "larger_offset": Quantity(
        truth="max(abs(x_mm), abs(y_mm))", unit="mm", noun="larger of both offsets", decimals=1
    ),
    "distance": Quantity(
        truth="hypot(x_mm, y_mm)", unit="mm", noun="distance from the center", decimals=1
    ),
    "area": Quantity(truth="area_percent", unit="%", noun="contact area", decimals=0),
    "force": Quantity(truth="force_n", unit="N", noun="force"),
    "band_low": Quantity(truth="band_low_n", unit="N", noun="least force wanted"),
    "band_high": Quantity(truth="band_high_n", unit="N", noun="most force wanted"),
    "limit": Quantity(truth="limit_n", unit="N", noun="limit"),
    "headroom": Quantity(truth="limit_n - force_n", unit="N", noun="force left to the limit"),
    "used": Quantity(
        truth="100 * force_n / limit_n", unit="%", noun="share of the limit in use", decimals=0
    ),
    "needed": Quantity(truth="gram_n * mass_g", unit="N", noun="force that surely holds it"),
    "lacking": Quantity(
        truth="max(0, band_low_n - force_n)", unit="N", noun="force lacking to the band"
    ),
    "excess": Quantity(
        truth="max(0, force_n - band_high_n)", unit="N", noun="force above the band"
    ),
    "to_low": Quantity(
        truth="abs(force_n - band_low_n)",
        unit="N",
        noun="distance of the force from the band's lower end",
    ),
    "to_high": Quantity(
        truth="abs(force_n - band_high_n)",
        unit="N",
        noun="distance of the force from the band's upper end",
    ),
    "mass": Quantity(truth="mass_g", unit="g", noun="mass", decimals=0),
    "holds": Quantity(truth="holds_g", unit="g", noun="heaviest load held", decimals=0),
    "free_area": Quantity(
        truth="100 - area_percent", unit="%", noun="free part of the pad", decimals=0
    ),
    "band_middle": Quantity(
        truth="(band_low_n + band_high_n) / 2", unit="N", noun="middle of the band"
    ),
    "off_middle": Quantity(
        truth="abs(force_n - (band_low_n + band_high_n) / 2)",
        unit="N",
        noun="distance of the force from the middle of the band",
    ),
    "band_width": Quantity(truth="band_high_n - band_low_n", unit="N", noun="width of the band"),
    "band_to_limit": Quantity(
        truth="limit_n - band_high_n", unit="N", noun="room between the band and the limit"
    ),
    "spare": Quantity(
        truth="holds_g - mass_g",
        unit="g",
        noun="load held beyond the mass",
        decimals=0,
        is_signed=True,
    ),
}
GIVEN = frozenset(
    {"band_low", "band_high", "limit", "needed", "mass", "band_middle", "band_width",
     "band_to_limit"}
)  # fmt: skip
"""Quantities that nobody feels: exact ones."""

MULTIPLIED = ("force", "depth", "holds")
"""Quantities whose multiples can be asked for."""

QUANTITIES: Mapping[str, Quantity] = {
    **_QUANTITIES,
    **{
        name: multiple
        for multiplied in MULTIPLIED
        for name, multiple in _multiples(multiplied, _QUANTITIES[multiplied]).items()
    },
}
"""Quantities by name."""


def amount_text(
    name: str, value: float, unit: str, scene: AskedScene, *, is_signed: bool = False
) -> str:
    """A value of a quantity, given in the quantity's own unit, as text in another unit.

    The value is rounded in its own unit first, as captions round it; what is given, and not felt,
    has a digit more where that would be more than a hundredth off.

    Args:
        name: Name of the quantity.
        value: Its value, or a difference of it.
        unit: Unit of the text.
        scene: The scene, whose sensor has an area.
        is_signed: Whether a plus is shown, whatever the quantity.
    """
    quantity = QUANTITIES[name]
    largest = {"holds": 0.05, "spare": 0.05}.get(name, 0.01 if name in GIVEN else math.inf)
    decimals_shown = quantity.decimals + _is_coarse(value, quantity.decimals, largest)
    sign = "+" if is_signed or quantity.is_signed else ""
    if unit == "%":
        return f"{sign if value >= 0 else '-'}{percent_text(abs(value))} %"
    shown = round(value, decimals_shown) + 0.0  # no minus before zeros
    written = UNITS[unit].written or unit
    if unit == quantity.unit:
        return f"{shown:{sign}.{decimals_shown}f} {unit}"
    converted = _in_unit(quantity, value if UNITS[unit].dimension == "area" else shown, unit, scene)
    size = 1 / _in_unit(quantity, 1.0, unit, scene)
    if unit in ("cm²", "in²"):
        size_of = math.floor(math.log10(abs(converted))) if converted else 0
        decimals = 2 if size_of >= -1 else 1 - size_of
    elif size > 1 and unit != "mm²":
        decimals = decimals_shown + math.ceil(math.log10(size) - 1e-9)
    else:
        decimals = 0 if abs(converted) >= 10 else 1
    return f"{converted:{sign}.{decimals}f} {written}"


def _is_coarse(value: float, decimals: int, largest: float) -> bool:
    """Whether rounding changes a value by more than a fraction of it."""
    return abs(round(value, decimals) - value) > largest * abs(value)


def value_text(value: float, unit: str) -> str:
    """A calculated value, given in mm, N, percent, mm², g or N/mm², as text in a unit.

    The unit is '' for a ratio, and may be a quotient of two ('N/mm'). Pressures, masses
    and small quotients have three figures.
    """
    if unit == "%":
        return f"{'-' if value < 0 else ''}{percent_text(abs(value))} %"
    known = UNITS.get(unit)
    one, _, each = unit.partition("/")
    size = known.size if known else UNITS[one].size / UNITS[each].size if each else 1.0
    dimension = known.dimension if known else ""
    has_two = abs(value) >= (1 if dimension == "force" else 0.1)
    base = 0 if dimension == "mass" else 2 if has_two else 3
    decimals = max(0, base + round(math.log10(size)))
    told = abs(value / size)
    is_rate = bool(each and not known) or dimension == "pressure"
    is_small = dimension == "mass" and told < 100
    if told > 0 and (is_small or (is_rate and (told < 1 or known is not None or decimals == 0))):
        decimals = max(0, 2 - math.floor(math.log10(told)))
    written = (known.written if known else "") or unit
    return f"{round(value / size, decimals) + 0.0:.{decimals}f} {written}".rstrip()


def to_step(text: str, step: float) -> str:
    """A text with its first number rounded to a multiple of a step, unless it is coarser."""

    def rounded(match: re.Match[str]) -> str:
        decimals = len(match["decimals"] or "")
        if step <= 10.0**-decimals:
            return match[0]
        told = math.floor(abs(float(match[0])) / step + 0.5) * step
        shown = len(f"{step:.6f}".rstrip("0").partition(".")[2])
        sign = match["sign"] if told else ""
        return f"{sign}{told:.{shown}f}"

    return re.sub(r"(?P<sign>[+-]?)\d+(?:\.(?P<decimals>\d+))?", rounded, text, count=1)


def can_be_in(name: str, unit: str) -> bool:
    """Whether an answer can give a quantity in a unit.

    A unit of its dimension can be had, of a force also the mass that weighs as much, and of a part
    of the pad also its area.
    """
    if name not in QUANTITIES or unit not in UNITS:
        return False
    own, other = UNITS[QUANTITIES[name].unit].dimension, UNITS[unit].dimension
    is_part = name in ("area", "free_area") and other == "area"
    return own == other or (own, other) == ("force", "mass") or is_part


def percent_text(percent: float) -> str:
    """A percentage in two figures or so."""
    decimals = 0 if percent >= 9.95 else 1 if percent >= 0.995 else 2
    return f"{percent:.{decimals}f}"


def number_in(text: str) -> float:
    """The first number of a text that ``amount_text`` wrote."""
    match = re.search(r"[+-]?\d+(?:\.\d+)?", text)
    if match is None:
        raise ValueError(f"no number in {text!r}")
    return float(match[0])


def _in_unit(quantity: Quantity, value: float, unit: str, scene: AskedScene) -> float:
    """A value in another unit; grams of a force are those that weigh as much."""
    base = value * UNITS[quantity.unit].size
    wanted = UNITS[unit]
    if wanted.dimension == "area":
        return base / 100 * scene.sensor.area_mm2 / wanted.size
    if wanted.dimension == "mass" and UNITS[quantity.unit].dimension == "force":
        return base / GRAVITY_N_PER_G / wanted.size
    return base / wanted.size
