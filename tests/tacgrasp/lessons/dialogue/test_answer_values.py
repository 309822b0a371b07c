"""Values that programs get are those that the answers were worded from."""

import numpy as np
import pytest

from tacgrasp.lessons.dialogue.answer_values import answer_in
from tacgrasp.lessons.dialogue.answers import answer
from tacgrasp.lessons.dialogue.meaning import AnswerKind, Which
from tacgrasp.lessons.dialogue.quantities import UNITS
from tacgrasp.lessons.question_draws import draw_question, families_by_kind
from tests.fakes.question_scenes import ASIDE, FIRM, HELD, LIGHT


@pytest.mark.parametrize(
    "kind",
    [AnswerKind.NUMBER, AnswerKind.YES_NO, AnswerKind.UNKNOWABLE, AnswerKind.OFF_TOPIC],
)
def test_every_answer_of_the_grammar_is_read_back(kind: AnswerKind) -> None:
    rng = np.random.default_rng(3)
    for family in families_by_kind()[kind]:
        for scene in (HELD, FIRM, ASIDE, LIGHT):
            question = draw_question(scene, rng, family)
            true = answer(question.meaning, scene)
            said = answer_in(true.text)
            assert (said.kind, said.decidable) == (true.kind, true.decidable), true
            if isinstance(true.value, float):
                base = true.value * UNITS[true.unit].size
                assert said.value == pytest.approx(base), true
                assert UNITS[said.unit].dimension == UNITS[true.unit].dimension
            else:
                assert said.value == true.value, true


def test_words_are_read_back_too() -> None:
    rng = np.random.default_rng(4)
    for family in families_by_kind()[AnswerKind.CHOICE]:
        for scene in (HELD, FIRM, ASIDE):
            question = draw_question(scene, rng, family)
            if not isinstance(question.meaning, Which):
                continue
            true = answer(question.meaning, scene)
            assert answer_in(true.text).value == true.value, true


@pytest.mark.parametrize(
    ("text", "kind", "value", "unit"),
    [
        ("190 µm.", AnswerKind.NUMBER, 0.19, "mm"),
        ("85 g.", AnswerKind.NUMBER, 85.0, "g"),
        ("The force left to the limit is 0.20 N.", AnswerKind.NUMBER, 0.2, "N"),
        ("Move left: it is off center.", AnswerKind.CHOICE, "move_left", ""),
        ("Slight or moderate.", AnswerKind.TEXT, None, ""),
        ("0.12 N or 0.31 N.", AnswerKind.TEXT, None, ""),
        ("Because it is pressed too firmly.", AnswerKind.TEXT, None, ""),
        ("Nothing touches.", AnswerKind.TEXT, None, ""),
    ],
)
def test_what_an_answer_says(text: str, kind: AnswerKind, value: object, unit: str) -> None:
    said = answer_in(text)
    assert (said.kind, said.value, said.unit) == (kind, value, unit)
