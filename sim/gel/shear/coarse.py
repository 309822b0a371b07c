"""Friction at the rate of a control loop: coarser elements, looser tolerance, the last traction.

``tacgrasp bench gel`` prints its error against ``ShearLayer`` on the pressure's own grid, and how
long a step takes.
"""

from __future__ import annotations

import torch
from torch import Tensor

from cltp.gel.compliance import GelMaterial
from sim.gel.layer import ElasticLayer
from sim.gel.shear.layer import Shear, ShearLayer

FACTOR = 2
"""Elements of the pressure's grid along the side of one of friction's: 0.5 mm on a GelSight Mini's
60 × 80. Our choice: a contact of 2 mm then has 50 elements."""

LOOP_TOL = 2e-3
LOOP_ITERATIONS = 8
"""Tolerance and bound of the solver. Our choice: the force then is off by the grid, not by these. A
looser tolerance first costs the stick fraction, which counts points at their limit. The bound keeps
the slowest step short; ``Shear.converged`` is False where it ended one."""


class CoarseShear:
    """Friction on elements ``FACTOR`` times as large as those of the pressure.

    Args:
        layer: The gel, on the grid of its pressure.
        friction, body, coupled: As for ``ShearLayer``.

    Raises:
        ValueError: As ``ShearLayer``, or a grid that has no even number of rows and columns.

    Attributes:
        shear_layer: The gel on the coarser grid; states, fields and loads are its own.
    """

    def __init__(
        self,
        layer: ElasticLayer,
        *,
        friction: float,
        body: GelMaterial | None = None,
        coupled: bool = False,
    ) -> None:
        if layer.rows % FACTOR or layer.columns % FACTOR:
            raise ValueError(
                f"friction is solved on elements {FACTOR} times as large, and a grid of "
                f"{layer.rows} × {layer.columns} is no multiple of that; take one that is"
            )
        self.shear_layer = ShearLayer(
            layer.coarsened(FACTOR), friction=friction, body=body, coupled=coupled
        )

    @torch.no_grad()
    def step(self, before: Shear | None, pressure_kpa: Tensor, motion: Tensor) -> Shear:
        """As ``ShearLayer.step``, with the pressure (B, H, W) on its own grid [kPa].

        Raises:
            ValueError: A shape or value is out of range.
        """
        return self.shear_layer.step(
            before,
            self.coarse(pressure_kpa),
            motion,
            tol=LOOP_TOL,
            max_iterations=LOOP_ITERATIONS,
        )

    def coarse(self, grid: Tensor) -> Tensor:
        """Means of a grid (B, H, W) over the coarser elements; forces are kept."""
        if grid.ndim != 3:
            raise ValueError(f"expected a grid (B, H, W), got shape {tuple(grid.shape)}")
        return torch.nn.functional.avg_pool2d(grid[:, None], FACTOR)[:, 0]
