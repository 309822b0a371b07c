"""Questions whether it is one of several classes."""

import pytest

from tacgrasp.lessons.dialogue.rules.members import member_of


@pytest.mark.parametrize(
    ("question", "truth"),
    [
        ("Is the shape one of edge, corner or line?", "shape in ['edge', 'corner', 'line']"),
        ("Has it been classified as a sphere or a disc?", "shape in ['sphere', 'disc']"),
        ("Anything bumpy or rough about it?", "texture in ['rough', 'bumpy']"),
    ],
)
def test_one_of_several_is_a_yes_or_a_no(question, truth):
    assert member_of(question).truth == truth


@pytest.mark.parametrize(
    "question",
    [
        "Is it an edge or a corner?",  # wants the one that it is
        "Which one of edge, corner or line is it?",
        "Is it one of sphere, disc or neither?",
        "Is it one of the rough spheres or discs?",
        "Is one of the two forces 1 N or 2 N?",
    ],
)
def test_a_choice_is_left_to_others(question):
    assert member_of(question) is None
