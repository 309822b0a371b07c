"""The gel's contact against closed forms, each in the range where the form holds."""

import math

import numpy as np
import pytest
import torch

from sim.gel import layer
from sim.gel.compliance import spectrum_of
from sim.gel.gap import NO_BODY_MM
from sim.gel.layer import GEL_MATERIALS, ElasticLayer, GelMaterial, gel_of
from tests.paths import SHARED_DATA

MINI = GEL_MATERIALS["gelsight_mini"]
PROFILE = SHARED_DATA / "gelsight_mini_balls/profile_6.31mm.csv"


def radius_mm(rows, columns, pitch):
    y = (torch.arange(rows, dtype=torch.float64) - (rows - 1) / 2) * pitch
    x = (torch.arange(columns, dtype=torch.float64) - (columns - 1) / 2) * pitch
    return torch.hypot(y[:, None], x[None, :])


def ball(r, rows, columns, pitch):
    rho = radius_mm(rows, columns, pitch)
    gap = r - (r * r - rho * rho).clamp(min=0).sqrt()
    return torch.where(rho < r, gap, torch.inf)[None]


def paraboloid(r, size, pitch):
    return (radius_mm(size, size, pitch) ** 2 / (2 * r))[None]


def field(material=MINI, rows=76, columns=102, pitch=0.2, **options):
    return ElasticLayer(material, rows=rows, columns=columns, pitch_mm=pitch, **options)


def half_space(e=0.2, nu=0.4):
    return GelMaterial(thickness_mm=math.inf, young_mpa=e, poisson=nu)


# Closed forms.


def test_a_half_space_carries_a_ball_as_hertz_says():
    # F = 4/3 E* sqrt(R) d^1.5, a² = R d. Holds for a paraboloid, and a ball where a is well below
    # R; Love's kernel knows no thickness and no period. a = 1 mm on 0.05 mm elements: 20 to the
    # radius, which sets what is left of the error.
    gel = field(half_space(), 61, 61, 0.05, dtype=torch.float64)
    press = gel.press_to_depth(paraboloid(10.0, 61, 0.05), 0.1)
    e_star = 0.2 / (1 - 0.16)
    assert press.force_n.item() == pytest.approx(
        4 / 3 * e_star * math.sqrt(10) * 0.1**1.5, rel=0.01
    )
    area = (press.pressure_kpa > 0).sum().item() * 0.05**2
    assert math.sqrt(area / math.pi) == pytest.approx(1.0, rel=0.02)
    peak = 1.5 * press.force_n.item() / math.pi * 1e3
    assert press.pressure_kpa.max().item() == pytest.approx(peak, rel=0.02)


def test_force_given_and_depth_given_agree():
    gel = field(dtype=torch.float64)
    gap = ball(15.0, 76, 102, 0.2)
    by_force = gel.press_to_force(gap, 1.0, tol=1e-6)
    by_depth = gel.press_to_depth(gap, by_force.depth_mm, tol=1e-6)
    assert by_depth.force_n.item() == pytest.approx(1.0, rel=1e-4)
    assert torch.allclose(by_depth.height_mm, by_force.height_mm, atol=1e-5)


def test_a_flat_round_punch_on_a_half_space_needs_two_e_star_a_d():
    # Sneddon: F = 2 E* a d. Holds on a half-space for any depth. The edge is singular, so that the
    # radius counts to half an element: 30 elements to it.
    gap = torch.where(radius_mm(61, 61, 0.05) <= 1.5, 0.0, torch.inf)[None]
    radius = math.sqrt((gap == 0).sum().item() * 0.05**2 / math.pi)
    press = field(half_space(), 61, 61, 0.05, dtype=torch.float64).press_to_depth(gap, 0.1)
    assert press.force_n.item() == pytest.approx(2 * 0.2 / 0.84 * radius * 0.1, rel=0.02)


def test_a_long_rod_is_carried_as_a_line_contact():
    # Hertz for lines: a² = 4 F' R / (pi E*), p0 = sqrt(F' E* / (pi R)). Holds where the rod is
    # long against its width (here 40 half-widths) and far from its ends (the middle section); on a
    # half-space the force per length follows from the length, so it is taken from the solution.
    y = (torch.arange(41, dtype=torch.float64) - 20) * 0.1
    gap = (y[:, None] ** 2 / 20.0).expand(41, 401)[None]
    gel = field(half_space(), 41, 401, 0.1, dtype=torch.float64)
    section = gel.press_to_force(gap, 0.75).pressure_kpa[0, :, 200] * 1e-3
    load, e_star = section.sum().item() * 0.1, 0.2 / 0.84
    assert section.max().item() == pytest.approx(
        math.sqrt(load * e_star / (math.pi * 10)), rel=0.02
    )
    half_width = 2 * math.sqrt((section * y**2).sum().item() / section.sum().item())
    assert 0.8 < half_width < 1.6
    assert half_width == pytest.approx(math.sqrt(4 * load * 10 / (math.pi * e_star)), rel=0.02)


@pytest.mark.parametrize("chi", [0.1, 0.2, 0.3])
def test_a_bonded_incompressible_layer_is_stiffer_as_dimitriadis_says(chi):
    # Dimitriadis et al. 2002, nu = 1/2, bonded; their series holds up to about chi = 0.3.
    h, r = 3.6, 20.0
    depth = (chi * h) ** 2 / r
    gel = field(
        GelMaterial(thickness_mm=h, young_mpa=0.15, poisson=0.4999),
        81, 81, chi * h / 30, dtype=torch.float64,
    )  # fmt: skip
    press = gel.press_to_depth(paraboloid(r, 81, chi * h / 30), depth)
    hertz = 4 / 3 * 0.15 / (1 - 0.4999**2) * math.sqrt(r) * depth**1.5
    series = 1 + 1.133 * chi + 1.283 * chi**2 + 0.769 * chi**3 + 0.0975 * chi**4
    assert press.force_n.item() / hertz == pytest.approx(series, rel=0.03)


def test_an_incompressible_gel_keeps_its_volume():
    # Exact only at nu = 1/2 and on a field without end: nu 0.4999 loses 0.2 % here.
    thin = GelMaterial(thickness_mm=2.0, young_mpa=0.145, poisson=0.4999)
    gel = field(thin, 121, 121, 0.4)  # 48 mm: 12 thicknesses each way
    height = gel.press_to_force(ball(4.0, 121, 121, 0.4), 1.0).height_mm.double()
    sunk, risen = height.clamp(min=0).sum().item(), -height.clamp(max=0).sum().item()
    assert risen == pytest.approx(sunk, rel=0.01)
    assert 0.02 < -height.min().item() < 0.08


def test_a_compressible_gel_loses_the_volume_that_its_confined_stiffness_says():
    soft = GelMaterial(thickness_mm=2.0, young_mpa=0.1, poisson=0.3)
    gel = field(soft, 121, 121, 0.2, dtype=torch.float64)
    volume = gel.press_to_force(ball(4.0, 121, 121, 0.2), 0.5).height_mm.sum().item() * 0.04
    assert volume == pytest.approx(0.5 * 2.0 * 0.4 * 1.3 / (0.1 * 0.7), rel=0.01)


def test_a_soft_body_adds_its_compliance_as_hertz_says():
    e_gel, e_body = 0.2 / 0.84, torch.tensor([0.1, 0.4])
    gel = field(half_space(), 61, 61, 0.05, body_modulus_mpa=e_body)
    press = gel.press_to_depth(paraboloid(10.0, 61, 0.05).expand(2, -1, -1), 0.1)
    both = 1 / (1 / e_gel + 1 / e_body)
    assert torch.allclose(press.force_n, 4 / 3 * both * math.sqrt(10) * 0.1**1.5, rtol=0.01)
    # Gel and body share the displacement as their compliances.
    deepest = press.height_mm.amax((1, 2))
    assert torch.allclose(deepest, 0.1 * both / e_gel, rtol=0.01)


def test_the_real_ball_s_profile_is_met():
    if not PROFILE.exists():
        pytest.skip(f"{PROFILE} is not there: real profile not compared")
    real = np.loadtxt(PROFILE, delimiter=",", skiprows=3)[:, 1]
    rows, columns, pitch = 120, 160, 0.127
    rho = radius_mm(rows, columns, pitch).numpy()
    depths = torch.linspace(0.79, 0.85, 7)
    gap = ball(3.155, rows, columns, pitch).expand(7, -1, -1)
    heights = field(MINI, rows, columns, pitch).press_to_depth(gap, depths).height_mm.numpy()
    errors = []
    for height in heights:
        flat = height - np.median(height)
        bins = [np.median(flat[(rho >= 0.2 * k) & (rho < 0.2 * k + 0.2)]) for k in range(28)]
        errors.append(float(np.sqrt(np.mean((np.array(bins) - real) ** 2))))
    assert min(errors) <= 0.0075


# What any solution must satisfy.


def test_pressure_is_positive_gaps_are_open_and_the_forces_balance():
    gel = field(dtype=torch.float64)
    gap = torch.cat([ball(r, 76, 102, 0.2) for r in (2.0, 6.0, 30.0)])
    force = torch.tensor([0.3, 1.0, 3.0])
    press = gel.press_to_force(gap, force)
    assert press.converged.all()
    assert (press.pressure_kpa >= 0).all()
    summed = press.pressure_kpa.sum((1, 2)) * 1e-3 * 0.04
    assert torch.allclose(summed, force.double(), rtol=1e-9)
    assert torch.allclose(press.force_n, force.double(), rtol=1e-9)
    opening = press.height_mm + gap - press.depth_mm[:, None, None]
    touching = press.pressure_kpa > 0
    limit = 1e-3 * press.depth_mm[:, None, None].expand_as(opening)
    assert (opening[touching].abs() <= limit[touching]).all()
    assert (opening[~touching] >= -limit[~touching]).all()


def test_the_surface_is_the_one_that_the_pressure_makes():
    gel = field(body_modulus_mpa=0.2)
    press = gel.press_to_force(ball(15.0, 76, 102, 0.2), 1.0)
    spectrum = spectrum_of(MINI, 76, 102, 0.2, torch.float32, torch.device("cpu"))
    pressure_mpa = press.pressure_kpa * 1e-3
    assert torch.allclose(spectrum.apply(pressure_mpa), press.height_mm, atol=1e-6)
    assert torch.allclose(spectrum.apply(2 * pressure_mpa), 2 * press.height_mm, atol=2e-6)


def test_a_finer_grid_changes_the_force_less_and_less():
    forces = []
    for pitch, rows in ((0.4, 38), (0.2, 76), (0.1, 152)):
        gel = field(MINI, rows, rows, pitch, dtype=torch.float64)
        forces.append(gel.press_to_depth(ball(5.0, rows, rows, pitch), 0.6).force_n.item())
    coarse, middle = abs(forces[0] / forces[2] - 1), abs(forces[1] / forces[2] - 1)
    assert middle < 0.5 * coarse
    assert middle < 0.005


def test_single_precision_agrees_with_double_within_a_thousandth():
    gap = torch.cat([ball(r, 76, 102, 0.2) for r in (1.0, 15.0)])
    force = torch.tensor([0.5, 2.0])
    single = field(body_modulus_mpa=0.2).press_to_force(gap, force)
    double = field(body_modulus_mpa=0.2, dtype=torch.float64).press_to_force(gap, force, tol=1e-7)
    assert single.height_mm.dtype == torch.float32
    assert torch.allclose(single.depth_mm.double(), double.depth_mm, rtol=1e-3)
    deepest = double.height_mm.amax((1, 2), keepdim=True)
    assert ((single.height_mm - double.height_mm).abs() <= 1e-3 * deepest).all()


def test_a_contact_does_not_depend_on_its_company():
    bodies = torch.tensor([0.1, 0.2, 0.4, 0.3])
    gap = torch.cat([ball(r, 76, 102, 0.2) for r in (1.0, 5.0, 15.0, 40.0)])
    force = torch.tensor([0.1, 3.0, 0.0, 1.0])
    batch = field(body_modulus_mpa=bodies).press_to_force(gap, force)
    for k in range(4):
        single = field(body_modulus_mpa=bodies[k : k + 1]).press_to_force(
            gap[k : k + 1], force[k : k + 1]
        )
        assert single.iterations.item() == batch.iterations[k].item()
        # Reductions and transforms run along one contact at a time, so even rounding agrees.
        assert torch.allclose(single.height_mm[0], batch.height_mm[k], atol=1e-6)
        assert torch.allclose(single.pressure_kpa[0], batch.pressure_kpa[k], atol=1e-3)


def test_pressure_ends_where_the_body_ends_while_the_surface_moves_outside():
    gap = ball(10.0, 76, 102, 0.2)
    gap[..., 48:] = NO_BODY_MM
    press = field().press_to_force(gap, 1.0)
    assert press.converged.all()
    assert press.force_n.item() == pytest.approx(1.0, rel=1e-5)
    assert (press.pressure_kpa[0, :, 48:] == 0).all()
    assert press.pressure_kpa[0, :, 47].max() > 0
    assert press.height_mm[0, 38, 48] > 0.01


def test_a_warm_start_gives_the_same_contact_sooner():
    gel = field(dtype=torch.float64)
    gap = ball(8.0, 76, 102, 0.2)
    before = gel.press_to_force(gap, 1.0)
    warm = gel.press_to_force(gap, 1.02, start=before, tol=1e-6)
    cold = gel.press_to_force(gap, 1.02, tol=1e-6)
    assert warm.iterations.item() < cold.iterations.item()
    assert torch.allclose(warm.height_mm, cold.height_mm, atol=1e-5)
    none = torch.zeros_like(before.pressure_kpa)
    loose = gel.press_to_force(gap, 1.02, start=none, tol=1e-6)
    assert torch.equal(loose.height_mm, cold.height_mm)


def test_a_far_too_hard_start_is_recovered_from():
    gel = field()
    gap = ball(8.0, 76, 102, 0.2)
    cold = gel.press_to_depth(gap, 0.3)
    warm = gel.press_to_depth(gap, 0.3, start=torch.full((1, 76, 102), 200.0))
    assert warm.converged.all()
    assert torch.allclose(warm.height_mm, cold.height_mm, atol=3e-4)


def test_no_force_moves_nothing_and_touches_at_the_lowest_point():
    press = field().press_to_force(ball(8.0, 76, 102, 0.2) + 0.25, 0.0)
    assert (press.height_mm == 0).all()
    assert press.force_n.item() == 0
    assert press.depth_mm.item() == pytest.approx(0.25125, abs=1e-5)


def test_a_body_that_does_not_reach_the_gel_presses_nothing():
    press = field().press_to_depth(ball(8.0, 76, 102, 0.2).expand(2, -1, -1), [-0.5, 0.3])
    assert press.force_n[0].item() == 0
    assert press.force_n[1].item() > 0
    assert (press.height_mm[0] == 0).all()


def test_a_force_with_nothing_over_the_field_is_not_carried_and_says_so():
    press = field().press_to_force(torch.full((1, 76, 102), torch.inf), 1.0)
    assert press.force_n.item() == 0
    assert math.isinf(press.depth_mm.item())
    assert (press.height_mm == 0).all()


def test_a_solve_that_is_cut_short_says_so(monkeypatch):
    monkeypatch.setattr(layer, "MAX_ITERATIONS", 1)
    press = field().press_to_force(ball(8.0, 76, 102, 0.2), 1.0)
    assert not press.converged.item()
    assert press.iterations.item() == 1


# Bad input.


def test_an_unknown_sensor_is_refused_with_the_known_ones():
    with pytest.raises(ValueError, match="gelsight_mini"):
        gel_of("gelsite")
    assert gel_of("gelsight_mini").thickness_mm == 3.4


@pytest.mark.parametrize(
    ("options", "named"),
    [
        ({"rows": 0}, "rows"),
        ({"pitch": 0.0}, "pitch_mm"),
        ({"dtype": torch.float16}, "float32"),
        ({"body_modulus_mpa": 0.0}, "body_modulus_mpa"),
        ({"body_modulus_mpa": torch.ones(2, 2)}, "body_modulus_mpa"),
    ],
)
def test_an_impossible_gel_is_refused_by_name(options, named):
    with pytest.raises(ValueError, match=named):
        field(**options)


@pytest.mark.parametrize(
    ("gap", "force", "options", "named"),
    [
        (torch.zeros(1, 5, 5), 1.0, {}, "gap_mm"),
        (torch.zeros(76, 102), 1.0, {}, "gap_mm"),
        (torch.full((1, 76, 102), -0.1), 1.0, {}, "gap_mm"),
        (torch.full((1, 76, 102), torch.nan), 1.0, {}, "gap_mm"),
        (torch.zeros(1, 76, 102), -1.0, {}, "force_n"),
        (torch.zeros(1, 76, 102), math.nan, {}, "force_n"),
        (torch.zeros(1, 76, 102), [1.0, 2.0], {}, "force_n"),
        (torch.zeros(1, 76, 102), 1.0, {"start": torch.zeros(3, 76, 102)}, "start"),
    ],
)
def test_bad_input_is_refused_by_name(gap, force, options, named):
    with pytest.raises(ValueError, match=named):
        field().press_to_force(gap, force, **options)


def test_a_depth_that_is_no_number_is_refused():
    with pytest.raises(ValueError, match="depth_mm"):
        field().press_to_depth(torch.zeros(1, 76, 102), math.nan)


def test_bodies_and_gaps_must_be_equally_many():
    gel = field(body_modulus_mpa=torch.tensor([0.1, 0.2]))
    with pytest.raises(ValueError, match="2 bodies"):
        gel.press_to_force(torch.zeros(3, 76, 102), 1.0)
