"""Questions whether what is felt is called so, by words that may be no class."""

import pytest

from tacgrasp.lessons.dialogue.answers import answer
from tacgrasp.lessons.dialogue.query import read_query
from tacgrasp.lessons.dialogue.rules.worded import worded_query
from tests.fakes.question_scenes import ASIDE, FREE, HELD


@pytest.mark.parametrize(
    ("question", "query"),
    [
        ("Is that a star I'm holding?", "calculate shape == 'star'."),
        ("My money's on a star. Did I win?", "calculate shape == 'star'."),
        ("yo is it a star or nah", "calculate shape == 'star'."),
        ("Somebody told me it would be an octagon. Is it?", "calculate shape == 'octagon'."),
        ("square or not?", "check shape cuboid."),
        ("The drawing says it's a cone. Is that what you feel?", "check shape peak."),
        ("I bet it's not a ring. Is it one?", "check shape ring."),
        ("I bet it's not a ring. Am I right?", "check not shape ring."),
        ("I expected a dotted finish. Does the touch bear that out?", "check texture bumpy."),
        ("Is it that dotted sort of pattern, like on my gloves?", "check texture bumpy."),
        ("Is the finish striped rather than dotted?", "check texture ridged."),
        ("Am I right in thinking the surface isn't striped?", "check not texture ridged."),
        ("Do you feel stripes on it?", "calculate texture == 'ridged' or shape == 'stripes'."),
        ("Either a square or a hexagon, am I right?", "calculate shape in ['cuboid', 'hexagon']."),
        (
            "Gripping an edge or a corner, or neither of these? Yes means one of the two.",
            "calculate shape in ['edge', 'corner'].",
        ),
        (
            "Got a corner? Or an edge, I'd take an edge too.",
            "calculate shape in ['corner', 'edge'].",
        ),
        ("Disc or ring, is it one of those two?", "calculate shape in ['disc', 'ring']."),
        ("Is the texture one of woven or bumpy?", "calculate texture in ['woven', 'bumpy']."),
        ("Neither dotted nor striped, then?", "calculate not (texture in ['bumpy', 'ridged'])."),
        ("Not a ring, not a disc either, right?", "calculate not (shape in ['ring', 'disc'])."),
        ("A star or a heart?", "choice shape."),
        (
            "Is it a ring, a star or neither?",
            "calculate 'ring' if shape == 'ring' else 'star' if shape == 'star' else 'neither'.",
        ),
    ],
)
def test_a_word_is_checked_whether_it_is_a_class_or_not(question, query):
    assert worded_query(question) == query


@pytest.mark.parametrize(
    "question",
    [
        "Is it near the edge?",
        "Is it at the corner of the pad?",
        "What is the point?",
        "Is the star red?",
        "Is it a star deeper than 2 mm?",
        "Will the star slip?",
        "Is it a ring, and how deep is it?",
        "Are we touching on an edge here, not a flat?",
        "Is it a strawberry?",
        "Is it round and smooth?",
    ],
)
def test_what_says_more_is_left_to_others(question):
    assert worded_query(question) == ""


@pytest.mark.parametrize(
    ("query", "scene", "text"),
    [
        ("calculate shape == 'star'.", HELD, "No, it is an ellipsoid."),
        ("calculate not (shape == 'star').", HELD, "Yes, it is an ellipsoid."),
        ("calculate shape in ['ring', 'ellipsoid'].", HELD, "Yes, it is an ellipsoid."),
        (
            "calculate texture == 'ridged' or shape == 'stripes'.",
            ASIDE,
            "No, the surface is bumpy, these are dots.",
        ),
        ("calculate shape == 'star'.", FREE, "I can't tell the shape."),
    ],
)
def test_an_answer_names_what_is_felt(query, scene, text):
    assert answer(read_query(query), scene).text == text
