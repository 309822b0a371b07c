"""Displacement of a layer's surface under traction on grid elements, and its convolution.

As for pressure (``sim.gel.compliance``), every compliance is a real-space kernel: the displacement
[mm] at the centre of an element for 1 MPa on one square element. Nothing is periodic at the end of
the grid.

Axes are those of the gel frame: x right, y up, z into the gel; row 0 of a grid is the top. Traction
and displacement along the surface are (B, 2, H, W), x first; traction is the body's on the gel.

Not here: which traction acts (``sim.gel.shear.friction``).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
import torch
from scipy.fft import next_fast_len
from scipy.interpolate import CubicSpline
from torch import Tensor

from cltp.gel.compliance import GelMaterial
from sim.gel.shear.compliance import (
    coupling_compliance,
    longitudinal_compliance,
    shear_modulus_mpa,
    transverse_compliance,
)

_WAVES, _REACH = 20.0, 15.0
"""The smooth remainder of a layer is zero in float64 beyond these, in units of 1/h and h."""

_quadrature = lru_cache(np.polynomial.legendre.leggauss)


@dataclass(frozen=True, slots=True, kw_only=True)
class ShearKernel:
    """Displacements at lag (i, j) of the traction on one element: i rows down, j columns right.

    Each has shape (rows, columns), float64 [mm/MPa]; other lags follow by symmetry.

    Attributes:
        xx: Displacement along x under traction along x, even in both lags.
        yy: The same along y.
        xy: Displacement along y under traction along x, and the reverse, odd in both lags.
        zx: Displacement into the gel under traction along x, odd in j. A pressure displaces along x
            by the opposite.
        zy: The same for y, odd in i.
    """

    xx: Tensor
    yy: Tensor
    xy: Tensor
    zx: Tensor
    zy: Tensor


def _lags_mm(rows: int, columns: int, pitch_mm: float) -> tuple[Tensor, Tensor]:
    """Displacement in x (1, columns) and y (rows, 1) of lags to the right and down [mm]."""
    y = -torch.arange(rows, dtype=torch.float64)[:, None] * pitch_mm
    return torch.arange(columns, dtype=torch.float64)[None, :] * pitch_mm, y


def _element_mean(
    function: Callable[[Tensor, Tensor], Tensor], x: Tensor, y: Tensor, pitch_mm: float
) -> Tensor:
    """Integral over the element around each (x, y) [mm] of d²f/dxdy, for the ``function`` f."""
    half = 0.5 * pitch_mm
    right = function(x + half, y + half) - function(x + half, y - half)
    left = function(x - half, y + half) - function(x - half, y - half)
    return right - left


def half_space_kernel(
    rows: int, columns: int, pitch_mm: float, material: GelMaterial
) -> ShearKernel:
    """Half-space under uniform traction on one square element.

    Source: Cerruti's solution, u = (1 / 2 pi G) [(1 - nu)/r + nu x²/r³, nu xy/r³,
        (1 - 2 nu) x / 2r²] for a unit force along x, integrated over the element in closed form;
        Johnson, Contact Mechanics, section 3.6.
    """
    nu = material.poisson
    scale = 1.0 / (2.0 * math.pi * shear_modulus_mpa(material))
    x, y = _lags_mm(rows, columns, pitch_mm)
    # Element integrals of y²/r³ and x²/r³ ; their sum, 1/r, is Love's.
    over_x = _element_mean(lambda u, v: u * torch.asinh(v / u.abs()), x, y, pitch_mm)
    over_y = _element_mean(lambda u, v: v * torch.asinh(u / v.abs()), x, y, pitch_mm)
    mixed = _element_mean(lambda u, v: -torch.hypot(u, v), x, y, pitch_mm)
    sink_x = _element_mean(
        lambda u, v: v * torch.hypot(u, v).log() + u * torch.atan(v / u), x, y, pitch_mm
    )
    sink_y = _element_mean(
        lambda u, v: u * torch.hypot(u, v).log() + v * torch.atan(u / v), x, y, pitch_mm
    )
    return ShearKernel(
        xx=scale * ((1 - nu) * over_x + over_y),
        yy=scale * (over_x + (1 - nu) * over_y),
        xy=scale * nu * mixed,
        zx=scale * (0.5 - nu) * sink_x,
        zy=scale * (0.5 - nu) * sink_y,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Radial:
    """A kernel by distance: u = [even I + split (2 rr - I)] t along the surface, w = sink r·t.

    Here r is the unit vector from the force to the point; all are [mm/N] at each distance.
    """

    even: Tensor
    split: Tensor
    sink: Tensor


def _far_part(r_mm: Tensor, material: GelMaterial) -> _Radial:
    """Smooth far part of a half-space's kernel, equal to it far beyond the thickness h.

    Cerruti's surface kernel is I/r - nu grad grad r. Its far part has erf(r/h)/r for 1/r, and for r
    the F with F' = erf(r/h); the coupling's 1/r has (1 - e^(-r²/h²))/r.
    """
    nu, h = material.poisson, material.thickness_mm
    scale = 1.0 / (2.0 * math.pi * shear_modulus_mpa(material))
    x = (r_mm / h).clamp(min=1e-4)  # flat to 1e-8 below
    first = torch.special.erf(x) / x
    second = 2.0 / math.sqrt(math.pi) * torch.exp(-x * x)
    return _Radial(
        even=scale / h * (first - 0.5 * nu * (first + second)),
        split=scale / h * (-0.5 * nu) * (second - first),
        sink=scale / h * (0.5 - nu) * -torch.expm1(-x * x) / x,
    )


def _remainder(r_mm: Tensor, material: GelMaterial) -> _Radial:
    """Kernel of the layer less the near part of a half-space, smooth in both spaces.

    Hankel transforms by Gauss-Legendre on radii h/64 apart, then cubic splines, so that the cost
    does not depend on the grid.
    """
    h, nu, modulus = material.thickness_mm, material.poisson, shear_modulus_mpa(material)
    nodes, weights = _quadrature(400)
    q = torch.from_numpy(nodes + 1.0) * (0.5 * _WAVES / h)
    step = q * torch.from_numpy(weights) * (0.5 * _WAVES / h) / (2.0 * math.pi)
    a = 0.5 * q * h
    bell = torch.exp(-a * a)
    near = torch.special.erf(a)
    curved = near - 2.0 * a / math.sqrt(math.pi) * bell
    along = longitudinal_compliance(q, material) - (near - nu * curved) / (modulus * q)
    across = transverse_compliance(q, material) - near / (modulus * q)
    sink = coupling_compliance(q, material)
    sink = sink + (0.5 - nu) * (1.0 - bell) / (modulus * q)
    radii = np.arange(0.0, _REACH + 1e-9, 1.0 / 64.0) * h
    phase = torch.from_numpy(radii)[:, None] * q
    j0, j1 = torch.special.bessel_j0(phase), torch.special.bessel_j1(phase)
    j2 = torch.where(phase > 1e-6, 2.0 * j1 / phase.clamp(min=1e-6) - j0, 0.125 * phase**2)

    def at_radii(values: Tensor) -> Tensor:
        spline = CubicSpline(radii, values.numpy(), extrapolate=False)
        return torch.from_numpy(np.nan_to_num(spline(r_mm.numpy())))

    return _Radial(
        even=at_radii(j0 @ (0.5 * (along + across) * step)),
        split=at_radii(-(j2 @ (0.5 * (along - across) * step))),
        sink=at_radii(-(j1 @ (sink * step))),
    )


def _smooth_part(x: Tensor, y: Tensor, material: GelMaterial) -> ShearKernel:
    """Kernel of the layer less that of the half-space, per force, at points (x, y) [mm/N]."""
    r = torch.hypot(x, y)
    rest, far = _remainder(r, material), _far_part(r, material)
    even, split, sink = rest.even - far.even, rest.split - far.split, rest.sink - far.sink
    safe = r.clamp(min=1e-12)
    cosine, sine = x / safe, y / safe
    return ShearKernel(
        xx=even + split * (cosine**2 - sine**2),
        yy=even - split * (cosine**2 - sine**2),
        xy=split * 2.0 * cosine * sine,
        zx=sink * cosine,
        zy=sink * sine,
    )


@lru_cache(maxsize=16)
def shear_kernel(material: GelMaterial, rows: int, columns: int, pitch_mm: float) -> ShearKernel:
    """Bonded layer under uniform traction on one square element.

    The kernel of the layer is that of a half-space in closed form, and a smooth rest, integrated
    over the element by two Gauss points each way. The rest is Ewald's split, as for pressure: the
    half-space's far part in real space, the layer less the near part in Fourier space. The near
    parts' transforms are (erf(qh/2) - nu m)/(Gq) along q, with m = erf(qh/2) -
    (qh/sqrt(pi)) e^(-q²h²/4), erf(qh/2)/(Gq) across, and the coupling's times 1 - e^(-q²h²/4).
    Along and across meet at q = 0, so that no direction is left there.
    """
    kernel = half_space_kernel(rows, columns, pitch_mm, material)
    if math.isinf(material.thickness_mm):
        return kernel
    x, y = _lags_mm(rows, columns, pitch_mm)
    offset, weight = pitch_mm / (2.0 * math.sqrt(3.0)), 0.25 * pitch_mm**2
    points = [(dx, dy) for dx in (-offset, offset) for dy in (-offset, offset)]
    parts = [_smooth_part(x + dx, y + dy, material) for dx, dy in points]
    names = ("xx", "yy", "xy", "zx", "zy")
    sums = {name: weight * sum(getattr(part, name) for part in parts) for name in names}
    return ShearKernel(**{name: getattr(kernel, name) + sums[name] for name in names})


@dataclass(frozen=True, kw_only=True)
class ShearSpectrum:
    """Kernels ready for zero-padded convolution on one grid.

    Attributes:
        size: Rows and columns of the grid.
        padded: Rows and columns of the transform.
        xx, yy, xy: Real transforms, (padded[0], padded[1] // 2 + 1) [mm/MPa].
        zx, zy: Imaginary parts of the coupling's transforms, which are imaginary.
    """

    size: tuple[int, int]
    padded: tuple[int, int]
    xx: Tensor
    yy: Tensor
    xy: Tensor
    zx: Tensor
    zy: Tensor

    def apply(self, traction_mpa: Tensor) -> Tensor:
        """Displacement along the surface, (B, 2, H, W) [mm], under traction of the same shape."""
        wave = self._forward(traction_mpa)
        x, y = wave[:, 0], wave[:, 1]
        moved = torch.stack([self.xx * x + self.xy * y, self.xy * x + self.yy * y], 1)
        return self._back(moved)

    def sink(self, traction_mpa: Tensor) -> Tensor:
        """Displacement into the gel, (B, H, W) [mm], under traction (B, 2, H, W)."""
        wave = self._forward(traction_mpa)
        return self._back(1j * (self.zx * wave[:, 0] + self.zy * wave[:, 1]))

    def spread(self, pressure_mpa: Tensor) -> Tensor:
        """Displacement along the surface, (B, 2, H, W) [mm], under pressure (B, H, W)."""
        wave = self._forward(pressure_mpa)
        return self._back(torch.stack([-1j * self.zx * wave, -1j * self.zy * wave], 1))

    @cached_property
    def largest(self) -> float:
        """A bound of the displacement per traction of any pattern on the grid [mm/MPa]."""
        mean, half = 0.5 * (self.xx + self.yy), 0.5 * (self.xx - self.yy)
        return float((mean + torch.hypot(half, self.xy)).max())

    def _forward(self, grid: Tensor) -> Tensor:
        # Axis by axis: padded rows are zero before, and not needed after.
        wave = torch.fft.rfft(grid, n=self.padded[1], dim=-1)
        return torch.fft.fft(wave, n=self.padded[0], dim=-2)

    def _back(self, wave: Tensor) -> Tensor:
        wave = torch.fft.ifft(wave, dim=-2)[..., : self.size[0], :]
        return torch.fft.irfft(wave, n=self.padded[1], dim=-1)[..., : self.size[1]]


def _transform(kernel: Tensor, padded: tuple[int, int], sign: tuple[int, int]) -> Tensor:
    """Transform of a kernel for lags >= 0, even (sign 1) or odd (sign -1) in rows and columns."""
    rows, columns = kernel.shape
    lags = torch.zeros(padded, dtype=torch.float64)
    lags[:rows, :columns] = kernel
    if rows > 1:
        lags[-(rows - 1) :] = sign[0] * lags[1:rows].flip(0)
    if columns > 1:
        lags[:, -(columns - 1) :] = sign[1] * lags[:, 1:columns].flip(1)
    return torch.fft.rfft2(lags)


def shear_spectrum_from(
    kernel: ShearKernel, dtype: torch.dtype, device: torch.device
) -> ShearSpectrum:
    """Spectrum of kernels on a grid of their size."""
    rows, columns = kernel.xx.shape
    padded = next_fast_len(2 * rows - 1, real=True), next_fast_len(2 * columns - 1, real=True)

    def as_given(values: Tensor) -> Tensor:
        return values.to(device=device, dtype=dtype).contiguous()

    return ShearSpectrum(
        size=(rows, columns),
        padded=padded,
        xx=as_given(_transform(kernel.xx, padded, (1, 1)).real),
        yy=as_given(_transform(kernel.yy, padded, (1, 1)).real),
        xy=as_given(_transform(kernel.xy, padded, (-1, -1)).real),
        zx=as_given(_transform(kernel.zx, padded, (1, -1)).imag),
        zy=as_given(_transform(kernel.zy, padded, (-1, 1)).imag),
    )
