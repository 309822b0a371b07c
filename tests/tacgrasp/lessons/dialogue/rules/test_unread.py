"""Questions that no reader may take for something near."""

import pytest

from tacgrasp.lessons.dialogue.rules.unread import is_beyond
from tacgrasp.lessons.understanding import understood_by_grammar


@pytest.mark.parametrize(
    "question",
    [
        "Is 3 N more than 5 N?",
        "Is 2 mm less than 5 mm?",
        "Does 2 N exceed 3 N?",
        "Is 50 g heavier than 20 g?",
        "Is 500 mN more than 0.3 N?",
    ],
)
def test_what_nothing_reads_ends_and_is_beyond(question):
    assert understood_by_grammar(question) is None
    assert is_beyond(question)


@pytest.mark.parametrize(
    "question",
    [
        "What's the width of the gripper?",
        "If I tighten by 1 N, is it too much?",
        "How wide is the gripper open?",
        "What is the resolution of the sensor?",
    ],
)
def test_what_no_query_has_is_beyond(question):
    assert is_beyond(question)


@pytest.mark.parametrize(
    "question",
    ["Is the force more than 5 N?", "How deep is it?", "How wide is the band?"],
)
def test_what_is_read_is_not_beyond(question):
    assert not is_beyond(question)
