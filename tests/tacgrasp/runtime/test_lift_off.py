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
from tacgrasp.runtime.lift_off import (
    MOST_RISE_MM,
    MOST_ROCKED,
    ROCKED,
    ROCKED_TIMES,
    SLID_PER_MM,
    _rock,
    lift_off,
)
from tacgrasp.runtime.reflex_loop import ReflexLoop
from tacgrasp.runtime.steps import NoRecorder, Steps, read_observation

SEED = 5
SIDE_M = np.array([0.025, 0.0, 0.0])


def lifted_off(part, sensor="taxels", limit_n=None, lift_off_mm=1.0, lift_mm=40.0):
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
    before = replace(read_observation(rig, None), felt_force_n=felt)
    verify = config.verify.model_copy(update={"lift_off_mm": lift_off_mm, "lift_mm": lift_mm})
    found = lift_off(rig, steps, verify, contract, before, SIDE_M)
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


class RockedHold:
    """A hold of what slides by some way in each rock, and notes what is asked of it.

    Args:
        slides_mm: Way in each rock [mm].
        is_told: Whether a frame looks like a slip too.
    """

    spread_mm = 0.02

    def __init__(self, slides_mm, *, is_told):
        self._slides_mm, self._is_told = list(slides_mm), is_told
        self.seen_s, self.slipped_s, self.called_s = 0.0, -math.inf, -math.inf
        self.indented_mm = (0.0, 0.0)
        self.asked_n = []
        self.num_rests = self.num_hung = 0

    def rest(self):
        self.num_rests += 1

    def hang(self):
        self.num_hung += 1

    @property
    def is_rocked(self):
        return False

    @is_rocked.setter
    def is_rocked(self, now):
        if now:
            return
        slid_mm = self._slides_mm.pop(0)
        self.indented_mm = (0.0, self.indented_mm[1] - slid_mm)
        self.seen_s += 1.0
        if self._is_told and slid_mm > 0:
            self.called_s = self.seen_s

    @property
    def ahead_n(self):
        return self.asked_n[-1]

    @ahead_n.setter
    def ahead_n(self, force_n):
        self.asked_n.append(force_n)


@pytest.mark.parametrize(
    ("slides_mm", "is_told", "factors"),
    [
        ([0.0], True, []),
        ([0.15], False, []),  # no more than noise
        ([0.15, 0.0], True, [ROCKED + 0.15 * SLID_PER_MM]),
        ([1.0, 0.0], False, [ROCKED + SLID_PER_MM]),
        ([9.0, 9.0, 9.0], True, [MOST_ROCKED] * ROCKED_TIMES),
    ],
)
def test_after_a_rock_the_force_is_raised_by_the_way_that_it_slid(slides_mm, is_told, factors):
    rig = build("fruit", SEED, sensor_name="taxels")
    rig.gripper.grip(0.2)
    hold = RockedHold(slides_mm, is_told=is_told)
    before_m = rig.arm.pose().position_m
    goes_on = _rock(rig, hold, load("fruit")[0].verify, 1.0, 0.1 * SIDE_M, before_m[2] + 0.004)
    assert goes_on is (len(factors) < ROCKED_TIMES)  # nothing makes the force grow here
    assert hold.asked_n == pytest.approx([0.2 * factor for factor in factors])
    assert hold.num_hung == len(factors)  # its place is another one after each slide
    assert hold.num_rests >= 1
    slid_mm = sum(min(slid_mm, MOST_RISE_MM) for slid_mm in slides_mm[: len(factors)])
    risen_m = rig.arm.pose().position_m - before_m  # up to the top
    assert risen_m == pytest.approx([0.0, 0.0, min(slid_mm / 1000, 0.004)], abs=1e-9)


def test_a_grip_that_may_not_grow_is_reported_and_nothing_falls():
    rig, found, least_n = lifted_off(0.5, limit_n=0.55 * 0.2, lift_off_mm=0.5)
    assert "still slips 5 mm above" in found.problem
    assert not rig.grasp.hangs
    assert not rig.truth().dropped
    assert rig.truth().peak_force_n <= least_n


def test_a_lift_off_goes_no_higher_than_the_lift():
    rig, _, _ = lifted_off(0.3, limit_n=0.05, lift_off_mm=4.0, lift_mm=10.0)
    assert rig.arm.pose().position_m[2] < 0.21
    assert not rig.truth().dropped


def test_without_shear_nothing_moves():
    rig, found, _ = lifted_off(0.6, sensor="gelsight_mini")
    assert (found.problem, found.floor_n) == ("", 0.0)
    assert math.isclose(rig.arm.pose().position_m[2], 0.20)


def test_what_slides_at_the_limit_is_rocked_no_harder_and_does_not_fall():
    rig = build("fruit", SEED, sensor_name="taxels", start_offset_mm=(0.0, 0.0))
    holds_n = rig.grasp.fingers.slip_minimum_n([(0.0, 0.0)]) / rig.gripper.force_gain
    rig, found, _ = lifted_off(1.0, limit_n=2 * 1.2 * holds_n)  # the guard sends half of it
    assert found.problem == "it slides on at the largest force that its limit allows"
    assert rig.grasp.hangs and not rig.truth().dropped
