"""The live world moves while the arm does, and shows the shear of its gel meanwhile."""

import numpy as np
import pytest

from sim.emulators.live_world import LiveWorld, sends_shear
from sim.emulators.ur.motion import MotionSegment
from sim.grasp.rig import build
from tests.fakes.waiting import poll

FORCE_N = 0.6
LIFT_M = np.array([0.0, 0.0, 0.02])


def segment(by_m, speed_m_s=0.2, acceleration_m_s2=2.5):
    return MotionSegment(np.array(by_m), np.zeros(3), speed_m_s, acceleration_m_s2)


@pytest.fixture
def rig():
    return build("strawberry", 3, sensor_name="taxels", start_offset_mm=(0.0, 0.0))


@pytest.fixture
def world(rig):
    world = LiveWorld(rig)
    world.width_under(FORCE_N)
    yield world
    world.close()


def dragged_um(world):
    world.height_mm()
    return 1e3 * float(np.abs(world.along_mm().mean(axis=(0, 1))).max())


def test_only_a_sensor_with_shear_at_its_taxels_has_one():
    assert sends_shear(build("strawberry", 3, sensor_name="taxels").sensor.spec)
    for name in ("gelsight_mini", "gelsight_mini_markers", "gelstereo"):
        other = build("strawberry", 3, sensor_name=name)
        assert not sends_shear(other.sensor.spec)
        with pytest.raises(ValueError, match="no shear at the cells"):
            LiveWorld(other)


def test_the_gel_is_dragged_while_the_arm_still_moves(world):
    assert world.height_mm().shape == (12, 12)
    assert world.along_mm().shape == (12, 12, 2)
    before_um = dragged_um(world)
    world.begin(segment(2 * LIFT_M, speed_m_s=0.02))
    poll(lambda: dragged_um(world) > before_um + 1)
    assert world.facts()["held"]
    world.follow(segment(LIFT_M, speed_m_s=0.02))


def test_a_force_that_is_commanded_in_the_middle_of_a_motion_is_there_before_its_end(world, rig):
    world.begin(segment(2 * LIFT_M, speed_m_s=0.0004))  # would take longer than any wait
    world.width_under(1.5 * FORCE_N)
    assert world.facts()["force_n"] == pytest.approx(1.5 * FORCE_N * rig.gripper.force_gain)
    world.follow(segment(np.zeros(3)))


def test_a_motion_that_is_played_comes_to_the_truth_of_the_simulated_rig(world):
    simulated = build("strawberry", 3, sensor_name="taxels", start_offset_mm=(0.0, 0.0))
    simulated.gripper.grip(FORCE_N)
    simulated.grasp.move((0.0, 20.0), 0.2, 2.5)
    plan = segment(LIFT_M)
    world.begin(plan)
    world.follow(plan)
    facts, truth = world.facts(), simulated.truth()
    assert facts["held"] == truth.held
    assert facts["slip_mm"] == pytest.approx(truth.slip_mm, abs=0.01)
    assert (facts["offset_x_mm"], facts["offset_y_mm"]) == pytest.approx(truth.offset_mm, abs=0.01)


def test_a_motion_that_is_cut_short_leaves_the_fingers_where_the_arm_stopped(world, rig):
    world.begin(segment(5 * LIFT_M, speed_m_s=0.02))
    world.follow(segment([0.0, 0.0, 0.001], speed_m_s=0.02))
    assert rig.grasp.pad_xy_mm == pytest.approx((0.0, 1.0), abs=1e-6)
    assert world.facts()["held"]
    assert rig.grasp.offset_mm == pytest.approx((0.0, 0.0), abs=0.05)


def test_a_motion_without_a_plan_is_followed_at_its_end(world, rig):
    world.follow(segment([0.0, 0.0, 0.002]))
    assert rig.grasp.pad_xy_mm == pytest.approx((0.0, 2.0))


def test_opening_in_the_middle_of_a_motion_drops_the_body(world):
    began_mm = world._rig.grasp.body_xy_mm[1]
    world.begin(segment(2 * LIFT_M, speed_m_s=0.02))
    poll(lambda: world._rig.grasp.body_xy_mm[1] > began_mm + 2)
    world.release()
    world.follow(segment([0.0, 0.0, 0.01], speed_m_s=0.02))
    assert world.facts()["dropped"]
