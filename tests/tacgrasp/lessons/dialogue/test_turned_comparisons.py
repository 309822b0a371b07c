"""Comparisons whose number comes first."""

import pytest

from tacgrasp.lessons.dialogue.turned_comparisons import turned


@pytest.mark.parametrize(
    ("question", "subject_first"),
    [
        ("Is 0.3 mm less than the depth?", "is the depth more than 0.3 mm?"),
        ("Does 2 N exceed what you feel?", "is the force less than 2 N?"),
        ("Does 1 mm exceed what you feel?", "is the depth less than 1 mm?"),
        ("Does 300 mN exceed what you feel?", "is the force less than 300 mN?"),
        ("Would 1 N be an understatement of the force?", "is the force more than 1 N?"),
        ("Is 1.5 N too high a guess for the force?", "is the force less than 1.5 N?"),
        (
            "Is half a newton greater than the force you measure?",
            "is the force less than half a newton?",
        ),
        ("Is 20 % surpassed by the coverage?", "is the coverage more than 20 %?"),
    ],
)
def test_the_subject_comes_first(question, subject_first):
    assert turned(question) == subject_first


@pytest.mark.parametrize(
    "question",
    [
        "Is it less than 2 N?",
        "Is 30 g too much?",
        "Is the depth more than 0.3 mm?",
        "Is 1 N enough?",
    ],
)
def test_other_questions_stay(question):
    assert turned(question) == question
