"""Distances of solids: closed forms, and no step of a ray that could jump over a surface."""

import math

import pytest
import torch

from cltp.tactile.states import Shape
from sim.objects.catalogue import CATALOGUE, LARGE, SMALL, object_named
from sim.objects.compounds import along, moved
from sim.objects.faces import Form
from sim.objects.primitives import ball, bars, box, on_corner, polygon, prism, pyramid, rod
from sim.objects.solids import Hoop


def at(*point):
    return torch.tensor([point], dtype=torch.float64)


@pytest.mark.parametrize(
    ("solid", "point", "expected"),
    [
        (ball(10), (0, 0, 8), 3),
        (box(20, 10, 6, 0.5), (0, 0, 5), 2),
        (box(20, 10, 6, 0.5), (0, 0, 0), -3),
        # the corner of a rounded box is a ball
        (box(20, 10, 6, 0.5), (13, 8, 6), math.hypot(3.5, 3.5, 3.5) - 0.5),
        (rod(8, 20), (0, 0, 3), 3),
        (rod(8, 20), (9, 0, -10), 5),
        (along("x", rod(8, 20)), (3, 0, 0), 3),
        (moved(ball(4), 1, 2, 3), (1, 2, 8), 3),
        (Hoop(5, 1), (9, 0, 0), 3),
        (Hoop(5, 1, math.pi / 2), (-5, 0, 0), math.hypot(5, 5) - 1),
        (bars([(-3, 0, 3, 0)], 1.0), (0, 0, 2), 2),
    ],
)
def test_distances_are_those_of_closed_forms(solid, point, expected):
    assert float(solid.distance(at(*point))) == pytest.approx(expected, abs=1e-9)


def test_a_cube_on_its_corner_reaches_half_its_diagonal_less_the_fillet():
    solid = on_corner(9.0, 0.3)
    tip = 4.5 * math.sqrt(3) - 0.3 * (math.sqrt(3) - 1)
    assert float(solid.distance(at(0, 0, tip))) == pytest.approx(0, abs=1e-6)


def test_cells_are_the_faces_that_are_nearest():
    solid = prism(polygon(6, 10), 20, Shape.HEXAGON)
    assert solid.cells[int(solid.cell(at(0, 0, 0.1)))].outline is Shape.HEXAGON
    side = solid.cells[int(solid.cell(at(6, 0.1, -10)))]
    assert side.form is Form.FLAT
    assert side.outline is None


@pytest.mark.parametrize("obj", CATALOGUE, ids=lambda obj: obj.name)
def test_no_distance_grows_faster_than_it_says(obj):
    draw = torch.Generator().manual_seed(3)
    reach = min(1.4 * obj.reach_mm, 80)
    points = (2 * torch.rand(1500, 3, generator=draw, dtype=torch.float64) - 1) * reach
    outside = points + 0.02 * torch.randn(1500, 3, generator=draw, dtype=torch.float64)
    away = obj.distance(points)
    growth = (away - obj.distance(outside)).abs() / (points - outside).norm(dim=1)
    assert float(growth[away > 0].max()) < 1.05 * obj.max_slope


def test_a_pyramid_is_not_thought_further_away_than_it_is():
    solid = pyramid(6, 52, 14)
    assert 0 < float(solid.distance(at(0, 0, 25))) < 25.2  # its blunt tip lies a little below 0


def test_there_are_55_small_objects_and_62_large_ones():
    assert (len(SMALL), len(LARGE)) == (55, 62)
    assert all(obj.is_small for obj in SMALL)
    assert not any(obj.is_small for obj in LARGE)
    with pytest.raises(ValueError, match="unknown object 'teapot'"):
        object_named("teapot")


@pytest.mark.parametrize(
    "solid",
    [moved(box(7.3, 4.1, 2.7, 0.3), 0.1, 0.2, 0.3), bars([(-3.1, 0.7, 3.3, 0)], 0.9)],
    ids=["planes", "rods"],
)
def test_numbers_kept_for_rays_are_kept_for_each_precision(solid):
    points = torch.randn(40, 3, generator=torch.Generator().manual_seed(1), dtype=torch.float64)
    with torch.inference_mode():
        coarse = solid.distance(points.float())
    fine = solid.distance(points)
    assert coarse.dtype == torch.float32
    assert fine.dtype == torch.float64
    assert (fine - coarse).abs().max() < 1e-5
    as_grid = solid.distance(points.view(5, 8, 3))
    assert torch.equal(as_grid.flatten(), fine)
    assert torch.equal(solid.distance(points.float()), coarse)  # not changed by use
