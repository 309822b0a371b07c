"""Shape label of a contact: one of the 19 shapes, and whether it is certain.

A box can give a plane, a cuboid, an edge or a corner; the surface under pressure decides. Each grid
point has a cell of the surface (``sim.objects.solids``). Flat faces, edges and tips follow from the
number of touching cells and from the gap over them, curved surfaces from their principal
curvatures, patterns from the number of their elements that touch.

A label is unsure where another one fits nearly as well: close to a limit of the vocabulary, cut off
by the pad, or several shapes at once.

Not here: depth, position, area and texture (``sim.tcl3d.labels``).
"""

from __future__ import annotations

import math
from collections import Counter

import numpy as np
from scipy.ndimage import binary_dilation

from cltp.tactile.cloud import FloatArray
from cltp.tactile.states import Shape
from sim.gel.gap import NO_BODY_MM
from sim.objects.faces import Cell, Form
from sim.tcl3d.contact_geometry import (
    ContactGeometry,
    Mask,
    ShapeLabel,
    angle_between,
    border_fraction,
    circle_fraction,
    count_enclosed_points,
    count_pieces,
    covered_fraction,
    curvatures,
    slopes,
    with_nearby_surface,
)

PLANE_FRACTION = 0.80
"""Fraction of the sensing area from which a flat contact is a plane (``Shape``)."""

CAP_RATIOS = (1.4, 4.0)
"""Limits of the ratio of curvatures between sphere, ellipsoid and cylinder."""

BAR_MM = 1.6
"""Largest width of a line: 1.5 mm and half a grid point."""

_RATIO_UNSURE = (0.95, 1.05)  # factors about a limit between which a ratio is unsure
_RUNS_OUT, _RUNS_OUT_UNSURE = 0.32, 0.06  # range of the gap over a face, in depths: tilted above
_CUT_UNSURE = 0.34  # fraction of the outline at the pad's border
_CUT_STRAIGHT = 0.42  # the same for a rectangle, of which less is needed
_SHARP_MM = 1.6  # radius of curvature from which an edge is round
_ENDS_SEEN = 0.15  # fraction of an outline at the border up to which a face is whole
_ASLANT = 0.2  # slope up to which a face that touches as a whole counts as that face
_LEVEL_MM = 0.35  # largest drop of a round within 0.6 mm
_LONG = 2.1  # elongation between corners and edges
_FLAT_PER_MM = 1 / 120  # curvature up to which a surface is flat
_CAVITY_MM2 = 0.8  # area of the smallest hole
_TINY = 30  # grid points up to which a contact is no larger than an edge's fillet
_FEW = 3  # touching grid points from which a cell counts


def name_shape(contact: ContactGeometry) -> ShapeLabel:
    """Label the shape of a contact."""
    if np.count_nonzero(contact.touching) < _TINY:
        contact = with_nearby_surface(contact)
    numbers = np.flatnonzero(contact.counts).tolist()
    points: Counter[Form] = Counter()
    for number in numbers:
        points[contact.cell_table[number].form] += int(contact.counts[number])
    form, most = points.most_common(1)[0]
    pure = most >= 0.75 * points.total()
    touching_cells = [n for n in numbers if contact.counts[n] >= _FEW]
    of_form = [n for n in touching_cells if contact.cell_table[n].form is form]
    match form:
        case Form.BAR:
            label = _bars(contact, of_form)
        case Form.LOOP:
            # One entry more than cells: -1 stands for none.
            chosen = np.isin(np.arange(len(contact.cell_table) + 1), of_form)
            label = _loop(contact, chosen[contact.cells] & contact.touching)
        case Form.DOT:
            label = _several(contact, of_form, Shape.DOTS, enough=3)
        case Form.CREST:
            label = _several(contact, of_form, Shape.WAVE, enough=2)
        case _:
            return _plain(contact, touching_cells or [int(contact.counts.argmax())])
    return label.sure_if(pure)


def _bars(contact: ContactGeometry, bars: list[int]) -> ShapeLabel:
    if len(bars) < 2:
        rectangle = contact.rectangle(contact.touching)
        if rectangle.length < 1.8 * rectangle.width:
            return _cap(contact).sure_if(False)
        return ShapeLabel(Shape.LINE, rectangle.length > 2.2 * rectangle.width)
    directions, sizes = [], []
    for number in bars:
        rectangle = contact.rectangle((contact.cells == number) & contact.touching)
        sizes.append(rectangle.length)
        if rectangle.length > 2 * rectangle.width:
            directions.append(rectangle.angle)
    if not directions:
        return ShapeLabel(Shape.STRIPES, False)
    apart = max(angle_between(a, directions[0]) for a in directions)
    short = sorted(sizes)[-2] < 0.25 * max(sizes)
    if apart > math.radians(30):
        return ShapeLabel(Shape.CROSS, not short and len(directions) == len(bars))
    return ShapeLabel(Shape.STRIPES, not short)


def _several(
    contact: ContactGeometry, cells: list[int], shape: Shape, *, enough: int
) -> ShapeLabel:
    if len(cells) >= enough:
        return ShapeLabel(shape, True)
    if len(cells) == 1:
        return _cap(contact)
    return ShapeLabel(shape, False)


def _loop(contact: ContactGeometry, mask: Mask) -> ShapeLabel:
    """Ring, crescent, or the side of a bent bar, by the fraction of the circle in contact."""
    fraction = circle_fraction(mask)
    if fraction >= 0.8:
        return ShapeLabel(Shape.RING, fraction >= 0.82)
    if fraction >= 0.14:  # about 50°
        return ShapeLabel(Shape.CRESCENT, 0.17 <= fraction < 0.76)
    return _cap(contact).sure_if(fraction < 0.11)


def _plain(contact: ContactGeometry, touching_cells: list[int]) -> ShapeLabel:
    """Faces, edges, corners, tips and curved surfaces."""
    is_one_piece = count_pieces(contact.closed) == 1
    main = max(touching_cells, key=lambda n: contact.counts[n])
    fraction = float(contact.counts[main] / np.count_nonzero(contact.touching))
    cell = contact.cell_table[main]
    of_cell = contact.cells == main
    mask = of_cell & contact.touching
    is_flank = cell.form is Form.TAPER and cell.outline in (None, Shape.PEAK)
    if cell.outline is Shape.LINE and fraction >= 0.5:  # the edge of a blade, at any lean
        rectangle = contact.rectangle(contact.touching)
        return ShapeLabel(Shape.LINE, rectangle.length > 2.4 * rectangle.width and is_one_piece)
    if cell.form is not Form.CURVED and not is_flank and fraction >= 0.5:
        runs_out = float(np.ptp(np.percentile(contact.gap_mm[mask], [8, 92]))) / contact.depth_mm
        touched = float(np.count_nonzero(mask) / np.count_nonzero(of_cell))
        is_whole_in_view = border_fraction(contact.closed) < _ENDS_SEEN
        is_whole = touched > 0.9 and is_whole_in_view and _slope(contact, mask) < _ASLANT
        if runs_out < _RUNS_OUT or is_whole:
            level = runs_out < _RUNS_OUT - _RUNS_OUT_UNSURE or is_whole
            sure = level and fraction >= 0.6 and is_one_piece
            return _outline(contact, cell, mask).sure_if(sure)
    elif (
        cell.form is Form.CURVED
        and fraction >= 0.85
        and (_rounds_off(contact) or _lies_level(contact))
    ):
        return _cap(contact).sure_if(is_one_piece)
    return _sharp(contact, touching_cells).sure_if(is_one_piece)


def _rounds_off(contact: ContactGeometry) -> bool:
    """Whether a curved surface is level at its foremost point, instead of ending there."""
    row, column = np.unravel_index(int(contact.gap_mm.argmin()), contact.gap_mm.shape)
    about = contact.gap_mm[max(row - 3, 0) : row + 4, max(column - 3, 0) : column + 4]
    return float(about.max()) < _LEVEL_MM


def _slope(contact: ContactGeometry, where: Mask) -> float:
    """Mean slope of the bare surface."""
    down, right = slopes(contact.gap_mm, where, contact.pitch_mm)
    return math.hypot(float(np.median(right)), float(np.median(down)))


def _lies_level(contact: ContactGeometry) -> bool:
    """Whether the flanks of a contact balance: a rod near its end, not on it."""
    down, right = slopes(contact.gap_mm, contact.touching, contact.pitch_mm)
    gentle = np.hypot(down, right) < 1.5
    if not gentle.any():
        return False
    return math.hypot(float(right[gentle].mean()), float(down[gentle].mean())) < 0.06


def _outline(contact: ContactGeometry, cell: Cell, mask: Mask) -> ShapeLabel:
    """Label of a flat contact, by its outline."""
    covered, cut = covered_fraction(contact.closed), border_fraction(contact.closed)
    if cell.outline is Shape.HOLE:
        has_cavity = count_enclosed_points(contact.closed) * contact.pitch_mm**2 > _CAVITY_MM2
        if covered >= PLANE_FRACTION and not has_cavity:
            return ShapeLabel(Shape.PLANE, covered > 0.97)
        return ShapeLabel(Shape.HOLE, has_cavity)
    if covered >= PLANE_FRACTION:
        return ShapeLabel(Shape.PLANE, covered >= PLANE_FRACTION + 0.015)
    rectangle = contact.rectangle(mask)
    is_inside = covered < PLANE_FRACTION - 0.05
    aspect = rectangle.length / rectangle.width
    if cell.outline in (Shape.RING, Shape.CRESCENT):
        label = _loop(contact, mask)
        is_bent = label.shape in (Shape.RING, Shape.CRESCENT)
        return label if is_bent else ShapeLabel(Shape.LINE, False)
    bar = BAR_MM if cell.outline is not Shape.LINE else 2 * BAR_MM  # made to be one
    if rectangle.width <= bar and aspect >= 2:
        return ShapeLabel(Shape.LINE, aspect >= 2.4)
    if cell.outline in (None, Shape.CUBOID, Shape.LINE):
        return ShapeLabel(Shape.CUBOID, cut < _CUT_STRAIGHT and is_inside and aspect < 2.4)
    return ShapeLabel(cell.outline, cut < _CUT_UNSURE and is_inside and aspect < 2.4)


def _sharp(contact: ContactGeometry, touching_cells: list[int]) -> ShapeLabel:
    """Edge, corner or peak: several cells touch, or one that ends."""
    near = binary_dilation(contact.touching, iterations=2)
    nearby = np.flatnonzero(contact.count_cells(near)).tolist()
    rectangle = contact.rectangle(contact.touching)
    elongation = rectangle.length / rectangle.width
    tapers = [n for n in nearby if contact.cell_table[n].form is Form.TAPER]
    if any(contact.cell_table[n].outline is Shape.PEAK for n in tapers):
        return ShapeLabel(Shape.PEAK, elongation < 2.6)
    if [contact.cell_table[n] for n in touching_cells] == [Cell(form=Form.TAPER)]:  # a cone's side
        return _cap(contact)
    level = _rounds_off(contact)
    radius = 1 / max(curvatures(contact.gap_mm, _top(contact), contact.pitch_mm)[1], 1e-3)
    if level and radius > _SHARP_MM:
        return _cap(contact).sure_if(radius > 1.9)
    faces = [n for n in nearby if n not in touching_cells or contact.counts[n] >= _FEW]
    cliffs = bool((contact.gap_mm[near] >= NO_BODY_MM).any())
    sides = len(faces) + cliffs
    bend = _bend(contact, touching_cells)
    if any(contact.cell_table[n].form is Form.CURVED for n in nearby):  # a rim
        blunt = bend is not None and bend < math.radians(42)
        return ShapeLabel(Shape.EDGE, elongation > 1.25 and sides >= 2 and not blunt)
    dull = bend is not None and not math.radians(50) < bend < math.radians(130)
    is_whole = border_fraction(contact.closed) < 0.45
    if sides >= 3 and elongation < _LONG:
        return ShapeLabel(Shape.CORNER, elongation < 0.93 * _LONG and not dull and is_whole)
    return ShapeLabel(Shape.EDGE, elongation > (1.07 * _LONG if sides >= 3 else 1.4) and not dull)


def _bend(contact: ContactGeometry, touching_cells: list[int]) -> float | None:
    """Angle between the normals of the two cells with most touching points [rad]."""
    if len(touching_cells) < 2:
        return None
    first, second = sorted(touching_cells, key=lambda n: -contact.counts[n])[:2]
    normals: list[FloatArray] = []
    near = binary_dilation(contact.touching, iterations=5) & (contact.gap_mm < NO_BODY_MM)
    fillet = contact.touching
    if np.count_nonzero(fillet) < 60:
        fillet = binary_dilation(fillet)
    for number in (first, second):
        mask = (contact.cells == number) & near
        outside_fillet = mask & ~fillet
        mask = outside_fillet if np.count_nonzero(outside_fillet) >= _FEW else mask
        down, right = slopes(contact.gap_mm, mask, contact.pitch_mm)
        slope = float(np.median(right)), float(np.median(down))
        normals.append(np.array([*slope, 1.0]) / math.hypot(*slope, 1.0))
    return math.acos(float(np.clip(np.dot(normals[0], normals[1]), -1, 1)))


def _cap(contact: ContactGeometry) -> ShapeLabel:
    """Sphere, ellipsoid, cylinder or line, by the curvatures of the contact."""
    low, high = curvatures(contact.gap_mm, _top(contact), contact.pitch_mm)
    if high < _FLAT_PER_MM:
        is_plane = covered_fraction(contact.closed) >= PLANE_FRACTION
        return ShapeLabel(Shape.PLANE if is_plane else Shape.CUBOID, False)
    ratio = high / max(low, 1e-9)
    sure = low > -0.15 * high
    for limit in CAP_RATIOS:
        sure = sure and not _RATIO_UNSURE[0] * limit < ratio < _RATIO_UNSURE[1] * limit
    if ratio < CAP_RATIOS[0]:
        return ShapeLabel(Shape.SPHERE, sure)
    if ratio < CAP_RATIOS[1]:
        return ShapeLabel(Shape.ELLIPSOID, sure)
    radius = 1 / high
    if radius < 1.1:
        return ShapeLabel(Shape.LINE, sure and radius < 0.8)
    return ShapeLabel(Shape.CYLINDER, sure and radius > 1.4)


def _top(contact: ContactGeometry) -> Mask:
    """Foremost part of a contact; further out, a fitted quadric overstates the curvatures."""
    # All surface as near as the tops of a texture, not the tops alone.
    reach = float(np.percentile(contact.gap_mm[contact.touching], 90))
    mask = binary_dilation(contact.closed, iterations=2) & (contact.gap_mm <= reach)
    if np.count_nonzero(mask) < 16:
        mask = binary_dilation(contact.touching, iterations=2) & (contact.gap_mm < NO_BODY_MM)
    top = mask & (contact.gap_mm <= 0.6 * float(contact.gap_mm[mask].max()))
    return top if np.count_nonzero(top) >= 24 else mask
