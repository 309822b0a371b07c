"""The meaning of a question that calculates with what is felt and given."""

from __future__ import annotations

from tacgrasp.lessons.dialogue.calculations.amounts import calculated_amount
from tacgrasp.lessons.dialogue.calculations.asked import AskedWords, asked_words
from tacgrasp.lessons.dialogue.calculations.borders import border_check, nearest_border
from tacgrasp.lessons.dialogue.calculations.checks import calculated_check
from tacgrasp.lessons.dialogue.calculations.choices import calculated_choice
from tacgrasp.lessons.dialogue.calculations.footprints import pressure_check
from tacgrasp.lessons.dialogue.calculations.loads import needs_more, suffices
from tacgrasp.lessons.dialogue.calculations.suppositions import supposed, supposes
from tacgrasp.lessons.dialogue.calculations.terms import Term
from tacgrasp.lessons.dialogue.expression import Expression
from tacgrasp.lessons.dialogue.meaning import Calculated


def calculated(question: str) -> Calculated | None:
    """What a question asks to calculate; None where it asks for nothing of the kind."""
    return _calculated(asked_words(question))


def calculated_about(asked: AskedWords, subject: Term) -> Calculated | None:
    """What a question asks to calculate of what its pronouns stand for; None likewise."""
    return _calculated(asked.about(subject, asked.words))


def _calculated(asked: AskedWords) -> Calculated | None:
    if (meaning := supposed(asked)) or supposes(asked):
        return meaning if meaning and _is_sound(meaning.truth) else None
    for reader in (
        needs_more, suffices, nearest_border, calculated_choice, calculated_amount, border_check,
        pressure_check, calculated_check,
    ):  # fmt: skip
        if (meaning := reader(asked)) and _is_sound(meaning.truth):
            return meaning
    return None


def _is_sound(truth: str) -> bool:
    """Whether an expression may be evaluated: not too long, nor without a quantity."""
    try:
        return bool(Expression(truth).names)
    except ValueError:
        return False
