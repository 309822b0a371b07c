"""Families that compare a number with a threshold, affirmed or denied."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from tacgrasp.lessons.dialogue.conditions import check_of
from tacgrasp.lessons.dialogue.families.family import Bindings, Numbers, QuestionFamily, length_of
from tacgrasp.lessons.dialogue.families.phrases import check_pattern, denied_pattern
from tacgrasp.lessons.dialogue.families.thresholds import (
    COMPARISONS,
    UNDENIED,
    UNITS,
    one_threshold,
    test_of,
)
from tacgrasp.lessons.dialogue.meaning import Check
from tacgrasp.lessons.dialogue.pattern import Slots
from tacgrasp.lessons.dialogue.scene import AskedScene

_TRUTHS: Mapping[str, tuple[str, str]] = {
    "depth": ("depth_mm", "mm"),
    "force": ("force_n", "N"),
    "area": ("area_percent", "%"),
    "distance": ("hypot(x_mm, y_mm)", "mm"),
}
"""Expression of each quantity that is compared, and its unit."""


def _units(*symbols: str) -> dict[str, str]:
    return {symbol: UNITS[symbol] for symbol in symbols}


def _slots(units: Mapping[str, str], fixed: Mapping[str, str]) -> Slots:
    return {
        "comparison": COMPARISONS,
        "unit": dict(units),
        "fixed": dict(fixed),
        "amount": "({#t} {unit}|{#t} {unit}|{fixed})" if fixed else "{#t} {unit}",
        "between": {
            "between": "(between {#t} and {#u} {unit}|from {#t} to {#u} {unit}|"
            "in the range {#t} to {#u} {unit}|somewhere between {#t} and {#u} {unit})"
        },
    }


def _build(quantity: str, unit: str, *, denied: bool) -> Callable[[Bindings, Numbers], Check]:
    def build(bindings: Bindings, numbers: Numbers) -> Check:
        named = dict(bindings)
        for word in ("between", "deeper", "shallower"):
            if word in bindings:
                named["comparison"] = bindings[word]
        test = test_of(quantity, unit, named, numbers)
        return check_of(test, denied=denied, length=length_of(bindings))

    return build


_FIXED_LENGTHS = {
    "0.5": "(half a millimetre|half a mm)",
    "1": "(one millimetre|one mm|a millimetre)",
    "0.1": "(a tenth of a millimetre|one tenth of a millimetre)",
    "0.25": "(a quarter of a millimetre|a quarter mm)",
    "0.2": "(a fifth of a millimetre|two tenths of a millimetre)",
    "0.3": "three tenths of a millimetre",
}
_FIXED_FORCES = {
    "0.5": "half a newton",
    "1": "(one newton|a newton|a single newton)",
    "2": "two newtons",
    "3": "three newtons",
    "4": "four newtons",
    "5": "five newtons",
    "1.5": "one and a half newtons",
    "2.5": "two and a half newtons",
}
_FIXED_AREAS = {
    "50": "half of the (pad|gel|sensor)",
    "25": "a quarter of the (pad|gel|sensor)",
    "10": "(a tenth|ten percent) of the (pad|gel|sensor)",
    "5": "five percent of the (pad|gel|sensor)",
    "20": "(a fifth|twenty percent) of the (pad|gel|sensor)",
    "33.3": "a third of the (pad|gel|sensor)",
}
_FIXED_DISTANCES = {
    "1": "(one|a) millimetre",
    "2": "two millimetres",
    "3": "three millimetres",
    "5": "five millimetres",
    "0.5": "half a millimetre",
}

_DEPTH_SLOTS: Slots = {
    **_slots(_units("mm", "µm"), _FIXED_LENGTHS),
    "deeper": {">": "deeper than"},
    "shallower": {"<": "shallower than"},
}
_FORCE_SLOTS = _slots(_units("N", "mN", "g"), _FIXED_FORCES)
_AREA_SLOTS = _slots(_units("%", "mm²"), _FIXED_AREAS)
_DISTANCE_SLOTS = _slots(_units("mm"), _FIXED_DISTANCES)

_COMPARED = "{comparison} {amount}|{between}"
_DEPTH_SUBJECT = (
    "the [contact|press|indentation|present] depth|the indentation|the dent|"
    "the depth of ({touch}|{body})"
)
_DEEP_SUBJECT = "{touch}|{body}|the dent|the object"
_DEEP = (
    "({deeper}|{shallower}) {amount}|pressed in by {comparison} {amount}|{comparison} {amount} deep"
)
_FORCE_SUBJECT = (
    "the [contact|normal|grip|gripping|felt|present] force|the load on the pad|the squeeze|"
    "the (force|load|pressure) (of|from|on) {body}|the grip|the force between the fingers"
)
_AREA_SUBJECT = (
    "the [contact|touched|covered] area|the footprint|the contact patch|the area of {touch}|"
    "the imprint of {body}|the part in contact"
)
_DISTANCE_SUBJECT = "{thing}|{touch}"
_DISTANCE_PREDICATE = (
    "{comparison} {amount} (from|away from|off) the (center|middle)|"
    "{comparison} {amount} off center"
)


def _compare(
    name: str, quantity: str, pattern: str, slots: Slots, *, denied: bool = False
) -> QuestionFamily:
    truth, unit = _TRUTHS[quantity]
    return QuestionFamily(
        name=name,
        pattern=pattern,
        build=_build(quantity, unit, denied=denied),
        slots=slots,
        choose=_chooser(truth),
    )


def _chooser(
    truth: str,
) -> Callable[[AskedScene, Bindings, np.random.Generator], Mapping[str, str]]:
    draw = one_threshold(truth)

    def choose(
        scene: AskedScene, bindings: Bindings, rng: np.random.Generator
    ) -> Mapping[str, str]:
        return draw(scene, bindings, rng) if "unit" in bindings else {}

    return choose


FAMILIES: tuple[QuestionFamily, ...] = (
    _compare(
        "depth_above",
        "depth",
        check_pattern(
            _DEPTH_SUBJECT,
            _COMPARED,
            "does {thing} (sink|go|reach|press) {comparison} {amount} (in|deep|into the gel)|"
            "has {thing} sunk in by {comparison} {amount}|do you measure {comparison} {amount} "
            "of (depth|indentation)|did we press {thing} {comparison} {amount} deep",
        ),
        _DEPTH_SLOTS,
    ),
    _compare(
        "deeper_than",
        "depth",
        check_pattern(_DEEP_SUBJECT, _DEEP),
        _DEPTH_SLOTS,
    ),
    _compare(
        "force_above",
        "force",
        check_pattern(
            _FORCE_SUBJECT,
            _COMPARED,
            "do (we|you|the fingers|I) (press|hold|grip|squeeze) {thing} with {comparison} {amount}|"
            "does {thing} press with {comparison} {amount}|do you (feel|measure|read) "
            "{comparison} {amount}|is there a force of {comparison} {amount} [on {thing}]|"
            "is {thing} (held|pressed|squeezed|gripped) with {comparison} {amount}|"
            "are there {comparison} {amount} on {thing}",
        ),
        _FORCE_SLOTS,
    ),
    _compare(
        "area_above",
        "area",
        check_pattern(
            _AREA_SUBJECT,
            _COMPARED,
            "does {thing} (cover|touch|fill|occupy) {comparison} {amount}|"
            "is {comparison} {amount} (covered|touched|in contact)|"
            "are {comparison} {amount} of the pad covered [by {thing}]",
        ),
        _AREA_SLOTS,
    ),
    _compare(
        "distance_above",
        "distance",
        check_pattern(
            _DISTANCE_SUBJECT,
            _DISTANCE_PREDICATE,
            "did we miss the (center|middle) by {comparison} {amount}|"
            "does {thing} lie {comparison} {amount} from the (center|middle)",
        ),
        _DISTANCE_SLOTS,
    ),
    _compare(
        "not_deep",
        "depth",
        denied_pattern(f"{_DEPTH_SUBJECT}", _COMPARED),
        {**_DEPTH_SLOTS, "comparison": UNDENIED},
        denied=True,
    ),
    _compare(
        "not_force",
        "force",
        denied_pattern(_FORCE_SUBJECT, _COMPARED),
        {**_FORCE_SLOTS, "comparison": UNDENIED},
        denied=True,
    ),
    _compare(
        "not_area",
        "area",
        denied_pattern(_AREA_SUBJECT, _COMPARED),
        {**_AREA_SLOTS, "comparison": UNDENIED},
        denied=True,
    ),
)
