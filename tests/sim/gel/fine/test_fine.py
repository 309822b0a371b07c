"""Presses at full resolution, made the short way, are those of the whole grid."""

import math

import pytest
import torch

from sim.gel.fine import fine
from sim.gel.fine.fine import FineLayer
from sim.gel.fine.levels import Box, GridLevel, boxes_around
from sim.gel.gap import NO_BODY_MM
from sim.gel.layer import ElasticLayer, GelMaterial, gel_of

MINI = gel_of("gelsight_mini")
ROWS, COLUMNS, PITCH = 120, 160, 0.1268


def axes(rows=ROWS, columns=COLUMNS, pitch=PITCH):
    y = (torch.arange(rows, dtype=torch.float64) - (rows - 1) / 2) * pitch
    x = (torch.arange(columns, dtype=torch.float64) - (columns - 1) / 2) * pitch
    return y[:, None], x[None, :]


def ball(radius, at_x=0.0, at_y=0.0):
    y, x = axes()
    r = torch.hypot(y - at_y, x - at_x)
    gap = radius - (radius**2 - r**2).clamp(min=0).sqrt()
    gap = torch.where(r < radius, gap, torch.inf)
    return (gap - gap.min())[None]


def block(half_x, half_y):
    y, x = axes()
    covered = (x.abs() < half_x) & (y.abs() < half_y)
    return torch.where(covered, 0.01 * (x + 0.5 * y + 1.5 * half_x), torch.inf)[None]


def layers(**options):
    options = {"rows": ROWS, "columns": COLUMNS, "pitch_mm": PITCH} | options
    whole = ElasticLayer(MINI, **options)
    return FineLayer(whole), whole


def test_rigid_bodies_are_felt_as_on_the_whole_grid():
    gap = torch.cat([ball(3.155), ball(9.0, 5.0, -4.0), block(2.0, 1.3), ball(80.0)])
    gap[2] -= gap[2].min()
    depth = torch.tensor([0.8, 0.5, 0.4, 0.3])
    short, whole = layers()
    fine_press, truth = short.press_to_depth(gap, depth), whole.press_to_depth(gap, depth, tol=1e-6)
    assert fine_press.converged.all()
    error = (fine_press.height_mm - truth.height_mm).abs()
    assert error.max() < 4e-3
    assert error.square().mean((1, 2)).sqrt().max() < 3e-4
    assert torch.allclose(fine_press.force_n, truth.force_n, rtol=2e-3)
    area, reference = ((p.pressure_kpa > 0).float().mean((1, 2)) for p in (fine_press, truth))
    assert torch.allclose(area, reference, atol=4e-3)  # a nearly flat ball has a long faint rim


def test_soft_bodies_are_felt_as_on_the_whole_grid():
    modulus = torch.tensor([0.23, 0.6])
    gap = torch.cat([ball(15.0), ball(6.0, 3.0, 2.0)])
    depth = torch.tensor([0.9, 0.7])
    short, whole = layers(body_modulus_mpa=modulus)
    fine_press, truth = short.press_to_depth(gap, depth), whole.press_to_depth(gap, depth, tol=1e-6)
    assert torch.allclose(fine_press.force_n, truth.force_n, rtol=2e-3)
    assert torch.equal(fine_press.depth_mm, depth)
    error = (fine_press.height_mm - truth.height_mm).abs()
    assert error.max() < 4e-3
    assert error.square().mean((1, 2)).sqrt().max() < 5e-4


def test_where_a_rigid_body_touches_the_surface_is_the_body_s():
    gap = ball(4.0)
    press = layers()[0].press_to_depth(gap, 0.7)
    touching = press.pressure_kpa > 0
    assert torch.allclose(press.height_mm[touching], (0.7 - gap[touching]).float(), atol=2e-6)
    assert (press.height_mm[~touching] + gap[~touching] >= 0.7 - 2e-6).all()


def test_a_contact_is_the_same_bit_for_bit_in_any_company():
    gap = torch.cat([ball(3.0), ball(9.0, 4.0, 1.0), ball(30.0, -2.0)])
    depth = torch.tensor([0.5, 0.3, 0.7])
    batch = layers()[0].press_to_depth(gap, depth)
    for k in range(3):
        single = layers()[0].press_to_depth(gap[k : k + 1], depth[k : k + 1])
        assert torch.equal(single.height_mm[0], batch.height_mm[k])
        assert torch.equal(single.pressure_kpa[0], batch.pressure_kpa[k])


@pytest.mark.parametrize("modulus", [None, torch.tensor([0.23, 0.6, 0.4])])
def test_boxes_of_one_size_solved_together_give_what_each_gives_alone(modulus):
    gap = torch.cat([ball(15.0), ball(6.0, 3.0, 2.0), ball(9.0, -2.0)])
    depth, start = torch.tensor([0.5, 0.4, 0.3]), torch.zeros_like(gap)
    boxes = [Box(top=20, left=20, rows=80, columns=120)] * 2
    boxes.append(Box(top=0, left=0, rows=ROWS, columns=COLUMNS))
    level = GridLevel(layer=layers()[1], moduli_mpa=modulus)
    gap, start = gap.clamp(max=50.0).float(), start.float()
    single = level._solve_single(boxes, gap, depth, start)
    batches = level._solve_batches(boxes, gap, depth, start)
    assert batches.converged.all()
    assert torch.equal(batches.approach_mm, depth)
    forces = [p.pressure_mpa.sum((1, 2)) for p in (single, batches)]
    assert torch.allclose(*forces, rtol=2e-3)


def test_a_contact_that_leaves_its_box_is_solved_on_the_whole_field(monkeypatch):
    small = Box(top=44, left=64, rows=32, columns=32)  # 4 mm, where the larger ball touches 6 mm
    monkeypatch.setattr(fine, "boxes_around", lambda contact: [small] * len(contact))
    gap = torch.cat([ball(9.0), ball(3.0)])
    press = layers()[0].press_to_depth(gap, torch.tensor([0.6, 0.4]))
    monkeypatch.undo()
    assert (press.pressure_kpa[0, :44] > 0).any()
    proper = layers()[0].press_to_depth(gap, torch.tensor([0.6, 0.4]))
    assert torch.allclose(press.height_mm, proper.height_mm, atol=3e-3)


def test_a_body_thinner_than_a_coarse_element_is_not_lost():
    y, x = axes()
    pin = torch.where((y.abs() < 0.07) & (x.abs() < 0.07), 0.0, torch.inf)[None]
    press = layers()[0].press_to_depth(pin, 0.2)
    assert press.force_n.item() > 0
    assert press.height_mm.max().item() == pytest.approx(0.2, abs=1e-6)


def test_a_coarser_gap_is_the_mean_of_where_a_body_is():
    none = NO_BODY_MM
    gap = torch.tensor([[1.0, 2.0, 1.0, none], [3.0, 6.0, none, none], [none, none, 0.0, 0.5]])
    gap = torch.cat([gap, torch.tensor([[none, none, 1.0, 1.5]])])[None]
    assert fine._coarser(gap).tolist() == [[[3.0, 1.0], [none, 0.75]]]


def test_a_body_that_barely_touches_or_does_not_is_pressed_as_it_is():
    gap = torch.cat([ball(3.0), ball(3.0)])
    press = layers()[0].press_to_depth(gap, torch.tensor([0.002, -0.5]))
    assert press.force_n[0].item() > 0
    assert press.force_n[1].item() == 0
    assert (press.height_mm[1] == 0).all()


def test_nothing_over_the_field_carries_no_force():
    press = layers()[0].press_to_depth(torch.full((1, ROWS, COLUMNS), torch.inf), 1.0)
    assert press.force_n.item() == 0
    assert (press.height_mm == 0).all()


def test_grids_that_can_t_be_halved_are_solved_whole():
    y, x = axes(51, 61, 0.2)
    gap = ((x**2 + y**2) / 10.0)[None]
    whole = ElasticLayer(MINI, rows=51, columns=61, pitch_mm=0.2)
    fine_press = FineLayer(whole).press_to_depth(gap, 0.3)
    truth = whole.press_to_depth(gap, 0.3, tol=fine.TOLERANCE)
    assert torch.equal(fine_press.height_mm, truth.height_mm)


def test_bad_input_is_refused_by_name():
    with pytest.raises(ValueError, match="depth_mm"):
        layers()[0].press_to_depth(ball(3.0), math.nan)
    with pytest.raises(ValueError, match="gap_mm"):
        layers()[0].press_to_depth(torch.zeros(1, 5, 5), 0.1)
    with pytest.raises(ValueError, match="body_modulus_mpa"):
        layers(body_modulus_mpa=-1.0)
    with pytest.raises(ValueError, match="2 bodies"):
        layers(body_modulus_mpa=torch.tensor([0.1, 0.2]))[0].press_to_depth(ball(3.0), 0.1)


@pytest.mark.gpu
def test_an_accelerator_finds_the_same_heights():
    gap = torch.cat([ball(3.155), ball(9.0, 5.0, -4.0), ball(80.0)])
    depth = torch.tensor([0.8, 0.5, 0.3])
    on_cpu = layers()[0].press_to_depth(gap, depth)
    covered = layers(device="cuda")[0].press_to_depth(gap.cuda(), depth.cuda())
    assert (on_cpu.height_mm - covered.height_mm.cpu()).abs().max() < 3e-3


def test_a_thick_gel_is_pressed_too():
    thick = GelMaterial(thickness_mm=math.inf, young_mpa=0.2, poisson=0.4)
    whole = ElasticLayer(thick, rows=ROWS, columns=COLUMNS, pitch_mm=PITCH)
    fine_press, truth = (gel.press_to_depth(ball(5.0), 0.4) for gel in (FineLayer(whole), whole))
    assert fine_press.force_n.item() == pytest.approx(truth.force_n.item(), rel=2e-3)


def test_one_body_at_several_depths_is_pressed_as_so_many_bodies():
    gap, depth = ball(4.0), torch.tensor([0.2, 0.6])
    expanded = layers()[0].press_to_depth(gap.expand(2, -1, -1), depth)
    repeated = layers()[0].press_to_depth(gap.repeat(2, 1, 1), depth)
    assert torch.equal(expanded.height_mm, repeated.height_mm)
    assert torch.equal(expanded.pressure_kpa, repeated.pressure_kpa)


def test_what_lies_behind_a_thin_body_does_not_keep_it_off_on_the_coarser_grids(monkeypatch):
    y, _ = axes()
    bar = torch.where(y.abs() < 1.5 * PITCH, 0.0, 50.0).expand(1, ROWS, COLUMNS)
    boxes = []

    def record_contact(contact):
        boxes.append(contact)
        return boxes_around(contact)

    monkeypatch.setattr(fine, "boxes_around", record_contact)
    layers()[0].press_to_depth(bar, 0.3)
    assert all(contact.any() for contact in boxes)
