"""Compliance of a bonded layer to traction along its surface, and its coupling to pressure.

Derivation. The surface is z = 0, z points into the gel, the back z = h does not move. A traction
t on the surface, waves e^(ik·x) along it, moves the surface by u of the same wave. In axes along k
and across it, the two parts of the motion separate (isotropy):

- Across k the layer shears alone: v'' = k² v, v(h) = 0, -G v'(0) = t gives
  v(0) = tanh(a) / (G k) · t, with a = kh.
- Along k and z the strain is plane. With U = -iV along k, W along z, s = k (h - z), m = 2 (1 - nu)
  / (1 - 2 nu), Navier's equations are V'' = m V - (m - 1) W' and m W'' = W + (m - 1) V'
  (derivatives by s). Two solutions vanish at the back, with kappa = 3 - 4 nu:

      V1 = s cosh s + kappa sinh s    W1 = s sinh s
      V2 = s sinh s                   W2 = s cosh s - kappa sinh s

  The surface's traction is t = -iGk (V' + W) along k and p = Gk (m W' - (m - 2) V) along z. At
  s = a, the V' + W are Q1 = (kappa + 1) cosh a + 2a sinh a, Q2 = 2a cosh a - (kappa - 1) sinh a;
  the m W' - (m - 2) V are P1 = 2a cosh a + (kappa - 1) sinh a, P2 = 2a sinh a - (kappa + 1) cosh a.
  P1 Q2 - P2 Q1 = D = 2 kappa cosh 2a + 4a² + kappa² + 1. Without pressure the amplitudes stand as
  -P2 : P1, which gives

      U = 2/(E* k) · (2 kappa sinh 2a + 4a) / D · t
      W = i / (G k) · (2a² - kappa (kappa - 1) sinh² a) / D · t

  and, by reciprocity, a pressure p moves the surface along k by U = -i (the same factor) · p.

Limits. For k to 0 both tangential compliances are h/G, pure shear. For h to infinity they are
(1 - nu)/(G k) along and 1/(G k) across k, and the coupling is -i (1 - 2 nu)/(2 G k): Cerruti's
half-space. There the coupling vanishes at nu = 1/2; in a bonded layer it does not: an
incompressible gel that is dragged sideways rises before the body and sinks behind it.

Source: our derivation from Navier's equations. The pressure's own compliance has the same D
(``sim.gel.compliance``). The test integrates the equations in z numerically.

Not here: the kernels on a grid (``sim.gel.shear.kernels``).
"""

from __future__ import annotations

import math

import torch
from torch import Tensor

from cltp.gel.compliance import GelMaterial


def shear_modulus_mpa(material: GelMaterial) -> float:
    """G = E / (2 (1 + nu)) [MPa]."""
    return material.young_mpa / (2.0 * (1.0 + material.poisson))


def _scaled_bottom(a: Tensor, e2: Tensor, kappa: float) -> Tensor:
    """D e^(-2a) of the module's docstring."""
    return kappa * (1.0 + e2 * e2) + (4.0 * a * a + 1.0 + kappa * kappa) * e2


def longitudinal_compliance(q_per_mm: Tensor, material: GelMaterial) -> Tensor:
    """Surface displacement over a sinusoidal traction, both along the wavevector.

    Args:
        q_per_mm: Wavenumbers, any shape, > 0 [rad/mm].
        material: The layer; infinite thickness makes it a half-space.

    Returns:
        Compliance, same shape [mm/MPa].
    """
    half_space = 2.0 / (material.plane_strain_mpa * q_per_mm)
    if math.isinf(material.thickness_mm):
        return half_space
    kappa = 3.0 - 4.0 * material.poisson
    a = q_per_mm * material.thickness_mm
    e2 = torch.exp(-2.0 * a)
    return half_space * (kappa * (1.0 - e2 * e2) + 4.0 * a * e2) / _scaled_bottom(a, e2, kappa)


def transverse_compliance(q_per_mm: Tensor, material: GelMaterial) -> Tensor:
    """Surface displacement over a sinusoidal traction, both across the wavevector.

    Arguments and result are those of ``longitudinal_compliance``.
    """
    return torch.tanh(q_per_mm * material.thickness_mm) / (shear_modulus_mpa(material) * q_per_mm)


def coupling_compliance(q_per_mm: Tensor, material: GelMaterial) -> Tensor:
    """Real factor c of the coupling between pressure and traction along the wavevector.

    A traction t moves the surface by i·c·t into the gel, a pressure p by -i·c·p along the
    wavevector. Arguments and result are those of ``longitudinal_compliance``.
    """
    modulus = shear_modulus_mpa(material)
    if math.isinf(material.thickness_mm):
        return -(1.0 - 2.0 * material.poisson) / (2.0 * modulus * q_per_mm)
    kappa = 3.0 - 4.0 * material.poisson
    a = q_per_mm * material.thickness_mm
    e2 = torch.exp(-2.0 * a)
    top = 2.0 * a * a * e2 - 0.25 * kappa * (kappa - 1.0) * torch.expm1(-2.0 * a) ** 2
    return top / (modulus * q_per_mm * _scaled_bottom(a, e2, kappa))
