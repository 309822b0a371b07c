"""A held berry, step by step: it carries its load, sticks ever less, slides, and is caught."""

import time
from itertools import pairwise

import numpy as np
import pytest

from cltp.tactile.sensors import sensor_named
from sim.gel.layer import gel_of
from sim.grasp.bodies import draw_body
from sim.grasp.fingers import FlatFingers
from sim.grasp.holding import Holding

DT_S = 0.01
SETTLED = 40
"""Steps after which a held berry is at rest."""


@pytest.fixture(scope="module")
def fingers():
    berry = draw_body("strawberry", np.random.default_rng(13))
    return FlatFingers(berry, sensor_named("gelsight_mini"), gel_of("gelsight_mini"))


@pytest.fixture(scope="module")
def least_n(fingers):
    """Force of the world's own friction law at which the berry starts to slide."""
    return fingers.slip_minimum_n([(0.0, 0.0)])


def _settled(fingers, force_n, load_n, steps=SETTLED):
    holding = Holding(fingers, force_n)
    for k in range(steps):
        state = holding.step(DT_S, force_n, np.asarray(load_n) * min(1.0, (k + 1) / 10))
    return holding, state


def test_each_pad_carries_half_of_the_load(fingers, least_n):
    _, state = _settled(fingers, 2 * least_n, (0.1, -0.2))
    assert state.tangential_n == pytest.approx([0.05, -0.1], abs=0.02 * least_n)
    total = state.field.total_force_n
    assert total[:2] == pytest.approx(state.tangential_n, abs=1e-4)
    assert total[2] == pytest.approx(2 * least_n, rel=0.01)
    assert state.slipped_mm == 0


def test_it_sticks_ever_less_as_the_force_falls_and_slides_where_the_world_says_so(
    fingers, least_n
):
    fractions, slips, forces = [], [], np.linspace(1.6, 0.9, 71) * least_n
    holding, _ = _settled(fingers, forces[0], Holding(fingers, forces[0]).weight_n())
    for force_n in forces:
        state = holding.step(DT_S, force_n, holding.weight_n())
        fractions.append(state.stick_fraction)
        slips.append(state.slipped_mm)
    assert all(after <= before + 0.02 for before, after in pairwise(fractions[1:]))
    assert fractions[10] > 0.5
    assert any(0.05 < fraction < 0.4 for fraction in fractions)
    begins_n = forces[np.argmax(np.array(slips) > 0)]
    assert begins_n == pytest.approx(least_n, rel=0.06)


def test_what_friction_does_not_hold_accelerates_the_berry(fingers, least_n):
    holding, _ = _settled(fingers, 2 * least_n, Holding(fingers, 1.0).weight_n())
    force_n, steps = 0.6 * least_n, 6
    for _ in range(steps):
        state = holding.step(DT_S, force_n, holding.weight_n())
    body = fingers.body
    half_kg, half_n = body.mass_kg / 2, -holding.weight_n()[1] / 2
    acceleration = (half_n - body.friction * force_n) / half_kg
    assert state.stick_fraction < 0.02
    assert np.linalg.norm(state.tangential_n) == pytest.approx(body.friction * force_n, rel=0.03)
    assert state.slipped_mm == pytest.approx(500 * acceleration * (steps * DT_S) ** 2, rel=0.2)


def test_more_force_catches_a_sliding_berry_and_the_field_keeps_what_happened(fingers, least_n):
    holding, before = _settled(fingers, 2 * least_n, Holding(fingers, 1.0).weight_n())
    for _ in range(6):
        sliding = holding.step(DT_S, 0.8 * least_n, holding.weight_n())
    for _ in range(SETTLED):
        caught = holding.step(DT_S, 2 * least_n, holding.weight_n())
    assert 0 < sliding.slipped_mm <= caught.slipped_mm < sliding.slipped_mm + 0.1
    assert caught.stick_fraction > 0.9
    assert caught.tangential_n == pytest.approx(before.tangential_n, abs=0.02 * least_n)
    change_mm = caught.field.displacement_mm - before.field.displacement_mm
    assert np.abs(change_mm[:, :2]).max() > 1e-3


def test_a_load_that_is_gone_leaves_shear_in_the_gel(fingers, least_n):
    force_n = 2 * least_n
    holding, clean = _settled(fingers, force_n, (0.0, 0.0))
    friction_n = fingers.body.friction * force_n
    for load_n in (-1.2 * friction_n, 0.0):
        for _ in range(SETTLED):
            state = holding.step(DT_S, force_n, (0.0, load_n))
    left_kpa = state.shear.traction_kpa - clean.shear.traction_kpa
    assert np.abs(state.tangential_n[1]) < 0.02 * friction_n
    assert left_kpa.abs().max() > 0.1 * (fingers.body.friction * clean.shear.pressure_kpa.max())
    assert state.slipped_mm == 0


def test_a_berry_that_slid_off_touches_nothing(fingers, least_n):
    holding = Holding(fingers, least_n)
    for _ in range(60):
        state = holding.step(DT_S, 0.3 * least_n, holding.weight_n())
    assert state.dropped
    assert state.slipped_mm > 12
    assert np.abs(state.field.values).max() == 0


@pytest.mark.slow  # it measures time, of which a slow machine has less
@pytest.mark.usefixtures("one_thread")
def test_a_step_goes_at_the_rate_of_a_reflex(fingers, least_n):
    holding, _ = _settled(fingers, 2 * least_n, Holding(fingers, 1.0).weight_n())
    began = time.thread_time()
    for k in range(100):
        holding.step(DT_S, 2 * least_n, holding.weight_n((0.0, np.sin(0.3 * k))))
    assert time.thread_time() - began < 100 * 5e-3


@pytest.mark.parametrize(
    ("dt_s", "force_n", "load_n"),
    [(0.0, 1.0, (0, 0)), (0.01, 0.0, (0, 0)), (0.01, np.nan, (0, 0)), (0.01, 1.0, (0, 0, 0))],
)
def test_it_takes_no_step_that_nothing_can_make(fingers, dt_s, force_n, load_n):
    with pytest.raises(ValueError, match=r"force > 0|a step needs"):
        Holding(fingers, 1.0).step(dt_s, force_n, load_n)
