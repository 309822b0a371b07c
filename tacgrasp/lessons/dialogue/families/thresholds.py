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
from tacgrasp.lessons.dialogue.families.family import Bindings, Numbers
from tacgrasp.lessons.dialogue.quantities import GRAVITY_N_PER_G
from tacgrasp.lessons.dialogue.scene import AskedScene

COMPARISONS: dict[str, str] = {
    ">": (
        "(more than|over|above|beyond|greater than|higher than|larger than|in excess of|"
        "bigger than|upwards of|past|exceeding)"
    ),
    "<": (
        "(less than|under|below|smaller than|lower than|short of|beneath|not even|inferior to|"
        "fewer than)"
    ),
    ">=": "(at least|no less than|not less than|not below|a minimum of|not under)",
    "<=": "(at most|no more than|not more than|not above|not over|a maximum of|up to)",
}
"""Comparisons by their sign."""

UNDENIED = {sign: COMPARISONS[sign].replace("not even|", "") for sign in "<>"}
"""Comparisons that 'not' may stand before."""

UNITS: dict[str, str] = {
    "mm": "(mm|millimetres|millimetre)",
    "µm": "(µm|microns|micrometres)",
    "N": "(N|newtons|newton)",
    "mN": "(mN|millinewtons)",
    "g": "(g|grams|gram)",
    "%": "(%|percent|per cent)",
    "mm²": "(mm²|mm2|square millimetres)",
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


SCALES: Mapping[str, Mapping[str, Scale]] = {
    "depth_mm": {
        "mm": Scale(size=1.0, step=0.01, low=0.05, high=1.2),
        "µm": Scale(size=1e-3, step=10, low=50, high=1200),
    },
    "force_n": {
        "N": Scale(size=1.0, step=0.05, low=0.1, high=8.0),
        "mN": Scale(size=1e-3, step=50, low=100, high=8000),
        "g": Scale(size=GRAVITY_N_PER_G, step=5, low=10, high=800),
    },
    "area_percent": {
        "%": Scale(size=1.0, step=1, low=2, high=50),
        "mm²": Scale(size=0.32409, step=1, low=5, high=150),
    },
    "hypot(x_mm, y_mm)": {"mm": Scale(size=1.0, step=0.5, low=0.5, high=9.0)},
}
"""Scales by expression and unit. mm² are those of a GelSight Mini, whose 1 % is 3.09 mm²."""


def one_threshold(
    truth: str,
) -> Callable[[AskedScene, Bindings, np.random.Generator], dict[str, str]]:
    """Chooser of the number ``t``, and of a second, greater one ``u``, around an expression."""
    expression = Expression(truth)

    def choose(scene: AskedScene, bindings: Bindings, rng: np.random.Generator) -> dict[str, str]:
        scale = SCALES[truth][bindings["unit"]]
        value = expression.evaluate(scene.values()).value
        known = isinstance(value, float) and value > 0
        middle = (
            float(value or 0.0) / scale.size
            if known
            else float(np.exp(rng.uniform(math.log(scale.low), math.log(scale.high))))
        )
        away = float(np.exp(rng.choice([-1, 1]) * rng.uniform(0.1, 0.9)))
        first = _stepped(middle * away, scale.step)
        second = _stepped(first * float(np.exp(rng.uniform(0.3, 1.2))) + scale.step, scale.step)
        return {"t": number_text(first), "u": number_text(second)}

    return choose


def test_of(quantity: str, unit: str, bindings: Bindings, numbers: Numbers) -> str:
    """The comparison that a wording makes, in the words of a query.

    Args:
        quantity: What is compared.
        unit: Unit of a number that is fixed in the wording, as 'half a newton' is.
        bindings: Values of the wording's slots.
        numbers: Its numbers.
    """
    unit = bindings.get("unit", unit)
    first = bindings.get("fixed") or number_text(numbers["t"])
    if bindings["comparison"] == "between":
        return f"{quantity} {first} - {number_text(numbers['u'])} {unit}"
    return f"{quantity} {bindings['comparison']} {first} {unit}"


def _stepped(number: float, step: float) -> float:
    return max(step, round(number / step) * step)
