"""Whatever a person types is read in time, and never read into more than a contract allows."""

import gc
import re
import time
from collections.abc import Iterator
from importlib import resources

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from policies.contract import read_contract
from policies.force_terms import MOST_OF_TASK
from primitives.contract import Contract
from tests.fakes.contracts import peg_terms, terms

TASKS = (terms(), peg_terms())
LONGEST = 500
WITHIN_S = 0.5

WORDS = sorted(
    set(
        re.findall(
            r"[a-z']+", (resources.files("policies.instructions") / "words.txt").read_text("utf-8")
        )
    )
)
PIECES = [
    "0.5",
    "1",
    "2.5",
    "20",
    "500",
    "N",
    "newtons",
    "mN",
    "grams",
    "of",
    "force",
    "kPa",
    "mm",
    "%",
    "twice",
    "half",
    "one",
    "hundred",
    "point",
    "at",
    "most",
    "least",
    "no",
    "more",
    "than",
    "never",
    "not",
    "above",
    "below",
    "between",
    "and",
    "to",
    ",",
    ".",
    ";",
    ":",
    "?",
    "!",
    "±",
    "1,5",
    "1e3",
    "0",
    "-1",
    "inf",
    "nan",
    "<=",
    ">=",
    "[",
    "]",
    "(",
    ")",
    "2/3",
    "½",
    "1/0",
    "hold",
    "it",
    "the",
    "strawberry",
    "gently",
    "firmly",
    "don't",
]
salad = st.lists(st.sampled_from(PIECES) | st.sampled_from(WORDS), max_size=120).map(" ".join)
repeated = st.builds(
    lambda word, gap: (word + gap) * LONGEST,
    st.sampled_from(PIECES),
    st.sampled_from(["", " ", ", "]),
)


@pytest.fixture(autouse=True, scope="module")
def reading_alone_counts() -> Iterator[None]:
    """What the first reading of a process compiles is no reading's time, nor is a collection."""
    for task in TASKS:
        read_contract("Hold it with 1 N.", task, {})
    gc.disable()
    yield
    gc.enable()


def read(text: str) -> list[Contract]:
    """Contracts of a text for both tasks, each of which must stand on its own."""
    contracts = []
    for task in TASKS:
        began_s = time.thread_time()
        contract = read_contract(text, task, {})
        assert time.thread_time() - began_s < WITHIN_S
        assert (contract.force_n is None) == (contract.limit_n is None) == bool(contract.refused)
        if not contract.refused:
            band, limit_n = contract.terms.force_n, contract.terms.limit_n
            assert 0 < band.low <= band.high <= limit_n
            assert band.middle <= MOST_OF_TASK * task.force.limit_n * 1.001
            assert limit_n >= task.least_n
        contracts.append(contract)
    return contracts


@given(st.text(max_size=LONGEST))
def test_any_text_at_all_becomes_a_contract_or_a_refusal_in_time(text):
    read(text)


@example("one strawberry " * 40)  # cut within a word
@settings(max_examples=200)
@given(salad | repeated)
def test_any_salad_of_its_own_words_becomes_a_contract_or_a_refusal_in_time(text):
    read(text[:LONGEST])


@given(salad)
def test_the_same_words_mean_the_same_however_often_they_are_read(text):
    assert read(text) == read(text)


@pytest.mark.parametrize("text", ["", " ", "\n\t", "...", "?!", "---", "\u200b", "42", "1 2 3"])
def test_a_text_without_words_is_refused(text):
    assert all(contract.refused for contract in read(text))


@pytest.mark.parametrize("number", ["1e309", "9" * 12, "infinite", "-1", "0"])
def test_a_force_that_no_grip_can_have_is_refused(number):
    assert all(contract.refused for contract in read(f"Hold it with {number} N."))
