"""The gel's friction agrees with the world's: what holds sticks less and less, and then slides."""

import math

import numpy as np
import pytest
import torch

from cltp.gel.compliance import GelMaterial
from cltp.tactile.sensors import sensor_named
from sim.gel.layer import ElasticLayer, gel_of
from sim.gel.shear.coarse import CoarseShear
from sim.gel.shear.load import carry
from sim.grasp.bodies import draw_body
from sim.grasp.fingers import GRAVITY_M_S2, FlatFingers, grid_of

SENSOR = sensor_named("gelsight_mini")


@pytest.mark.parametrize("seed", [3, 5])
def test_a_berry_sticks_ever_less_until_the_world_lets_it_slide(seed):
    berry = draw_body("strawberry", np.random.default_rng(seed))
    gel = gel_of("gelsight_mini")
    fingers = FlatFingers(berry, SENSOR, gel)
    flesh = GelMaterial(thickness_mm=math.inf, young_mpa=berry.young_mpa, poisson=berry.poisson)
    rows, columns = grid_of(SENSOR)
    layer = ElasticLayer(gel, rows=rows, columns=columns, pitch_mm=SENSOR.width_mm / columns)
    coarse = CoarseShear(layer, friction=berry.friction, body=flesh)
    half_weight_n = berry.mass_kg / 2 * GRAVITY_M_S2
    load = [0.0, -half_weight_n, -berry.com_mm[0] * half_weight_n]
    fractions = []
    for factor in (3.0, 1.5, 1.1, 0.95):
        patch = fingers.press((0.0, 0.0), factor * half_weight_n / berry.friction)
        pressure = coarse.coarse(torch.as_tensor(patch.pressure_kpa)[None])
        carried = carry(
            coarse.shear_layer, None, pressure, torch.tensor([load]), load_tol=5e-3, tol=5e-4
        )
        assert carried.holds.item() == (fingers.resistance(patch, (0.0, 0.0)).margin >= 1)
        fractions.append(carried.shear.stick_fraction.item())
    assert fractions == sorted(fractions, reverse=True)
    assert fractions[0] > 0.85
    assert 0.1 < fractions[2] < 0.5
    assert fractions[3] < 0.05
