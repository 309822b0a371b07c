"""Places and depths of presses, fitted to their colours together with the light that explains them.

What a press shows is a smooth function of the slope of the gel and of its depth: the light that
reaches a pixel grows as the gel is pushed towards the lamps, so that the lowest point of a ball
differs from untouched gel by 10 to 20 levels, though both are level. The function is a polynomial
whose coefficients vary over the sensing area, times the colours of the untouched gel, which carry
the fall of the light and the shade of the lens. Coefficients and presses are fitted in turns.

Slopes that a network reads are no measure for this: where it reads too little, presses are found
too shallow, it then learns still less, and calls both consistent.

Source: the direction of inference, shading from shape, after Horn, 'Obtaining shape from shading
information' (1975); the polynomial and its terms are ours.

Not here: the inverse, slopes from colours (``cltp.train.photometric.consensus``).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, optimize

from cltp.sensing.ball_presses import BallPress, ProfileTable, heights_of, slopes_of
from cltp.sensing.frames import Frame
from cltp.sensing.photometric import COLOUR_SCALE, position_inputs
from cltp.tactile.sensors import SensorSpec

FloatArray = NDArray[np.float64]

TURNS = 6
"""Fits of the coefficients, and of the presses after each."""

BRIGHTENINGS = (0.0, 0.1, 0.2, 0.3, 0.4)
"""Growths of the light with depth [1 / mm] of which the one of least misfit is interpolated."""

_NEAR_MM = 3.5  # of a press: ball, bulge and a rim
_SLOPED = 9  # terms of slopes alone, before those of the height
_STRIDE = 3  # pixels between those that are fitted to
_BLUR_PX = 6.0
_PENALTY = 1e-4  # of the coefficients, over their mean square feature
_EVEN = 0.1  # of the penalty, for coefficients that are constant or linear in position
_FOOTING = 4.0 / COLOUR_SCALE  # residuals beyond it count less: about twice the noise of a frame
_REACH_PX = 15.0
_LEAST_MM = 0.05


def light_of(background: Frame) -> FloatArray:
    """Colours of the untouched gel without its grain, (rows × columns, 3), in ``COLOUR_SCALE``."""
    blurred = ndimage.gaussian_filter(background.astype(np.float64), (_BLUR_PX, _BLUR_PX, 0))
    return np.maximum(blurred, 1.0).reshape(-1, 3) / COLOUR_SCALE


def fit_places(
    changes: Sequence[NDArray[np.float32]],
    presses: Sequence[BallPress],
    profiles: ProfileTable,
    background: Frame,
    sensor: SensorSpec,
    report: Callable[[], None],
) -> list[BallPress]:
    """Fit the presses of some frames.

    Args:
        changes: Change of colour of each frame, (rows × columns, 3).
        presses: A guess of each press, within a few pixels.
        profiles: The gel around the ball.
        background: The untouched gel.
        sensor: Sensor of the frames.
        report: Called ``TURNS`` times.
    """
    light, places = light_of(background), _place_terms(sensor)
    fitted = list(presses)
    for _ in range(TURNS):
        pixels = [_pixels_near(press, sensor) for press in fitted]
        coefficients = _fit_coefficients(changes, fitted, pixels, profiles, light, places, sensor)
        fitted = [
            _fit_press(
                press,
                change[near],
                near,
                np.einsum("nk,mkc->nmc", places[near], coefficients) * light[near, None],
                profiles,
                sensor,
            )
            for change, press, near in zip(changes, fitted, pixels, strict=True)
        ]
        report()
    return fitted


def fit_brightening(
    changes: Sequence[NDArray[np.float32]],
    presses: Sequence[BallPress],
    profiles: ProfileTable,
    background: Frame,
    sensor: SensorSpec,
) -> float:
    """Growth of the light with the depth of the gel [1 / mm], by which colours are explained best.

    The colour that depends on depth alone is fitted beside it, without regard to the place.
    """
    light, places = light_of(background), _place_terms(sensor)
    pixels = [_pixels_near(press, sensor) for press in presses]
    at, terms, colours = _observed(changes, presses, pixels, profiles, sensor)
    sloped = _products(terms[:, :_SLOPED], places[at])
    depth = terms[:, _SLOPED]
    alone = np.stack([depth, depth**2], axis=1)
    misfits = []
    for brightening in BRIGHTENINGS:
        growth = 1 + brightening * np.maximum(depth, 0)
        design = np.concatenate([sloped * growth[:, None], alone], axis=1)
        misfit = 0.0
        for colour in range(3):
            scaled = design * light[at, colour, None]
            solved = _ridge(scaled, colours[:, colour], np.ones(scaled.shape[1]))
            misfit += float(np.square(scaled @ solved - colours[:, colour]).mean())
        misfits.append(misfit)
    bend, slope, _ = np.polyfit(BRIGHTENINGS, misfits, 2)
    least = -slope / (2 * bend) if bend > 0 else 0.0
    return float(np.clip(least, 0.0, BRIGHTENINGS[-1]))


def _place_terms(sensor: SensorSpec) -> FloatArray:
    """Products of the coordinates of each pixel to their cubes, (rows × columns, K)."""
    return _polynomial(position_inputs(sensor).astype(np.float64), 0, 3)


def _observed(
    changes: Sequence[NDArray[np.float32]],
    presses: Sequence[BallPress],
    pixels: Sequence[NDArray[np.intp]],
    profiles: ProfileTable,
    sensor: SensorSpec,
) -> tuple[NDArray[np.intp], FloatArray, FloatArray]:
    """Pixels near all presses (N,), their terms (N, 13) and their changes of colour (N, 3)."""
    terms = [
        _terms(press, near, profiles, sensor) for press, near in zip(presses, pixels, strict=True)
    ]
    colours = [change[near] for change, near in zip(changes, pixels, strict=True)]
    return np.concatenate(pixels), np.concatenate(terms), np.concatenate(colours).astype(np.float64)


def _products(terms: FloatArray, places: FloatArray) -> FloatArray:
    """Each term times each of the place: (N, M), (N, K) -> (N, M × K)."""
    return (terms[:, :, None] * places[:, None, :]).reshape(len(terms), -1)


def _ridge(design: FloatArray, wanted: FloatArray, penalty: FloatArray) -> FloatArray:
    """Coefficients (K,) of a design (N, K) by least squares, ``_PENALTY`` times ``penalty``."""
    moments = design.T @ design
    squares = np.diag(moments)
    moments = moments + np.diag(_PENALTY * squares * penalty + 1e-9 * squares.mean())
    return np.linalg.solve(moments, design.T @ wanted).astype(np.float64)


def _polynomial(values: FloatArray, least: int, most: int) -> FloatArray:
    """Monomials of two columns from degree ``least`` to ``most``, ascending: (N, 2) -> (N, K)."""
    return np.stack(
        [
            values[:, 0] ** (degree - power) * values[:, 1] ** power
            for degree in range(least, most + 1)
            for power in range(degree + 1)
        ],
        axis=1,
    )


def _terms(
    press: BallPress, pixels: NDArray[np.intp], profiles: ProfileTable, sensor: SensorSpec
) -> FloatArray:
    """What the colours depend on, (N, 13): slopes to their cubes, height, with slopes, squared."""
    row, column = (a.astype(float) for a in np.divmod(pixels, sensor.columns))
    slopes = slopes_of(press, profiles, column, row, sensor.mm_per_px)
    height = heights_of(press, profiles, column, row, sensor.mm_per_px)[:, None]
    return np.concatenate([_polynomial(slopes, 1, 3), height, height * slopes, height**2], axis=1)


def _pixels_near(press: BallPress, sensor: SensorSpec) -> NDArray[np.intp]:
    row, column = (
        a.ravel() for a in np.mgrid[0 : sensor.rows : _STRIDE, 0 : sensor.columns : _STRIDE]
    )
    near = np.hypot(column - press.column, row - press.row) * sensor.mm_per_px < _NEAR_MM
    return row[near] * sensor.columns + column[near]


def _fit_coefficients(
    changes: Sequence[NDArray[np.float32]],
    presses: Sequence[BallPress],
    pixels: Sequence[NDArray[np.intp]],
    profiles: ProfileTable,
    light: FloatArray,
    places: FloatArray,
    sensor: SensorSpec,
) -> FloatArray:
    """Ridge regression of each colour: (terms, position terms, 3)."""
    at, terms, colours = _observed(changes, presses, pixels, profiles, sensor)
    design, lit = _products(terms, places[at]), light[at]
    penalty = np.ones((terms.shape[1], places.shape[1]))
    penalty[:, :3] = _EVEN
    solved = []
    for colour in range(3):
        scaled = design * lit[:, colour, None]
        solved.append(_ridge(scaled, colours[:, colour], penalty.ravel()))
    return np.stack(solved, axis=-1).reshape(*penalty.shape, 3)


def _fit_press(
    start: BallPress,
    colours: NDArray[np.float32],
    pixels: NDArray[np.intp],
    response: FloatArray,
    profiles: ProfileTable,
    sensor: SensorSpec,
) -> BallPress:
    """The press that shows these colours (N, 3) at ``response`` (N, terms, 3)."""

    def misfit(guess: FloatArray) -> FloatArray:
        press = BallPress(column=guess[0], row=guess[1], depth_mm=guess[2])
        terms = _terms(press, pixels, profiles, sensor)
        return (np.einsum("nm,nmc->nc", terms, response) - colours).ravel()

    deepest_mm = float(profiles.depths_mm[-1])
    low = np.array([start.column - _REACH_PX, start.row - _REACH_PX, _LEAST_MM])
    high = np.array([start.column + _REACH_PX, start.row + _REACH_PX, deepest_mm])
    fitted = optimize.least_squares(
        misfit,
        np.clip([start.column, start.row, start.depth_mm], low, high - 1e-6),
        loss="soft_l1",
        f_scale=_FOOTING,
        x_scale=[1, 1, 0.05],
        diff_step=1e-3,
        bounds=(low, high),
        max_nfev=8,
    )
    return BallPress(column=fitted.x[0], row=fitted.x[1], depth_mm=fitted.x[2])
