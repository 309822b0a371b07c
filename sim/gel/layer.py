"""The gel of a tactile sensor: presses a shape into it and returns surface, pressure and force.

The gel is a linear elastic layer bonded to a rigid back. The pressing body is rigid or a soft
half-space. Contact is frictionless and quasi-static.

Computation is in mm, N and MPa (N/mm²); results give pressure in kPa. Surfaces are in the gel
frame, positive into the gel; the gel that rises around a contact is negative.

Not here: friction (``sim.gel.shear``), the pressing bodies (``sim.grasp.bodies``,
``sim.full.drawn``), sensor noise and point clouds (``cltp.tactile``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import torch
from torch import Tensor

from cltp.gel.compliance import GelMaterial, layer_compliance
from cltp.gel.pressure import NOMINAL_GEL
from cltp.tactile.sensors import SENSORS
from sim.gel.compliance import Spectrum, spectrum_of
from sim.gel.contact_solver import Solution, solve
from sim.gel.gap import NO_BODY_MM

MAX_ITERATIONS = 300
"""Bound of the contact solver; ``Press.converged`` is False where it ends a contact."""

_DEEPEST_GUESS_MM = 1e3  # upper bound of the depth from which the first guess is searched

# Young's modulus [MPa] and Poisson's ratio. GelSight Mini: fitted, with the thickness, to two
# forces and a profile of real presses (``tacgrasp bench gel``): forces within 5.2 %, profile
# 0.0071 mm. The profile alone would choose h 3.6 mm and nu 0.495 (0.0067 mm) and miss the forces
# by 7 %. The marker gel, DIGIT, GelSight R1.5 and taxels: assumed alike. GelStereo: as in TacFlex
# by its makers (github.com/Zhang-Chaofan/TacFlex). The thickness is that of
# ``cltp.tactile.sensors``.
_MINI = (NOMINAL_GEL.young_mpa, NOMINAL_GEL.poisson)
_ELASTICITY = {
    "gelsight_mini": _MINI,
    "gelsight_mini_markers": _MINI,
    "gelsight_r15": _MINI,
    "digit": _MINI,
    "gelstereo": (0.25, 0.47),
    "taxels": _MINI,
}

GEL_MATERIALS: dict[str, GelMaterial] = {
    name: GelMaterial(thickness_mm=SENSORS[name].gel_mm, young_mpa=young_mpa, poisson=poisson)
    for name, (young_mpa, poisson) in _ELASTICITY.items()
}
"""Gels by the name of their sensor."""


def gel_of(sensor_name: str) -> GelMaterial:
    """Return the gel of the sensor called ``sensor_name``.

    Raises:
        ValueError: No gel is known for it; the message lists those that are.
    """
    try:
        return GEL_MATERIALS[sensor_name]
    except KeyError:
        names = ", ".join(sorted(GEL_MATERIALS))
        raise ValueError(f"no gel known for sensor {sensor_name!r}; known: {names}") from None


@dataclass(frozen=True, slots=True, kw_only=True)
class Press:
    """A batch of solved contacts.

    Attributes:
        pressure_kpa: Normal pressure, (B, H, W) [kPa].
        height_mm: Surface of the gel, positive into the gel, (B, H, W) [mm].
        force_n: Normal force, (B,) [N]. It is below the requested force only where no body lies
            over the grid: then it is 0.
        depth_mm: Lowest point of the undeformed body below the undeformed surface, (B,) [mm]. A
            soft body has flattened by part of this. +inf where no depth gives the force; where the
            force is 0, the depth at which the body just touches.
        iterations: Iterations of the contact solver, (B,) int64.
        converged: (B,) bool. False where ``MAX_ITERATIONS`` ended it with a residual above ``tol``.
    """

    pressure_kpa: Tensor
    height_mm: Tensor
    force_n: Tensor
    depth_mm: Tensor
    iterations: Tensor
    converged: Tensor


StartPressure = Press | Tensor | None
"""First guess of a press: a similar press, or its pressure (B, H, W) [kPa]."""


class ElasticLayer:
    """A gel on one grid.

    Args:
        material: The gel; infinite thickness makes it a half-space.
        rows: Rows of the grid, H.
        columns: Columns of the grid, W.
        pitch_mm: Edge of a (square) element [mm].
        body_modulus_mpa: E* = E / (1 - nu²) of the pressing body, as a half-space [MPa]. None is
            rigid, one number holds for all bodies, a tensor (B,) gives one for each of the batch.
        dtype: float32 or float64.
        device: Torch device of the computation.

    Raises:
        ValueError: A size, pitch, modulus or dtype is out of range.
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
        if rows < 1 or columns < 1 or not 0 < pitch_mm < math.inf:
            raise ValueError(
                f"a gel's grid needs rows and columns >= 1 and pitch_mm > 0, "
                f"got {rows} x {columns} at {pitch_mm} mm"
            )
        if dtype not in (torch.float32, torch.float64):
            raise ValueError(f"a gel computes in float32 or float64, got {dtype}")
        self.material, self.rows, self.columns, self.pitch_mm = material, rows, columns, pitch_mm
        self.dtype, self.device = dtype, torch.device(device)
        self._modulus: Tensor | None = None
        if body_modulus_mpa is not None:
            modulus = torch.as_tensor(body_modulus_mpa, dtype=dtype, device=self.device)
            if modulus.ndim > 1 or not bool((modulus > 0).all()):
                raise ValueError(
                    "body_modulus_mpa must be > 0, one number or (B,), "
                    f"got {body_modulus_mpa}; None is a rigid body"
                )
            self._modulus = modulus.reshape(()) if modulus.numel() == 1 else modulus
        # Stiffness of the layer to a wave as long as its thickness (a half-space: as the grid), for
        # first guesses only.
        size = min(material.thickness_mm, 0.5 * pitch_mm * max(rows, columns))
        wave = torch.tensor(2.0 / size, dtype=torch.float64)
        if math.isinf(material.thickness_mm):
            self.stiffness = float(material.plane_strain_mpa * wave / 2.0)
        else:
            self.stiffness = 1.0 / float(layer_compliance(wave, material))

    def coarsened(self, factor: int) -> ElasticLayer:
        """The same gel and bodies on a grid with elements ``factor`` times as large."""
        return ElasticLayer(
            self.material,
            rows=self.rows // factor,
            columns=self.columns // factor,
            pitch_mm=self.pitch_mm * factor,
            body_modulus_mpa=self._modulus,
            dtype=self.dtype,
            device=self.device,
        )

    def moduli_mpa(self, batch: int) -> Tensor | None:
        """E* of each of ``batch`` bodies, (B,) [MPa]; None for rigid ones.

        Raises:
            ValueError: ``body_modulus_mpa`` was given for another number of bodies.
        """
        if self._modulus is None:
            return None
        if self._modulus.numel() not in (1, batch):
            raise ValueError(
                f"body_modulus_mpa was given for {self._modulus.numel()} bodies, "
                f"but {batch} are pressed; give as many of both"
            )
        return self._modulus.expand(batch)

    def press_to_force(
        self,
        gap_mm: Tensor,
        force_n: Tensor | float,
        *,
        start: StartPressure = None,
        tol: float = 1e-4,
    ) -> Press:
        """Press a body with a given normal force.

        Args:
            gap_mm: Height of the undeformed body above its lowest point, (B, H, W), >= 0 [mm];
                ``NO_BODY_MM`` or more, +inf included, where there is no body.
            force_n: (B,) or one number, >= 0 [N].
            start: First guess.
            tol: Residual gap over the mean displacement in contact, root mean square. The worst
                height is then off by about 0.1 µm at 1e-4 and 1 µm at 1e-3, which takes half
                the time (measured by ``tacgrasp bench gel``).

        Raises:
            ValueError: A shape, sign or value is out of range.
        """
        return self._press(gap_mm, force_n, start, tol, by_force=True)

    def press_to_depth(
        self,
        gap_mm: Tensor,
        depth_mm: Tensor | float,
        *,
        start: StartPressure = None,
        tol: float = 1e-4,
    ) -> Press:
        """Press a body until its undeformed lowest point is ``depth_mm`` below the surface.

        The arguments are those of ``press_to_force``, but for ``depth_mm``: (B,) or one number
        [mm]; a body does not touch where it is below the smallest gap.
        """
        return self._press(gap_mm, depth_mm, start, tol, by_force=False)

    def _press(
        self,
        gap_mm: Tensor,
        load: Tensor | float,
        start: StartPressure,
        tol: float,
        *,
        by_force: bool,
    ) -> Press:
        gap, target = self.check_inputs(gap_mm, load, by_force=by_force)
        self.moduli_mpa(len(gap))
        if by_force:
            target = target / self.pitch_mm**2
            guess = self.first_pressure(start, gap, self._springs_depth(gap, target))
            total = guess.flatten(1).sum(1).clamp(min=1e-30)
            guess = guess * (target / total)[:, None, None]
        else:
            guess = self.first_pressure(start, gap, target)
        solution = solve(
            self._combined_spectrum,
            gap,
            target,
            by_force=by_force,
            start_mpa=guess,
            stiffness=self.stiffness,
            tol=tol,
            max_iterations=MAX_ITERATIONS,
        )
        return self.press_of(solution, self._gel_spectrum.apply(solution.pressure_mpa))

    def press_of(self, solution: Solution, height_mm: Tensor) -> Press:
        """A solution on this grid, with its surface (B, H, W) [mm], in the units of a press."""
        pressure = solution.pressure_mpa
        return Press(
            pressure_kpa=pressure * 1e3,
            height_mm=height_mm,
            force_n=pressure.flatten(1).sum(1) * self.pitch_mm**2,
            depth_mm=solution.approach_mm,
            iterations=solution.iterations,
            converged=solution.converged,
        )

    def check_inputs(
        self, gap_mm: Tensor, load: Tensor | float, *, by_force: bool
    ) -> tuple[Tensor, Tensor]:
        """Check gaps and loads of a press; convert them to this gel's dtype and device.

        Args:
            gap_mm: As for ``press_to_force``.
            load: Forces [N] if ``by_force``, else depths [mm]; (B,) or one number.
            by_force: Whether the load is a force.

        Returns:
            Gaps (B, H, W) [mm], ``NO_BODY_MM`` where there is no body, and loads (B,).

        Raises:
            ValueError: A shape, sign or value is out of range.
        """
        gap = self._as_grid(gap_mm, "gap_mm")
        name, batch = "force_n" if by_force else "depth_mm", len(gap)
        if gap.stride(0) == 0:  # one body, expanded
            gap = gap[:1]
        if not bool((gap >= -1e-5).all()):
            raise ValueError(
                "gap_mm must be >= 0 everywhere and not NaN: it is the body's height above its "
                f"own lowest point; the smallest is {gap.min().item()} mm"
            )
        gap = gap.clamp(max=NO_BODY_MM).expand(batch, -1, -1)
        loads = torch.as_tensor(load, dtype=self.dtype, device=self.device)
        if loads.ndim > 1 or loads.numel() not in (1, batch):
            raise ValueError(f"{name} must be one number or ({batch},), got {tuple(loads.shape)}")
        loads = loads.reshape(-1).expand(batch)
        if by_force and not bool(((loads >= 0) & torch.isfinite(loads)).all()):
            raise ValueError(f"force_n must be finite and >= 0 N, got {loads.tolist()}")
        if not bool(torch.isfinite(loads).all()):
            raise ValueError(f"depth_mm must be finite, got {loads.tolist()}")
        return gap, loads

    def first_pressure(self, start: StartPressure, gap: Tensor, depth: Tensor) -> Tensor:
        """First pressures (B, H, W) [MPa]: ``start`` where it has any, else that of springs.

        Args:
            start: First guess, or None.
            gap: As returned by ``check_inputs``, (B, H, W) [mm].
            depth: Depth of the springs, (B,) [mm].

        Raises:
            ValueError: ``start`` has another shape than ``gap``.
        """
        limit = depth.clamp(max=NO_BODY_MM)[:, None, None]
        springs = ((limit - gap) * self.stiffness).clamp_(min=0)
        if start is None:
            return springs
        start_kpa = start.pressure_kpa if isinstance(start, Press) else start
        start_mpa = (self._as_grid(start_kpa, "start") * 1e-3).clamp(min=0) * (gap < NO_BODY_MM)
        if start_mpa.shape != gap.shape:
            raise ValueError(f"start has {start_mpa.shape[0]} presses, gap_mm has {gap.shape[0]}")
        pressed = (start_mpa > 0).flatten(1).any(1)
        return torch.where(pressed[:, None, None], start_mpa, springs)

    def _spectrum(self, material: GelMaterial | None) -> Spectrum:
        return spectrum_of(
            material, self.rows, self.columns, self.pitch_mm, self.dtype, self.device
        )

    @cached_property
    def _gel_spectrum(self) -> Spectrum:
        """Made when first used: ``sim.gel.fine.fine`` needs it for few of its grids."""
        return self._spectrum(self.material)

    @cached_property
    def _combined_spectrum(self) -> Spectrum:
        """Gel and body in series."""
        if self._modulus is None:
            return self._gel_spectrum
        inverse = 1.0 / self._modulus
        if inverse.ndim == 1:
            inverse = inverse[:, None, None]
        values = self._gel_spectrum.values + inverse * self._spectrum(None).values
        return replace(self._gel_spectrum, values=values)

    def _as_grid(self, value: Tensor, name: str) -> Tensor:
        grid = torch.as_tensor(value, dtype=self.dtype, device=self.device)
        if grid.ndim != 3 or tuple(grid.shape[1:]) != (self.rows, self.columns):
            raise ValueError(
                f"{name} must have shape (B, {self.rows}, {self.columns}), got {tuple(grid.shape)}"
            )
        return grid

    def _springs_depth(self, gap: Tensor, target: Tensor) -> Tensor:
        """Depth at which springs of the guessed stiffness carry ``target``.

        Newton's method from above cannot overshoot, since what springs carry is convex in depth.
        Six steps are enough for a guess.
        """
        flat = gap.flatten(1)
        carried = target / self.stiffness
        depth = (flat.amin(1) + carried).clamp(max=_DEEPEST_GUESS_MM)
        for _ in range(6):
            overlap = (depth[:, None] - flat).clamp_(min=0)
            pressed = (overlap > 0).sum(1).clamp(min=1)
            depth = depth - (overlap.sum(1) - carried).clamp(min=0) / pressed
        return depth
