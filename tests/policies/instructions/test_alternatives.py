"""Forces that are not decided are refused; a correction takes the unit of what it corrects."""

import pytest

from policies.contract import read_contract
from tests.fakes.contracts import terms
from tests.policies.instructions.test_quantities import forces


@pytest.mark.parametrize(
    "text",
    [
        "0.5 or 1 N",
        "half a newton or one",
        "1 N or 0.5",
        "either 0.5 N or 0.8 N",
        "hold it with 0.5 N or maybe 1 N",
        "0.5, 0.7 or 1 N",
        "if it does not slip use 0.5 N, otherwise 0.7 N",
        "would 1 N be ok? if not use 0.7",
    ],
)
def test_an_alternative_is_refused(text):
    assert "exclude each other" in read_contract(text, terms(), {}).refused


def test_forces_that_are_nearly_the_same_are_no_alternative():
    contract = read_contract("do 0.6 or 0.7 N", terms(), {})
    assert contract.force_n is not None
    assert contract.force_n.middle == pytest.approx(0.65)


@pytest.mark.parametrize(
    "text", ["start with 0.5 N, no wait, 0.8", "0.5 N, sorry, 0.8", "1 N, better 0.8"]
)
def test_a_correction_without_a_unit_is_the_force(text):
    assert forces(text) == [("value", 0.8)]


@pytest.mark.parametrize(
    "text",
    [
        "lower the limit to 1 N",
        "i don't care about the force, just not above 1 N",
        "I do not mind, never above 1 N",
        "I'd prefer it if the force stayed below 1 N",
        "should you need more than 1 N, stop",
        "if it slips go up to 1 N",
        "increase to 1 N only if needed",
        "once 1 N is reached, stop",
    ],
)
def test_no_bound_is_turned_round(text):
    assert forces(text) == [("most", 1.0)]


@pytest.mark.parametrize("text", ["hold it with 1 N but 20 % less", "1 N, half as hard"])
def test_a_force_beside_a_change_of_it_is_refused(text):
    assert "and a change" in read_contract(text, terms(), {}).refused
