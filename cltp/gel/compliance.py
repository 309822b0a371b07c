"""Compliance of a gel's surface under pressure: half-space and bonded elastic layer.

Every compliance is a real-space kernel, the displacement [mm] at the centre of a grid element
for 1 MPa on one square element, so that nothing is periodic at the end of the grid. The kernels are
computed once in float64.

Not here: their convolution (``sim.gel.compliance``), the pressure of a contact
(``sim.gel.contact_solver``), traction along the surface (``sim.gel.shear``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import torch
from scipy.interpolate import CubicSpline
from torch import Tensor


@dataclass(frozen=True, slots=True, kw_only=True)
class GelMaterial:
    """A linear elastic layer bonded to a rigid back.

    Attributes:
        thickness_mm: Thickness [mm]; ``math.inf`` makes it a half-space.
        young_mpa: Young's modulus [MPa].
        poisson: Poisson's ratio, 0 <= nu < 0.5. At 0.5 the bonded layer conserves volume exactly
            and a uniform load has no solution; 0.4999 is close enough.
    """

    thickness_mm: float
    young_mpa: float
    poisson: float

    def __post_init__(self) -> None:
        if not self.thickness_mm > 0:
            raise ValueError(f"gel thickness must be > 0 mm, got {self.thickness_mm}")
        if not 0 < self.young_mpa < math.inf:
            raise ValueError(
                f"Young's modulus must be finite and > 0 MPa, got {self.young_mpa}; "
                "soft silicone gels have 0.05 to 0.5 MPa"
            )
        if not 0 <= self.poisson < 0.5:
            raise ValueError(
                f"Poisson's ratio must be in [0, 0.5), got {self.poisson}; "
                "use 0.4999 for an incompressible gel"
            )

    @property
    def plane_strain_mpa(self) -> float:
        """E* = E / (1 - nu²) [MPa]."""
        return self.young_mpa / (1.0 - self.poisson**2)


def layer_compliance(q_per_mm: Tensor, material: GelMaterial) -> Tensor:
    """Surface displacement over pressure of a bonded layer for a sinusoidal pressure.

    Numerator and denominator are divided by e^(2qh): no overflow for thick layers and short waves.

    Args:
        q_per_mm: Wavenumbers, any shape, >= 0 [rad/mm].
        material: The layer.

    Returns:
        Compliance, same shape [mm/MPa].

    Source: the plane-strain solution of a layer with zero displacement at its back; shared notes,
        'Simulators'. At q = 0 it is the confined compression h (1 - 2nu)(1 + nu) / (E (1 - nu)).
    """
    nu, e_star = material.poisson, material.plane_strain_mpa
    kappa = 3.0 - 4.0 * nu
    a = q_per_mm * material.thickness_mm
    e2, e4 = torch.exp(-2.0 * a), torch.exp(-4.0 * a)
    top = kappa * (1.0 - e4) - 4.0 * a * e2
    bottom = kappa * (1.0 + e4) + (4.0 * a * a + 1.0 + kappa * kappa) * e2
    uniform = material.thickness_mm * (1 - 2 * nu) * (1 + nu) / (material.young_mpa * (1 - nu))
    waves = 2.0 * top / (e_star * q_per_mm.clamp(min=1e-300) * bottom)
    # Below a = 1e-4 the top is a difference of equal numbers; the limit is exact to 1e-8 there.
    return torch.where(a > 1e-4, waves, torch.full_like(a, uniform))


def love_kernel(rows: int, columns: int, pitch_mm: float) -> Tensor:
    """Half-space with E* = 1 MPa under uniform pressure on one square element.

    Returns:
        Displacement at lag (i, j) elements, i in 0..rows-1 and j in 0..columns-1, shape
        (rows, columns), float64 [mm/MPa]. Negative lags follow by symmetry.

    Source: Love (1929), the closed form for a rectangle; written with asinh, which is the
        logarithm of the usual form without its cancellation.
    """
    half = 0.5 * pitch_mm
    y = torch.arange(rows, dtype=torch.float64)[:, None] * pitch_mm
    x = torch.arange(columns, dtype=torch.float64)[None, :] * pitch_mm

    def corner(u: Tensor, v: Tensor) -> Tensor:
        return u * torch.asinh(v / u.abs()) + v * torch.asinh(u / v.abs())

    near_x, far_x, near_y, far_y = x - half, x + half, y - half, y + half
    total = corner(far_x, far_y) - corner(far_x, near_y)
    total = total - corner(near_x, far_y) + corner(near_x, near_y)
    return total / math.pi


# The remainder of the split below is zero in float64 beyond these, in units of 1/h and h.
_REMAINDER_WAVES, _REMAINDER_REACH = 20.0, 15.0


def _far_part(r_mm: Tensor, scale_mm: float, pitch_mm: float) -> Tensor:
    """Mean of erf(r/s)/r over one element around each radius [1/mm].

    To second order: the value and pitch²/24 times its Laplacian. Without the second term the sum
    over a wide area misses the flux through its edge.
    """
    x = (r_mm / scale_mm).clamp(min=1e-3)  # flat to 1e-6 below
    bell = 2.0 / math.sqrt(math.pi) * torch.exp(-x * x)
    value = torch.special.erf(x) / x
    curved = torch.where(x > 1e-2, value / x**2 - bell * (2.0 + 1.0 / x**2), -4.0 / 3.0 * bell)
    return (value + pitch_mm**2 / (24.0 * scale_mm**2) * curved) / scale_mm


# Gauss-Legendre nodes and weights over -1 to 1 take longer than the rest of a kernel.
_quadrature = lru_cache(np.polynomial.legendre.leggauss)


def _remainder(r_mm: Tensor, pitch_mm: float, material: GelMaterial) -> Tensor:
    """Compliance of the layer less the near part of a half-space, per force on one element [mm/N].

    Hankel transform of G(q) - (2/E*q) erf(qh/2), averaged over the element to the same order as
    the far part: by Gauss-Legendre on radii h/64 apart, then a cubic spline, so that the cost
    does not depend on the grid.
    """
    h, e_star = material.thickness_mm, material.plane_strain_mpa
    nodes, weights = _quadrature(400)
    q = torch.from_numpy(nodes + 1.0) * (0.5 * _REMAINDER_WAVES / h)
    step = torch.from_numpy(weights) * (0.5 * _REMAINDER_WAVES / h)
    rest = layer_compliance(q, material) - 2.0 / (e_star * q) * torch.special.erf(0.5 * q * h)
    rest = rest * torch.exp(-((q * pitch_mm) ** 2) / 24.0)
    radii = np.arange(0.0, _REMAINDER_REACH + 1e-9, 1.0 / 64.0) * h
    waves = torch.special.bessel_j0(torch.from_numpy(radii)[:, None] * q)
    values = waves @ (rest * q * step) / (2.0 * math.pi)
    spline = CubicSpline(radii, values.numpy(), extrapolate=False)
    return torch.from_numpy(np.nan_to_num(spline(r_mm.numpy())))


def layer_kernel(rows: int, columns: int, pitch_mm: float, material: GelMaterial) -> Tensor:
    """Bonded layer under uniform pressure on one square element.

    The layer's kernel is singular at the origin, like a half-space's, and decays fast, so that
    neither real nor Fourier space alone gives it accurately. It is split: Love's closed form less
    the smooth far part erf(r/s)/r of a half-space, in real space; and the layer less the near part
    of a half-space, whose transform is (2/E*q) erf(qs/2), in Fourier space. That remainder is
    smooth in both spaces.

    Returns:
        As ``love_kernel``, for this material [mm/MPa].

    Source: the split is Ewald's; our choice for this kernel, with s = h.
    """
    e_star, h = material.plane_strain_mpa, material.thickness_mm
    near = love_kernel(rows, columns, pitch_mm) / e_star
    if math.isinf(h):
        return near
    y = torch.arange(rows, dtype=torch.float64)[:, None] * pitch_mm
    x = torch.arange(columns, dtype=torch.float64)[None, :] * pitch_mm
    r = torch.hypot(x, y)
    far = _far_part(r, h, pitch_mm) / (math.pi * e_star)
    return near + pitch_mm**2 * (_remainder(r, pitch_mm, material) - far)


@lru_cache(maxsize=32)
def kernel_of(material: GelMaterial | None, rows: int, columns: int, pitch_mm: float) -> Tensor:
    """Kernel of a material; ``None`` is the half-space with E* = 1 MPa."""
    if material is None:
        return love_kernel(rows, columns, pitch_mm)
    return layer_kernel(rows, columns, pitch_mm, material)
