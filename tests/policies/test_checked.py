"""A policy's reply is checked before anything is done with it."""

import math
from dataclasses import replace

import pytest

from policies import Decision, PolicyError, checked
from primitives import Primitive

GOOD = Decision(
    text="Too light.", action=Primitive.INCREASE_FORCE, success=False, reason="more force"
)


@pytest.mark.parametrize("good", [GOOD, replace(GOOD, action=None, success=True)])
def test_a_whole_decision_passes_as_it_is(good):
    assert checked(good) is good


@pytest.mark.parametrize(
    ("reply", "words"),
    [
        (None, "expected a Decision"),
        ("increase_force", "expected a Decision"),
        (replace(GOOD, action="squeeze_hard"), "unknown action 'squeeze_hard'"),
        (replace(GOOD, action="increase_force"), "unknown action"),
        (replace(GOOD, text=None), "needs a text"),
        (replace(GOOD, success="yes"), "True or False"),
        (
            replace(GOOD, text="Increase \udcff force."),
            r"text is no Unicode, got 'Increase \\udcff",
        ),
        (replace(GOOD, reason="\ud800"), "reason is no Unicode"),
        (replace(GOOD, confidence=math.nan), "confidence is nan"),
        (replace(GOOD, stage_ms={"decide": math.inf}), "decide is inf"),
        (replace(GOOD, reason=None), "reason is a text, .* got None"),
        (replace(GOOD, stage_ms=None), "stage_ms durations by their names"),
        (replace(GOOD, confidence="high"), "confidence is 'high'"),
    ],
)
def test_what_is_no_decision_is_an_error_of_the_policy(reply, words):
    with pytest.raises(PolicyError, match=words):
        checked(reply)
