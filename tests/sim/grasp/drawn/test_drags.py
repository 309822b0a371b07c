"""Drawn drags: the body moves as fast as drawn, slides slowly or stops before."""

import numpy as np
import pytest

from sim.grasp.drawn.drags import AFTER_S, SPEED_MM_S, draw_drag, follow_drag
from sim.grasp.drawn.loads import STEP_S
from sim.grasp.holding import Holding

SLIDES, HOLDS = 100, 107
"""Seeds of a drag that slides by more than a millimetre, and of one that stops before."""


def test_a_seed_draws_the_same_drag_for_both_sensors():
    taxels, markers = (draw_drag(7, name) for name in ("taxels", "gelsight_mini_markers"))
    assert (taxels.speed_mm_s, taxels.force_n) == (markers.speed_mm_s, markers.force_n)
    assert (taxels.direction == markers.direction).all()


@pytest.mark.parametrize("seed", range(12))
def test_a_drag_rises_to_its_speed_and_ends_after_its_travel(seed):
    drag = draw_drag(seed, "taxels")
    assert np.linalg.norm(drag.direction) == pytest.approx(1.0)
    assert SPEED_MM_S.low <= drag.speed_mm_s <= SPEED_MM_S.high
    way_mm = np.array([drag.moved_mm(t_s) for t_s in np.arange(-0.1, 2.0, STEP_S)])
    steps_mm = np.diff(way_mm)
    assert (steps_mm >= 0).all() and steps_mm.max() <= drag.speed_mm_s * STEP_S + 1e-9
    assert (way_mm[0], way_mm[-1]) == pytest.approx((0.0, drag.travel_mm))


def test_a_slow_slide_goes_as_far_as_it_is_dragged_but_for_what_the_gel_gives():
    drag = draw_drag(SLIDES, "taxels")
    frames = list(follow_drag(drag, quiet=3))
    assert [frame.slipped_mm for frame in frames[:3]] == [0.0, 0.0, 0.0]
    assert 0.5 * drag.travel_mm < frames[-1].slipped_mm < drag.travel_mm
    assert any(frame.slides for frame in frames)
    middle = len(frames) // 2
    speed_mm_s = (frames[middle + 1].slipped_mm - frames[middle - 1].slipped_mm) / (2 * STEP_S)
    assert speed_mm_s == pytest.approx(drag.speed_mm_s, rel=0.15)


def test_a_drag_that_stops_early_does_not_slide_and_is_followed_a_while():
    drag = draw_drag(HOLDS, "taxels")
    frames = list(follow_drag(drag, quiet=1))
    assert frames[-1].slipped_mm == 0
    assert min(frame.stick_fraction for frame in frames) > 0.2
    ended_s = next(f.t_s for f in frames if drag.moved_mm(f.t_s) >= drag.travel_mm)
    assert frames[-1].t_s == pytest.approx(ended_s + AFTER_S, abs=2 * STEP_S)


def test_a_drag_needs_a_finite_motion():
    drag = draw_drag(HOLDS, "taxels")
    holding = Holding(drag.fingers, drag.force_n)
    with pytest.raises(ValueError, match=r"shape \(2,\)"):
        holding.drag(drag.force_n, (np.nan, 0.0))
