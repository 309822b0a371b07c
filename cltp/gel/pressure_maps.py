"""Maps of the pressure that explains heights, in Fourier space: what the gel has blurred, undone.

A gel rounds what is pressed into it: its compliance damps waves by their wavenumber. The pressure
under it has the sharp outlines and the texture of the body. Noise has them too, so that waves are
undone only as far as they are larger than it, which is different for each map.

Not here: the force of a contact (``cltp.gel.pressure``), which needs its outline.

Source: Wiener deconvolution; the compliance is that of ``cltp.gel.compliance``.
"""

from __future__ import annotations

from functools import lru_cache

import torch
from torch import Tensor

from cltp.gel.compliance import layer_kernel
from cltp.gel.pressure import NOMINAL_GEL, UNIT_MM
from cltp.tactile.point_layout import GRID

DAMPED = (0.003, 0.02)
"""Compliances, as fractions of the largest, of the waves that each map has half of. Our choice, by
1,000 steps of 64 contacts: one map alone, 0.006, and three, 0.001, 0.006 and 0.03, learn less."""

PITCH_MM = 0.2
"""Edge of a cell that the compliance is computed for [mm]. A grid of other cells gets the maps of
as many cells of this size."""

PADDED = (96, 120)
"""Rows and columns with the zeros around a grid, beyond which waves come in again on the other
side. Our choice: 4 mm, the gel's thickness, and products of small primes."""

UNIT_MPA = 0.05
"""Pressure that is 1 in a map [MPa]: a common size with the other channels."""


def pressure_maps(heights: Tensor) -> Tensor:
    """Pressures under scaled heights on a grid: shape (B, maps, rows, columns), ``UNIT_MPA``.

    Args:
        heights: Shape (B, rows, columns), scaled, 0 outside the pad.
    """
    rows, columns = heights.shape[-2:]
    waves = torch.fft.rfft2(heights.float(), s=PADDED)[:, None] * _filters(heights.device)
    return torch.fft.irfft2(waves, s=PADDED)[..., :rows, :columns]


@lru_cache(maxsize=4)
def _filters(device: torch.device) -> Tensor:
    """Pressure over scaled height of every wave, for each map: (maps, rows, columns / 2 + 1)."""
    kernel = layer_kernel(GRID.rows, GRID.columns, PITCH_MM, NOMINAL_GEL)
    down, along = (torch.arange(size) for size in PADDED)
    down, along = (torch.minimum(lag, len(lag) - lag) for lag in (down, along))
    compliance = torch.fft.rfft2(kernel[down][:, along]).real
    damped = [fraction * compliance.max() for fraction in DAMPED]
    filters = [compliance / (compliance**2 + least**2) for least in damped]
    return torch.stack(filters).mul(UNIT_MM / UNIT_MPA).float().to(device)
