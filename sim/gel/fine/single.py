"""One contact at a time on a CPU, pressed to a depth: preconditioned conjugate gradients.

The compliance is far larger for long waves than for short ones, so that plain conjugate gradients
(``sim.gel.contact_solver``) need more steps on finer grids. Here the residual is first divided by
the compliance of a periodic box; three or four steps then suffice on any grid. Elements that
overlap the body join the contact at once, without a restart.

Not here: batches, forces, accelerators (``sim.gel.contact_solver``), levels and boxes
(``sim.gel.fine.fine``).

Source: Vollebregt (2014), J. Comput. Phys. 257, 333-351, for the preconditioner and for keeping
the direction while the contact changes. The stop is that of ``sim.gel.contact_solver``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import torch
from scipy.fft import dctn, next_fast_len
from torch import Tensor

_MIN_FRACTION = 1e-4  # smallest fraction of the largest compliance: bounds the preconditioner
_FIRST_STEP = 0.8  # fraction of the first correction; the whole of it mostly overshoots


@dataclass(frozen=True, slots=True, kw_only=True)
class BoxCompliance:
    """The transformed kernel of one contact in a box of (rows, columns) elements.

    In the spectra rows are the inner axis, as they are used, and every value stands twice, for the
    real and for the imaginary part.

    Attributes:
        size: Rows and columns of the box.
        padded: Rows and columns of the transform, even, each at least twice the box's less 1.
        values: Transform of the kernel, (padded[1] // 2 + 1, 2 padded[0]) [mm/MPa].
        periodic: Transform of the kernel of the box as if it were periodic, shape
            (columns // 2 + 1, 2 rows) [mm/MPa].
    """

    size: tuple[int, int]
    padded: tuple[int, int]
    values: Tensor
    periodic: Tensor

    def in_series(self, other: BoxCompliance, factor: float) -> BoxCompliance:
        """Both in series: this one and ``factor`` times another one for the same box."""
        return replace(
            self,
            values=self.values + factor * other.values,
            periodic=self.periodic + factor * other.periodic,
        )


def box_compliance(kernel: Tensor, dtype: torch.dtype) -> BoxCompliance:
    """Transform a kernel for lags >= 0, (rows, columns), for a box of that size."""
    rows, columns = kernel.shape
    padded_rows, padded_columns = (2 * next_fast_len(n, real=True) for n in (rows, columns))
    # The kernel is even, so that a cosine transform over lags >= 0 is complete.
    half = torch.zeros(padded_rows // 2 + 1, padded_columns // 2 + 1, dtype=torch.float64)
    half[:rows, :columns] = kernel
    waves = torch.from_numpy(dctn(half.numpy(), type=1))
    down, across = torch.arange(rows), torch.arange(columns)
    nearest = kernel[torch.minimum(down, rows - down)][:, torch.minimum(across, columns - across)]
    periodic = torch.fft.rfft2(nearest).real
    periodic = periodic.clamp(min=_MIN_FRACTION * float(periodic.max()))
    return BoxCompliance(
        size=(rows, columns),
        padded=(padded_rows, padded_columns),
        values=_repeated(torch.cat([waves, waves[1:-1].flip(0)]), dtype),
        periodic=_repeated(periodic, dtype),
    )


def _repeated(values: Tensor, dtype: torch.dtype) -> Tensor:
    """(H, W) -> (W, 2 H), every value twice."""
    return values.T.to(dtype).repeat_interleave(2, dim=1).contiguous()


class Convolution:
    """Zero-padded convolution with one real spectrum, with reused buffers.

    The rows of the field are transformed first, without the padded ones; then the columns, stored
    as rows.
    """

    def __init__(self, values: Tensor, size: tuple[int, int], padded: tuple[int, int]) -> None:
        # ``values``: (padded columns // 2 + 1, 2 padded rows), for fields of ``size``.
        self.padded = padded
        self._values, (self._rows, self._columns) = values, size
        self._field = values.new_zeros(size[0], padded[1])
        self._waves = torch.zeros(
            padded[1] // 2 + 1, padded[0], dtype=values.dtype.to_complex(), device=values.device
        )

    def apply(self, field: Tensor) -> Tensor:
        """Convolve a field (rows, columns)."""
        self._field[:, : self._columns] = field
        self._waves[:, : self._rows] = torch.fft.rfft(self._field).T
        waves = torch.fft.fft(self._waves)
        torch.view_as_real(waves).view_as(self._values).mul_(self._values)
        waves = torch.fft.ifft(waves)[:, : self._rows]
        return torch.fft.irfft(waves.T, n=self.padded[1])[:, : self._columns]


def convolution(compliance: BoxCompliance) -> Convolution:
    """The convolution from pressure [MPa] to displacement [mm]."""
    return Convolution(compliance.values, compliance.size, compliance.padded)


@dataclass(frozen=True, slots=True, kw_only=True)
class SingleSolution:
    """Pressure of one contact.

    Attributes:
        pressure_mpa: (H, W) [MPa].
        iterations: Number of iterations.
        converged: False if ``max_iterations`` stopped it.
    """

    pressure_mpa: Tensor
    iterations: int
    converged: bool


def solve_single(
    compliance: BoxCompliance,
    gap_mm: Tensor,
    depth_mm: float,
    *,
    start_mpa: Tensor,
    tol: float,
    max_iterations: int,
) -> SingleSolution:
    """Solve one contact by depth.

    Args:
        compliance: Compliance of the two surfaces together.
        gap_mm: Undeformed gap, (H, W) [mm].
        depth_mm: Approach [mm].
        start_mpa: First guess, (H, W) [MPa]; used only where the body comes below the undeformed
            surface.
        tol: Root mean square of the residual gap over the mean displacement in contact.
        max_iterations: Bound of the iterations.
    """
    deform = convolution(compliance)
    precondition = Convolution(compliance.periodic.reciprocal(), compliance.size, compliance.size)
    above = gap_mm - depth_mm
    pressure = torch.where(above < 0, start_mpa.clamp(min=0), 0.0)
    direction, previous, power = torch.zeros_like(above), torch.zeros_like(above), torch.inf
    if not bool((above < 0).any()):
        return SingleSolution(pressure_mpa=pressure, iterations=0, converged=True)
    displacement = deform.apply(pressure)
    for step in range(max_iterations + 1):
        opening = displacement + above
        touched = pressure > 0
        pressed = touched.to(above.dtype)
        count = max(float(pressed.sum()), 1.0)
        mean = _dot(displacement, pressed) / count
        residual = torch.where(touched, opening, opening.clamp(max=0))
        done = _dot(residual, residual) <= count * (tol * mean) ** 2
        if done or step == max_iterations:
            break
        free = (residual != 0).to(above.dtype)
        correction = precondition.apply(residual).mul_(free)
        if step == 0:
            pressure = pressure.sub_(correction, alpha=_FIRST_STEP).clamp_(min=0)
            displacement = deform.apply(pressure)
            continue
        # Polak and Ribière's rule drops the old direction by itself where the contact has changed.
        conjugacy = max(0.0, _dot(correction, torch.sub(residual, previous, out=previous)) / power)
        torch.add(correction, direction.mul_(free), alpha=conjugacy, out=direction)
        previous, power = residual, _dot(correction, residual)
        response = deform.apply(direction)
        length = _dot(residual, direction) / max(_dot(response, direction), 1e-30)
        pressure = pressure.sub_(direction, alpha=length)
        if float(pressure.amin()) < 0:
            pressure = pressure.clamp_(min=0)
            displacement = deform.apply(pressure)
        else:
            displacement = displacement.sub(response, alpha=length)
    return SingleSolution(pressure_mpa=pressure, iterations=step, converged=done)


def _dot(first: Tensor, second: Tensor) -> float:
    return float(torch.dot(first.flatten(), second.flatten()))
