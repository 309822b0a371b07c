"""Questions about thirds, quadrants and corner fields of the pad, and about the sides that cut."""

import pytest

from tacgrasp.lessons.answering import answered
from tacgrasp.lessons.dialogue.meaning import truth_of
from tacgrasp.lessons.dialogue.rules.regions import of_region
from tacgrasp.lessons.understanding import understood_by_grammar
from tests.fakes.question_scenes import ASIDE, HELD


@pytest.mark.parametrize(
    ("question", "held", "aside"),
    [
        ("Is it in the left, center or right third of the pad?", "Center", "Left"),
        ("Vertically: top, middle or bottom?", "Middle", "Top"),
        ("Is the contact in the upper third?", "No", "Yes"),
        ("Am I wrong to say the contact is in the upper third of the pad?", "Yes", "No"),
        (
            "Which quadrant is it in: upper-left, upper-right, lower-left or lower-right?",
            "Lower-right",
            "Upper-left",
        ),
        ("Has it landed in one of the four corner fields?", "No", "Yes"),
        ("Is it sitting in the middle square of the pad?", "Yes", "No"),
        ("How many sides of the pad does it run over?", "0", "1"),
        ("Does it leave the pad on two opposite sides at once?", "No", "No"),
        ("Is it going off the left, off the right, both or neither?", "Neither", "Left"),
    ],
)
def test_the_answer_is_that_of_the_part_of_the_pad(question, held, aside):
    read = understood_by_grammar(question)
    assert answered(read, HELD).answer.text.startswith(held)
    assert answered(read, ASIDE).answer.text.startswith(aside)


def test_the_middle_third_is_of_the_axis_that_is_named():
    assert "abs(x_mm)" in truth_of(of_region("Is it in the middle column?"))
    assert "abs(y_mm)" in truth_of(of_region("Is it in the middle row?"))
    assert of_region("Is it in the middle third?") is None


@pytest.mark.parametrize(
    "question",
    [
        "Is it left, right or above 2 N?",
        "Is the upper third of the band reached?",
        "How many edges does the object have?",
        "Upper-left, upper-right, lower-left, lower-right or in the middle?",
    ],
)
def test_what_is_no_part_of_the_pad_is_left_to_others(question):
    assert of_region(question) is None
