"""Contacts of the second generator: draws a body, presses it, labels it, and keeps what is clear.

Contact ``number`` of a seed has the shape ``number`` modulo 19, and follows from both alone. A
contact whose label a careful person would doubt is drawn again. Heights are clean.

Not here: noise (``sim.independent.noise``), files of contacts (``cltp.data``).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter

from cltp.data.contact import Contact, Split
from cltp.tactile.cloud import FloatArray, grid_axes_mm
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import Shape, Texture
from sim.gel.gap import NO_BODY_MM
from sim.independent.bodies import draw_body
from sim.independent.checks import Touched, is_clear
from sim.independent.membrane import MembraneGel, press
from sim.independent.recipe import HeightBody, PressRecipe, log_uniform
from sim.independent.reliefs import LEAST_DEPTH_MM, Relief, draw_relief
from sim.tcl3d.labels import in_contact, label, uncertain_labels

ROWS, COLUMNS = 120, 160
_MARGIN = 24
"""Grid points of gel beyond the sensing area, on every side."""

KINDS = {"ordinary": 0.58, "small": 0.14, "shallow": 0.14, "cut": 0.14}
"""Fractions of contacts. Small: faces of up to 8 mm², few dots, short bars. Shallow: below 0.15 mm,
but for tips, edges and waves, which leave too little to see. Cut: by the pad's border."""

DEPTHS_MM = ((0.15, 0.3), (0.3, 0.6), (0.6, 0.9), (0.9, 1.25))
SHALLOW_MM = (0.06, 0.15)
_SHARP = (Shape.PEAK, Shape.EDGE, Shape.CORNER, Shape.WAVE)
_LEAST_SHARP_MM = 0.35
_IMPOSSIBLE = {(Shape.PLANE, "small"), (Shape.PLANE, "cut"), (Shape.WAVE, "small")} | {
    (shape, "shallow") for shape in _SHARP
}

TEXTURED_FRACTION = 0.65
"""Fraction of the bodies that can carry a texture which have one."""

_TRIES = 400
_LEAST_MARK_MM = 0.004  # deviation that a texture must leave in the heights to be seen


@dataclass(frozen=True, slots=True, kw_only=True)
class _Grid:
    """Points of the gel [mm], and the part of them that the sensor sees."""

    x_mm: FloatArray
    y_mm: FloatArray
    pitch_mm: float
    seen: tuple[slice, slice] = (slice(_MARGIN, -_MARGIN), slice(_MARGIN, -_MARGIN))

    @classmethod
    def of(cls, sensor: SensorSpec) -> _Grid:
        x, y = grid_axes_mm(sensor, ROWS, COLUMNS)
        pitch = sensor.width_mm / COLUMNS
        beyond = pitch * np.arange(1, _MARGIN + 1)
        x = np.concatenate([x[0] - beyond[::-1], x, x[-1] + beyond])
        y = np.concatenate([y[0] + beyond[::-1], y, y[-1] - beyond])
        wide_x, wide_y = np.meshgrid(x, y)
        return cls(x_mm=wide_x, y_mm=wide_y, pitch_mm=pitch)


def make_contact(seed: int, number: int, sensor: SensorSpec) -> Contact:
    """Make one contact.

    Args:
        seed: Random seed.
        number: Number of the contact, from 0.
        sensor: The sensor; its heights are ``ROWS`` × ``COLUMNS``.

    Raises:
        ValueError: A number is negative.
    """
    if seed < 0 or number < 0:
        raise ValueError(f"seed and number must be 0 or more, got {seed} and {number}")
    shape = list(Shape)[number % len(Shape)]
    grid = _Grid.of(sensor)
    rng = np.random.default_rng([seed, number, 271])
    kind = str(rng.choice(list(KINDS), p=list(KINDS.values())))
    if (shape, kind) in _IMPOSSIBLE:
        kind = "ordinary"
    wish = Texture.SMOOTH
    if rng.random() < TEXTURED_FRACTION:
        wish = list(Texture)[1 + int(rng.integers(len(Texture) - 1))]
    for _ in range(_TRIES):
        contact = _attempt(shape, kind, wish, grid, sensor, rng, seed=seed, number=number)
        if contact is not None:
            return contact
    raise RuntimeError(f"no clear {kind} {shape} in {_TRIES} draws of seed {seed}, {number}")


def make_contacts(seed: int, count: int, sensor: SensorSpec) -> Iterator[Contact]:
    """Contacts 0 to ``count`` - 1 of a seed."""
    return (make_contact(seed, number, sensor) for number in range(count))


def _attempt(
    shape: Shape,
    kind: str,
    wish: Texture,
    grid: _Grid,
    sensor: SensorSpec,
    rng: np.random.Generator,
    *,
    seed: int,
    number: int,
) -> Contact | None:
    """Draw and press once; None where the label would be in doubt."""
    recipe = PressRecipe(depth_mm=_depth_mm(shape, kind, rng), small=kind == "small")
    body = draw_body(shape, recipe, rng)
    gel = MembraneGel.draw(rng)
    u, v, base = _placed(body, kind == "cut", recipe, grid, sensor, rng)
    can_have = body.textured and recipe.depth_mm >= LEAST_DEPTH_MM
    texture = wish if can_have else Texture.SMOOTH
    relief = draw_relief(texture, recipe.depth_mm, rng, grid.x_mm, grid.y_mm)
    surface = body.behind_mm(u, v)
    covered = surface < NO_BODY_MM
    if not covered[grid.seen].any():
        return None
    gap = surface + base + relief.behind_mm
    gap = np.where(covered, gap - gap[grid.seen][covered[grid.seen]].min(), NO_BODY_MM)
    solved = press(gap, recipe.depth_mm, gel, grid.pitch_mm)
    height = solved.height_mm[grid.seen].astype(np.float32)
    pressure = solved.pressure_kpa[grid.seen].astype(np.float32)
    closed = in_contact(torch.from_numpy(pressure[None]), grid.pitch_mm)[0]
    touched = Touched(
        shape=shape,
        body=body,
        bare_gap_mm=surface[grid.seen],
        touching=pressure > 0,
        closed=closed,
        parts=body.parts(u, v)[grid.seen],
        pitch_mm=grid.pitch_mm,
    )
    force_n = 1e-3 * float(pressure.sum()) * grid.pitch_mm**2
    state = label(
        height_mm=height,
        pressure_kpa=pressure,
        touching=closed,
        force_n=force_n,
        sensor=sensor,
        shape=shape,
        texture=texture,
    )
    if not is_clear(touched, cut=kind == "cut", small=recipe.small, state=state):
        return None
    if not _shows(relief, texture, solved.height_mm[grid.seen], closed, grid.pitch_mm):
        return None
    return Contact(
        height_mm=height,
        sensor=sensor,
        state=state,
        object=f"{shape}: {body.variant}, {kind}",
        series=number,
        split=Split.TEST,
        seed=seed,
        unsure=frozenset(uncertain_labels(state, sensor)),
        approach_mm=recipe.depth_mm,
        peak_kpa=float(pressure.max()),
    )


def _depth_mm(shape: Shape, kind: str, rng: np.random.Generator) -> float:
    if kind == "shallow":
        return log_uniform(rng, *SHALLOW_MM)
    least, most = DEPTHS_MM[int(rng.integers(len(DEPTHS_MM)))]
    if shape in _SHARP:
        least, most = max(least, _LEAST_SHARP_MM), max(most, 2 * _LEAST_SHARP_MM)
    return float(rng.uniform(least, most))


def _placed(
    body: HeightBody,
    cut: bool,
    recipe: PressRecipe,
    grid: _Grid,
    sensor: SensorSpec,
    rng: np.random.Generator,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The body's own coordinates over the grid, and the tilt of its base [mm]."""
    half = np.array([sensor.width_mm, sensor.height_mm]) / 2
    middle = rng.uniform(-0.85, 0.85, 2) * half
    if cut:
        side = int(rng.integers(2))
        middle[side] = rng.choice([-1.0, 1.0]) * rng.uniform(0.6, 1.0) * half[side]
    turn = rng.uniform(0, 2 * math.pi)
    slope = body.max_tilt * rng.random()
    if body.extent_mm:
        slope = rng.uniform(0, 0.2) * recipe.depth_mm / body.extent_mm
    lean = rng.uniform(0, 2 * math.pi)
    off_x, off_y = grid.x_mm - middle[0], grid.y_mm - middle[1]
    u = off_x * math.cos(turn) + off_y * math.sin(turn)
    v = off_y * math.cos(turn) - off_x * math.sin(turn)
    base = slope * (off_x * math.cos(lean) + off_y * math.sin(lean))
    return u, v, np.asarray(base)


def _shows(
    relief: Relief, texture: Texture, height: FloatArray, closed: NDArray[np.bool_], pitch_mm: float
) -> bool:
    """Whether a texture has room and leaves a mark, so that it can be told from a smooth face."""
    if texture is Texture.SMOOTH:
        return True
    width_mm = math.sqrt(float(closed.sum())) * pitch_mm
    broad = gaussian_filter(height, 0.5 * relief.pitch_mm / pitch_mm)
    mark = float((height - broad)[closed].std()) if closed.any() else 0.0
    return width_mm > 2.5 * relief.pitch_mm and mark > _LEAST_MARK_MM
