"""Contacts moved about the pad, turned and sampled anew, with labels that stay true.

A contact that is shifted or turned within the gel's plane is another contact of the same thing:
shape and texture stay, position follows, and where part of it leaves the field, depth, area, force
and cut are recomputed. Nothing is centred or scaled, which would destroy position, depth and area.

What lay beyond the field was never measured. A move that would bring it in is only made where the
gel at that border is at rest (``REST_MM``), so that what comes in is untouched gel.

Not here: mirroring and noise at training time (``cltp.data.sampler``,
``cltp.tactile.sensor_noise``). That a real pad ends at its field, and gives way more easily there,
is not modelled.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import map_coordinates

from cltp.errors import TouchError
from cltp.tactile.cloud import NUM_POINTS, TactileCloud, grid_axes_mm
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import ContactState, Side, area_word, depth_word, position_word

FloatArray = NDArray[np.float64]

REST_MM = 0.03
"""Below this a border of the field is at rest. Our choice: less than a sensor's own drift."""

LEAST_LEFT = 0.5
"""A drawn move leaves at least this share of the contact on the pad. Our choice: of less, a shape
can't be named."""

CUT_MM = 0.6
"""Length of border in contact from which a side cuts a contact: that of the simulated labels."""

_TRIES = 8
_OPPOSITE = {
    Side.TOP: Side.BOTTOM,
    Side.BOTTOM: Side.TOP,
    Side.LEFT: Side.RIGHT,
    Side.RIGHT: Side.LEFT,
}


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

    def moved(self, x_mm: float, y_mm: float) -> tuple[float, float]:
        """Where a point of the pad comes to [mm]."""
        cos, sin = math.cos(self.turn_rad), math.sin(self.turn_rad)
        return cos * x_mm - sin * y_mm + self.x_mm, sin * x_mm + cos * y_mm + self.y_mm


HALF_TURN = Placement(turn_rad=math.pi)
"""Maps every field onto itself: true of every contact."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Moved:
    """A contact after a move.

    Attributes:
        height_mm: Shape (H, W), float32 [mm], over the same field.
        state: Its labels.
    """

    height_mm: NDArray[np.float32]
    state: ContactState


@dataclass(frozen=True, slots=True)
class _Pressed:
    """Where a contact's pixels are (K,) [mm], how high above the footprint's level (K,) [mm]."""

    x_mm: FloatArray
    y_mm: FloatArray
    load: FloatArray
    level_mm: float

    @classmethod
    def of(cls, heights: FloatArray, state: ContactState, sensor: SensorSpec) -> _Pressed:
        """The highest pixels, as many as the stored area says; at least one."""
        count = max(1, round(state.area_fraction * heights.size))
        highest = np.argpartition(heights.ravel(), -count)[-count:]
        x, y = np.meshgrid(*grid_axes_mm(sensor, *heights.shape))
        level = float(heights.ravel()[highest].min())
        load = heights.ravel()[highest] - level
        return cls(x.ravel()[highest], y.ravel()[highest], load + 1e-9, level)

    def stays(self, sensor: SensorSpec, to: Placement) -> NDArray[np.bool_]:
        """Which of the pixels a move leaves on the field."""
        cos, sin = math.cos(to.turn_rad), math.sin(to.turn_rad)
        x = cos * self.x_mm - sin * self.y_mm + to.x_mm
        y = sin * self.x_mm + cos * self.y_mm + to.y_mm
        return (np.abs(x) <= sensor.width_mm / 2) & (np.abs(y) <= sensor.height_mm / 2)

    def centre(self, chosen: NDArray[np.bool_]) -> FloatArray:
        """Centre of the load on some of the pixels, shape (2,) [mm]."""
        load = self.load[chosen]
        at = np.stack([self.x_mm[chosen], self.y_mm[chosen]])
        return np.asarray(at @ load / load.sum())


def move(
    height_mm: NDArray[np.floating], state: ContactState, sensor: SensorSpec, to: Placement
) -> Moved:
    """Move a contact.

    Where all of it stays on the field its depth, area and force are those that were stored, and its
    position is the stored one moved. Otherwise they follow from the heights: the footprint is what
    is higher than the level that gives the stored area, the load is taken to be as the height above
    that level, and its centre moves as much as the centre of that load does.

    Args:
        height_mm: Shape (H, W), clean indentation over the field [mm], row 0 = top.
        state: Its labels.
        sensor: Whose field it is.
        to: Where to.

    Raises:
        TouchError: What lies beyond the field would come in, and the gel is not at rest there; or
            the whole contact would leave.
    """
    heights = np.asarray(height_mm, dtype=np.float64)
    if not _at_rest_where_shown(heights, sensor, to):
        raise TouchError(
            "the move would bring gel onto the field that was never measured and is not at rest; "
            "move the contact the other way, or by half a turn"
        )
    moved = _moved_heights(heights, sensor, to)
    if not state.in_contact:
        return Moved(height_mm=moved.astype(np.float32), state=state)
    state = _relabelled(_Pressed.of(heights, state, sensor), moved, state, sensor, to)
    return Moved(height_mm=moved.astype(np.float32), state=state)


def draw_placement(
    height_mm: NDArray[np.floating],
    state: ContactState,
    sensor: SensorSpec,
    rng: np.random.Generator,
) -> Placement:
    """Draw a move that keeps labels true and at least ``LEAST_LEFT`` of the contact on the pad.

    Contacts for which no move was found in a few tries are turned by half a turn, or left.
    """
    heights = np.asarray(height_mm, dtype=np.float64)
    pressed = _Pressed.of(heights, state, sensor)
    for _ in range(_TRIES):
        turn = float(rng.uniform(-math.pi, math.pi)) if rng.random() < 0.5 else 0.0
        drawn = Placement(
            x_mm=float(rng.uniform(-0.5, 0.5) * sensor.width_mm),
            y_mm=float(rng.uniform(-0.5, 0.5) * sensor.height_mm),
            turn_rad=turn,
        )
        if not _at_rest_where_shown(heights, sensor, drawn):
            continue
        if pressed.stays(sensor, drawn).mean() >= LEAST_LEFT:
            return drawn
    return HALF_TURN if rng.random() < 0.5 else Placement()


def random_cloud(
    height_mm: NDArray[np.floating],
    sensor: SensorSpec,
    rng: np.random.Generator,
    num_points: int = NUM_POINTS,
) -> TactileCloud:
    """Points anywhere on the surface, each drawn on its own: a looser sampling than the lattice's.

    Source: the paper, section 3.1, 'random sampling'.

    Raises:
        TouchError: Heights that are none, or fewer points than a cloud needs.
    """
    heights = np.asarray(height_mm, dtype=np.float64)
    u, v = rng.random((2, num_points))
    at = np.stack([v * heights.shape[0] - 0.5, u * heights.shape[1] - 0.5])
    z = map_coordinates(heights, at, order=1, mode="nearest")
    x, y = (u - 0.5) * sensor.width_mm, (0.5 - v) * sensor.height_mm
    return TactileCloud(points_mm=np.stack([x, y, z], axis=1).astype(np.float32), sensor=sensor)


def _origin(
    shape: tuple[int, ...], sensor: SensorSpec, to: Placement
) -> tuple[FloatArray, FloatArray]:
    """Where each pixel's gel came from, x and y of shape (H, W) [mm]."""
    x, y = np.meshgrid(*grid_axes_mm(sensor, shape[0], shape[1]))
    cos, sin = math.cos(to.turn_rad), math.sin(to.turn_rad)
    x, y = x - to.x_mm, y - to.y_mm
    return cos * x + sin * y, cos * y - sin * x


def _moved_heights(heights: FloatArray, sensor: SensorSpec, to: Placement) -> FloatArray:
    rows, columns = heights.shape
    x, y = _origin(heights.shape, sensor, to)
    row = (0.5 - y / sensor.height_mm) * rows - 0.5
    column = (x / sensor.width_mm + 0.5) * columns - 0.5
    # Linear: cubic splines overshoot at the edges of punches, which would deepen the contact.
    return np.asarray(map_coordinates(heights, [row, column], order=1, mode="nearest"))


def _at_rest_where_shown(heights: FloatArray, sensor: SensorSpec, to: Placement) -> bool:
    """Whether the gel is at rest at every border beyond which the move looks."""
    x, y = _origin(heights.shape, sensor, to)
    half_x, half_y = sensor.width_mm / 2, sensor.height_mm / 2
    borders = (
        (x < -half_x, heights[:, 0]),
        (x > half_x, heights[:, -1]),
        (y > half_y, heights[0]),
        (y < -half_y, heights[-1]),
    )
    return all(not beyond.any() or np.abs(edge).max() < REST_MM for beyond, edge in borders)


def _relabelled(
    pressed: _Pressed, moved: FloatArray, state: ContactState, sensor: SensorSpec, to: Placement
) -> ContactState:
    stays = pressed.stays(sensor, to)
    if not stays.any():
        raise TouchError("the whole contact would leave the pad; move it less far")
    x_mm, y_mm = to.moved(state.x_mm, state.y_mm)
    if stays.all():
        # A contact that is cut loses more of itself in every move but none and half a turn.
        turned = math.cos(to.turn_rad) < 0
        cut = frozenset(_OPPOSITE[side] for side in state.cut) if turned else state.cut
        return _with(state, sensor, x_mm=x_mm, y_mm=y_mm, cut=cut)
    shift_x, shift_y = pressed.centre(stays) - pressed.centre(np.ones_like(stays))
    x_mm, y_mm = to.moved(state.x_mm + shift_x, state.y_mm + shift_y)
    return _with(
        state,
        sensor,
        depth_mm=min(state.depth_mm, float(moved.max())),
        x_mm=x_mm,
        y_mm=y_mm,
        area_fraction=state.area_fraction * float(stays.mean()),
        force_n=state.force_n * float(pressed.load[stays].sum() / pressed.load.sum()),
        cut=_cut(moved > pressed.level_mm, sensor),
    )


def _with(state: ContactState, sensor: SensorSpec, **changes: object) -> ContactState:
    """The state with other numbers, and the words that they mean where a number changed."""
    new = dataclasses.replace(state, **changes)  # type: ignore[arg-type]
    position = position_word(new.x_mm, new.y_mm, sensor)
    depth = state.depth if new.depth_mm == state.depth_mm else depth_word(new.depth_mm)
    area = state.area if new.area_fraction == state.area_fraction else area_word(new.area_fraction)
    return dataclasses.replace(new, position=position, depth=depth, area=area)


def _cut(footprint: NDArray[np.bool_], sensor: SensorSpec) -> frozenset[Side]:
    borders = {
        Side.TOP: footprint[0],
        Side.BOTTOM: footprint[-1],
        Side.LEFT: footprint[:, 0],
        Side.RIGHT: footprint[:, -1],
    }
    least = round(CUT_MM / (sensor.width_mm / footprint.shape[1]))
    return frozenset(side for side, border in borders.items() if border.sum() >= least)
