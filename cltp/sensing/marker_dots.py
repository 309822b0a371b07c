"""Dots on a gel, in the frames of the camera behind it: found once, then followed in every frame.

A dot is dark in all colours; a slope of the gel is dark in one or two. So the largest colour of a
pixel is looked at. A dot is found again where the mean of a small square is darker than that of a
larger one, and then placed by matching its picture in the untouched gel, to a fraction of a pixel
(Gauss-Newton with the template's own gradient, after Baker and Matthews 2004, 'Lucas-Kanade 20
years on').

Not here: the displacement field of a sensor (``cltp.sensing.marker_field``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.spatial import KDTree

from cltp.errors import TouchError
from cltp.sensing.frames import Frame, check_frame
from cltp.tactile.cloud import FloatArray
from cltp.tactile.sensors import SensorSpec

RADII_PX = (2.0, 12.0)
"""Smallest and largest radius of a dot [px]. Our choice: what fits a lattice of 35 px."""

DARKER = 0.25
"""Part of the light around it that a dot lacks at least. Our choice: a shadow lacks less."""

FOUND = 0.5
"""Darkness of a dot in a frame over that in the untouched gel, from which it counts."""

LEAST_FOUND = 0.9
"""Fraction of a lattice's dots that must be found on the untouched gel. Our choice."""

LARGEST_MOVE = 0.45
"""Largest way between a dot and where it is expected, over the lattice's pitch."""

BLUR_PX = 0.8
"""Blur of a frame before dots are matched [px]. Our choice: linear interpolation then is off by
hundredths of a pixel."""

STEPS, SETTLED_PX = 6, 0.01
"""Most steps of the matching, and the step below which it has settled [px]."""

UNLIKE = 0.6
"""Misfit over the template's own contrast from which a match is none. Our choice: half of a dot
that is hidden gives more."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Dots:
    """The dots of a lattice in one frame.

    Attributes:
        places_px: Shape (N, 2): column and row of each, row by row from the top left [px]; the
            middle of the first pixel is 0. Where one was not found, it is where it is expected.
        found: Shape (N,), bool.
    """

    places_px: FloatArray
    found: NDArray[np.bool_]


def mean_dots(frames: Sequence[Dots]) -> Dots:
    """The dots of several frames of one gel at rest: found where they were found in each."""
    return Dots(
        places_px=np.mean([each.places_px for each in frames], axis=0),
        found=np.all([each.found for each in frames], axis=0),
    )


class DotTracker:
    """Follows the dots of one gel.

    Args:
        background: Frame of the untouched gel.
        sensor: A sensor whose ``shear_grid`` are the rows and columns of dots.

    Raises:
        TouchError: No frame of this sensor, or the dots are not there.
    """

    def __init__(self, background: Frame, sensor: SensorSpec) -> None:
        if sensor.shear_grid is None:
            raise TouchError(f"{sensor.name} has no dots to follow")
        self._sensor = sensor
        rows, columns = sensor.shear_grid
        light = _light(check_frame(background, sensor, "the background"))
        places, self.radius_px = _lattice(light, sensor.name, rows, columns)
        between_px, _ = KDTree(places).query(places, k=2)
        self._pitch_px = float(np.median(between_px[:, 1]))
        self._small, self._large = _squares(self.radius_px, self._pitch_px)
        darkness = self._darkness(light)
        at = np.clip(np.rint(places).astype(np.intp), 0, (sensor.columns - 1, sensor.rows - 1))
        self._least = FOUND * float(np.median(darkness[at[:, 1], at[:, 0]]))
        half = int(np.ceil(self.radius_px)) + 3
        axis = np.arange(-half, half + 1.0)
        self._window = np.stack([g.ravel() for g in np.meshgrid(axis, axis)], axis=1)
        self._templates, self._solvers = self._matchers(light, places)
        self.untouched = Dots(places_px=places, found=np.ones(len(places), dtype=bool))

    def follow(self, frame: Frame, before: Dots | None = None) -> Dots:
        """The dots in a frame.

        Args:
            frame: The frame.
            before: The dots of a frame shortly before, from which they are looked for; the
                untouched gel when not given.

        Raises:
            TouchError: No frame of this sensor.
        """
        light = _light(check_frame(frame, self._sensor))
        expected = (before or self.untouched).places_px
        near, found = self._nearest(self._darkness(light), expected)
        places, fits = self._match(light, near)
        found &= fits & (np.hypot(*(places - near).T) < self.radius_px)
        moved = places - self.untouched.places_px
        lost = np.flatnonzero(~found)
        if not found.any():
            moved = expected - self.untouched.places_px
        elif len(lost):  # one that is lost is thought to move as those near it do
            count = min(4, int(found.sum()))
            near_ones = KDTree(self.untouched.places_px[found])
            _, which = near_ones.query(self.untouched.places_px[lost], k=list(range(1, count + 1)))
            moved[lost] = moved[found][which].mean(axis=1)
        return Dots(places_px=self.untouched.places_px + moved, found=found)

    def _darkness(self, light: NDArray[np.float32]) -> NDArray[np.float32]:
        """How much darker a small square about each pixel is than a larger one, of 0 to 1."""
        small = ndimage.uniform_filter(light, self._small, mode="nearest")
        large = ndimage.uniform_filter(light, self._large, mode="nearest")
        return np.asarray(1.0 - small / np.maximum(large, 1.0))

    def _nearest(
        self, darkness: NDArray[np.float32], expected: FloatArray
    ) -> tuple[FloatArray, NDArray[np.bool_]]:
        """The dark spots nearest to where dots are expected, and whether each is one."""
        peaks = ndimage.maximum_filter(darkness, self._small, mode="nearest") == darkness
        rows, columns = np.nonzero(peaks & (darkness > self._least))
        if not len(rows):
            return expected.copy(), np.zeros(len(expected), dtype=bool)
        spots = np.stack([columns, rows], axis=1).astype(np.float64)
        way, which = KDTree(spots).query(expected)
        _, back = KDTree(expected).query(spots)
        found = (way < LARGEST_MOVE * self._pitch_px) & (back[which] == np.arange(len(expected)))
        return np.where(found[:, None], spots[which], expected), found

    def _matchers(
        self, light: NDArray[np.float32], places: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Pictures of the dots (N, P), and what solves for (shift, gain, offset), (N, 4, P)."""
        step = 0.5
        template = self._windows(light, places)
        right, down = (
            (self._windows(light, places + by) - self._windows(light, places - by)) / (2 * step)
            for by in (np.array([step, 0.0]), np.array([0.0, step]))
        )
        parts = np.stack([right, down, template, np.ones_like(template)], axis=2)
        return template, np.asarray(np.linalg.pinv(parts), dtype=np.float64)

    def _match(
        self, light: NDArray[np.float32], start: FloatArray
    ) -> tuple[FloatArray, NDArray[np.bool_]]:
        """Places of the dots' pictures (N, 2) near some places, and whether each fits."""
        places = start.copy()
        templates = self._templates
        contrast = templates.std(axis=1)
        for _ in range(STEPS):
            seen = self._windows(light, places)
            solved = np.einsum("nkp,np->nk", self._solvers, seen)
            gain = np.maximum(solved[:, 2], 0.1)
            # seen(x) = gain · template(x + shift) + offset: the dot lies by the shift to the left
            step = np.clip(solved[:, :2] / gain[:, None], -2.0, 2.0)
            places -= step
            if np.abs(step).max() < SETTLED_PX:
                break
        seen = self._windows(light, places)
        gain = (seen * templates).mean(axis=1) - seen.mean(axis=1) * templates.mean(axis=1)
        gain /= np.maximum(contrast, 1e-3) ** 2
        rest = seen - seen.mean(axis=1, keepdims=True)
        rest -= gain[:, None] * (templates - templates.mean(axis=1, keepdims=True))
        fits = (gain > FOUND) & (rest.std(axis=1) < UNLIKE * gain * contrast)
        return places, fits

    def _windows(self, light: NDArray[np.float32], places: FloatArray) -> FloatArray:
        """Light in a square about each place, (N, P)."""
        at = places[:, None, :] + self._window
        return np.asarray(
            ndimage.map_coordinates(light, (at[:, :, 1], at[:, :, 0]), order=1, mode="nearest")
        ).astype(np.float64)


def _light(frame: Frame) -> NDArray[np.float32]:
    """The largest colour of each pixel, slightly blurred."""
    largest = np.maximum(np.maximum(frame[:, :, 0], frame[:, :, 1]), frame[:, :, 2])
    return np.asarray(ndimage.gaussian_filter(largest.astype(np.float32), BLUR_PX))


def _squares(radius_px: float, pitch_px: float) -> tuple[int, int]:
    """Edges of the square that a dot fills, and of one that it does not [px]."""
    small = max(3, round(1.6 * radius_px))
    return small, max(small + 4, min(round(4 * radius_px), round(0.9 * pitch_px)))


def _lattice(
    light: NDArray[np.float32], name: str, rows: int, columns: int
) -> tuple[FloatArray, float]:
    """Places of the dots (N, 2) of an untouched gel [px], row by row, and their radius [px]."""
    size = 2 * int(RADII_PX[1]) + 3
    around = ndimage.grey_closing(light, (size, size))
    dark = 1.0 - light / np.maximum(around, 1.0)
    labels, count = ndimage.label(dark > DARKER)
    areas = np.bincount(labels.ravel(), minlength=count + 1)[1:]
    least, most = (np.pi * r * r for r in RADII_PX)
    numbers = 1 + np.flatnonzero((areas >= least) & (areas <= most))
    wrong = (
        f"{len(numbers)} dark dots on the untouched gel, expected {rows} × {columns} of "
        f"{name}: is it the gel with dots, lit and in focus? A gel without dots is "
        "gelsight_mini"
    )
    if len(numbers) < LEAST_FOUND * rows * columns:
        raise TouchError(wrong)
    usual = float(np.median(areas[numbers - 1]))
    numbers = numbers[np.abs(np.log(areas[numbers - 1] / usual)) < np.log(2.5)]
    middles = np.array(ndimage.center_of_mass(dark, labels, numbers))[:, ::-1]
    radius_px = float(np.sqrt(usual / np.pi))
    places, found = _ordered(middles, rows, columns) if len(middles) > 3 else (middles, 0)
    if found < LEAST_FOUND * rows * columns:
        raise TouchError(wrong)
    return places, radius_px


def _ordered(middles: FloatArray, rows: int, columns: int) -> tuple[FloatArray, int]:
    """Spots (M, 2) as a lattice (N, 2), and how many of its places have a spot of their own.

    A place without one is where the lattice has it.
    """
    i, j = np.meshgrid(np.arange(columns), np.arange(rows))
    grid = np.stack([i.ravel(), j.ravel(), np.ones(i.size)], axis=1).astype(np.float64)
    low, high = middles.min(axis=0), middles.max(axis=0)
    pitch = (high - low) / (columns - 1, rows - 1)
    affine = np.array([[pitch[0], 0.0], [0.0, pitch[1]], low])
    tree = KDTree(middles)
    way, which = tree.query(grid @ affine)
    for _ in range(10):
        near = way < LARGEST_MOVE * pitch.min()
        if near.sum() < 3:
            break
        affine, *_ = np.linalg.lstsq(grid[near], middles[which[near]], rcond=None)
        way, which = tree.query(grid @ affine)
    near = way < LARGEST_MOVE / 2 * pitch.min()
    places = np.where(near[:, None], middles[which], grid @ affine)
    return places, len(set(which[near].tolist()))
