"""The value of an answer, read back from its text: what programs get beside the words.

Not here: whether it is right (``tacgrasp.lessons.dialogue.answer_scores``).
"""

from __future__ import annotations

import re
from dataclasses import replace

from cltp.tactile.states import CLASSES
from tacgrasp.lessons.dialogue.answer_reading import AnswerReading, Measured, read_answer
from tacgrasp.lessons.dialogue.answers import Answer
from tacgrasp.lessons.dialogue.meaning import AnswerKind
from tacgrasp.lessons.dialogue.quantities import UNITS

_BASE_UNITS = {unit.dimension: unit.symbol for unit in UNITS.values() if unit.size == 1.0}

_OTHERS = ("force_band", "wholeness", "worse_axis", "side_x", "side_y")
"""Names whose words are looked for where no action and no class is named."""

_NO_WORD = re.compile(r"\bleft to\b|\bthe edge (?=cuts\b)", re.I)
"""'The force left to the limit' is on no side, and the edge of the pad is no shape."""


def answer_in(text: str) -> Answer:
    """What an answer says.

    Numbers are in mm, N, percent, mm² or g, whatever unit the text has. An answer of one word of
    the vocabulary is a choice, one with an action too; reasons, several words or several numbers
    are a text without a value.
    """
    reading = read_answer(text)
    if reading.is_off_topic or reading.is_unknown:
        kind = AnswerKind.OFF_TOPIC if reading.is_off_topic else AnswerKind.UNKNOWABLE
        return Answer(text=text, kind=kind, decidable=False)
    if reading.is_yes is not None and len(reading.verdicts) <= 1:
        return Answer(text=text, kind=AnswerKind.YES_NO, value=reading.is_yes)
    words = _words(reading)
    number = _one_number(reading)
    if number is not None and not words:
        unit = _BASE_UNITS[number.dimension]
        return Answer(text=text, kind=AnswerKind.NUMBER, value=number.value, unit=unit)
    is_reason = text.lower().startswith("because")
    if len(words) == 1 and not (reading.numbers or reading.is_nothing or is_reason):
        return Answer(text=text, kind=AnswerKind.CHOICE, value=words[0])
    return Answer(text=text, kind=AnswerKind.TEXT)


def _one_number(reading: AnswerReading) -> Measured | None:
    """The only number with a unit; None where there is none, or another one."""
    numbers = set(reading.numbers)
    return numbers.pop() if len(numbers) == 1 and reading.numbers[0].dimension else None


def _words(reading: AnswerReading) -> list[str]:
    """The actions of an answer; where it has none its classes, else its other words."""
    if action := list(reading.words("action")):
        return action
    reading = replace(reading, text=_NO_WORD.sub("", reading.text))
    classes = [word for name in CLASSES for word in reading.words(name)]
    return classes or [word for name in _OTHERS for word in reading.words(name)]
