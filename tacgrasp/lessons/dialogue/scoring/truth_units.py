"""What a truth measures, and in which multiple of the unit of its names.

A file may state what is asked for in microns as ``depth_mm`` or as ``depth_mm * 1000``.
"""

from __future__ import annotations

import math
import re

from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.quantities import GRAVITY_N_PER_G, UNITS, unit_of_name

_FORCES = ("force_n", "limit_n", "band_low_n", "band_high_n")
MOST_MULTIPLE = 20.0
"""Largest multiple of a quantity that a truth states in another unit. Our choice."""

_OVER_GRAM = re.compile(r"/ *gram_n\b")


def dimension_of(truth: Expression) -> str:
    """What a number measures, by the first name of its truth; '' for a word.

    A quotient of two names of one dimension is a ratio, and 100 of them, or of a name over a
    number, percent. A mass times what a gram weighs is a force, and a force over it a mass; so of
    the force that holds a gram. The root of an area is a length, a force over an area a pressure,
    an area times a depth a volume.
    """
    if {"pad_width_mm", "pad_height_mm"} <= set(truth.names) and re.search(
        r"pad_width_mm \* pad_height_mm|pad_height_mm \* pad_width_mm", truth.text
    ):
        return "area"
    if set(truth.names) == {"force_n", "area_mm2"} and "/" in truth.text:
        return "pressure"
    if set(truth.names) == {"depth_mm", "area_mm2"} and "/" not in truth.text:
        return "volume"
    if truth.is_percentage:
        return "fraction"
    if "gram_n" in truth.names and set(truth.names) <= {"mass_g", "gram_n", *_FORCES}:
        return "mass" if _OVER_GRAM.search(truth.text) else "force"
    if truth.names == ("area_mm2",) and re.search(r"sqrt|\*\* ?0?\.5", truth.text):
        return "length"
    dimensions = [next(filter(None, map(_dimension_of_name, names)), "") for names in truth.divided]
    has_gravity = _has_gravity(truth)
    if has_gravity and set(dimensions) == {"force", "mass"}:
        return "ratio"
    if len(set(dimensions)) == 1 and dimensions[0]:
        return "ratio"
    first = next(filter(None, map(_dimension_of_name, truth.names)), "")
    if has_gravity and first == "mass" and len(truth.names) == 1:
        return "force"
    if has_gravity and set(truth.names) <= set(_FORCES) and "/" in truth.text:
        return "mass"
    return "ratio" if first == "fraction" and truth.is_hundredth else first


def is_count(truth: Expression) -> bool:
    """Whether it may tell how many things of one size are as much: ``depth_mm / 0.05``."""
    is_measure = dimension_of(truth) not in ("", "fraction", "ratio")
    is_share = is_measure and "/" in truth.text and len(truth.names) == 1
    return is_share and _factor(truth) != 0 and _stated_scale(truth) is None


def scale_of(truth: Expression) -> float:
    """How many of the unit that a truth is stated in make one of its dimension's own.

    1000 of ``depth_mm * 1000``, which is in microns, and 0.001 of ``force_n / 9.81``, which is in
    kilograms; 1 where it may as well be a multiple of the quantity ('twice the depth').
    """
    if dimension_of(truth) in ("", "fraction", "ratio"):
        return 1.0
    if (stated := _stated_scale(truth)) is not None:
        return stated
    if not _has_gravity(truth):
        return truth.power_of_ten
    in_own = _factor(truth) / _own_factor(truth)
    if in_own <= 0:
        return 1.0
    power = 10.0 ** round(math.log10(in_own))
    return power if math.isclose(in_own, power, rel_tol=0.01) else 1.0


def is_multiple_in(truth: Expression, size: float) -> bool:
    """Whether a truth may be a multiple of its quantity in a unit: half the depth in microns.

    Args:
        truth: The truth, such as ``500 * depth_mm``.
        size: Size of the unit.
    """
    if dimension_of(truth) in ("", "fraction", "ratio") or _stated_scale(truth) is not None:
        return False
    return MOST_MULTIPLE**-1 <= abs(_factor(truth)) * size <= MOST_MULTIPLE


def _stated_scale(truth: Expression) -> float | None:
    """How many of the unit of a truth's factor make one of its dimension's own; None of no unit."""
    dimension, in_own = dimension_of(truth), _factor(truth) / _own_factor(truth)
    tolerance = 3e-3 if _has_gravity(truth) else 1e-3  # of 9.81 for 9.80665
    scales = (1 / unit.size for unit in UNITS.values() if unit.dimension == dimension)
    return next((each for each in scales if math.isclose(in_own, each, rel_tol=tolerance)), None)


def _own_factor(truth: Expression) -> float:
    """What turns a truth's quantity into its dimension's own unit: a force's mass, or weight."""
    if not _has_gravity(truth):
        return 1.0
    return 1 / GRAVITY_N_PER_G if dimension_of(truth) == "mass" else GRAVITY_N_PER_G


def _has_gravity(truth: Expression) -> bool:
    return any(map(_is_gravity, truth.numbers))


def _factor(truth: Expression) -> float:
    """What the first quantity is multiplied with, of a sum or pressure; 0 of a word, or of none."""
    if not truth.names:  # a number that was told in the question
        return 0.0
    zeros = dict.fromkeys(truth.names, 0.0)
    if dimension_of(truth) == "pressure":
        zeros["area_mm2"] = 1.0
    try:
        values = [truth.evaluate(each).value for each in (zeros, {**zeros, truth.names[0]: 1.0})]
    except ValueError:  # it compares a word
        return 0.0
    low, high = (value if isinstance(value, float) else math.nan for value in values)
    return 0.0 if math.isnan(high - low) else high - low


def unit_of(truth: Expression) -> str:
    """The unit that a truth is stated in; '' for a word, a ratio, and a number of none."""
    dimension, scale = dimension_of(truth), scale_of(truth)
    units = [unit for unit in UNITS.values() if unit.dimension == dimension]
    stated = [unit.symbol for unit in units if math.isclose(unit.size * scale, 1.0, rel_tol=1e-6)]
    return stated[0] if stated else next((each.symbol for each in units if each.size == 1.0), "")


def _is_gravity(number: float) -> bool:
    """Whether a number is 9.8 times a power of ten."""
    return number > 0 and 9.7 < 10 ** (-math.floor(math.log10(number))) * number < 9.9


def _dimension_of_name(name: str) -> str:
    unit = unit_of_name(name)
    return UNITS[unit].dimension if unit else ""
