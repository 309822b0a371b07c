"""Figures of a file of questions: trivial answers, upper bounds, and what is left out."""

import pytest

from tacgrasp.lessons.dialogue.scoring.question_file import question_row
from tacgrasp.lessons.question_scores import (
    answer_all,
    ask_all,
    baselines,
    figures,
    figures_by_family,
    grammar_answer,
)
from tests.fakes.question_scenes import FIRM, HELD, LIGHT

SCENES = (HELD, LIGHT, FIRM)


def row(family, question, kind, truth="", tolerance=""):
    columns = {"family": family, "question": question, "kind": kind, "truth": truth}
    return question_row({**columns, "tolerance": tolerance})


ROWS = [
    row("depth", "How deep is it?", "number", "depth_mm"),
    row("force_above", "Is the force above 1 N?", "yes_no", "force_n > 1"),
    row("shape", "What shape is it?", "text", "shape"),
    row("price", "What does it cost?", "unknowable"),
    row("facts", "What is the capital of France?", "off_topic"),
]


def scored():
    asked = ask_all(ROWS, SCENES, 3)
    return {name: answer_all(asked, one) for name, one in baselines(asked).items()}


def test_trivial_answers_reach_what_can_be_counted_by_hand():
    results = {name: figures(answers) for name, answers in scored().items()}
    # 9 decidable: three depths, three forces (no, no, yes), three shapes (two are ellipsoids)
    assert results["no"].decidable_n == 9
    assert results["no"].undecidable_n == 6
    assert results["no"].right == pytest.approx(2 / 9)
    assert results["yes"].right == pytest.approx(1 / 9)
    assert results["no"].right_kind == pytest.approx(3 / 15)
    assert results["no"].undecidable == 0
    assert results["unknowable"].right == 0
    assert results["unknowable"].undecidable == 1
    assert results["unknowable"].right_kind == pytest.approx(3 / 15)
    # the median depth 0.19 mm once, no twice, ellipsoid twice
    assert results["most frequent"].right == pytest.approx(5 / 9)
    assert results["truth in words"].right == 1
    assert results["truth in words"].right_kind == 1
    assert (results["grammar"].right, results["grammar"].undecidable) == (1, 1)


def test_families_are_counted_apart():
    families = figures_by_family(scored()["no"])
    assert list(families) == ["depth", "force_above", "shape", "price", "facts"]
    assert families["force_above"].right == pytest.approx(2 / 3)
    assert families["price"].right is None


def test_contacts_near_the_threshold_are_left_out():
    rows = [row("force", "Over 0.8 N?", "yes_no", "force_n > 0.8", "0.1")]
    [figure] = figures_by_family(answer_all(ask_all(rows, SCENES, 3), lambda _: "No.")).values()
    assert (figure.close_n, figure.decidable_n, figure.right) == (1, 2, 0.5)


def test_the_grammar_passes_what_it_does_not_know():
    asked = ask_all([row("x", "Quelle heure est-il?", "off_topic")], SCENES, 1)
    assert grammar_answer(asked[0]) is None
    assert answer_all(asked, grammar_answer) == []


def test_scenes_take_turns():
    asked = ask_all(ROWS, SCENES, 2)
    assert len(asked) == 10
    assert [one.contact for one in asked[:4]] == [0, 1, 2, 0]


@pytest.mark.parametrize(
    ("kind", "truth"),
    [
        ("number", "force_n / limit_n"),
        ("number", "100 * force_n / limit_n"),
        ("number", "100 * depth_mm / 2"),
        ("number", "force_n * 1000 / 9.81"),
        ("number", "force_n / 9.81"),
        ("number", "depth_mm * 1000"),
        ("number", "depth_mm * 10"),
        ("number", "(band_high_n - force_n) * 1000"),
        ("number", "area_mm2 / 100"),
        ("number", "limit_n / gram_n"),
        ("number", "mass_g * gram_n"),
        ("number", "2 * sqrt(area_mm2 / 3.14159)"),
        ("number", "1000 * force_n / area_mm2"),
        ("number", "area_percent / 100"),
        ("number", "force_n / depth_mm"),
        ("choice", "'upper' if y_mm > 0 else 'lower'"),
        ("choice", "'inside' if band_low_n <= force_n <= band_high_n else 'above'"),
        ("text", "'tighten' if force_n < band_low_n else 'hold'; force_n"),
    ],
)
def test_the_truth_in_words_is_right(kind, truth):
    asked = ask_all([row("any", "What is it?", kind, truth)], SCENES, 3)
    contestants = baselines(asked)
    assert figures(answer_all(asked, contestants["truth in words"])).right == 1
    assert figures(answer_all(asked, contestants["most frequent"])).right is not None
