"""Drawn objects: every one has a surface, in the sizes that its shape stands for."""

import numpy as np
import pytest

from cltp.tactile.states import Shape
from sim.full.drawn.dots import DOTS
from sim.full.drawn.faces import TRIANGLES, triangle
from sim.full.drawn.outlines import bent, curve, polygon, rounded_power
from sim.full.drawn.scans import scanned
from sim.full.drawn.surface import Draws, Rim
from sim.full.objects import DRAW_OF, DRAWN
from sim.gel.gap import NO_BODY_MM

AXIS = np.linspace(-9, 9, 181)
U, V = np.meshgrid(AXIS, AXIS)


def draws(seed=0, **options):
    values = {"lightest_mm": 0.25, "small": False, "scale": 1.0, **options}
    return Draws(np.random.default_rng(seed), **values)


@pytest.mark.parametrize("small", [False, True])
@pytest.mark.parametrize("name", DRAW_OF)
def test_every_object_has_a_surface_near_its_origin_and_elements_on_it(name, small):
    for seed in range(3):
        surface = DRAW_OF[name](draws(seed, small=small))
        height = surface.behind_mm(U, V)
        body = height < NO_BODY_MM
        assert np.isfinite(height).all()
        assert height[body].min() == pytest.approx(0, abs=0.25)
        elements = surface.elements(U, V)
        assert body[elements >= 0].all() or surface.shape in (Shape.DOTS, Shape.STRIPES)
        assert len(np.unique(elements[elements >= 0])) >= min(surface.needed, 2)
        foremost = (height < height.min() + 0.02) & body
        if surface.is_compact:
            assert np.hypot(U, V)[foremost].min() < surface.extent_mm + 0.2


def test_the_distance_from_a_square_is_that_of_a_square():
    square = np.array([(-1.0, -1), (1, -1), (1, 1), (-1, 1)])
    u, v = np.array([0.0, 2, 2, 0.5]), np.array([0.0, 0, 2, 0])
    np.testing.assert_allclose(polygon(u, v, square), [-1, 1, np.sqrt(2), -0.5])
    np.testing.assert_allclose(rounded_power(u, v, 2.0, 2.0, 2.0), np.hypot(u, v) - 2, atol=1e-6)


def test_a_notch_of_a_polygon_is_outside():
    arrow = np.array([(0.0, 0), (2, 2), (0, 1), (-2, 2)])  # pointing down, hollow above
    assert polygon(np.array([0.0]), np.array([1.5]), arrow)[0] > 0
    assert polygon(np.array([0.0]), np.array([0.5]), arrow)[0] < 0


def test_a_bent_line_turns_by_its_angle_and_keeps_its_length():
    points = bent(5.0, 1.2, num=201)
    steps = np.diff(points, axis=0)
    assert np.hypot(*steps.T).sum() == pytest.approx(10, rel=1e-3)
    ends = np.arctan2(steps[[0, -1], 1], steps[[0, -1], 0])
    assert ends[1] - ends[0] == pytest.approx(1.2, abs=0.02)
    parallel = bent(5.0, 1.2, 1.0, num=201)
    assert curve(*parallel.T, points) == pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize("kind", TRIANGLES)
def test_triangles_have_the_angles_of_their_kind(kind):
    for seed in range(20):
        corners = triangle(TRIANGLES[kind](draws(seed)), 20.0)
        sides = np.roll(corners, -1, axis=0) - corners
        back = -np.roll(sides, 1, axis=0)
        cosine = (
            (sides * back).sum(1) / np.linalg.norm(sides, axis=1) / np.linalg.norm(back, axis=1)
        )
        degrees = np.degrees(np.arccos(cosine))
        area = 0.5 * abs(sides[0, 0] * sides[1, 1] - sides[0, 1] * sides[1, 0])
        assert area == pytest.approx(20)
        if kind == "obtuse":
            assert degrees.max() > 97
        if kind == "slender":
            assert degrees.min() < 31


def test_dense_dots_are_dozens_less_than_two_mm_apart():
    counts = []
    for seed in range(10):
        surface = DOTS[Shape.DOTS]["dots_thrown_dense"](draws(seed))
        elements = surface.elements(U, V)
        numbers = np.unique(elements[elements >= 0])
        centres = np.array([(U[elements == n].mean(), V[elements == n].mean()) for n in numbers])
        apart = np.hypot(*(centres[:, None] - centres).transpose(2, 0, 1))
        apart[np.diag_indices(len(apart))] = np.inf
        assert np.median(apart.min(axis=1)) < 2.1
        counts.append(len(numbers))
    assert np.median(counts) > 24


def test_longish_dots_are_longer_than_wide():
    surface = DOTS[Shape.DOTS]["dots_longish"](draws(4))
    elements = surface.elements(U, V)
    ratios = []
    for number in np.unique(elements[elements >= 0]):
        spread = np.linalg.eigvalsh(np.cov(U[elements == number], V[elements == number]))
        ratios.append(np.sqrt(spread[1] / spread[0]))
    assert np.median(ratios) > 1.2


def test_a_rim_is_flat_within_its_width_and_ends_at_the_outline():
    round_edge, chamfer = Rim(width_mm=0.4), Rim(width_mm=0.4, slope=1.0, wall=2.0)
    distance = np.array([-1.0, -0.4, -1e-9, 0.5])
    np.testing.assert_allclose(round_edge.behind(distance), [0, 0, 0.4, NO_BODY_MM], atol=1e-3)
    np.testing.assert_allclose(chamfer.behind(distance), [0, 0, 0.4, 1.4], atol=1e-3)


@pytest.mark.parametrize("shape", DRAWN)
def test_a_scan_follows_its_surface_but_not_exactly(shape):
    surface = next(iter(DRAWN[shape].values()))(draws(3))
    scan = scanned(surface, draws(5), (-4.0, 4.0, -4.0, 4.0))
    axis = np.linspace(-2, 2, 41)
    u, v = np.meshgrid(axis, axis)
    bare, seen = surface.behind_mm(u, v), scan.behind_mm(u, v)
    near = (bare < 0.6) & (seen < 1.5)
    off = (seen - bare)[near]
    assert np.median(np.abs(off - np.median(off))) > 1e-4
    if surface.can_be_textured:
        assert np.median(np.abs(off)) < 0.1
    else:  # a worn tip or bar is lower as a whole, but where it was
        row, column = np.unravel_index(seen.argmin(), seen.shape)
        assert bare[max(row - 2, 0) : row + 3, max(column - 2, 0) : column + 3].min() < 0.25
