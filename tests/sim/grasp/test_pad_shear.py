"""The gel of a grasp: it carries what the world carries, slides where it slides, and remembers."""

import dataclasses

import numpy as np
import pytest

from cltp.tactile.sensors import sensor_named
from sim.gel.layer import gel_of
from sim.grasp.bodies import draw_body
from sim.grasp.fingers import GRAVITY_M_S2, FlatFingers
from sim.grasp.pad_shear import PadShear
from sim.grasp.world import Grasp

MASS_KG, FRICTION = 0.02, 0.5
HALF_WEIGHT_N = MASS_KG / 2 * GRAVITY_M_S2


def grasp(*, with_shear: bool = True, com_mm: tuple[float, float] = (0.0, 0.0)) -> Grasp:
    body = draw_body("cherry_tomato", np.random.default_rng(3))
    body = dataclasses.replace(body, com_mm=com_mm, friction=FRICTION, mass_kg=MASS_KG)
    fingers = FlatFingers(body, sensor_named("gelsight_mini"), gel_of("gelsight_mini"))
    shear = PadShear(fingers) if with_shear else None
    return Grasp(fingers=fingers, body_xy_mm=(0.0, 0.0), shear=shear)


def traction_n(world: Grasp) -> np.ndarray:
    return world.shear.field().total_force_n[:2]


def test_a_closed_grip_of_a_supported_body_has_no_tangential_load():
    world = grasp()
    world.close(1.0)
    assert traction_n(world) == pytest.approx([0, 0], abs=1e-3)
    assert world.shear.field().total_force_n[2] == pytest.approx(1.0, rel=0.01)
    assert world.shear.shear.stick_fraction.item() > 0.99


def test_a_lifted_body_rests_on_the_traction_and_sticks_less_under_more_load():
    sticks = []
    for acceleration in (0.0, 5.0, 15.0):
        world = grasp()
        world.close(0.8)
        world._lifted_mm = 10.0
        world.load((0.0, acceleration), 0.1)
        load_n = HALF_WEIGHT_N * (1 + acceleration / GRAVITY_M_S2)
        assert traction_n(world) == pytest.approx([0, -load_n], abs=0.01 * FRICTION * 0.8)
        assert world.slip_mm == 0
        sticks.append(world.shear.shear.stick_fraction.item())
    assert 1 > sticks[0] > sticks[1] > sticks[2] > 0.2


def test_a_body_that_slides_carries_friction_times_normal_force_and_no_point_sticks():
    world = grasp()
    world.close(0.05)
    world._lifted_mm = 10.0
    world.wait(0.02)
    assert world.slip_mm > 0
    assert world.shear.shear.stick_fraction.item() <= 0.02
    assert traction_n(world) == pytest.approx([0, -FRICTION * 0.05], abs=0.02 * FRICTION * 0.05)


def test_shakes_leave_a_field_that_the_same_load_without_them_does_not_have():
    fields = []
    for accelerations in ([], [(0.0, 12.0), (0.0, -12.0), (8.0, 0.0)]):
        world = grasp()
        world.close(1.0)
        world._lifted_mm = 10.0
        for acceleration in [*accelerations, (0.0, 0.0)]:
            world.load(acceleration, 0.1)
        assert traction_n(world) == pytest.approx([0, -HALF_WEIGHT_N], abs=0.01 * FRICTION)
        fields.append(world.shear.field())
    change_n = np.abs(fields[1].force_n[:, :2] - fields[0].force_n[:, :2]).sum()
    assert change_n > 0.05 * HALF_WEIGHT_N


def test_open_fingers_have_no_shear_and_forget():
    world = grasp()
    world.close(1.0)
    world.move((0.0, 20.0), 0.1, 0.5)
    before = world.shear.field()
    world.open()
    assert np.abs(before.values).max() > 0
    assert np.abs(world.shear.field().values).max() == 0


def test_following_the_shear_changes_nothing_of_the_world():
    ends = []
    for with_shear in (False, True):
        world = grasp(with_shear=with_shear, com_mm=(0.5, -1.0))
        world.close(0.3)
        world.move((3.0, 20.0), 0.2, 2.0)
        world.close(0.2)
        world.wait(0.3)
        ends.append((world.slip_mm, world.body_xy_mm, world.peak_kpa, world.dropped))
    assert ends[0] == ends[1]


def test_without_shear_nothing_of_it_is_computed():
    world = grasp(with_shear=False)
    world.close(1.0)
    world.move((0.0, 20.0), 0.1, 0.5)
    assert "shear" not in vars(world.fingers)
