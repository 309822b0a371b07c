"""What a contact is called, from the geometry that touches: one of the 19 shapes, and how surely.

A box can give a plane, a cuboid, an edge or a corner; which one is decided by what lies under the
pressure. Each grid point knows the cell of the surface that it belongs to (``sim.objects.solids``);
flat faces, edges and tips follow from how many cells touch and how the gap runs over them, curved
surfaces from their principal curvatures, patterns from how much of them touches.

A name is unsure where another would do nearly as well: close to a limit of the vocabulary, cut
off by the pad, or of several things at once.

Not here: depth, position, area (``sim.tcl3d.labels``), texture (``sim.objects.object``).
"""

from __future__ import annotations

import math

import numpy as np

from cltp.tactile.states import Shape
from sim.gel.gap import NO_BODY_MM
from sim.objects.faces import Cell, Form
from sim.tcl3d.masks import (
    FloatArray,
    Mask,
    angle_between,
    curvatures,
    cut_share,
    enclosed,
    grown,
    pieces,
    share_of,
    slopes,
    spread_of,
    way_round,
)
from sim.tcl3d.touch import Named, Touch, about_to_touch

PLANE_SHARE = 0.80
"""Share of the field from which a flat contact is a plane (``cltp.tactile.states.Shape``)."""

CAP_RATIOS = (1.4, 4.0)
"""Ratios of curvatures between sphere, ellipsoid and cylinder."""

BAR_MM = 1.6
"""Widest bar that is a line: 1.5 mm and half a grid point."""

_RATIO_UNSURE = (0.95, 1.05)  # factors about a limit between which a ratio is unsure
_RUNS_OUT, _RUNS_OUT_UNSURE = 0.32, 0.06  # of the depth, over a face: tilted rather than flat
_CUT_UNSURE = 0.34  # of the outline, at the pad's border
_CUT_STRAIGHT = 0.42  # the same for a rectangle, of which less needs to be seen
_SHARP_MM = 1.6  # radius of curvature from which an edge is a round
_ENDS_SEEN = 0.15  # share of an outline at the border up to which a face is seen as a whole
_ASLANT = 0.2  # slope up to which a face that touches as a whole is seen as that face
_LEVEL_MM = 0.35  # how far a round falls away within 0.6 mm, at most
_LONG = 2.1  # elongation between corners and edges
_FLAT_PER_MM = 1 / 120  # curvature of what is as good as flat
_CAVITY_MM2 = 0.8  # smallest hole
_TINY = 30  # grid points of a contact that is no larger than an edge's fillet
_FEW = 3  # grid points that a cell must touch with to count


def name_shape(touch: Touch) -> Named:
    """Name the shape of what touches."""
    if np.count_nonzero(touch.touching) < _TINY:
        touch = about_to_touch(touch)
    numbers = np.flatnonzero(touch.counts).tolist()
    shares: dict[Form, int] = {}
    for number in numbers:
        form = touch.table[number].form
        shares[form] = shares.get(form, 0) + int(touch.counts[number])
    form = max(shares, key=lambda one: shares[one])
    pure = shares[form] >= 0.75 * sum(shares.values())
    present = [n for n in numbers if touch.counts[n] >= _FEW]
    of_form = [n for n in present if touch.table[n].form is form]
    match form:
        case Form.BAR:
            named = _bars(touch, of_form)
        case Form.LOOP:
            chosen = np.isin(np.arange(len(touch.table) + 1), of_form)  # the last one: no cell
            named = _loop(touch, chosen[touch.cells] & touch.touching)
        case Form.DOT:
            named = _several(touch, of_form, Shape.DOTS, enough=3)
        case Form.CREST:
            named = _several(touch, of_form, Shape.WAVE, enough=2)
        case _:
            return _plain(touch, present or [int(touch.counts.argmax())])
    return Named(named.shape, named.sure and pure)


def _bars(touch: Touch, bars: list[int]) -> Named:
    if len(bars) < 2:
        return _one_bar(touch)
    directions, sizes = [], []
    for number in bars:
        spread = spread_of((touch.cells == number) & touch.touching, touch.pitch_mm)
        sizes.append(spread.length)
        if spread.length > 2 * spread.width:
            directions.append(spread.angle)
    if not directions:
        return Named(Shape.STRIPES, False)
    apart = max(angle_between(a, directions[0]) for a in directions)
    short = sorted(sizes)[-2] < 0.25 * max(sizes)
    if apart > math.radians(30):
        return Named(Shape.CROSS, not short and len(directions) == len(bars))
    return Named(Shape.STRIPES, not short)


def _one_bar(touch: Touch) -> Named:
    spread = spread_of(touch.touching, touch.pitch_mm)
    if spread.length < 1.8 * spread.width:
        return Named(_cap(touch).shape, False)
    return Named(Shape.LINE, spread.length > 2.2 * spread.width)


def _several(touch: Touch, cells: list[int], shape: Shape, *, enough: int) -> Named:
    if len(cells) >= enough:
        return Named(shape, True)
    if len(cells) == 1:
        return _cap(touch)
    return Named(shape, False)


def _loop(touch: Touch, mask: Mask) -> Named:
    """Ring, crescent, or the side of a bent bar, by how far round the contact goes."""
    share = way_round(mask)
    if share >= 0.8:
        return Named(Shape.RING, share >= 0.82)
    if share >= 0.14:  # about 50°
        return Named(Shape.CRESCENT, 0.17 <= share < 0.76)
    named = _cap(touch)
    return Named(named.shape, named.sure and share < 0.11)


def _plain(touch: Touch, present: list[int]) -> Named:
    """Faces, edges, corners, tips and curved surfaces."""
    in_one = pieces(touch.closed) == 1
    main = max(present, key=lambda n: touch.counts[n])
    share = float(touch.counts[main] / np.count_nonzero(touch.touching))
    cell = touch.table[main]
    every = touch.cells == main
    own = every & touch.touching
    flank = cell.form is Form.TAPER and cell.outline in (None, Shape.PEAK)
    if cell.outline is Shape.LINE and share >= 0.5:  # the edge of a blade, however it leans
        spread = spread_of(touch.touching, touch.pitch_mm)
        return Named(Shape.LINE, spread.length > 2.4 * spread.width and in_one)
    if cell.form is not Form.CURVED and not flank and share >= 0.5:
        runs_out = float(np.ptp(np.percentile(touch.gap_mm[own], [8, 92]))) / touch.depth_mm
        covered = float(np.count_nonzero(own) / np.count_nonzero(every))
        seen = cut_share(touch.closed) < _ENDS_SEEN
        whole = covered > 0.9 and seen and _slope(touch, own) < _ASLANT
        if runs_out < _RUNS_OUT or whole:
            named = _outline(touch, cell, own)
            level = runs_out < _RUNS_OUT - _RUNS_OUT_UNSURE or whole
            sure = named.sure and level and share >= 0.6
            return Named(named.shape, sure and in_one)
    elif cell.form is Form.CURVED and share >= 0.85 and (_rounds_off(touch) or _lies_level(touch)):
        named = _cap(touch)
        return Named(named.shape, named.sure and in_one)
    named = _sharp(touch, present)
    return Named(named.shape, named.sure and in_one)


def _rounds_off(touch: Touch) -> bool:
    """Whether a curved surface is level where it touches first, instead of ending there."""
    row, column = np.unravel_index(int(touch.gap_mm.argmin()), touch.gap_mm.shape)
    about = touch.gap_mm[max(row - 3, 0) : row + 4, max(column - 3, 0) : column + 4]
    return float(about.max()) < _LEVEL_MM


def _slope(touch: Touch, where: Mask) -> float:
    """Mean slope of the bare surface."""
    down, right = slopes(touch.gap_mm, where, touch.pitch_mm)
    return math.hypot(float(np.median(right)), float(np.median(down)))


def _lies_level(touch: Touch) -> bool:
    """Whether the flanks of what touches balance: a rod near its end, not on it."""
    down, right = slopes(touch.gap_mm, touch.touching, touch.pitch_mm)
    gentle = np.hypot(down, right) < 1.5
    if not gentle.any():
        return False
    return math.hypot(float(right[gentle].mean()), float(down[gentle].mean())) < 0.06


def _outline(touch: Touch, cell: Cell, own: Mask) -> Named:
    """A flat contact by its outline."""
    field = share_of(touch.closed)
    if field >= PLANE_SHARE and cell.outline is Shape.HOLE:
        if enclosed(touch.closed) * touch.pitch_mm**2 > _CAVITY_MM2:
            return Named(Shape.HOLE, True)
        return Named(Shape.PLANE, field > 0.97)
    if field >= PLANE_SHARE:
        return Named(Shape.PLANE, field >= PLANE_SHARE + 0.015)
    spread = spread_of(own, touch.pitch_mm)
    whole = cut_share(touch.closed) < _CUT_UNSURE and field < PLANE_SHARE - 0.05
    aspect = spread.length / spread.width
    if cell.outline in (Shape.RING, Shape.CRESCENT):
        named = _loop(touch, own)
        return named if named.shape in (Shape.RING, Shape.CRESCENT) else Named(Shape.LINE, False)
    if cell.outline is Shape.HOLE:
        around = enclosed(touch.closed) * touch.pitch_mm**2 > _CAVITY_MM2
        return Named(Shape.HOLE, around)
    bar = BAR_MM if cell.outline is not Shape.LINE else 2 * BAR_MM  # made to be one
    if spread.width <= bar and aspect >= 2:
        return Named(Shape.LINE, aspect >= 2.4)
    if cell.outline in (None, Shape.CUBOID, Shape.LINE):
        straight = cut_share(touch.closed) < _CUT_STRAIGHT and field < PLANE_SHARE - 0.05
        return Named(Shape.CUBOID, straight and aspect < 2.4)
    return Named(cell.outline, whole and aspect < 2.4)


def _sharp(touch: Touch, present: list[int]) -> Named:
    """Edge, corner or peak: several cells touch, or one that ends."""
    near = grown(touch.touching, 2)
    around = np.flatnonzero(touch.counts_in(near)).tolist()
    spread = spread_of(touch.touching, touch.pitch_mm)
    long = spread.length / spread.width
    tapers = [n for n in around if touch.table[n].form is Form.TAPER]
    if any(touch.table[n].outline is Shape.PEAK for n in tapers):
        return Named(Shape.PEAK, long < 2.6)
    if len(present) == 1 and touch.table[present[0]] == Cell(form=Form.TAPER):  # a cone's side
        return _cap(touch)
    level = _rounds_off(touch)
    radius = 1 / max(curvatures(touch.gap_mm, _top(touch), touch.pitch_mm)[1], 1e-3)
    if level and radius > _SHARP_MM:
        named = _cap(touch)
        return Named(named.shape, named.sure and radius > 1.9)
    faces = [n for n in around if n not in present or touch.counts[n] >= _FEW]
    cliffs = bool((touch.gap_mm[near] >= NO_BODY_MM).any())
    sides = len(faces) + cliffs
    bend = _bend(touch, present)
    if any(touch.table[n].form is Form.CURVED for n in around):  # a rim
        blunt = bend is not None and bend < math.radians(42)
        return Named(Shape.EDGE, long > 1.25 and sides >= 2 and not blunt)
    dull = bend is not None and not math.radians(50) < bend < math.radians(130)
    whole = cut_share(touch.closed) < 0.45
    if sides >= 3 and long < _LONG:
        return Named(Shape.CORNER, long < 0.93 * _LONG and not dull and whole)
    return Named(Shape.EDGE, long > (1.07 * _LONG if sides >= 3 else 1.4) and not dull)


def _bend(touch: Touch, present: list[int]) -> float | None:
    """Angle between the normals of the two cells that touch most [rad]."""
    if len(present) < 2:
        return None
    first, second = sorted(present, key=lambda n: -touch.counts[n])[:2]
    normals: list[FloatArray] = []
    near = grown(touch.touching, 5) & (touch.gap_mm < NO_BODY_MM)
    fillet = grown(touch.touching) if np.count_nonzero(touch.touching) < 60 else touch.touching
    for number in (first, second):
        own = (touch.cells == number) & near
        beside = own & ~fillet
        own = beside if np.count_nonzero(beside) >= _FEW else own
        down, right = slopes(touch.gap_mm, own, touch.pitch_mm)
        slope = float(np.median(right)), float(np.median(down))
        normals.append(np.array([*slope, 1.0]) / math.hypot(*slope, 1.0))
    return math.acos(float(np.clip(np.dot(normals[0], normals[1]), -1, 1)))


def _cap(touch: Touch) -> Named:
    """Sphere, ellipsoid, cylinder or line by the curvatures of what touches."""
    low, high = curvatures(touch.gap_mm, _top(touch), touch.pitch_mm)
    if high < _FLAT_PER_MM:
        return Named(Shape.PLANE if share_of(touch.closed) >= PLANE_SHARE else Shape.CUBOID, False)
    ratio = high / max(low, 1e-9)
    sure = low > -0.15 * high
    for limit in CAP_RATIOS:
        sure = sure and not _RATIO_UNSURE[0] * limit < ratio < _RATIO_UNSURE[1] * limit
    if ratio < CAP_RATIOS[0]:
        return Named(Shape.SPHERE, sure)
    if ratio < CAP_RATIOS[1]:
        return Named(Shape.ELLIPSOID, sure)
    radius = 1 / high
    if radius < 1.1:
        return Named(Shape.LINE, sure and radius < 0.8)
    return Named(Shape.CYLINDER, sure and radius > 1.4)


def _top(touch: Touch) -> Mask:
    """What touches first: there a quadric tells the curvatures, further out it overstates them."""
    # Not only the tops of a texture: all that lies as near as they do.
    reach = float(np.percentile(touch.gap_mm[touch.touching], 90))
    own = grown(touch.closed, 2) & (touch.gap_mm <= reach)
    if np.count_nonzero(own) < 16:
        own = grown(touch.touching, 2) & (touch.gap_mm < NO_BODY_MM)
    top = own & (touch.gap_mm <= 0.6 * float(touch.gap_mm[own].max()))
    return top if np.count_nonzero(top) >= 24 else own
