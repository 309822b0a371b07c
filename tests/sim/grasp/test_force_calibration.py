from dataclasses import replace

import numpy as np
import pytest

from cltp.tactile.measure import contact_state
from sim.gel.layer import gel_of
from sim.grasp.force_calibration import drawn_force_calibration
from sim.grasp.rig import build

NOMINAL = gel_of("gelsight_mini")


def test_factors_of_many_rigs_scatter_by_five_per_cent_over_the_root_of_four_loads():
    logs = [
        np.log(drawn_force_calibration("gelsight_mini", seed).factor) for seed in range(1000, 1400)
    ]
    assert abs(np.mean(logs)) < 0.005
    assert np.std(logs) == pytest.approx(0.05 / 2, rel=0.15)


def test_the_spread_of_the_loads_is_the_scatter_that_they_were_drawn_with():
    squares = [drawn_force_calibration("gelsight_mini", seed).spread ** 2 for seed in range(400)]
    assert np.sqrt(np.mean(squares)) == pytest.approx(0.05, rel=0.1)


def test_a_seed_gives_one_calibration_and_another_seed_another():
    one, same, other = (drawn_force_calibration("gelsight_mini", seed) for seed in (3, 3, 4))
    assert one == same
    assert one.factor != other.factor


@pytest.mark.parametrize("stiffness", [0.6, 1.7])
def test_the_factor_of_another_gel_is_its_stiffness_over_the_nominal_one(stiffness):
    gel = replace(NOMINAL, young_mpa=stiffness * NOMINAL.young_mpa)
    calibration = drawn_force_calibration("gelsight_mini", 0, gel=gel, scatter=0.0)
    assert calibration.factor == pytest.approx(stiffness, rel=0.15)
    thicker = replace(gel, thickness_mm=1.2 * NOMINAL.thickness_mm)
    softer = drawn_force_calibration("gelsight_mini", 0, gel=thicker, scatter=0.0)
    assert softer.factor < calibration.factor


@pytest.mark.parametrize("stiffness", [0.6, 1.7])
def test_a_force_felt_on_another_gel_is_near_that_on_the_nominal_one(stiffness):
    gel = replace(NOMINAL, young_mpa=stiffness * NOMINAL.young_mpa)
    felt = []
    for each in (None, gel):
        rig = build("egg", 5, start_offset_mm=(0.0, 0.0), noise_level=0.0, gel=each)
        rig.grasp.close(2.0)
        felt.append(contact_state(rig.sensor.read()).force_n)
    assert felt[1] == pytest.approx(felt[0], rel=0.15)


def test_the_rig_reads_forces_by_the_factor_of_its_own_calibration():
    rig = build("egg", 5, start_offset_mm=(0.0, 0.0))
    rig.grasp.close(2.0)
    cloud = rig.sensor.read()
    assert cloud.force_scale == rig.force_calibration.scale
    nominal = contact_state(replace(cloud, force_scale=replace(cloud.force_scale, factor=1.0)))
    felt_n = contact_state(cloud).force_n
    assert felt_n == pytest.approx(rig.force_calibration.factor * nominal.force_n)
