"""Family that asks for the force that a mass needs: 'how much force do I need for 25 g'.

Not here: the least force of the contract (``tacgrasp.lessons.dialogue.families.amounts.agreed``), which
is asked for without a mass; whether the felt force holds it (``lifting``).
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tacgrasp.lessons.dialogue.conditions import number_text
from tacgrasp.lessons.dialogue.families.amounts.wordings import (
    UNIT_WORDS,
    AmountWording,
    Asked,
    amount_slots,
    number_pattern,
)
from tacgrasp.lessons.dialogue.meaning import Amount
from tacgrasp.lessons.dialogue.patterns.family import (
    Bindings,
    Numbers,
    QuestionFamily,
    length_of,
)
from tacgrasp.lessons.dialogue.scene import AskedScene

_TO_HOLD = "(for|to (hold|lift|carry|pick up|support|bear))"
_LEAST = "(least|minimum|minimal|smallest|lowest|required|needed|necessary|right)"
_NEEDED = AmountWording(
    asked=(
        Asked(
            "(how much (force|grip force|grip|squeeze)|what force|which force|what grip force)",
            f"(do|would|will|must|should) (we|I|you|the fingers) (need|use|apply|require) {_TO_HOLD} {{load}}|"
            f"is (needed|required|necessary|enough) {_TO_HOLD} {{load}}|(does|would) {{load}} (need|require|take)|"
            "[surely|safely|certainly] (holds|would hold|will hold|carries) {load}|does it take to (hold|lift|carry) {load}",
            f"(we|I|you) (need|must use|should apply) {_TO_HOLD} {{load}}|is (needed|required|necessary) {_TO_HOLD} "
            "{load}|{load} (needs|requires|takes)|it takes to (hold|lift) {load}",
        ),
        Asked(
            "what",
            f"is the {_LEAST} [grip] force [(I|we) need|that is needed] {_TO_HOLD} {{load}}|is the {_LEAST} [grip] force that "
            "(holds|carries|would hold) {load}",
            f"the {_LEAST} [grip] force {_TO_HOLD} {{load}} is",
        ),
        Asked(
            "how (hard|firmly|tightly|strongly)",
            f"(must|should|do) (we|I|the fingers) [have to|need to] (grip|squeeze|hold|press|pinch) [it] {_TO_HOLD} "
            "{load}|would (we|I) have to (grip|squeeze|hold) {load}",
            f"(we|I) (must|should|have to) (grip|squeeze|hold|press) [it] {_TO_HOLD} {{load}}",
        ),
    ),
    counted=(
        Asked(
            "how many {unit}",
            f"(do|would|must) (we|I|you) (need|use|apply) {_TO_HOLD} {{load}}|(are|is) (needed|required|necessary) "
            f"{_TO_HOLD} {{load}}|does {{load}} (need|take|require)",
            f"(we|I) need {_TO_HOLD} {{load}}|are needed {_TO_HOLD} {{load}}",
        ),
    ),
    nouns=(
        f"the {_LEAST} [grip] force {_TO_HOLD} {{load}}|the force [that is|(we|I) would|] (needed|required|need|necessary) "
        f"{_TO_HOLD} {{load}}|the force {{load}} (needs|requires|takes)"
    ),
    bare=f"force (needed|required) {_TO_HOLD} {{load}}|(needed|required|minimum) force {_TO_HOLD} {{load}}",
    terse="{unit} (needed|required) for {load}",
)


def _build(bindings: Bindings, numbers: Numbers) -> Amount:
    of = f"{number_text(numbers['m'])} {bindings['mass_unit']}" if "m" in numbers else ""
    unit = bindings.get("unit", "N")
    return Amount(quantity="needed", unit=unit, of=of, length=length_of(bindings))


def _choose(_: AskedScene, bindings: Bindings, rng: np.random.Generator) -> Mapping[str, str]:
    grams = 5 * int(rng.integers(1, 80))
    return {"m": number_text(grams / 1000) if bindings.get("mass_unit") == "kg" else str(grams)}


FAMILIES: tuple[QuestionFamily, ...] = (
    QuestionFamily(
        name="needed",
        pattern=number_pattern(_NEEDED, is_unit_needed=False),
        build=_build,
        slots={
            **amount_slots({unit: UNIT_WORDS[unit] for unit in ("N", "mN")}),
            "load": (
                "({#m} {mass_unit}|{#m} {mass_unit}|(a|an|the|this) {#m} {mass_unit} ({*objects}|load|thing|object|part)|"
                "(a|an) (load|weight|mass|{*objects}) of {#m} {mass_unit}|(this|its|the given|the stated|the known) "
                "(weight|mass)|(a thing|something) of {#m} {mass_unit}|(it|{thing}) if it weighs {#m} {mass_unit}|(it|{thing}) at (its|this) weight)"
            ),
            "mass_unit": {"g": "(g|g|grams|gram)", "kg": "(kg|kilograms|kilos|kilo)"},
        },
        choose=_choose,
    ),
)
