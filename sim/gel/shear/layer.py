"""A gel that a body drags sideways under Coulomb friction, step by step.

Each step is given the pressure and how the body moved, and remembers where the surface stuck: a
point that sticks moves with the body; a point that slips sticks anew where it comes to rest; a
point that the body reaches sticks where it is touched, and one that the body leaves forgets.
Strains are small and the steps quasi-static; static and kinetic friction are one.

The pressure is solved without friction and given. In a bonded layer traction would change it and
pressure would drag the surface, at any Poisson's ratio (``sim.gel.shear.compliance``). With
``coupled`` the drag of the pressure is part of the contact. The change of the pressure by traction
is left out; ``tacgrasp bench gel`` prints what both would change.

Vectors are (x, y), gel frame; traction is the body's on the gel. Computation is in mm, N and MPa,
results give traction in kPa.

Not here: the solution of one step (``sim.gel.shear.friction``), what a sensor sees of it
(``sim.gel.shear.sensed``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import torch
from torch import Tensor

from cltp.gel.compliance import GelMaterial
from sim.gel.layer import ElasticLayer
from sim.gel.shear.friction import FrictionSolution, solve_friction
from sim.gel.shear.kernels import ShearSpectrum
from sim.gel.shear.pair import box_around, pair_spectrum

MAX_SHEAR_ITERATIONS = 300
"""Bound of the friction solver; ``Shear.converged`` is False where it ends a contact."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Shear:
    """A batch of contacts after a step.

    Attributes:
        pressure_kpa: The given pressure, (B, H, W) [kPa].
        traction_kpa: (B, 2, H, W) [kPa].
        displacement_mm: Displacement of the gel's surface under this traction, (B, 2, H, W) [mm].
        held_mm: Displacement of the surface, relative to the body's, from which each point sticks,
            (B, 2, H, W) [mm]: the memory.
        sticking: Points in contact whose traction is below friction's limit, (B, H, W) bool. The
            others slip, or would under any more load.
        force_n: Force on the gel, (B, 2) [N].
        moment_nmm: Moment on the gel about the grid's centre, counter-clockwise, (B,) [N mm].
        dissipated_mj: Heat of this step, (B,) [mJ].
        iterations: (B,) int64.
        converged: (B,) bool. False where ``MAX_SHEAR_ITERATIONS`` ended it above ``tol``.
    """

    pressure_kpa: Tensor
    traction_kpa: Tensor
    displacement_mm: Tensor
    held_mm: Tensor
    sticking: Tensor
    force_n: Tensor
    moment_nmm: Tensor
    dissipated_mj: Tensor
    iterations: Tensor
    converged: Tensor

    @property
    def stick_fraction(self) -> Tensor:
        """Fraction of the normal force that rests on sticking points, (B,); 0 without contact.

        Points count by their pressure, not by their area, which is blurred at a grid's resolution.
        """
        total = self.pressure_kpa.flatten(1).sum(1)
        stuck = (self.pressure_kpa * self.sticking).flatten(1).sum(1)
        return stuck / total.clamp(min=1e-30)


class ShearLayer:
    """A gel and its friction with a body.

    Args:
        layer: The gel and its grid; its ``body_modulus_mpa`` is not used here.
        friction: Coefficient of friction, >= 0.
        body: The pressing body as an elastic half-space, infinitely thick; None is rigid.
        coupled: Whether the displacement along the surface under pressure drags on the body. It
            matters where a contact is wider than the gel is thick.

    Raises:
        ValueError: Friction is negative or not finite, or the body is not a half-space.

    Attributes:
        displacement_of_turn: Displacement of each element by a turn of the body about the grid's
            centre, (2, H, W) [mm/rad].
    """

    def __init__(
        self,
        layer: ElasticLayer,
        *,
        friction: float,
        body: GelMaterial | None = None,
        coupled: bool = False,
    ) -> None:
        if not 0 <= friction < math.inf:
            raise ValueError(f"friction must be finite and >= 0, got {friction}")
        if body is not None and not math.isinf(body.thickness_mm):
            raise ValueError(
                f"a pressing body is a half-space here, got one {body.thickness_mm} mm thick; "
                "give thickness_mm=math.inf"
            )
        self.layer, self.friction, self.body, self.coupled = layer, friction, body, coupled
        y = 0.5 * (layer.rows - 1) - torch.arange(layer.rows, dtype=torch.float64)
        x = torch.arange(layer.columns, dtype=torch.float64) - 0.5 * (layer.columns - 1)
        self.displacement_of_turn = self._to_layer(
            torch.stack(
                [
                    -y[:, None].expand(layer.rows, layer.columns),
                    x.expand(layer.rows, layer.columns),
                ]
            )
            * layer.pitch_mm
        )

    def at_rest(self, batch: int = 1) -> Shear:
        """Gels that nothing touches."""
        grid = torch.zeros(
            (batch, self.layer.rows, self.layer.columns),
            dtype=self.layer.dtype,
            device=self.layer.device,
        )
        vectors, numbers = torch.stack([grid, grid], 1), grid[:, 0, 0]
        return Shear(
            pressure_kpa=grid,
            traction_kpa=vectors,
            displacement_mm=vectors,
            held_mm=vectors,
            sticking=grid > 0,
            force_n=vectors[:, :, 0, 0],
            moment_nmm=numbers,
            dissipated_mj=numbers,
            iterations=numbers.long(),
            converged=numbers == 0,
        )

    def step(
        self,
        before: Shear | None,
        pressure_kpa: Tensor,
        motion: Tensor,
        *,
        start_kpa: Tensor | None = None,
        tol: float = 1e-4,
        max_iterations: int = MAX_SHEAR_ITERATIONS,
    ) -> Shear:
        """Contact after the body moved under a pressure.

        Args:
            before: Contact before the motion; None is ``at_rest``. A body that first touches moves
                through all of the ``motion`` in touch.
            pressure_kpa: Pressure at the end of the motion, (B, H, W), >= 0 [kPa].
            motion: Motion of the body since ``before``, (B, 3): x, y [mm], and its turn about the
                grid's centre, counter-clockwise as the sensor sees it [rad], small.
            start_kpa: First guess of the traction; None is that of ``before``.
            tol: Slip that should not be over displacement, root mean square over the contact.
            max_iterations: Bound of the solver.

        Raises:
            ValueError: A shape or value is out of range.
        """
        pressure, move = self._checked(pressure_kpa, motion)
        before = self.at_rest(len(pressure)) if before is None else before
        if before.traction_kpa.shape != (len(pressure), 2, *pressure.shape[1:]):
            raise ValueError(
                f"before has shape {tuple(before.pressure_kpa.shape)}, pressure_kpa "
                f"{tuple(pressure.shape)}; step one batch on one grid"
            )
        drive = (
            before.held_mm
            + move[:, :2, None, None]
            + move[:, 2, None, None, None] * self.displacement_of_turn
        )
        dragged = self._pair.spread(pressure) if self.coupled else torch.zeros_like(drive)
        first = before.traction_kpa if start_kpa is None else start_kpa
        solution = self._solve(pressure, drive - dragged, 1e-3 * first, tol, max_iterations)
        touched = self.friction * pressure > 0
        moved = self._gel.apply(solution.traction_mpa)
        relative = moved if self.body is None else self._pair.apply(solution.traction_mpa)
        slipping = solution.slipping[:, None]
        heat = (solution.traction_mpa * solution.slip_mm * slipping).flatten(1)
        area = self.layer.pitch_mm**2
        return Shear(
            pressure_kpa=1e3 * pressure,
            traction_kpa=1e3 * solution.traction_mpa,
            displacement_mm=moved,
            held_mm=torch.where(touched[:, None] & ~slipping, drive, relative + dragged),
            sticking=touched & ~solution.at_limit,
            force_n=solution.traction_mpa.sum((2, 3)) * area,
            moment_nmm=(solution.traction_mpa * self.displacement_of_turn).sum((1, 2, 3)) * area,
            dissipated_mj=heat.sum(1) * area,
            iterations=solution.iterations,
            converged=solution.converged,
        )

    def sink_mm(self, shear: Shear) -> Tensor:
        """Displacement of the gel's surface into the gel under the traction, (B, H, W) [mm]."""
        return self._gel.sink(1e-3 * shear.traction_kpa)

    def spread_mm(self, shear: Shear) -> Tensor:
        """Displacement of the gel along its surface under the pressure, (B, 2, H, W) [mm]."""
        return self._gel.spread(1e-3 * shear.pressure_kpa)

    def _solve(
        self, pressure: Tensor, drive: Tensor, start: Tensor, tol: float, max_iterations: int
    ) -> FrictionSolution:
        """Solve in a box around the contacts; the convolution needs no more."""
        rows, columns = box_around(pressure > 0)
        solution = solve_friction(
            self._spectrum(rows.stop - rows.start, columns.stop - columns.start),
            drive[:, :, rows, columns],
            self.friction * pressure[:, rows, columns],
            start_mpa=start[:, :, rows, columns],
            tol=tol,
            max_iterations=max_iterations,
        )
        traction, slip = torch.zeros_like(drive), torch.zeros_like(drive)
        slipping = torch.zeros_like(pressure, dtype=torch.bool)
        at_limit = torch.zeros_like(slipping)
        traction[:, :, rows, columns] = solution.traction_mpa
        slip[:, :, rows, columns] = solution.slip_mm
        slipping[:, rows, columns] = solution.slipping
        at_limit[:, rows, columns] = solution.at_limit
        return replace(
            solution, traction_mpa=traction, slip_mm=slip, slipping=slipping, at_limit=at_limit
        )

    def _spectrum(self, rows: int, columns: int) -> ShearSpectrum:
        """Gel and body together on a grid of some size."""
        return pair_spectrum(
            self.layer.material,
            self.body,
            (self.layer.rows, self.layer.columns),
            (rows, columns),
            self.layer.pitch_mm,
            self.layer.dtype,
            self.layer.device,
        )

    @property
    def _pair(self) -> ShearSpectrum:
        return self._spectrum(self.layer.rows, self.layer.columns)

    @property
    def _gel(self) -> ShearSpectrum:
        size = self.layer.rows, self.layer.columns
        layer = self.layer
        return pair_spectrum(
            layer.material, None, size, size, layer.pitch_mm, layer.dtype, layer.device
        )

    def _to_layer(self, values: Tensor) -> Tensor:
        return torch.as_tensor(values, dtype=self.layer.dtype, device=self.layer.device)

    def _checked(self, pressure_kpa: Tensor, motion: Tensor) -> tuple[Tensor, Tensor]:
        """Pressure [MPa] and motion in the layer's dtype."""
        pressure, move = 1e-3 * self._to_layer(pressure_kpa), self._to_layer(motion)
        grid = self.layer.rows, self.layer.columns
        if pressure.ndim != 3 or tuple(pressure.shape[1:]) != grid:
            raise ValueError(
                f"pressure_kpa must have shape (B, {grid[0]}, {grid[1]}), "
                f"got {tuple(pressure.shape)}"
            )
        if move.shape != (len(pressure), 3) or not bool(torch.isfinite(move).all()):
            raise ValueError(
                f"motion must be finite, of shape ({len(pressure)}, 3): x and y in mm, turn in "
                f"rad; got shape {tuple(move.shape)}"
            )
        if not bool(((pressure >= 0) & torch.isfinite(pressure)).all()):
            raise ValueError("pressure_kpa must be finite and >= 0 everywhere; take a Press's")
        return pressure, move
