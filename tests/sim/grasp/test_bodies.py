"""Drawn bodies: ranges, quantiles, and the height field of a ball."""

import numpy as np
import pytest

from sim.gel.gap import NO_BODY_MM
from sim.grasp.bodies import OBJECTS, PITCH_MM, Range, draw_body


@pytest.mark.parametrize("name", OBJECTS)
@pytest.mark.parametrize("tails", [0.0, 0.1])
def test_every_property_lies_within_its_quantiles(name, tails):
    ranges = OBJECTS[name]
    for seed in range(12):
        body = draw_body(name, np.random.default_rng(seed), tails)
        for value, of in (
            (1000 * body.mass_kg, ranges.mass_g),
            (body.young_mpa, ranges.young_mpa),
            (body.friction, ranges.friction),
            (body.bruise_n, ranges.bruise_n),
        ):
            follows = ranges.ripeness is not None and of in (ranges.young_mpa, ranges.bruise_n)
            left_out = 0.0 if follows else tails  # what follows from others has no quantiles
            assert of.quantile(left_out) * 0.999 <= value <= of.quantile(1 - left_out) * 1.001


@pytest.mark.parametrize("name", OBJECTS)
def test_the_nearest_point_lies_at_the_middle_and_nothing_lies_before_it(name):
    body = draw_body(name, np.random.default_rng(5))
    middle = body.gap_mm.shape[0] // 2
    assert body.gap_mm.min() == 0.0
    assert body.gap_mm[middle, middle] < 0.15  # up to an achene
    assert body.gap_mm.max() == NO_BODY_MM


def test_the_same_seed_draws_the_same_body_and_another_one_another():
    same = [draw_body("strawberry", np.random.default_rng(seed)) for seed in (1, 1, 2)]
    assert np.array_equal(same[0].gap_mm, same[1].gap_mm)
    assert same[0].mass_kg == same[1].mass_kg != same[2].mass_kg


def test_a_heavier_berry_is_larger():
    light, heavy = Range(low=7, high=7), Range(low=40, high=40)
    sizes = []
    for mass in (light, heavy):
        rng = np.random.default_rng(0)
        from sim.grasp.bodies import _strawberry

        sizes.append(_strawberry(mass.low, rng)[3])
    assert sizes[1] / sizes[0] == pytest.approx((40 / 7) ** (1 / 3))


def test_a_peg_is_a_cylinder():
    body = draw_body("peg", np.random.default_rng(1))
    radius = body.thickness_mm / 2
    x = np.array([-3.0, 0.0, 3.0])
    gap = body.gap_on(x, np.array([2.0, 0.0, -2.0]))
    sagitta = radius - np.sqrt(radius**2 - 9.0)
    assert gap[:, 0] == pytest.approx([sagitta] * 3, abs=0.05)
    assert gap[:, 1] == pytest.approx([0.0] * 3, abs=0.02)


def test_beyond_its_grid_there_is_no_body():
    body = draw_body("egg", np.random.default_rng(1))
    assert (body.gap_on(np.array([60.0, 70.0]), np.array([1.0, 0.0])) == NO_BODY_MM).all()
    assert PITCH_MM < 0.2


def test_an_unknown_object_is_refused_with_the_names_of_the_known():
    with pytest.raises(ValueError, match="known: strawberry"):
        draw_body("melon", np.random.default_rng(0))


def test_a_log_range_has_its_geometric_mean_in_the_middle():
    assert Range(low=0.3, high=3.0, log=True).quantile(0.5) == pytest.approx(0.3 * 10**0.5)
