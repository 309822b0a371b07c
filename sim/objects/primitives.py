"""Boxes, pegs, tubes, tips and patterns in millimetres, from which objects are built.

A tip or an end points to +z and lies at z = 0; other solids are centred on the origin.

Not here: objects (``sim.objects.catalogue``), distances (``sim.objects.solids``).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from cltp.tactile.states import Shape
from sim.objects.compounds import Blend, Hollow, Placed, moved
from sim.objects.faces import Barrel, Bore, Cell, Dome, Face, Flat, Form, Ripple
from sim.objects.solids import Cut, Oval, Rods, Solid

UP, DOWN = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)
_SIDE = Cell(form=Form.TAPER, outline=Shape.TRIANGLE)
_TIP = Cell(form=Form.TAPER, outline=Shape.PEAK)
_FACE = Cell(form=Form.FLAT, outline=Shape.TRIANGLE)


def _end(outline: Shape) -> Flat:
    return Flat(UP, 0.0, Cell(form=Form.FLAT, outline=outline))


def _base(length: float, outline: Shape = Shape.DISC) -> Flat:
    return Flat(DOWN, length, Cell(form=Form.FLAT, outline=outline))


def ball(diameter: float) -> Rods:
    """A ball about the origin."""
    origin = (0.0, 0.0, 0.0)
    return Rods(((origin, origin),), diameter / 2, Form.CURVED)


def oval(x: float, y: float, z: float) -> Oval:
    """An ellipsoid by its whole axes."""
    return Oval(x / 2, y / 2, z / 2)


def box(x: float, y: float, z: float, fillet: float = 0.4) -> Cut:
    """A box by its whole edges."""
    half = (x / 2, y / 2, z / 2)
    faces = [
        Flat((sign * (axis == 0), sign * (axis == 1), sign * (axis == 2)), reach)
        for axis, reach in enumerate(half)
        for sign in (1.0, -1.0)
    ]
    return Cut(tuple(faces), fillet, math.hypot(*half), leaning=1.0)


def rod(diameter: float, length: float, fillet: float = 0.3, end: Shape = Shape.DISC) -> Cut:
    """A cylinder with two flat ends."""
    faces = (_end(end), _base(length, end), Barrel(diameter / 2))
    return Cut(faces, fillet, math.hypot(diameter / 2, length), leaning=1.0)


def taper(top: float, bottom: float, length: float, fillet: float = 0.3) -> Cut:
    """A truncated cone: diameters at its end and ``length`` below it."""
    widening = (top - bottom) / 2 / length
    faces = (_end(Shape.DISC), _base(length), Barrel(top / 2, widening))
    return Cut(faces, fillet, math.hypot(max(top, bottom) / 2, length))


def lengthwise(diameter: float, length: float) -> Rods:
    """A rod with round ends."""
    return Rods((((0.0, 0.0, -length), (0.0, 0.0, 0.0)),), diameter / 2, Form.CURVED)


def prism(
    corners: Sequence[tuple[float, float]], length: float, outline: Shape, fillet: float = 0.25
) -> Cut:
    """A convex outline (counter-clockwise) extruded along z."""
    faces: list[Face] = [_end(outline), _base(length, outline)]
    for (u0, v0), (u1, v1) in zip(corners, [*corners[1:], corners[0]], strict=True):
        side = math.hypot(u1 - u0, v1 - v0)
        normal = ((v1 - v0) / side, -(u1 - u0) / side, 0.0)
        faces.append(Flat(normal, u0 * normal[0] + v0 * normal[1]))
    reach = max(math.hypot(u, v) for u, v in corners)
    return Cut(tuple(faces), fillet, math.hypot(reach, length))


def hexagonal(across: float, length: float, fillet: float = 0.25) -> Cut:
    """A hexagonal prism by its circumscribed diameter."""
    return prism(polygon(6, across), length, Shape.HEXAGON, fillet)


def triangular(corners: Sequence[tuple[float, float]], length: float) -> Cut:
    """A triangular prism."""
    return prism(corners, length, Shape.TRIANGLE)


def polygon(num: int, across: float) -> list[tuple[float, float]]:
    """Corners of a regular polygon by its circumscribed diameter."""
    steps = (2 * math.pi * i / num for i in range(num))
    return [(across / 2 * math.cos(a), across / 2 * math.sin(a)) for a in steps]


def triangle(a: float, b: float, c: float, radius: float) -> list[tuple[float, float]]:
    """Corners of a triangle on a circle, at three angles [°]."""
    return [
        (radius * math.cos(math.radians(d)), radius * math.sin(math.radians(d))) for d in (a, b, c)
    ]


def block(x: float, y: float, length: float, fillet: float = 0.25) -> Cut:
    """A rectangular peg."""
    return prism(_rectangle(x, y), length, Shape.CUBOID, fillet)


def _rectangle(x: float, y: float) -> list[tuple[float, float]]:
    return [(x / 2, y / 2), (-x / 2, y / 2), (-x / 2, -y / 2), (x / 2, -y / 2)]


def tube(outer: float, inner: float, length: float, fillet: float = 0.2) -> Cut:
    """A pipe; its end counts as a ring, or as a face with a hole where the wall is thick."""
    outline = Shape.RING if (outer - inner) / 2 <= 1.5 else Shape.HOLE
    faces = (_end(outline), _base(length, outline), Barrel(outer / 2), Bore(inner / 2))
    return Cut(faces, fillet, math.hypot(outer / 2, length), leaning=1.0)


def bored(solid: Cut, diameter: float, fillet: float = 0.2) -> Cut:
    """A prism or rod with a bore through its end, which then counts as a face with a hole."""
    hole = Cell(form=Form.FLAT, outline=Shape.HOLE)
    faces = (
        replace(face, cell=hole) if isinstance(face, Flat) and abs(face.normal[2]) == 1.0 else face
        for face in solid.faces
    )
    return Cut((*faces, Bore(diameter / 2)), fillet, solid.reach_mm, solid.leaning)


def dished(diameter: float, length: float, sphere: float, depth: float) -> Hollow:
    """A rod whose end has a round hollow, ``depth`` deep, cut by a ball of radius ``sphere``."""
    end = rod(diameter, length, 0.3, Shape.HOLE)
    return Hollow(end, moved(ball(2 * sphere), z=sphere - depth))


def cone(half_angle: float, length: float, blunt: float = 0.25, shank: float = 11.0) -> Cut:
    """A cone with its tip up, by the angle [°] between axis and side, on a shank."""
    widening = -math.tan(math.radians(half_angle))
    faces = (
        Flat(UP, 0.0, _TIP),
        Barrel(blunt, widening, Cell(form=Form.TAPER)),
        Barrel(shank / 2),
        _base(length),
    )
    return Cut(faces, blunt, math.hypot(shank / 2, length), 1.42)


def pyramid(
    num: int, half_angle: float, length: float, blunt: float = 0.2, shank: float = 12.0
) -> Cut:
    """A pyramid with its tip up, by the angle [°] between axis and faces, on a round shank."""
    rise, run = math.sin(math.radians(half_angle)), math.cos(math.radians(half_angle))
    # Three faces count as a corner.
    tip, side = (_TIP, _SIDE) if num > 3 else (_FACE, _FACE)
    faces: list[Face] = [Flat(UP, 0.0, tip), _base(length), Barrel(shank / 2)]
    for i in range(num):
        turn = 2 * math.pi * i / num
        faces.append(Flat((run * math.cos(turn), run * math.sin(turn), rise), blunt * run, side))
    leaning = math.sqrt(1 + num * rise**2)
    return Cut(tuple(faces), blunt, math.hypot(shank / 2, length), leaning)


def roof(angle: float, width: float, length: float, lean: float = 0.0, fillet: float = 0.2) -> Cut:
    """A wedge with its edge up, along x, by the angle [°] between its faces."""
    faces: list[Face] = [
        Flat(DOWN, width),
        Flat((1.0, 0.0, 0.0), length / 2),
        Flat((-1.0, 0.0, 0.0), length / 2),
    ]
    for sign in (1.0, -1.0):
        max_slope = math.radians(90 - angle / 2 + sign * lean)
        faces.append(Flat((0.0, sign * math.sin(max_slope), math.cos(max_slope)), 0.0))
    reach = math.hypot(length / 2, width, width * math.tan(math.radians(angle / 2 + abs(lean))))
    return Cut(tuple(faces), fillet, reach)


def rounded(radius: float, length: float, diameter: float) -> Cut:
    """A rod with a domed end, of radius ``radius``."""
    faces = (Dome(radius, -radius), Barrel(diameter / 2), _base(length))
    return Cut(faces, 0.3, math.hypot(diameter / 2, length), 1.42)


def on_base(pattern: Solid, diameter: float, below: float = 1.8, length: float = 14.0) -> Blend:
    """A pattern on a round shank whose end lies ``below`` under z = 0."""
    return Blend((pattern, moved(rod(diameter, length), z=-below)))


def bars(
    lines: Sequence[tuple[float, float, float, float]], width: float, below: float = 0.0
) -> Rods:
    """Round bars between (x0, y0) and (x1, y1), their tops at z = 0."""
    z = -width / 2 - below
    return Rods(tuple(((a, b, z), (c, d, z)) for a, b, c, d in lines), width / 2)


def flat_bar(length: float, width: float, height: float = 12.0) -> Cut:
    """A blade with a flat edge at z = 0, along x."""
    return prism(_rectangle(length, width), height, Shape.LINE, min(0.3, 0.3 * width))


def parallel(num: int, pitch: float, length: float, width: float) -> Rods:
    """Round bars side by side along x."""
    rows = [(i - (num - 1) / 2) * pitch for i in range(num)]
    return bars([(-length / 2, y, length / 2, y) for y in rows], width)


def crossing(first: float, second: float, width: float, angle: float = 90.0) -> Rods:
    """Two round bars that cross at an angle [°]."""
    x, y = (second / 2 * f(math.radians(angle)) for f in (math.cos, math.sin))
    return bars([(-first / 2, 0, first / 2, 0), (-x, -y, x, y)], width)


def lattice(columns: int, rows: int, pitch: float, skew: float = 0.0) -> list[tuple[float, float]]:
    """Points of a lattice about the origin; every other row is shifted by ``skew`` pitches."""
    rise = pitch * math.sqrt(1 - skew**2)
    points = [
        (i * pitch + (j % 2) * skew * pitch, j * rise) for j in range(rows) for i in range(columns)
    ]
    mid_x = sum(x for x, _ in points) / len(points)
    mid_y = sum(y for _, y in points) / len(points)
    return [(x - mid_x, y - mid_y) for x, y in points]


def bumps(points: Sequence[tuple[float, float]], diameter: float) -> Rods:
    """Round bumps whose tops lie at z = 0, each a cell."""
    z = -diameter / 2
    return Rods(tuple(((x, y, z), (x, y, z)) for x, y in points), diameter / 2, Form.DOT)


def waves(x: float, y: float, period: float, amplitude: float, height: float = 12.0) -> Cut:
    """A block whose upper face is corrugated, its crests along y at z = 0."""
    sides = ((1, 0, 0, x), (-1, 0, 0, x), (0, 1, 0, y), (0, -1, 0, y))
    faces: list[Face] = [Ripple(0.0, period, amplitude), Flat(DOWN, height)]
    faces += [Flat((float(a), float(b), float(c)), span / 2) for a, b, c, span in sides]
    return Cut(tuple(faces), 0.25, math.hypot(x / 2, y / 2, height))


def on_corner(edge: float, fillet: float = 0.3) -> Placed:
    """A cube about the origin with a corner towards +z."""
    a, b, c = 1 / math.sqrt(2), 1 / math.sqrt(6), 1 / math.sqrt(3)
    return Placed(box(edge, edge, edge, fillet), turn=((a, b, c), (-a, b, c), (0.0, -2 * b, c)))
