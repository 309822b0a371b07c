"""Families that compare depth or force with a number and its tolerance: '1.2 N give or take 0.1'.

'About 1.2 N' names none (``tacgrasp.lessons.dialogue.conditions.ABOUT``).
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tacgrasp.lessons.dialogue.conditions import check_of, number_text
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.families.comparisons.thresholds import (
    SCALES,
    UNITS,
    one_threshold,
)
from tacgrasp.lessons.dialogue.meaning import FACTS, Check
from tacgrasp.lessons.dialogue.patterns.family import (
    Bindings,
    Numbers,
    QuestionFamily,
    length_of,
)
from tacgrasp.lessons.dialogue.scene import AskedScene

_SIGN = "(±|+-|+/-|plus or minus|plus minus|give or take|plus/minus)"
_NEAR = (
    f"({{#t}} {{unit}} {_SIGN} {{#u}}|{{#t}} {_SIGN} {{#u}} {{unit}}|"
    "within {#u} of {#t} {unit}|{#t} {unit} with a tolerance of {#u}|"
    "{#t} {unit} to within {#u}|no (further|more) than {#u} (off|away from) {#t} {unit}|"
    "{#t} {unit} , tolerance {#u}|{#t} {unit} with {#u} (tolerance|play|leeway|slack)|"
    "{#t} {unit} with {#u} of (play|leeway|slack))"
)


def _near_family(name: str, quantity: str, nouns: str, *units: str) -> QuestionFamily:
    """A family that asks whether a quantity is a number within a tolerance of the same unit."""
    truth = FACTS[quantity]

    def build(bindings: Bindings, numbers: Numbers) -> Check:
        middle, away = (number_text(numbers[number]) for number in "tu")
        test = f"{quantity} {middle} +- {away} {bindings['unit']}"
        return check_of(test, length=length_of(bindings))

    def choose(
        scene: AskedScene, bindings: Bindings, rng: np.random.Generator
    ) -> Mapping[str, str]:
        scale = SCALES[truth][bindings["unit"]]
        value = Expression(truth).evaluate(scene.values()).value
        felt = value if isinstance(value, float) and value > 0 else 0.5
        middle = felt / scale.size * float(np.exp(rng.uniform(-0.4, 0.4)))
        away = middle * float(rng.uniform(0.05, 0.3))
        steps = [max(1, round(number / scale.step)) * scale.step for number in (middle, away)]
        return dict(zip("tu", map(number_text, steps), strict=True))

    return QuestionFamily(
        name=name,
        pattern=(
            f"{{lead}} ( (is|is|was|isn't) ({nouns}) [really|still|now] {_NEAR} "
            f"| {{whether}} ({nouns}) is {_NEAR} | [{{believe}}] ({nouns}) is {_NEAR} [{{tag}}] "
            f"| ({nouns}) {_NEAR} [, yes or no|, right|, true or false|, correct] "
            f"| (does|did) ({nouns}) (come to|amount to|measure) {_NEAR} ) {{tail}} [, {{length}}]"
        ),
        build=build,
        slots={"unit": {unit: UNITS[unit] for unit in units}},
        choose=choose,
    )


_ABOUT = (
    "((about|around|roughly|approximately|some|near|close to|nearly|more or less|pretty much|circa|"
    "in the region of|in the neighbourhood of|something like) {#t} {unit}|"
    "{#t} {unit} (or thereabouts|or so|more or less|roughly|approximately|give or take)|"
    "(about|around|roughly|approximately|near|close to) {half}|"
    "[exactly|precisely|just|equal to] {#t} {unit} {deep})"
)


def _about_family(
    name: str, quantity: str, nouns: str, half: str, deep: str, *units: str
) -> QuestionFamily:
    """A family that asks whether a quantity is about a number, or about half (a unit) of the first.

    'Is it 0.3 mm deep?' asks so too: no measured number is another one to the last digit.
    """

    def build(bindings: Bindings, numbers: Numbers) -> Check:
        middle, unit = numbers.get("t", 0.5), bindings.get("unit", units[0])
        test = f"{quantity} about {number_text(middle)} {unit}"
        return check_of(test, length=length_of(bindings))

    draw = one_threshold(FACTS[quantity])
    return QuestionFamily(
        name=name,
        pattern=(
            f"{{lead}} ( (is|was|isn't) ({nouns}) [now|still|really] {_ABOUT} "
            f"| {{whether}} ({nouns}) is {_ABOUT} | [{{believe}}] ({nouns}) is {_ABOUT} [{{tag}}] "
            f"| ({nouns}) {_ABOUT} [, yes or no|, right|, true or false|, correct] "
            f"| (does|did) ({nouns}) (come to|amount to|measure) {_ABOUT} "
            f"| are we [now|still] at {_ABOUT} ) [now|right now|at the moment|please] [, {{length}}]"
        ),
        build=build,
        slots={"unit": {unit: UNITS[unit] for unit in units}, "half": half, "deep": deep},
        choose=lambda scene, bindings, rng: (
            draw(scene, bindings, rng) if "unit" in bindings else {}
        ),
    )


FAMILIES: tuple[QuestionFamily, ...] = (
    _about_family(
        "force_about",
        "force",
        "it|that|the [contact|grip|normal|present] force|our (grip|force)|the (grip|squeeze|load)|"
        "the force on {thing}",
        "half a (newton|N)",
        "[of force]",
        *("N", "mN"),
    ),
    _about_family(
        "force_about_grams",
        "force",
        "the [contact|grip|normal|present] force|our (grip|force)|the (grip|squeeze|load)|"
        "the force on {thing}",
        "{#t} {unit}",
        "of force",
        *("g",),
    ),
    _about_family(
        "depth_about",
        "depth",
        "it|that|the [contact|press|present] depth|the (indentation|dent|penetration)|"
        "the depth of {touch}",
        "half a (millimetre|mm)",
        "[deep|of depth]",
        *("mm", "µm"),
    ),
    _near_family(
        "force_near",
        "force",
        "the [contact|grip|normal|present] force|our (grip|force)|the (grip|squeeze|load)|"
        "the force on {thing}",
        *("N", "mN", "g"),
    ),
    _near_family(
        "depth_near",
        "depth",
        "the [contact|press|present] depth|the (indentation|dent|penetration)|the depth of {touch}",
        *("mm", "µm"),
    ),
)
