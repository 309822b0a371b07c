"""Berries whose needs go with size and stiffness: closed forms against contact solves."""

import math
from dataclasses import replace

import numpy as np
import pytest

from cltp.tactile.sensors import sensor_named
from sim.gel.layer import gel_of
from sim.grasp.bodies import OBJECTS, draw_body
from sim.grasp.fingers import FlatFingers
from sim.grasp.ripeness import (
    BRUISE_KPA_PER_MPA,
    BRUISE_OVER_SLIP,
    LEAST_FRICTION,
    flesh_of,
    slip_minimum_n,
)

SEEDS = range(12)
LOADS = [(0.0, 2.5), (10.0, 0.0), (-10.0, 0.0)]


def fingers_of(seed: int, friction: float = LEAST_FRICTION) -> FlatFingers:
    berry = draw_body("strawberry", np.random.default_rng(seed))
    slippery = replace(berry, friction=friction)
    return FlatFingers(slippery, sensor_named("gelsight_mini"), gel_of("gelsight_mini"))


@pytest.fixture(scope="module")
def berries() -> list[FlatFingers]:
    return [fingers_of(seed) for seed in SEEDS]


def test_every_berry_bruises_at_1_8_to_2_6_times_what_holds_it_at_the_least_friction(berries):
    ratios = [each.body.bruise_n / each.slip_minimum_n(LOADS) for each in berries]
    low, high = BRUISE_OVER_SLIP
    assert 0.97 * low <= min(ratios) and max(ratios) <= 1.03 * high
    assert max(ratios) > 1.2 * min(ratios)  # ripe and firm ones


def test_the_closed_form_of_the_slip_minimum_is_that_of_the_solved_contact(berries):
    for each in berries:
        body = each.body
        closed = slip_minimum_n(1000 * body.mass_kg, math.hypot(*body.com_mm))
        assert closed == pytest.approx(each.slip_minimum_n(LOADS), rel=0.05)


def test_the_bruise_pressure_goes_with_the_stiffness_within_its_scatter(berries):
    for each in berries:
        expected = BRUISE_KPA_PER_MPA * each.body.young_mpa
        assert each.bruise_kpa == pytest.approx(expected, rel=0.12)  # scatter, and achenes


def test_a_larger_berry_of_one_ripeness_is_firmer_and_stands_more():
    small, large = (
        flesh_of(mass, 25 * (mass / 7) ** (1 / 3), 1.0, bruise_over_slip=2.2)
        for mass in (6.0, 50.0)
    )
    assert large.young_mpa > small.young_mpa
    assert large.bruise_n / small.bruise_n > 0.8 * 50 / 6


def test_a_riper_berry_of_one_size_is_softer():
    low, high = BRUISE_OVER_SLIP
    ripe, firm = (flesh_of(20.0, 35.0, 1.0, ratio) for ratio in (low, high))
    assert ripe.young_mpa < 0.9 * firm.young_mpa
    assert firm.bruise_n / ripe.bruise_n == pytest.approx(high / low)


def test_half_of_all_berries_are_lighter_than_the_geometric_mean_of_the_range():
    masses = [1000 * draw_body("strawberry", np.random.default_rng(s)).mass_kg for s in range(60)]
    middle = math.sqrt(OBJECTS["strawberry"].mass_g.low * OBJECTS["strawberry"].mass_g.high)
    assert 15 <= sum(mass < middle for mass in masses) <= 45
