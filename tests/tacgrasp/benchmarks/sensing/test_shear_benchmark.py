"""The benchmark of friction: its closed forms agree with one another, its figures with them."""

import numpy as np
import pytest

from sim.gel.shear.coarse import CoarseShear
from tacgrasp.benchmarks.sensing import shear, shear_pace
from tacgrasp.benchmarks.sensing.shear import Mindlin

FORMS = Mindlin(limit_n=2.0, slide_mm=0.03)


def test_load_and_shift_are_inverse():
    for t in (0.0, 0.3, 0.99):
        assert FORMS.load(FORMS.shift_mm(t)) == pytest.approx(t)


def unloading(force_n, t):
    """Shift of Masing's branch from a load t down to ``force_n``: the first loading, doubled."""
    down = (t * FORMS.limit_n - force_n) / (2 * FORMS.limit_n)
    return FORMS.shift_mm(t) - 2 * np.vectorize(FORMS.shift_mm)(down)


def test_loss_and_residue_are_those_of_masing_s_branches():
    t = 0.7
    force = np.linspace(-t, t, 4001) * FORMS.limit_n
    down = unloading(force, t)
    up = -unloading(-force, t)
    assert up[-1] == pytest.approx(down[-1])
    assert np.trapezoid(down - up, force) == pytest.approx(FORMS.loss_mj(t), rel=1e-4)
    assert unloading(0.0, t) == pytest.approx(FORMS.residue_mm(t))


def by_key(figures):
    return {figure.key: figure.value for figure in figures}


def test_the_stuck_layer_and_the_twist_are_within_their_limits():
    found = by_key(shear.stuck_layer() + shear.twist())
    assert abs(found["stuck_layer_error_percent"]) < 2
    assert abs(found["sliding_twist_error_percent"]) < 5


def test_the_shift_and_stick_radius_of_a_thick_layer_are_within_their_limit():
    found = by_key(shear.cattaneo_mindlin(100, size=31, loads=4))
    assert abs(found["mindlin_shift_error_percent_100_radii"]) < 5
    assert abs(found["mindlin_stick_radius_error_percent_100_radii"]) < 5


def test_the_coarse_form_is_compared_with_the_full_one_along_a_path():
    path = shear_pace.path_of(15.0, 1.0, steps=12)
    error = shear_pace.pace_error(path)
    assert error.force.shape == error.stick.shape == (12,)
    assert 0 < error.force.max() < 0.05
    assert 0 < abs(error.stick).max() < 0.2
    last = shear_pace.follow(path, CoarseShear(path.layer, friction=shear_pace.FRICTION))[-1]
    assert last.force_n.norm().item() > 0
