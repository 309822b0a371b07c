"""Places and depths of presses, fitted to colours that no function of the slope alone explains."""

from collections.abc import Sequence

import numpy as np
import pytest

from cltp.sensing.ball_presses import BallPress, heights_of, slopes_of
from cltp.sensing.photometric import COLOUR_SCALE
from cltp.train.photometric.places import TURNS, fit_brightening, fit_places, light_of
from tests.cltp.sensing.test_calibration import COLUMN, LAMPS, PX, ROW, SENSOR, SKIRTS, presses

BRIGHTER = np.array([15.0, 0.0, 20.0])  # levels for each mm of depth
DARKEST = 0.3  # light in the corners, over that in the middle


def shade() -> np.ndarray:
    x, y = COLUMN / SENSOR.columns - 0.5, ROW / SENSOR.rows - 0.5
    return 1 - (1 - DARKEST) * 2 * (x**2 + y**2)


BACKGROUND = np.rint(130 * shade()[..., None] * np.ones(3)).astype(np.uint8)


def change(press: BallPress, rng: np.random.Generator, growth: float = 0.0) -> np.ndarray:
    """Colours of three lamps and of the depth, in the shade, with noise of 2 levels.

    The lamps' part grows by ``growth`` for each mm of depth.
    """
    where = COLUMN.ravel(), ROW.ravel(), PX
    depth = heights_of(press, SKIRTS, *where)[:, None]
    levels = slopes_of(press, SKIRTS, *where) @ LAMPS.T * (1 + growth * np.maximum(depth, 0))
    levels += depth * BRIGHTER
    levels = levels * shade().reshape(-1, 1) + rng.normal(0, 2, levels.shape)
    return (levels / COLOUR_SCALE).astype(np.float32)


def errors(found: Sequence[BallPress], truth: Sequence[BallPress]) -> tuple[float, float]:
    """Root mean square distance [px] and difference of depth [mm]."""
    off = np.array(
        [
            (
                np.hypot(one.column - other.column, one.row - other.row),
                one.depth_mm - other.depth_mm,
            )
            for one, other in zip(found, truth, strict=True)
        ]
    )
    return tuple(np.sqrt(np.mean(off**2, axis=0)))


def test_presses_are_found_where_and_as_deep_as_they_are() -> None:
    rng = np.random.default_rng(0)
    cut = BallPress(column=300, row=225, depth_mm=0.9)  # in the shade of a corner
    truth = [*presses(10), cut]
    guesses = [
        BallPress(
            column=press.column + rng.uniform(-3, 3),
            row=press.row + rng.uniform(-3, 3),
            depth_mm=press.depth_mm * rng.uniform(0.85, 1.15),
        )
        for press in truth
    ]
    turns: list[int] = []
    fitted = fit_places(
        [change(press, rng) for press in truth],
        guesses, SKIRTS, BACKGROUND, SENSOR, lambda: turns.append(1),
    )  # fmt: skip
    assert len(turns) == TURNS
    before, after = (errors(found, truth) for found in (guesses, fitted))
    assert after[0] < 0.5 * before[0] and after[0] < 1.0  # px
    assert after[1] < 0.6 * before[1] and after[1] < 0.05  # mm


@pytest.mark.parametrize("growth", [0.0, 0.15, 0.3])
def test_light_that_grows_with_depth_is_found_and_none_where_there_is_none(growth: float) -> None:
    rng, truth = np.random.default_rng(0), presses(10)
    changes = [change(press, rng, growth) for press in truth]
    found = fit_brightening(changes, truth, SKIRTS, BACKGROUND, SENSOR)
    assert abs(found - growth) < 0.04


def test_light_is_the_background_without_its_grain() -> None:
    rng = np.random.default_rng(0)
    grainy = (BACKGROUND + rng.integers(-3, 4, BACKGROUND.shape)).astype(np.uint8)
    light = light_of(grainy).reshape(BACKGROUND.shape)
    middle = light[100:140, 140:180]
    np.testing.assert_allclose(middle, 130 / COLOUR_SCALE, rtol=0.03)
    assert light[0, 0, 0] < 0.5 * middle[0, 0, 0]
