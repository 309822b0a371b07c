"""The world of the emulators does what the simulated rig of the same seed does."""

import dataclasses
import time

import numpy as np
import pytest

from cltp.tactile.sensor_noise import MINI_SPREAD
from primitives.devices import Pose
from sim.emulators.ur.motion import MotionSegment
from sim.emulators.world import SLIDE_PERIOD_S, SharedWorld
from sim.grasp.rig import FINE_PART, build


class Clock:
    """A clock that a test advances."""

    def __init__(self):
        self.now_s = 100.0

    def __call__(self):
        return self.now_s


def segment(by_m, rotvec_rad, speed_m_s, acceleration_m_s2):
    return MotionSegment(
        by_base_m=np.array(by_m),
        rotvec_rad=np.array(rotvec_rad),
        speed_m_s=speed_m_s,
        acceleration_m_s2=acceleration_m_s2,
    )


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def world(clock):
    world = SharedWorld(build("strawberry", 3), clock)
    yield world
    world.close()


def truth_of(rig):
    facts = dataclasses.asdict(rig.truth())
    x_mm, y_mm = facts.pop("offset_mm")
    return facts | {"offset_x_mm": x_mm, "offset_y_mm": y_mm}


def same(facts, rig):
    truth = truth_of(rig)
    return {name: facts[name] for name in truth} == pytest.approx(truth)


class Pair:
    """The same commands to a simulated rig and to the emulators' world."""

    def __init__(self, world, clock, rig):
        self.world, self.clock, self.rig = world, clock, rig

    def grip(self, force_n):
        state = self.rig.gripper.grip(force_n)
        self.clock.now_s += 0.6
        assert self.world.width_under(force_n) == pytest.approx(state.width_m)

    def open(self):
        before_s = self.rig.clock.simulated_s
        self.rig.gripper.open_by(0.002)
        self.clock.now_s += self.rig.clock.simulated_s - before_s
        self.world.release()

    def move(self, *by_m, speed_m_s=0.4, acceleration_m_s2=2.5):
        before, began_s = self.rig.arm.pose(), self.rig.clock.simulated_s
        target = Pose(position_m=before.position_m + by_m, rotvec_rad=before.rotvec_rad)
        self.rig.arm.move_to(target, speed_m_s=speed_m_s, acceleration_m_s2=acceleration_m_s2)
        self.clock.now_s += self.rig.clock.simulated_s - began_s
        self.world.follow(segment(by_m, np.zeros(3), speed_m_s, acceleration_m_s2))

    def wait(self, seconds):
        self.rig.clock.sleep(seconds)
        self.clock.now_s += seconds


def test_the_same_commands_come_to_the_same_truth_and_the_same_gel(world, clock):
    pair = Pair(world, clock, build("strawberry", 3))
    pair.grip(1.2)
    pair.open()
    pair.move(0.003, 0, 0)
    pair.grip(1.2)
    assert same(world.facts(), pair.rig)
    cloud = pair.rig.sensor.read()
    heights_mm, expected_mm = world.height_mm(), cloud.points_mm[:, 2].reshape(cloud.grid)
    # the frames' noise included; the drift of one period is less than a ten-thousandth
    assert heights_mm == pytest.approx(expected_mm, abs=1e-4)
    assert (world.facts()["grips"], world.facts()["contacts"]) == (2, 3)


def test_a_body_that_cannot_be_held_slides_alike_while_it_is_lifted_and_held(clock):
    simulated, emulated = (
        build("strawberry", 3, start_offset_mm=(0, 0), gripper_force_gain=1.0) for _ in range(2)
    )
    world = SharedWorld(emulated, clock)
    pair = Pair(world, clock, simulated)
    pair.grip(0.1)
    pair.move(0, 0, 0.04)
    for _ in range(4):
        pair.move(0.025, 0, 0, acceleration_m_s2=10)
        pair.move(-0.025, 0, 0, acceleration_m_s2=10)
    pair.wait(2.0)
    assert pair.rig.truth().slipped
    facts = world.facts()
    world.close()
    assert facts["slipped"]
    assert facts["dropped"] == pair.rig.truth().dropped
    assert facts["slip_mm"] == pytest.approx(pair.rig.truth().slip_mm, rel=0.2)


def mean_of_frames(world):
    return np.mean([world.height_mm() for _ in range(20)], axis=0)


def test_each_frame_has_its_own_noise_and_the_drift_goes_on_in_time(world, clock):
    fine_mm = np.std(world.height_mm() - world.height_mm()) / np.sqrt(2)
    assert 0.95 * FINE_PART.low < fine_mm / MINI_SPREAD.fine_mm < 1.05 * FINE_PART.high
    before = mean_of_frames(world)
    assert np.abs(mean_of_frames(world) - before).max() < 0.02
    clock.now_s += 120
    assert np.abs(mean_of_frames(world) - before).max() > 0.05


def test_closing_on_nothing_leaves_the_gel_as_it_was(clock):
    world = SharedWorld(build("strawberry", 3, start_offset_mm=(50.0, 0.0)), clock)
    before = mean_of_frames(world)
    assert world.width_under(0.6) == 0.0
    assert np.abs(mean_of_frames(world) - before).max() < 0.02
    world.close()


def test_the_gel_shows_a_slide_while_nothing_is_commanded(clock):
    rig = build("strawberry", 3, start_offset_mm=(0, 0), gripper_force_gain=1.0, noise_level=0.0)
    world = SharedWorld(rig, clock)
    body = rig.grasp.fingers.body
    slips_n = 0.85 * body.mass_kg * 9.81 / (2 * body.friction)
    world.width_under(2 * slips_n)
    world.follow(segment([0, 0, 0.02], np.zeros(3), 0.4, 2.5))
    world.width_under(slips_n)
    world.facts()
    before = world.height_mm()
    deadline = time.monotonic() + 20
    while np.array_equal(world.height_mm(), before) and time.monotonic() < deadline:
        clock.now_s += 2 * SLIDE_PERIOD_S
        time.sleep(0.005)
    assert not np.array_equal(world.height_mm(), before)
    world.close()


def test_a_tool_that_has_turned_moves_along_the_axes_that_it_has_now(clock):
    world = SharedWorld(build("peg", 3, start_offset_mm=(1.0, 2.0)), clock)
    world.follow(segment(np.zeros(3), [0, 0, np.pi / 2], 0.1, 0.5))
    world.follow(segment([0, 0.005, 0], np.zeros(3), 0.1, 0.5))
    facts = world.facts()
    world.close()
    assert (facts["offset_x_mm"], facts["offset_y_mm"]) == pytest.approx((-4.0, 2.0))


@pytest.mark.parametrize("force_n", [0.0, -1.0, float("nan")])
def test_fingers_do_not_close_with_no_force(world, force_n):
    with pytest.raises(ValueError, match="close with a force above 0 N"):
        world.width_under(force_n)


def test_the_world_has_no_faults_of_its_own(world):
    with pytest.raises(ValueError, match="faults are the devices'"):
        world.inject("earthquake")
