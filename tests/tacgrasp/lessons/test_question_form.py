"""A question's form speaks against queries of another kind."""

import pytest

from tacgrasp.lessons.question_form import is_unlikely, with_number_before


@pytest.mark.parametrize(
    ("question", "query"),
    [
        ("is the whole contact inside the pad", "choice wholeness."),
        ("does it use more than half of the limit", "amount limit N."),
        ("is it a sphere or a ring", "word shape."),
        ("what is the next action to dispatch", "why step."),
        ("is it deep", "amount depth mm; word shape."),
        ("how many parts in a hundred are covered", "check whole."),
        ("where on the pad has it landed", "check cut."),
        ("centered - does that word describe the contact", "word position."),
    ],
)
def test_another_kind_of_answer_is_unlikely(question, query):
    assert is_unlikely(question, query)


@pytest.mark.parametrize(
    ("question", "query"),
    [
        ("is the whole contact inside the pad", "check whole."),
        ("is it a sphere or a ring", "choice shape."),
        ("could you kindly tell me the depth", "amount depth mm."),
        ("is it red", "unknown color."),
        ("is it round, and how deep is it", "check shape sphere; amount depth mm."),
        ("on what grounds do you say so", "why step."),
        ("what is the depth", "amount depth mm."),
        ("depth", "check depth deep."),
        ("what is the verdict: is it within the band", "check force within."),
        ("which is it, over or under two newtons", "check force > #1 N."),
        ("what about the band", "check force within."),
        ("how deep is it, and is it round", "amount depth mm; check shape sphere."),
        ("", "other."),
    ],
)
def test_what_fits_or_is_not_told_stays(question, query):
    assert not is_unlikely(question, query)


@pytest.mark.parametrize(
    ("question", "asked"),
    [
        ("Anything above 2.5 newtons worries me. Is the grip over that?", "2.5 newtons"),
        ("It cracks past 0.8 mm, so are we beyond that figure now?", "0.8 mm"),
    ],
)
def test_that_is_the_number_which_was_told_before(question, asked):
    assert with_number_before(question).endswith(f"{asked}?")


@pytest.mark.parametrize(
    "question",
    [
        "Is the grip over that?",
        "It weighs 30 g and the limit is 2 N. Are we over that?",  # which of both?
        "Is 2 N fine, or is the grip over 3 N?",
    ],
)
def test_of_none_or_two_numbers_that_is_neither(question):
    assert with_number_before(question) == ""
