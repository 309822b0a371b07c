"""What a touched object needs: its size and stiffness out of openings and felt forces."""

import math

import numpy as np
import pytest

from policies import Observation
from policies.needs import NEEDS, FeltNeed, TouchedObject
from primitives.sense import Interval
from tests.fakes.loop_fakes import touch

BERRY = NEEDS["strawberry"]


def grip(
    commanded_n: float, *, gain: float, size_mm: float, young_mpa: float, bias: float = 1.0
) -> Observation:
    """A grip of a berry by fingers with a hidden gain, felt with a bias."""
    force_n = gain * commanded_n
    approach = float(BERRY.approach_mm.at(np.float64(size_mm), np.float64(young_mpa), force_n))
    felt = bias * force_n
    return Observation(
        cloud=touch(),
        in_contact=True,
        width_m=(size_mm - 2 * approach) / 1000,
        commanded_force_n=commanded_n,
        felt_force_n=Interval(value=felt, low=felt / 1.35, high=felt * 1.35),
    )


def usual_young(size_mm: float) -> float:
    return float(BERRY.young_mpa.at(np.float64(size_mm), np.float64(0.2)))


def felt_need(size_mm: float, young_mpa: float, gain: float = 1.0, bias: float = 1.0) -> FeltNeed:
    touched, need = TouchedObject(BERRY), None
    for commanded_n in (0.1, 0.2, 0.4):
        observation = grip(
            commanded_n / gain, gain=gain, size_mm=size_mm, young_mpa=young_mpa, bias=bias
        )
        need = touched.feel(observation, is_whole=True)
    assert need is not None
    return need


@pytest.mark.parametrize("size_mm", [22.0, 30.0, 45.0])
@pytest.mark.parametrize("gain", [0.5, 2.0])
def test_the_size_is_read_through_the_flesh_that_gives_way(size_mm, gain):
    need = felt_need(size_mm, usual_young(size_mm), gain)
    assert need.size_mm == pytest.approx(size_mm, rel=0.01)
    assert need.young_mpa == pytest.approx(usual_young(size_mm), rel=0.1)


def test_a_hidden_gain_changes_nothing_of_the_need_in_felt_newtons():
    weak, strong = (felt_need(30.0, 0.2, gain) for gain in (0.5, 2.0))
    assert weak.least_n == pytest.approx(strong.least_n, rel=1e-6)
    assert weak.most_n == pytest.approx(strong.most_n, rel=1e-6)


def test_of_one_size_the_softer_berry_stands_less():
    usual = usual_young(30.0)
    soft, firm = felt_need(30.0, 0.8 * usual), felt_need(30.0, 1.25 * usual)
    assert soft.young_mpa < firm.young_mpa
    assert soft.most_n < firm.most_n


def test_a_felt_force_that_reads_high_is_known_by_the_opening_in_part():
    true, biased = felt_need(30.0, usual_young(30.0)), felt_need(30.0, usual_young(30.0), bias=1.3)
    # all of a bias would leave the need as it is, none would raise it by 1.3
    assert 1.05 < biased.least_n / true.least_n < 1.3


def test_a_larger_berry_needs_more_and_stands_more():
    small, large = (felt_need(size, usual_young(size)) for size in (23.0, 45.0))
    assert large.least_n > 4 * small.least_n
    assert large.most_n > 4 * small.most_n
    for need in (small, large):
        assert 1.5 < need.most_n / need.least_n < 3.0


@pytest.mark.parametrize("changes", [{"felt_force_n": None}, {"width_m": 0.0}, {"width_m": None}])
def test_without_a_felt_force_or_an_opening_nothing_is_told(changes):
    from dataclasses import replace

    observation = replace(grip(0.3, gain=1.0, size_mm=30.0, young_mpa=0.2), **changes)
    assert TouchedObject(BERRY).feel(observation, is_whole=True) is None


def test_grips_that_the_pads_edge_cuts_count_until_one_is_whole():
    touched = TouchedObject(BERRY)
    cut = grip(0.2, gain=1.0, size_mm=40.0, young_mpa=usual_young(40.0), bias=3.0)
    whole = grip(0.2, gain=1.0, size_mm=30.0, young_mpa=usual_young(30.0))
    first = touched.feel(cut, is_whole=False)
    second = touched.feel(whole, is_whole=True)
    third = touched.feel(cut, is_whole=False)
    assert first is not None and second is not None and third is not None
    assert first.size_mm == pytest.approx(40.0, rel=0.02)
    assert second.size_mm == pytest.approx(30.0, rel=0.01)
    assert third.size_mm == second.size_mm
    assert math.isfinite(third.least_n)
