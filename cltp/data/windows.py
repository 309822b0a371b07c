"""Contacts as a smaller pad sees them, of any proportions, with labels that stay true.

Sensors of a data set have few proportions. An encoder that has learned from windows of their pads
reads the place of a contact on pads of other proportions too.

A real pad ends at its sensing area and gives way more easily there; this is not modelled.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cltp.data.placement import Footprint, Placement
from cltp.errors import TouchError
from cltp.tactile.measure import cut_sides
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import CUT_MM, ContactState, Shape

LEAST_SIDE = 0.45
"""Least fraction of either side of the sensing area that a drawn window has. Our choice: a GelSight
Mini's sides then stand in any ratio from 0.6 to 3."""

LEAST_LEFT = 0.75
"""Least fraction of a contact that a drawn window leaves. Our choice: a smaller part does not show
the shape."""

MOST_COVERED = 0.8
"""Fraction of a pad from which a flat contact is a plane (``Shape.PLANE``), whatever its outline
is beyond the pad."""

_TRIES = 8


@dataclass(frozen=True, slots=True, kw_only=True)
class Window:
    """A part of a sensing area: rows and columns of its pixels, ends exclusive.

    Raises:
        TouchError: It has fewer than 2 rows or columns, or begins before the first ones.
    """

    top: int
    bottom: int
    left: int
    right: int

    def __post_init__(self) -> None:
        if min(self.top, self.left) < 0 or min(self.height, self.width) < 2:
            raise TouchError(f"a window needs at least 2 rows and columns, got {self}")

    @property
    def height(self) -> int:
        """Number of its rows."""
        return self.bottom - self.top

    @property
    def width(self) -> int:
        """Number of its columns."""
        return self.right - self.left


@dataclass(frozen=True, slots=True, kw_only=True)
class Cropped:
    """A contact as a smaller pad sees it.

    Attributes:
        height_mm: Shape (H, W), float32 [mm], over its sensing area.
        state: Its labels, in the frame of the smaller pad.
        sensor: The smaller pad; all but its extent is the larger one's.
    """

    height_mm: NDArray[np.float32]
    state: ContactState
    sensor: SensorSpec


def crop(
    height_mm: NDArray[np.floating], state: ContactState, sensor: SensorSpec, window: Window
) -> Cropped:
    """Cut a window out of clean heights (H, W) [mm] of the whole sensing area, row 0 = top.

    Labels follow as in ``cltp.data.placement.move``: what the window leaves of the contact is
    moved into its frame.

    Raises:
        TouchError: The window reaches beyond the sensing area, or nothing of the contact is in it.
    """
    heights = np.asarray(height_mm, dtype=np.float64)
    rows, columns = heights.shape
    if window.bottom > rows or window.right > columns:
        raise TouchError(f"{window} reaches beyond {rows} rows and {columns} columns")
    smaller, placement = _pad_of(window, heights.shape, sensor)
    inside = heights[window.top : window.bottom, window.left : window.right]
    if state.in_contact:
        footprint = Footprint.of(heights, state, sensor)
        part = inside.size / heights.size
        state = footprint.relabelled(inside, state, smaller, placement, pad_fraction=part)
        least = round(CUT_MM * columns / sensor.width_mm)
        cut = cut_sides(inside > footprint.level_mm, least=least)
        state = dataclasses.replace(state, cut=state.cut | cut)
    return Cropped(height_mm=inside.astype(np.float32), state=state, sensor=smaller)


def draw_window(
    height_mm: NDArray[np.floating],
    state: ContactState,
    sensor: SensorSpec,
    rng: np.random.Generator,
) -> Window:
    """Draw a window that leaves ``LEAST_LEFT`` of a contact and keeps its shape to be seen.

    When a few tries yield none, it is the whole sensing area; so it is for a sensor with markers,
    whose number is its own.
    """
    heights = np.asarray(height_mm, dtype=np.float64)
    rows, columns = heights.shape
    whole = Window(top=0, bottom=rows, left=0, right=columns)
    if sensor.markers is not None:
        return whole
    footprint = Footprint.of(heights, state, sensor) if state.in_contact else None
    for _ in range(_TRIES):
        window = _random_window(rows, columns, rng)
        if footprint is None:
            return window
        smaller, placement = _pad_of(window, heights.shape, sensor)
        left = float(footprint.stays(smaller, placement).mean())
        covered = state.area_fraction * left * heights.size / (window.height * window.width)
        is_seen = covered <= MOST_COVERED or state.shape == Shape.PLANE
        if left >= LEAST_LEFT and is_seen:
            return window
    return whole


def _random_window(rows: int, columns: int, rng: np.random.Generator) -> Window:
    """A window whose sides are drawn log-uniformly from ``LEAST_SIDE`` of the pad's to all."""
    height, width = (
        round(side * math.exp(rng.uniform(math.log(LEAST_SIDE), 0.0))) for side in (rows, columns)
    )
    top, left = int(rng.integers(rows - height + 1)), int(rng.integers(columns - width + 1))
    return Window(top=top, bottom=top + height, left=left, right=left + width)


def _pad_of(
    window: Window, shape: tuple[int, ...], sensor: SensorSpec
) -> tuple[SensorSpec, Placement]:
    """The pad that sees a window of so many rows and columns, and the move into its frame."""
    rows, columns = shape
    pitch_mm = sensor.width_mm / columns
    smaller = dataclasses.replace(
        sensor, columns=window.width, rows=window.height, mm_per_px=pitch_mm
    )
    x_mm = (columns - window.left - window.right) / 2 * pitch_mm
    y_mm = (window.top + window.bottom - rows) / 2 * pitch_mm
    return smaller, Placement(x_mm=x_mm, y_mm=y_mm)
