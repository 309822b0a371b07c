"""Shape label of a drawn object's contact, by what of the object touches; the doubtful are marked.

The object is known; what of it the pad shows need not be. A contact that shows another shape (one
dot is a round tip) has that shape's label. A label is unsure where a careful person might give
another one.

Not here: labels of solids, whose pose decides what they are (``sim.tcl3d.shape_labels``); depth,
position and area (``sim.tcl3d.labels``).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cltp.tactile.cloud import FloatArray
from cltp.tactile.states import Shape, Texture
from sim.full.drawn.surface import Surface
from sim.full.skins import DrawnSkin
from sim.tcl3d.contact_geometry import (
    Mask,
    ShapeLabel,
    border_fraction,
    bounding_rectangle,
    circle_fraction,
    count_enclosed_points,
    count_pieces,
    covered_fraction,
    slopes,
)
from sim.tcl3d.labels import MIN_PERIODS, SMOOTH_RELIEF_MM

LEAST_POINTS = 10
"""Grid points in contact from which a label can be certain: 0.4 mm²."""

PLANE_FRACTION, PLANE_SURE = 0.80, 0.815
"""Fraction of the sensing area from which a flat contact is a plane, and surely one."""

_PART_POINTS = 3  # grid points from which a dot or an arm counts
_TOUCHED = 0.75  # part of a face in view that must touch
_IN_VIEW = 0.6  # part of a face that must be in view
_RING_IN_VIEW = 0.82  # a ring of which less is seen is a crescent
_CUT = 0.36  # part of the outline at the pad's border up to which a cap shows its shape
_SIMILAR = 0.25  # size of the second bar or arm over that of the largest
_TIP_LONG, _LINE_LONG = 2.0, 2.2  # elongation of a tip at most, and of a line or edge at least
_ALONG = 0.7  # part of a bar in view that must touch
_CAVITY_MM2 = 0.5
_SLACK = 0.35  # slope of a contact's middle from which a cap is its flank


@dataclass(frozen=True, slots=True, kw_only=True)
class DrawnContact:
    """What of a drawn object touches; arrays are (H, W).

    Attributes:
        surface: The object.
        gap_mm: Its bare surface behind its foremost point, ``NO_BODY_MM`` beside it [mm].
        elements: Numbers of its elements, negative beside them.
        element_mm2: Area of its first element as a whole, on the pad or not [mm²].
        touching: Points under pressure.
        closed: The same with fine gaps closed.
        pitch_mm: Pitch of the grid [mm].
    """

    surface: Surface
    gap_mm: FloatArray
    elements: NDArray[np.int64]
    element_mm2: float
    touching: Mask
    closed: Mask
    pitch_mm: float

    @property
    def elongation(self) -> float:
        rectangle = bounding_rectangle(self.touching, self.pitch_mm)
        return rectangle.length / rectangle.width

    def touched_elements(self) -> NDArray[np.int64]:
        """Grid points of each element that touches, most first."""
        numbers = self.elements[self.touching & (self.elements >= 0)]
        counts = np.unique(numbers, return_counts=True)[1]
        return np.sort(counts[counts >= _PART_POINTS])[::-1]


def name_drawn(contact: DrawnContact) -> ShapeLabel:
    """Label the shape of a drawn object's contact."""
    if np.count_nonzero(contact.touching) < LEAST_POINTS:
        return ShapeLabel(contact.surface.shape, False)
    shape = contact.surface.shape
    covered = covered_fraction(contact.closed)
    if contact.surface.is_flat and covered >= PLANE_FRACTION and shape is not Shape.HOLE:
        return ShapeLabel(Shape.PLANE, covered >= PLANE_SURE)
    return _RULES[shape](contact)


def _label(
    shape: Shape, rule: Callable[[DrawnContact], bool]
) -> Callable[[DrawnContact], ShapeLabel]:
    return lambda contact: ShapeLabel(shape, rule(contact))


def _in_view(contact: DrawnContact) -> float:
    """Fraction of the first element that lies on the pad."""
    seen_mm2 = np.count_nonzero(contact.elements == 0) * contact.pitch_mm**2
    return float(seen_mm2 / max(contact.element_mm2, 1e-6))


def _face_touches(contact: DrawnContact) -> bool:
    face = contact.elements == 0
    return bool(face.any() and contact.closed[face].mean() >= _TOUCHED)


def _is_face(contact: DrawnContact) -> bool:
    return _face_touches(contact) and _in_view(contact) >= _IN_VIEW


def _is_crescent(contact: DrawnContact) -> bool:
    fraction = circle_fraction(contact.touching)
    return _is_face(contact) and 0.16 < fraction < 0.86


def _plane(contact: DrawnContact) -> ShapeLabel:
    """Not a plane any more: a face of which less is in view."""
    return ShapeLabel(Shape.CUBOID, False)


def _ring(contact: DrawnContact) -> ShapeLabel:
    in_view, touches = _in_view(contact), _face_touches(contact)
    if in_view >= _RING_IN_VIEW - 0.1:
        return ShapeLabel(Shape.RING, touches and in_view >= _RING_IN_VIEW)
    return ShapeLabel(Shape.CRESCENT, touches and 0.3 < in_view < _RING_IN_VIEW - 0.15)


def _hole(contact: DrawnContact) -> ShapeLabel:
    cavity_mm2 = count_enclosed_points(contact.closed) * contact.pitch_mm**2
    return ShapeLabel(Shape.HOLE, cavity_mm2 > _CAVITY_MM2 and _is_face(contact))


def _is_cap(contact: DrawnContact) -> bool:
    """The foremost point is on the pad, and the contact is one piece that shows most of itself."""
    row, column = np.unravel_index(int(contact.gap_mm.argmin()), contact.gap_mm.shape)
    rows, columns = contact.gap_mm.shape
    margin_mm = min(row, column, rows - 1 - row, columns - 1 - column) * contact.pitch_mm
    is_whole = border_fraction(contact.closed) < _CUT and margin_mm > 0.5
    return bool(is_whole and count_pieces(contact.closed) == 1)


def _is_tip(contact: DrawnContact) -> bool:
    return _is_cap(contact) and contact.elongation < _TIP_LONG


def _is_rod(contact: DrawnContact) -> bool:
    rectangle = bounding_rectangle(contact.closed, contact.pitch_mm)
    down, right = slopes(contact.gap_mm, contact.touching, contact.pitch_mm)
    level = float(np.hypot(np.median(right), np.median(down))) < _SLACK
    is_long = rectangle.length > 1.4 * rectangle.width and rectangle.width > 0.9
    return level and is_long and border_fraction(contact.closed) < 0.4


def _is_edge(contact: DrawnContact) -> bool:
    one_piece = count_pieces(contact.closed) == 1
    return contact.elongation > _LINE_LONG and one_piece and border_fraction(contact.closed) < 0.4


def _is_line(contact: DrawnContact) -> bool:
    """Long, and in contact along most of what of the bar is on the pad."""
    bar = contact.elements >= 0
    if not bar.any():
        return False
    whole = bounding_rectangle(bar, contact.pitch_mm).length
    along = bounding_rectangle(contact.touching, contact.pitch_mm).length
    in_view = border_fraction(contact.closed) < 0.4
    return contact.elongation > _LINE_LONG and in_view and along > _ALONG * whole


def _cross(contact: DrawnContact) -> ShapeLabel:
    counts = contact.touched_elements()
    if len(counts) >= 3:
        return ShapeLabel(Shape.CROSS, len(counts) == 4 and counts[3] > _SIMILAR * counts[0])
    return ShapeLabel(Shape.LINE, False)


def _stripes(contact: DrawnContact) -> ShapeLabel:
    counts = contact.touched_elements()
    if len(counts) >= 2:
        return ShapeLabel(Shape.STRIPES, bool(counts[1] > _SIMILAR * counts[0]))
    return ShapeLabel(Shape.LINE, len(counts) == 1 and _is_line(contact))


def _dots(contact: DrawnContact) -> ShapeLabel:
    counts = contact.touched_elements()
    on_base = np.count_nonzero(contact.touching & (contact.elements < 0))
    free = on_base < 0.3 * np.count_nonzero(contact.touching)
    if len(counts) >= 3:
        return ShapeLabel(Shape.DOTS, bool(free))
    return ShapeLabel(Shape.DOTS if len(counts) == 2 else Shape.SPHERE, False)


def _wave(contact: DrawnContact) -> ShapeLabel:
    counts = contact.touched_elements()
    if len(counts) >= 2:
        return ShapeLabel(Shape.WAVE, bool(counts[1] > _SIMILAR * counts[0]))
    return ShapeLabel(Shape.CYLINDER, False)


_RULES: Mapping[Shape, Callable[[DrawnContact], ShapeLabel]] = {
    **{
        shape: _label(shape, _is_face)
        for shape in (Shape.CUBOID, Shape.TRIANGLE, Shape.HEXAGON, Shape.DISC)
    },
    Shape.CRESCENT: _label(Shape.CRESCENT, _is_crescent),
    Shape.PLANE: _plane,
    Shape.RING: _ring,
    Shape.HOLE: _hole,
    Shape.SPHERE: _label(Shape.SPHERE, _is_cap),
    Shape.ELLIPSOID: _label(Shape.ELLIPSOID, _is_cap),
    Shape.PEAK: _label(Shape.PEAK, _is_tip),
    Shape.CORNER: _label(Shape.CORNER, _is_tip),
    Shape.CYLINDER: _label(Shape.CYLINDER, _is_rod),
    Shape.EDGE: _label(Shape.EDGE, _is_edge),
    Shape.LINE: _label(Shape.LINE, _is_line),
    Shape.CROSS: _cross,
    Shape.STRIPES: _stripes,
    Shape.DOTS: _dots,
    Shape.WAVE: _wave,
}


def name_skin(skin: DrawnSkin, closed: Mask, pitch_mm: float) -> tuple[Texture, bool]:
    """Label the texture of a contact, and whether a careful person would give it without doubt."""
    if skin.texture is Texture.SMOOTH:
        return Texture.SMOOTH, True
    relief = skin.behind_mm[closed]
    range_mm = float(np.ptp(np.percentile(relief, [3, 97]))) if len(relief) else 0.0
    if range_mm < SMOOTH_RELIEF_MM:
        return Texture.SMOOTH, range_mm < 0.6 * SMOOTH_RELIEF_MM
    broad_mm = float(np.sqrt(np.count_nonzero(closed))) * pitch_mm
    width_mm = min(broad_mm, bounding_rectangle(closed, pitch_mm).width)
    return skin.texture, width_mm > MIN_PERIODS * skin.pitch_mm
