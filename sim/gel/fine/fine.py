"""Presses at a sensor's own resolution: coarse first, then only where there is contact.

A contact is solved on a grid four times coarser, then twice, then at full resolution. Each solve
starts from the one before and covers only the box that holds the contact; one convolution then
gives the whole surface. Where a rigid body touches, the surface is the body's: the remaining
residual of the solver is subtracted there. A contact that leaves its box is solved again on the
whole grid, so that the shortcut never changes the contact.

``tacgrasp bench tcl3d`` measures the error against a solve on the whole grid.

Not here: how one grid is solved (``sim.gel.fine.levels``), materials and the plain press
(``sim.gel.layer``).
"""

from __future__ import annotations

from collections.abc import Callable

import torch
from torch import Tensor
from torch.nn.functional import avg_pool2d, interpolate

from sim.gel.contact_solver import Solution, chosen
from sim.gel.fine.boxes import Box, boxes_around, escaped_from
from sim.gel.fine.levels import TOLERANCE, GridLevel
from sim.gel.gap import NO_BODY_MM
from sim.gel.layer import ElasticLayer, Press, StartPressure

_FEWEST_CELLS = 24  # along the shorter side of the coarsest grid


class FineLayer:
    """A gel at a sensor's own resolution.

    Args:
        finest: The gel on that grid. Two coarser grids are used as well where its rows and columns
            are divisible by 4, one where they are divisible by 2.
    """

    def __init__(self, finest: ElasticLayer) -> None:
        self.finest = finest
        factors = _factors(finest.rows, finest.columns)
        self._layers = [*(finest.coarsened(factor) for factor in factors), finest]

    def press_to_force(
        self, gap_mm: Tensor, force_n: Tensor | float, *, start: StartPressure = None
    ) -> Press:
        """Press with a given normal force; see ``ElasticLayer.press_to_force``."""
        return self._press(gap_mm, force_n, start, by_force=True)

    def press_to_depth(
        self, gap_mm: Tensor, depth_mm: Tensor | float, *, start: StartPressure = None
    ) -> Press:
        """Press a body to a given depth; see ``ElasticLayer.press_to_depth``."""
        return self._press(gap_mm, depth_mm, start, by_force=False)

    def _press(
        self, gap_mm: Tensor, load: Tensor | float, start: StartPressure, *, by_force: bool
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
        moduli = self.finest.moduli_mpa(len(loads))
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
        level = GridLevel(layer=layer, moduli_mpa=layer.moduli_mpa(len(loads)))
        first = layer.first_pressure(start_kpa, gap, loads)
        return level.solve([field] * len(loads), gap, loads, first, by_force=False).pressure_mpa

    def _reachable(self, gap: Tensor) -> Tensor:
        """Gap without parts further away than the gel is thick, which no mean may include."""
        return torch.where(gap < self.finest.material.thickness_mm, gap, NO_BODY_MM)


def _whole_surface(
    level: GridLevel,
    gap: Tensor,
    loads: Tensor,
    boxes: list[Box],
    solved: Solution,
    *,
    by_force: bool,
) -> Press:
    """Surface of the whole grid; contacts that reach out of their boxes are solved again."""
    height, opening = level.surface(solved, gap)
    escaped = escaped_from(boxes, opening)
    if bool(escaped.any()):
        field = Box(top=0, left=0, rows=gap.shape[1], columns=gap.shape[2])
        regions = [field if one else box for one, box in zip(escaped.tolist(), boxes, strict=True)]
        resolved = level.solve(regions, gap, loads, solved.pressure_mpa, by_force=by_force)
        solved = chosen(escaped, resolved, solved)
        height, opening = level.surface(solved, gap)
    pressure = solved.pressure_mpa
    residual = torch.where(pressure > 0, opening, opening.clamp(max=0))
    loaded = (pressure > 0).flatten(1).any(1)[:, None, None]
    height = torch.where(loaded, height - level.short_wave_fraction() * residual, 0.0)
    return level.layer.press_of(solved, height)


def _factors(rows: int, columns: int) -> list[int]:
    """How many times coarser the coarser grids are, coarsest first."""
    return [
        factor
        for factor in (4, 2)
        if rows % factor == 0
        and columns % factor == 0
        and min(rows, columns) // factor >= _FEWEST_CELLS
    ]


def _per_body(change: Callable[[Tensor], Tensor], gap: Tensor) -> Tensor:
    """Apply ``change`` to gaps (B, H, W), once where they are one body's, expanded."""
    if gap.stride(0) != 0:
        return change(gap)
    return change(gap[:1]).expand(len(gap), -1, -1)


def _coarser(gap: Tensor) -> Tensor:
    """Mean gap of two by two elements, of those with a body: a thin body must not be lost."""
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
