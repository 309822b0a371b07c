"""Questions that readers would take for others, and those that no query has."""

import pytest

from tacgrasp.lessons.dialogue.query import asked_text
from tacgrasp.lessons.dialogue.rules.others import other_query
from tacgrasp.lessons.dialogue.rules.unread import is_beyond


@pytest.mark.parametrize(
    ("question", "query"),
    [
        ("leftward more than 2 mm", "check x < -#1 mm."),
        ("Is the rightward offset at most 2 mm?", "check x <= #1 mm."),
        ("Is the offset to the tip less than 1 mm?", "check y > -#1 mm."),
        ("Which direction is it off, horizontally?", "word side_x."),
        ("Is it deeper than before?", "unknown past."),
        ("Did the force increase since the last frame?", "unknown past."),
        ("How long have we been in contact?", "unknown past."),
        ("Has it got any deeper?", "unknown past."),
        ("What's the tangential load?", "unknown trait."),
        ("How many dots are there?", "unknown trait."),
        ("How wide is the contact in mm?", "unknown size."),
        ("What's the radius of the ball?", "unknown size."),
        ("Thickness of that part in mm?", "unknown size."),
        ("Are you sure about the shape?", "why shape."),
        ("Should I squeeze it more or less?", "choice action."),
    ],
)
def test_a_class_of_questions_has_its_query(question, query):
    assert other_query(asked_text(question).words) == query


@pytest.mark.parametrize(
    "question",
    [
        "How wide is the band?",
        "What is the width of the band?",
        "What is the size of the contact?",
        "Is it a corner?",
        "Is the force increased enough for the band?",
        "Is it more than 2 mm deep?",
        "Which side is it on?",
        "Should I press more?",
        "How deep is it?",
        "Has the imprint got the form of a triangle?",
        "Has it become deep?",
        "The depth in centimetres, since our form only takes those?",
    ],
)
def test_others_are_left_to_the_readers(question):
    assert other_query(asked_text(question).words) == ""


@pytest.mark.parametrize(
    "question",
    [
        "Is the pressure above 10 kPa?",
        "x in pixels",
        "Would ten times that be too much?",
        "Would 0.5 N more be too much?",
        "If I add 0.5 N, is it still in the band?",
        "Are we 0.1 N or more above the lower end of the band?",
        "How far is it from the left edge?",
        "What mass can 0.5 N hold?",
        "Is the force closer to 0.5 N or to 1 N?",
        "Are both offsets below 2 mm?",
        "leftward more than 300 microns",
        "depth in grams",
        "How deep is it in newtons?",
        "What is the force in mm?",
        "With a friction coefficient of 0.8, how much can it carry?",
        "Given friction of 0.5, would 30 g slip?",
        "If the pad is 400 mm² large, how much of it is touched?",
        "Is it neither zorby nor deep?",
    ],
)
def test_what_no_query_has_is_beyond_them(question):
    assert is_beyond(question)


@pytest.mark.parametrize(
    "question",
    [
        "Would twice that be too much?",
        "Is the pressure above 2 N?",
        "How many newtons more until the limit?",
        "How much can it hold at 2 N?",
        "How far is it to the left?",
        "How warm is it, in degrees?",
    ],
)
def test_what_is_near_it_is_not(question):
    assert not is_beyond(question)
