"""Convolution of a pressure with the compliance of a surface, by zero-padded FFT.

Not here: the kernels (``cltp.gel.compliance``); the pressure of a contact
(``sim.gel.contact_solver``); traction along the surface (``sim.gel.shear``).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import torch
from scipy.fft import next_fast_len
from torch import Tensor

from cltp.gel.compliance import GelMaterial, kernel_of


@dataclass(frozen=True, slots=True, kw_only=True)
class Spectrum:
    """A kernel ready for zero-padded convolution on one grid.

    Attributes:
        size: Rows and columns of the grid.
        padded: Rows and columns of the transform, each at least twice the grid's less 1.
        values: Transform of the kernel, real because the kernel is even. Shape
            (padded[0], padded[1] // 2 + 1), or with a leading batch (B, ...) [mm/MPa].
    """

    size: tuple[int, int]
    padded: tuple[int, int]
    values: Tensor

    def apply(self, pressure_mpa: Tensor) -> Tensor:
        """Displacement (B, rows, columns) [mm] under ``pressure_mpa`` of the same shape."""
        if pressure_mpa.shape[0] < 2 or pressure_mpa.device.type != "cpu":
            return self._apply(pressure_mpa, self.values)
        # One by one: rounding of a CPU's FFT depends on the size of the batch, and one fits its
        # cache.
        displacement = torch.empty_like(pressure_mpa)
        for i in range(len(pressure_mpa)):
            values = self.values if self.values.ndim == 2 else self.values[i : i + 1]
            displacement[i : i + 1] = self._apply(pressure_mpa[i : i + 1], values)
        return displacement

    def _apply(self, pressure_mpa: Tensor, values: Tensor) -> Tensor:
        # Axis by axis: padded rows are zero before and not needed after, so that the transforms
        # along x run over the real rows only.
        wave = torch.fft.rfft(pressure_mpa, n=self.padded[1], dim=-1)
        wave = torch.fft.fft(wave, n=self.padded[0], dim=-2)
        wave *= values
        wave = torch.fft.ifft(wave, dim=-2)[..., : self.size[0], :]
        return torch.fft.irfft(wave, n=self.padded[1], dim=-1)[..., : self.size[1]]

    def select(self, index: Tensor) -> Spectrum:
        """The same convolution for some elements of the batch."""
        if self.values.ndim == 2:
            return self
        return replace(self, values=self.values[index])


@lru_cache(maxsize=32)
def spectrum_of(
    material: GelMaterial | None,
    rows: int,
    columns: int,
    pitch_mm: float,
    dtype: torch.dtype,
    device: torch.device,
) -> Spectrum:
    """Spectrum of a material's kernel; ``None`` is the half-space with E* = 1 MPa."""
    return spectrum_from(kernel_of(material, rows, columns, pitch_mm), dtype, device)


def spectrum_from(kernel: Tensor, dtype: torch.dtype, device: torch.device) -> Spectrum:
    """Spectrum of a kernel for lags >= 0, (rows, columns), on a grid of that size."""
    rows, columns = kernel.shape
    # Factors 2, 3 and 5 only: a little longer, but twice as fast as with 7 and 11.
    padded = next_fast_len(2 * rows - 1, real=True), next_fast_len(2 * columns - 1, real=True)
    lags = torch.zeros(padded, dtype=torch.float64)
    lags[:rows, :columns] = kernel
    if rows > 1:
        lags[-(rows - 1) :] = lags[1:rows].flip(0)
    if columns > 1:
        lags[:, -(columns - 1) :] = lags[:, 1:columns].flip(1)
    values = torch.fft.rfft2(lags).real.to(device=device, dtype=dtype).contiguous()
    return Spectrum(size=(rows, columns), padded=padded, values=values)
