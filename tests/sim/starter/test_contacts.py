"""Contacts for data sets: labels by hand, determinism, and what must hold for each of them."""

import dataclasses
import itertools

import numpy as np
import pytest
import torch

from cltp.data.contact import Split
from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import Area, Depth, Position, Shape, Side, Texture, area_word, depth_word
from sim.grasp.rig import BENCHMARK_SEED
from sim.starter import series
from sim.starter.contacts import DEEPEST_MM, GROUP_CONTACTS, GROUP_SERIES, make_group, split_of
from sim.starter.series import BODY_FORCE_N, COLUMNS, ROWS, draw_series, num_loads
from sim.tcl3d.labels import in_contact, label

MINI = sensor_named("gelsight_mini")
PITCH = MINI.width_mm / COLUMNS
pytestmark = pytest.mark.usefixtures("one_thread")


@pytest.fixture(scope="module")
def contacts():
    return make_group(3, 0, MINI)


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


def test_a_group_holds_its_series_in_order_with_rising_depth_and_force(contacts):
    assert len(contacts) == GROUP_CONTACTS
    numbers = [contact.series for contact in contacts]
    assert numbers == [n for n in range(GROUP_SERIES) for _ in range(num_loads(n))]
    for before, after in itertools.pairwise(contacts):
        if before.series == after.series:
            assert after.state.depth_mm >= before.state.depth_mm - 1e-3
            assert after.state.force_n > before.state.force_n
            assert after.split is before.split
            assert after.object == before.object


def test_labels_agree_with_the_heights_and_forces_that_were_asked_for(contacts):
    by_series = {}
    for contact in contacts:
        by_series.setdefault(contact.series, []).append(contact)
    kinds = set()
    for number, members in by_series.items():
        series = draw_series(3, number, MINI)
        for contact, load in zip(members, series.loads, strict=True):
            state = contact.state
            assert state.depth_mm == pytest.approx(contact.height_mm.max(), abs=1e-6)
            assert state.depth_mm < DEEPEST_MM * 1.01
            assert state.depth is depth_word(state.depth_mm)
            assert state.area is area_word(state.area_fraction)
            assert 0 < state.area_fraction <= 1
            if series.modulus_mpa is None:
                kinds.add("rigid")
                assert state.depth_mm == pytest.approx(load, abs=0.005)
            elif state.depth_mm < DEEPEST_MM * 0.9:
                kinds.add("soft")
                assert state.force_n == pytest.approx(load, rel=1e-3)
    assert kinds == {"rigid", "soft"}


def test_a_group_is_made_again_bit_for_bit_and_differs_from_others(contacts):
    again = make_group(3, 0, MINI)
    for one, two in zip(contacts, again, strict=True):
        assert np.array_equal(one.height_mm, two.height_mm)
        assert one.state == two.state
    other = make_group(4, 0, MINI)
    assert [c.object for c in other] != [c.object for c in contacts]


def test_series_cover_all_shapes_textures_and_objects(monkeypatch):
    # Achenes are slow to draw and change nothing here.
    monkeypatch.setattr("sim.grasp.bodies._achenes", lambda rng, length: None)
    series = [draw_series(0, number, MINI) for number in range(600)]
    assert {each.shape for each in series} == set(Shape)
    assert {each.texture for each in series} == set(Texture)
    assert set(BODY_FORCE_N) < {each.object for each in series}
    bodies = [each for each in series if each.object in BODY_FORCE_N]
    assert 0.45 < len(bodies) / len(series) < 0.65
    for each in series:
        assert each.gap_mm.min() == 0
        assert list(each.loads) == sorted(each.loads)
    for each in bodies:
        limits = BODY_FORCE_N[each.object]
        assert limits.low <= each.loads[0] <= each.loads[-1] <= limits.high


def test_a_plane_covers_most_of_the_field_and_shows_where_it_ends(monkeypatch):
    monkeypatch.setattr("sim.starter.series.BODY_FRACTION", 0.0)
    planes = [
        series
        for series in (draw_series(0, number, MINI) for number in range(200))
        if series.shape is Shape.PLANE
    ]
    assert len(planes) > 3
    for plane in planes:
        assert 0.8 < (plane.gap_mm < 1).mean() < 0.98


def test_splits_have_their_shares():
    splits = [split_of(0, number) for number in range(4000)]
    assert splits.count(Split.TRAIN) / 4000 == pytest.approx(0.90, abs=0.015)
    assert splits.count(Split.VALIDATION) / 4000 == pytest.approx(0.04, abs=0.012)
    assert splits.count(Split.TEST) / 4000 == pytest.approx(0.06, abs=0.012)


@pytest.mark.parametrize(("seed", "group"), [(BENCHMARK_SEED, 0), (-1, 0), (0, -1)])
def test_seeds_of_the_benchmark_are_refused(seed, group):
    with pytest.raises(ValueError, match="seeds 0 to 999999"):
        make_group(seed, group, MINI)


def test_a_deeper_press_is_made_lighter_until_the_gel_can_bear_it(monkeypatch):
    import sim.starter.contacts as made

    def harder(seed, number, sensor):
        series = draw_series(seed, number, sensor)
        factor = 1 if series.modulus_mpa is None else 30
        return dataclasses.replace(series, loads=tuple(factor * load for load in series.loads))

    monkeypatch.setattr(made, "draw_series", harder)
    depths = [contact.state.depth_mm for contact in make_group(3, 0, MINI)]
    assert 0.9 * DEEPEST_MM < max(depths) < 1.05 * DEEPEST_MM


def test_some_bodies_lie_as_a_sensor_mounted_a_quarter_turn_meets_them(monkeypatch):
    lying = []
    monkeypatch.setattr(series, "turned", lambda body: lying.append(body) or body)
    for number in range(80):
        series._body_series(number, np.random.default_rng(number), MINI)
    assert len(lying) == pytest.approx(80 * series.TURNED_FRACTION, abs=12)
