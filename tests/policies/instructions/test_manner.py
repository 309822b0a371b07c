"""Manner: softer or firmer than the task, by words, their denials and comparisons."""

import pytest

from policies.contract import read_contract
from tests.fakes.contracts import peg_terms, terms

TASK = terms()
USUAL_N = TASK.force.force_n.middle
NOTICED = 0.15
"""Least change of the middle of the band that counts as another manner."""


def middle_n(text: str) -> float:
    contract = read_contract(text, TASK, {})
    assert not contract.refused, (text, contract.refused)
    return contract.terms.force_n.middle


@pytest.mark.parametrize(
    "text",
    [
        "Hold it gently.",
        "Take the strawberry very softly, please.",
        "Lift the berry with a light touch.",
        "Grip it as gently as you can.",
        "Do not squeeze it hard.",
        "Don't hold it firmly.",
        "Never grip the fruit tightly.",
        "Hold it without squeezing hard.",
        "Hold it a bit softer than usual.",
        "Use less force here than usual.",
        "Hold it not as firmly as before.",
        "It is very fragile, so pick it with great care.",
        "It is too soft for a firm grip.",
        "Too delicate to grip hard.",
        "Do not, I say, do not hold it firmly.",
    ],
)
def test_gentle_words_lower_the_middle_of_the_band(text):
    assert middle_n(text) <= (1 - NOTICED) * USUAL_N


@pytest.mark.parametrize(
    "text",
    [
        "Hold it firmly.",
        "Grip the strawberry tightly.",
        "Take a strong grip on it.",
        "Do not be gentle.",
        "Don't hold it loosely.",
        "Never hold the berry too lightly.",
        "Hold it a little firmer than usual.",
        "Squeeze harder than usual.",
        "Use more force here than usual.",
        "Hold it firmly, not gently.",
        "It is too slippery for a gentle grip.",
    ],
)
def test_firm_words_raise_the_middle_of_the_band(text):
    assert middle_n(text) >= (1 + NOTICED) * USUAL_N


@pytest.mark.parametrize(
    "text",
    [
        "Pick the strawberry.",
        "Please lift the berry now.",
        "Could you pick up the fruit?",
        "Grasp the one on the left and hold it.",
        "Hold the frobnicated strawberry.",
        "As usual.",
        "Neither harder nor softer than usual.",
        "Neither too hard nor too soft.",
        "Not too hard, not too soft.",
    ],
)
def test_words_without_manner_leave_the_band_to_the_task(text):
    assert read_contract(text, TASK, {}).terms == TASK.force


@pytest.mark.parametrize("task", [terms(), peg_terms()], ids=["strawberry", "peg"])
def test_manner_is_relative_to_the_task(task):
    gently, firmly = (
        read_contract(text, task, {}).terms.force_n
        for text in ("Hold it gently.", "Hold it firmly.")
    )
    assert gently.middle < task.force.force_n.middle < firmly.middle
    assert gently.middle / task.force.force_n.middle == pytest.approx(
        read_contract("Hold it gently.", TASK, {}).terms.force_n.middle / USUAL_N
    )


def test_emphasis_goes_further_than_plain_manner():
    assert middle_n("Hold it very gently.") < middle_n("Hold it gently.")
    assert middle_n("Hold it very firmly.") > middle_n("Hold it firmly.")


@pytest.mark.parametrize("text", ["Hold it firmly but gently.", "Grip it hard and softly."])
def test_both_manners_at_once_are_refused_by_name(text):
    refused = read_contract(text, TASK, {}).refused
    assert "both" in refused


@pytest.mark.parametrize(
    ("wrong", "right"),
    [("Hold it genlty.", "Hold it gently."), ("Hold it firmyl.", "Hold it firmly.")],
)
def test_a_slip_of_the_keyboard_changes_nothing(wrong, right):
    assert middle_n(wrong) == middle_n(right)


@pytest.mark.parametrize(
    "text",
    [
        "You needn't be gentle, the usual will do.",
        "It isn't delicate; the normal grip will do.",
        "Be delicate with it; actually, forget delicate, just do it the usual way.",
        "Grip it hard. Whoops.",
        "Use moderate force.",
        "I bought six strawberries at the market; pick one up.",
    ],
)
def test_what_asks_for_the_usual_leans_neither_way(text):
    contract = read_contract(text, TASK, {})
    assert contract.terms == TASK.force
    assert contract.lean == read_contract("Pick the strawberry.", TASK, {}).lean
