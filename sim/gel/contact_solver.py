"""Normal contact of an elastic surface with a shape: constrained conjugate gradients.

Solves for the pressure p >= 0 with gap >= 0 and p·gap = 0, by force or by approach, for a batch of
contacts at once. Each contact stops on its own residual and then leaves the batch, so that its
solution does not depend on the rest of the batch.

Not here: the compliance (``sim.gel.compliance``), units and materials of a sensor
(``sim.gel.layer``).

Source: Polonsky & Keer (1999), Wear 231, 206-219, but with a stop on the residual gap instead of
the change of pressure (our choice: it bounds the error of the surface).
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, TypeVar

import torch
from torch import Tensor

from sim.gel.compliance import Spectrum
from sim.gel.gap import NO_BODY_MM

if TYPE_CHECKING:
    from _typeshed import DataclassInstance


@dataclass(frozen=True, slots=True, kw_only=True)
class Solution:
    """Pressures and approaches of a batch.

    Attributes:
        pressure_mpa: (B, H, W) [MPa].
        approach_mm: (B,) [mm]; +inf where the force cannot be reached by any approach.
        iterations: (B,) int64.
        converged: (B,) bool; False where ``max_iterations`` stopped the contact.
    """

    pressure_mpa: Tensor
    approach_mm: Tensor
    iterations: Tensor
    converged: Tensor


@dataclass(slots=True, kw_only=True)
class _Active:
    """Contacts that have not converged yet; grids are flat, (B, H·W)."""

    index: Tensor
    pressure: Tensor
    gap: Tensor
    target: Tensor
    direction: Tensor
    norm: Tensor
    conjugate: Tensor
    compliance: Spectrum

    def retain(self, mask: Tensor) -> None:
        """Drop every contact whose ``mask`` is False."""
        self.index, self.pressure, self.gap = self.index[mask], self.pressure[mask], self.gap[mask]
        self.target, self.direction = self.target[mask], self.direction[mask]
        self.norm, self.conjugate = self.norm[mask], self.conjugate[mask]
        self.compliance = self.compliance.select(mask)

    def displacement(self, pressure: Tensor) -> Tensor:
        """Displacement under ``pressure``, both flat."""
        grid = pressure.unflatten(1, self.compliance.size)
        return self.compliance.apply(grid).flatten(1)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Residual:
    """Residual of each contact.

    Attributes:
        gap: Deformed gap where there is pressure, overlap where there is none, else 0.
        contact: 1 where there is pressure, else 0.
        count: Number of elements with pressure, at least 1.
        level: Approach.
        norm: Sum of the squared gap.
        mean: Mean displacement in contact.
    """

    gap: Tensor
    contact: Tensor
    count: Tensor
    level: Tensor
    norm: Tensor
    mean: Tensor

    def retain(self, mask: Tensor) -> _Residual:
        """Residual of the contacts whose ``mask`` is True."""
        return _Residual(**{each.name: getattr(self, each.name)[mask] for each in fields(self)})


Batch = TypeVar("Batch", bound="DataclassInstance")


def chosen(mask: Tensor, batch: Batch, other: Batch) -> Batch:
    """Contacts of ``batch`` where ``mask`` (B,), else of ``other``; fields are tensors (B, ...)."""

    def choose(first: Tensor, second: Tensor) -> Tensor:
        return torch.where(mask.view(-1, *[1] * (first.ndim - 1)), first, second)

    names = [each.name for each in fields(other)]
    pairs = {name: choose(getattr(batch, name), getattr(other, name)) for name in names}
    return replace(other, **pairs)


def _dot(a: Tensor, b: Tensor) -> Tensor:
    # Not bmm: its rounding depends on the size of the batch.
    return (a * b).sum(1)


def solve(
    compliance: Spectrum,
    gap_mm: Tensor,
    target: Tensor,
    *,
    by_force: bool,
    start_mpa: Tensor,
    stiffness: float,
    tol: float,
    max_iterations: int,
) -> Solution:
    """Solve a batch of contacts.

    Args:
        compliance: Compliance of the two surfaces together.
        gap_mm: Undeformed gap, (B, H, W) [mm]; ``NO_BODY_MM`` where no pressure can act.
        target: (B,) sum of the pressures [MPa] if ``by_force``, else the approach [mm].
        by_force: Whether the target is a force.
        start_mpa: First guess, >= 0, zero where no pressure can act, (B, H, W) [MPa].
        stiffness: Pressure per gap of the first step where no contact exists [MPa/mm].
        tol: Root mean square of the residual gap over the mean displacement in contact.
        max_iterations: Bound of the iterations.

    Returns:
        The solution; contacts without load have zero pressure.
    """
    batch = gap_mm.shape[0]
    flat = gap_mm.flatten(1)
    lowest = flat.amin(1)
    pressure = torch.zeros_like(flat)
    approach = torch.where(lowest < NO_BODY_MM, lowest, torch.inf) if by_force else target.clone()
    iterations = torch.zeros(batch, dtype=torch.int64, device=flat.device)
    converged = torch.ones(batch, dtype=torch.bool, device=flat.device)
    loaded = (target > 0) & (lowest < NO_BODY_MM) & (by_force | (target > lowest))
    active = _Active(
        index=torch.arange(batch, device=flat.device),
        pressure=start_mpa.flatten(1),
        gap=flat,
        target=target,
        direction=torch.zeros_like(flat),
        norm=torch.ones_like(target),
        conjugate=torch.zeros_like(target),
        compliance=compliance,
    )
    if not bool(loaded.all()):
        active.retain(loaded)
    for step in range(max_iterations + 1):
        if active.index.numel() == 0:
            break
        residual = _residual(active, by_force=by_force)
        done = residual.norm <= residual.count * (tol * residual.mean) ** 2
        if step == max_iterations:
            converged[active.index] = done
            done = torch.ones_like(done)
        if bool(done.any()):
            ended = active.index[done]
            pressure[ended], approach[ended] = active.pressure[done], residual.level[done]
            iterations[ended] = step
            mask = ~done
            active.retain(mask)
            residual = residual.retain(mask)
            if active.index.numel() == 0:
                break
        _advance(active, residual, by_force=by_force, stiffness=stiffness)
    return Solution(
        pressure_mpa=pressure.view_as(gap_mm),
        approach_mm=approach,
        iterations=iterations,
        converged=converged,
    )


def _residual(active: _Active, *, by_force: bool) -> _Residual:
    displacement = active.displacement(active.pressure)
    pressed = active.pressure > 0
    contact = pressed.to(displacement.dtype)
    count = contact.sum(1).clamp(min=1)
    mean = _dot(displacement, contact) / count
    gap = displacement.add_(active.gap)
    level = _dot(gap, contact) / count if by_force else active.target
    gap -= level[:, None]
    gap = torch.where(pressed, gap, gap.clamp(max=0))
    return _Residual(
        gap=gap, contact=contact, count=count, level=level, norm=_dot(gap, gap), mean=mean
    )


def _advance(active: _Active, residual: _Residual, *, by_force: bool, stiffness: float) -> None:
    """One conjugate-gradient step, in place: direction, step length, projection, force."""
    gap_in = residual.gap * residual.contact
    norm = _dot(gap_in, gap_in)
    beta = active.conjugate * norm / active.norm.clamp(min=1e-30)
    active.direction = torch.addcmul(gap_in, active.direction * residual.contact, beta[:, None])
    active.norm = norm
    response = active.displacement(active.direction)
    curvature = _dot(response, active.direction)
    if by_force:
        mean = _dot(response, residual.contact) / residual.count
        curvature -= mean * active.direction.sum(1)
    ratio = _dot(gap_in, active.direction) / curvature.clamp(min=1e-30)
    length = torch.where(curvature > 0, ratio, stiffness)[:, None]
    overlap = residual.gap - gap_in
    pressure = active.pressure.addcmul(active.direction, length, value=-1.0).clamp_(min=0)
    pressure = pressure.addcmul_(overlap, length, value=-1.0)
    active.conjugate = (overlap.amin(1) >= 0).to(norm.dtype)
    if by_force:
        pressure *= (active.target / pressure.sum(1).clamp(min=1e-30))[:, None]
    active.pressure = pressure
