"""The compliance kernels against closed forms and textbook values."""

import math

import pytest
import torch

from cltp.gel.compliance import GelMaterial, layer_compliance, layer_kernel, love_kernel
from sim.gel.compliance import spectrum_of

MINI = GelMaterial(thickness_mm=3.6, young_mpa=0.145, poisson=0.495)


def test_a_uniformly_pressed_square_sinks_by_the_textbook_value_at_its_centre():
    # Timoshenko & Goodier, section 139: 2.24 q a / E* for a square of side 2a.
    kernel = love_kernel(1, 1, 2.0)
    assert kernel[0, 0].item() == pytest.approx(8.0 / math.pi * math.log(1 + math.sqrt(2)))
    assert kernel[0, 0].item() == pytest.approx(2.24, abs=0.005)


def test_the_corner_of_a_pressed_square_sinks_half_as_far_as_its_centre():
    # Four elements meet at a corner: their four corners' sinking is the big square's centre.
    fine = love_kernel(60, 60, 0.1)
    block = fine[:30, :30].sum() - 0.5 * fine[0, :30].sum() - 0.5 * fine[:30, 0].sum()
    quarter = block + 0.25 * fine[0, 0]
    big = love_kernel(1, 1, 5.9)[0, 0]
    assert 4.0 * quarter.item() == pytest.approx(big.item(), rel=1e-9)


def test_a_far_element_acts_as_a_point_force():
    kernel = love_kernel(1, 101, 0.2)
    assert kernel[0, 100].item() == pytest.approx(0.2**2 / (math.pi * 20.0), rel=1e-4)


def test_the_layer_s_compliance_has_both_its_limits():
    q = torch.tensor([0.0, 1e-6, 1e-4, 50.0, 1e6], dtype=torch.float64)
    g = layer_compliance(q, MINI)
    uniform = 3.6 * 0.01 * 1.495 / (0.145 * 0.505)
    assert g[0].item() == pytest.approx(uniform, rel=1e-12)
    assert g[1].item() == pytest.approx(uniform, rel=1e-6)
    # Next to q = 0 the compliance grows with the square of qh.
    assert g[2].item() == pytest.approx(uniform, rel=1e-3)
    assert g[3].item() == pytest.approx(2.0 / (MINI.plane_strain_mpa * 50.0), rel=1e-12)
    assert torch.isfinite(layer_compliance(q.float(), MINI)).all()


def test_a_wide_uniform_load_compresses_the_layer_as_if_confined():
    soft = GelMaterial(thickness_mm=1.0, young_mpa=0.1, poisson=0.4)
    layer = spectrum_of(soft, 121, 121, 0.25, torch.float64, torch.device("cpu"))
    sunk = layer.apply(torch.ones(1, 121, 121, dtype=torch.float64))[0, 60, 60].item()
    assert sunk == pytest.approx(1.0 * 0.2 * 1.4 / (0.1 * 0.6), rel=1e-4)


def test_a_wave_of_pressure_sinks_by_the_layer_s_transfer_function():
    wavelength = 4.0
    q = 2.0 * math.pi / wavelength
    thin = GelMaterial(thickness_mm=1.0, young_mpa=0.145, poisson=0.495)
    layer = spectrum_of(thin, 241, 241, 0.125, torch.float64, torch.device("cpu"))
    x = (torch.arange(241, dtype=torch.float64) - 120) * 0.125
    wave = torch.cos(q * x).expand(1, 241, 241).contiguous()
    expected = layer_compliance(torch.tensor(q, dtype=torch.float64), thin).item()
    # A cosine made of flat steps 1/32 of the wave wide: sinc(pi/32) = 0.9984.
    assert layer.apply(wave)[0, 120, 120].item() == pytest.approx(expected * 0.9984, rel=2e-3)


def test_a_very_thick_layer_is_a_half_space():
    thick = GelMaterial(thickness_mm=100.0, young_mpa=0.145, poisson=0.3)
    layer = layer_kernel(9, 9, 0.1, thick)
    half_space = love_kernel(9, 9, 0.1) / thick.plane_strain_mpa
    assert torch.allclose(layer, half_space, atol=0, rtol=0.07)
    # The back takes away a constant that falls with 1/h.
    missing = half_space - layer
    assert missing.std().item() < 1e-3 * missing.mean().item()


def test_convolution_does_not_wrap_around_the_grid():
    layer = spectrum_of(MINI, 20, 30, 0.5, torch.float64, torch.device("cpu"))
    pressure = torch.zeros(1, 20, 30, dtype=torch.float64)
    pressure[0, 2, 3] = 1.0
    kernel = layer_kernel(20, 30, 0.5, MINI)
    sunk = layer.apply(pressure)[0]
    assert sunk[2, 3].item() == pytest.approx(kernel[0, 0].item(), rel=1e-9)
    assert sunk[19, 29].item() == pytest.approx(kernel[17, 26].item(), abs=1e-12)
    assert sunk[0, 0].item() == pytest.approx(kernel[2, 3].item(), abs=1e-12)


@pytest.mark.parametrize(
    ("h", "e", "nu", "named"),
    [
        (0.0, 0.1, 0.4, "thickness"),
        (math.nan, 0.1, 0.4, "thickness"),
        (3.0, 0.0, 0.4, "Young"),
        (3.0, math.inf, 0.4, "Young"),
        (3.0, 0.1, 0.5, "Poisson"),
        (3.0, 0.1, -0.1, "Poisson"),
    ],
)
def test_impossible_materials_are_refused_by_name(h, e, nu, named):
    with pytest.raises(ValueError, match=named):
        GelMaterial(thickness_mm=h, young_mpa=e, poisson=nu)
