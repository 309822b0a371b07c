"""Presses at a sensor's own resolution: coarse first, then only where there is contact.

A contact is solved on a grid four times coarser, then twice, then at full resolution, each time
starting from the one before and only within the box that holds the contact; the whole surface
follows from one convolution. Where a rigid body touches, the surface is the body's: what is left
of the solver's residual is taken away there. A contact that leaves its box is solved again on the
whole field, so that the shortcut never decides anything.

How far this is from the solve on the whole grid is measured by ``tacgrasp bench tcl3d``.

Not here: the solver (``sim.contact``), materials and the plain press (``sim.gel``).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import torch
from torch import Tensor
from torch.nn.functional import avg_pool2d, interpolate

from sim.boxes import Box, boxes_around, by_size, escaped_from
from sim.compliance import GelMaterial, Spectrum, layer_kernel, love_kernel, spectrum_from
from sim.contact import NO_BODY_MM, Solution, solve
from sim.gel import ElasticLayer, Press

TOLERANCE = 1e-3
"""Of every level: residual gap over the mean displacement in contact, root mean square."""

_FEWEST_CELLS = 24  # along the shorter side of the coarsest grid
_MARGIN_CELLS = 2  # of the coarser grid, around its contact
_BOX_STEP_CPU, _BOX_STEP_DEVICE = (
    16,
    80,
)  # an accelerator wants few sizes, and many contacts of each
_OVERLAP_MM = 2e-4  # outside of a box; a fifth of what is stored


@lru_cache(maxsize=24)
def _kernel(material: GelMaterial | None, rows: int, columns: int, pitch_mm: float) -> Tensor:
    if material is None:
        return love_kernel(rows, columns, pitch_mm)
    return layer_kernel(rows, columns, pitch_mm, material)


@lru_cache(maxsize=512)
def _spectrum(
    material: GelMaterial | None,
    grid: tuple[int, int, float],
    size: tuple[int, int],
    dtype: torch.dtype,
    device: torch.device,
) -> Spectrum:
    """Of a box within a grid (rows, columns, pitch): a corner of the grid's kernel."""
    return spectrum_from(_kernel(material, *grid)[: size[0], : size[1]], dtype, device)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Level:
    """One grid of the cascade, and E* of each body that presses (None: rigid)."""

    layer: ElasticLayer
    moduli_mpa: Tensor | None

    def _spectrum_of(self, size: tuple[int, int], chosen: Tensor, *, both: bool) -> Spectrum:
        layer = self.layer
        grid = (layer.rows, layer.columns, layer.pitch_mm)
        gel = _spectrum(layer.material, grid, size, layer.dtype, layer.device)
        if self.moduli_mpa is None or not both:
            return gel
        body = _spectrum(None, grid, size, layer.dtype, layer.device)
        inverse = (1.0 / self.moduli_mpa[chosen])[:, None, None]
        return replace(gel, values=gel.values + inverse * body.values)

    def surface(self, solved: Solution, gap: Tensor) -> tuple[Tensor, Tensor]:
        """Surface of the gel, and the deformed gap between it and the body, both (B, H, W)."""
        height = self._displacement(solved.pressure_mpa, both=False)
        total = height
        if self.moduli_mpa is not None:
            total = self._displacement(solved.pressure_mpa, both=True)
        return height, total + gap - solved.approach_mm[:, None, None]

    def short_wave_share(self) -> Tensor | float:
        """Share of the gel in the residual, which is short against the gel: as of half-spaces."""
        if self.moduli_mpa is None:
            return 1.0
        gel = 1.0 / self.layer.material.plane_strain_mpa
        return (gel / (gel + 1.0 / self.moduli_mpa))[:, None, None]

    def _displacement(self, pressure_mpa: Tensor, *, both: bool) -> Tensor:
        size = (self.layer.rows, self.layer.columns)
        # A few at a time, for their padded spectra; one where a cache is what counts.
        few = 1 if self.layer.device.type == "cpu" else 256
        parts = torch.arange(len(pressure_mpa), device=self.layer.device).split(few)
        return torch.cat(
            [self._spectrum_of(size, part, both=both).apply(pressure_mpa[part]) for part in parts]
        )

    def solve(
        self, boxes: list[Box], gap: Tensor, load: Tensor, start: Tensor, *, by_force: bool
    ) -> Solution:
        """Solve every contact in its box; those whose boxes are equally large together.

        Args:
            boxes: One for each contact.
            gap: (B, H, W), ``NO_BODY_MM`` where no pressure can act [mm].
            load: (B,) [N] if ``by_force``, else [mm].
            start: (B, H, W) [MPa].
            by_force: Which of the two is given.
        """
        pressure = torch.zeros_like(gap)
        approach = torch.zeros_like(load)
        iterations = torch.zeros(len(load), dtype=torch.int64, device=gap.device)
        converged = torch.ones(len(load), dtype=torch.bool, device=gap.device)
        for size, members in by_size(boxes, one_by_one=gap.device.type == "cpu"):
            chosen = torch.tensor(members, device=gap.device)
            target = load[chosen]
            first = torch.stack([boxes[i].of(start[i]) for i in members])
            inside = torch.stack([boxes[i].of(gap[i]) for i in members])
            first = first.clamp(min=0) * (inside < NO_BODY_MM)
            if by_force:
                target = target / self.layer.pitch_mm**2
                total = first.flatten(1).sum(1).clamp(min=1e-30)
                first = first * (target / total)[:, None, None]
            solved = solve(
                self._spectrum_of(size, chosen, both=True),
                inside,
                target,
                by_force=by_force,
                start_mpa=first,
                stiffness=self.layer.stiffness,
                tol=TOLERANCE,
                max_iterations=300,
            )
            for place, i in enumerate(members):
                boxes[i].of(pressure[i]).copy_(solved.pressure_mpa[place])
            approach[chosen] = solved.approach_mm
            iterations[chosen], converged[chosen] = solved.iterations, solved.converged
        return Solution(
            pressure_mpa=pressure, approach_mm=approach, iterations=iterations, converged=converged
        )


class FineLayer:
    """A gel at a sensor's own resolution, ready to be pressed.

    Takes what ``ElasticLayer`` takes; two coarser grids need rows and columns divisible by 4.

    Raises:
        ValueError: A size, pitch, modulus or dtype makes no sense.
    """

    def __init__(
        self,
        material: GelMaterial,
        *,
        rows: int,
        columns: int,
        pitch_mm: float,
        body_modulus_mpa: float | Tensor | None = None,
        dtype: torch.dtype = torch.float32,
        device: torch.device | str = "cpu",
    ) -> None:
        self._modulus = body_modulus_mpa
        self._layers = [
            ElasticLayer(
                material,
                rows=rows // factor,
                columns=columns // factor,
                pitch_mm=pitch_mm * factor,
                body_modulus_mpa=body_modulus_mpa,
                dtype=dtype,
                device=device,
            )
            for factor in _factors(rows, columns)
        ]
        self.finest = self._layers[-1]

    def press_to_force(
        self, gap_mm: Tensor, force_n: Tensor | float, *, start: Press | Tensor | None = None
    ) -> Press:
        """Press with a given normal force; as ``ElasticLayer.press_to_force``.

        Args:
            gap_mm: (B, H, W) [mm].
            force_n: (B,) or one number [N].
            start: A similar press, or its pressure (B, H, W) [kPa]: the same body at less force.

        Raises:
            ValueError: A shape, sign or value makes no sense.
        """
        return self._press(gap_mm, force_n, start, by_force=True)

    def press_to_depth(
        self, gap_mm: Tensor, depth_mm: Tensor | float, *, start: Press | Tensor | None = None
    ) -> Press:
        """Press a body to a given depth; see ``ElasticLayer.press_to_depth``.

        Args:
            gap_mm: (B, H, W) [mm].
            depth_mm: (B,) or one number [mm].
            start: As for ``press_to_force``.

        Raises:
            ValueError: A shape, sign or value makes no sense.
        """
        return self._press(gap_mm, depth_mm, start, by_force=False)

    def _press(
        self,
        gap_mm: Tensor,
        load: Tensor | float,
        start: Press | Tensor | None,
        *,
        by_force: bool,
    ) -> Press:
        gap, loads = self.finest.checked(gap_mm, load, by_force=by_force)
        gaps = [gap]
        for _ in self._layers[1:]:
            gaps.insert(0, _coarser(gaps[0]))
        coarsest = self._layers[0]
        press = coarsest.press_to_force if by_force else coarsest.press_to_depth
        before = None if start is None else _pooled(start, gap.shape[1] // coarsest.rows)
        coarse = press(gaps[0], loads, start=before, tol=TOLERANCE)
        if len(self._layers) == 1:
            return coarse
        pressure, moduli = coarse.pressure_kpa * 1e-3, self._moduli(len(loads))
        for layer, finer in zip(self._layers[1:], gaps[1:], strict=True):
            level = _Level(layer=layer, moduli_mpa=moduli)
            boxes = boxes_around(pressure > 0)
            solved = level.solve(boxes, finer, loads, _finer(pressure), by_force=by_force)
            pressure = solved.pressure_mpa
        return _whole(level, gap, loads, boxes, solved, by_force=by_force)

    def _moduli(self, batch: int) -> Tensor | None:
        if self._modulus is None:
            return None
        modulus = torch.as_tensor(self._modulus, dtype=self.finest.dtype, device=self.finest.device)
        return modulus.reshape(-1).expand(batch)


def _whole(
    level: _Level,
    gap: Tensor,
    loads: Tensor,
    boxes: list[Box],
    solved: Solution,
    *,
    by_force: bool,
) -> Press:
    """The whole surface; contacts that reach out of their boxes are solved again."""
    height, opening = level.surface(solved, gap)
    escaped = escaped_from(boxes, opening)
    if bool(escaped.any()):
        field = Box(top=0, left=0, rows=gap.shape[1], columns=gap.shape[2])
        out = [field if one else box for one, box in zip(escaped.tolist(), boxes, strict=True)]
        again = level.solve(out, gap, loads, solved.pressure_mpa, by_force=by_force)
        solved = _chosen(escaped, again, solved)
        height, opening = level.surface(solved, gap)
    pressure = solved.pressure_mpa
    residual = torch.where(pressure > 0, opening, opening.clamp(max=0))
    loaded = (pressure > 0).flatten(1).any(1)[:, None, None]
    return Press(
        pressure_kpa=pressure * 1e3,
        height_mm=torch.where(loaded, height - level.short_wave_share() * residual, 0.0),
        force_n=pressure.flatten(1).sum(1) * level.layer.pitch_mm**2,
        depth_mm=solved.approach_mm,
        iterations=solved.iterations,
        converged=solved.converged,
    )


def _factors(rows: int, columns: int) -> list[int]:
    """How much coarser the grids are, coarsest first."""
    return [
        factor
        for factor in (4, 2, 1)
        if factor == 1
        or (
            rows % factor == 0
            and columns % factor == 0
            and min(rows, columns) // factor >= _FEWEST_CELLS
        )
    ]


def _coarser(gap: Tensor) -> Tensor:
    """Mean gap of four elements, of those where a body is: a thin body must not be lost."""
    there = (gap < NO_BODY_MM).to(gap.dtype)
    share = avg_pool2d(there[:, None], 2)[:, 0]
    mean = avg_pool2d((gap * there)[:, None], 2)[:, 0] / share.clamp(min=0.25)
    return torch.where(share > 0, mean, NO_BODY_MM)


def _finer(pressure: Tensor) -> Tensor:
    return interpolate(pressure[:, None], scale_factor=2, mode="bilinear", align_corners=False)[
        :, 0
    ]


def _pooled(start: Press | Tensor, factor: int) -> Tensor:
    pressure = start.pressure_kpa if isinstance(start, Press) else start
    return avg_pool2d(pressure[:, None], factor)[:, 0]


def _chosen(which: Tensor, these: Solution, others: Solution) -> Solution:
    """``these`` where ``which`` (B,), else ``others``."""
    return Solution(
        pressure_mpa=torch.where(which[:, None, None], these.pressure_mpa, others.pressure_mpa),
        approach_mm=torch.where(which, these.approach_mm, others.approach_mm),
        iterations=torch.where(which, these.iterations, others.iterations),
        converged=torch.where(which, these.converged, others.converged),
    )
