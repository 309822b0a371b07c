"""Families that compare half, twice or three times an amount with a number, and a number with the limit."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tacgrasp.lessons.dialogue.conditions import check_of
from tacgrasp.lessons.dialogue.families.comparisons.felt import compare_family
from tacgrasp.lessons.dialogue.families.comparisons.thresholds import one_threshold, test_of
from tacgrasp.lessons.dialogue.families.comparisons.wordings import (
    MORE,
    measured_pattern,
    slots_of,
    thing_pattern,
)
from tacgrasp.lessons.dialogue.meaning import FACTS, Check
from tacgrasp.lessons.dialogue.patterns.family import (
    Bindings,
    Numbers,
    QuestionFamily,
    length_of,
    multiple_of,
)
from tacgrasp.lessons.dialogue.scene import AskedScene


def _multiple(name: str, quantity: str, noun: str, adverb: str, *units: str) -> QuestionFamily:
    """A family that compares a multiple of a quantity with a number.

    Args:
        name: Its name.
        quantity: Name of the quantity.
        noun: What is multiplied, with its article.
        adverb: What may stand after the number: 'deep'.
        units: Units, the usual one first.
    """

    def build(bindings: Bindings, numbers: Numbers) -> Check:
        test, denied = test_of(multiple_of(bindings, quantity), units[0], bindings, numbers)
        return check_of(test, denied=denied, length=length_of(bindings))

    def choose(
        scene: AskedScene, bindings: Bindings, rng: np.random.Generator
    ) -> Mapping[str, str]:
        truth = FACTS[multiple_of(bindings, quantity)]
        return one_threshold(truth, FACTS[quantity])(scene, bindings, rng)

    compared = f"({MORE}) [{adverb}]"
    return QuestionFamily(
        name=name,
        pattern=" | ".join(
            (
                measured_pattern("{times}"),
                thing_pattern(
                    f"(would|will|might|could) {{times}} [still|already|even] be {compared}|"
                    f"would {{times}} [still|already] (make|come to|amount to|give) {compared}|"
                    f"(if|suppose|imagine|when|supposing|assuming|say) ({noun}) (were|was|is|gets) "
                    f"{{changed}} , (would|will|is) (it|that) [still|already] [be] {compared}|"
                    f"(if|suppose|imagine|when|say|supposing) (we|you|I|the fingers) {{change}} "
                    f"({noun}) , (would|will|is) (it|that) [still|already] [be] {compared}|"
                    f"(would|will) it [still|already] be {compared} (if|when|after) (we|you|I) "
                    f"{{change}} ({noun})",
                    f"{{times}} (is|would be|would still be|makes) {compared}|"
                    f"({noun}) {{changed}} (is|would be) {compared}",
                    f"{{times}} , {compared}|{{times}} {compared}|({noun}) {{changed}} , {compared}",
                ),
            )
        ),
        build=build,
        slots={
            **slots_of(units, {}),
            "times": {
                "half": f"(half|one half of|half of) ({noun})",
                "twice": f"(twice|double|two times) ({noun})",
                "thrice": f"(three times|thrice|triple) ({noun})",
            },
            "changed": {
                "half": "(halved|cut in half|cut by half)",
                "twice": "(doubled|twice as (large|big|great|strong))",
                "thrice": "(tripled|three times as (large|big|great|strong))",
            },
            "change": {
                "half": "(halve|halved|cut in half)",
                "twice": "(double|doubled)",
                "thrice": "(triple|tripled)",
            },
        },
        choose=choose,
    )


_ALLOWED = (
    "(the [hard|force|agreed] limit|(we|I) may [ever] (use|apply|press|put on) [here|on {thing}]|"
    "[what] is (allowed|permitted|acceptable) [here]|the contract (allows|permits|tolerates)|"
    "[what] we are allowed|(we|you) may exert)"
)
_NUMBER_AND_LIMIT = (
    "(would|will|is|are|does) [a force of] {united} [be|mean|count as] {beyond}|"
    "would [a force of|a grip of|gripping with|pressing with|squeezing with] {united} [already|"
    "still] (be|lie|go|end up) {beyond}|"
    "(would|does|will) [a force of|a grip of] {united} [already] {break} (the|our) [hard|force] limit|"
    "is [a force of|a grip of] {united} [still|already] {beyond}"
)
_NUMBER_AND_LIMIT_SAID = (
    "[a force of|a grip of] {united} (is|would be) [still|already] {beyond}|"
    "[a force of] {united} would {break} (the|our) [hard|force] limit"
)
_LIMIT_SLOTS = {
    **slots_of(("N", "mN", "cN", "g"), {"1 N": "(one newton|a newton)", "0.5 N": "half a newton"}),
    "beyond": {
        "<": f"(more than|above|over|beyond|past|higher than|in excess of) {_ALLOWED}|too much for "
        "(the contract|the limit)|(forbidden|prohibited|not allowed)",
        ">=": "(within|below|under|no more than|at most|not above|not beyond) the [hard|force|agreed] "
        "limit|[still] (allowed|permitted|acceptable|legal)",
    },
    "break": {
        "<": "(break|exceed|violate|breach|overstep|go past|pass)",
        ">=": "(respect|keep|obey)",
    },
}

FAMILIES: tuple[QuestionFamily, ...] = (
    _multiple(
        "force_multiple_above",
        "force",
        "(the|our|this|that|the present) (force|grip force|squeeze|grip|pressure|hold|pinch)",
        "[of force]",
        *("N", "mN", "g", "cN"),
    ),
    _multiple(
        "depth_multiple_above",
        "depth",
        "(the|our|this|that|the present) ([contact] depth|indentation|dent|penetration)",
        "deep",
        *("mm", "µm"),
    ),
    _multiple(
        "holds_multiple_above",
        "holds",
        "(the|our|this) (payload|capacity|carrying capacity|holding capacity)|what (this grip|the "
        "grip|this hold) [surely] (holds|can hold|carries)",
        "[in weight]",
        "g",
    ),
    compare_family(
        "number_over_limit",
        "limit",
        "N",
        thing_pattern(_NUMBER_AND_LIMIT, _NUMBER_AND_LIMIT_SAID, "{united} , {beyond}"),
        _LIMIT_SLOTS,
    ),
)
