"""Presses at a sensor's own resolution: coarse first, then only where there is contact.

A contact is solved on a grid four times coarser, then twice, then at full resolution, each time
starting from the one before and only within the box that holds the contact; the whole surface
follows from one convolution. Where a rigid body touches, the surface is the body's: what is left
of the solver's residual is taken away there. A contact that leaves its box is solved again on the
whole field, so that the shortcut never decides anything.

How far this is from the solve on the whole grid is measured by ``tacgrasp bench tcl3d``.

Not here: how one grid is solved (``sim.gel.fine.levels``), materials and the plain press
(``sim.gel.layer``).
"""

from __future__ import annotations

from collections.abc import Callable

import torch
from torch import Tensor
from torch.nn.functional import avg_pool2d, interpolate

from sim.gel.compliance import GelMaterial
from sim.gel.contact_solver import Solution
from sim.gel.fine.boxes import Box, boxes_around, escaped_from
from sim.gel.fine.levels import TOLERANCE, GridLevel
from sim.gel.gap import NO_BODY_MM
from sim.gel.layer import ElasticLayer, Press

_FEWEST_CELLS = 24  # along the shorter side of the coarsest grid


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
        gap, loads = self.finest.check_inputs(gap_mm, load, by_force=by_force)
        gaps = [self._reachable(gap)]
        for _ in self._layers[1:]:
            gaps.insert(0, _per_body(_coarser, gaps[0]))
        coarsest = self._layers[0]
        start_kpa = None if start is None else _pooled(start, gap.shape[1] // coarsest.rows)
        if len(self._layers) == 1:
            press = coarsest.press_to_force if by_force else coarsest.press_to_depth
            return press(gap, loads, start=start_kpa, tol=TOLERANCE)
        pressure = self._coarsest(gaps[0], loads, start_kpa, by_force=by_force)
        moduli = self._moduli(len(loads))
        gaps[-1] = gap
        for layer, finer in zip(self._layers[1:], gaps[1:], strict=True):
            level = GridLevel(layer=layer, moduli_mpa=moduli)
            boxes = boxes_around(pressure > 0)
            solved = level.solve(boxes, finer, loads, _finer(pressure), by_force=by_force)
            pressure = solved.pressure_mpa
        return _whole_surface(level, gap, loads, boxes, solved, by_force=by_force)

    def _coarsest(
        self, gap: Tensor, loads: Tensor, start_kpa: Tensor | None, *, by_force: bool
    ) -> Tensor:
        """Pressure on the coarsest grid [MPa]."""
        layer = self._layers[0]
        if by_force:
            press = layer.press_to_force(gap, loads, start=start_kpa, tol=TOLERANCE)
            return press.pressure_kpa * 1e-3
        field = Box(top=0, left=0, rows=layer.rows, columns=layer.columns)
        level = GridLevel(layer=layer, moduli_mpa=self._moduli(len(loads)))
        first = layer.first_pressure(start_kpa, gap, loads)
        return level.solve([field] * len(loads), gap, loads, first, by_force=False).pressure_mpa

    def _reachable(self, gap: Tensor) -> Tensor:
        """Without what lies further away than the gel is thick: no mean may count it in."""
        return torch.where(gap < self.finest.material.thickness_mm, gap, NO_BODY_MM)

    def _moduli(self, batch: int) -> Tensor | None:
        if self._modulus is None:
            return None
        modulus = torch.as_tensor(self._modulus, dtype=self.finest.dtype, device=self.finest.device)
        if modulus.numel() not in (1, batch):
            raise ValueError(
                f"body_modulus_mpa was given for {modulus.numel()} bodies, "
                f"but {batch} are pressed; give as many of both"
            )
        return modulus.reshape(-1).expand(batch)


def _whole_surface(
    level: GridLevel,
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
        regions = [field if one else box for one, box in zip(escaped.tolist(), boxes, strict=True)]
        resolved = level.solve(regions, gap, loads, solved.pressure_mpa, by_force=by_force)
        solved = _select(escaped, resolved, solved)
        height, opening = level.surface(solved, gap)
    pressure = solved.pressure_mpa
    residual = torch.where(pressure > 0, opening, opening.clamp(max=0))
    loaded = (pressure > 0).flatten(1).any(1)[:, None, None]
    return Press(
        pressure_kpa=pressure * 1e3,
        height_mm=torch.where(loaded, height - level.short_wave_fraction() * residual, 0.0),
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


def _per_body(change: Callable[[Tensor], Tensor], gap: Tensor) -> Tensor:
    """Change gaps (B, H, W), once where they are one body's, expanded."""
    if gap.stride(0) != 0:
        return change(gap)
    return change(gap[:1]).expand(len(gap), -1, -1)


def _coarser(gap: Tensor) -> Tensor:
    """Mean gap of four elements, of those where a body is: a thin body must not be lost."""
    covered = gap < NO_BODY_MM
    count = _sum_of_four(covered.to(gap.dtype))
    mean = _sum_of_four(gap.masked_fill(~covered, 0)) / count.clamp(min=1)
    return torch.where(count > 0, mean, NO_BODY_MM)


def _sum_of_four(field: Tensor) -> Tensor:
    """Sums over squares of two by two, (B, H, W) -> (B, H/2, W/2); pooling takes longer."""
    upper, lower = field[:, ::2], field[:, 1::2]
    total = upper[..., ::2] + upper[..., 1::2]
    return total.add_(lower[..., ::2]).add_(lower[..., 1::2])


def _finer(pressure: Tensor) -> Tensor:
    return interpolate(pressure[:, None], scale_factor=2, mode="bilinear", align_corners=False)[
        :, 0
    ]


def _pooled(start: Press | Tensor, factor: int) -> Tensor:
    pressure = start.pressure_kpa if isinstance(start, Press) else start
    return avg_pool2d(pressure[:, None], factor)[:, 0]


def _select(mask: Tensor, solution: Solution, other: Solution) -> Solution:
    """``these`` where ``which`` (B,), else ``others``."""
    return Solution(
        pressure_mpa=torch.where(mask[:, None, None], solution.pressure_mpa, other.pressure_mpa),
        approach_mm=torch.where(mask, solution.approach_mm, other.approach_mm),
        iterations=torch.where(mask, solution.iterations, other.iterations),
        converged=torch.where(mask, solution.converged, other.converged),
    )
