"""The layer's tangential compliance against its equations, integrated through the thickness."""

import math

import numpy as np
import pytest
import torch
from scipy.linalg import expm

from cltp.gel.compliance import GelMaterial, layer_compliance
from sim.gel.shear.compliance import (
    coupling_compliance,
    longitudinal_compliance,
    shear_modulus_mpa,
    transverse_compliance,
)


def plane_strain_response(k, material, traction, pressure):
    """Displacements (u, w) of the surface under stresses e^(ikx), by integrating in z.

    The state is (u, w, sxz, szz), complex: Hooke's law and equilibrium, written as four equations
    of first order in z. Nothing of the closed forms is used.
    """
    nu, h = material.poisson, material.thickness_mm
    g = shear_modulus_mpa(material)
    lam = 2 * g * nu / (1 - 2 * nu)
    p_wave = lam + 2 * g
    slope = np.array(
        [
            [0, -1j * k, 1 / g, 0],  # sxz = G (u' + ik w)
            [-1j * k * lam / p_wave, 0, 0, 1 / p_wave],  # szz = lam ik u + (lam + 2G) w'
            [k**2 * (p_wave - lam**2 / p_wave), 0, 0, -1j * k * lam / p_wave],  # sxz' = -ik sxx
            [0, 0, -1j * k, 0],  # szz' = -ik sxz
        ]
    )
    through = expm(slope * h)  # state at the back from that at the surface
    stress = np.array([-traction, -pressure])  # the outward normal of the surface is -z
    return np.linalg.solve(through[:2, :2], -through[:2, 2:] @ stress)


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.47])
@pytest.mark.parametrize("k", [0.01, 0.2, 0.6, 1.5])
def test_plane_strain_through_the_thickness_gives_the_closed_forms(nu, k):
    gel = GelMaterial(thickness_mm=3.4, young_mpa=0.423, poisson=nu)
    q = torch.tensor(k, dtype=torch.float64)
    coupled = coupling_compliance(q, gel).item()
    u, w = plane_strain_response(k, gel, 1.0, 0.0)
    assert u == pytest.approx(longitudinal_compliance(q, gel).item(), rel=1e-9)
    assert w == pytest.approx(1j * coupled, rel=1e-7, abs=1e-12)
    u, w = plane_strain_response(k, gel, 0.0, 1.0)
    assert w == pytest.approx(layer_compliance(q, gel).item(), rel=1e-9)
    assert u == pytest.approx(-1j * coupled, rel=1e-7, abs=1e-12)


@pytest.mark.parametrize("k", [0.01, 0.6, 3.0])
def test_shear_through_the_thickness_gives_the_transverse_closed_form(k):
    gel = GelMaterial(thickness_mm=3.4, young_mpa=0.423, poisson=0.47)
    g = shear_modulus_mpa(gel)
    through = expm(np.array([[0, 1 / g], [g * k**2, 0]]) * 3.4)  # (v, syz)
    v = through[0, 1] / through[0, 0]
    found = transverse_compliance(torch.tensor(k, dtype=torch.float64), gel)
    assert found.item() == pytest.approx(v, rel=1e-9)


def test_long_waves_shear_the_layer_as_a_whole():
    gel = GelMaterial(thickness_mm=3.4, young_mpa=0.423, poisson=0.47)
    q = torch.tensor(1e-5, dtype=torch.float64)
    whole = 3.4 / shear_modulus_mpa(gel)
    assert longitudinal_compliance(q, gel).item() == pytest.approx(whole, rel=1e-8)
    assert transverse_compliance(q, gel).item() == pytest.approx(whole, rel=1e-8)


@pytest.mark.parametrize("thickness", [math.inf, 400.0])
def test_short_waves_see_cerruti_s_half_space(thickness):
    gel = GelMaterial(thickness_mm=thickness, young_mpa=0.3, poisson=0.3)
    g, q = shear_modulus_mpa(gel), torch.tensor(0.5, dtype=torch.float64)
    assert longitudinal_compliance(q, gel).item() == pytest.approx(0.7 / (0.5 * g), rel=1e-12)
    assert transverse_compliance(q, gel).item() == pytest.approx(1 / (0.5 * g), rel=1e-12)
    assert coupling_compliance(q, gel).item() == pytest.approx(-0.4 / g, rel=1e-12)


def test_an_incompressible_layer_is_coupled_where_a_half_space_is_not():
    q = torch.tensor(0.3, dtype=torch.float64)
    layer = GelMaterial(thickness_mm=3.4, young_mpa=0.3, poisson=0.4999)
    half_space = GelMaterial(thickness_mm=math.inf, young_mpa=0.3, poisson=0.4999)
    along = longitudinal_compliance(q, layer)
    assert (coupling_compliance(q, layer) / along).item() > 0.3
    assert abs(coupling_compliance(q, half_space) / along).item() < 1e-3
