"""Scenes of assembled objects: solids of the catalogue, resized, with other edges and skins."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import cast

import numpy as np
import torch
from torch import Tensor

from cltp.tactile.states import Shape, Texture
from sim.full.drawn.surface import Draws
from sim.full.labels import name_skin
from sim.full.requests import FullRequest
from sim.full.scene import PressScene, gentle, pad_grid
from sim.full.skins import DrawnSkin, draw_skin
from sim.gel.gap import NO_BODY_MM
from sim.objects.catalogue import object_named
from sim.objects.compounds import Around, Blend, Hollow, Placed
from sim.objects.faces import Cell, Form
from sim.objects.object import Mount, Part, SolidObject
from sim.objects.ray_casting import cast_pad_rays
from sim.objects.skins import SMOOTH, bumpy, fade, ridged, rough, woven
from sim.objects.solids import Cut, Solid
from sim.tcl3d.contact_geometry import ContactGeometry, Mask, covered_fraction
from sim.tcl3d.labelled_press import Naming
from sim.tcl3d.poses import draw_pose
from sim.tcl3d.shape_labels import name_shape

SMALL_SCALE, LARGE_SCALE = (0.85, 1.15), (0.75, 1.35)
"""Ranges of the factor by which small and large objects are resized. Our choice: the small ones
keep the vocabulary's sizes of bars and dots."""

FILLET_FACTOR = (0.4, 1.35)
"""Range of the factor of the radii of edges."""

_SMOOTH_FORMS = (Form.BAR, Form.LOOP, Form.DOT, Form.CREST, Form.TAPER)  # too narrow for a skin
_POSE_SKINS = {  # for a pose it counts only that there is one
    Texture.ROUGH: rough(0.05, 0.5),
    Texture.RIDGED: ridged(0.1, 1.0),
    Texture.BUMPY: bumpy(0.1, 2.0),
    Texture.WOVEN: woven(0.1, 1.0),
}
_SHARP, _SHARP_AREA = (Shape.EDGE, Shape.CORNER, Shape.PEAK), 0.3  # more touches of a leaning face
_MAX_ATTEMPTS, _BORDER_MARGIN = 30, 4
_SOFT_ALIKE_MPA = 0.35  # roughly the stiffness of a gel on its back: such a body flattens as much


@dataclass(frozen=True, slots=True)
class Resized:
    """A solid, larger or smaller by a factor."""

    solid: Solid
    factor: float

    @property
    def cells(self) -> tuple[Cell, ...]:
        return self.solid.cells

    @property
    def reach_mm(self) -> float:
        return self.solid.reach_mm * self.factor

    @property
    def max_slope(self) -> float:
        return self.solid.max_slope

    def distance(self, points: Tensor) -> Tensor:
        return self.solid.distance(points / self.factor) * self.factor

    def cell(self, points: Tensor) -> Tensor:
        return self.solid.cell(points / self.factor)


def with_fillets(solid: Solid, factor: float) -> Solid:
    """A solid whose edges have other radii."""
    if isinstance(solid, Cut):
        return replace(solid, fillet=solid.fillet * factor)
    if isinstance(solid, Blend):
        return replace(solid, parts=tuple(with_fillets(part, factor) for part in solid.parts))
    if isinstance(solid, Hollow):
        without = with_fillets(solid.without, factor)
        return replace(solid, solid=with_fillets(solid.solid, factor), without=without)
    if isinstance(solid, Around | Placed):
        return replace(solid, solid=with_fillets(solid.solid, factor))
    return solid


def redrawn(obj: SolidObject, rng: np.random.Generator) -> SolidObject:
    """An object of the catalogue, resized, with other edges, smooth."""
    low, high = SMALL_SCALE if obj.is_small else LARGE_SCALE
    factor = float(low * (high / low) ** rng.random())
    low, high = FILLET_FACTOR
    fillets = float(low * (high / low) ** rng.random())
    parts = tuple(
        Part(Resized(with_fillets(part.solid, fillets), factor), SMOOTH) for part in obj.parts
    )
    mounts = tuple(
        Mount(
            mount.direction,
            cast("tuple[float, float, float]", tuple(factor * x for x in mount.point)),
            mount.most_tilt_deg,
        )
        for mount in obj.mounts
    )
    return replace(obj, parts=parts, mounts=mounts)


@torch.inference_mode()
def solid_scene(
    request: FullRequest, rng: np.random.Generator, device: torch.device | str = "cpu"
) -> PressScene:
    """Draw the scene of an object of the catalogue.

    Raises:
        ValueError: No pose of the object on the pad was found.
    """
    obj, depths = redrawn(object_named(request.choice.kind), rng), request.depths_mm
    x, y = pad_grid(request.sensor)
    draws = Draws(rng, lightest_mm=depths[0], small=False, scale=request.scale)
    skin = draw_skin(draws, (x, y), request.sensor, textured=True)
    if skin.texture is not Texture.SMOOTH:
        parts = tuple(Part(part.solid, _POSE_SKINS[skin.texture]) for part in obj.parts)
        obj = replace(obj, parts=parts)
    for attempt in range(_MAX_ATTEMPTS):
        pose = draw_pose(obj, rng, request.sensor, depths[0])
        view = cast_pad_rays(obj, pose.object_from_pad, pose.point, x, y, device)
        slips = view is not None and not pose.flat and _at_border(view.gap_mm)
        if view is not None and not (slips and attempt < _MAX_ATTEMPTS // 2):
            break
    else:
        raise ValueError(f"{obj.name} could not be brought to the pad in {_MAX_ATTEMPTS} attempts")
    covered = view.gap_mm < NO_BODY_MM
    cells = np.full(covered.shape, -1, dtype=np.int64)
    cells[covered] = obj.cell(torch.from_numpy(view.points[covered])).numpy()
    is_broad = [*(cell.form not in _SMOOTH_FORMS for cell in obj.cells), False]
    broad: Mask = np.array(is_broad)[cells]
    pitch_mm = request.sensor.width_mm / x.shape[1]
    down, right = np.gradient(view.gap_mm, pitch_mm)
    relief = np.where(broad, fade(skin.behind_mm, np.hypot(down, right)), 0.0)
    gap = view.gap_mm + relief
    # A soft body flattens as well.
    factor = 1 + (_SOFT_ALIKE_MPA / obj.modulus_mpa if obj.modulus_mpa else 0.0)

    def name(touching: Mask, closed: Mask, depth_mm: float) -> Naming:
        geometry = ContactGeometry(
            gap_mm=view.gap_mm,
            cells=cells,
            cell_table=obj.cells,
            touching=touching,
            closed=closed,
            depth_mm=depth_mm,
            pitch_mm=pitch_mm,
        )
        texture, is_sure = _texture(skin, closed & covered, broad, pitch_mm)
        shape = name_shape(geometry)
        if shape.shape in _SHARP:
            shape = shape.sure_if(covered_fraction(closed) < _SHARP_AREA)
        return Naming(shape=shape, texture=texture, is_texture_sure=is_sure)

    return PressScene(
        gap_mm=np.where(covered, gap - gap[covered].min(), NO_BODY_MM),
        loads=tuple(depth * factor for depth in gentle(depths, view.gap_mm)),
        modulus_mpa=obj.modulus_mpa,
        name=name,
    )


def _at_border(gap_mm: np.ndarray) -> bool:
    """Whether the foremost point is at the pad's border, where the object slips off."""
    row, column = np.unravel_index(int(gap_mm.argmin()), gap_mm.shape)
    rows, columns = gap_mm.shape
    return min(row, column, rows - 1 - row, columns - 1 - column) < _BORDER_MARGIN


def _texture(skin: DrawnSkin, closed: Mask, broad: Mask, pitch_mm: float) -> tuple[Texture, bool]:
    """Texture of the part of a contact that can carry one, if that is most of it."""
    carrying = closed & broad
    fraction = float(np.count_nonzero(carrying)) / max(int(np.count_nonzero(closed)), 1)
    if fraction < 0.5:
        return Texture.SMOOTH, skin.texture is Texture.SMOOTH or fraction < 0.2
    texture, is_sure = name_skin(skin, carrying, pitch_mm)
    return texture, is_sure and (fraction > 0.8 or skin.texture is Texture.SMOOTH)
