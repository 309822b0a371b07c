import pytest

from tacgrasp.lessons.dialogue.families.misspelled import (
    compared_aright,
    compares_unread,
    respelled,
)


@pytest.mark.parametrize(
    ("question", "meant"),
    [
        ("what is the dpeth", "what is the depth"),
        ("is ther a contcat", "is there a contact"),
        ("How fr is it from the midle?", "how fr is it from the middle?"),
        ("Is it ruogh?", "is it rough?"),
    ],
)
def test_a_slip_in_a_word_that_matters_is_set_right(question, meant):
    assert respelled(question) == meant


@pytest.mark.parametrize(
    "question",
    [
        "Is there a grid on the ship?",
        "Was it made in Finnish woods?",
        "Is it among the nine kiwis?",
        "Subtract the halved limit from 5 N.",
        "What's the Depth?",
        "",
    ],
)
def test_other_words_stay(question):
    assert respelled(question) == question


@pytest.mark.parametrize(
    ("question", "meant"),
    [
        ("Is it deaper then 0.2 mm?", "Is it deeper than 0.2 mm?"),
        ("Is it deper then half a mm?", "Is it deeper than half a mm?"),
        ("heigher than 2 N", "higher than 2 N"),
        ("biger then 10 %", "bigger than 10 %"),
        ("ligther then the limit", "lighter than the limit"),
        ("strongger than", "stronger than"),
        ("shalower then 1 mm", "shallower than 1 mm"),
        ("grater than 2 N", "greater than 2 N"),
        ("wieker then 2 N", "weaker than 2 N"),
        ("les then 3 N", "less than 3 N"),
        ("moer then 3 N", "more than 3 N"),
        ("the force abov 2 N", "the force above 2 N"),
        ("undr 2 N", "under 2 N"),
        ("does it exeed 2 N", "does it exceed 2 N"),
        ("betwen 1 and 2 N", "between 1 and 2 N"),
    ],
)
def test_a_word_of_comparison_is_known_by_its_place(question, meant):
    assert compared_aright(question) == meant


@pytest.mark.parametrize(
    "question",
    [
        "rather than 2 N",
        "other than 2 N",
        "slower than 2 N",
        "denser than water",
        "Is it warmer than 20 degrees?",
        "If it were 2 N higher then the force is too much?",
        "Is it higher? Then what?",
        "Is it about 2 N, and does it cover 12 %?",
        "",
    ],
)
def test_what_compares_something_else_stays(question):
    assert compared_aright(question) == question


@pytest.mark.parametrize(
    ("question", "is_unread"),
    [
        ("Is the force zorp 2 N?", True),
        ("Is it slower than 2 N?", True),
        ("Is the force about 2 N?", False),
        ("Is it 0.3 mm deep?", False),
        ("How deep is it?", False),
    ],
)
def test_a_comparison_that_nothing_reads_is_told(question, is_unread):
    assert compares_unread(question) == is_unread
