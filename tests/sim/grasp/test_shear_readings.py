"""The simulated sensor reads the shear of its grasp, if it is one that measures any."""

import numpy as np
import pytest

from sim.grasp.rig import build


def lifted(name, **settings):
    rig = build("strawberry", 5, sensor_name=name, start_offset_mm=(0.0, 0.0), **settings)
    rig.gripper.grip(1.0)
    rig.grasp.move((0.0, 20.0), 0.1, 0.5)
    return rig


def test_a_sensor_without_shear_gives_none_and_follows_none():
    rig = lifted("gelsight_mini")
    rig.sensor.read()
    assert rig.sensor.last_shear() is None
    assert rig.grasp.shear is None


@pytest.mark.parametrize(
    ("name", "num_points", "frame_s"), [("gelsight_mini_markers", 63, 0.04), ("taxels", 144, 0.01)]
)
def test_a_held_berry_drags_the_points_down_by_what_the_gel_moves(name, num_points, frame_s):
    rig = lifted(name)
    before_s = rig.clock.simulated_s
    cloud, field = rig.sensor.read(4), rig.sensor.last_shear()
    assert rig.clock.simulated_s - before_s == pytest.approx(4 * frame_s)
    assert field.stamp == cloud.stamp
    assert 0.9 * num_points <= len(field.positions_mm) <= num_points
    assert field.force_n is None
    true = rig.grasp.shear.field()
    assert true.displacement_mm[:, 1].min() < -0.01
    found = [
        np.flatnonzero((true.positions_mm == each).all(axis=1))[0] for each in field.positions_mm
    ]
    errors = field.displacement_mm - true.displacement_mm[found]
    assert 1e-4 < errors.std() < 0.02


def test_a_perfect_unit_reads_the_true_field():
    rig = lifted("gelsight_mini_markers", noise_level=0.0)
    rig.sensor.read()
    np.testing.assert_allclose(
        rig.sensor.last_shear().displacement_mm, rig.grasp.shear.field().displacement_mm, atol=1e-6
    )


def test_two_units_have_other_noise_and_one_seed_always_the_same():
    fields = []
    for seed in (1, 1, 2):
        rig = build("strawberry", seed, sensor_name="taxels")
        rig.sensor.read()
        fields.append(rig.sensor.last_shear().displacement_mm)
    np.testing.assert_array_equal(fields[0], fields[1])
    assert (fields[0] != fields[2]).any()


def test_shear_changes_nothing_of_what_becomes_of_the_berry():
    truths = []
    for name in ("gelsight_mini", "gelsight_mini_markers"):
        rig = build("strawberry", 5, sensor_name=name, gripper_force_gain=0.4)
        rig.gripper.grip(0.8)
        rig.grasp.move((0.0, 20.0), 0.4, 2.5)
        rig.clock.sleep(0.2)
        truths.append(rig.truth())
    assert truths[0] == truths[1]
    assert truths[0].slip_mm > 0
