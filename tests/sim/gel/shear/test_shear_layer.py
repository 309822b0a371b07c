"""A gel dragged sideways: closed forms, memory, and what any path must satisfy."""

import math

import pytest
import torch

from cltp.gel.compliance import GelMaterial
from sim.gel.layer import ElasticLayer, gel_of
from sim.gel.shear.layer import ShearLayer

MINI = gel_of("gelsight_mini")
MU = 0.5


def square(material, size, pitch, dtype=torch.float64):
    return ElasticLayer(material, rows=size, columns=size, pitch_mm=pitch, dtype=dtype)


def radius_mm(size, pitch):
    axis = (torch.arange(size, dtype=torch.float64) - (size - 1) / 2) * pitch
    return torch.hypot(axis[:, None], axis[None, :])


def hertz(size=41, nu=0.47, thickness=math.inf):
    """A contact of 1 mm: gel, pressure [kPa], its radius [mm], friction mu P [N], (2 - nu)/G."""
    pitch = 2.3 / size
    gel = square(GelMaterial(thickness_mm=thickness, young_mpa=0.4, poisson=nu), size, pitch)
    press = gel.press_to_depth((radius_mm(size, pitch) ** 2 / 40)[None], 0.05)
    radius = math.sqrt((press.pressure_kpa > 0).sum().item() * pitch**2 / math.pi)
    modulus = 0.4 / (2 * (1 + nu))
    return gel, press.pressure_kpa, radius, MU * press.force_n.item(), (2 - nu) / modulus


def by(x=0.0, y=0.0, turn=0.0):
    return torch.tensor([[x, y, turn]], dtype=torch.float64)


def pressed(gel, force_n, ball_mm=7.5, middle=(0.0, 0.0)):
    y = ((gel.rows - 1) / 2 - torch.arange(gel.rows)[:, None]) * gel.pitch_mm - middle[1]
    x = (torch.arange(gel.columns) - (gel.columns - 1) / 2) * gel.pitch_mm - middle[0]
    return gel.press_to_force(((x**2 + y**2) / (2 * ball_mm))[None], force_n).pressure_kpa


def mini(dtype=torch.float64):
    return ElasticLayer(MINI, rows=30, columns=40, pitch_mm=0.5, dtype=dtype)


# Closed forms.


@pytest.mark.parametrize("load", [0.3, 0.6, 0.9])
def test_a_ball_slips_from_the_rim_as_cattaneo_and_mindlin_say(load):
    # Johnson, Contact Mechanics, section 7.2; equal Poisson's ratios are not needed, since the
    # pressure is given. The form neglects slip across the force, which is below 1 %.
    gel, pressure, radius, limit_n, soft = hertz()
    slide = 3 * limit_n * soft / (16 * radius)
    shear = ShearLayer(gel, friction=MU).step(
        None, pressure, by(slide * (1 - (1 - load) ** (2 / 3))), tol=1e-5
    )
    assert shear.converged.all()
    assert shear.force_n[0, 0].item() / limit_n == pytest.approx(load, rel=0.02)
    assert shear.force_n[0, 1].item() == pytest.approx(0.0, abs=1e-6 * limit_n)
    stuck = math.sqrt(shear.sticking.sum().item() / (pressure > 0).sum().item())
    assert stuck == pytest.approx((1 - load) ** (1 / 3), rel=0.03)


def test_a_small_load_meets_mindlin_s_stiffness_of_eight_a_over_s():
    gel, pressure, radius, _, soft = hertz()
    shift = 1e-4
    shear = ShearLayer(gel, friction=50.0).step(None, pressure, by(shift), tol=1e-5)
    assert shear.force_n[0, 0].item() / shift == pytest.approx(8 * radius / soft, rel=0.03)


def test_a_wide_stuck_punch_shears_the_layer_under_it():
    gel = square(GelMaterial(thickness_mm=1.0, young_mpa=0.4, poisson=0.47), 49, 0.3)
    punch = 100.0 * (radius_mm(49, 0.3) <= 6.5)[None]
    shear = ShearLayer(gel, friction=10.0).step(None, punch, by(0.006, 0.008), tol=1e-5)
    modulus_kpa = 400 / (2 * 1.47)
    middle = shear.traction_kpa[0, :, 24, 24].tolist()
    assert middle == pytest.approx([0.006 * modulus_kpa, 0.008 * modulus_kpa], rel=0.01)
    assert shear.stick_fraction.item() == 1.0


def test_a_ball_that_slides_or_spins_resists_with_all_of_its_friction():
    gel, pressure, radius, limit_n, _ = hertz()
    layer = ShearLayer(gel, friction=MU)
    slid = layer.step(None, pressure, by(3.0, 4.0))
    assert slid.force_n[0].tolist() == pytest.approx([0.6 * limit_n, 0.8 * limit_n], rel=1e-3)
    assert slid.stick_fraction.item() == 0.0
    spun = layer.step(None, pressure, by(turn=5.0))
    assert spun.moment_nmm.item() == pytest.approx(3 * math.pi / 16 * limit_n * radius, rel=0.02)


def test_a_cycle_loses_what_mindlin_and_deresiewicz_say_and_closes():
    gel, pressure, radius, limit_n, soft = hertz(31)
    layer, slide = ShearLayer(gel, friction=MU), 3 * limit_n * soft / (16 * radius)
    end, steps, heat = 0.6 * slide, 12, 0.0
    first = shear = layer.step(None, pressure, by(end))
    for k in range(2 * steps):
        shear = layer.step(shear, pressure, by((-1 if k < steps else 1) * 2 * end / steps))
        heat += shear.dissipated_mj.item()
        if k == steps - 1:
            assert shear.force_n[0, 0].item() == pytest.approx(
                -first.force_n[0, 0].item(), rel=0.01
            )
    t = first.force_n[0, 0].item() / limit_n
    lost = 1 - (1 - t) ** (5 / 3) - 5 / 6 * t * (1 + (1 - t) ** (2 / 3))
    assert heat == pytest.approx(24 / 5 * slide * limit_n * lost, rel=0.05)
    assert shear.force_n[0, 0].item() == pytest.approx(first.force_n[0, 0].item(), rel=0.01)


def test_a_body_as_soft_as_the_gel_halves_the_stiffness():
    gel, pressure, _, _, _ = hertz(31)
    rigid = ShearLayer(gel, friction=50.0).step(None, pressure, by(1e-3), tol=1e-6)
    soft = ShearLayer(gel, friction=50.0, body=gel.material).step(
        None, pressure, by(1e-3), tol=1e-6
    )
    assert soft.force_n[0, 0].item() == pytest.approx(0.5 * rigid.force_n[0, 0].item(), rel=1e-4)
    assert torch.allclose(soft.displacement_mm, 0.5 * rigid.displacement_mm, atol=1e-7)


# Memory.


def test_what_sticks_moves_with_the_body_and_comes_back_with_it():
    gel = mini()
    layer, pressure = ShearLayer(gel, friction=50.0), pressed(mini(), 1.0)
    shear = layer.step(None, pressure, by(0.02, -0.01), tol=1e-6)
    shear = layer.step(shear, pressure, by(0.01, 0.03), tol=1e-6)
    moved = shear.displacement_mm[0, :, shear.sticking[0]]
    assert torch.allclose(moved[0], torch.tensor(0.03, dtype=torch.float64), atol=1e-5)
    assert torch.allclose(moved[1], torch.tensor(0.02, dtype=torch.float64), atol=1e-5)
    back = layer.step(shear, pressure, by(-0.03, -0.02), tol=1e-6)
    assert back.force_n.abs().max().item() < 1e-4 * shear.force_n.abs().max().item()
    assert back.dissipated_mj.item() == 0.0


def test_the_same_place_reached_on_two_paths_bears_two_tractions():
    layer, pressure = ShearLayer(mini(), friction=MU), pressed(mini(), 1.0)
    straight = layer.step(None, pressure, by(0.1))
    beyond = layer.step(None, pressure, by(0.25))
    returned = layer.step(beyond, pressure, by(-0.15))
    assert returned.force_n[0, 0] < 0.7 * straight.force_n[0, 0]
    assert returned.stick_fraction.item() > straight.stick_fraction.item()


def test_small_steps_end_where_a_large_one_does():
    # A steady pressure and a straight path: the slip never turns back, so that the path is one.
    layer, pressure = ShearLayer(mini(), friction=MU), pressed(mini(), 1.0)
    shear, once = None, layer.step(None, pressure, by(0.12), tol=1e-5)
    for _ in range(60):
        shear = layer.step(shear, pressure, by(0.002), tol=1e-4)
    assert shear.force_n[0, 0].item() == pytest.approx(once.force_n[0, 0].item(), rel=0.005)
    assert shear.stick_fraction.item() == pytest.approx(once.stick_fraction.item(), abs=0.03)


def test_a_body_at_rest_keeps_its_traction_and_its_stick_fraction():
    layer, pressure = ShearLayer(mini(), friction=MU), pressed(mini(), 1.0)
    moved = rest = layer.step(None, pressure, by(0.2, 0.05))
    for _ in range(5):
        rest = layer.step(rest, pressure, by())
    assert 0.2 < moved.stick_fraction.item() < 0.8
    assert rest.stick_fraction.item() == pytest.approx(moved.stick_fraction.item(), abs=1e-9)
    assert torch.allclose(rest.traction_kpa, moved.traction_kpa, atol=1e-6)
    assert rest.dissipated_mj.item() < 1e-4 * moved.dissipated_mj.item()


def test_a_point_that_is_touched_later_sticks_where_it_is_touched():
    layer = ShearLayer(mini(), friction=50.0)
    light, firm = pressed(mini(), 0.3), pressed(mini(), 3.0)
    moved = layer.step(None, light, by(0.05), tol=1e-6)
    firmer = layer.step(moved, firm, by(), tol=1e-6)
    new = (firm > 0) & (light == 0)
    assert new.sum() > 20
    assert firmer.traction_kpa[0, :, new[0]].abs().max() < 0.01 * moved.traction_kpa.max()
    back = layer.step(firmer, firm, by(-0.05), tol=1e-6)
    assert back.traction_kpa[0, 0][new[0]].sum() < 0  # they stuck while the others were ahead


def test_a_point_that_is_left_forgets():
    layer, pressure = ShearLayer(mini(), friction=MU), pressed(mini(), 1.0)
    moved = layer.step(None, pressure, by(0.1))
    left = layer.step(moved, torch.zeros_like(pressure), by())
    again = layer.step(left, pressure, by())
    assert moved.force_n[0, 0] > 0.1
    assert left.traction_kpa.abs().max() == 0
    assert left.displacement_mm.abs().max() == 0
    assert again.traction_kpa.abs().max() == 0


def test_a_lighter_press_slips_until_friction_bears_the_rest():
    layer = ShearLayer(mini(), friction=MU)
    moved = layer.step(None, pressed(mini(), 2.0), by(0.2))
    lighter = layer.step(moved, pressed(mini(), 0.5), by())
    assert moved.force_n[0, 0] > MU * 0.5
    assert lighter.force_n[0].norm().item() <= MU * 0.5 * (1 + 1e-6)
    assert lighter.dissipated_mj.item() > 0


# Coupling.


@pytest.mark.parametrize(("nu", "least", "most"), [(0.3, 0.05, 0.55), (0.4999, 0.0, 1e-3)])
def test_friction_holds_what_pressure_would_draw_inwards_on_a_half_space(nu, least, most):
    gel, pressure, _, limit_n, _ = hertz(31, nu=nu)
    shear = ShearLayer(gel, friction=MU, coupled=True).step(None, pressure, by())
    axis = torch.arange(31, dtype=torch.float64) - 15
    outwards = (shear.traction_kpa[0, 0] * axis.sign()).sum() * 1e-3 * gel.pitch_mm**2
    assert shear.force_n.abs().max().item() < 1e-6 * limit_n
    assert least <= outwards.item() / limit_n <= most
    plain = ShearLayer(gel, friction=MU).step(None, pressure, by())
    assert plain.traction_kpa.abs().max() == 0


# What is given.


def test_a_contact_does_not_depend_on_its_company():
    gel = mini()
    two = torch.cat([pressed(gel, 1.0), pressed(gel, 0.5, middle=(4.0, -3.0))])
    motion = torch.cat([by(0.1, 0.0, 0.01), by(-0.05, 0.1)])
    layer = ShearLayer(gel, friction=MU)
    batch = layer.step(layer.step(None, two, motion, tol=1e-6), two, -0.5 * motion, tol=1e-6)
    for k in range(2):
        one = layer.step(None, two[k : k + 1], motion[k : k + 1], tol=1e-6)
        one = layer.step(one, two[k : k + 1], -0.5 * motion[k : k + 1], tol=1e-6)
        assert torch.allclose(one.traction_kpa[0], batch.traction_kpa[k], atol=1e-2)
        assert torch.allclose(one.force_n[0], batch.force_n[k], atol=1e-5)


def test_without_friction_nothing_sticks():
    shear = ShearLayer(mini(), friction=0.0).step(None, pressed(mini(), 1.0), by(0.1))
    assert not shear.sticking.any()
    assert shear.force_n.abs().max() == 0


def test_impossible_layers_are_refused():
    with pytest.raises(ValueError, match="friction must be finite"):
        ShearLayer(mini(), friction=-0.1)
    with pytest.raises(ValueError, match=r"give thickness_mm=math\.inf"):
        ShearLayer(mini(), friction=0.5, body=MINI)


def test_impossible_steps_are_refused():
    layer, pressure = ShearLayer(mini(), friction=MU), pressed(mini(), 1.0)
    with pytest.raises(ValueError, match="pressure_kpa must have shape"):
        layer.step(None, pressure[:, :-1], by())
    with pytest.raises(ValueError, match="take a Press's"):
        layer.step(None, -pressure, by())
    with pytest.raises(ValueError, match="motion must be finite"):
        layer.step(None, pressure, torch.zeros(2, 3))
    with pytest.raises(ValueError, match="motion must be finite"):
        layer.step(None, pressure, by(math.nan))
    with pytest.raises(ValueError, match="one batch on one grid"):
        layer.step(layer.at_rest(2), pressure, by())
