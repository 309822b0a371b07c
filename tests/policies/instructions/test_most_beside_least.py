"""A number that is said beside a least force is never passed, whatever it was said for."""

from __future__ import annotations

from itertools import product

import pytest

from policies.contract import read_contract
from tests.fakes.contracts import terms

LEASTS = ("at least 0.5 N", "0.5 newtons at the minimum", "minimum 0.5 N", "no less than 500 mN")
LINKS = (" and ", ", ", ". ", " then ")
NUMBERS = {"0.7": 0.7, "1": 1.0, "0.7 N": 0.7, "700 mN": 0.7}


@pytest.mark.parametrize(
    "most",
    [
        "{} at the maximum",
        "{} tops",
        "{} as the ceiling",
        "{} absolute max",
        "never {}",
        "do not go past {}",
        "cap it at {}",
        "peak {}",
        "{} peak",
        "{} is the limit",
        "{} is the most it can take",
        "{} at worst",
        "{} in the worst case",
        "{} for the hard stop",
        "{} when it slips",
    ],
)
def test_no_limit_lies_above_a_number_beside_a_least(most: str) -> None:
    task = terms()
    for least, link, (said, most_n) in product(LEASTS, LINKS, NUMBERS.items()):
        text = least + link + most.format(said)
        held = read_contract(text, task, {})
        assert held.refused or held.terms.limit_n <= most_n, (text, held.terms.limit_n)


@pytest.mark.parametrize(
    "text",
    [
        "P0: force never under 1.55 N",
        "Take berry number 3, and mind that less than 1.4 N isn't allowed.",
        "Slip was logged at 0.35 N on runs 4 through 9, so stay above that",
    ],
)
def test_a_number_that_counts_is_no_force(text: str) -> None:
    assert not read_contract(text, terms(), {}).refused


def test_a_force_that_is_denied_above_a_least_is_the_most() -> None:
    held = read_contract("Use at least 0.5 N and never 0.7 N.", terms(), {})
    assert held.terms.limit_n == pytest.approx(0.99 * 0.7)
    assert any("0.7 N" in note and "limit" in note for note in held.assumed)
