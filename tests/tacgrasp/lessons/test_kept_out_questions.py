"""The kept-out questions: their number and kinds, and that the grammar does not contain them."""

from collections import Counter

import numpy as np
import pytest

from tacgrasp.lessons.dialogue.families.catalogue import FAMILIES
from tacgrasp.lessons.dialogue.meaning import AnswerKind
from tacgrasp.lessons.dialogue.scoring.question_file import read_questions
from tacgrasp.lessons.question_draws import draw_question, draw_scene
from tacgrasp.lessons.question_scores import answer_all, ask_all, figures, perfect_answer
from tacgrasp.lessons.wording_coverage import coverage
from tests.fakes.question_scenes import HELD, SCENES, random_states

ROWS = read_questions(None)


def test_there_are_three_hundred_of_all_kinds():
    assert len(ROWS) == 300
    assert len({row.question.lower() for row in ROWS}) == 300
    counts = Counter(row.kind for row in ROWS)
    assert min(counts[kind] for kind in AnswerKind) >= 30
    unknown = {row.family for row in ROWS if row.kind is AnswerKind.UNKNOWABLE}
    assert len(unknown) >= 12
    assert len({row.family for row in ROWS}) >= 30


def test_the_grammar_can_produce_none_of_them_and_few_of_their_runs():
    results = coverage([row.question for row in ROWS])
    produced = [each.question for each in results if each.produced_by]
    fraction = sum(each.fraction for each in results) / len(results)
    print(  # noqa: T201
        f"kept-out questions that the grammar can produce: {len(produced)} of {len(results)}; "
        f"runs of four words that occur in it: {100 * fraction:.1f} % on average"
    )
    assert not produced
    assert fraction <= 1 / 3


def test_coverage_finds_what_the_grammar_does_produce():
    rng = np.random.default_rng(2)
    drawn = [draw_question(SCENES[0], rng, family).text for family in FAMILIES[::9]]
    for each in coverage(drawn):
        assert each.produced_by, each.question
        assert each.fraction == pytest.approx(1.0)
    strange = coverage(["Purple seven quickly the of?"])[0]
    assert (strange.produced_by, strange.fraction) == ((), 0.0)


def test_the_truths_in_words_are_right_in_every_scene():
    answers = answer_all(ask_all(ROWS, SCENES, len(SCENES)), perfect_answer)
    wrong = [(e.asked.row.question, e.text) for e in answers if not e.score.right]
    assert not wrong
    assert figures(answers).right_kind == 1.0


def test_no_constant_answers_a_yes_or_no_question_in_every_scene():
    rng = np.random.default_rng(4)
    values = [draw_scene(state, rng).values() for state in random_states(400)] + [HELD.values()]
    for row in ROWS:
        if row.kind is AnswerKind.YES_NO and row.names != ("contact",):
            truths = {row.truths[0].evaluate(each).value for each in values}
            assert truths >= {True, False}, row.question
