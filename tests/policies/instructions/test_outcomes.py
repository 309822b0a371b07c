"""What became of an earlier grip bounds the next one: it slipped below, it bruised above."""

import pytest

from policies.contract import read_contract
from tests.fakes.contracts import terms
from tests.policies.instructions.test_quantities import forces

SLIPPED = (
    "it {slip} at 0.5 N",
    "with 0.5 N it {slip}",
    "at 0.5 N the berry {slip}",
    "last time it {slip} with 0.5 N",
    "it {slip} when I used 0.5 N",
    "we used 0.5 N and it {slip}",
    "squeeze more, it {slip} at 0.5 N",
)
SLIPS = (
    "slips",
    "slipped",
    "has slipped",
    "was slipping",
    "would slip",
    "fell",
    "slid away",
    "got away",
    "came loose",
)
HURT = (
    "it {hurt} at 2 N",
    "with 2 N it {hurt}",
    "at 2 N the skin {hurt}",
    "the last one {hurt} with 2 N",
    "it {hurt} when we applied 2 N",
    "it {hurt} after 2 N",
)
HURTS = (
    "cracks",
    "cracked",
    "has cracked",
    "was crushed",
    "got bruised",
    "would burst",
    "came apart",
    "left juice and marks",
    "deformed",
)


def test_a_force_at_which_it_slipped_is_a_least_in_every_tense():
    texts = [pattern.format(slip=slip) for pattern in SLIPPED for slip in SLIPS]
    assert [text for text in texts if forces(text) != [("least", 0.5)]] == []


def test_a_force_that_did_harm_is_a_most_in_every_tense():
    texts = [pattern.format(hurt=hurt) for pattern in HURT for hurt in HURTS]
    assert [text for text in texts if forces(text) != [("most", 2.0)]] == []


@pytest.mark.parametrize(
    "text",
    [
        "it did not slip at 0.5 N",
        "nothing slipped at 0.5 N",
        "use 0.5 N so that it does not slip",
        "use 0.5 N because it slipped yesterday",
        "it slipped, use 0.5 N",
        "it slipped twice. Hold it with 0.5 N.",
        "hold the fallen berry with 0.5 N",
        "grip the berry that fell over with 0.5 N",
        "the force fell to 0.5 N",
    ],
)
def test_a_slip_at_no_force_or_denied_bounds_nothing(text):
    assert forces(text) == [("value", 0.5)]


def test_of_several_outcomes_the_narrowest_counts():
    assert forces("it slipped between 0.4 and 0.5 N") == [("least", 0.5)]
    assert forces("it cracked at 1.5 to 2 N") == [("most", 1.5)]
    contract = read_contract("it slipped at 0.4 N and at 0.5 N, and cracked at 2 N", terms(), {})
    assert contract.force_n is not None
    assert contract.force_n.low == pytest.approx(0.5)
    assert contract.limit_n == pytest.approx(0.99 * 2)


@pytest.mark.parametrize(
    "text",
    [
        "it slipped at 0.5 N, use 0.4 N",
        "it cracked at 2 N, use 2.5 N",
        "last time 2 N was too much, use 3 N",
        "yesterday 2 N bruised it, hold it with 3 N",
    ],
)
def test_a_force_against_an_outcome_is_refused(text):
    assert "exclude each other" in read_contract(text, terms(), {}).refused


def test_a_force_that_only_did_not_work_is_not_used():
    refused = read_contract("0.5 N did not work", terms(), {}).refused
    assert "what not to hold with (0.5 n did not work)" in refused


@pytest.mark.parametrize(
    "said", ["it cracked at {} N", "the gripper can do {} N", "it can take {} N"]
)
def test_what_is_told_raises_no_limit(said):
    plain, none = (read_contract(text, terms(), {}) for text in ("hold it with 1 N", "hold it"))
    told = read_contract(f"hold it with 1 N, {said.format(9)}", terms(), {})
    assert told.limit_n == plain.limit_n
    assert none.limit_n is not None
    alone = read_contract(said.format(1.3 * none.limit_n), terms(), {})
    assert alone.limit_n == none.limit_n
