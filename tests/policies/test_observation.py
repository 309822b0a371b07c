"""What a policy is given: a force that no gripper makes of its command is none."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cltp.tactile.cloud import Stamp, cloud_from_heights
from cltp.tactile.force_scale import POSSIBLE_RATIO
from cltp.tactile.measure import contact_state
from cltp.tactile.sensors import SENSORS
from policies import Observation
from policies.observation import is_impossible
from policies.rules import RulesPolicy
from primitives import Primitive
from primitives.devices import GripperState
from primitives.sense import Interval
from sim.grasp.devices import START_POSE
from tacgrasp.runtime.steps import Readings
from tests.fakes.contracts import contract

Y, X = np.mgrid[0:40, 0:50]
CLOUD = cloud_from_heights(
    0.4 * np.exp(-((X - 25) ** 2 + (Y - 20) ** 2) / 60), SENSORS["gelsight_mini"]
)
FELT_N = contact_state(CLOUD, in_contact=True).force_n


@pytest.mark.parametrize(
    ("commanded_n", "expected"),
    [(1.0, False), (0.34, False), (0.32, True), (0.0, False), (None, False)],
)
def test_a_force_is_impossible_beyond_three_times_a_command(
    commanded_n: float | None, expected: bool
) -> None:
    assert POSSIBLE_RATIO == 3.0
    assert is_impossible(1.0, commanded_n) is expected


@pytest.mark.parametrize("part", [0.9, 1.1])
def test_a_policy_is_given_no_force_that_no_command_makes(part: float) -> None:
    felt = Interval(value=part * POSSIBLE_RATIO, low=1.0, high=9.0)
    readings = Readings(
        cloud=CLOUD,
        tcp_pose=START_POSE,
        gripper=GripperState(width_m=0.03, force_n=1.0, closed=True),
        stamp=Stamp(monotonic_s=0.0, wall_s=0.0),
        started_s=0.0,
        in_contact=True,
        felt_force_n=felt,
    )
    assert readings.for_policy(0.0).felt_force_n == (felt if part < 1 else None)
    assert readings.felt_force_n == felt  # guard and record have it all the same


def test_rules_take_the_command_for_a_force_that_it_can_t_have_made() -> None:
    policy = RulesPolicy(move_step_mm=3.0)
    aim = contract(0.5 * FELT_N, 0.7 * FELT_N, 2 * FELT_N)
    seen = Observation(cloud=CLOUD, in_contact=True, commanded_force_n=0.9 * FELT_N)
    assert policy.decide(seen, aim).action is Primitive.DECREASE_FORCE
    light = replace(seen, commanded_force_n=0.3 * FELT_N)
    assert policy.decide(light, aim).action is Primitive.INCREASE_FORCE
