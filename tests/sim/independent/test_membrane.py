import numpy as np
import pytest

from sim.independent.membrane import MembraneGel, press

GEL = MembraneGel(decay_mm=0.6, springs_n_per_mm3=0.2)
PITCH_MM = 0.1
X, Y = np.meshgrid(np.arange(-60, 61) * PITCH_MM, np.arange(-60, 61) * PITCH_MM)


def test_beside_a_straight_edge_the_gel_decays_exponentially():
    gap = np.where(X <= 0, 0.0, 50.0)
    height = press(gap, 0.5, GEL, PITCH_MM).height_mm
    middle = height[60]
    beside = 0.5 * np.exp(-X[60, 60:100] / GEL.decay_mm)
    assert middle[:61] == pytest.approx(0.5)
    assert middle[60:100] == pytest.approx(beside, abs=0.004)


def test_nothing_of_the_body_is_inside_the_gel_and_free_gel_obeys_its_equation():
    gap = (X**2 + Y**2) / (2 * 4.0)
    solved = press(gap, 0.4, GEL, PITCH_MM)
    height, touching = solved.height_mm, solved.pressure_kpa > 0
    assert (height >= 0.4 - gap - 1e-9).all()
    assert height[touching] == pytest.approx((0.4 - gap)[touching])
    laplacian = sum(np.roll(height, shift, axis) for shift in (1, -1) for axis in (0, 1))
    rest = height - (GEL.decay_mm / PITCH_MM) ** 2 * (laplacian - 4 * height)
    free = ~touching
    free[[0, -1]] = free[:, [0, -1]] = False
    assert np.abs(rest[free]).max() < 0.01


def test_the_springs_carry_the_whole_force():
    gap = (X**2 + Y**2) / (2 * 4.0)
    solved = press(gap, 0.4, GEL, PITCH_MM)
    force_n = 1e-3 * solved.pressure_kpa.sum() * PITCH_MM**2
    springs_n = GEL.springs_n_per_mm3 * solved.height_mm.sum() * PITCH_MM**2
    assert force_n == pytest.approx(springs_n, rel=0.01)


def test_a_press_of_no_depth_is_refused():
    with pytest.raises(ValueError, match="above 0"):
        press(np.zeros((4, 4)), 0.0, GEL, PITCH_MM)
