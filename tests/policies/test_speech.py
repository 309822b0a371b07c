"""What is said is read back to the same advice."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from policies.extraction import DESCRIPTORS, extract
from policies.speech import (
    ACTION_WORDINGS,
    CONTACT_WORDINGS,
    NO_CONTACT_WORDINGS,
    REASON_WORDINGS,
    SUCCESS_WORDINGS,
    describe,
    speak,
)
from policies.teacher import Advice, Reason
from primitives import Primitive
from tests.policies.test_teacher import GOAL, NOTHING, TOUCHES, advise, touch

ADVICE = [
    *((Advice(action=p, success=False, reason=Reason.TOO_FIRM), w) for p in Primitive
      for w in ACTION_WORDINGS[p]),
    *((Advice(action=None, success=True, reason=Reason.GOOD), w) for w in SUCCESS_WORDINGS),
    (Advice(action=None, success=False, reason=Reason.BAND_TOO_NARROW), ""),
]  # fmt: skip


@pytest.mark.parametrize("reason", [r for rs in REASON_WORDINGS.values() for r in rs])
def test_every_advice_in_every_wording_reads_back_after_every_reason(reason):
    for advice, wording in ADVICE:
        extraction = extract(f"{reason} {wording}")
        assert (extraction.action, extraction.success) == (advice.action, advice.success), wording


@pytest.mark.parametrize("template", [*CONTACT_WORDINGS, *NO_CONTACT_WORDINGS])
def test_every_advice_in_every_wording_reads_back_after_every_contact(template):
    contact = template.format(
        depth="very deep", position="top-left", area="tiny", depth_mm="0.95",
        x="-8.0", y="+6.1", share="2", force="1.4",
    )  # fmt: skip
    for advice, wording in ADVICE:
        extraction = extract(f"{contact} {wording}")
        assert (extraction.action, extraction.success) == (advice.action, advice.success), wording


@given(st.one_of(st.just(NOTHING), TOUCHES), st.integers(0, 2**32 - 1))
def test_whatever_is_felt_the_teachers_words_read_back_to_its_advice(state, seed):
    advice = advise(state, GOAL)
    for text in (speak(state, advice), speak(state, advice, np.random.default_rng(seed))):
        extraction = extract(text)
        assert (extraction.action, extraction.success) == (advice.action, advice.success), text


@given(TOUCHES, st.integers(0, 2**32 - 1))
def test_the_action_as_a_token_at_the_end_says_the_same(state, seed):
    advice = advise(state, GOAL)
    token = "none" if advice.action is None else advice.action
    extraction = extract(f"{speak(state, advice, np.random.default_rng(seed))} Action: <{token}>.")
    assert (extraction.action, extraction.success) == (advice.action, advice.success)


def test_there_are_at_least_eight_wordings_of_each_advice_and_no_two_alike():
    for wordings in (*ACTION_WORDINGS.values(), SUCCESS_WORDINGS):
        assert len(set(wordings)) == len(wordings) >= 8


def test_each_success_uses_one_of_the_four_descriptors():
    for wording in SUCCESS_WORDINGS:
        words = set(wording.lower().replace(".", " ").replace(",", " ").replace(":", " ").split())
        assert words & set(DESCRIPTORS), wording


def test_the_contact_is_said_in_words_and_numbers():
    text = describe(touch(x=1.25, y=-5, depth=0.42, share=0.05, force=1.26))
    assert text == (
        "The contact is moderate (0.42 mm) at the bottom-center (+1.2, -5.0 mm), its area is small "
        "(5 % of the pad), the force is about 1.3 N."
    )


def test_words_are_fixed_without_a_generator_and_vary_with_one():
    state = touch(y=-5)
    advice = advise(state, GOAL)
    rng = np.random.default_rng(0)
    assert speak(state, advice) == speak(state, advice)
    assert len({speak(state, advice, rng) for _ in range(50)}) > 30
