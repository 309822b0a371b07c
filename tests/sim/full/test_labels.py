"""Shape labels of drawn objects: what touches decides, and what is doubtful is marked."""

import numpy as np
import pytest

from cltp.tactile.states import Shape, Texture
from sim.full.drawn.surface import Surface, no_elements
from sim.full.labels import DrawnContact, name_drawn, name_skin
from sim.full.skins import DrawnSkin

PITCH = 0.2
X, Y = np.meshgrid((np.arange(100) - 49.5) * PITCH, (37 - np.arange(75)) * PITCH)


def contact(shape, touching, elements=None, gap=None, **options):
    surface = Surface(
        shape=shape,
        behind_mm=lambda u, v: 0 * u,
        elements=no_elements,
        extent_mm=3.0,
        needed=options.pop("needed", 1),
        is_flat=options.pop("is_flat", False),
    )
    numbers = np.where(touching, 0, -1) if elements is None else elements
    return DrawnContact(
        surface=surface,
        gap_mm=np.where(touching, 0.0, 5.0) if gap is None else gap,
        elements=numbers,
        element_mm2=options.pop("element_mm2", float((numbers == 0).sum()) * PITCH**2),
        touching=touching,
        closed=touching,
        pitch_mm=PITCH,
    )


RING = np.abs(np.hypot(X, Y) - 3) < 0.5


def test_a_whole_face_is_certain_and_half_of_one_is_not():
    face = (np.abs(X) < 3) & (np.abs(Y) < 2)
    assert name_drawn(contact(Shape.CUBOID, face, is_flat=True)) == (Shape.CUBOID, True)
    half = contact(Shape.CUBOID, face, is_flat=True, element_mm2=48.0)
    assert not name_drawn(half).sure
    tilted = contact(Shape.CUBOID, face & (X > 1.5), np.where(face, 0, -1), is_flat=True)
    assert not name_drawn(tilted).sure


def test_part_of_a_ring_is_a_crescent():
    assert name_drawn(contact(Shape.RING, RING, is_flat=True)) == (Shape.RING, True)
    whole_mm2 = float(RING.sum()) * PITCH**2
    half = contact(Shape.RING, RING & (X > 0), is_flat=True, element_mm2=whole_mm2)
    assert name_drawn(half) == (Shape.CRESCENT, True)


def test_a_face_over_most_of_the_pad_is_a_plane():
    assert name_drawn(contact(Shape.CUBOID, X < 8, is_flat=True)).shape is Shape.PLANE
    less = name_drawn(contact(Shape.PLANE, X < 4, is_flat=True))
    assert less == (Shape.CUBOID, False)


@pytest.mark.parametrize(("count", "label"), [(1, Shape.SPHERE), (2, Shape.DOTS), (3, Shape.DOTS)])
def test_dots_need_three_that_touch(count, label):
    numbers = np.full(X.shape, -1)
    for i in range(count):
        numbers[np.hypot(X - 3 * i + 3, Y) < 0.6] = i
    named = name_drawn(contact(Shape.DOTS, numbers >= 0, numbers, needed=3))
    assert named == (label, count == 3)


def test_a_cross_of_one_arm_is_a_line():
    numbers = np.full(X.shape, -1)
    numbers[(np.abs(Y) < 0.4) & (X > 1) & (X < 5)] = 1
    assert name_drawn(contact(Shape.CROSS, numbers >= 0, numbers)).shape is Shape.LINE
    for i, (x, y) in enumerate([(-3, 0), (3, 0), (0, -3), (0, 3)]):
        half = (2.0, 0.4) if y == 0 else (0.4, 2.0)
        numbers[(np.abs(X - x) < half[0]) & (np.abs(Y - y) < half[1])] = i
    assert name_drawn(contact(Shape.CROSS, numbers >= 0, numbers)) == (Shape.CROSS, True)


def test_a_few_points_are_never_certain():
    assert not name_drawn(contact(Shape.PEAK, np.hypot(X, Y) < 0.25)).sure


def test_a_cap_at_the_border_is_doubtful():
    gap = (X**2 + Y**2) / 20
    assert name_drawn(contact(Shape.SPHERE, gap < 0.3, gap=gap)).sure
    beside = ((X - 9.9) ** 2 + Y**2) / 20
    assert not name_drawn(contact(Shape.SPHERE, beside < 0.3, gap=beside)).sure


def test_a_relief_that_does_not_show_is_smooth():
    closed = np.hypot(X, Y) < 3
    flat = DrawnSkin(texture=Texture.BUMPY, behind_mm=np.zeros_like(X), pitch_mm=2.0)
    assert name_skin(flat, closed, PITCH) == (Texture.SMOOTH, True)
    bumps = DrawnSkin(
        texture=Texture.BUMPY, behind_mm=0.1 * np.cos(3 * X) * np.cos(3 * Y), pitch_mm=2.0
    )
    assert name_skin(bumps, closed, PITCH) == (Texture.BUMPY, True)
    assert not name_skin(bumps, np.hypot(X, Y) < 0.9, PITCH)[1]
