"""Families that ask by how much an amount is more than a number: 'how much deeper than 0.1 mm'."""

from __future__ import annotations

from tacgrasp.lessons.dialogue.conditions import taken
from tacgrasp.lessons.dialogue.families.comparisons.thresholds import UNITS, one_threshold
from tacgrasp.lessons.dialogue.meaning import FACTS, Amount
from tacgrasp.lessons.dialogue.patterns.family import (
    Bindings,
    Numbers,
    QuestionFamily,
    length_of,
)

_SIGNED = (
    "[, (count|with|take) (a|any) (shallower one|smaller one|weaker one|lower one|less|shortfall) as "
    "(negative|minus|a minus)|, (negative|minus|below zero|with a minus) (if|when|where) (it is [less|"
    "below]|less|below|smaller|shallower|weaker|it is not)|, signed|, with [its|the] sign|, plus or "
    "minus|, minus if below]"
)
_IN = "[in {unit2}|, in {unit2}|, {unit2}|, {unit2} please]"


def _difference(
    name: str, quantity: str, nouns: str, more: str, does: str, *units: str
) -> QuestionFamily:
    """A family that asks by how much a quantity is more than a number of the question.

    Args:
        name: Its name.
        quantity: Name of the quantity.
        nouns: What is measured, with its article.
        more: Adjectives before 'than'.
        does: What the thing does so much more: 'does it go'.
        units: Units, the usual one first.
    """

    def build(bindings: Bindings, numbers: Numbers) -> Amount:
        unit = bindings["unit"]
        return Amount(
            quantity=quantity,
            unit=unit,
            less=taken(quantity, numbers["t"], unit),
            length=length_of(bindings),
        )

    words = {unit: UNITS[unit] for unit in units}
    amount = "{#t} {unit}"
    return QuestionFamily(
        name=name,
        pattern=(
            f"{{lead}} ( (how much|by how much|how many {{unit2}}) ({more}) than {amount} ({does}) "
            f"{_SIGNED} {_IN} "
            f"| (how much|how far|by how much) (is|are|was) ({nouns}) (above|over|beyond|past|more than|off|"
            f"away from) {amount} {_SIGNED} {_IN} "
            f"| (by how much|how far|how much) (does|do|did) ({nouns}) (exceed|pass|top|go beyond|surpass|"
            f"differ from) {amount} {_SIGNED} {_IN} "
            f"| {{ask}} (by how much|how far|how much) ({nouns}) (exceeds|is above|is over|is beyond|"
            f"differs from|passes|is more than) {amount} {_SIGNED} {_IN} "
            f"| [{{want}}] the (difference|gap|distance) (between ({nouns}) and|of ({nouns}) (from|to|"
            f"against)) {amount} {_SIGNED} {_IN} "
            f"| [what is|what would be|give me|tell me] ({nouns}) (minus|less) {amount} {_SIGNED} {_IN} "
            f"| (take|subtract) {amount} from ({nouns}) [:|, what (is left|remains|do you get)] {_IN} "
            f"| (what is left|how much is left|what remains) of ({nouns}) (after|beyond|past|over) {amount} "
            f"{_SIGNED} {_IN} "
            f"| (with respect to|relative to|compared with|compared to|against|measured against) {amount} , "
            f"(how much ({more})|how far (above|over|off)|what is the difference) (is|are|of) ({nouns}) "
            f"{_SIGNED} {_IN} "
            f"| how much ({more}) than {amount} {_SIGNED} {_IN} "
            f"| ({nouns}) (versus|vs|against|compared with) {amount} , (the difference|by how much|"
            f"difference) {_SIGNED} {_IN} "
            f") {{tail}} [, {{length}}]"
        ),
        build=build,
        slots={"unit": words, "unit2": f"({'|'.join(words.values())})"},
        choose=one_threshold(FACTS[quantity]),
    )


FAMILIES: tuple[QuestionFamily, ...] = (
    _difference(
        "depth_difference",
        "depth",
        "(the|our|its|this) ([contact|press] depth|indentation|dent|penetration)|the depth of {touch}",
        "deeper|further in|farther in|more deeply",
        "(does (it|{thing}) (go|sink|press|reach|get)|is (it|{thing}|{touch}) [pressed in]|are we [in]|did we press)",
        *("mm", "µm"),
    ),
    _difference(
        "force_difference",
        "force",
        "(the|our|its|this) ([grip|contact|normal|felt] force|grip|squeeze|load|pressure)|the force on {thing}",
        "harder|stronger|more|firmer|tighter|higher",
        "(do we (press|squeeze|grip|hold)|are we (pressing|squeezing|gripping)|is (it|the (grip|force)|"
        "{thing}) [held|pressed]|is there)",
        *("N", "mN", "g", "cN"),
    ),
)
