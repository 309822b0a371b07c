"""A mass of an object is no force; two masses of one object are refused."""

import pytest

from policies.contract import read_contract
from policies.instructions.reader import read_request
from tests.fakes.contracts import peg_terms, terms

TASK = terms()


@pytest.mark.parametrize(
    "text",
    [
        "The peg is 0.15 kilos.",
        "This egg is about sixty grams, so pick it up.",
        "It weighs 20 grams, er, 25 grams.",
        "You're lifting a two-ounce egg.",
        "Lift the tomato, roughly 120 grams, with care? No, as usual.",
        "The tomato is twice as heavy as the 55 gram egg.",
    ],
)
@pytest.mark.parametrize("task", [TASK, peg_terms()], ids=["strawberry", "peg"])
def test_a_mass_leaves_the_force_to_the_task(text, task):
    contract = read_contract(text, task, {})
    assert not contract.refused
    assert contract.terms.force_n == task.force.force_n


@pytest.mark.parametrize(
    "text",
    [
        "The berry weighs 12 g and it weighs 35 g.",
        "The egg weighs 50 grams and the egg also weighs 70 grams.",
    ],
)
def test_two_masses_of_one_object_are_refused(text):
    assert "two masses" in read_contract(text, TASK, {}).refused


def test_masses_of_two_objects_are_no_contradiction():
    assert not read_contract(
        "The egg weighs 50 g, the peg weighs 100 g. Lift it.", TASK, {}
    ).refused


@pytest.mark.parametrize("text", ["My cat weighs 4 kg.", "I ate 200 g of chocolate."])
def test_a_mass_of_something_else_asks_for_nothing(text):
    assert read_contract(text, TASK, {}).refused


@pytest.mark.parametrize(
    ("text", "grams"),
    [
        ("Hold it with about 100 grams.", 100),
        ("Use 100 grams, no, 150 grams.", 150),
        ("The force on the berry is about 100 grams.", 100),
        ("The limit is 100 grams of force.", 100),
    ],
)
def test_grams_that_a_grip_is_asked_for_with_stay_a_force(text, grams):
    forces = read_request(text).numbers.forces
    assert [force.value_n for force in forces] == pytest.approx([grams * 9.80665e-3])
