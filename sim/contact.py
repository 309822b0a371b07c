"""Normal contact of an elastic surface with a shape: constrained conjugate gradients.

Finds the pressure p >= 0 with gap >= 0 and p·gap = 0, for a given force or a given approach, for
a batch of contacts at once. Each contact stops on its own residual and leaves the batch then, so
that its answer does not depend on its company.

Not here: the compliance (``sim.compliance``), units and materials of a sensor (``sim.gel``).

Source: Polonsky & Keer (1999), Wear 231, 206-219; with the stop on the residual gap instead of
the change of pressure (our choice: it bounds the error of the surface).
"""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor

from sim.compliance import Spectrum


@dataclass(frozen=True, slots=True, kw_only=True)
class Solution:
    """Pressures and approaches of a batch.

    Attributes:
        pressure_mpa: (B, H, W) [MPa].
        approach_mm: (B,) [mm]; +inf where the force cannot be reached by any approach.
        iterations: (B,) int64.
        converged: (B,) bool; False where ``max_iterations`` ended it.
    """

    pressure_mpa: Tensor
    approach_mm: Tensor
    iterations: Tensor
    converged: Tensor


@dataclass(slots=True, kw_only=True)
class _Active:
    """The contacts that are still being solved; every tensor has the same leading size."""

    index: Tensor
    pressure: Tensor
    gap: Tensor
    allowed: Tensor
    target: Tensor
    direction: Tensor
    norm: Tensor
    conjugate: Tensor
    compliance: Spectrum

    def keep(self, rest: Tensor) -> None:
        """Drop every contact whose ``rest`` is False."""
        self.index, self.pressure, self.gap = self.index[rest], self.pressure[rest], self.gap[rest]
        self.allowed, self.target = self.allowed[rest], self.target[rest]
        self.direction, self.norm = self.direction[rest], self.norm[rest]
        self.conjugate = self.conjugate[rest]
        self.compliance = self.compliance.select(rest)


def _total(x: Tensor) -> Tensor:
    return x.flatten(1).sum(1)


def _wide(x: Tensor) -> Tensor:
    return x[:, None, None]


def solve(
    compliance: Spectrum,
    gap_mm: Tensor,
    allowed: Tensor,
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
        compliance: Of the two surfaces together.
        gap_mm: Undeformed gap, finite, (B, H, W) [mm].
        allowed: Where pressure may act, bool (B, H, W).
        target: (B,) sum of the pressures [MPa] if ``by_force``, else the approach [mm].
        by_force: Which of the two is given.
        start_mpa: First guess, >= 0, zero where not allowed, (B, H, W) [MPa].
        stiffness: Pressure per gap of the first step where no contact exists [MPa/mm].
        tol: Root mean square of the residual gap over the mean displacement in contact.
        max_iterations: Bound.

    Returns:
        The solution; contacts with nothing to carry have zero pressure.
    """
    batch = gap_mm.shape[0]
    free_gap = torch.where(allowed, gap_mm, torch.inf).flatten(1).amin(1)
    pressure = torch.zeros_like(gap_mm)
    approach = free_gap.clone() if by_force else target.clone()
    iterations = torch.zeros(batch, dtype=torch.int64, device=gap_mm.device)
    converged = torch.ones(batch, dtype=torch.bool, device=gap_mm.device)
    loaded = (target > 0) & torch.isfinite(free_gap) if by_force else target > free_gap
    zeros = torch.zeros_like(target)
    act = _Active(
        index=torch.arange(batch, device=gap_mm.device),
        pressure=start_mpa,
        gap=gap_mm,
        allowed=allowed,
        target=target,
        direction=torch.zeros_like(gap_mm),
        norm=torch.ones_like(zeros),
        conjugate=zeros,
        compliance=compliance,
    )
    act.keep(loaded)
    for step in range(max_iterations + 1):
        if act.index.numel() == 0:
            break
        displacement = act.compliance.apply(act.pressure)
        contact = act.pressure > 0
        count = _total(contact).clamp(min=1)
        gap = displacement + act.gap
        level = _total(gap * contact) / count if by_force else act.target
        gap -= _wide(level)
        overlap = act.allowed & ~contact & (gap < 0)
        wrong = _total(gap * gap * (contact | overlap)) / count
        done = wrong.sqrt() <= tol * (_total(displacement * contact) / count)
        if step == max_iterations:
            converged[act.index] = done
            done = torch.ones_like(done)
        if bool(done.any()):
            ended = act.index[done]
            pressure[ended], approach[ended] = act.pressure[done], level[done]
            iterations[ended] = step
            rest = ~done
            act.keep(rest)
            gap, contact = gap[rest], contact[rest]
            if act.index.numel() == 0:
                break
        _advance(act, gap, contact, by_force=by_force, stiffness=stiffness)
    return Solution(
        pressure_mpa=pressure, approach_mm=approach, iterations=iterations, converged=converged
    )


def _advance(
    act: _Active, gap: Tensor, contact: Tensor, *, by_force: bool, stiffness: float
) -> None:
    """One conjugate-gradient step, in place: direction, step length, projection, force."""
    gap_in = gap * contact
    norm = _total(gap_in * gap_in)
    beta = act.conjugate * norm / act.norm.clamp(min=1e-30)
    act.direction = (gap_in + _wide(beta) * act.direction) * contact
    act.norm = norm
    response = act.compliance.apply(act.direction)
    if by_force:
        mean = _total(response * contact) / _total(contact).clamp(min=1)
        response = response - _wide(mean)
    curvature = _total(response * act.direction)
    ratio = _total(gap_in * act.direction) / curvature.clamp(min=1e-30)
    length = torch.where(curvature > 0, ratio, stiffness)
    pressure = (act.pressure - _wide(length) * act.direction).clamp_(min=0)
    entering = act.allowed & (pressure == 0) & (gap < 0)
    pressure -= _wide(length) * gap * entering
    act.conjugate = 1.0 - entering.flatten(1).any(1).to(norm.dtype)
    if by_force:
        pressure *= _wide(act.target / _total(pressure).clamp(min=1e-30))
    act.pressure = pressure
