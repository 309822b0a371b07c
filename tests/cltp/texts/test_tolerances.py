"""The ± of numeric captions, held against drawn noise."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.sensor_noise import NoiseUnit
from cltp.tactile.sensors import SENSORS
from cltp.tactile.states import (
    NO_CONTACT_STATE,
    ContactState,
    area_word,
    depth_word,
    position_word,
)
from cltp.texts.tolerances import toleranced_caption, tolerances

MINI = SENSORS["gelsight_mini"]
X, Y = np.meshgrid(*grid_axes_mm(MINI, 76, 102))


def cap_state(depth_mm=0.5, radius_mm=3.0, force_n=2.0):
    fraction = math.pi * radius_mm**2 / MINI.area_mm2
    return ContactState(
        depth_mm=depth_mm,
        x_mm=1.0,
        y_mm=-2.0,
        area_fraction=fraction,
        force_n=force_n,
        depth=depth_word(depth_mm),
        position=position_word(1.0, -2.0, MINI),
        area=area_word(fraction),
    )


@pytest.mark.parametrize(("depth_mm", "radius_mm"), [(0.2, 2.0), (0.5, 3.0), (0.9, 4.0)])
def test_about_two_thirds_of_ideal_readings_of_a_noisy_cap_lie_within_them(depth_mm, radius_mm):
    state = cap_state(depth_mm, radius_mm)
    within = tolerances(state, MINI)
    squared = ((X - 1.0) ** 2 + (Y + 2.0) ** 2) / radius_mm**2
    clean = depth_mm * (1 - squared).clip(0)
    inside = squared < 1
    terms = np.stack([np.ones(inside.sum()), X[inside], Y[inside], squared[inside]], axis=1)
    hits = np.zeros(4)
    rng = np.random.default_rng(0)
    for _ in range(300):
        noisy = NoiseUnit.draw(rng).apply(clean, MINI, rng)
        _, along_x, _, bend = np.linalg.lstsq(terms, noisy[inside], rcond=None)[0]
        peak_x = 1.0 + along_x * radius_mm**2 / (-2 * bend)
        drift = (noisy - clean)[(squared > 0.8) & (squared < 1.2)].mean()
        hits += [
            abs(noisy[38 + 10, 51 + 5] - clean[38 + 10, 51 + 5]) < within.depth_mm,
            abs(peak_x - 1.0) < within.position_mm,
            abs(drift) / depth_mm * math.pi * radius_mm**2 < within.area_mm2,
            abs(noisy[inside].sum() / clean[inside].sum() - 1) * state.force_n < within.force_n,
        ]
    hit_rates = hits / 300
    assert (hit_rates > 0.55).all(), hit_rates
    assert hit_rates[0] < 0.8  # and no wider than need be


def test_a_cap_worked_out_by_hand():
    within = tolerances(cap_state(depth_mm=0.4, radius_mm=2.0, force_n=1.0), MINI)
    assert within.depth_mm == pytest.approx(math.hypot(0.04, 0.4 * 0.15 / math.sqrt(3)))
    slope = math.hypot(0.04 * math.sqrt(2 / 20), 0.003)
    cell = MINI.width_mm / 32 / math.sqrt(12)
    assert within.position_mm == pytest.approx(math.hypot(slope * 4 / 0.8, cell))
    assert within.area_mm2 == pytest.approx(math.pi * 4 * 0.04 / 0.4)
    assert within.force_n == pytest.approx(math.hypot(0.15 / math.sqrt(3), 0.2))


@given(st.floats(0.01, 2.0), st.floats(0.1, 7.0), st.floats(0.01, 20.0))
def test_tolerances_are_finite_grow_with_noise_and_never_pass_area_or_force(depth, radius, force):
    state = cap_state(depth, radius, force)
    less, more = tolerances(state, MINI, 0.5), tolerances(state, MINI, 1.0)
    for name in ("depth_mm", "position_mm", "area_mm2", "force_n"):
        assert 0 < getattr(less, name) <= getattr(more, name) < math.inf
    assert more.area_mm2 <= state.area_fraction * MINI.area_mm2 + 1e-9
    assert more.force_n <= state.force_n


def test_the_caption_gives_every_number_its_tolerance_and_leaves_out_an_unknown_force():
    assert toleranced_caption(cap_state(), MINI) == (
        "pressed 0.50 ± 0.06 mm at x +1.0, y -2.0 ± 0.2 mm, with 28.3 ± 2.3 mm² contact area "
        "and 2.00 ± 0.36 N."
    )
    assert " N" not in toleranced_caption(cap_state(force_n=math.nan), MINI)
    assert toleranced_caption(NO_CONTACT_STATE, MINI) == "no contact."
    assert tolerances(NO_CONTACT_STATE, MINI).depth_mm == 0
