"""Measures of masks: quicker ways give what looking at every point gives."""

import math

import numpy as np
import pytest
import torch
from scipy.ndimage import maximum_filter, minimum_filter

from sim.objects.faces import Cell, Form
from sim.tcl3d.contact_geometry import (
    ContactGeometry,
    border_fraction,
    bounding_rectangle,
    count_enclosed_points,
    count_pieces,
    slopes,
)
from sim.tcl3d.labels import CLOSING_MM, in_contact

PITCH = 0.2


def scattered(fraction, seed, rows=37, columns=52):
    return np.random.default_rng(seed).random((rows, columns)) < fraction


@pytest.mark.parametrize("seed", range(20))
def test_a_rectangle_about_the_ends_of_rows_is_that_about_every_point(seed):
    mask = scattered(0.02, seed)
    row, column = np.nonzero(mask)
    sides = []
    for degrees in range(0, 90, 5):
        cos, sin = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        u, v = column * cos - row * sin, column * sin + row * cos
        sides.append(((np.ptp(u) + 1) * PITCH, (np.ptp(v) + 1) * PITCH))
    best = min(range(18), key=lambda i: sides[i][0] * sides[i][1])
    rectangle = bounding_rectangle(mask, PITCH)
    assert (rectangle.length, rectangle.width) == (max(sides[best]), min(sides[best]))
    turn = 5 * best + (0 if sides[best][0] >= sides[best][1] else 90)
    assert rectangle.angle == math.radians(turn)


def test_a_bar_that_leans_has_its_own_length_width_and_direction():
    x, y = np.meshgrid(np.arange(80), np.arange(60))
    along = (x - 40) * math.cos(0.5236) - (y - 30) * math.sin(0.5236)
    across = (x - 40) * math.sin(0.5236) + (y - 30) * math.cos(0.5236)
    rectangle = bounding_rectangle((abs(along) <= 20) & (abs(across) <= 4), 1.0)
    assert rectangle.length == pytest.approx(41, abs=1)
    assert rectangle.width == pytest.approx(9, abs=1)
    assert rectangle.angle == pytest.approx(math.pi / 6)


@pytest.mark.parametrize("point", [(0, 0), (36, 51), (0, 20), (17, 51), (18, 25)])
def test_slopes_at_a_mask_are_those_of_the_whole_field(point):
    gap = np.random.default_rng(1).random((37, 52))
    down, right = np.gradient(gap, PITCH)
    one, some = np.zeros(gap.shape, dtype=bool), np.zeros(gap.shape, dtype=bool)
    one[point] = True
    some[max(point[0] - 3, 0) : point[0] + 3, max(point[1] - 5, 0) : point[1] + 2] = True
    for mask in (one, some & scattered(0.5, 2) | one):
        result = slopes(gap, mask, PITCH)
        assert np.array_equal(result[0], down[mask])
        assert np.array_equal(result[1], right[mask])


def test_nowhere_there_are_no_slopes():
    down, right = slopes(np.zeros((5, 6)), np.zeros((5, 6), dtype=bool), PITCH)
    assert len(down) == len(right) == 0


def test_crumbs_are_no_pieces():
    mask = np.zeros((40, 40), dtype=bool)
    mask[2:12, 2:12] = True
    assert count_pieces(mask) == 1
    mask[30:34, 30:34] = True  # 16 % of the larger one
    assert count_pieces(mask) == 2
    mask[30:34, 20:23] = True  # exactly 12 %
    assert count_pieces(mask) == 2


def test_a_hole_is_enclosed_and_a_bay_is_not():
    mask = np.zeros((20, 20), dtype=bool)
    mask[2:12, 2:12] = True
    mask[4:7, 4:8] = False
    mask[10:12, 9:11] = False
    assert count_enclosed_points(mask) == 12


def test_half_of_what_lies_at_the_border_is_cut():
    mask = np.zeros((20, 20), dtype=bool)
    mask[:4, 5:9] = True
    assert border_fraction(mask) == 4 / (4 + 0.8 * 12)


@pytest.mark.parametrize("pitch", [0.05, 0.2])
def test_closing_is_the_largest_and_then_the_smallest_within_a_square(pitch):
    size = 2 * round(CLOSING_MM / pitch / 2) + 1
    loads = np.stack([scattered(fraction, 3, 60, 90) for fraction in (0.002, 0.02, 0.1)])
    for load, closed in zip(loads, in_contact(torch.from_numpy(loads).float(), pitch), strict=True):
        wide = np.pad(load, 2 * size, mode="edge")
        expected = minimum_filter(maximum_filter(wide, size), size)
        assert np.array_equal(closed, expected[2 * size : -2 * size, 2 * size : -2 * size])


def test_a_touch_counts_the_points_of_its_cells_and_not_those_of_none():
    cells = np.array([[0, 0, 2], [-1, 2, 2]])
    touching = np.array([[True, False, True], [True, True, False]])
    contact = ContactGeometry(
        gap_mm=np.zeros((2, 3)),
        cells=cells,
        cell_table=(Cell(form=Form.FLAT),) * 4,
        touching=touching,
        closed=touching,
        depth_mm=0.1,
        pitch_mm=PITCH,
    )
    assert contact.counts.tolist() == [1, 0, 2, 0]
    assert contact.count_cells(~touching).tolist() == [1, 0, 1, 0]
