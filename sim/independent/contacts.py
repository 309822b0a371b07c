"""Contacts of the second generator: draws a body, presses it, labels it, and keeps what is clear.

A contact follows from its seed alone, and its shape is that of the seed modulo 19. A contact whose
label a careful person would doubt is drawn again. Heights are clean.

Not here: noise (``sim.independent.noise``), files of contacts (``cltp.data``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

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

COLUMNS = 160
_MARGIN = 24
"""Grid points of gel beyond the sensing area, on every side."""

KINDS = {"ordinary": 0.58, "small": 0.14, "shallow": 0.14, "cut": 0.14}
"""Fractions of contacts. Small: faces of up to 8 mm², few dots, short bars. Shallow: below 0.15 mm,
but for tips, edges and waves, which leave too little to see. Cut: by the pad's border."""

DEPTHS_MM = ((0.15, 0.3), (0.3, 0.6), (0.6, 0.9), (0.9, 1.25))
SHALLOW_MM = (0.06, 0.15)
_SHARP = (Shape.PEAK, Shape.EDGE, Shape.CORNER, Shape.WAVE)
_LEAST_SHARP_MM = 0.35
_IMPOSSIBLE = {
    (Shape.PLANE, "small"),
    (Shape.PLANE, "cut"),
    (Shape.WAVE, "small"),
    (Shape.CRESCENT, "cut"),
} | {(shape, "shallow") for shape in _SHARP}

TEXTURED_FRACTION = 0.85
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
        rows = round(COLUMNS * sensor.height_mm / sensor.width_mm)
        x, y = grid_axes_mm(sensor, rows, COLUMNS)
        pitch = sensor.width_mm / COLUMNS
        beyond = pitch * np.arange(1, _MARGIN + 1)
        x = np.concatenate([x[0] - beyond[::-1], x, x[-1] + beyond])
        y = np.concatenate([y[0] + beyond[::-1], y, y[-1] - beyond])
        wide_x, wide_y = np.meshgrid(x, y)
        return cls(x_mm=wide_x, y_mm=wide_y, pitch_mm=pitch)


def make_contact(seed: int, sensor: SensorSpec) -> Contact:
    """Make one contact.

    Args:
        seed: Random seed.
        sensor: The sensor; its heights have ``COLUMNS`` columns and square points.

    Raises:
        ValueError: The seed is negative.
    """
    if seed < 0:
        raise ValueError(f"the seed of a contact must be 0 or more, got {seed}")
    grid = _Grid.of(sensor)
    rng = np.random.default_rng([seed, 271])
    wish = _Wish.draw(list(Shape)[seed % len(Shape)], rng)
    for number in range(_TRIES):
        if number == _TRIES // 2:
            wish = replace(wish, kind="ordinary")
        drawn = _Press.draw(wish, grid, sensor, rng)
        contact = drawn.contact(grid, sensor, seed) if drawn is not None else None
        if contact is not None:
            return contact
    raise RuntimeError(f"no clear {wish} in {_TRIES} draws of seed {seed}")


@dataclass(frozen=True, slots=True, kw_only=True)
class _Wish:
    """What a contact shall be; a body that can't carry the texture is smooth."""

    shape: Shape
    kind: str
    texture: Texture

    @classmethod
    def draw(cls, shape: Shape, rng: np.random.Generator) -> _Wish:
        kind = str(rng.choice(list(KINDS), p=list(KINDS.values())))
        texture = Texture.SMOOTH
        if rng.random() < TEXTURED_FRACTION:
            texture = list(Texture)[1 + int(rng.integers(len(Texture) - 1))]
        impossible = (shape, kind) in _IMPOSSIBLE
        return cls(shape=shape, kind="ordinary" if impossible else kind, texture=texture)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Press:
    """A body over the gel, and what it is pressed with; arrays are those of the grid."""

    wish: _Wish
    body: HeightBody
    parts: NDArray[np.int64]
    surface_mm: FloatArray
    gap_mm: FloatArray
    texture: Texture
    relief: Relief
    recipe: PressRecipe
    gel: MembraneGel

    @classmethod
    def draw(
        cls, wish: _Wish, grid: _Grid, sensor: SensorSpec, rng: np.random.Generator
    ) -> _Press | None:
        """Draw everything; None where no part of the body is over the pad."""
        depth_mm = _depth_mm(wish.shape, wish.kind, rng)
        recipe = PressRecipe(depth_mm=depth_mm, small=wish.kind == "small")
        body, gel = draw_body(wish.shape, recipe, rng), MembraneGel.draw(rng)
        u, v, base = _placed(body, wish.kind == "cut", recipe, grid, sensor, rng)
        can_have = body.textured and depth_mm >= LEAST_DEPTH_MM
        texture = wish.texture if can_have else Texture.SMOOTH
        relief = draw_relief(texture, depth_mm, rng, grid.x_mm, grid.y_mm)
        surface = body.behind_mm(u, v)
        covered = surface < NO_BODY_MM
        if not covered[grid.seen].any():
            return None
        gap = surface + base + relief.behind_mm
        return cls(
            wish=wish,
            body=body,
            parts=body.parts(u, v),
            surface_mm=surface,
            gap_mm=np.where(covered, gap - gap[grid.seen][covered[grid.seen]].min(), NO_BODY_MM),
            texture=texture,
            relief=relief,
            recipe=recipe,
            gel=gel,
        )

    def contact(self, grid: _Grid, sensor: SensorSpec, seed: int) -> Contact | None:
        """Press and label; None where the label would be in doubt."""
        solved = press(self.gap_mm, self.recipe.depth_mm, self.gel, grid.pitch_mm)
        height = solved.height_mm[grid.seen].astype(np.float32)
        pressure = solved.pressure_kpa[grid.seen].astype(np.float32)
        closed = in_contact(torch.from_numpy(pressure[None]), grid.pitch_mm)[0]
        touched = Touched(
            shape=self.wish.shape,
            body=self.body,
            bare_gap_mm=self.surface_mm[grid.seen],
            touching=pressure > 0,
            closed=closed,
            parts=self.parts[grid.seen],
            pitch_mm=grid.pitch_mm,
        )
        state = label(
            height_mm=height,
            pressure_kpa=pressure,
            touching=closed,
            force_n=1e-3 * float(pressure.sum()) * grid.pitch_mm**2,
            sensor=sensor,
            shape=self.wish.shape,
            texture=self.texture,
        )
        if not is_clear(touched, cut=self.wish.kind == "cut", small=self.recipe.small, state=state):
            return None
        if not _shows(self.relief, solved.height_mm[grid.seen], closed, grid.pitch_mm):
            return None
        return Contact(
            height_mm=height,
            sensor=sensor,
            state=state,
            object=f"{self.wish.shape}: {self.body.variant}, {self.wish.kind}",
            series=seed,
            split=Split.TEST,
            seed=seed,
            unsure=frozenset(uncertain_labels(state, sensor)),
            approach_mm=self.recipe.depth_mm,
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


def _shows(relief: Relief, height: FloatArray, closed: NDArray[np.bool_], pitch_mm: float) -> bool:
    """Whether a texture has room and leaves a mark, so that it can be told from a smooth face."""
    if relief.pitch_mm == 0:
        return True
    width_mm = math.sqrt(float(closed.sum())) * pitch_mm
    broad = gaussian_filter(height, 0.5 * relief.pitch_mm / pitch_mm)
    mark = float((height - broad)[closed].std()) if closed.any() else 0.0
    return width_mm > 2.5 * relief.pitch_mm and mark > _LEAST_MARK_MM
