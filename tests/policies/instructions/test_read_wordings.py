"""Wordings that the rules have been held against stay read as they should be.

They are no measure of the reader: the rules were changed until they passed. The measure is
``tacgrasp eval instructions`` on wordings that were kept out.
"""

from pathlib import Path

import pytest

from tacgrasp.config.layers import load
from tacgrasp.config.terms import task_terms
from tacgrasp.lessons.instruction_scores import read_wordings, score

WORDINGS = read_wordings(Path(__file__).with_name("read_wordings.csv"))
EVERY = 4


def wrong(wordings):
    task = task_terms(load("strawberry")[0])
    return [s.wording.text for s in score(wordings, task) if not s.right]


def test_a_fourth_of_the_known_wordings_is_read_rightly() -> None:
    assert wrong(WORDINGS[::EVERY]) == []


@pytest.mark.slow
def test_every_known_wording_is_read_rightly() -> None:
    assert wrong(WORDINGS) == []
