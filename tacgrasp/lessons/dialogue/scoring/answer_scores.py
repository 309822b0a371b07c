"""Whether an answer is right: its reading against the truth of the question in a scene.

Not here: asking (``tacgrasp.training.question_evaluation``).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from tacgrasp.lessons.dialogue.expression import Expression, TruthValue
from tacgrasp.lessons.dialogue.facts import UNTOUCHED_NAMES
from tacgrasp.lessons.dialogue.meaning import AnswerKind
from tacgrasp.lessons.dialogue.quantities import GRAVITY_N_PER_G, UNITS
from tacgrasp.lessons.dialogue.scene import NAMES, AskedScene
from tacgrasp.lessons.dialogue.scoring.answer_reading import AnswerReading, Measured, read_answer
from tacgrasp.lessons.dialogue.scoring.question_file import UNDECIDABLE, QuestionRow
from tacgrasp.lessons.dialogue.scoring.tolerances import EXACT
from tacgrasp.lessons.dialogue.scoring.truth_units import (
    dimension_of,
    is_count,
    is_multiple_in,
    scale_of,
)

_WEIGHTS = tuple(UNITS[name].size for name in ("kgf", "lbf", "ozf"))
"""Sizes of the units of force that are named after a mass."""

VERDICTS = ("contact", "cut")
"""Names whose value is yes or no."""


@dataclass(frozen=True, slots=True, kw_only=True)
class AnswerScore:
    """An answer against its truth.

    Attributes:
        decidable: Whether touch and what was given decide the question in this scene.
        is_close: Whether the scene is too near to the threshold to count.
        right: Whether the answer is right; for an undecidable question, whether it says so.
        right_kind: Whether it is an answer of the right kind.
    """

    decidable: bool
    is_close: bool
    right: bool
    right_kind: bool


def score_answer(text: str, row: QuestionRow, scene: AskedScene) -> AnswerScore:
    """Compare an answer with the truth of a question in a scene.

    Where nothing touches, saying so answers every question about the contact. Where a name of the
    truth has no value, the right answer says that it can't be told.

    Raises:
        ValueError: The truth can't be evaluated.
    """
    reading = read_answer(text)
    if row.kind in UNDECIDABLE:
        as_such = reading.is_unknown or reading.is_off_topic
        is_kind = reading.is_unknown if row.kind is AnswerKind.UNKNOWABLE else reading.is_off_topic
        return AnswerScore(
            decidable=False, is_close=False, right=as_such, right_kind=as_such and is_kind
        )
    values = scene.values()
    truths = [truth.evaluate(values) for truth in row.truths]
    untouched = not scene.state.in_contact and not set(row.names) <= UNTOUCHED_NAMES
    if untouched and reading.is_nothing and not reading.is_unknown:
        return AnswerScore(decidable=True, is_close=False, right=True, right_kind=True)
    if any(truth.value is None for truth in truths):
        says_so = reading.is_unknown and not untouched
        return AnswerScore(decidable=untouched, is_close=False, right=says_so, right_kind=says_so)
    if reading.is_unknown or reading.is_off_topic:
        return AnswerScore(
            decidable=True, is_close=_is_close(row, truths), right=False, right_kind=False
        )
    return AnswerScore(
        decidable=True,
        is_close=_is_close(row, truths),
        right=_is_right(reading, row, truths, scene),
        right_kind=_is_of_kind(reading, row),
    )


def _is_close(row: QuestionRow, truths: Sequence[TruthValue]) -> bool:
    is_tolerant = row.kind is AnswerKind.YES_NO and row.tolerance is not None
    return is_tolerant and any(
        row.tolerance is not None and truth.margin < row.tolerance.of(1.0) for truth in truths
    )


def _is_of_kind(reading: AnswerReading, row: QuestionRow) -> bool:
    """Whether an answer is of the row's kind, right or not."""
    if row.kind is AnswerKind.YES_NO:
        return reading.is_yes is not None
    if row.kind is AnswerKind.NUMBER:
        wanted = dimension_of(row.truths[0])
        is_counted = is_count(row.truths[0]) and _is_bare(reading)
        is_given = is_counted or bool(_converted(reading.numbers, wanted, None))
        return reading.is_yes is None and is_given
    return all(_says_something(reading, truth) for truth in row.truths)


def _is_bare(reading: AnswerReading) -> bool:
    """Whether all numbers of an answer stand without a unit."""
    return bool(reading.numbers) and not any(number.dimension for number in reading.numbers)


def _says_something(reading: AnswerReading, truth: Expression) -> bool:
    if reading.words(truth.text, truth.choices):
        return True
    dimension = dimension_of(truth)
    if truth.text in NAMES and truth.text not in VERDICTS:
        return bool(dimension) and bool(_converted(reading.numbers, dimension, None))
    is_number = bool(dimension) and bool(_converted(reading.numbers, dimension, None))
    return is_number or bool(reading.verdicts) or reading.is_yes is not None


def _is_right(
    reading: AnswerReading, row: QuestionRow, truths: Sequence[TruthValue], scene: AskedScene
) -> bool:
    if row.kind is AnswerKind.YES_NO:
        return reading.is_yes == bool(truths[0].value)
    if row.kind is AnswerKind.NUMBER:
        truth = row.truths[0]
        if not truth.names:  # a number that the question itself tells
            return _is_told(reading, row, truths[0])
        wanted = "" if is_count(truth) and _is_bare(reading) else dimension_of(truth)
        measured = _converted(reading.numbers, wanted or "ratio", scene)
        is_alone = len(measured) == len(reading.numbers) and bool(measured)
        values = [number.value for number in measured]
        is_one = is_alone and max(values) - min(values) <= 1e-6 + 1e-3 * abs(values[0])
        return is_one and _is_near(measured[0], row, truth, truths[0])
    return _has_all(reading, row, truths, scene)


def _is_told(reading: AnswerReading, row: QuestionRow, truth: TruthValue) -> bool:
    """Whether the only number of an answer is a constant truth, in the unit that is said."""
    if len(reading.numbers) != 1:
        return False
    said, true = reading.numbers[0], float(truth.value or 0.0)
    tolerance = (row.tolerance or EXACT).of(true)
    return any(abs(value - true) <= tolerance for value in (said.value, said.value / said.size))


def _has_all(
    reading: AnswerReading, row: QuestionRow, truths: Sequence[TruthValue], scene: AskedScene
) -> bool:
    """Whether words, verdicts and numbers of a text are those of the truths, in their order."""
    verdicts = list(reading.verdicts)
    numbers: dict[str, list[Measured]] = {}
    wanted: dict[str, int] = {}
    asks_mass = any(dimension_of(truth) == "mass" for truth in row.truths)
    for expression, truth in zip(row.truths, truths, strict=True):
        if isinstance(truth.value, str):
            if reading.words(expression.text, expression.choices) != [truth.value]:
                return False
        elif isinstance(truth.value, bool):
            if not verdicts or verdicts.pop(0) != truth.value:
                return False
        else:
            dimension = dimension_of(expression)
            # grams are a force only where no mass is asked for too
            is_mass = asks_mass and dimension != "mass"
            said = [each for each in reading.numbers if not (is_mass and each.dimension == "mass")]
            found = numbers.setdefault(dimension, _converted(said, dimension, scene))
            place = wanted.get(dimension, 0)
            wanted[dimension] = place + 1
            if place >= len(found) or not _is_near(found[place], row, expression, truth):
                return False
    is_bare = all(isinstance(truth.value, str) for truth in truths)
    return is_bare or all(len(numbers[dimension]) == count for dimension, count in wanted.items())


def _is_near(said: Measured, row: QuestionRow, expression: Expression, truth: TruthValue) -> bool:
    """Whether a number is the truth, which may be stated in the unit that is said."""
    scale = scale_of(expression)
    scale = scale if math.isclose(said.size * scale, 1.0, rel_tol=1e-6) else 1.0
    true = float(truth.value or 0.0)
    tolerance = row.tolerance or row.usual_tolerance(expression).times(scale)
    if abs(said.value * scale - true) <= tolerance.of(true) + 1e-9:
        return True
    # 500 * depth_mm is half of it in microns
    return is_multiple_in(expression, said.size) and (
        abs(said.value / said.size - true) <= (row.tolerance or EXACT).of(true) + 1e-9
    )


def _converted(
    numbers: Sequence[Measured], dimension: str, scene: AskedScene | None
) -> list[Measured]:
    """The numbers that measure a dimension, in its own unit.

    Grams count as the force that they weigh, and mm² as the percentage of the sensing area that
    they are; without a scene the values are not needed.
    """
    area_mm2 = 100.0 if scene is None else scene.sensor.area_mm2
    factors = {(dimension, dimension): 1.0}
    factors["mass", "force"] = GRAVITY_N_PER_G
    if all(any(math.isclose(each.size, size) for size in _WEIGHTS) for each in numbers):
        factors["force", "mass"] = 1 / GRAVITY_N_PER_G
    factors["area", "fraction"] = 100 / area_mm2
    factors["fraction", "ratio"] = 0.01
    factors["", "ratio"] = 1.0
    return [
        Measured(
            value=number.value * factors[number.dimension, dimension],
            dimension=dimension,
            size=number.size * factors[number.dimension, dimension],
        )
        for number in numbers
        if (number.dimension, dimension) in factors and (number.dimension or dimension)
    ]
