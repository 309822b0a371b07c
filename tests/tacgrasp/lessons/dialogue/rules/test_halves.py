"""Questions for a side, a half or a quadrant of the pad, and about offsets from the middle."""

import pytest

from tacgrasp.lessons.dialogue.plain_words import plain_words
from tacgrasp.lessons.dialogue.rules.halves import half_query
from tacgrasp.lessons.dialogue.rules.offsets import offset_query


def plain(question):
    return " ".join(plain_words(question))


@pytest.mark.parametrize(
    ("question", "query"),
    [
        ("Is contact on the right half of the pad?", "check right."),
        ("Does it sit in the half of the pad towards the fingertip?", "check bottom."),
        ("Is it in the half away from the fingertip?", "check top."),
        ("Was it caught on the fingertip's side of the midline, not the palm's?", ""),
        ("Was it caught on the fingertip's side rather than on the palm's?", "check bottom."),
        ("It is centred higher up, nearer the top edge than the bottom one, right?", "check top."),
        ("Is it sitting more on the right than on the left?", "check right."),
        ("The contact, it is in the left half, no?", "check left."),
        ("Is the object not on the palm side?", "check not top."),
        ("It sits nearer to the palm than to the fingertip, doesn't it?", "check top."),
        ("Top right quadrant, is that where it is?", "calculate x_mm > 0 and y_mm > 0."),
        ("Is it left of the centre and above it?", "calculate x_mm < 0 and y_mm > 0."),
        (
            "Left or right, which side did it end up on?",
            "calculate 'left' if x_mm < 0 else 'right'.",
        ),
        (
            "Upper half or lower half of the pad, where's the centre of it?",
            "calculate 'upper' if y_mm > 0 else 'lower'.",
        ),
        ("Nearer the palm, or nearer the tip?", "calculate 'palm' if y_mm > 0 else 'tip'."),
        ("In which quadrant is it? Give left/right and palm/tip.", "word side_x; word side_y."),
    ],
)
def test_a_side_is_asked_for_in_any_words(question, query):
    assert half_query(plain(question)) == query


@pytest.mark.parametrize(
    "question",
    [
        "Is it right?",
        "What is on the right side?",
        "Is it left of the middle by 2 mm?",
        "Are we at the upper end?",
        "Is the force in the upper half of the band?",
        "Should I move left or right?",
        "How far left is it?",
        "Is it in the top left corner?",
        "Is it not so that it lies on the left?",
        "Which quarter of the limit is left?",
    ],
)
def test_others_are_not_about_sides(question):
    assert half_query(plain(question)) == ""
    assert offset_query(plain(question)) == ""


@pytest.mark.parametrize(
    ("question", "query"),
    [
        ("Left-right offset in microns, ignore the sign.", "amount offset_x mm."),
        ("How many mm is it off along the finger, sign dropped?", "amount offset_y mm."),
        ("Distance from the vertical centreline in mm, unsigned?", "amount offset_x mm."),
        ("How many mm of sideways shift would line it up with the middle?", "amount offset_x mm."),
        (
            "Which way's it off more, sideways or lengthwise?",
            "calculate 'sideways' if abs(x_mm) > abs(y_mm) else 'lengthwise'.",
        ),
        (
            "Of the two offsets, which is larger: y or x?",
            "calculate 'x' if abs(x_mm) > abs(y_mm) else 'y'.",
        ),
        (
            "To get back to the middle it'd have to move to the left or the right?",
            "calculate 'left' if x_mm > 0 else 'right'.",
        ),
        (
            "To be centred again, must the object go up or down?",
            "calculate 'down' if y_mm > 0 else 'up'.",
        ),
        ("Would it need to slide right to be centred again?", "check left."),
    ],
)
def test_an_offset_is_asked_for_in_any_words(question, query):
    assert offset_query(plain(question)) == query


@pytest.mark.parametrize(
    "question",
    [
        "How many mm left of the middle is it, minus for the right?",
        "Should I move it left or right to get to the middle?",
        "Is the sideways offset more than 2 mm?",
        "How far is it from the middle?",
        "Which is larger, the force or the limit?",
        "What depth has it, ignoring the sign?",
    ],
)
def test_others_are_not_about_offsets(question):
    assert offset_query(plain(question)) == ""
