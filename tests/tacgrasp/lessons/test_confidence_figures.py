"""Calibration error and AUROC of confidences, against what a hand counts."""

from types import SimpleNamespace

import pytest

from tacgrasp.lessons.question_scores import confidence_figures


def scored(right, *, decidable=True, is_close=False):
    return SimpleNamespace(
        score=SimpleNamespace(right=right, decidable=decidable, is_close=is_close)
    )


def test_confidences_that_order_all_answers_and_are_off_by_a_tenth():
    answers = [scored(False)] * 10 + [scored(True)] * 10
    found = confidence_figures(answers, [0.1] * 10 + [0.9] * 10)
    assert found == {"calibration_error": pytest.approx(0.1), "auroc": 1.0}


def test_confidences_that_say_nothing():
    answers = [scored(number % 2 == 0) for number in range(20)]
    found = confidence_figures(answers, [0.5] * 20)
    assert found == {"calibration_error": pytest.approx(0.0), "auroc": 0.5}


def test_only_decidable_answers_count():
    answers = [scored(False, decidable=False), scored(False, is_close=True), scored(True)]
    found = confidence_figures(answers, [1.0, 1.0, 0.75])
    assert found == {"calibration_error": pytest.approx(0.25), "auroc": None}
    assert confidence_figures(answers[:2], [1.0, 1.0])["calibration_error"] is None
