"""The automata of all families are a gigabyte: other tests run without them."""

import gc
from collections.abc import Iterator

import pytest

from tacgrasp.lessons.dialogue.families.catalogue import FAMILIES


@pytest.fixture(scope="package", autouse=True)
def _forgotten_automata() -> Iterator[None]:
    yield
    for family in FAMILIES:
        family.__dict__.pop("automaton", None)
    gc.collect()
