"""A dialogue about one scene: facts that are told, doubts, premises, and what comes first."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import pytest

from tacgrasp.lessons.dialogue.scene import AskedScene, band_contract
from tacgrasp.lessons.turns.dialogue import Dialogue
from tacgrasp.lessons.turns.turn import next_turn
from tests.fakes.question_scenes import HELD


class Refusing:
    """A model that must not be asked for a query."""

    width = 8

    def reply_to(self, touch, prompt, *, grammar):
        pytest.fail(f"the model was asked {prompt!r}", pytrace=False)  # a grammar's repr is endless


@pytest.fixture
def talk():
    """Begins a dialogue about a state that is felt."""

    def begin(state=HELD.state, *, mass_g=None, shape=0.7):
        scene = AskedScene(state=state, contract=band_contract(0.6, 1.0, 1.3), mass_g=mass_g)
        ends = {"depth_mm": (0.15, 0.25), "force_n": (0.5, 1.4)}
        talk = Dialogue(partial(next_turn, Refusing()), scene, {"shape": shape}, ends)
        return lambda *lines: [talk.ask(line).answer.text for line in lines][-1]

    return begin


def test_a_mass_that_is_told_counts_from_then_on(talk):
    ask = talk()
    assert ask("Will it slip?") == "I can't say: no mass is given."
    assert ask("Why?") == "Because no mass is given."
    assert ask("The object weighs 60 g.") == "Noted: the object weighs 60 g."
    assert ask("Will it slip?").startswith("Yes")
    assert ask("What is the mass?") == "60 g."


def test_what_is_told_with_a_question_counts_afterwards_too(talk):
    ask = talk()
    assert "above" in ask("My band is 0.2 to 0.5 N. Is it safe to lift?")
    assert "above" in ask("Is it safe to lift?")


def test_a_question_behind_a_comma_is_answered(talk):
    ask = talk()
    said = ask("the wafer cracks at about 0.8 N, are we still below that force")
    assert said == "No, probably: the force is 0.83 N."
    assert ask("it weighs 20 g, will it slip").startswith("No")
    assert ask("it weighs 30 g, it is glass") == "Noted: the object weighs 30 g."


def test_a_band_behind_if_counts_for_that_question_alone(talk):
    ask = talk()
    assert "below" in ask("If the band is 2 to 3 N, is it safe to lift?")
    assert "within" in ask("Is it safe to lift?")


def test_a_limit_below_the_band_leaves_no_band(talk):
    ask = talk()
    assert ask("The limit is 0.8 N.") == (
        "Noted: the limit is 0.8 N, and the band above it no longer counts."
    )
    assert ask("Are we over it?") == "Yes, probably: the force is 0.83 N."
    assert ask("Is it safe to lift?") == "I can't say: no force band is given."
    assert ask("The limit is 0 N.").startswith("I can't take that: ")


@pytest.mark.parametrize("told", ["The band is 0 to 0 N.", "The band is 1 to 0 N."])
def test_a_band_that_ends_at_nothing_is_refused_and_changes_nothing(talk, told):
    ask = talk()
    assert ask(told).startswith("I can't take that: ")
    assert ask("What is the band?") == (
        "The least force wanted is 0.60 N; the most force wanted is 1.00 N."
    )


def test_how_sure_an_answer_is_is_told_by_its_interval_or_chances(talk):
    ask = talk()
    assert ask("How deep is it?", "Are you sure?").startswith("In nine cases of ten it is between")
    assert ask("What shape is it?", "How sure are you?").startswith("About 70 % sure: it is")
    assert ask("What range could the force have?").endswith(" N.")
    assert ask("How confident are you in the shape?").startswith("About 70 % sure: it is")
    assert ask("Are you sure about the shape?").startswith("About 70 % sure: it is")
    assert talk()("How sure are you?").startswith("About 70 % sure: it is")
    text = ask("How certain are you that it isn't a cube?")
    assert text == "About 70 % sure that the answer is yes."


def test_a_description_is_no_surer_than_its_shape(talk):
    assert talk()("Describe it.").startswith("A ")
    assert talk(shape=0.5)("Describe it.").startswith("Probably a ")


@pytest.mark.parametrize(
    ("question", "text"),
    [
        ("Why is the force over the limit?", "It is not so: the force is 0.83 N."),
        ("Why is it so rough?", "It is not so: the surface is "),
    ],
)
def test_a_reason_for_what_is_not_so_is_refused(talk, question, text):
    assert talk()(question).startswith(text)


def test_a_yes_to_a_lift_says_what_comes_first(talk):
    aside = replace(HELD.state, x_mm=6.5)
    assert "but move right first: it is off center" in talk(aside)("Should I lift it?")
    assert "first" not in talk(aside)("Is the force within the band?")


@pytest.mark.parametrize(
    ("changes", "text"), [({"force_n": 0.3}, "0.30 N."), ({"x_mm": 6.0, "y_mm": 0.0}, "6.0 mm.")]
)
def test_how_much_a_step_of_the_advice_lacks_is_told(talk, changes, text):
    ask = talk(replace(HELD.state, **changes))
    assert ask("What next?", "By how much?").removeprefix("About ") == text


def test_why_there_is_no_answer_is_told(talk):
    ask = talk()
    assert ask("What does it cost?", "Why?") == (
        "Because the touch of one fingertip does not tell it."
    )


def test_a_supposed_limit_or_mass_counts_for_its_own_question_alone(talk):
    ask = talk(mass_g=100.0)
    over = "If the limit is 0.7 N, are we over it?"
    assert ask(over).startswith("Yes")
    assert ask("Is it above the limit?").startswith("No")
    assert ask("If it weighs 5 g, will it slip?").startswith("No")
    assert ask("Will it slip?").startswith("Yes")


@pytest.mark.parametrize(
    ("questions", "unit"),
    [
        (("How deep is it?", "What is twice the force?"), " N."),
        (("How deep is it?", "What is twice the depth?"), " mm."),
        (("What is the ratio of force to limit?", "What is twice the force?"), " N."),
    ],
)
def test_a_multiple_of_a_quantity_that_it_names_is_not_of_the_one_before(talk, questions, unit):
    assert talk()(*questions).endswith(unit)
