"""The kernels on a grid: point forces, waves, symmetries."""

import math

import numpy as np
import pytest
import torch

from cltp.gel.compliance import GelMaterial
from sim.gel.shear.compliance import (
    coupling_compliance,
    longitudinal_compliance,
    shear_modulus_mpa,
    transverse_compliance,
)
from sim.gel.shear.kernels import half_space_kernel, shear_kernel, shear_spectrum_from

HALF_SPACE = GelMaterial(thickness_mm=math.inf, young_mpa=0.3, poisson=0.3)
THIN = GelMaterial(thickness_mm=1.0, young_mpa=0.145, poisson=0.47)
CPU = torch.device("cpu")


def cerruti(x, y, nu, g):
    """Displacements (ux, uy, uz) at (x, y) under a unit force along x; Johnson, section 3.6."""
    r = np.hypot(x, y)
    scale = 1 / (2 * math.pi * g)
    return (
        scale * ((1 - nu) / r + nu * x**2 / r**3),
        scale * nu * x * y / r**3,
        scale * (0.5 - nu) * x / r**2,
    )


def test_a_far_element_acts_as_cerruti_s_point_force():
    kernel = half_space_kernel(41, 31, 0.1, HALF_SPACE)
    ux, uy, uz = cerruti(3.0, -4.0, 0.3, shear_modulus_mpa(HALF_SPACE))  # row 40 is 4 mm down
    assert kernel.xx[40, 30].item() == pytest.approx(ux * 0.01, rel=1e-3)
    assert kernel.xy[40, 30].item() == pytest.approx(uy * 0.01, rel=1e-3)
    assert kernel.zx[40, 30].item() == pytest.approx(uz * 0.01, rel=1e-3)


def test_a_near_element_is_the_integral_over_its_area():
    kernel = half_space_kernel(2, 2, 1.0, HALF_SPACE)
    nodes, weights = np.polynomial.legendre.leggauss(40)
    x, y = 1.0 + 0.5 * nodes[None, :], -1.0 + 0.5 * nodes[:, None]
    area = 0.25 * weights[:, None] * weights[None, :]
    expected = [(u * area).sum() for u in cerruti(x, y, 0.3, shear_modulus_mpa(HALF_SPACE))]
    found = [kernel.xx[1, 1].item(), kernel.xy[1, 1].item(), kernel.zx[1, 1].item()]
    assert found == pytest.approx(expected, rel=1e-9)


def test_x_and_y_are_alike():
    for material in (HALF_SPACE, THIN):
        kernel = shear_kernel(material, 12, 12, 0.3)
        assert torch.allclose(kernel.xx, kernel.yy.T)
        assert torch.allclose(kernel.xy, kernel.xy.T)
        assert torch.allclose(kernel.zx, -kernel.zy.T)  # rows go down, y goes up


def test_a_very_thick_layer_is_a_half_space():
    thick = GelMaterial(thickness_mm=100.0, young_mpa=0.3, poisson=0.3)
    layer, half_space = (shear_kernel(each, 9, 9, 0.1) for each in (thick, HALF_SPACE))
    for name in ("xx", "yy"):  # the back takes away a constant that falls with 1/h
        missing = getattr(half_space, name) - getattr(layer, name)
        assert 0 < missing.mean().item() < 0.02 * getattr(half_space, name).mean().item()
        assert missing.std().item() < 1e-3 * missing.mean().item()
    for name in ("xy", "zx", "zy"):
        ours, theirs = getattr(layer, name), getattr(half_space, name)
        assert torch.allclose(ours, theirs, rtol=0, atol=2e-3 * theirs.abs().max().item())


@pytest.mark.parametrize("degrees", [0.0, 90.0, 30.0])
def test_a_wave_of_traction_moves_the_surface_by_the_layer_s_compliance(degrees):
    n, pitch, q = 161, 0.125, 2 * math.pi / 4
    spectrum = shear_spectrum_from(shear_kernel(THIN, n, n, pitch), torch.float64, CPU)
    axis = (torch.arange(n, dtype=torch.float64) - n // 2) * pitch
    along = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    phase = q * (along[0] * axis[None, :] - along[1] * axis[:, None])
    wavenumber = torch.tensor(q, dtype=torch.float64)
    # A wave of flat steps 1/32 of its length wide: sinc(pi/32) = 0.9984.
    for direction, compliance in (
        (along, longitudinal_compliance),
        ((-along[1], along[0]), transverse_compliance),
    ):
        traction = torch.stack([c * phase.cos() for c in direction])[None]
        moved = spectrum.apply(traction)[0, :, n // 2, n // 2]
        expected = 0.9984 * compliance(wavenumber, THIN).item()
        assert moved.tolist() == pytest.approx([expected * c for c in direction], abs=2e-3)
    traction = torch.stack([c * phase.sin() for c in along])[None]
    sunk = spectrum.sink(traction)[0, n // 2, n // 2].item()
    assert sunk == pytest.approx(coupling_compliance(wavenumber, THIN).item(), rel=5e-3)


def test_pressure_and_traction_work_on_each_other_alike():
    # Betti: the pressure's work on what the traction sinks is the traction's on what it spreads.
    spectrum = shear_spectrum_from(shear_kernel(THIN, 10, 14, 0.2), torch.float64, CPU)
    draw = torch.Generator().manual_seed(0)
    pressure = torch.rand(1, 10, 14, generator=draw, dtype=torch.float64)
    traction = torch.randn(1, 2, 10, 14, generator=draw, dtype=torch.float64)
    one = (pressure * spectrum.sink(traction)).sum().item()
    other = (traction * spectrum.spread(pressure)).sum().item()
    assert one == pytest.approx(other, rel=1e-9)
    assert abs(one) > 1e-3


def test_a_gel_dragged_to_the_right_rises_on_its_right():
    gel = GelMaterial(thickness_mm=2.0, young_mpa=0.3, poisson=0.4999)
    spectrum = shear_spectrum_from(shear_kernel(gel, 21, 41, 0.2), torch.float64, CPU)
    traction = torch.zeros(1, 2, 21, 41, dtype=torch.float64)
    traction[0, 0, 10, 20] = 1.0
    moved, sunk = spectrum.apply(traction)[0], spectrum.sink(traction)[0]
    assert moved[0, 10].min() > 0
    assert sunk[10, 25] < 0 < sunk[10, 15]


def test_no_pattern_moves_more_than_the_bound():
    spectrum = shear_spectrum_from(shear_kernel(THIN, 12, 12, 0.2), torch.float64, CPU)
    pattern = torch.randn(1, 2, 12, 12, dtype=torch.float64)
    for _ in range(50):  # towards the pattern that moves most
        pattern = pattern / pattern.norm()
        pattern = spectrum.apply(pattern)
    assert 0.5 * spectrum.largest < pattern.norm().item() <= spectrum.largest
