"""The compliance of gel and body together, on the part of a grid where they touch.

A convolution needs no more than the contact: a box around it costs a fraction of the grid.

Not here: the kernels themselves (``sim.gel.shear.kernels``).
"""

from __future__ import annotations

from functools import lru_cache

import torch
from torch import Tensor

from cltp.gel.compliance import GelMaterial
from sim.gel.shear.kernels import ShearKernel, ShearSpectrum, shear_kernel, shear_spectrum_from

_BOX_MULTIPLE = 6
"""Sides of a box are multiples of this [elements], so that few spectra are made."""


def box_around(contact: Tensor) -> tuple[slice, slice]:
    """Rows and columns around the contacts (B, H, W) of a batch."""
    touched = contact.any(0)
    return _range(touched.any(1)), _range(touched.any(0))


def _range(touched: Tensor) -> slice:
    """Range of a multiple of some elements, where there is room, around those that are True."""
    size = len(touched)
    index = torch.nonzero(touched).flatten()
    if not len(index):
        return slice(0, min(size, _BOX_MULTIPLE))
    first, last = int(index[0]), int(index[-1])
    length = min(size, -(-(last + 1 - first) // _BOX_MULTIPLE) * _BOX_MULTIPLE)
    begin = min(first, size - length)
    return slice(begin, begin + length)


@lru_cache(maxsize=64)
def pair_spectrum(
    material: GelMaterial,
    body: GelMaterial | None,
    grid: tuple[int, int],
    size: tuple[int, int],
    pitch_mm: float,
    dtype: torch.dtype,
    device: torch.device,
) -> ShearSpectrum:
    """Spectrum of gel and body for a part of ``size`` of a ``grid``.

    Traction on the body is opposite to that on the gel, pressure is the same: what the coupling
    moves on one counts against the other.
    """
    kernel = shear_kernel(material, *grid, pitch_mm)
    if body is not None:
        other = shear_kernel(body, *grid, pitch_mm)
        kernel = ShearKernel(
            xx=kernel.xx + other.xx,
            yy=kernel.yy + other.yy,
            xy=kernel.xy + other.xy,
            zx=kernel.zx - other.zx,
            zy=kernel.zy - other.zy,
        )
    rows, columns = size
    part = ShearKernel(
        xx=kernel.xx[:rows, :columns],
        yy=kernel.yy[:rows, :columns],
        xy=kernel.xy[:rows, :columns],
        zx=kernel.zx[:rows, :columns],
        zy=kernel.zy[:rows, :columns],
    )
    return shear_spectrum_from(part, dtype, device)
