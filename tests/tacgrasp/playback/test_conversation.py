"""Which questions of a dialogue mean something only after the one before."""

import pytest

from tacgrasp.lessons.dialogue.question_file import read_questions
from tacgrasp.playback.conversation import is_follow_up


def test_kept_out_follow_ups_are_seen_as_such() -> None:
    rows = [row for row in read_questions(None) if row.before]
    assert len(rows) == 10
    seen = [row.question for row in rows if is_follow_up(row.question, row.before)]
    assert len(seen) >= 9


def test_most_questions_that_stand_alone_are_not() -> None:
    rows = [row for row in read_questions(None) if not row.before]
    seen = [row for row in rows if is_follow_up(row.question, "How deep is the contact?")]
    assert len(seen) < 0.3 * len(rows)


@pytest.mark.parametrize(
    ("question", "before", "expected"),
    [
        ("How hard is it pressed?", "How deep is the contact?", False),
        ("And the force?", "How deep is the contact?", True),
        ("Why?", "What should I do next?", True),
        ("Which of the nine parts of the sensing pad carries the load?", "Why?", False),
    ],
)
def test_a_question_of_the_grammar_stands_alone(question: str, before: str, expected: bool) -> None:
    assert is_follow_up(question, before) is expected
