"""Questions about an edge of the pad."""

from dataclasses import replace

import pytest

from cltp.tactile.states import Side
from tacgrasp.lessons.dialogue.answers import answer
from tacgrasp.lessons.dialogue.query import asked_text, read_query
from tacgrasp.lessons.dialogue.rules.edges import edge_query
from tests.fakes.question_scenes import ASIDE, HELD, UNTOUCHED, contact


@pytest.mark.parametrize(
    ("question", "query"),
    [
        ("Is it touching the left edge?", "check cut left."),
        ("Is the contact near an edge?", "check not position centered."),
        ("Is it not close to any border of the pad?", "check position centered."),
        ("Does it reach the top edge of the pad?", "check cut top."),
        ("Is the contact cut off on the right?", "check cut right."),
        ("It is cut off on the left, right?", "check cut left."),
        ("Does it stick out on the palm side?", "check cut top."),
        ("has the contact run over the tip end", "check cut bottom."),
        ("It doesn't touch the left rim?", "check not cut left."),
        ("Is the print clear of any clipping at the rim?", "check not cut."),
        ("Does it touch the left or the right edge?", "calculate cut_left or cut_right."),
        (
            "Is it cut on the right-hand side or at the bottom (or both)?",
            "calculate cut_right or cut_bottom.",
        ),
        (
            "Does it run off the left or the right rim (either counts)?",
            "calculate cut_left or cut_right.",
        ),
        ("Is it cut on both the left and the bottom edge?", "calculate cut_left and cut_bottom."),
        (
            "Neither the left nor the right border clips it.",
            "calculate not (cut_left or cut_right).",
        ),
        ("Left or right edge, which one clips it?", "word cut_sides."),
        ("Is the right-hand border chopping the contact off?", "check cut right."),
        ("Did we lose a bit of it over the right edge?", "check cut right."),
        ("Is the tip-side rim biting into the patch?", "check cut bottom."),
        ("Which edge cuts it?", "word cut_sides."),
        ("which side is clipped", "word cut_sides."),
        ("Is it touching the edge?", "check cut."),
        ("Are we at the edge of the pad?", "check cut."),
        ("Is it close to the left edge?", "check near left."),
    ],
)
def test_an_edge_is_asked_for_by_its_side(question, query):
    assert edge_query(asked_text(question).words) == query


@pytest.mark.parametrize(
    "question",
    [
        "Is it left of the middle?",
        "Is it nearer the top edge than the bottom one?",
        "Has the force gone over the top of the wanted band?",
        "Is it an edge?",
        "Are you touching the edge of the object?",
        "How far is it from the left edge?",
        "Should I move left, off the edge?",
        "Is it 2 mm from the left edge?",
        "Is there more force left over?",
        "Is it touching something on the right now?",
    ],
)
def test_other_questions_are_not_about_edges(question):
    assert edge_query(asked_text(question).words) == ""


@pytest.mark.parametrize(
    ("query", "scene", "text"),
    [
        ("check cut left.", ASIDE, "Yes, the left edge cuts it."),
        ("check cut top.", ASIDE, "No, the left edge cuts it."),
        ("check not cut top.", ASIDE, "Yes, the left edge cuts it."),
        ("check cut left.", HELD, "No, the edge of the pad does not cut it."),
        ("word cut_sides.", ASIDE, "The left edge cuts it."),
        ("calculate cut_left or cut_top.", ASIDE, "Yes, the left edge cuts it."),
        ("calculate cut_top or cut_right.", ASIDE, "No, the left edge cuts it."),
        ("check near left.", ASIDE, "Yes, it is in the top-left."),
        ("check near right.", HELD, "No, it is centered."),
        ("check cut left.", UNTOUCHED, "Nothing touches the pad."),
        ("word cut_sides.", UNTOUCHED, "Nothing touches the pad."),
    ],
)
def test_an_answer_names_the_edge_that_cuts(query, scene, text):
    assert answer(read_query(query), scene).text == text


def test_two_edges_are_both_named():
    corner = replace(HELD, state=contact(cut=frozenset({Side.LEFT, Side.TOP})))
    assert answer(read_query("word cut_sides."), corner).text == "The top and left edges cut it."
