"""The reflex in a simulated hold: what it catches, what it records, and what ends it."""

import math
from contextlib import nullcontext

import numpy as np
import pytest

from cltp.errors import TouchError
from policies.reflex import MAX_BLIND_S
from primitives import Primitive, RobotError
from primitives.devices import Pose
from primitives.sense import Interval
from sim.grasp.devices import ADJUST_S, SimClock
from sim.grasp.rig import build
from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tacgrasp.config.terms import contract_of
from tacgrasp.rig.factory import make_executor
from tacgrasp.runtime.reflex_hold import QUIET_FRAMES
from tacgrasp.runtime.reflex_loop import DECISION_S, ReflexLoop, unfelt_slips
from tests.fakes.contracts import contract as bands

SEED, HEAVY = 3, 9
"""Seeds of a berry of 8 g, and of one of 36 g."""


def hold(sensor="taxels", force_n=0.6, seed=SEED):
    """A simulated berry in the middle of the pad, gripped with a commanded force."""
    config, _ = load("strawberry")
    config = RunConfig(**{**dict(config), "sensor": sensor, "seed": seed})
    rig = build("strawberry", seed, sensor_name=sensor, start_offset_mm=(0.0, 0.0))
    contract = contract_of(config)
    executor = make_executor(rig, config, contract)
    executor.grasp(force_n)
    return rig, executor, contract


def felt(rig):
    force_n = rig.truth().force_n
    return Interval(value=force_n, low=0.8 * force_n, high=1.2 * force_n)


def lift(rig, acceleration_m_s2=2.5):
    up = np.array([0.0, 0.0, 0.04])
    pose = Pose(position_m=rig.arm.pose().position_m + up, rotvec_rad=rig.arm.pose().rotvec_rad)
    rig.arm.move_to(pose, speed_m_s=0.4, acceleration_m_s2=acceleration_m_s2)


def test_a_firm_hold_is_left_alone_and_read_at_the_rate_of_the_sensor():
    rig, executor, contract = hold()
    reflex = ReflexLoop(rig, executor)
    before_s = rig.clock.simulated_s
    with reflex.keeping(contract, felt(rig)):
        lift(rig)
        rig.clock.sleep(0.5)
    trace = reflex.take_trace()
    assert trace.corrections == ()
    assert trace.num_blind == 0
    assert len(trace.t_s) == pytest.approx((rig.clock.simulated_s - before_s) * 100, abs=1)
    assert (np.diff(trace.t_s) > 0).all()
    assert trace.felt_n[QUIET_FRAMES + 5 :] == pytest.approx(rig.truth().force_n, rel=0.25)
    assert "force kept" in trace.text
    assert reflex.take_trace() is None


def test_a_berry_that_would_slide_is_gripped_harder_and_slides_less():
    slid_mm = {}
    for has_reflex in (False, True):
        rig, executor, contract = hold(seed=HEAVY)
        least_n = rig.grasp.fingers.slip_minimum_n([(0.0, 0.0)])
        executor.correct_force(0.93 * least_n / rig.gripper.force_gain)
        reflex = ReflexLoop(rig, executor)
        if has_reflex:
            with reflex.keeping(contract, felt(rig)):
                lift(rig, 0.5)
            trace = reflex.take_trace()
            assert len(trace.corrections) >= 1
            assert trace.corrections[0].reason == "slip"
            assert "raised" in trace.text
            assert rig.truth().peak_force_n <= contract.limit_n
        else:
            lift(rig, 0.5)
        slid_mm[has_reflex] = rig.truth().slip_mm
    assert slid_mm[False] > 2.0
    assert slid_mm[True] < slid_mm[False] / 2


def test_without_shear_there_is_no_reflex_and_the_trace_says_so():
    rig, executor, contract = hold("gelsight_mini")
    reflex = ReflexLoop(rig, executor)
    with reflex.keeping(contract, None):
        lift(rig)
    assert reflex.take_trace().text == "reflex: none, gelsight_mini measures no shear"


def test_a_sensor_that_fails_for_a_moment_is_survived_and_one_that_stays_silent_ends_the_motion(
    monkeypatch,
):
    for seconds, ends in ((MAX_BLIND_S / 2, False), (2 * MAX_BLIND_S, True)):
        rig, executor, contract = hold()
        reflex, read, before_n = (
            ReflexLoop(rig, executor),
            rig.sensor.newest_shear,
            executor.force_n,
        )
        from_s = rig.clock.simulated_s + 0.2

        def silent(_, rig=rig, read=read, from_s=from_s, seconds=seconds):
            if from_s < rig.clock.simulated_s < from_s + seconds:
                raise TouchError("no frame")
            return read()

        with monkeypatch.context() as patch:
            patch.setattr(type(rig.sensor), "newest_shear", silent)
            blind = r"^the reflex was blind: .*; no reading for 0\.5 s$"
            expected = pytest.raises(TouchError, match=blind) if ends else nullcontext()
            with expected, reflex.keeping(contract, felt(rig)):
                rig.clock.sleep(2.0)
        assert executor.force_n == before_n
        assert reflex.take_trace().num_blind > 10


def test_a_reflex_that_is_blind_says_what_the_sensor_says(monkeypatch):
    def failed(_):
        raise TouchError("the taxel array at PORT was unplugged: plug it in")

    says_stale = lambda _: "the taxel array at PORT: no fresh frame; check its cable"  # noqa: E731
    for check_alive in (says_stale, failed):
        rig, executor, contract = hold()
        with monkeypatch.context() as patch:
            patch.setattr(type(rig.sensor), "newest_shear", lambda _: None)
            for name, method in (
                ("check_alive", check_alive),
                ("expect_untouched", lambda _: None),
                ("counts", lambda _: None),
            ):  # as a sensor of a real rig
                patch.setattr(type(rig.sensor), name, method, raising=False)
            keeping = ReflexLoop(rig, executor).keeping(contract, felt(rig))
            with pytest.raises(TouchError, match=r"blind: .* s; the taxel array at PORT"), keeping:
                rig.clock.sleep(2 * MAX_BLIND_S)


def test_a_gripper_that_fails_ends_the_motion():
    rig, executor, contract = hold()
    rig.gripper.disconnect()
    with pytest.raises(RobotError), ReflexLoop(rig, executor).keeping(contract, None):
        rig.clock.sleep(0.1)


def test_a_command_comes_into_force_after_the_time_that_the_gripper_needs():
    rig, executor, _ = hold()
    forces = []
    rig.clock.call_every(0.01, lambda: forces.append(rig.truth().force_n))
    before_n = rig.truth().force_n
    executor.correct_force(1.1 * executor.force_n)
    rig.clock.sleep(0.1)
    assert forces[0] == before_n
    assert sum(force == before_n for force in forces) == round(ADJUST_S / 0.01) - 1
    assert forces[-1] == pytest.approx(1.1 * before_n)


def test_a_command_still_waiting_is_carried_out_when_the_calls_end():
    rig, executor, _ = hold()
    before_n = rig.truth().force_n
    rig.clock.call_every(0.01, lambda: None)
    executor.correct_force(1.1 * executor.force_n)
    rig.clock.call_every(0.01, None)
    assert rig.truth().force_n == pytest.approx(1.1 * before_n)


def test_calls_come_in_the_middle_of_waits_and_time_is_counted_once():
    clock, rig = SimClock(), build("strawberry", SEED)
    clock.attach(rig.grasp)
    times: list[float] = []
    clock.call_every(0.1, lambda: times.append(clock.simulated_s))
    clock.sleep(0.35)
    assert times == pytest.approx([0.1, 0.2, 0.3])
    assert clock.simulated_s == pytest.approx(0.35)
    clock.call_every(0.1, None)
    clock.sleep(1.0)
    assert len(times) == 3
    assert clock.simulated_s == pytest.approx(1.35)
    with pytest.raises(ValueError, match="above 0"):
        clock.call_every(0.0, lambda: None)


def test_the_limit_holds_for_a_correction_too():
    _, executor, _ = hold()
    state = executor.correct_force(15.0)
    assert state.clamped
    assert math.isclose(executor.force_n, state.force_n)
    limit_n = contract_of(load("strawberry")[0]).terms.limit_n
    assert executor.most_felt_n(state.force_n) <= limit_n * (1 + 1e-9)


def test_while_a_policy_decides_a_force_above_the_band_is_lowered_and_time_passes():
    rig, executor, _ = hold()
    before_n, before_s = executor.force_n, rig.clock.simulated_s
    above = bands(0.1, 0.5 * rig.truth().force_n, 3.0)
    reflex = ReflexLoop(rig, executor)
    with reflex.deciding(above, felt(rig)):
        assert executor.force_n == before_n
    assert rig.clock.simulated_s - before_s == pytest.approx(DECISION_S)
    trace = reflex.take_trace()
    assert len(trace.t_s) == round(DECISION_S * 100)
    assert executor.force_n == pytest.approx(0.9 * before_n)
    assert "above" in trace.text


def test_a_good_hold_is_left_alone_while_a_policy_decides():
    rig, executor, contract = hold()
    reflex = ReflexLoop(rig, executor)
    with reflex.deciding(contract, felt(rig)):
        pass
    assert reflex.take_trace().text == "reflex: 30 readings, force kept"


@pytest.mark.parametrize("sensor", ["taxels", "gelsight_mini"])
def test_without_contact_or_shear_a_decision_takes_no_time_and_leaves_no_trace(sensor):
    rig, executor, contract = hold(sensor)
    before_s, reflex = rig.clock.simulated_s, ReflexLoop(rig, executor)
    with reflex.deciding(contract, None if sensor == "taxels" else felt(rig)):
        pass
    assert rig.clock.simulated_s == before_s
    assert reflex.take_trace() is None


def test_a_decided_change_is_made_of_the_force_that_was_felt_not_of_a_corrected_one():
    forces = []
    for corrects in (False, True):
        _, executor, _ = hold()
        executor.feel(Interval(value=1.0, low=0.8, high=1.2))
        if corrects:
            executor.correct_force(0.9 * executor.force_n)
        executor.execute(Primitive.DECREASE_FORCE)
        forces.append(executor.force_n)
        executor.correct_force(0.9 * executor.force_n)
        executor.feel(Interval(value=0.6, low=0.5, high=0.7))
        before_n = executor.force_n
        executor.execute(Primitive.DECREASE_FORCE)
        assert executor.force_n == pytest.approx(0.65 * before_n)
    assert forces[0] == pytest.approx(forces[1])


def test_a_force_that_no_command_makes_is_not_known_and_the_hold_goes_on():
    rig, executor, contract = hold()
    reflex = ReflexLoop(rig, executor)
    force_n = 100 * rig.truth().force_n
    with reflex.keeping(contract, Interval(value=force_n, low=force_n, high=force_n)):
        lift(rig)
        rig.clock.sleep(2 * MAX_BLIND_S)
    trace = reflex.take_trace()
    assert trace.num_blind == 0
    assert (trace.felt_n == 0).all()  # as where nothing is known of it


@pytest.mark.parametrize(
    ("task", "sensor", "has_reflex", "words"),
    [
        ("fruit", "gelsight_mini", True, "gelsight_mini measures no shear; --sensor taxels"),
        ("fruit", "taxels", False, "the reflex is switched off"),
        ("fruit", "taxels", True, ""),
        ("fruit", "gelsight_mini_markers", True, ""),
        ("strawberry", "gelsight_mini", True, ""),
    ],
)
def test_a_lift_off_whose_slips_nobody_feels_is_warned_of(task, sensor, has_reflex, words):
    changes = {"sensor": sensor, "reflex": has_reflex}
    config = load(task)[0].model_copy(update=changes)
    warning = unfelt_slips(build(task, SEED, sensor_name=sensor), config)
    assert words in warning
    assert bool(warning) == bool(words)


def test_a_force_that_the_guard_does_not_let_through_is_asked_for_once(monkeypatch):
    rig, executor, contract = hold()
    reflex, sent_n = ReflexLoop(rig, executor), []
    correct_force = executor.correct_force
    monkeypatch.setattr(
        executor, "correct_force", lambda force_n: sent_n.append(force_n) or correct_force(force_n)
    )
    with reflex.keeping(contract, None) as held:
        held.ahead_n = 100.0
        rig.clock.sleep(0.5)
    assert len(sent_n) <= 2
    assert held.ahead_n == executor.force_n


def test_after_a_motion_that_was_cut_short_arm_world_and_clock_agree():
    rig, _, _ = hold()
    start, calls = rig.arm.pose(), []

    def fail():
        calls.append(0)
        if len(calls) == 30:
            raise TouchError("blind")

    rig.clock.call_every(0.01, fail)
    with pytest.raises(TouchError):
        lift(rig, 0.5)
    rig.clock.call_every(0.01, None)
    risen_mm = 1000 * (rig.arm.pose().position_m[2] - start.position_m[2])
    assert rig.grasp.pad_xy_mm[1] == pytest.approx(risen_mm)
    rig.arm.move_to(start, speed_m_s=0.4)
    assert rig.grasp.pad_xy_mm == pytest.approx((0.0, 0.0), abs=1e-9)
    before_s = rig.clock.simulated_s
    rig.clock.sleep(0.2)
    assert rig.clock.simulated_s - before_s == pytest.approx(0.2)
