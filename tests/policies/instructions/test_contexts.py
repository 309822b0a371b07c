"""A manner or a force means the same whatever stands around it."""

from pathlib import Path

import pytest

from policies.contract import read_contract
from primitives.contract import Contract
from tacgrasp.config.layers import load
from tacgrasp.config.terms import task_terms

CONTEXTS = Path(__file__).with_name("contexts.txt").read_text().splitlines()
TASK = task_terms(load("strawberry")[0])
USUAL_N = TASK.force.force_n.high


def contracts(phrase: str) -> list[tuple[str, Contract]]:
    texts = [context.format(phrase) for context in CONTEXTS]
    return [(text, read_contract(text, TASK, {})) for text in texts]


@pytest.mark.parametrize("manner", ["gently", "with a light touch"])
def test_a_soft_manner_is_softer_in_every_context(manner: str) -> None:
    said = contracts(manner)
    assert [text for text, c in said if c.refused or c.terms.force_n.high >= USUAL_N] == []


@pytest.mark.parametrize("manner", ["firmly", "with a firm grip"])
def test_a_firm_manner_is_firmer_in_every_context(manner: str) -> None:
    said = contracts(manner)
    assert [text for text, c in said if c.refused or c.terms.force_n.high <= USUAL_N] == []


@pytest.mark.parametrize("limit", ["with at most 0.9 N", "below 0.9 N"])
def test_a_most_is_never_passed_in_any_context(limit: str) -> None:
    said = contracts(limit)
    assert [text for text, c in said if not c.refused and c.terms.limit_n > 0.93] == []
    assert sum(bool(c.refused) for _, c in said) <= 2


def test_a_force_is_held_in_every_context() -> None:
    said = contracts("with 0.9 N")
    assert [text for text, c in said if not c.refused and 0.9 not in c.terms.force_n] == []
    assert sum(bool(c.refused) for _, c in said) <= 2
