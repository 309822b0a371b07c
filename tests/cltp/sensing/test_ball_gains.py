"""Gains of a calibration are found from presses of a ball, whatever their depth and place."""

import dataclasses

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.sensing.ball_gains import (
    LARGEST_MISFIT,
    Gains,
    PressGains,
    corrected,
    gains_of,
    measure_gains,
    press_gains,
)
from cltp.sensing.ball_presses import BallPress, SphericalCap, slopes_of
from cltp.sensing.photometric import Photometer
from tests.cltp.sensing.test_calibration import COLUMN, PX, ROW, SKIRTS
from tests.cltp.sensing.test_photometric import BACKGROUND, LEVELS, LINEAR, SENSOR

DIAMETER_MM = 6.0


def frame_of(press: BallPress) -> np.ndarray:
    """A frame under the law that ``LINEAR`` knows: red for x, blue for down."""
    slopes = slopes_of(press, SKIRTS, COLUMN.ravel(), ROW.ravel(), PX).reshape(*COLUMN.shape, 2)
    change = np.stack([slopes[..., 0], np.zeros(COLUMN.shape), slopes[..., 1]], axis=-1) * LEVELS
    return (BACKGROUND + np.rint(change)).clip(0, 255).astype(np.uint8)


PRESSES = [
    BallPress(column=160, row=120, depth_mm=0.7),
    BallPress(column=60, row=60, depth_mm=0.5),
    BallPress(column=250, row=180, depth_mm=0.9),
    BallPress(column=300, row=100, depth_mm=0.8),  # cut by the border
]
FRAMES = [frame_of(press) for press in PRESSES]


def with_gains(x: float, y: float) -> Photometer:
    """The right calibration, which then reads slopes x and y times as steep."""
    off = Gains(x=1 / x, y=1 / y, error_x=0, error_y=0, misfit=0, presses=(), rejected={})
    return Photometer(corrected(LINEAR, off), BACKGROUND, SENSOR)


@pytest.mark.parametrize(("x", "y"), [(1.0, 1.0), (1.25, 1.0), (1.0, 1.25), (0.8, 1.1)])
def test_gains_are_found_and_taken_out(x: float, y: float) -> None:
    gains = measure_gains(with_gains(x, y), FRAMES, BACKGROUND, DIAMETER_MM)
    assert (gains.x, gains.y) == (pytest.approx(x, rel=0.02), pytest.approx(y, rel=0.02))
    assert gains.are_off() == (x != 1 or y != 1)
    assert gains.explain
    off = Gains(x=1 / x, y=1 / y, error_x=0, error_y=0, misfit=0, presses=(), rejected={})
    photometer = Photometer(corrected(corrected(LINEAR, off), gains), BACKGROUND, SENSOR)
    again = measure_gains(photometer, FRAMES, BACKGROUND, DIAMETER_MM)
    assert again.ratio == pytest.approx(1, abs=1e-3)
    assert not again.are_off()


def test_the_slopes_of_a_press_far_from_its_start_are_still_matched() -> None:
    press = BallPress(column=150, row=100, depth_mm=0.8)
    ball = SphericalCap(diameter_mm=DIAMETER_MM)
    everywhere = dataclasses.replace(press, depth_mm=3.0)  # the whole sphere
    slopes = slopes_of(everywhere, ball, COLUMN.ravel(), ROW.ravel(), PX).reshape(*COLUMN.shape, 2)
    slopes = np.nan_to_num(slopes)
    start = dataclasses.replace(press, column=153, row=98)
    found = press_gains(start, 1.3 * slopes[..., 0], 0.7 * slopes[..., 1], DIAMETER_MM, PX)
    assert (found.x, found.y) == (pytest.approx(1.3, rel=1e-3), pytest.approx(0.7, rel=1e-3))
    assert found.misfit < 1e-3


def test_colours_that_mean_something_else_are_flagged() -> None:
    """A unit whose lamps are turned by a quarter: no gains make its slopes right."""
    turned = dataclasses.replace(LINEAR, b3=LINEAR.b3[[3, 4, 5, 0, 1, 2]])
    photometer = Photometer(turned, BACKGROUND, SENSOR)
    gains = measure_gains(photometer, FRAMES, BACKGROUND, DIAMETER_MM)
    assert gains.misfit > LARGEST_MISFIT
    assert not gains.explain


def test_frames_without_a_ball_are_named_and_too_few_refused() -> None:
    photometer = with_gains(1, 1)
    gains = measure_gains(photometer, [BACKGROUND, *FRAMES[:3]], BACKGROUND, DIAMETER_MM)
    assert list(gains.rejected) == [0]
    with pytest.raises(TouchError, match="2 of 3 frames, expected at least 3"):
        measure_gains(photometer, [BACKGROUND, *FRAMES[:2]], BACKGROUND, DIAMETER_MM)


def test_a_gain_within_its_own_error_is_no_gain() -> None:
    scattered = [PressGains(x=x, y=1.0, misfit=0.1) for x in (0.8, 1.06, 1.3)]
    assert not gains_of(scattered).are_off()
    agreeing = [PressGains(x=x, y=1.0, misfit=0.1) for x in (1.06, 1.061, 1.062)]
    assert not gains_of(agreeing).are_off()  # three presses can agree by chance
    assert gains_of(3 * agreeing).are_off()
