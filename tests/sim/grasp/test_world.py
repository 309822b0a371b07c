"""What becomes of a body: carried, slid, dropped, bruised."""

import dataclasses

import numpy as np
import pytest

from cltp.tactile.sensors import sensor_named
from sim.gel.layer import gel_of
from sim.grasp.bodies import draw_body
from sim.grasp.fingers import GRAVITY_M_S2, FlatFingers
from sim.grasp.world import Grasp


def grasp(offset_mm: tuple[float, float] = (0.0, 0.0), **changes: object) -> Grasp:
    body = draw_body("cherry_tomato", np.random.default_rng(3))
    settings = {"com_mm": (0.0, 0.0), "friction": 0.5, "mass_kg": 0.02, "bruise_n": 2.0}
    body = dataclasses.replace(body, **{**settings, **changes})
    fingers = FlatFingers(body, sensor_named("gelsight_mini"), gel_of("gelsight_mini"))
    return Grasp(fingers=fingers, body_xy_mm=offset_mm)


def test_open_fingers_leave_the_body_where_it_is():
    world = grasp((5.0, 2.0))
    world.move((3.0, 0.0), 0.1, 0.5)
    assert world.offset_mm == pytest.approx((2.0, 2.0))


def test_closed_fingers_carry_the_body_along():
    world = grasp((5.0, 2.0))
    world.close(1.0)
    world.move((3.0, 10.0), 0.1, 0.5)
    assert world.offset_mm == pytest.approx((5.0, 2.0))
    assert not world.slipped


def test_a_grip_that_is_too_light_slides_with_the_acceleration_that_is_left_over():
    world = grasp()
    friction_n = 2 * 0.5 * 0.05
    world.close(0.05)
    world._lifted_mm = 10.0
    seconds = 0.02
    world.wait(seconds)
    acceleration = (0.02 * GRAVITY_M_S2 - friction_n) / 0.02
    assert world.slip_mm == pytest.approx(1000 * acceleration * seconds**2 / 2, rel=0.03)
    assert world.offset_mm[1] == pytest.approx(-world.slip_mm, rel=0.02)


def test_a_grip_that_is_firm_enough_does_not_slide_at_all():
    world = grasp()
    world.close(1.0)
    world.move((0.0, 40.0), 0.4, 2.5)
    world.wait(2.0)
    assert world.slip_mm == 0.0


def test_a_grip_far_too_light_leaves_the_body_on_its_support():
    world = grasp()
    world.close(0.02)
    world.move((0.0, 40.0), 0.4, 2.5)
    world.wait(2.0)
    assert world.slipped and world.patch is None and not world.dropped
    assert world.body_xy_mm == (0.0, 0.0)


def test_a_grip_that_gives_way_high_up_ends_in_a_drop():
    world = grasp()
    world.close(1.0)
    world.move((0.0, 40.0), 0.4, 2.5)
    world.close(0.02)
    world.wait(2.0)
    assert world.dropped and world.slipped and world.patch is None


def test_a_grip_that_gives_way_low_down_sets_the_body_on_its_support():
    world = grasp()
    world.close(1.0)
    world.move((0.0, 3.0), 0.05, 0.5)
    world.close(0.05)
    world.wait(2.0)
    give_mm = world.fingers.give_mm(world.patch)
    assert not world.dropped
    assert world.slip_mm == pytest.approx(3.0, abs=2 * give_mm + 0.2)
    slid_mm = world.slip_mm
    world.wait(2.0)
    assert world.slip_mm == slid_mm


class Raiser:
    """Raises the force of a grip once, in the middle of a rise."""

    def __init__(self, world: Grasp, after_s: float, force_n: float) -> None:
        self.world, self.left_s, self.force_n = world, after_s, force_n

    def until_next_s(self) -> float:
        return 0.01

    def passed(self, seconds: float) -> None:
        self.left_s -= seconds
        if abs(self.left_s) < seconds / 2:
            self.world.adjust(self.force_n)


def test_pads_slide_up_along_a_body_until_they_grip_firmly_enough():
    world = grasp()
    world.close(0.1)  # half of what carries 0.2 N at a friction of 0.5
    world.beat = Raiser(world, 0.2, 0.4)
    world.move((0.0, 3.0), 0.005, 0.5)
    assert world.offset_mm[1] == pytest.approx(-1.0, abs=0.2)  # of 5 mm/s for 0.2 s
    assert not world.slipped  # it is held from there on
    assert world.body_xy_mm[1] == pytest.approx(2.0, abs=0.2)
    world.beat = None
    world.move((0.0, 40.0), 0.4, 2.5)
    assert not world.slipped and not world.dropped


def test_a_slide_stops_when_the_fingers_stop_accelerating():
    world = grasp()
    world.close(0.25)  # holds the weight (0.2 N), not weight and 8 m/s² aside
    world._lifted_mm = 10.0
    world.load((8.0, 0.0), 0.03)
    slid = world.slip_mm
    world.load((0.0, 0.0), 1.0)
    assert slid > 0
    assert world._speed == 0.0 and not world.dropped


def test_what_stands_is_not_loaded_until_it_is_lifted():
    world = grasp()
    world.close(0.02)
    world.move((10.0, 0.0), 0.4, 8.0)
    world.wait(5.0)
    assert world.slip_mm == 0.0


def test_letting_go_in_the_air_drops_and_on_the_ground_does_not():
    low, high = grasp(), grasp()
    for world, lift in ((low, 0.0), (high, 30.0)):
        world.close(1.0)
        world.move((0.0, lift), 0.1, 0.5)
        world.open()
    assert not low.dropped
    assert high.dropped


def test_the_first_grip_bruises_at_the_start_and_a_later_one_by_its_action():
    first, later = grasp(), grasp()
    first.close(2.5)
    later.close(1.0)
    later.close(2.5)
    assert (first.bruised_at_start, first.bruised) == (True, False)
    assert (later.bruised_at_start, later.bruised) == (False, True)


def test_no_more_pressure_than_was_borne_before_makes_no_new_bruise():
    world = grasp()
    world.close(2.5)
    world.open()
    world.close(2.5)
    world.close(2.2)
    assert world.bruised_at_start and not world.bruised
    world.close(3.5)
    assert world.bruised


def test_the_edge_of_the_pad_bruises_where_the_centre_does_not():
    centred, cut = grasp(), grasp((10.0, 7.0))
    for world in (centred, cut):
        world.close(1.5)
    assert not centred.bruised_at_start
    assert cut.bruised_at_start


def test_fingers_that_meet_nothing_hold_nothing():
    world = grasp((40.0, 0.0))
    world.close(1.0)
    assert world.patch is None and world.peak_force_n == 0.0


@pytest.mark.parametrize("lift_mm", [40.0, 37.3, 0.8])
def test_a_body_that_was_set_down_stands_and_a_light_touch_leaves_it_there(lift_mm):
    world = grasp((1.0, 0.5))
    for _ in range(3):
        world.close(1.0)
        world.move((0.0, lift_mm), 0.4, 2.5)
        assert world.hangs
        world.move((0.0, -lift_mm), 0.4, 2.5)
        assert not world.hangs
        world.open()
        world.close(0.01)
        world.open()
    assert world.slip_mm == 0.0
    assert world.body_xy_mm == pytest.approx((1.0, 0.5))


def test_a_body_that_is_let_go_just_above_its_support_stands_on_it_again():
    world = grasp()
    world.close(1.0)
    world.move((0.0, 0.8), 0.4, 2.5)
    world.open()
    assert world.body_xy_mm == pytest.approx((0.0, 0.0))
    world.close(0.05)
    assert not world.hangs and not world.dropped


def test_what_a_body_that_slides_along_is_pressed_with_counts():
    world = grasp((0.0, 5.5))
    world.close(0.3)
    at_first = world.peak_kpa
    world.pad_xy_mm = (0.0, -3.0)  # towards the edge, which presses harder
    assert world.patch is not None
    world._follow(world.patch)
    assert world.peak_kpa == world.patch.peak_kpa > at_first
