"""One grid of a cascade: each contact solved in its box, and the surface of the whole grid.

On a CPU, contacts are solved one by one (``sim.gel.fine.single``); accelerators use the plain
solver (``sim.gel.contact_solver``).

A box is the part of a grid around a contact, to which its solve is limited. Not here: the order of
the grids (``sim.gel.fine.fine``).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import torch
from scipy.fft import next_fast_len
from torch import Tensor

from cltp.gel.compliance import GelMaterial, kernel_of
from sim.gel.compliance import Spectrum, spectrum_from
from sim.gel.contact_solver import Solution, solve
from sim.gel.fine.single import BoxCompliance, box_compliance, convolution, solve_single
from sim.gel.gap import NO_BODY_MM
from sim.gel.layer import MAX_ITERATIONS, ElasticLayer

TOLERANCE = 1e-3
"""Tolerance of every level: residual gap over mean displacement in contact, root mean square."""

_MARGIN_CELLS = 2  # elements of the coarser grid around its contact
_STEP_CPU, _STEP_DEVICE = 16, 80  # on an accelerator few sizes, with many contacts each, are faster
_OVERLAP_MM = 2e-4  # allowed outside of a box; a fifth of the stored resolution


@dataclass(frozen=True, slots=True, kw_only=True)
class Box:
    """Part of a grid: first row and column, numbers of rows and columns."""

    top: int
    left: int
    rows: int
    columns: int

    def crop(self, field: Tensor) -> Tensor:
        """That part of a grid (..., H, W)."""
        return field[..., self.top : self.top + self.rows, self.left : self.left + self.columns]


def boxes_around(contact: Tensor) -> list[Box]:
    """Boxes on the next finer grid around contacts (B, h, w); the whole grid where there is none.

    Sizes are multiples of a step, so that many contacts share a spectrum; the multiples are lengths
    that suit a Fourier transform.
    """
    step = _STEP_CPU if contact.device.type == "cpu" else _STEP_DEVICE
    row_spans = _spans(contact.any(2).cpu(), step)
    column_spans = _spans(contact.any(1).cpu(), step)
    return [
        Box(top=vertical[0], rows=vertical[1], left=horizontal[0], columns=horizontal[1])
        for vertical, horizontal in zip(row_spans, column_spans, strict=True)
    ]


def _spans(mask: Tensor, step: int) -> list[tuple[int, int]]:
    """First element and length, on the finer grid, of a span around each row of ``mask`` (B, n)."""
    size = mask.shape[1]
    spans = []
    for row in mask.numpy():
        occupied = row.nonzero()[0]
        low, high = (occupied[0], occupied[-1] + 1) if len(occupied) else (0, size)
        low, high = max(0, int(low) - _MARGIN_CELLS), min(size, int(high) + _MARGIN_CELLS)
        steps = next_fast_len(-(-2 * (high - low) // step), real=True)
        length = min(2 * size, steps * step)
        first = max(0, low + high - length // 2)
        spans.append((min(first, 2 * size - length), length))
    return spans


def escaped_from(boxes: list[Box], opening: Tensor) -> Tensor:
    """Mask of contacts that overlap their bodies outside of their boxes, (B,).

    Args:
        boxes: Boxes of the contacts.
        opening: Deformed gap, (B, H, W) [mm].
    """
    overlap = opening < -_OVERLAP_MM
    for box, one in zip(boxes, overlap, strict=True):
        box.crop(one).fill_(False)
    return overlap.flatten(1).any(1)


@lru_cache(maxsize=128)
def _spectrum(
    material: GelMaterial | None,
    grid: tuple[int, int, float],
    size: tuple[int, int],
    dtype: torch.dtype,
    device: torch.device,
) -> Spectrum:
    """Spectrum of a box within a grid (rows, columns, pitch): a corner of the grid's kernel."""
    return spectrum_from(kernel_of(material, *grid)[: size[0], : size[1]], dtype, device)


@lru_cache(maxsize=512)
def _compliance(
    material: GelMaterial | None,
    grid: tuple[int, int, float],
    size: tuple[int, int],
    dtype: torch.dtype,
) -> BoxCompliance:
    """The same for one contact on a CPU."""
    return box_compliance(kernel_of(material, *grid)[: size[0], : size[1]], dtype)


@dataclass(frozen=True, slots=True, kw_only=True)
class GridLevel:
    """One grid of the cascade, and E* of each pressing body (None: rigid)."""

    layer: ElasticLayer
    moduli_mpa: Tensor | None

    @property
    def _grid(self) -> tuple[int, int, float]:
        return self.layer.rows, self.layer.columns, self.layer.pitch_mm

    def _spectrum_of(self, size: tuple[int, int], chosen: Tensor, *, with_body: bool) -> Spectrum:
        layer = self.layer
        gel = _spectrum(layer.material, self._grid, size, layer.dtype, layer.device)
        if self.moduli_mpa is None or not with_body:
            return gel
        body = _spectrum(None, self._grid, size, layer.dtype, layer.device)
        inverse = (1.0 / self.moduli_mpa[chosen])[:, None, None]
        return replace(gel, values=gel.values + inverse * body.values)

    def _compliance_of(
        self, size: tuple[int, int], index: int, *, with_body: bool
    ) -> BoxCompliance:
        gel = _compliance(self.layer.material, self._grid, size, self.layer.dtype)
        if self.moduli_mpa is None or not with_body:
            return gel
        body = _compliance(None, self._grid, size, self.layer.dtype)
        return gel.in_series(body, 1.0 / float(self.moduli_mpa[index]))

    def surface(self, solved: Solution, gap: Tensor) -> tuple[Tensor, Tensor]:
        """Surface of the gel, and the deformed gap between it and the body, both (B, H, W)."""
        height = self._displacement(solved.pressure_mpa, with_body=False)
        total = height
        if self.moduli_mpa is not None:
            total = self._displacement(solved.pressure_mpa, with_body=True)
        return height, total + gap - solved.approach_mm[:, None, None]

    def short_wave_fraction(self) -> Tensor | float:
        """Fraction of the gel in the residual, whose waves are short: as for two half-spaces."""
        if self.moduli_mpa is None:
            return 1.0
        gel = 1.0 / self.layer.material.plane_strain_mpa
        return (gel / (gel + 1.0 / self.moduli_mpa))[:, None, None]

    def _displacement(self, pressure_mpa: Tensor, *, with_body: bool) -> Tensor:
        size = (self.layer.rows, self.layer.columns)
        if self.layer.device.type == "cpu":
            return torch.stack(
                [
                    convolution(self._compliance_of(size, index, with_body=with_body)).apply(one)
                    for index, one in enumerate(pressure_mpa)
                ]
            )
        # In parts: the padded spectra of all would not fit.
        parts = torch.arange(len(pressure_mpa), device=self.layer.device).split(256)
        return torch.cat(
            [
                self._spectrum_of(size, part, with_body=with_body).apply(pressure_mpa[part])
                for part in parts
            ]
        )

    def solve(self, boxes: list[Box], gap: Tensor, depth: Tensor, start: Tensor) -> Solution:
        """Solve every contact in its box.

        Args:
            boxes: A box for each contact.
            gap: (B, H, W), ``NO_BODY_MM`` where no pressure can act [mm].
            depth: (B,) [mm].
            start: (B, H, W) [MPa].
        """
        one_by_one = gap.device.type == "cpu"
        return (self._solve_single if one_by_one else self._solve_batches)(boxes, gap, depth, start)

    def _solve_single(
        self, boxes: list[Box], gap: Tensor, depth: Tensor, start: Tensor
    ) -> Solution:
        pressure = torch.zeros_like(start)
        solved = []
        for index, box in enumerate(boxes):
            compliance = self._compliance_of((box.rows, box.columns), index, with_body=True)
            one = solve_single(
                compliance,
                box.crop(gap[index]),
                float(depth[index]),
                start_mpa=box.crop(start[index]),
                tol=TOLERANCE,
                max_iterations=MAX_ITERATIONS,
            )
            box.crop(pressure[index]).copy_(one.pressure_mpa)
            solved.append(one)
        return Solution(
            pressure_mpa=pressure,
            approach_mm=depth.clone(),
            iterations=torch.tensor([one.iterations for one in solved]),
            converged=torch.tensor([one.converged for one in solved]),
        )

    def _solve_batches(
        self, boxes: list[Box], gap: Tensor, depth: Tensor, start: Tensor
    ) -> Solution:
        """Solve contacts with equally large boxes together."""
        pressure = torch.zeros_like(start)
        iterations = torch.zeros(len(depth), dtype=torch.int64, device=gap.device)
        converged = torch.ones(len(depth), dtype=torch.bool, device=gap.device)
        groups: dict[tuple[int, int], list[int]] = {}
        for i, box in enumerate(boxes):
            groups.setdefault((box.rows, box.columns), []).append(i)
        for size, indices in groups.items():
            chosen = torch.tensor(indices, device=gap.device)
            first = torch.stack([boxes[i].crop(start[i]) for i in indices])
            inside = torch.stack([boxes[i].crop(gap[i]) for i in indices])
            solved = solve(
                self._spectrum_of(size, chosen, with_body=True),
                inside,
                depth[chosen],
                by_force=False,
                start_mpa=first.clamp(min=0) * (inside < NO_BODY_MM),
                stiffness=self.layer.stiffness,
                tol=TOLERANCE,
                max_iterations=MAX_ITERATIONS,
            )
            for position, i in enumerate(indices):
                boxes[i].crop(pressure[i]).copy_(solved.pressure_mpa[position])
            iterations[chosen], converged[chosen] = solved.iterations, solved.converged
        return Solution(
            pressure_mpa=pressure,
            approach_mm=depth.clone(),
            iterations=iterations,
            converged=converged,
        )
