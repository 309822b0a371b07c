"""What ties a follow-up to the line before it, and what only looks so."""

import pytest

from tacgrasp.lessons.turns.leads import without_lead


@pytest.mark.parametrize(
    ("question", "bare"),
    [
        ("And the depth?", "the depth?"),
        ("ok, so how deep is it then?", "how deep is it?"),
        ("Fair enough. Its texture at least?", "Its texture?"),
        ("more than 3 mm, right?", "more than 3 mm?"),
        ("n 35?", "35?"),
    ],
)
def test_words_that_tie_are_left_out(question, bare):
    assert without_lead(question) == bare


@pytest.mark.parametrize(
    "question",
    [
        "No contact?",
        "Right edge?",
        "Good grip?",
        "Still safe to lift?",
        "Next step?",
        "Just right?",
    ],
)
def test_words_that_mean_something_stay(question):
    assert without_lead(question) == question
