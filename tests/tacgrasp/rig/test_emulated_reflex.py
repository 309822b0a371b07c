"""The reflex on the emulated rig, through the real drivers: it holds, and it ends safely."""

import os
import signal
import threading

import numpy as np
import pytest

from cltp import TouchError
from policies.reflex import MAX_BLIND_S
from primitives import RobotError
from primitives.devices import Pose
from primitives.sense import Interval
from sim.grasp.rig import build
from tacgrasp.config.terms import contract_of
from tacgrasp.rig.emulated import start
from tacgrasp.rig.factory import make_executor
from tacgrasp.runtime.reflex_loop import ReflexLoop
from tests.fakes.patient_rig import patient_config
from tests.fakes.waiting import poll

pytest.importorskip("rtde_control")
pytest.importorskip("dynamixel_sdk")
pytestmark = pytest.mark.slow

HEAVY = 9
"""Seed of a berry of 36 g."""

LIFT_M = np.array([0.0, 0.0, 0.04])


@pytest.fixture
def hold(tmp_path):
    """A heavy berry, gripped a little too lightly to be lifted."""
    config = patient_config(tmp_path, seed=HEAVY, sensor="taxels")
    simulated = build("strawberry", HEAVY, sensor_name="taxels", start_offset_mm=(0.0, 0.0))
    least_n = simulated.grasp.fingers.slip_minimum_n([(0.0, 0.0)])
    rig = start(config, config.hardware, centred=True)
    try:
        executor = make_executor(rig, config, contract_of(config))
        rig.sensor.take_reference()
        executor.grasp(0.93 * least_n / simulated.gripper.force_gain)
        yield rig, executor, contract_of(config)
    finally:
        rig.disconnect()


def felt(rig):
    force_n = rig.truth().force_n
    return Interval(value=force_n, low=0.8 * force_n, high=1.2 * force_n)


def lift(rig, speed_m_s=0.4):
    here = rig.arm.pose()
    target = Pose(position_m=here.position_m + LIFT_M, rotvec_rad=here.rotvec_rad)
    rig.arm.move_to(target, speed_m_s=speed_m_s, acceleration_m_s2=0.5)


def test_a_berry_that_slides_is_gripped_harder_while_the_arm_lifts_it(hold):
    rig, executor, contract = hold
    reflex, before_n = ReflexLoop(rig, executor), executor.force_n
    with reflex.keeping(contract, felt(rig)):
        lift(rig)
    trace = reflex.take_trace()
    assert trace.corrections and trace.corrections[0].reason == "slip"
    assert executor.force_n > before_n
    assert rig.truth().peak_force_n <= contract.limit_n
    adjusted = [each for each in rig.commands() if each.asked.startswith("adjust to")]
    assert len(adjusted) == len(trace.corrections)
    assert all("goal current" in each.sent and not each.error for each in adjusted)
    assert (np.diff(trace.t_s) > 0).all()


def test_without_it_the_same_berry_is_dropped(hold):
    rig, _, _ = hold
    lift(rig)
    assert rig.truth().dropped


def test_a_sensor_that_falls_silent_ends_the_lift_and_the_grip_is_kept(hold):
    rig, executor, contract = hold
    before_n, facts = executor.force_n, rig.emulators.control.facts
    reflex = ReflexLoop(rig, executor)
    with (
        pytest.raises((TouchError, RobotError), match=r"the taxel array at .*: no fresh frame"),
        reflex.keeping(contract, felt(rig)),
    ):
        rig.emulators.control.inject("taxels", "stall")
        rig.clock.sleep(2 * MAX_BLIND_S)
        lift(rig, speed_m_s=0.02)
    assert reflex.take_trace().num_blind > 10
    assert executor.force_n == before_n
    poll(lambda: not facts("ur")["moving"])
    assert facts("ur")["tcp_speed_m_s"] == 0.0
    assert facts("dynamixel")["force_n"] > 0


def test_a_gripper_that_is_lost_ends_the_lift_at_once(hold):
    rig, executor, contract = hold
    facts = rig.emulators.control.facts
    with pytest.raises(RobotError), ReflexLoop(rig, executor).keeping(contract, felt(rig)):
        rig.emulators.control.inject("dynamixel", "unplug")
        lift(rig, speed_m_s=0.02)
    poll(lambda: not facts("ur")["moving"])


def test_a_stop_by_the_operator_ends_it_and_nothing_is_commanded_afterwards(hold):
    rig, executor, contract = hold
    facts = rig.emulators.control.facts
    ctrl_c = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
    ctrl_c.start()
    with pytest.raises(KeyboardInterrupt), ReflexLoop(rig, executor).keeping(contract, felt(rig)):
        lift(rig, speed_m_s=0.005)
    rig.arm.stop()  # as the runtime does at the end of every episode
    assert not [each for each in threading.enumerate() if each.name == "reflex"]
    rig.commands()
    poll(lambda: not facts("ur")["moving"])
    assert facts("ur")["tcp_speed_m_s"] == 0.0
    assert facts("dynamixel")["force_n"] > 0
    assert rig.commands() == ()
