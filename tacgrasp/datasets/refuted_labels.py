"""Labels that the heights of their own file refute by far, in words; '' for any other.

A label may be a person's estimate, and heights have the errors of their sensor, so that the
tolerances are wide: what they catch is another unit, another file, or a slip of the pen.

Not here: reading a table of labels (``tacgrasp.datasets.import_touches``).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from cltp.tactile.states import AREA_LIMITS, DEPTH_LIMITS_MM, Area, Depth

NUMBER_FACTOR, WORD_FACTOR, SLACK_MM = 5.0, 3.0, 0.1
"""Factor, and depth besides [mm], by which a number and the nearest limit of a word may differ from
the heights. Our choice: the heights of a soft skin, or of a tip finer than a pixel, may be half."""

TINY_FACTOR = 100.0
"""Factor below the heights from which a number is never meant in mm, however low they are."""

UNIT_FACTOR = 2.5
"""Factor by which a number in another unit may differ from the heights."""

AREA_FACTOR, LESS_AREA, MORE_AREA = 4.0, 0.02, 0.1
"""Factor, and fraction of the pad besides, by which the nearest limit of a word may exceed the area
that is measured, and stay below it. Our choice: twice what drift does."""

CLEAR_MM = 0.4
"""Depth from which an area can be measured as too large for a word: drift looks like area beside a
light press. Source: of 4,250 simulated contacts, without noise and with that of a sensor, no true
depth or area is refuted."""


def refuted_number(depth_mm: float, measured_mm: float, highest_mm: float) -> str:
    """How heights refute a number of mm.

    Args:
        depth_mm: The label.
        measured_mm: Depth that is measured from the heights [mm].
        highest_mm: Largest height [mm].
    """
    measured_mm = min(measured_mm, highest_mm)
    is_less = NUMBER_FACTOR * depth_mm + SLACK_MM < measured_mm or (
        TINY_FACTOR * depth_mm < measured_mm
    )
    if not is_less and depth_mm <= NUMBER_FACTOR * highest_mm + SLACK_MM:
        return ""
    hint = ""
    for factor, unit in ((1000.0, "metres? Multiply by 1000"), (0.001, "µm? Divide by 1000")):
        if abs(math.log(factor * depth_mm / highest_mm)) < math.log(UNIT_FACTOR):
            hint = f"; is it in {unit}"
    return f"depth {depth_mm:g} mm, but the heights reach {highest_mm:.2g} mm{hint}"


def refuted_depth(word: Depth, measured_mm: float, highest_mm: float) -> str:
    """How heights refute a class of depth; the arguments are those of ``refuted_number``."""
    low_mm, high_mm = _limits(word, DEPTH_LIMITS_MM)
    is_more = low_mm > WORD_FACTOR * highest_mm + SLACK_MM
    if not is_more and WORD_FACTOR * high_mm + SLACK_MM >= min(measured_mm, highest_mm):
        return ""
    shown = _range(low_mm, high_mm, "mm")
    return f"depth {word} ({shown}), but the heights reach {highest_mm:.2g} mm"


def refuted_area(word: Area, fraction: float, measured_mm: float) -> str:
    """How heights refute a class of area.

    Args:
        word: The label.
        fraction: Fraction of the sensing area in contact, as it is measured.
        measured_mm: Depth that is measured from the heights [mm].
    """
    low, high = _limits(word, AREA_LIMITS)
    is_less = measured_mm >= CLEAR_MM and AREA_FACTOR * high + MORE_AREA < fraction
    if not is_less and low <= AREA_FACTOR * fraction + LESS_AREA:
        return ""
    shown = _range(100 * low, 100 * high, "%")
    return f"area {word} ({shown}), but {fraction:.1%} of the pad seems to be in contact"


def _limits(word: Depth | Area, limits: Sequence[float]) -> tuple[float, float]:
    """Least and most of a class, by the limits between the classes of its kind."""
    number = list(type(word)).index(word)
    return (0.0, *limits)[number], (*limits, math.inf)[number]


def _range(low: float, high: float, unit: str) -> str:
    """Limits of a class in words."""
    if low == 0:
        return f"below {high:g} {unit}"
    return f"{low:g} {unit} and more" if math.isinf(high) else f"{low:g} to {high:g} {unit}"
