"""The reflex: a pure function that keeps the contract and owns no goal."""

import math
from dataclasses import replace
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from policies.reflex import (
    CLEARLY_ABOVE,
    FRESH_S,
    IMPOSSIBLE,
    LEAST_FACTOR,
    LEAST_RELIEF,
    LOWER_EVERY_S,
    MAX_BLIND_S,
    MOST_FACTOR,
    NEWEST_POSSIBLE,
    RELIEVED,
    RESPONSE_S,
    SMALL_EVERY_S,
    SMALL_FACTOR,
    SURE_FACTOR,
    SURE_SLIP,
    Act,
    ReflexMemory,
    ReflexReading,
    correct,
)
from primitives.contract import Band, ForceTerms

PERIOD_S = 0.01
TERMS = ForceTerms(force_n=Band(low=0.5, high=1.0), limit_n=1.5)
CALM = ReflexReading(
    t_s=10.0, captured_s=10.0, felt_n=0.8, slip=-2.0, commanded_n=0.6, most_felt_n=1.0
)


def act(reading, memory=None, terms=TERMS):
    return correct(reading, terms, memory or ReflexMemory(), PERIOD_S)


def test_a_calm_hold_inside_the_band_is_left_alone():
    correction, memory = act(CALM)
    assert (correction.act, correction.force_n) == (Act.HOLD, CALM.commanded_n)
    assert memory == ReflexMemory()


def test_a_slip_raises_the_force_by_the_least_step():
    correction, _ = act(replace(CALM, slip=0.1))
    assert correction.act is Act.RAISE
    assert correction.force_n == pytest.approx(0.6 * LEAST_FACTOR)


def test_no_second_step_before_the_gripper_has_had_time_to_answer():
    slipping = replace(CALM, slip=3.0)
    _, memory = act(slipping)
    soon = replace(slipping, t_s=10.0 + RESPONSE_S / 2, captured_s=10.0 + RESPONSE_S / 2)
    assert act(soon, memory)[0].act is Act.HOLD


def test_a_slip_that_goes_on_gets_ever_larger_steps_up_to_the_largest():
    memory, commanded_n, factors = ReflexMemory(), 0.1, []
    terms = ForceTerms(force_n=Band(low=0.5, high=1.0), limit_n=100.0)
    for k in range(6):
        t_s = 10.0 + k * RESPONSE_S
        reading = replace(CALM, t_s=t_s, captured_s=t_s, slip=3.0, commanded_n=commanded_n)
        correction, memory = act(reading, memory, terms)
        factors.append(correction.force_n / commanded_n)
        commanded_n = correction.force_n
    assert factors[:3] == pytest.approx([1.12, 1.24, 1.48])
    assert factors[-1] == pytest.approx(MOST_FACTOR)


def test_a_later_slip_begins_with_the_least_step_again():
    _, memory = act(replace(CALM, slip=3.0))
    later = replace(CALM, t_s=10.1 + FRESH_S, captured_s=10.1 + FRESH_S, slip=3.0)
    assert act(later, memory)[0].force_n == pytest.approx(0.6 * LEAST_FACTOR)


def test_a_force_clearly_above_the_band_is_lowered_and_not_twice_at_once():
    high = replace(CALM, felt_n=1.01 * CLEARLY_ABOVE)
    correction, memory = act(high)
    assert correction.act is Act.LOWER
    assert correction.force_n < high.commanded_n
    soon = replace(high, t_s=10.0 + LOWER_EVERY_S / 2, captured_s=10.0 + LOWER_EVERY_S / 2)
    assert act(soon, memory)[0].act is Act.HOLD


def test_what_a_slip_has_asked_for_is_not_taken_away():
    raised, memory = act(replace(CALM, slip=1.0))
    later = replace(
        CALM, t_s=12.0, captured_s=12.0, felt_n=1.2, commanded_n=raised.force_n, most_felt_n=2.0
    )
    assert act(later, memory)[0].act is Act.HOLD


def test_at_the_limit_a_slip_raises_nothing():
    correction, _ = act(replace(CALM, slip=5.0, felt_n=RELIEVED * TERMS.limit_n, most_felt_n=2.0))
    assert correction.act is Act.HOLD
    assert "limit" in correction.reason


@pytest.mark.parametrize("slip", [-2.0, 5.0, None])
@pytest.mark.parametrize(
    "felt",
    [{"felt_n": 2.0}, {"felt_n": 0.8, "newest_n": 2.0}, {"felt_n": None, "newest_n": 2.0}],
)
def test_near_the_limit_the_force_is_lowered_at_once_slip_or_not(slip, felt):
    _, memory = act(replace(CALM, slip=1.0))  # a slip has just asked for more
    above = replace(CALM, t_s=10.0 + RESPONSE_S, captured_s=10.0 + RESPONSE_S, slip=slip, **felt)
    correction, memory = act(above, memory)
    assert correction.act is Act.LOWER
    assert "near the limit of 1.50 N" in correction.reason
    assert 2.0 * correction.force_n / above.commanded_n == pytest.approx(RELIEVED * 1.5)
    soon = replace(above, t_s=above.t_s + RESPONSE_S / 2, captured_s=above.t_s + RESPONSE_S / 2)
    assert act(soon, memory)[0].act is Act.HOLD


def test_what_no_command_makes_in_the_newest_frame_alone_is_no_force():
    most_n = NEWEST_POSSIBLE * CALM.most_felt_n
    for newest_n in (1.01 * most_n, math.inf, math.nan):
        correction, memory = act(replace(CALM, newest_n=newest_n))
        assert (correction.act, memory.blind_s) == (Act.HOLD, None)


def test_a_gain_that_has_doubled_is_undone_in_two_steps():
    commanded_n, memory = 1.0, ReflexMemory()
    terms = ForceTerms(force_n=Band(low=0.8, high=1.2), limit_n=1.3)
    felt = [2.0]
    for k in range(3):
        t_s = 10.0 + k * RESPONSE_S
        reading = replace(
            CALM, t_s=t_s, captured_s=t_s, felt_n=felt[-1], commanded_n=commanded_n, most_felt_n=2.0
        )
        correction, memory = act(reading, memory, terms)
        commanded_n = correction.force_n
        felt.append(2.0 * commanded_n)
    assert felt[2] <= terms.limit_n
    assert felt[3] > 0.8 * RELIEVED * terms.limit_n  # and no further


def test_a_single_wrong_frame_takes_no_more_than_one_step():
    correction, _ = act(replace(CALM, felt_n=2.9))
    assert correction.force_n == pytest.approx(LEAST_RELIEF * CALM.commanded_n)


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"captured_s": None}, "no frame"),
        ({"captured_s": 10.0 - 2 * PERIOD_S - 0.021}, "ms old"),
        ({"captured_s": 10.5}, "500 ms in the future"),
        ({"captured_s": math.nan}, "no frame"),
        ({"felt_n": math.nan}, "felt force is nan"),
        ({"felt_n": math.inf}, "felt force is inf"),
        ({"slip": math.nan}, "slip is nan"),
        ({"felt_n": 1.01 * IMPOSSIBLE}, "which makes at most 1.00 N"),
    ],
)
def test_what_is_stale_not_finite_or_impossible_is_no_reading_and_the_force_is_held(change, reason):
    correction, memory = act(replace(CALM, **{"slip": 9.0, **change}))
    assert (correction.act, correction.force_n) == (Act.HOLD, CALM.commanded_n)
    assert reason in correction.reason
    assert memory.blind_s == CALM.t_s


def test_without_a_reading_for_too_long_the_hold_ends_and_one_reading_starts_the_time_anew():
    blind = replace(CALM, captured_s=None)
    _, memory = act(blind)
    within = replace(blind, t_s=10.0 + MAX_BLIND_S)
    assert act(within, memory)[0].act is Act.HOLD
    assert act(replace(within, t_s=10.01 + MAX_BLIND_S), memory)[0].act is Act.END
    seen = replace(CALM, t_s=10.4, captured_s=10.4)
    assert act(seen, memory)[1].blind_s is None


def test_a_sensor_that_cannot_tell_slips_is_done_without():
    assert act(replace(CALM, slip=None))[0].act is Act.HOLD


numbers = st.floats(min_value=-1e3, max_value=1e3) | st.sampled_from([math.nan, math.inf])


@given(
    felt_n=st.none() | numbers,
    slip=st.none() | numbers,
    commanded_n=st.floats(min_value=0.01, max_value=20),
    age_s=st.floats(min_value=0, max_value=1),
    since_s=st.floats(min_value=0, max_value=1),
    factor=st.floats(min_value=1, max_value=2),
)
def test_the_felt_force_that_a_correction_leads_to_is_never_above_the_limit(
    felt_n, slip, commanded_n, age_s, since_s, factor
):
    reading = ReflexReading(
        t_s=10.0,
        captured_s=10.0 - age_s,
        felt_n=felt_n,
        slip=slip,
        commanded_n=commanded_n,
        most_felt_n=2 * commanded_n,
    )
    memory = ReflexMemory(raised_s=10.0 - since_s, factor=factor)
    correction, _ = act(reading, memory)
    assert math.isfinite(correction.force_n)
    assert correction.force_n > 0
    if correction.act is Act.RAISE and felt_n is not None and felt_n > 0:
        assert felt_n * correction.force_n / commanded_n <= TERMS.limit_n * (1 + 1e-9)
    if correction.act is Act.LOWER:
        assert correction.force_n < commanded_n


def steps_up(count, every_s, **reading):
    """Times [s] and factors of the steps up of readings of a slip, so far apart."""
    memory, commanded_n, steps = ReflexMemory(), 0.1, []
    terms = ForceTerms(force_n=Band(low=0.05, high=1.0), limit_n=100.0)
    for k in range(count):
        t_s = 10.0 + k * every_s
        slipping = replace(CALM, t_s=t_s, captured_s=t_s, commanded_n=commanded_n, **reading)
        correction, memory = act(slipping, memory, terms)
        if correction.act is Act.RAISE:
            steps.append((t_s, correction.force_n / commanded_n))
        commanded_n = correction.force_n
    return zip(*steps, strict=True)


def test_while_the_object_stands_steps_up_stay_small_and_wait_for_what_is_felt():
    times_s, factors = steps_up(12, 0.02, slip=3.0, standing=True)
    assert factors == pytest.approx([SMALL_FACTOR] * len(factors))
    assert len(factors) > 2
    assert min(b - a for a, b in pairwise(times_s)) == pytest.approx(SMALL_EVERY_S)


@pytest.mark.parametrize(
    ("slip", "factor", "every_s"),
    [
        (0.9 * SURE_SLIP, SMALL_FACTOR, SMALL_EVERY_S),
        (1.1 * SURE_SLIP, SURE_FACTOR, RESPONSE_S),
    ],
)
def test_after_a_lift_off_steps_do_not_grow_and_only_a_sure_slip_has_larger_ones(
    slip, factor, every_s
):
    times_s, factors = steps_up(20, 0.01, slip=slip, is_found=True)
    assert factors == pytest.approx([factor] * len(factors))
    assert [b - a for a, b in pairwise(times_s)] == pytest.approx([every_s] * (len(factors) - 1))
    assert len(factors) > 3


def test_what_the_next_motion_needs_is_asked_for_once_and_not_lowered_again():
    correction, memory = act(replace(CALM, ahead_n=0.8))
    assert (correction.act, correction.reason) == (Act.RAISE, "what is ahead")
    assert correction.force_n == pytest.approx(0.8)
    later = replace(CALM, t_s=11.0, captured_s=11.0, commanded_n=0.8, ahead_n=0.8, felt_n=1.2)
    correction, _ = act(later, memory)
    assert correction.act is Act.HOLD  # above the band of 1 N, as was asked for


@given(ahead_n=st.floats(0.0, 1e6), felt_n=st.floats(0.01, 1.5))
def test_no_motion_ahead_gets_more_than_the_limit(ahead_n, felt_n):
    reading = replace(CALM, ahead_n=ahead_n, felt_n=felt_n, most_felt_n=100.0)
    correction, _ = act(reading)
    assert correction.force_n * felt_n / CALM.commanded_n <= TERMS.limit_n * (1 + 1e-9)
