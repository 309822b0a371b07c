"""What a contact is called, from the geometry that touches: one of the 19 shapes, and how surely.

A box can give a plane, a cuboid, an edge or a corner; which one is decided by what lies under the
pressure. Each grid point knows the cell of the surface that it belongs to (``sim.solids``); flat
faces, edges and tips follow from how many cells touch and how the gap runs over them, curved
surfaces from their principal curvatures, patterns from how much of them touches.

A name is unsure where another would do nearly as well: close to a limit of the vocabulary, cut
off by the pad, or of several things at once.

Not here: depth, position, area (``sim.labels``), texture (``sim.objects``).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation, label

from cltp.states import Shape
from sim.bodies import FAR_MM
from sim.faces import Cell, Form

FloatArray = NDArray[np.float64]
Mask = NDArray[np.bool_]

PLANE_SHARE = 0.80
"""Share of the field from which a flat contact is a plane (``cltp.states.Shape``)."""

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
_BEHIND_MM = 0.3  # what counts as about to touch
_FLAT_PER_MM = 1 / 120  # curvature of what is as good as flat
_CAVITY_MM2 = 0.8  # smallest hole
_TINY = 30  # grid points of a contact that is no larger than an edge's fillet
_FEW = 3  # grid points that a cell must touch with to count


class Named(NamedTuple):
    """A shape, and whether a careful person would call it so without doubt."""

    shape: Shape
    sure: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class Touch:
    """What lies over the pad, and where it touches.

    Attributes:
        gap_mm: Shape (H, W), the bare surface behind its foremost point [mm].
        cells: Shape (H, W), number of the cell there, -1 where nothing is.
        table: Cells by number.
        touching: Shape (H, W), where pressure acts.
        closed: Same, fine gaps closed (``sim.labels.in_contact``).
        depth_mm: Largest indentation [mm].
        pitch_mm: Of the grid [mm].
    """

    gap_mm: FloatArray
    cells: NDArray[np.int64]
    table: Sequence[Cell]
    touching: Mask
    closed: Mask
    depth_mm: float
    pitch_mm: float


def name_shape(touch: Touch) -> Named:
    """Name the shape of what touches."""
    if touch.touching.sum() < _TINY:
        touch = _about_to_touch(touch)
    numbers, counts = np.unique(touch.cells[touch.touching], return_counts=True)
    known = numbers >= 0
    numbers, counts = numbers[known], counts[known]
    shares: dict[Form, int] = {}
    for number, count in zip(numbers, counts, strict=True):
        form = touch.table[number].form
        shares[form] = shares.get(form, 0) + int(count)
    form = max(shares, key=lambda one: shares[one])
    pure = shares[form] >= 0.75 * sum(shares.values())
    present = [int(n) for n, c in zip(numbers, counts, strict=True) if c >= _FEW]
    of_form = [n for n in present if touch.table[n].form is form]
    match form:
        case Form.BAR:
            named = _bars(touch, of_form)
        case Form.LOOP:
            named = _loop(touch, np.isin(touch.cells, of_form) & touch.touching)
        case Form.DOT:
            named = _several(touch, of_form, Shape.DOTS, enough=3)
        case Form.CREST:
            named = _several(touch, of_form, Shape.WAVE, enough=2)
        case _:
            return _plain(touch, present or [int(numbers[counts.argmax()])])
    return Named(named.shape, named.sure and pure)


def _about_to_touch(touch: Touch) -> Touch:
    """A contact no larger than the fillet of an edge, with what lies just behind it."""
    near = binary_dilation(touch.touching, iterations=4)
    touching = touch.touching | (near & (touch.gap_mm < _BEHIND_MM))
    closed = touch.closed | touching
    depth_mm = max(touch.depth_mm, 1.5 * _BEHIND_MM)
    return replace(touch, touching=touching, closed=closed, depth_mm=depth_mm)


def _bars(touch: Touch, bars: list[int]) -> Named:
    if len(bars) < 2:
        return _one_bar(touch)
    directions, sizes = [], []
    for number in bars:
        spread = _spread((touch.cells == number) & touch.touching, touch.pitch_mm)
        sizes.append(spread.length)
        if spread.length > 2 * spread.width:
            directions.append(spread.angle)
    if not directions:
        return Named(Shape.STRIPES, False)
    apart = max(_between(a, directions[0]) for a in directions)
    short = sorted(sizes)[-2] < 0.25 * max(sizes)
    if apart > math.radians(30):
        return Named(Shape.CROSS, not short and len(directions) == len(bars))
    return Named(Shape.STRIPES, not short)


def _one_bar(touch: Touch) -> Named:
    spread = _spread(touch.touching, touch.pitch_mm)
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
    share = _way_round(mask)
    if share >= 0.8:
        return Named(Shape.RING, share >= 0.82)
    if share >= 0.14:  # about 50°
        return Named(Shape.CRESCENT, 0.17 <= share < 0.76)
    named = _cap(touch)
    return Named(named.shape, named.sure and share < 0.11)


def _way_round(mask: Mask) -> float:
    """Share of a circle, fitted to a thin mask, along which the mask goes."""
    row, column = np.nonzero(mask)
    if len(row) < 8:
        return 0.0
    terms = np.stack([column, row, np.ones_like(row)], axis=1).astype(np.float64)
    square = (column**2 + row**2).astype(np.float64)
    fit, *_ = np.linalg.lstsq(terms, square, rcond=None)
    angle = np.arctan2(row - fit[1] / 2, column - fit[0] / 2)
    bins = np.unique(np.floor((angle + math.pi) / (2 * math.pi) * 36).astype(int) % 36)
    return len(bins) / 36


def _plain(touch: Touch, present: list[int]) -> Named:
    """Faces, edges, corners, tips and curved surfaces."""
    pieces = _pieces(touch.closed)
    counts = {n: int(((touch.cells == n) & touch.touching).sum()) for n in present}
    main = max(present, key=lambda n: counts[n])
    share = counts[main] / int(touch.touching.sum())
    cell = touch.table[main]
    own = (touch.cells == main) & touch.touching
    flank = cell.form is Form.TAPER and cell.outline in (None, Shape.PEAK)
    if cell.outline is Shape.LINE and share >= 0.5:  # the edge of a blade, however it leans
        spread = _spread(touch.touching, touch.pitch_mm)
        return Named(Shape.LINE, spread.length > 2.4 * spread.width and pieces == 1)
    if cell.form is not Form.CURVED and not flank and share >= 0.5:
        runs_out = float(np.ptp(np.percentile(touch.gap_mm[own], [8, 92]))) / touch.depth_mm
        covered = own.sum() / (touch.cells == main).sum()
        seen = _cut_share(touch.closed) < _ENDS_SEEN
        whole = covered > 0.9 and seen and _slope(touch, own) < _ASLANT
        if runs_out < _RUNS_OUT or whole:
            named = _outline(touch, cell, own)
            level = runs_out < _RUNS_OUT - _RUNS_OUT_UNSURE or whole
            sure = named.sure and level and share >= 0.6
            return Named(named.shape, sure and pieces == 1)
    elif cell.form is Form.CURVED and share >= 0.85 and (_rounds_off(touch) or _lies_level(touch)):
        named = _cap(touch)
        return Named(named.shape, named.sure and pieces == 1)
    named = _sharp(touch, present, counts)
    return Named(named.shape, named.sure and pieces == 1)


def _rounds_off(touch: Touch) -> bool:
    """Whether a curved surface is level where it touches first, instead of ending there."""
    row, column = np.unravel_index(int(touch.gap_mm.argmin()), touch.gap_mm.shape)
    about = touch.gap_mm[max(row - 3, 0) : row + 4, max(column - 3, 0) : column + 4]
    return float(about.max()) < _LEVEL_MM


def _pieces(mask: Mask) -> int:
    """Parts of a mask that are more than crumbs of the largest one."""
    parts, _ = label(mask, structure=np.ones((3, 3)))
    sizes = np.bincount(parts.ravel())[1:]
    return int((sizes > 0.12 * sizes.max()).sum())


def _slopes(touch: Touch) -> tuple[FloatArray, FloatArray]:
    """Slopes of the bare surface along rows downwards and along columns, (H, W) each."""
    down, right = np.gradient(touch.gap_mm, touch.pitch_mm)
    return np.asarray(down), np.asarray(right)


def _slope(touch: Touch, where: Mask) -> float:
    """Mean slope of the bare surface."""
    down, right = _slopes(touch)
    return math.hypot(float(np.median(right[where])), float(np.median(down[where])))


def _lies_level(touch: Touch) -> bool:
    """Whether the flanks of what touches balance: a rod near its end, not on it."""
    down, right = _slopes(touch)
    own = touch.touching & (np.hypot(down, right) < 1.5)
    if not own.any():
        return False
    return math.hypot(float(right[own].mean()), float(down[own].mean())) < 0.06


def _outline(touch: Touch, cell: Cell, own: Mask) -> Named:
    """A flat contact by its outline."""
    field = float(touch.closed.mean())
    if field >= PLANE_SHARE and cell.outline is Shape.HOLE:
        if _enclosed(touch.closed) * touch.pitch_mm**2 > _CAVITY_MM2:
            return Named(Shape.HOLE, True)
        return Named(Shape.PLANE, field > 0.97)
    if field >= PLANE_SHARE:
        return Named(Shape.PLANE, field >= PLANE_SHARE + 0.015)
    spread = _spread(own, touch.pitch_mm)
    whole = _cut_share(touch.closed) < _CUT_UNSURE and field < PLANE_SHARE - 0.05
    aspect = spread.length / spread.width
    if cell.outline in (Shape.RING, Shape.CRESCENT):
        named = _loop(touch, own)
        return named if named.shape in (Shape.RING, Shape.CRESCENT) else Named(Shape.LINE, False)
    if cell.outline is Shape.HOLE:
        around = _enclosed(touch.closed) * touch.pitch_mm**2 > _CAVITY_MM2
        return Named(Shape.HOLE, around)
    bar = BAR_MM if cell.outline is not Shape.LINE else 2 * BAR_MM  # made to be one
    if spread.width <= bar and aspect >= 2:
        return Named(Shape.LINE, aspect >= 2.4)
    if cell.outline in (None, Shape.CUBOID, Shape.LINE):
        straight = _cut_share(touch.closed) < _CUT_STRAIGHT and field < PLANE_SHARE - 0.05
        return Named(Shape.CUBOID, straight and aspect < 2.4)
    return Named(cell.outline, whole and aspect < 2.4)


def _enclosed(mask: Mask) -> int:
    """Grid points that a mask surrounds."""
    parts, num = label(~mask)
    at_border = np.unique(np.concatenate([parts[0], parts[-1], parts[:, 0], parts[:, -1]]))
    inside = ~np.isin(np.arange(num + 1), np.append(at_border, 0))
    return int(inside[parts].sum())


def _cut_share(mask: Mask) -> float:
    """Share of a mask's outline that is the border of the grid."""
    border = int(mask[0].sum() + mask[-1].sum() + mask[:, 0].sum() + mask[:, -1].sum())
    inner = int((mask[1:] != mask[:-1]).sum() + (mask[:, 1:] != mask[:, :-1]).sum())
    return border / max(border + 0.8 * inner, 1)  # stairs are longer than what they stand for


def _sharp(touch: Touch, present: list[int], counts: dict[int, int]) -> Named:
    """Edge, corner or peak: several cells touch, or one that ends."""
    near = binary_dilation(touch.touching, iterations=2)
    around = {int(n) for n in np.unique(touch.cells[near]) if n >= 0}
    spread = _spread(touch.touching, touch.pitch_mm)
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
    faces = [n for n in around if counts.get(n, 0) >= _FEW or n not in present]
    cliffs = bool((touch.gap_mm[near] >= FAR_MM).any())
    sides = len(faces) + cliffs
    bend = _bend(touch, present, counts)
    if any(touch.table[n].form is Form.CURVED for n in around):  # a rim
        blunt = bend is not None and bend < math.radians(42)
        return Named(Shape.EDGE, long > 1.25 and sides >= 2 and not blunt)
    dull = bend is not None and not math.radians(50) < bend < math.radians(130)
    whole = _cut_share(touch.closed) < 0.45
    if sides >= 3 and long < _LONG:
        return Named(Shape.CORNER, long < 0.93 * _LONG and not dull and whole)
    return Named(Shape.EDGE, long > (1.07 * _LONG if sides >= 3 else 1.4) and not dull)


def _bend(touch: Touch, present: list[int], counts: dict[int, int]) -> float | None:
    """Angle between the normals of the two cells that touch most [rad]."""
    if len(present) < 2:
        return None
    first, second = sorted(present, key=lambda n: -counts[n])[:2]
    normals: list[FloatArray] = []
    down, right = _slopes(touch)
    near = binary_dilation(touch.touching, iterations=5) & (touch.gap_mm < FAR_MM)
    fillet = binary_dilation(touch.touching) if touch.touching.sum() < 60 else touch.touching
    for number in (first, second):
        own = (touch.cells == number) & near
        beside = own & ~fillet
        own = beside if beside.sum() >= _FEW else own
        slope = float(np.median(right[own])), float(np.median(down[own]))
        normals.append(np.array([*slope, 1.0]) / math.hypot(*slope, 1.0))
    return math.acos(float(np.clip(np.dot(normals[0], normals[1]), -1, 1)))


def _cap(touch: Touch) -> Named:
    """Sphere, ellipsoid, cylinder or line by the curvatures of what touches."""
    low, high = curvatures(touch.gap_mm, _top(touch), touch.pitch_mm)
    if high < _FLAT_PER_MM:
        return Named(Shape.PLANE if touch.closed.mean() >= PLANE_SHARE else Shape.CUBOID, False)
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
    own = binary_dilation(touch.closed, iterations=2) & (touch.gap_mm <= reach)
    if own.sum() < 16:
        own = binary_dilation(touch.touching, iterations=2) & (touch.gap_mm < FAR_MM)
    top = own & (touch.gap_mm <= 0.6 * float(touch.gap_mm[own].max()))
    return top if top.sum() >= 24 else own


def curvatures(gap_mm: FloatArray, where: Mask, pitch_mm: float) -> tuple[float, float]:
    """Principal curvatures [1/mm], smaller first, of a quadric fitted to part of a gap."""
    row, column = np.nonzero(where)
    x, y = (column - column.mean()) * pitch_mm, (row.mean() - row) * pitch_mm
    terms = np.stack([x * x, x * y, y * y, x, y, np.ones_like(x)], axis=1)
    (a, b, c, p, q, _), *_ = np.linalg.lstsq(terms, gap_mm[where], rcond=None)
    first = np.array([[1 + p * p, p * q], [p * q, 1 + q * q]])
    second = np.array([[2 * a, b], [b, 2 * c]]) / math.sqrt(1 + p * p + q * q)
    low, high = np.sort(np.linalg.eigvals(np.linalg.solve(first, second)).real)
    return float(low), float(high)


class _Spread(NamedTuple):
    """Smallest rectangle about a mask: sides [mm], direction of the longer [rad]."""

    length: float
    width: float
    angle: float


def _spread(mask: Mask, pitch_mm: float) -> _Spread:
    row, column = np.nonzero(mask)
    best = _Spread(math.inf, math.inf, 0.0)
    for degrees in range(0, 90, 5):
        cos, sin = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        u, v = column * cos - row * sin, column * sin + row * cos
        sides = (np.ptp(u) + 1) * pitch_mm, (np.ptp(v) + 1) * pitch_mm
        if sides[0] * sides[1] < best.length * best.width:
            angle = math.radians(degrees + (0 if sides[0] >= sides[1] else 90))
            best = _Spread(max(sides), min(sides), angle)
    return best


def _between(first: float, second: float) -> float:
    """Angle between two directions without a sense [rad]."""
    apart = (first - second) % math.pi
    return min(apart, math.pi - apart)
