"""The form for the closed loop against the full one."""

import pytest
import torch

from cltp.tactile.sensors import sensor_named
from sim.gel.layer import ElasticLayer, gel_of
from sim.gel.shear.coarse import LOOP_ITERATIONS, CoarseShear
from sim.gel.shear.layer import ShearLayer
from tests.sim.gel.shear.test_shear_layer import MU, by, pressed

PITCH = sensor_named("gelsight_mini").width_mm / 80


def world_gel(rows=60):
    return ElasticLayer(gel_of("gelsight_mini"), rows=rows, columns=80, pitch_mm=PITCH)


def test_the_coarse_form_follows_the_full_one_within_its_stated_error():
    gel = world_gel()
    full, coarse = ShearLayer(gel, friction=MU), CoarseShear(gel, friction=MU)
    pressure, a, b = pressed(gel, 1.0, ball_mm=15.0), None, None
    for motion in (by(0.05), by(0.1, 0.02, 0.01), by(-0.06), by(-0.1, 0.0, -0.02), by(0.03)):
        a, b = full.step(a, pressure, motion), coarse.step(b, pressure, motion)
        assert (a.force_n - b.force_n).norm().item() < 0.02 * MU
        assert a.stick_fraction.item() == pytest.approx(b.stick_fraction.item(), abs=0.08)
        assert b.iterations.item() <= LOOP_ITERATIONS
    assert b.pressure_kpa.shape == (1, 30, 40)


def test_a_coarse_pressure_keeps_its_force():
    gel = world_gel()
    coarse, pressure = CoarseShear(gel, friction=MU), pressed(gel, 1.0)
    total = coarse.coarse(pressure).sum().item() * (2 * PITCH) ** 2
    assert total == pytest.approx(pressure.sum().item() * PITCH**2, rel=1e-5)
    with pytest.raises(ValueError, match="expected a grid"):
        coarse.coarse(torch.zeros(60, 80))


def test_an_odd_grid_is_refused():
    with pytest.raises(ValueError, match="no multiple"):
        CoarseShear(world_gel(61), friction=MU)
