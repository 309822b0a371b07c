"""Questions whether a step is the one that is advised."""

from dataclasses import replace

import pytest

from tacgrasp.lessons.answering import answered
from tacgrasp.lessons.dialogue.rules.advised import advised, is_step_advised
from tacgrasp.lessons.understanding import understood_by_grammar
from tests.fakes.question_scenes import ASIDE, HELD, LIGHT

MOVES = "action in ['move_up', 'move_down', 'move_left', 'move_right']"


@pytest.mark.parametrize(
    ("question", "truth"),
    [
        ("Would you advise lifting now?", "action == 'lift'"),
        ("Is the next step a move of some sort?", MOVES),
        ("Do you want me to shift it sideways?", "action in ['move_left', 'move_right']"),
        ("Are you telling me to squeeze harder?", "action == 'increase_force'"),
        ("Do you recommend easing off?", "action == 'decrease_force'"),
        ("Is letting go and starting over what you suggest?", "action == 'reset'"),
        ("Is your next step anything other than lifting?", "not (action == 'lift')"),
        ("Don't you suggest moving to the left?", "action == 'move_left'"),
    ],
)
def test_the_step_that_is_named_is_compared_with_the_advice(question, truth):
    assert advised(question).truth == truth


def test_the_answer_says_what_is_advised():
    read = understood_by_grammar("Would you advise lifting now?")
    assert answered(read, HELD).answer.text == "Yes, the advice is to lift it."
    assert answered(read, LIGHT).answer.text == "No, the advice is to increase the force."
    moved = understood_by_grammar("Is the recommended step a move?")
    assert answered(moved, ASIDE).answer.text.startswith("Yes, the advice is to move")


def test_one_of_two_steps_or_another_is_chosen():
    read = understood_by_grammar("Hold, lift or something else?")
    assert answered(read, HELD).answer.value == "lift"
    assert answered(read, LIGHT).answer.value == "something else"
    assert not answered(read, replace(HELD, contract=None)).answer.decidable


@pytest.mark.parametrize(
    ("question", "chosen"),
    [
        ("Next step: squeeze more, squeeze less, or neither?", "squeeze more"),
        ("Should I grip harder, ease off, or leave the squeeze alone?", "grip harder"),
        ("Lift now or not yet: what do you advise?", "not yet"),
        ("Which way must it travel next: left, right, up, down or nowhere?", "nowhere"),
    ],
)
def test_a_step_is_chosen_by_the_questions_own_words(question, chosen):
    assert answered(understood_by_grammar(question), LIGHT).answer.value == chosen


def test_should_i_move_is_a_yes_or_a_no():
    read = understood_by_grammar("Should I shift the gripper?")
    assert answered(read, ASIDE).answer.text.startswith("Yes, the advice is to move")
    assert answered(read, HELD).answer.text == "No, the advice is to lift it."
    assert understood_by_grammar("Does it lie to the left?").query == "check left."


@pytest.mark.parametrize(
    "question", ["Should I squeeze harder?", "What do you advise?", "Is it deep?", "Lift or not?"]
)
def test_other_questions_are_left_to_others(question):
    assert advised(question) is None


def test_a_step_with_a_number_or_a_condition_is_none():
    assert is_step_advised("move left by 2 mm?") is None
    assert is_step_advised("lift if it is deep?") is None
