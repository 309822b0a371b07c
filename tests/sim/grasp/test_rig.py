"""The simulated rig: what its devices refuse, what is drawn by a seed, and what stays hidden."""

import dataclasses
import time

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter

from cltp import TouchError
from cltp.tactile.measure import contact_state
from cltp.tactile.noise_levels import NoiseLevels
from primitives import LimitError, RobotError
from primitives.devices import Pose
from sim.grasp.devices import START_POSE
from sim.grasp.rig import BENCHMARK_SEED, build


def shifted(dx_m: float = 0.0, dz_m: float = 0.0) -> Pose:
    return Pose(
        position_m=START_POSE.position_m + np.array([dx_m, 0.0, dz_m]),
        rotvec_rad=START_POSE.rotvec_rad,
    )


def test_the_same_seed_gives_the_same_touch_bit_for_bit():
    clouds = []
    for _ in range(2):
        rig = build("strawberry", 7)
        rig.gripper.grip(rig.first_force_n)
        clouds.append(rig.sensor.read().points_mm)
    assert np.array_equal(*clouds)


def test_noise_does_not_change_what_is_drawn():
    quiet, noisy = (build("strawberry", 7, noise_level=level) for level in (0.0, 1.0))
    assert quiet.truth() == noisy.truth()


def test_a_sensor_has_the_noise_of_its_own_kind():
    tilt_alone = NoiseLevels(fine=0.0, drift=0.0, scale=0.0)

    def slopes(sensor: str) -> float:
        tilts = []
        for seed in range(60):
            rig = build("peg", seed, sensor_name=sensor, noise_level=tilt_alone)
            points = rig.sensor.read().points_mm
            tilts.append(np.polyfit(points[:, 0], points[:, 2], 1)[0])
        return float(np.std(tilts))

    assert slopes("gelsight_mini") == pytest.approx(0.003, rel=0.4)
    assert slopes("taxels") == pytest.approx(0.001, rel=0.4)
    received = [
        len(build("peg", seed, sensor_name="gelstereo").sensor.read().points_mm)
        for seed in range(20)
    ]
    assert len(set(received)) > 1
    assert 0.94 < np.mean(received) / 23**2 < 1.0


def test_training_seeds_draw_starts_from_the_middle_and_benchmark_seeds_from_all():
    def reach(first: int) -> float:
        return max(abs(build("peg", first + i).truth().offset_mm[0]) for i in range(40))

    assert reach(0) <= 0.8 * 11.0
    assert 0.8 * 11.0 < reach(BENCHMARK_SEED) <= 11.0


def test_moving_towards_the_contact_brings_it_to_the_centre():
    rig = build("strawberry", 3, start_offset_mm=(5.0, -4.0))
    rig.arm.move_to(shifted(dx_m=0.005, dz_m=-0.004))  # right and down: base +x and -z
    assert rig.truth().offset_mm == pytest.approx((0.0, 0.0), abs=1e-9)


def test_the_true_force_is_the_commanded_one_times_the_hidden_factor():
    rig = build("strawberry", 3, start_offset_mm=(0.0, 0.0), gripper_force_gain=1.7)
    assert rig.gripper.grip(1.0).force_n == 1.0
    assert rig.truth().force_n == pytest.approx(1.7)


def test_a_perfect_sensor_feels_where_how_deep_and_how_firm():
    rig = build(
        "cherry_tomato", 3, start_offset_mm=(3.0, -2.0), gripper_force_gain=1.0, noise_level=0
    )
    rig.gripper.grip(1.0)
    state = contact_state(rig.sensor.read())
    assert (state.x_mm, state.y_mm) == pytest.approx((3.0, -2.0), abs=0.3)
    patch = rig.grasp.patch
    assert patch is not None
    assert state.depth_mm == pytest.approx(float(patch.height_mm.max()), abs=0.04)
    assert state.force_n == pytest.approx(1.0, rel=0.25)


def heights_mm(rig):
    """The gel in one frame, shape (rows, columns) [mm]."""
    cloud = rig.sensor.read()
    return cloud.points_mm[:, 2].reshape(cloud.grid)


def broad_mm(rig):
    """What is left of the gel after fine noise is averaged away [mm]."""
    return gaussian_filter(heights_mm(rig), 4)


def test_closing_on_nothing_does_not_draw_the_drift_anew():
    rig = build("strawberry", 3, start_offset_mm=(45.0, 0.0))
    before = broad_mm(rig)
    rig.gripper.grip(1.0)
    after = broad_mm(rig)
    assert before.std() > 0.02
    assert (after - before).std() < 0.1 * before.std()


def test_a_reference_takes_the_drift_away_until_minutes_have_passed():
    rig = build("strawberry", 3, start_offset_mm=(45.0, 0.0))
    drift_mm = broad_mm(rig).std()
    rig.sensor.take_reference()
    assert broad_mm(rig).std() < 0.1 * drift_mm
    rig.clock.advance(600.0)
    assert broad_mm(rig).std() > 0.3 * drift_mm


def test_the_reconstruction_error_of_a_contact_grows_with_its_depth():
    def error_mm(force_n):
        rig = build("egg", 3, start_offset_mm=(0.0, 0.0), gripper_force_gain=1.0)
        rig.sensor.take_reference()
        rig.gripper.grip(force_n)
        true_mm = rig.grasp.patch.height_mm
        scaled = true_mm * rig.sensor._noise.depth_scale
        return gaussian_filter(heights_mm(rig) - (scaled - np.median(scaled)), 4).std()

    assert error_mm(4.0) > 1.5 * error_mm(0.3)


def test_closed_fingers_are_shut_once_their_body_is_gone():
    rig = build("strawberry", 5)
    rig.gripper.grip(2.0)
    rig.grasp.move((0.0, 40.0), 0.4, 2.5)
    assert rig.gripper.state().width_m > 0.01
    rig.gripper.adjust(0.01)
    rig.grasp.wait(2.0)
    assert rig.grasp.dropped
    assert rig.gripper.state().width_m == 0.0


def test_a_mistyped_command_is_refused_and_nothing_moves():
    rig = build("strawberry", 3)
    for command in (
        lambda: rig.arm.move_to(shifted(dx_m=5.0)),
        lambda: rig.arm.move_to(shifted(dx_m=0.01), speed_m_s=50.0),
        lambda: rig.arm.move_to(dataclasses.replace(START_POSE, rotvec_rad=np.zeros(3))),
        lambda: rig.gripper.grip(-1.0),
        lambda: rig.gripper.grip(float("nan")),
        lambda: rig.gripper.grip(1000.0),
        lambda: rig.gripper.open_by(0.0),
    ):
        with pytest.raises(LimitError):
            command()
    assert rig.grasp.grips == 0
    assert np.array_equal(rig.arm.pose().position_m, START_POSE.position_m)


def test_disconnected_devices_refuse():
    rig = build("strawberry", 3)
    rig.disconnect()
    rig.disconnect()
    with pytest.raises(RobotError):
        rig.arm.pose()
    with pytest.raises(RobotError):
        rig.gripper.grip(1.0)
    with pytest.raises(TouchError):
        rig.sensor.read()


def test_computing_takes_no_simulated_time():
    clock = build("strawberry", 5).clock
    before = clock.monotonic(), clock.wall(), clock.stamp()
    time.sleep(0.01)
    assert (clock.monotonic(), clock.wall(), clock.stamp()) == before
    clock.sleep(0.5)
    assert clock.monotonic() - before[0] == pytest.approx(0.5)
    assert clock.wall() - before[1] == pytest.approx(0.5, abs=1e-5)


def test_simulated_motion_takes_simulated_time():
    rig = build("strawberry", 3)
    before = rig.clock.monotonic()
    rig.arm.move_to(shifted(dx_m=0.01), speed_m_s=0.05, acceleration_m_s2=0.5)
    assert rig.clock.monotonic() - before == pytest.approx(0.01 / 0.05 + 0.05 / 0.5, abs=0.05)


def test_an_unknown_object_is_refused_with_the_names_of_the_known():
    with pytest.raises(RobotError, match="known: strawberry"):
        build("melon", 0)
