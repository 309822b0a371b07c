"""Friction of a patch against closed forms, and what the pad's edge does to a patch."""

import dataclasses

import numpy as np
import pytest
import torch

from cltp.processor import torch_threads
from cltp.tactile.sensors import SENSORS, sensor_named
from sim.gel import contact_solver, layer
from sim.gel.layer import gel_of
from sim.grasp.bodies import draw_body
from sim.grasp.fingers import GRAVITY_M_S2, FlatFingers, Patch, grid_of

SENSOR = sensor_named("gelsight_mini")
ROWS, COLUMNS = grid_of(SENSOR)
PITCH_MM = SENSOR.width_mm / COLUMNS


def fingers(**changes: object) -> FlatFingers:
    body = draw_body("cherry_tomato", np.random.default_rng(3))
    body = dataclasses.replace(body, com_mm=(0.0, 0.0), friction=0.5, mass_kg=0.02, **changes)
    return FlatFingers(body, SENSOR, gel_of("gelsight_mini"))


def flat_patch(blocks: list[tuple[int, int]], force_n: float) -> Patch:
    """A patch that carries its force, evenly, in 2 × 2 elements at the given rows and columns."""
    pressure = np.zeros((ROWS, COLUMNS))
    for row, column in blocks:
        pressure[row : row + 2, column : column + 2] = 1.0
    pressure *= force_n / (pressure.sum() * PITCH_MM**2 * 1e-3)
    return Patch(
        force_n=force_n,
        offset_mm=(0.0, 0.0),
        height_mm=np.zeros((ROWS, COLUMNS)),
        pressure_kpa=pressure,
        peak_kpa=float(pressure.max()),
        depth_mm=0.0,
    )


def test_friction_of_both_patches_holds_two_mu_times_the_force():
    resistance = fingers()
    patch = resistance.press((0.0, 0.0), 1.0)
    closed_form = 2 * 0.5 * 1.0 / (0.02 * (GRAVITY_M_S2 + 2.5))
    margin = resistance.resistance(patch, (0.0, 2.5)).margin
    assert margin == pytest.approx(closed_form, rel=0.02)


def test_a_load_aside_adds_to_the_weight_as_a_vector():
    resistance = fingers()
    patch = resistance.press((0.0, 0.0), 1.0)
    closed_form = 2 * 0.5 / (0.02 * np.hypot(GRAVITY_M_S2, 6.0))
    assert resistance.resistance(patch, (6.0, 0.0)).margin == pytest.approx(closed_form, rel=0.02)


def test_a_weight_beside_two_points_is_held_by_the_lever_rule():
    # points at ±r, weight at x = d > r: the nearer point carries W (d + r) / 2r of it
    resistance = fingers()
    centre_row, slid, right = ROWS // 2, 20, 58
    patch = flat_patch([(centre_row, slid), (centre_row, right)], force_n=1.0)
    r = (right - slid) / 2 * PITCH_MM
    middle = ((slid + right) / 2 + 1 - COLUMNS / 2) * PITCH_MM
    y = (ROWS / 2 - centre_row - 1) * PITCH_MM
    d = 1.5 * r
    resistance.body = dataclasses.replace(resistance.body, com_mm=(middle + d, y))
    half_weight = 0.01 * GRAVITY_M_S2
    closed_form = 0.5 * 1.0 / 2 / (half_weight * (d + r) / (2 * r))
    assert resistance.resistance(patch, (0.0, 0.0)).margin == pytest.approx(closed_form, rel=0.03)


def test_a_whole_patch_is_not_pushed_and_a_cut_one_is_pushed_over_the_edge():
    resistance = fingers()
    whole, cut = resistance.press_many([(0.0, 0.0), (9.5, 0.0)], [1.0, 1.0])
    assert abs(resistance._friction_of(whole).push[0]) < 0.01
    assert resistance._friction_of(cut).push[0] > 0.01


def test_a_patch_cut_by_the_edge_carries_all_of_the_force_at_a_higher_pressure():
    resistance = fingers()
    whole, cut = resistance.press_many([(0.0, 0.0), (9.5, 7.0)], [1.0, 1.0])
    for patch in (whole, cut):
        force = patch.pressure_kpa.sum() * 1e-3 * PITCH_MM**2
        assert force == pytest.approx(1.0, rel=1e-3)
    assert cut.peak_kpa > 1.3 * whole.peak_kpa


def test_the_slip_minimum_is_the_force_at_which_the_margin_is_one():
    resistance = fingers()
    accelerations = [(0.0, 2.5), (6.0, 0.0)]
    minimum = resistance.slip_minimum_n(accelerations)
    patch = resistance.press((0.0, 0.0), minimum)
    margin = min(resistance.resistance(patch, each).margin for each in accelerations)
    assert margin == pytest.approx(1.0, rel=0.03)


def test_the_bruise_force_makes_the_bruise_pressure_at_the_centre():
    resistance = fingers()
    patch = resistance.press((0.0, 0.0), resistance.body.bruise_n)
    assert patch.peak_kpa == pytest.approx(resistance.bruise_kpa)


def test_a_press_keeps_to_one_thread_whatever_the_process_uses(monkeypatch):
    tomato, threads = fingers(), []
    solve = contact_solver.solve
    monkeypatch.setattr(
        layer, "solve", lambda *a, **k: threads.append(torch.get_num_threads()) or solve(*a, **k)
    )
    with torch_threads(2):
        tomato.press((0.0, 0.0), 0.5)
        assert torch.get_num_threads() == 2
    assert threads == [1]


def test_fingers_beside_the_body_do_not_reach_it():
    resistance = fingers()
    assert resistance.reaches((0.0, 0.0))
    assert not resistance.reaches((40.0, 0.0))


@pytest.mark.parametrize("name", sorted(SENSORS))
def test_elements_of_the_grid_are_square_on_every_pad(name):
    sensor = SENSORS[name]
    rows, columns = grid_of(sensor)
    assert sensor.height_mm / rows == pytest.approx(sensor.width_mm / columns, rel=0.02)


def test_beside_a_body_wider_than_any_gap_there_is_nothing_to_reach():
    body = draw_body("cherry_tomato", np.random.default_rng(3))
    wide = dataclasses.replace(body, thickness_mm=104.0)
    fingers = FlatFingers(wide, sensor_named("gelsight_mini"), gel_of("gelsight_mini"))
    assert fingers.reaches((0.0, 0.0))
    assert not fingers.reaches((200.0, 0.0))
