"""Loads that friction carries, and loads that it does not."""

import pytest
import torch

from sim.gel.shear.layer import ShearLayer
from sim.gel.shear.load import carry
from tests.sim.gel.shear.test_shear_layer import MU, by, mini, pressed

FORCE_N = 1.0
LAYER = ShearLayer(mini(), friction=MU)


def loaded(*loads, before=None):
    pressure = pressed(mini(), FORCE_N).expand(len(loads), -1, -1)
    return carry(LAYER, before, pressure, torch.tensor(loads, dtype=torch.float64))


def test_a_motion_is_found_that_carries_force_and_moment():
    load = [0.25, 0.1, 0.3]
    carried = loaded(load)
    assert carried.holds.all()
    found = [*carried.shear.force_n[0].tolist(), carried.shear.moment_nmm.item()]
    assert found == pytest.approx(load, abs=2e-3)
    again = LAYER.step(None, pressed(mini(), FORCE_N), carried.motion)
    assert again.force_n[0].tolist() == pytest.approx(load[:2], abs=2e-3)


def test_the_stick_fraction_falls_before_the_body_slides():
    fractions = []
    for t in (0.2, 0.5, 0.8, 0.95):
        carried = loaded([0.0, -t * MU * FORCE_N, 0.0])
        assert carried.holds.all()
        fractions.append(carried.shear.stick_fraction.item())
    assert fractions == sorted(fractions, reverse=True)
    assert fractions[0] > 0.9
    assert 0 < fractions[-1] < 0.35


def test_a_load_beyond_friction_is_not_held():
    carried = loaded([1.02 * MU * FORCE_N, 0.0, 0.0])
    assert not carried.holds.any()
    assert carried.shear.stick_fraction.item() == 0.0


def test_a_moment_takes_away_from_the_force_that_is_held():
    assert loaded([0.42, 0.0, 0.0]).holds.all()
    assert not loaded([0.42, 0.0, 0.6]).holds.any()


def test_a_contact_far_from_the_middle_carries_a_load_about_its_own_centre():
    middle = (6.0, -4.0)
    pressure = pressed(mini(), FORCE_N, middle=middle)
    force = [0.1, -0.3]
    moment = middle[0] * force[1] - middle[1] * force[0]
    carried = carry(LAYER, None, pressure, torch.tensor([[*force, moment]]))
    assert carried.holds.all()
    assert carried.evaluations < 10
    # No moment about its own centre, so that it is not turned.
    assert abs(carried.motion[0, 2].item()) < 1e-3
    assert carried.motion[0, 1].item() == pytest.approx(-3 * carried.motion[0, 0].item(), rel=0.05)


def test_loads_of_a_batch_are_carried_each_for_itself():
    loads = [0.1, 0.0, 0.0], [0.6, 0.0, 0.0], [0.0, 0.3, 0.2]
    carried = loaded(*loads)
    assert carried.holds.tolist() == [True, False, True]
    alone = loaded(loads[2])
    assert carried.shear.force_n[2].tolist() == pytest.approx(
        alone.shear.force_n[0].tolist(), abs=2e-3
    )


def test_a_contact_without_load_stays_as_it_was():
    before = LAYER.step(None, pressed(mini(), FORCE_N), by(0.05))
    load = [*before.force_n[0].tolist(), before.moment_nmm.item()]
    carried = loaded(load, before=before)
    assert carried.evaluations == 1
    assert carried.motion.abs().max() == 0


def test_a_load_of_another_shape_is_refused():
    with pytest.raises(ValueError, match="force x and y in N"):
        carry(LAYER, None, pressed(mini(), FORCE_N), torch.zeros(3))
