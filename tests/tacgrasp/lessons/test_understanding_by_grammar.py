"""Questions whose wording the grammar has are read by it, and the model is not asked."""

import pytest

from tacgrasp.lessons.understanding import answered, understood, understood_in_turn
from tests.fakes.question_scenes import HELD


class Refusing:
    """A model that must not be asked."""

    width = 8

    def reply_to(self, touch, prompt, *, grammar):
        raise AssertionError(f"the model was asked {prompt!r}")


@pytest.mark.parametrize(
    ("question", "query"),
    [
        ("Should I squeeze more?", "check force below."),
        ("Is it a strawberry?", "unknown name."),
        ("How warm is it?", "unknown temperature."),
        ("Is it round?", "check shape sphere."),
        ("How heavy a berry could you hold?", "amount holds g."),
        ("Will it bruise?", "check force over."),
        ("Is it slippery?", "unknown trait."),
        ("Should I move left or right?", "choice action."),
        ("Is the object off to one side?", "check not position centered."),
        ("Is something wrong?", "check not force within."),
        ("Do I have to press harder to hold 60 g?", "check slips #1 g."),
        ("Is 0.3 N too little?", "check band_low > #1 N."),
        ("How many newtons do I need to lift it?", "amount band_low N."),
        ("Is there room to squeeze harder?", "check force under."),
        ("How deep is it, in microns?", "amount depth µm."),
        ("Is the force above half a newton?", "check force > #1 N."),
    ],
)
def test_a_wording_of_the_grammar_means_what_the_grammar_says(question, query):
    read = understood(Refusing(), question)
    assert read.query == query
    assert read.confidence == 1.0


def test_a_doubt_of_the_answer_before_asks_for_its_reason():
    read = understood_in_turn(Refusing(), "Are you sure?", "Is it a sphere?")
    assert read.query == "why shape."


def test_a_follow_up_of_the_grammar_is_read_behind_its_question():
    read = understood_in_turn(Refusing(), "And in microns?", "How deep is it?")
    assert read.query == "amount depth µm."


def test_another_wording_is_put_to_the_model():
    with pytest.raises(AssertionError, match="the model was asked 'does it fancy a waltz'"):
        understood(Refusing(), "Does it fancy a waltz?")


@pytest.mark.parametrize(
    ("question", "query"),
    [
        (
            "Is the force about 0.8 N and is it round?",
            "check force about #1 N; check shape sphere.",
        ),
        ("Is it rough, and how deep is it?", "check texture rough; amount depth mm."),
        ("Is it deep? Is it round?", "check depth deep; check shape sphere."),
        ("Is the contact small and shallow?", "check area small; check depth slight."),
        ("Is it above 0.5 N and below 1 N?", "check force > #1 N; check force < #2 N."),
        (
            "How deep is it, how hard is it pressed and what shape is it?",
            "amount depth mm; amount force N; word shape.",
        ),
        ("How deep is it, and how deep is it?", "amount depth mm."),
        ("Is it deep, please?", "check depth deep."),
    ],
)
def test_joined_wordings_are_asked_together(question, query):
    assert understood(Refusing(), question).query == query


@pytest.mark.parametrize(
    "question",
    [
        "Is it red and round?",  # the first is not felt
        "Is it soft and ripe?",
        "How deep is it? And why?",
        "Tell me x and y, is it round, is it deep, is it rough, and is it centered?",  # six
        "How deep is it, " * 12,
        "and",
        ", ",
    ],
)
def test_what_is_joined_with_something_else_is_left_to_the_model(question):
    with pytest.raises(AssertionError, match="the model was asked"):
        understood(Refusing(), question)


@pytest.mark.parametrize(
    ("question", "force_n", "text"),
    [
        ("Is the force about 0.8 N?", 0.83, "Yes, the force is 0.83 N."),
        ("Is it 0.7 N or thereabouts?", 0.83, "No, the force is 0.83 N."),
        ("Are we at about half a newton?", 0.83, "No, the force is 0.83 N."),
    ],
)
def test_about_a_number_is_within_a_tenth_of_it(question, force_n, text):
    assert HELD.state.force_n == force_n
    assert answered(understood(Refusing(), question), HELD).answer.text == text
