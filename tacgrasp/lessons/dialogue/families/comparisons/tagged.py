"""Families of denied comparisons with a question behind them: 'it does not exceed 2 N, does it?'.

They ask whether it does. Without that question a denied comparison asks whether it does not
(``tacgrasp.lessons.dialogue.families.comparisons.felt``).
"""

from __future__ import annotations

from tacgrasp.lessons.dialogue.families.comparisons.felt import compare_family
from tacgrasp.lessons.dialogue.families.comparisons.wordings import NOT_COMPARED, slots_of
from tacgrasp.lessons.dialogue.patterns.family import QuestionFamily
from tacgrasp.lessons.dialogue.patterns.pattern import Slots


def _tagged(name: str, quantity: str, nouns: str, thing: str, *units: str) -> QuestionFamily:
    """A family of denied statements with 'does it' or 'is it' behind them.

    Args:
        name: Its name.
        quantity: What is compared.
        nouns: What is measured, with its article.
        thing: What the thing does not do, before a number.
        units: Units, the usual one first.
    """
    slots: Slots = {**slots_of(units, {}), "beyond": {">": "(more than|over|beyond|past)"}}
    pattern = (
        f"{{lead}} [{{believe}}] ( ({nouns}) (does not|doesn't|did not|never) {{not_exceed}} "
        f"{{amount}} (, does it|, or does it|, did it) "
        f"| ({nouns}) (is not|isn't|is never|was not) {{now}} ({NOT_COMPARED}) (, is it|, or is it|"
        f", was it) "
        f"| {{thing}} (does not|doesn't) {thing} {{beyond}} {{amount}} (, does it|, or does it) "
        f"| (it is not|not) ({NOT_COMPARED}) , is it ) {{tail}}"
    )
    return compare_family(name, quantity, units[0], pattern, slots)


FAMILIES: tuple[QuestionFamily, ...] = (
    _tagged(
        "depth_tagged_above",
        "depth",
        "the [contact|press] depth|the (dent|indentation|penetration)|our depth",
        "(go in|sink in|press in|reach)",
        *("mm", "µm"),
    ),
    _tagged(
        "force_tagged_above",
        "force",
        "the [contact|grip|present] force|the (grip|squeeze|load|pressure)|our (grip|force)",
        "(press with|push with|get|take)",
        *("N", "mN", "g", "cN"),
    ),
    _tagged(
        "area_tagged_above",
        "area",
        "the [contact] area|the (footprint|patch|coverage|imprint)",
        "(cover|touch|take up)",
        "%",
    ),
)
