"""Drawn loads: some slip, some hold, and a load is the same for every sensor."""

import numpy as np
import pytest

from cltp.tactile.sensors import sensor_named
from sim.grasp.drawn.loads import GONE_S, STEP_S, LoadKind, draw_load, follow

SLIPS, HOLDS = 103, 101
"""Seeds of a load that friction can't hold, and of one that it can."""


def test_a_seed_draws_the_same_load_for_both_sensors():
    taxels, markers = (draw_load(7, name) for name in ("taxels", "gelsight_mini_markers"))
    assert (taxels.kind, taxels.force_n, taxels.ramp_s) == (
        markers.kind,
        markers.force_n,
        markers.ramp_s,
    )
    assert (taxels.extra_n == markers.extra_n).all()


@pytest.mark.parametrize("seed", range(12))
def test_a_load_rises_to_its_peak_and_a_jolt_falls_again(seed):
    load = draw_load(seed, "taxels")
    before, peak = load.load_n(0.0), load.carried_n + load.extra_n
    assert before == pytest.approx(load.carried_n)
    if load.kind is LoadKind.JOLT:
        assert load.load_n(load.ramp_s / 2) == pytest.approx(peak)
        assert load.load_n(load.duration_s) == pytest.approx(load.carried_n)
    else:
        assert load.load_n(load.duration_s) == pytest.approx(peak)


def test_a_body_that_friction_cannot_hold_slides_until_it_is_lost():
    frames = list(follow(draw_load(SLIPS, "taxels"), quiet=3))
    assert [frame.slipped_mm for frame in frames[:3]] == [0.0, 0.0, 0.0]
    gone = [frame.state.dropped for frame in frames]
    first = gone.index(True)
    assert frames[first].slides
    assert not frames[0].slides
    assert all(gone[first:]) and len(frames) - 1 - first == round(GONE_S / STEP_S)
    assert not frames[-1].field_of(sensor_named("taxels")).displacement_mm.any()


def test_the_indentation_follows_a_sliding_body():
    frames = list(follow(draw_load(SLIPS, "taxels"), quiet=1))
    slid = next(frame for frame in frames if frame.slipped_mm > 4.0)
    field_of = [frame.field_of(sensor_named("taxels")) for frame in (frames[0], slid)]
    middles = [
        np.average(
            field.positions_mm, axis=0, weights=field.displacement_mm[:, 2].clip(0.02) - 0.02
        )
        for field in field_of
    ]
    assert 1.0 < np.linalg.norm(middles[1] - middles[0]) < 2 * slid.slipped_mm


def test_a_held_body_keeps_sticking_and_more_force_holds_one_that_would_slide():
    held = list(follow(draw_load(HOLDS, "taxels"), quiet=0))
    assert held[-1].slipped_mm == 0
    load = draw_load(SLIPS, "taxels")
    firm = list(follow(load, quiet=0, force_n=lambda t_s: 2.5 * load.force_n))
    assert firm[-1].slipped_mm < 0.1
    assert firm[-1].force_n == pytest.approx(2.5 * load.force_n)
