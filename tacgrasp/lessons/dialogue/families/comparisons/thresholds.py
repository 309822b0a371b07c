"""Comparisons with a number: their wordings, and numbers that make the answer yes or no.

A threshold is drawn around the value of the scene, so that the question can't be answered without
the contact.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from tacgrasp.lessons.dialogue.conditions import number_text
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.patterns.family import Bindings, Numbers
from tacgrasp.lessons.dialogue.quantities import GRAVITY_N_PER_G
from tacgrasp.lessons.dialogue.scene import AskedScene

COMPARISONS: dict[str, str] = {
    ">": (
        "(more than|more than|over|over|above|above|beyond|greater than|higher than|larger than|"
        "in excess of|bigger than|upwards of|past|exceeding|strictly above|any more than|"
        "anything above|something over)"
    ),
    "<": (
        "(less than|less than|under|under|below|below|smaller than|lower than|short of|beneath|"
        "not even|inferior to|fewer than|strictly below|any less than|"
        "anything under|something below)"
    ),
    ">=": (
        "(at least|at least|no less than|not less than|not below|a minimum of|not under|"
        "no lower than|no smaller than|as much as|equal to or above|"
        "greater than or equal to|at or above)"
    ),
    "<=": (
        "(at most|no more than|not more than|not above|not over|a maximum of|up to|no higher than|"
        "no bigger than|no larger than|not greater than|not beyond|equal to or below|"
        "less than or equal to|at or below|not any more than)"
    ),
}
"""Comparisons by their sign."""

MORE_THAN: dict[str, str] = {
    ">": (
        "(more than|more than|more than|over|over|above|in excess of|upwards of|"
        "beyond|exceeding|anything over|anything above)"
    ),
    "<": (
        "(less than|less than|less than|under|under|below|not even|short of|fewer than|"
        "anything under)"
    ),
    ">=": "(at least|at least|at least|no less than|not less than|a minimum of|as much as)",
    "<=": "(at most|at most|no more than|no more than|not more than|a maximum of|up to|not over)",
}
"""Comparisons that may follow a verb."""

UNDENIED: dict[str, str] = {
    ">": "(more than|over|above|beyond|greater than|higher than|larger than|bigger than|past)",
    "<": "(less than|under|below|smaller than|lower than)",
    ">=": "(at least|quite)",
}
"""Comparisons that 'not' may stand before."""

OR_MORE: dict[str, str] = {
    ">=": "(or more|or more|or above|or over|or higher|or greater|or beyond|and up|at least)",
    "<=": "(or less|or less|or below|or under|or lower|or smaller|at most|at the most|at best)",
}
"""Comparisons that follow their number."""

INVERSE = {">": "<=", "<": ">=", ">=": "<", "<=": ">"}
"""The sign of a denied comparison."""

BETWEEN, DENIED = "between", "denied"
"""Values of slots that stand for a range, and for a 'not'."""

UNITS: dict[str, str] = {
    "mm": "(mm|mm|millimetres|millimetre|millimeters)",
    "µm": "(µm|um|microns|micrometres|micrometers)",
    "cm": "(cm|centimetres|centimeters)",
    "N": "(N|N|newtons|newton)",
    "mN": "(mN|millinewtons)",
    "cN": "(cN|centinewtons)",
    "g": "(g|g|grams|grams|gram)",
    "kg": "(kg|kilograms|kilogram|kilos)",
    "%": "(%|percent|per cent) [of the (pad|pad|gel|sensor|skin|surface)]",
    "mm²": "(mm²|mm2|square millimetres|square mm|square millimeters)",
}
"""Units of thresholds by their symbols."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Scale:
    """How thresholds of a quantity are written in a unit.

    Attributes:
        size: One of this unit in the quantity's own.
        step: Step of the numbers, in this unit.
        low, high: Range of numbers where the scene has no value, in this unit.
    """

    size: float
    step: float
    low: float
    high: float


_WIDTH = {"mm": Scale(size=1.0, step=0.5, low=0.5, high=9.0)}
_FORCE = {
    "N": Scale(size=1.0, step=0.05, low=0.1, high=8.0),
    "mN": Scale(size=1e-3, step=50, low=100, high=8000),
    "cN": Scale(size=1e-2, step=5, low=10, high=800),
    "g": Scale(size=GRAVITY_N_PER_G, step=5, low=10, high=800),
}
_MASS = {
    "g": Scale(size=1.0, step=5, low=5, high=800),
    "kg": Scale(size=1000.0, step=0.01, low=0.02, high=0.8),
}
SCALES: Mapping[str, Mapping[str, Scale]] = {
    "depth_mm": {
        "mm": Scale(size=1.0, step=0.01, low=0.05, high=1.2),
        "µm": Scale(size=1e-3, step=10, low=50, high=1200),
        "cm": Scale(size=10.0, step=0.005, low=0.005, high=0.12),
    },
    "force_n": _FORCE,
    "area_percent": {
        "%": Scale(size=1.0, step=1, low=2, high=50),
        "mm²": Scale(size=0.32409, step=1, low=5, high=150),
    },
    "hypot(x_mm, y_mm)": _WIDTH,
    "x_mm": _WIDTH,
    "y_mm": _WIDTH,
    "abs(x_mm)": _WIDTH,
    "abs(y_mm)": _WIDTH,
    "mass_g": _MASS,
    "holds_g": _MASS,
    "limit_n": _FORCE,
    "band_low_n": _FORCE,
    "band_high_n": _FORCE,
    "limit_n - force_n": {"N": Scale(size=1.0, step=0.05, low=0.05, high=3.0)},
    "100 * force_n / limit_n": {"%": Scale(size=1.0, step=5, low=10, high=120)},
}
"""Scales by expression and unit. mm² are those of a GelSight Mini, whose 1 % is 3.09 mm²."""


def one_threshold(
    truth: str, scaled_as: str = ""
) -> Callable[[AskedScene, Bindings, np.random.Generator], dict[str, str]]:
    """Chooser of the number ``t``, and of a second, greater one ``u``, around an expression.

    Args:
        truth: The expression.
        scaled_as: Another expression, whose scales its numbers have; '' for its own.
    """
    expression = Expression(truth)
    scales = SCALES[scaled_as or truth]

    def choose(scene: AskedScene, bindings: Bindings, rng: np.random.Generator) -> dict[str, str]:
        scale = scales[_unit(bindings) or next(iter(scales))]
        value = expression.evaluate(scene.values()).value
        known = isinstance(value, float) and value != 0
        middle = (
            abs(float(value or 0.0)) / scale.size
            if known
            else float(np.exp(rng.uniform(math.log(scale.low), math.log(scale.high))))
        )
        away = float(np.exp(rng.choice([-1, 1]) * rng.uniform(0.1, 0.9)))
        first = _stepped(middle * away, scale.step)
        second = _stepped(first * float(np.exp(rng.uniform(0.3, 1.2))) + scale.step, scale.step)
        return {"t": number_text(first), "u": number_text(second)}

    return choose


def test_of(quantity: str, unit: str, bindings: Bindings, numbers: Numbers) -> tuple[str, bool]:
    """The comparison that a wording makes, in the words of a query, and whether it is denied.

    A denied comparison is the one with the inverse sign; only a range stays denied.

    Args:
        quantity: What is compared.
        unit: Unit of a number without one.
        bindings: Values of the wording's slots.
        numbers: Its numbers.
    """
    values = list(bindings.values())
    denied = DENIED in values
    unit = _unit(bindings) or unit
    if BETWEEN in values:
        low, high = number_text(numbers["t"]), number_text(numbers["u"])
        return f"{quantity} {low} - {high} {unit}", denied
    sign = next(value for value in values if value in INVERSE)
    first = bindings.get("fixed") or f"{number_text(numbers['t'])} {unit}"
    return f"{quantity} {INVERSE[sign] if denied else sign} {first}", False


def _unit(bindings: Bindings) -> str:
    """The unit that a wording names; '' where it names none."""
    return next((value for value in bindings.values() if value in UNITS), "")


def _stepped(number: float, step: float) -> float:
    return max(step, round(number / step) * step)
