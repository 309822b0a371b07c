"""The gel of a tactile sensor: press a shape into it, get surface, pressure and force.

The gel is a linear elastic layer bonded to a rigid back; what presses may be rigid or a soft
half-space of its own. Contact is frictionless and quasi-static.

Inside mm, N and MPa (N/mm²); pressures go out in kPa. Surfaces are in the gel frame, positive
into the gel; the gel that rises around a contact is negative.

Not here: what presses (``sim.grasp.bodies``, ``sim.starter.shapes``), noise, points.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import torch
from torch import Tensor

from sim.gel.compliance import GelMaterial, Spectrum, layer_compliance, spectrum_of
from sim.gel.contact_solver import Solution, solve
from sim.gel.gap import NO_BODY_MM

_DEEPEST_GUESS_MM = 1e3  # where the search for a first guess begins at most

# GelSight Mini: thickness and Poisson's ratio fitted to real presses of a 6.31 mm ball, modulus
# as Tacchi uses for its elastomer (shared notes). DIGIT: not published, assumed alike. GelStereo:
# modulus and Poisson's ratio as in TacFlex by its makers (github.com/Zhang-Chaofan/TacFlex),
# thickness assumed.
GEL_MATERIALS: dict[str, GelMaterial] = {
    "gelsight_mini": GelMaterial(thickness_mm=3.6, young_mpa=0.145, poisson=0.495),
    "digit": GelMaterial(thickness_mm=3.6, young_mpa=0.145, poisson=0.495),
    "gelstereo": GelMaterial(thickness_mm=4.0, young_mpa=0.25, poisson=0.47),
}


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
    """A batch of contacts, solved.

    Attributes:
        pressure_kpa: Normal pressure, (B, H, W) [kPa].
        height_mm: Surface of the gel, positive into the gel, (B, H, W) [mm].
        force_n: Normal force, (B,) [N]. Less than asked for only where nothing lies over the
            field: then 0.
        depth_mm: Lowest point of the undeformed body below the undeformed surface, (B,) [mm];
            where the body is soft it has flattened by part of this. +inf where no depth gives
            the force; where the force is 0, the depth that just touches.
        iterations: Of the contact solver, (B,) int64.
        converged: (B,) bool. False: the iteration bound ended it, the residual is above ``tol``.
    """

    pressure_kpa: Tensor
    height_mm: Tensor
    force_n: Tensor
    depth_mm: Tensor
    iterations: Tensor
    converged: Tensor


class ElasticLayer:
    """A gel on one grid, ready to be pressed.

    Args:
        material: The gel; infinite thickness makes it a half-space.
        rows: Rows of the grid, H.
        columns: Columns of the grid, W.
        pitch_mm: Edge of a (square) element [mm].
        body_modulus_mpa: E* = E / (1 - nu²) of the body that presses, as a half-space [MPa]:
            None is rigid, a number holds for all, a tensor (B,) gives one for each of the batch.
        dtype: float32 or float64.
        device: Where to compute.

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
        if rows < 1 or columns < 1 or not 0 < pitch_mm < math.inf:
            raise ValueError(
                f"a gel's grid needs rows and columns >= 1 and pitch_mm > 0, "
                f"got {rows} x {columns} at {pitch_mm} mm"
            )
        if dtype not in (torch.float32, torch.float64):
            raise ValueError(f"a gel computes in float32 or float64, got {dtype}")
        self.material, self.rows, self.columns, self.pitch_mm = material, rows, columns, pitch_mm
        self.dtype, self.device = dtype, torch.device(device)
        self._modulus = (
            None if body_modulus_mpa is None else self._checked_modulus(body_modulus_mpa)
        )
        # Stiffness of the layer to a wave as long as itself (a half-space: as the grid), for
        # first guesses only.
        size = min(material.thickness_mm, 0.5 * pitch_mm * max(rows, columns))
        wave = torch.tensor(2.0 / size, dtype=torch.float64)
        if math.isinf(material.thickness_mm):
            self.stiffness = float(material.plane_strain_mpa * wave / 2.0)
        else:
            self.stiffness = 1.0 / float(layer_compliance(wave, material))

    def _checked_modulus(self, modulus_mpa: float | Tensor) -> Tensor:
        modulus = torch.as_tensor(modulus_mpa, dtype=self.dtype, device=self.device)
        if modulus.ndim > 1 or not bool((modulus > 0).all()):
            raise ValueError(
                f"body_modulus_mpa must be > 0, one number or (B,), got {modulus_mpa}; "
                "None is a rigid body"
            )
        return modulus

    def _spectrum(self, material: GelMaterial | None) -> Spectrum:
        return spectrum_of(
            material, self.rows, self.columns, self.pitch_mm, self.dtype, self.device
        )

    @cached_property
    def _gel_spectrum(self) -> Spectrum:
        """Made when first used: ``sim.gel.fine.fine`` needs it of few of its grids."""
        return self._spectrum(self.material)

    @cached_property
    def _combined_spectrum(self) -> Spectrum:
        """Gel and body in series."""
        if self._modulus is None:
            return self._gel_spectrum
        inverse = 1.0 / self._modulus
        if inverse.ndim == 1:
            inverse = inverse[:, None, None]
        return replace(
            self._gel_spectrum,
            values=self._gel_spectrum.values + inverse * self._spectrum(None).values,
        )

    def surface(self, pressure_kpa: Tensor) -> Tensor:
        """Displacement of the gel's surface, positive into the gel.

        Args:
            pressure_kpa: (B, H, W) [kPa].

        Returns:
            (B, H, W) [mm].
        """
        return self._gel_spectrum.apply(self._as_grid(pressure_kpa, "pressure_kpa") * 1e-3)

    def press_to_force(
        self,
        gap_mm: Tensor,
        force_n: Tensor,
        *,
        start: Press | Tensor | None = None,
        mask: Tensor | None = None,
        tol: float = 1e-4,
        max_iterations: int = 300,
    ) -> Press:
        """Press a body with a given normal force.

        Args:
            gap_mm: Height of the undeformed body above its lowest point, (B, H, W), >= 0 [mm];
                +inf (or above ``NO_BODY_MM``) where there is no body.
            force_n: (B,) or one number, >= 0 [N].
            start: A similar press, or its pressure (B, H, W) [kPa], to start from.
            mask: Where the pad can carry pressure, bool (H, W) or (B, H, W); all if None.
            tol: Residual gap over the mean displacement in contact, root mean square. The worst
                height is then off by about 0.1 µm at 1e-4 and 1 µm at 1e-3, which takes half
                the time (measured by ``tacgrasp bench gel``).
            max_iterations: Bound of the solver; see ``Press.converged``.

        Raises:
            ValueError: A shape, sign or value makes no sense.
        """
        gap, force = self.check_inputs(gap_mm, force_n, by_force=True, mask=mask)
        target = force / self.pitch_mm**2
        guess = self.first_pressure(start, gap, self._springs_depth(gap, target))
        total = guess.flatten(1).sum(1).clamp(min=1e-30)
        solution = solve(
            self._compliance(gap.shape[0]),
            gap,
            target,
            by_force=True,
            start_mpa=guess * (target / total)[:, None, None],
            stiffness=self.stiffness,
            tol=tol,
            max_iterations=max_iterations,
        )
        return self._press(solution)

    def press_to_depth(
        self,
        gap_mm: Tensor,
        depth_mm: Tensor,
        *,
        start: Press | Tensor | None = None,
        mask: Tensor | None = None,
        tol: float = 1e-4,
        max_iterations: int = 300,
    ) -> Press:
        """Press a body until its undeformed lowest point is ``depth_mm`` below the surface.

        Args:
            gap_mm: As for ``press_to_force``.
            depth_mm: (B,) or one number [mm]; not touching where it is below the smallest gap.
            start: As for ``press_to_force``.
            mask: As for ``press_to_force``.
            tol: As for ``press_to_force``.
            max_iterations: As for ``press_to_force``.

        Raises:
            ValueError: A shape, sign or value makes no sense.
        """
        gap, depth = self.check_inputs(gap_mm, depth_mm, by_force=False, mask=mask)
        solution = solve(
            self._compliance(gap.shape[0]),
            gap,
            depth,
            by_force=False,
            start_mpa=self.first_pressure(start, gap, depth),
            stiffness=self.stiffness,
            tol=tol,
            max_iterations=max_iterations,
        )
        return self._press(solution)

    def check_inputs(
        self, gap_mm: Tensor, load: Tensor | float, *, by_force: bool, mask: Tensor | None = None
    ) -> tuple[Tensor, Tensor]:
        """Gaps and loads of a press, checked, of this gel's dtype and on its device.

        Args:
            gap_mm: As for ``press_to_force``.
            load: Forces [N] if ``by_force``, else depths [mm]; (B,) or one number.
            by_force: Which of the two is given.
            mask: As for ``press_to_force``.

        Returns:
            Gaps (B, H, W) [mm], ``NO_BODY_MM`` where no pressure can act, and loads (B,).

        Raises:
            ValueError: A shape, sign or value makes no sense.
        """
        gap = self._checked_gap(gap_mm, mask)
        loads = self._per_contact(load, gap.shape[0], "force_n" if by_force else "depth_mm")
        if by_force and not bool(((loads >= 0) & torch.isfinite(loads)).all()):
            raise ValueError(f"force_n must be finite and >= 0 N, got {loads.tolist()}")
        if not bool(torch.isfinite(loads).all()):
            raise ValueError(f"depth_mm must be finite, got {loads.tolist()}")
        return gap, loads

    def _press(self, solution: Solution) -> Press:
        pressure = solution.pressure_mpa
        return Press(
            pressure_kpa=pressure * 1e3,
            height_mm=self._gel_spectrum.apply(pressure),
            force_n=pressure.flatten(1).sum(1) * self.pitch_mm**2,
            depth_mm=solution.approach_mm,
            iterations=solution.iterations,
            converged=solution.converged,
        )

    def _compliance(self, batch: int) -> Spectrum:
        values = self._combined_spectrum.values
        if values.ndim == 3 and values.shape[0] != batch:
            raise ValueError(
                f"body_modulus_mpa was given for {values.shape[0]} bodies, "
                f"but {batch} are pressed; give as many of both"
            )
        return self._combined_spectrum

    def _as_grid(self, value: Tensor, name: str) -> Tensor:
        field = torch.as_tensor(value, dtype=self.dtype, device=self.device)
        if field.ndim != 3 or tuple(field.shape[1:]) != (self.rows, self.columns):
            raise ValueError(
                f"{name} must have shape (B, {self.rows}, {self.columns}), got {tuple(field.shape)}"
            )
        return field

    def _per_contact(self, value: Tensor | float, batch: int, name: str) -> Tensor:
        values = torch.as_tensor(value, dtype=self.dtype, device=self.device)
        if values.ndim > 1 or values.numel() not in (1, batch):
            raise ValueError(f"{name} must be one number or ({batch},), got {tuple(values.shape)}")
        return values.reshape(-1).expand(batch)

    def _checked_gap(self, gap_mm: Tensor, mask: Tensor | None) -> Tensor:
        """Checked gap, ``NO_BODY_MM`` where no pressure can act."""
        gap = self._as_grid(gap_mm, "gap_mm")
        batch = len(gap)
        if gap.stride(0) == 0:  # one body, expanded
            gap = gap[:1]
        if not bool((gap >= -1e-5).all()):
            raise ValueError(
                "gap_mm must be >= 0 everywhere and not NaN: it is the body's height above its "
                f"own lowest point; the smallest is {gap.min().item()} mm"
            )
        gap = gap.clamp(max=NO_BODY_MM)
        if mask is not None:
            field = torch.as_tensor(mask, device=self.device)
            if field.dtype != torch.bool or tuple(field.shape[-2:]) != (self.rows, self.columns):
                raise ValueError(
                    f"mask must be bool (H, W) or (B, H, W) with H, W = {self.rows}, "
                    f"{self.columns}; got {field.dtype} {tuple(field.shape)}"
                )
            gap = torch.where(field, gap, NO_BODY_MM)
        return gap if len(gap) == batch else gap.expand(batch, -1, -1)

    def _springs_depth(self, gap: Tensor, target: Tensor) -> Tensor:
        """Depth at which springs of the guessed stiffness carry ``target``.

        Newton's method from above, where it cannot overshoot: what springs carry is convex in
        depth. Six steps are plenty for a guess.
        """
        flat = gap.flatten(1)
        carried = target / self.stiffness
        depth = (flat.amin(1) + carried).clamp(max=_DEEPEST_GUESS_MM)
        for _ in range(6):
            overlap = (depth[:, None] - flat).clamp_(min=0)
            pressed = (overlap > 0).sum(1).clamp(min=1)
            depth = depth - (overlap.sum(1) - carried).clamp(min=0) / pressed
        return depth

    def first_pressure(self, start: Press | Tensor | None, gap: Tensor, depth: Tensor) -> Tensor:
        """First pressures (B, H, W) [MPa]: what was given where it presses at all, else springs.

        Args:
            start: As for ``press_to_force``.
            gap: As ``checked`` gives it, (B, H, W) [mm].
            depth: Of the springs, (B,) [mm].

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
