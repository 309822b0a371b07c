"""Another time, place or finger than those of this touch."""

import pytest

from tacgrasp.lessons.dialogue.rules.elsewhere import of_elsewhere
from tacgrasp.lessons.understanding import understood_by_grammar


@pytest.mark.parametrize(
    ("question", "subject"),
    [
        ("How firm was the grip two days ago?", "past"),
        ("What was the largest contact area of last Tuesday?", "past"),
        ("Had the previous piece sunk in deeper?", "past"),
        ("How deep will it be in half an hour?", "future"),
        ("Will the next part weigh more than this?", "future"),
        ("Will the box be dented by Friday?", "future"),
        ("Does it stay there, or will it have slipped in twenty minutes?", "future"),
        ("Roughly what will the area be tomorrow?", "future"),
        ("Will it be crushed later?", "future"),
        ("How long until it slips?", "future"),
        ("And how soon does it fall?", "future"),
        ("Is the gel worn out?", "trait"),
        ("Has the sensor got dirty?", "trait"),
        ("Is there some dust on your pad?", "trait"),
        ("How large is the contact area on the opposing jaw?", "elsewhere"),
        ("And at the second finger, how many newtons?", "elsewhere"),
        ("How far is the gripper above the bench?", "surroundings"),
        ("Are there several contact points?", "surroundings"),
        ("Do you feel a second touch?", "surroundings"),
        ("Is it touching the gel in two different places?", "surroundings"),
        ("How many weeks has it been lying in the hand?", "age"),
        ("When was the sensor last calibrated?", "age"),
    ],
)
def test_another_time_place_or_finger_is_not_felt(question, subject):
    assert understood_by_grammar(question).query == f"unknown {subject}."


@pytest.mark.parametrize(
    "question",
    [
        "I was hired last month; how deep is it?",
        "The other finger presses as hard. What is the sum of both, in N?",
        "How many N are we off the opposite pad edge?",
        "Will it rain next week?",
        "In ten minutes I must leave: what is the force?",
    ],
)
def test_a_time_or_a_place_beside_a_question_changes_nothing(question):
    assert of_elsewhere(question) is None


@pytest.mark.parametrize(
    "question",
    [
        "Did the force ever go above 4 N?",
        "Was the limit respected during the whole shift?",
        "Can we guarantee it never exceeded 3 N?",
        "Has the force always been above 2 N?",
        "Can the witness confirm that the force did not exceed 4 newtons at any time?",
        "How many times did you squeeze it?",
    ],
)
def test_one_frame_tells_nothing_of_before(question):
    assert understood_by_grammar(question).query == "unknown past."


@pytest.mark.parametrize(
    ("question", "query"),
    [
        ("Has the never-exceed force been exceeded?", "calculate force_n > limit_n."),
        (
            "Have we gone past the force that must never be passed?",
            "check force over.",
        ),
    ],
)
def test_a_bound_that_is_never_passed_is_none_of_the_past(question, query):
    assert understood_by_grammar(question).query == query
