"""Lifting off: the force that just holds is found while the fingers rise."""

import math
from dataclasses import replace

import numpy as np
import pytest

from primitives.contract import Band
from primitives.sense import Interval
from sim.grasp.rig import build
from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tacgrasp.config.terms import contract_of
from tacgrasp.rig.factory import make_executor
from tacgrasp.runtime.lift_off import lift_off
from tacgrasp.runtime.reflex_loop import ReflexLoop
from tacgrasp.runtime.steps import NoRecorder, Steps

SEED = 5
SIDE_M = np.array([0.025, 0.0, 0.0])


def lifted_off(part, sensor="taxels", limit_n=None, lift_off_mm=1.0):
    """A fruit gripped with a part of what holds its weight, after its lift-off."""
    config = RunConfig(**{**dict(load("fruit")[0]), "sensor": sensor, "seed": SEED})
    rig = build("fruit", SEED, sensor_name=sensor, start_offset_mm=(0.0, 0.0))
    contract = contract_of(config)
    if limit_n is not None:
        contract = replace(
            contract, force_n=Band(low=0.01, high=limit_n), limit_n=limit_n, needs=""
        )
    executor = make_executor(rig, config, contract)
    least_n = rig.grasp.fingers.slip_minimum_n([(0.0, 0.0)])
    executor.grasp(part * least_n / rig.gripper.force_gain)
    steps = Steps(rig, config.loop, NoRecorder(), [], reflex=ReflexLoop(rig, executor))
    force_n = rig.truth().force_n
    felt = Interval(value=force_n, low=0.8 * force_n, high=1.2 * force_n)
    verify = config.verify.model_copy(update={"lift_off_mm": lift_off_mm})
    found = lift_off(rig, steps, verify, contract, felt, SIDE_M)
    return rig, found, least_n


@pytest.mark.parametrize("part", [0.6, 1.0])
def test_a_grip_that_is_too_light_is_raised_until_it_holds_through_the_shake(part):
    rig, found, least_n = lifted_off(part)
    assert found.problem == ""
    assert rig.grasp.hangs and not rig.truth().dropped
    assert rig.gripper.state().force_n == pytest.approx(found.floor_n, rel=1e-6)
    assert rig.truth().force_n < 4 * least_n  # a firm grip at once would hold as well
    shaken = rig.grasp.fingers.resistance(rig.grasp.patch, (10.0, 0.0))
    assert shaken.margin > 0.9


def test_a_grip_that_may_not_grow_is_reported_and_nothing_falls():
    rig, found, least_n = lifted_off(0.5, limit_n=0.55 * 0.2)
    assert "still slips 10 mm above" in found.problem
    assert not rig.grasp.hangs
    assert not rig.truth().dropped
    assert rig.truth().peak_force_n <= least_n


def test_a_lift_off_goes_no_higher_than_the_lift():
    rig, _, _ = lifted_off(0.3, limit_n=0.05, lift_off_mm=9.0)
    assert rig.arm.pose().position_m[2] < 0.24
    assert not rig.truth().dropped


def test_without_shear_nothing_moves():
    rig, found, _ = lifted_off(0.6, sensor="gelsight_mini")
    assert (found.problem, found.floor_n) == ("", 0.0)
    assert math.isclose(rig.arm.pose().position_m[2], 0.20)
