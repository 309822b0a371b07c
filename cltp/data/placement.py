"""Contacts shifted and turned on the pad, with labels that stay true.

A contact that is shifted or turned within the gel's plane is another contact of the same object:
shape and texture stay, position follows, and where part of it leaves the sensing area, depth, area,
force and cut are recomputed. Nothing is centred or scaled, which would destroy position, depth and
area.

The gel beyond the sensing area was never measured. A move that would bring it in is made only if
the gel at that border is at rest (``REST_MM``), so that untouched gel comes in. A real pad ends at
its sensing area and gives way more easily there; this is not modelled.

Not here: smaller pads (``cltp.data.windows``), mirroring and noise at training time
(``cltp.data.sampler``, ``cltp.tactile.sensor_noise``).
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from cltp.errors import TouchError
from cltp.tactile.cloud import FloatArray, grid_axes_mm, heights_at
from cltp.tactile.measure import cut_sides
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import CUT_MM, ContactState, area_word, depth_word, position_word

Coordinate = TypeVar("Coordinate", float, FloatArray)

REST_MM = 0.03
"""Below this a border is at rest. Our choice: less than a sensor's own drift."""

LEAST_LEFT = 0.5
"""Least fraction of a contact that a drawn move leaves on the pad. Our choice: a smaller
part does not show the shape."""

_TRIES = 8


@dataclass(frozen=True, slots=True, kw_only=True)
class Placement:
    """A rigid motion in the gel's plane: first a turn about the pad's centre, then a shift.

    Attributes:
        x_mm, y_mm: Shift [mm, gel frame].
        turn_rad: Counter-clockwise, as the sensor sees it [rad].

    Raises:
        TouchError: A value is not finite.
    """

    x_mm: float = 0.0
    y_mm: float = 0.0
    turn_rad: float = 0.0

    def __post_init__(self) -> None:
        if not all(map(math.isfinite, (self.x_mm, self.y_mm, self.turn_rad))):
            raise TouchError(f"a placement needs finite numbers, got {self}")

    def moved(self, x_mm: Coordinate, y_mm: Coordinate) -> tuple[Coordinate, Coordinate]:
        """Coordinates of points of the pad after the motion [mm]."""
        cos, sin = math.cos(self.turn_rad), math.sin(self.turn_rad)
        return cos * x_mm - sin * y_mm + self.x_mm, sin * x_mm + cos * y_mm + self.y_mm


HALF_TURN = Placement(turn_rad=math.pi)
"""Maps the sensing area onto itself, so that it is possible for every contact."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Moved:
    """A contact after a move.

    Attributes:
        height_mm: Shape (H, W), float32 [mm], over the same sensing area.
        state: Its labels.
    """

    height_mm: NDArray[np.float32]
    state: ContactState


@dataclass(frozen=True, slots=True)
class Footprint:
    """Pixels of a contact: positions (K,) and heights above the footprint's level (K,) [mm]."""

    x_mm: FloatArray
    y_mm: FloatArray
    load: FloatArray
    level_mm: float

    @classmethod
    def of(cls, heights: FloatArray, state: ContactState, sensor: SensorSpec) -> Footprint:
        """The highest pixels, as many as the stored area implies; at least one."""
        count = max(1, round(state.area_fraction * heights.size))
        highest = np.argpartition(heights.ravel(), -count)[-count:]
        x, y = np.meshgrid(*grid_axes_mm(sensor, *heights.shape))
        level = float(heights.ravel()[highest].min())
        load = heights.ravel()[highest] - level
        return cls(x.ravel()[highest], y.ravel()[highest], load + 1e-9, level)

    def stays(self, sensor: SensorSpec, placement: Placement) -> NDArray[np.bool_]:
        """Mask of the pixels that a move leaves on the sensing area."""
        x, y = placement.moved(self.x_mm, self.y_mm)
        return (np.abs(x) <= sensor.width_mm / 2) & (np.abs(y) <= sensor.height_mm / 2)

    def centre(self, mask: NDArray[np.bool_]) -> FloatArray:
        """Centre of the load on some of the pixels, shape (2,) [mm]."""
        load = self.load[mask]
        positions = np.stack([self.x_mm[mask], self.y_mm[mask]])
        return np.asarray(positions @ load / load.sum())

    def relabelled(
        self,
        moved: FloatArray,
        state: ContactState,
        sensor: SensorSpec,
        placement: Placement,
        pad_fraction: float = 1.0,
    ) -> ContactState:
        """The state after a move onto a pad, by which fraction of its own pad that one covers."""
        stays = self.stays(sensor, placement)
        if not stays.any():
            raise TouchError("the whole contact would leave the pad; move it less far")
        x_mm, y_mm = placement.moved(state.x_mm, state.y_mm)
        if stays.all():
            # A contact that is cut loses more of itself in every move but none and half a turn.
            turned = math.cos(placement.turn_rad) < 0
            cut = frozenset(side.opposite for side in state.cut) if turned else state.cut
            area = min(1.0, state.area_fraction / pad_fraction)
            return _with(state, sensor, x_mm=x_mm, y_mm=y_mm, area_fraction=area, cut=cut)
        shift_x, shift_y = self.centre(stays) - self.centre(np.ones_like(stays))
        x_mm, y_mm = placement.moved(state.x_mm + shift_x, state.y_mm + shift_y)
        pitch_mm = sensor.width_mm / moved.shape[1]
        return _with(
            state,
            sensor,
            depth_mm=min(state.depth_mm, float(moved.max())),
            x_mm=x_mm,
            y_mm=y_mm,
            area_fraction=min(1.0, state.area_fraction * float(stays.mean()) / pad_fraction),
            force_n=state.force_n * float(self.load[stays].sum() / self.load.sum()),
            cut=cut_sides(moved > self.level_mm, least=round(CUT_MM / pitch_mm)),
        )


def move(
    height_mm: NDArray[np.floating], state: ContactState, sensor: SensorSpec, placement: Placement
) -> Moved:
    """Move a contact with clean heights (H, W) [mm] of the whole sensing area, row 0 = top.

    Where all of it stays on the sensing area its depth, area and force are the stored ones, and its
    position is the stored one moved. Otherwise they follow from the heights: the footprint is what
    is higher than the level that gives the stored area, the load is proportional to the height
    above that level, and the position moves as much as the centre of that load does.

    Raises:
        TouchError: Gel beyond the sensing area would come in and is not at rest, or the whole
            contact would leave.
    """
    heights = np.asarray(height_mm, dtype=np.float64)
    if not _at_rest_at_entry(heights, sensor, placement):
        raise TouchError(
            "the move would bring gel onto the sensing area that was never measured and is not at "
            "rest; move the contact the other way, or by half a turn"
        )
    x, y = _origin(heights.shape, sensor, placement)
    moved = heights_at(heights, x, y, sensor)
    if state.in_contact:
        footprint = Footprint.of(heights, state, sensor)
        state = footprint.relabelled(moved, state, sensor, placement)
    return Moved(height_mm=moved.astype(np.float32), state=state)


def draw_placement(
    height_mm: NDArray[np.floating],
    state: ContactState,
    sensor: SensorSpec,
    rng: np.random.Generator,
) -> Placement:
    """Draw a move that keeps labels true and at least ``LEAST_LEFT`` of the contact on the pad.

    When a few tries yield no such move, the contact gets half a turn or stays.
    """
    heights = np.asarray(height_mm, dtype=np.float64)
    footprint = Footprint.of(heights, state, sensor)
    for _ in range(_TRIES):
        turn = float(rng.uniform(-math.pi, math.pi)) if rng.random() < 0.5 else 0.0
        placement = Placement(
            x_mm=float(rng.uniform(-0.5, 0.5) * sensor.width_mm),
            y_mm=float(rng.uniform(-0.5, 0.5) * sensor.height_mm),
            turn_rad=turn,
        )
        if (
            _at_rest_at_entry(heights, sensor, placement)
            and footprint.stays(sensor, placement).mean() >= LEAST_LEFT
        ):
            return placement
    return HALF_TURN if rng.random() < 0.5 else Placement()


def _origin(
    shape: tuple[int, ...], sensor: SensorSpec, placement: Placement
) -> tuple[FloatArray, FloatArray]:
    """Position of each pixel's gel before the move, x and y of shape (H, W) [mm]."""
    x, y = np.meshgrid(*grid_axes_mm(sensor, shape[0], shape[1]))
    cos, sin = math.cos(placement.turn_rad), math.sin(placement.turn_rad)
    x, y = x - placement.x_mm, y - placement.y_mm
    return cos * x + sin * y, cos * y - sin * x


def _at_rest_at_entry(heights: FloatArray, sensor: SensorSpec, placement: Placement) -> bool:
    """Whether the gel is at rest at every border through which the move brings gel in."""
    x, y = _origin(heights.shape, sensor, placement)
    half_x, half_y = sensor.width_mm / 2, sensor.height_mm / 2
    borders = (
        (x < -half_x, heights[:, 0]),
        (x > half_x, heights[:, -1]),
        (y > half_y, heights[0]),
        (y < -half_y, heights[-1]),
    )
    return all(not beyond.any() or np.abs(edge).max() < REST_MM for beyond, edge in borders)


def _with(state: ContactState, sensor: SensorSpec, **changes: object) -> ContactState:
    """The state with other numbers, and new words where a number changed."""
    new = dataclasses.replace(state, **changes)  # type: ignore[arg-type]
    position = position_word(new.x_mm, new.y_mm, sensor)
    depth = state.depth if new.depth_mm == state.depth_mm else depth_word(new.depth_mm)
    same_area = new.area_fraction == state.area_fraction
    area = state.area if same_area else area_word(new.area_fraction)
    return dataclasses.replace(new, position=position, depth=depth, area=area)
