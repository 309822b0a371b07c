"""What stands between a denial and what it denies does not end it."""

import itertools

import pytest

from policies.contract import read_contract
from tacgrasp.config.layers import load
from tacgrasp.config.terms import task_terms

TASK = task_terms(load("strawberry")[0])

DENIALS = ["Never", "Please don't", "You must not", "At no time", "I do not want you to"]
BETWEEN = [
    ", whatever happens,",
    ", not even by accident,",
    ", since it bruises,",
    ", darling robot,",
    " (and I mean it)",
    " - repeat -",
    ", in my view,",
]
LIMITS = ["use more than 0.9 N", "go over 0.9 N", "squeeze with a force higher than 0.9 N"]
LEAST = ["use less than 0.9 N", "go below 0.9 N", "hold it with under 0.9 N"]
FIRM = ["grip it hard", "squeeze it with all your strength", "hold it tightly"]


@pytest.mark.parametrize(("denial", "between"), list(itertools.product(DENIALS, BETWEEN)))
def test_a_denial_reaches_over_what_is_put_in(denial: str, between: str) -> None:
    for order in LIMITS:
        contract = read_contract(f"{denial}{between} {order}.", TASK, {})
        assert contract.refused or contract.limit_n <= 0.9, order
    for order in LEAST:
        contract = read_contract(f"{denial}{between} {order}.", TASK, {})
        assert contract.refused or contract.force_n.low >= 0.9, order
    for order in FIRM:
        contract = read_contract(f"{denial}{between} {order}.", TASK, {})
        assert contract.refused or contract.force_n.high <= 2.5, order


@pytest.mark.parametrize(
    ("text", "is_firm"),
    [
        ("Don't worry, my friend, hold it firmly.", True),
        ("Do not drop it, whatever happens, hold it firmly.", True),
        ("Why not, my dear, hold it firmly?", True),
        ("It is not ripe, so they say, hold it firmly.", True),
        ("Do not, I repeat, do not grip it hard.", False),
        ("Not hard, please, use a soft grip.", False),
        ("It's not for me, it's for my mum, hold it gently.", False),
    ],
)
def test_what_a_denial_has_ended_with_is_not_denied(text: str, is_firm: bool) -> None:
    contract = read_contract(text, TASK, {})
    assert not contract.refused
    assert (contract.force_n.high > 2.5) == is_firm


def test_a_forbidden_touch_is_refused_with_something_put_in() -> None:
    assert read_contract("Do not, I beg you, touch it.", TASK, {}).refused
