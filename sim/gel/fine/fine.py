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

import torch
from torch import Tensor
from torch.nn.functional import interpolate

from sim.gel.contact_solver import Solution, chosen
from sim.gel.fine.levels import TOLERANCE, Box, GridLevel, boxes_around, escaped_from
from sim.gel.gap import NO_BODY_MM
from sim.gel.layer import ElasticLayer, Press

_FEWEST_CELLS = 24  # along the shorter side of the coarsest grid


class FineLayer:
    """A gel at a sensor's own resolution.

    Args:
        finest: The gel on that grid. Two coarser grids are used as well where its rows and columns
            are divisible by 4, one where they are divisible by 2.
    """

    def __init__(self, finest: ElasticLayer) -> None:
        self.finest = finest
        shortest = min(finest.rows, finest.columns)
        self._layers = [
            *(
                finest.coarsened(factor)
                for factor in (4, 2)
                if finest.rows % factor == finest.columns % factor == 0
                and shortest // factor >= _FEWEST_CELLS
            ),
            finest,
        ]

    def press_to_depth(self, gap_mm: Tensor, depth_mm: Tensor | float) -> Press:
        """Press a body to a given depth; see ``ElasticLayer.press_to_depth``."""
        gap, depths = self.finest.check_inputs(gap_mm, depth_mm, by_force=False)
        # No mean may include parts further away than the gel is thick.
        gaps = [torch.where(gap < self.finest.material.thickness_mm, gap, NO_BODY_MM)]
        for _ in self._layers[1:]:
            gaps.insert(0, _coarser(gaps[0]))
        coarsest = self._layers[0]
        if len(self._layers) == 1:
            return coarsest.press_to_depth(gap, depths, tol=TOLERANCE)
        moduli = self.finest.moduli_mpa(len(depths))
        level = GridLevel(layer=coarsest, moduli_mpa=moduli)
        field = Box(top=0, left=0, rows=coarsest.rows, columns=coarsest.columns)
        start = coarsest.first_pressure(None, gaps[0], depths)
        pressure = level.solve([field] * len(depths), gaps[0], depths, start).pressure_mpa
        gaps[-1] = gap
        for layer, finer in zip(self._layers[1:], gaps[1:], strict=True):
            level = GridLevel(layer=layer, moduli_mpa=moduli)
            boxes = boxes_around(pressure > 0)
            start = interpolate(pressure[:, None], scale_factor=2, mode="bilinear").squeeze(1)
            solved = level.solve(boxes, finer, depths, start)
            pressure = solved.pressure_mpa
        return _whole_surface(level, gap, depths, boxes, solved)


def _whole_surface(
    level: GridLevel, gap: Tensor, depths: Tensor, boxes: list[Box], solved: Solution
) -> Press:
    """Surface of the whole grid; contacts that reach out of their boxes are solved again."""
    height, opening = level.surface(solved, gap)
    escaped = escaped_from(boxes, opening)
    if bool(escaped.any()):
        field = Box(top=0, left=0, rows=gap.shape[1], columns=gap.shape[2])
        regions = [field if one else box for one, box in zip(escaped.tolist(), boxes, strict=True)]
        resolved = level.solve(regions, gap, depths, solved.pressure_mpa)
        solved = chosen(escaped, resolved, solved)
        height, opening = level.surface(solved, gap)
    pressure = solved.pressure_mpa
    residual = torch.where(pressure > 0, opening, opening.clamp(max=0))
    loaded = (pressure > 0).flatten(1).any(1)[:, None, None]
    height = torch.where(loaded, height - level.short_wave_fraction() * residual, 0.0)
    return level.layer.press_of(solved, height)


def _coarser(gap: Tensor) -> Tensor:
    """Mean gap of two by two elements, of those with a body: a thin body must not be lost."""
    batch = len(gap)
    if gap.stride(0) == 0:  # one body, expanded
        gap = gap[:1]
    covered = gap < NO_BODY_MM
    count = _sum_of_four(covered.to(gap.dtype))
    mean = _sum_of_four(gap.masked_fill(~covered, 0)) / count.clamp(min=1)
    return torch.where(count > 0, mean, NO_BODY_MM).expand(batch, -1, -1)


def _sum_of_four(field: Tensor) -> Tensor:
    """Sums over squares of two by two, (B, H, W) -> (B, H/2, W/2); pooling takes longer."""
    upper, lower = field[:, ::2], field[:, 1::2]
    total = upper[..., ::2] + upper[..., 1::2]
    return total.add_(lower[..., ::2]).add_(lower[..., 1::2])
