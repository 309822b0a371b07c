"""What a contact is called follows from what touches: the same object has several names."""

import math

import numpy as np
import pytest
import torch

from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.sensors import SENSORS
from cltp.tactile.states import Shape, Texture
from sim.objects.compounds import along, moved
from sim.objects.object import Family, Part, SolidObject
from sim.objects.primitives import (
    ball,
    block,
    box,
    bumps,
    cone,
    crossing,
    flat_bar,
    lattice,
    oval,
    parallel,
    polygon,
    prism,
    pyramid,
    rod,
    tube,
    waves,
)
from sim.objects.ray_casting import cast_pad_rays, frame_at
from sim.objects.solids import Hoop
from sim.tcl3d.contact_geometry import ContactGeometry
from sim.tcl3d.shape_labels import name_shape

GEL = SENSORS["gelsight_mini"]
X, Y = np.meshgrid(*grid_axes_mm(GEL, 75, 100))
PITCH = GEL.width_mm / 100


def thing_of(*solids):
    return SolidObject("it", Family.PEG, "", tuple(Part(solid) for solid in solids))


def named(solids, point, towards=(0, 0, 1), depth_mm=0.5):
    """Name of what touches when as much of a thing touches as geometry alone would have."""
    obj = thing_of(*solids) if isinstance(solids, tuple) else thing_of(solids)
    normal = np.array(towards, dtype=float)
    normal /= np.linalg.norm(normal)
    view = cast_pad_rays(obj, frame_at(normal), np.array(point, dtype=float), X, Y)
    assert view is not None
    cells = np.full(X.shape, -1)
    covered = view.gap_mm < 40
    cells[covered] = obj.cell(torch.from_numpy(view.points[covered])).numpy()
    touching = view.gap_mm < 0.6 * depth_mm
    return name_shape(
        ContactGeometry(
            gap_mm=view.gap_mm,
            cells=cells,
            cell_table=obj.cells,
            touching=touching,
            closed=touching,
            depth_mm=depth_mm,
            pitch_mm=PITCH,
        )
    )


BOX = box(60, 50, 40, 0.3)


@pytest.mark.parametrize(
    ("towards", "point", "shape"),
    [
        ((0, 0, 1), (22, 0, 20), Shape.PLANE),  # the face, its end in the field
        ((1, 0, 1), (30, 0, 20), Shape.EDGE),
        ((1, 0, 0.27), (30, 0, 20), Shape.EDGE),  # 15° from a face
        ((1, 1, 1), (30, 25, 20), Shape.CORNER),
        ((1, 0.8, 0.6), (30, 25, 20), Shape.CORNER),
    ],
)
def test_a_box_is_a_plane_an_edge_or_a_corner(towards, point, shape):
    label = named(BOX, point, towards)
    assert label.shape is shape
    assert label.sure


@pytest.mark.parametrize(
    ("towards", "point", "shape"),
    [
        ((0, 0, 1), (0, 0, 0), Shape.DISC),
        ((1, 0, 0), (4.5, 0, -15), Shape.CYLINDER),
        ((1, 0, 1), (4.5, 0, 0), Shape.EDGE),
    ],
)
def test_a_cylinder_is_a_disc_on_its_end_and_an_edge_on_its_rim(towards, point, shape):
    label = named(rod(9, 40), point, towards)
    assert label.shape is shape
    assert label.sure


@pytest.mark.parametrize(
    ("solid", "point", "shape"),
    [
        (ball(16), (0, 0, 8), Shape.SPHERE),
        (oval(40, 22, 22), (0, 0, 11), Shape.ELLIPSOID),  # curvatures 1/11 and 11/400: 3.3
        (oval(60, 22, 22), (0, 0, 11), Shape.CYLINDER),  # 7.4
        (block(8, 6, 20), (0, 0, 0), Shape.CUBOID),
        (prism(polygon(3, 8), 20, Shape.TRIANGLE), (0, 0, 0), Shape.TRIANGLE),
        (prism(polygon(6, 9), 20, Shape.HEXAGON), (0, 0, 0), Shape.HEXAGON),
        (cone(45, 14), (0, 0, 0), Shape.PEAK),
        (pyramid(4, 40, 14), (0, 0, 0), Shape.PEAK),
        (pyramid(3, 48, 14), (0, 0, 0), Shape.CORNER),
        (flat_bar(10, 1.2), (0, 0, 0), Shape.LINE),
        (crossing(9, 8, 1.2), (0, 0, 0), Shape.CROSS),
        (parallel(3, 2.6, 9, 1.1), (0, 0, 0), Shape.STRIPES),
        (parallel(1, 2.6, 9, 1.1), (0, 0, 0), Shape.LINE),
        (bumps(lattice(3, 2, 3.0), 1.5), (0, 0, 0), Shape.DOTS),
        (bumps([(0, 0)], 4.0), (0, 0, 0), Shape.SPHERE),
        (waves(14, 10, 4.0, 0.4), (0, 0, 0), Shape.WAVE),
        (tube(9, 6.6, 20), (0, 0, 0), Shape.RING),
        (tube(11, 5, 20), (0, 0, 0), Shape.HOLE),
        (Hoop(4, 0.7), (0, 0, 0.7), Shape.RING),
        (Hoop(4, 0.7, 1.5), (0, 0, 0.7), Shape.CRESCENT),
    ],
)
def test_a_shape_that_touches_in_full_is_called_by_its_name(solid, point, shape):
    label = named(solid, point)
    assert label.shape is shape
    assert label.sure


def test_half_a_ring_on_the_pad_is_a_crescent():
    assert named(Hoop(4, 0.7), (0, 7.6, 0.7)).shape is Shape.CRESCENT


def test_one_crest_of_a_wave_is_no_wave():
    assert named(waves(3.0, 10, 4.0, 0.4), (0, 0, 0)).shape is not Shape.WAVE


def test_two_of_three_dots_are_no_sure_dots():
    assert not named(bumps([(0, 0), (3, 0)], 1.5), (0, 0, 0)).sure


def test_a_ratio_of_curvatures_at_the_limit_is_not_sure():
    radius = 11.0
    limit = oval(2 * radius * math.sqrt(1.4), 2 * radius, 2 * radius)
    assert not named(limit, (0, 0, radius)).sure


def test_a_hexagon_that_the_pad_cuts_in_half_is_not_sure():
    assert not named(prism(polygon(6, 12), 20, Shape.HEXAGON), (10, 0, 0)).sure


def test_the_side_of_a_long_rod_is_a_cylinder_wherever_it_lies():
    lying = along("x", moved(rod(12, 80), z=40))
    for shift in (-5, 0, 5):
        assert named(lying, (shift, 0, 6)).shape is Shape.CYLINDER


def test_a_skin_out_of_its_class_is_refused():
    from sim.objects.skins import Skin

    with pytest.raises(ValueError, match="a ridged skin"):
        Skin(Texture.RIDGED, 0.5, 1.0)
