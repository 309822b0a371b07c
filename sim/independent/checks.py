"""Whether a careful person would give a contact the label of its body, from what touches.

A body is known; what of it the pad shows need not be. The limits are our choice and stand beside
each rule.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cltp.tactile.cloud import FloatArray
from cltp.tactile.states import ContactState, Shape
from sim.independent.recipe import HeightBody
from sim.tcl3d.contact_geometry import (
    BoundingRectangle,
    border_fraction,
    bounding_rectangle,
    count_enclosed_points,
    count_pieces,
)

Mask = NDArray[np.bool_]

_PLANE = (0.84, 0.97)  # fraction of the pad under a plane: not a cuboid, and an end in sight
_NOT_PLANE = 0.70
_LEAST_POINTS = 12  # grid points in contact, 0.2 mm²
_PART_POINTS = 4  # grid points from which a dot or an arm counts
_TOUCHED = 0.85  # part of a face in view that must touch
_IN_VIEW = {False: 0.97, True: 0.62}  # part of a whole face on the pad: whole contacts, cut ones
_RING_IN_VIEW = 0.82  # a ring of which less is seen is a crescent
_BORDER = 0.34  # part of the outline at the border of a cut contact
_SIMILAR = 0.3  # size of the second bar or crest over that of the largest
_SMALL_AREA = 0.05  # fraction of the pad that a small contact covers at most


@dataclass(frozen=True, slots=True, kw_only=True)
class Touched:
    """What of a body touches.

    Attributes:
        shape: Label of the body.
        body: The body.
        bare_gap_mm: Shape (H, W), its surface over the pad, ``NO_BODY_MM`` beside it [mm].
        touching: Same shape, points under pressure.
        closed: Same shape, with fine gaps closed.
        parts: Same shape, numbers of its parts, negative beside them.
        pitch_mm: Pitch of the grid [mm].
    """

    shape: Shape
    body: HeightBody
    bare_gap_mm: FloatArray
    touching: Mask
    closed: Mask
    parts: NDArray[np.int64]
    pitch_mm: float

    @property
    def rectangle(self) -> BoundingRectangle:
        return bounding_rectangle(self.touching, self.pitch_mm)


def is_clear(touched: Touched, *, cut: bool, small: bool, state: ContactState) -> bool:
    """Whether the label holds, the contact is cut as wished, and small if it shall be."""
    if np.count_nonzero(touched.touching) < _LEAST_POINTS:
        return False
    if cut != bool(state.cut) and (cut or touched.body.is_compact):
        return False
    if small and state.area_fraction > _SMALL_AREA:
        return False
    if touched.shape is Shape.PLANE:
        return _PLANE[0] <= state.area_fraction <= _PLANE[1]
    if state.area_fraction > _NOT_PLANE and touched.shape is not Shape.WAVE:
        return False
    return _RULES[touched.shape](touched, cut)


def _is_whole(touched: Touched, cut: bool) -> bool:
    """A flat face: in view, and in contact as a whole."""
    face = touched.parts == 0
    if not face.any():
        return False
    least = _RING_IN_VIEW if touched.shape is Shape.RING else _IN_VIEW[cut]
    in_view = float(face.sum()) * touched.pitch_mm**2 / _face_mm2(touched.body)
    touching = float(touched.closed[face].mean())
    return in_view >= least and touching >= _TOUCHED


def _face_mm2(body: HeightBody) -> float:
    """Area of a flat face [mm²]."""
    axis = np.arange(-body.extent_mm, body.extent_mm, 0.1)
    return 0.01 * float(np.count_nonzero(body.parts(*np.meshgrid(axis, axis)) == 0))


def _is_cap(touched: Touched, cut: bool) -> bool:
    """A dome, tip or corner: its foremost point on the pad, and most of its outline."""
    row, column = np.unravel_index(int(touched.bare_gap_mm.argmin()), touched.closed.shape)
    rows, columns = touched.closed.shape
    inside = min(row, column, rows - 1 - row, columns - 1 - column) * touched.pitch_mm > 0.6
    whole = border_fraction(touched.closed) < (_BORDER if cut else 0.02)
    return bool(inside and whole and count_pieces(touched.closed) == 1)


def _is_tip(touched: Touched, cut: bool) -> bool:
    return _is_cap(touched, cut) and touched.rectangle.length < 1.8 * touched.rectangle.width


def _is_long(touched: Touched, cut: bool) -> bool:
    """An edge or a bar: much longer than wide."""
    rectangle = touched.rectangle
    in_view = border_fraction(touched.closed) < _BORDER
    one_piece = count_pieces(touched.touching) == 1
    return rectangle.length > 2.6 * rectangle.width and one_piece and in_view


def _is_rod(touched: Touched, cut: bool) -> bool:
    rectangle = touched.rectangle
    long_enough = rectangle.length > 1.5 * rectangle.width and rectangle.width > 1.5
    both_flanks = border_fraction(touched.closed) < _BORDER
    return long_enough and both_flanks and count_pieces(touched.closed) == 1


def _has_parts(touched: Touched, cut: bool) -> bool:
    """Dots, arms, bars, crests: enough of them touch, and none dwarfs the others."""
    _, counts = np.unique(
        touched.parts[touched.touching & (touched.parts >= 0)], return_counts=True
    )
    counts = np.sort(counts[counts >= _PART_POINTS])[::-1]
    needed = touched.body.needed
    if len(counts) < needed:
        return False
    alike = touched.shape is Shape.DOTS or counts[needed - 1] > _SIMILAR * counts[0]
    return bool(alike and (touched.shape is not Shape.DOTS or _stands_free(touched)))


def _stands_free(touched: Touched) -> bool:
    """Whether the base under dots hardly touches."""
    return bool(
        np.count_nonzero(touched.touching & (touched.parts < 0))
        < 0.3 * np.count_nonzero(touched.touching)
    )


def _has_cavity(touched: Touched, cut: bool) -> bool:
    cavity_mm2 = count_enclosed_points(touched.closed) * touched.pitch_mm**2
    return cavity_mm2 > 0.6 and _is_whole(touched, cut)


_RULES = {
    Shape.SPHERE: _is_cap,
    Shape.ELLIPSOID: _is_cap,
    Shape.PEAK: _is_tip,
    Shape.CORNER: _is_tip,
    Shape.CYLINDER: _is_rod,
    Shape.EDGE: _is_long,
    Shape.LINE: _is_long,
    Shape.CUBOID: _is_whole,
    Shape.TRIANGLE: _is_whole,
    Shape.HEXAGON: _is_whole,
    Shape.DISC: _is_whole,
    Shape.RING: _is_whole,
    Shape.CRESCENT: _is_whole,
    Shape.HOLE: _has_cavity,
    Shape.CROSS: _has_parts,
    Shape.STRIPES: _has_parts,
    Shape.DOTS: _has_parts,
    Shape.WAVE: _has_parts,
}
