"""Berries whose needs go with size and stiffness: closed forms against contact solves."""

from dataclasses import replace

import numpy as np
import pytest

from cltp.tactile.sensors import sensor_named
from sim.gel.layer import gel_of
from sim.grasp.bodies import OBJECTS, draw_body
from sim.grasp.fingers import FlatFingers
from sim.grasp.ripeness import BRUISE_KPA_PER_MPA, BRUISE_OVER_SLIP, LEAST_FRICTION, BerrySize

LOADS = [(0.0, 2.5), (10.0, 0.0), (-10.0, 0.0)]
"""Lift and shake of the verification, (sideways, upwards) [m/s²]."""


@pytest.fixture(scope="module")
def berries() -> list[FlatFingers]:
    """Drawn berries at the least friction."""
    drawn = [draw_body("strawberry", np.random.default_rng(seed)) for seed in range(10)]
    return [
        FlatFingers(
            replace(berry, friction=LEAST_FRICTION),
            sensor_named("gelsight_mini"),
            gel_of("gelsight_mini"),
        )
        for berry in drawn
    ]


def test_every_berry_bruises_at_1_8_to_2_6_times_what_holds_it_at_the_least_friction(berries):
    ratios = [each.body.bruise_n / each.slip_minimum_n(LOADS) for each in berries]
    assert min(ratios) >= 1.75
    assert max(ratios) <= 2.65
    assert max(ratios) > 1.15 * min(ratios)  # ripe and firm ones


def test_the_bruise_pressure_goes_with_the_stiffness_but_for_achenes(berries):
    ratios = [each.bruise_kpa / (BRUISE_KPA_PER_MPA * each.body.young_mpa) for each in berries]
    assert np.std(np.log(ratios)) < 0.1
    assert np.median(ratios) == pytest.approx(1.0, abs=0.1)


def size(mass_g: float) -> BerrySize:
    return BerrySize(mass_g=mass_g, size_mm=25 * (mass_g / 7) ** (1 / 3), com_mm=(0.0, 1.5))


def test_a_larger_berry_of_one_ripeness_is_firmer_and_stands_more():
    small, large = (size(mass_g).flesh(2.2) for mass_g in (6.0, 50.0))
    assert large.young_mpa > 1.5 * small.young_mpa
    assert large.bruise_n > 5 * small.bruise_n


def test_a_riper_berry_of_one_size_is_softer_and_its_ripeness_is_found_again():
    low, high = BRUISE_OVER_SLIP
    ripe, firm = (size(20.0).flesh(ratio) for ratio in (low, high))
    assert ripe.young_mpa < 0.85 * firm.young_mpa
    assert size(20.0).ripeness(ripe) == pytest.approx(low, rel=1e-3)


def test_without_a_moment_friction_alone_holds_the_load():
    centred = BerrySize(mass_g=20.0, size_mm=35.0, com_mm=(0.0, 0.0))
    assert centred.slip_minimum_n(0.2) == pytest.approx(0.02 * np.hypot(9.81, 10) / 0.6)


def test_the_masses_are_spread_evenly_over_their_logarithm():
    masses = [1000 * draw_body("strawberry", np.random.default_rng(s)).mass_kg for s in range(60)]
    middle = OBJECTS["strawberry"].mass_g.quantile(0.5)
    assert 18 <= sum(mass < middle for mass in masses) <= 42
