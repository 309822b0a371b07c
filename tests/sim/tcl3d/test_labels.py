"""Labels of solved contacts, measured by hand."""

import numpy as np
import pytest
import torch

from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import Area, Depth, Position, Shape, Side, Texture
from sim.tcl3d.labels import in_contact, label
from sim.tcl3d.series import COLUMNS, ROWS

MINI = sensor_named("gelsight_mini")
PITCH = MINI.width_mm / COLUMNS


def labelled(pressure):
    pressure = np.asarray(pressure, dtype=np.float32)
    touching = in_contact(torch.from_numpy(pressure)[None], PITCH)[0]
    return label(
        height_mm=0.01 * pressure,
        pressure_kpa=pressure,
        touching=touching,
        force_n=1.5,
        sensor=MINI,
        shape=Shape.CUBOID,
        texture=Texture.SMOOTH,
    )


def test_a_pressed_rectangle_is_labelled_as_a_ruler_would():
    pressure = np.zeros((ROWS, COLUMNS))
    pressure[5:20, 70:90] = 40.0  # 300 of 7500 cells: 4 %
    state = labelled(pressure)
    assert state.depth_mm == pytest.approx(0.4)
    assert state.depth is Depth.MODERATE
    assert state.area_fraction == pytest.approx(0.04)
    assert state.area is Area.SMALL
    assert state.x_mm == pytest.approx(30 * PITCH)  # columns 70-89: centre 80, field's 50
    assert state.y_mm == pytest.approx(25 * PITCH)  # rows 5-19: centre 12.5, field's 37.5
    assert state.position is Position.TOP_RIGHT
    assert state.cut == frozenset()
    assert (state.shape, state.texture, state.force_n) == (Shape.CUBOID, Texture.SMOOTH, 1.5)


def test_position_is_weighted_by_pressure():
    pressure = np.zeros((ROWS, COLUMNS))
    pressure[30, 20], pressure[30, 80] = 30.0, 10.0
    assert labelled(pressure).x_mm == pytest.approx((0.75 * 20 + 0.25 * 80 + 0.5 - 50) * PITCH)


def test_sides_cut_a_contact_from_three_cells_of_border_on():
    pressure = np.zeros((ROWS, COLUMNS))
    pressure[0, 40:43] = 1.0
    pressure[-1, 40:42] = 1.0
    pressure[30:40, 0] = 1.0
    assert labelled(pressure).cut == {Side.TOP, Side.LEFT}


def test_valleys_of_a_texture_are_in_contact_and_gaps_between_dots_are_not():
    ridges = torch.zeros(ROWS, COLUMNS)
    ridges[:, ::7] = 1.0  # 1.4 mm apart
    dots = torch.zeros(ROWS, COLUMNS)
    dots[10:60:10, 10:90:10] = 1.0  # 2 mm apart
    closed = in_contact(torch.stack([ridges, dots]), PITCH)
    assert closed[0][:, :99].all()  # from the first ridge to the last
    assert closed[1].sum() == dots.sum()


def test_closing_adds_nothing_at_the_border():
    block = torch.zeros(ROWS, COLUMNS)
    block[20:40, 80:] = 1.0
    assert np.array_equal(in_contact(block[None], PITCH)[0], block.numpy() > 0)
