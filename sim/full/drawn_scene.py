"""Scenes of drawn and scanned objects: drawn, placed on the pad, checked, and given a skin."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from cltp.tactile.cloud import FloatArray
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import Shape
from sim.full.drawn.scans import scanned, window_of
from sim.full.drawn.surface import Draws, Surface
from sim.full.labels import LEAST_POINTS, DrawnContact, name_drawn, name_skin
from sim.full.objects import DRAW_OF, Origin
from sim.full.requests import FullRequest, PressKind
from sim.full.scene import PressScene, gentle, pad_grid
from sim.full.skins import DrawnSkin, draw_skin
from sim.gel.gap import NO_BODY_MM
from sim.objects.skins import fade
from sim.tcl3d.contact_geometry import Mask, border_fraction
from sim.tcl3d.labelled_press import NameContact, Naming
from sim.tcl3d.poses import position_within

_OBJECTS, _POSES = 8, 6  # tries: objects, and poses of each
_TOUCHES = 0.55  # part of a press's depth up to which bare surface surely touches
_LEAST_SHARP_MM = 0.25  # a tip or an edge leaves too little to see below
_SHARP = (Shape.PEAK, Shape.EDGE, Shape.CORNER)
_COVERED = (0.83, 0.985)  # of the sensing area, under a plane
_PART_POINTS = 4
_AREA_STEP_MM = 0.12


@dataclass(frozen=True, slots=True, kw_only=True)
class _Placed:
    """A drawn object over the pad; arrays are (H, W)."""

    surface: Surface
    draws: Draws
    u_mm: FloatArray
    v_mm: FloatArray
    base_mm: FloatArray
    elements: NDArray[np.int64]
    depths_mm: tuple[float, ...]

    def gap(self) -> tuple[FloatArray, Mask]:
        """Its bare surface behind its foremost point [mm], and where there is any."""
        behind = self.surface.behind_mm(self.u_mm, self.v_mm)
        covered = behind < NO_BODY_MM
        gap = behind + self.base_mm
        least = gap[covered].min() if covered.any() else 0.0
        return np.where(covered, gap - least, NO_BODY_MM), covered


def drawn_scene(request: FullRequest, rng: np.random.Generator) -> PressScene:
    """Draw the scene of a parametric or scanned object."""
    grid = pad_grid(request.sensor)
    placed = _shown(request, grid, rng)
    if request.choice.origin is Origin.SCANNED:
        window = window_of(placed.surface, placed.u_mm, placed.v_mm)
        placed = replace(placed, surface=scanned(placed.surface, placed.draws, window))
    bare, covered = placed.gap()
    if not covered.any():
        raise ValueError(f"series {request.number}: no part of {request.choice.name} is on the pad")
    skin = draw_skin(placed.draws, grid, request.sensor, textured=placed.surface.can_be_textured)
    pitch_mm = request.sensor.width_mm / bare.shape[1]
    down, right = np.gradient(bare, pitch_mm)
    gap = bare + fade(skin.behind_mm, np.hypot(down, right))
    gap = np.where(covered, gap - gap[covered].min(), NO_BODY_MM)
    return PressScene(
        gap_mm=gap,
        loads=gentle(placed.depths_mm, bare),
        name=_namer(placed, bare, skin, pitch_mm),
    )


def _namer(placed: _Placed, bare: FloatArray, skin: DrawnSkin, pitch_mm: float) -> NameContact:
    element_mm2 = _element_mm2(placed.surface)

    def name(touching: Mask, closed: Mask, depth_mm: float) -> Naming:
        contact = DrawnContact(
            surface=placed.surface,
            gap_mm=bare,
            elements=placed.elements,
            element_mm2=element_mm2,
            touching=touching,
            closed=closed,
            pitch_mm=pitch_mm,
        )
        texture, is_sure = name_skin(skin, closed, pitch_mm)
        return Naming(shape=name_drawn(contact), texture=texture, is_texture_sure=is_sure)

    return name


def _element_mm2(surface: Surface) -> float:
    """Area of the first element of a flat face that can lie on the pad [mm²]; 0 of others."""
    if not (surface.is_flat and surface.is_compact):
        return 0.0
    reach = surface.extent_mm + 0.5
    axis = np.arange(-reach, reach, _AREA_STEP_MM)
    inside = surface.elements(*np.meshgrid(axis, axis)) == 0
    return float(np.count_nonzero(inside)) * _AREA_STEP_MM**2


def _shown(
    request: FullRequest, grid: tuple[FloatArray, FloatArray], rng: np.random.Generator
) -> _Placed:
    """Draw an object and its pose until it shows its shape, or the tries are over."""
    depths = request.depths_mm
    draws = Draws(
        rng, lightest_mm=depths[0], small=request.kind is PressKind.SMALL, scale=request.scale
    )
    for _ in range(_OBJECTS):
        surface = DRAW_OF[request.choice.kind](draws)
        if surface.shape in _SHARP:
            depths = tuple(max(d, _LEAST_SHARP_MM * (1 + i)) for i, d in enumerate(depths))
        for _ in range(_POSES):
            placed = _placed(surface, draws, depths, request, grid)
            if _shows(placed, request):
                return placed
    return placed


def _placed(
    surface: Surface,
    draws: Draws,
    depths_mm: tuple[float, ...],
    request: FullRequest,
    grid: tuple[FloatArray, FloatArray],
) -> _Placed:
    """Draw the pose of an object."""
    rng = draws.rng
    turn = rng.uniform(0, 2 * math.pi)
    cos, sin = math.cos(turn), math.sin(turn)
    if surface.shape is Shape.PLANE:
        end = _plane_end(surface, grid[0] * cos + grid[1] * sin, grid[1] * cos - grid[0] * sin, rng)
        x_mm, y_mm = end * cos, end * sin
    else:
        x_mm, y_mm = _position(surface, request.kind, request.sensor, rng)
    off_x, off_y = grid[0] - x_mm, grid[1] - y_mm
    slope, lean = _slope(surface, depths_mm[0], rng), rng.uniform(0, 2 * math.pi)
    u, v = off_x * cos + off_y * sin, off_y * cos - off_x * sin
    return _Placed(
        surface=surface,
        draws=draws,
        u_mm=u,
        v_mm=v,
        base_mm=slope * (off_x * math.cos(lean) + off_y * math.sin(lean)),
        elements=surface.elements(u, v),
        depths_mm=depths_mm,
    )


def _plane_end(surface: Surface, u: FloatArray, v: FloatArray, rng: np.random.Generator) -> float:
    """Position of the end of a plane [mm] at which it covers a drawn part of the sensing area.

    Over 80 %, not all: a smooth plane over all of it could not be told from no contact, since a
    sensor does not measure a constant.
    """
    wanted = rng.uniform(*_COVERED)
    low, high = -25.0, 40.0
    for _ in range(12):
        middle = 0.5 * (low + high)
        covered = float((surface.elements(u - middle, v) == 0).mean())
        low, high = (middle, high) if covered < wanted else (low, middle)
    return high


def _position(
    surface: Surface, kind: PressKind, sensor: SensorSpec, rng: np.random.Generator
) -> tuple[float, float]:
    """Position of the object's origin on the pad [mm]."""
    half = np.array([sensor.width_mm, sensor.height_mm]) / 2
    if kind is PressKind.CUT:
        at = rng.uniform(-0.9, 0.9, 2) * half
        side = int(rng.integers(2))
        inwards = rng.uniform(-0.15, 0.75) * min(surface.extent_mm, float(half[side]))
        at[side] = rng.choice([-1.0, 1.0]) * (half[side] - inwards)
    elif surface.is_compact:
        at = position_within(rng, (half - 0.6 * surface.extent_mm - 0.3).clip(min=0.4))
    else:
        at = position_within(rng, 0.8 * half)
    return float(at[0]), float(at[1])


def _slope(surface: Surface, lightest_mm: float, rng: np.random.Generator) -> float:
    """Slope of the base: what lets the whole of a face or a pattern touch."""
    if surface.needed == 0:
        return surface.largest_lean * float(rng.random())
    largest = (0.25 if surface.is_flat else 0.4) * lightest_mm
    return largest / (2 * min(surface.extent_mm, 8.0)) * float(rng.random())


def _shows(placed: _Placed, request: FullRequest) -> bool:
    """Whether the bare surface promises a contact that shows its shape, cut only where it shall be.

    What a solved contact shows decides its label; this saves solving those that can't.
    """
    gap, covered = placed.gap()
    surface = placed.surface
    if not covered.any():
        return False
    depths = gentle(placed.depths_mm, gap)
    light, deep = gap < _TOUCHES * depths[0], gap < _TOUCHES * depths[-1]
    if np.count_nonzero(light) < LEAST_POINTS:
        return False
    if surface.needed > 1:
        counts = np.unique(placed.elements[light & (placed.elements >= 0)], return_counts=True)[1]
        if np.count_nonzero(counts >= _PART_POINTS) < surface.needed:
            return False
    if surface.shape is Shape.PLANE:
        return True
    at_border = border_fraction(deep)
    if request.kind is PressKind.CUT and not 0.03 < at_border < 0.33:
        return False
    if not surface.is_compact:
        return at_border < 0.4 or surface.shape in (Shape.WAVE, Shape.DOTS, Shape.STRIPES)
    if request.kind is not PressKind.CUT:
        return at_border <= (0.2 if surface.needed == 0 else 0) and not _leaves(placed)
    return not surface.is_flat or _part_in_view(placed) > 0.62


def _leaves(placed: _Placed) -> bool:
    """Whether part of a flat face lies beside the pad."""
    if not placed.surface.is_flat:
        return False
    face = placed.elements == 0
    return bool(face[0].any() or face[-1].any() or face[:, 0].any() or face[:, -1].any())


def _part_in_view(placed: _Placed) -> float:
    pitch_mm = abs(float(placed.u_mm[0, 1] - placed.u_mm[0, 0]))
    pitch_mm = math.hypot(pitch_mm, float(placed.v_mm[0, 1] - placed.v_mm[0, 0]))
    seen_mm2 = np.count_nonzero(placed.elements == 0) * pitch_mm**2
    return float(seen_mm2 / max(_element_mm2(placed.surface), 1e-6))
