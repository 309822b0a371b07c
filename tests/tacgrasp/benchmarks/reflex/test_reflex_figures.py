"""Figures of bench reflex from results made by hand, and one load of each kind."""

from types import SimpleNamespace

import pytest

from sim.grasp.world import DROPPED_MM
from tacgrasp.benchmarks.reflex.loads import LoadResult, onset_s, run_seed
from tacgrasp.benchmarks.reflex.pace import Pace
from tacgrasp.benchmarks.reflex.run import (
    best_threshold,
    by_noise,
    delay_limit_ms,
    summary,
    wire_figures,
)
from tacgrasp.benchmarks.reflex.wire import WireResult, run_wire

SLIPS, HOLDS = 103, 101
"""Seeds of a load that friction can't hold, and of one that it can."""


def result(seed, *, slips, called, early=False, holds=None, delay_ms=None, ratio=1.0):
    return LoadResult(
        seed=seed,
        kind="lift",
        object="egg",
        noise_mm=0.001 * (seed + 1),
        slips=slips,
        holds=not slips if holds is None else holds,
        called=called,
        early=early,
        delay_ms=delay_ms,
        slid_mm=4.0 if slips else 0.0,
        slid_kept_mm=0.5 if called and slips else 4.0 if slips else 0.0,
        gone=slips,
        gone_kept=slips and not called,
        force_factor=1.2 if called else 1.0,
        largest_ratio=ratio,
        compute_ms=(0.5, 0.6),
    )


RESULTS = [
    result(0, slips=True, called=True, delay_ms=10.0, ratio=2.0),
    result(1, slips=True, called=True, delay_ms=20.0, ratio=3.0),
    result(2, slips=True, called=False, ratio=0.5),
    result(3, slips=True, called=True, early=True, delay_ms=-50.0, ratio=2.5),
    result(4, slips=False, called=False, ratio=0.4),
    result(5, slips=False, called=True, ratio=2.2),
    result(6, slips=False, called=True, holds=False, ratio=0.1),
]
PACE = Pace(command_ms=[1.0] * 10, late_ms=[0.1] * 10, interval_ms=[10.0] * 9, decisions=4)


def test_a_call_before_anything_slips_counts_as_false_and_what_lies_between_as_neither():
    figures = summary("taxels", RESULTS, PACE)
    assert figures["recall"] == pytest.approx(2 / 4)
    assert figures["precision"] == pytest.approx(2 / 4)
    assert (figures["slips"], figures["holds"], figures["between"]) == (4, 2, 1)
    assert (figures["false_alarms"], figures["between_called"]) == (2, 1)
    assert figures["rate_hz"] == {"p50": 100.0, "p99": 100.0}
    assert figures["slip_to_command_ms"]["p50"] == pytest.approx(11.0)
    assert figures["keeps_limits"] is False


def test_constant_detectors_stand_beside_it():
    detectors = summary("taxels", RESULTS, PACE)["detectors"]
    assert detectors["always"]["recall"] == 1.0
    assert detectors["always"]["precision"] == pytest.approx(4 / 6)
    assert detectors["never"]["recall"] == 0.0
    assert detectors["never"]["precision"] is None


def test_the_threshold_of_force_alone_is_the_best_there_is():
    best = best_threshold(RESULTS)
    assert (best["recall"], best["precision"]) == (1.0, 0.8)
    assert 0.4 <= best["threshold"] < 0.5


def test_what_the_reflex_keeps_is_counted_on_the_loads_that_slip_by_a_millimetre():
    became = summary("taxels", RESULTS, PACE)["kept"]
    assert (became["slipped_1_mm_alone"], became["slipped_1_mm_with_reflex"]) == (4, 1)
    assert (became["gone_alone"], became["gone_with_reflex"]) == (4, 1)


def test_the_noisiest_third_comes_last():
    thirds = by_noise(RESULTS)
    assert [third["noise_um"] for third in thirds] == [[1.0, 3.0], [4.0, 5.0], [6.0, 7.0]]


def test_figures_of_nothing_keep_no_limit():
    figures = summary("taxels", [RESULTS[4]], PACE)
    assert figures["recall"] is None
    assert figures["keeps_limits"] is False


def test_limits_are_those_of_the_sensor():
    assert delay_limit_ms("taxels") == 30.0
    assert delay_limit_ms("gelsight_mini_markers") == 105.0


def test_the_begin_of_a_slide_lies_between_two_steps_by_what_sticks():
    frames = [
        SimpleNamespace(t_s=0.01, stick_fraction=0.32, slides=False),
        SimpleNamespace(t_s=0.02, stick_fraction=0.0, slides=True),
    ]
    assert onset_s(frames) == pytest.approx(0.01 + 0.01 * 0.30 / 0.32)
    assert onset_s(frames[:1]) is None


def test_a_load_that_slips_and_one_that_holds():
    slipped, held = (run_seed("taxels", seed) for seed in (SLIPS, HOLDS))
    assert slipped.slips
    assert not slipped.holds
    assert slipped.gone
    assert min(slipped.slid_kept_mm, DROPPED_MM) <= min(slipped.slid_mm, DROPPED_MM)
    assert held.holds
    assert held.slid_mm == held.slid_kept_mm == 0
    assert held.delay_ms is None
    assert run_seed("taxels", HOLDS).largest_ratio == held.largest_ratio


def through_wire(seed, delay_ms):
    return WireResult(
        seed=seed,
        slid=True,
        called=True,
        delay_ms=delay_ms,
        largest_step_ms=12.0,
        num_blind=1,
        command_ms=(2.0, 3.0),
    )


def test_times_through_the_wire_stand_beside_those_of_the_same_loads():
    figures = wire_figures([through_wire(0, 18.0), through_wire(9, 40.0)], RESULTS)
    assert figures["wire_slip_to_command_ms"]["p50"] == pytest.approx(29.0)
    assert figures["wire_without_ms"]["p50"] == pytest.approx(10.0)
    assert figures["wire_command_ms"]["p50"] == pytest.approx(2.5)
    assert (figures["wire_loads"], figures["wire_slides"], figures["wire_blind"]) == (2, 2, 2)
    assert wire_figures([], RESULTS)["wire_slip_to_command_ms"] == {"p50": None, "p99": None}


def test_a_wire_that_is_too_slow_keeps_no_limit():
    good = [result(0, slips=True, called=True, delay_ms=10.0), result(1, slips=False, called=False)]
    assert summary("taxels", good, PACE, [through_wire(0, 44.0)])["keeps_limits"]
    assert not summary("taxels", good, PACE, [through_wire(0, 46.0)])["keeps_limits"]


@pytest.mark.slow
def test_a_slip_comes_through_the_emulated_wire_to_the_registers_and_a_hold_does_not():
    pytest.importorskip("dynamixel_sdk")
    done = []
    slipped, held = run_wire([SLIPS, HOLDS], done.append)
    assert done == [SLIPS, HOLDS]
    assert slipped.called and slipped.slid
    assert slipped.delay_ms is not None and slipped.delay_ms > 0
    assert not held.called and not held.slid and held.delay_ms is None
    assert slipped.num_blind == held.num_blind == 0
    assert len(slipped.command_ms) >= 1 and min(slipped.command_ms) > 0
