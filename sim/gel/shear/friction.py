"""Stick and slip of a contact under given pressure: the traction that Coulomb's friction allows.

In one step each point of the body would carry the gel's surface to a displacement b. The traction
q, at most r = friction times pressure, leaves the slip s = b - A q, with the compliance A. A point
sticks, s = 0, or slips with |q| = r along s. These are the conditions of the least
½ q·A q - b·q over the discs |q| <= r, which has one solution, since A is positive definite.

Solved by projected gradients with Barzilai and Borwein's step lengths, taken in turn from the
change of traction and of slip: one convolution an iteration. A step that raises the energy above
the last few is taken again with the inverse of the largest compliance, which always lowers it. The
conjugate gradient that solves for pressure is no help: its direction is lost whenever a point
changes between stick and slip or its slip turns.

Not here: the memory from step to step (``sim.gel.shear.layer``).

Sources: Kalker (1990), Three-Dimensional Elastic Bodies in Rolling Contact, for the principle;
Birgin, Martinez and Raydan (2000), SIAM J. Optim. 10, 1196-1211, for the method; the alternation
is our choice.
"""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor

from sim.gel.shear.kernels import ShearSpectrum

_MEMORY = 8
"""Energies among which the largest bounds the next."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FrictionSolution:
    """Traction and slip of a batch.

    Attributes:
        traction_mpa: (B, 2, H, W) [MPa].
        slip_mm: b - A q where there is pressure, else 0, (B, 2, H, W) [mm]. What is left of it
            where a point sticks is the error of the solution.
        slipping: (B, H, W) bool; points with friction that do not slip stick.
        at_limit: (B, H, W) bool: traction is at its limit, whether the point slips in this step or
            is about to.
        iterations: (B,) int64.
        converged: (B,) bool; False where ``max_iterations`` stopped the contact.
    """

    traction_mpa: Tensor
    slip_mm: Tensor
    slipping: Tensor
    at_limit: Tensor
    iterations: Tensor
    converged: Tensor


def solve_friction(
    compliance: ShearSpectrum,
    drive_mm: Tensor,
    limit_mpa: Tensor,
    *,
    start_mpa: Tensor,
    tol: float,
    max_iterations: int,
) -> FrictionSolution:
    """Solve a batch of contacts, one after the other: none depends on the rest of the batch.

    Args:
        compliance: Compliance of the two surfaces together.
        drive_mm: Displacement b at which each point would stick, (B, 2, H, W) [mm].
        limit_mpa: Largest traction r, >= 0, (B, H, W) [MPa].
        start_mpa: First guess of the traction, (B, 2, H, W) [MPa].
        tol: Root mean square of the slip that should not be, over that of the displacement.
        max_iterations: Bound of the iterations.
    """
    solved = [
        _solve_one(compliance, *each, tol=tol, max_iterations=max_iterations)
        for each in zip(drive_mm, limit_mpa, start_mpa, strict=True)
    ]
    device = drive_mm.device
    return FrictionSolution(
        traction_mpa=torch.stack([one.traction for one in solved]),
        slip_mm=torch.stack([one.slip for one in solved]),
        slipping=torch.stack([one.slipping for one in solved]),
        at_limit=torch.stack([one.at_limit for one in solved]),
        iterations=torch.tensor([one.iterations for one in solved], device=device),
        converged=torch.tensor([one.converged for one in solved], device=device),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _One:
    """The solution of one contact; grids as in ``FrictionSolution`` without the batch."""

    traction: Tensor
    slip: Tensor
    slipping: Tensor
    at_limit: Tensor
    iterations: int
    converged: bool


class _Discs:
    """The discs |q| <= r of one contact, (H, W), and what lies on their rims."""

    def __init__(self, limit_mpa: Tensor) -> None:
        self.limit = limit_mpa
        self.contact = (limit_mpa > 0).to(limit_mpa.dtype)
        self.count = max(1.0, float(self.contact.sum()))
        self._tiny = torch.finfo(limit_mpa.dtype).tiny
        self._rim = limit_mpa * (1.0 - 8.0 * torch.finfo(limit_mpa.dtype).eps)

    def project(self, traction: Tensor) -> Tensor:
        """The nearest traction (2, H, W) within the discs."""
        size = torch.hypot(traction[0], traction[1]).clamp_(min=self._tiny)
        return traction * (self.limit / size).clamp_(max=1.0)

    def on_rim(self, traction: Tensor) -> Tensor:
        """Which points with friction bear all of it, (H, W)."""
        return (torch.hypot(traction[0], traction[1]) >= self._rim) & (self.limit > 0)

    def split(self, traction: Tensor, slip: Tensor) -> tuple[Tensor, Tensor]:
        """Which points slip (H, W), and the part of ``slip`` that violates friction (2, H, W)."""
        size = torch.hypot(traction[0], traction[1])
        outward = (traction * slip).sum(0)
        slipping = (size >= self._rim) & (outward > 0)
        along = torch.where(slipping, outward / size.square().clamp_(min=self._tiny), 0.0)
        return slipping, torch.addcmul(slip, traction, along, value=-1.0)


def _dot(a: Tensor, b: Tensor) -> float:
    return float(torch.dot(a.flatten(), b.flatten()))


def _solve_one(
    compliance: ShearSpectrum,
    drive: Tensor,
    limit: Tensor,
    start: Tensor,
    *,
    tol: float,
    max_iterations: int,
) -> _One:
    discs = _Discs(limit)
    drive = drive * discs.contact
    safe_length = 1.0 / compliance.largest

    def slip_under(traction: Tensor) -> Tensor:
        return torch.addcmul(drive, compliance.apply(traction[None])[0], discs.contact, value=-1.0)

    traction = discs.project(start)
    slip = slip_under(traction)
    energies, length = [-0.5 * _dot(traction, drive + slip)], safe_length
    for step in range(max_iterations + 1):
        slipping, wrong = discs.split(traction, slip)
        moved = drive - slip
        done = _dot(wrong, wrong) <= tol * tol * _dot(moved, moved)
        if done or step == max_iterations:
            break
        for attempt in (length, safe_length):
            trial = discs.project(torch.add(traction, slip, alpha=attempt))
            trial_slip = slip_under(trial)
            energy = -0.5 * _dot(trial, drive + trial_slip)
            if energy <= max(energies) + 1e-6 * abs(energies[-1]):
                break
        change, response = trial - traction, slip - trial_slip
        traction, slip = trial, trial_slip
        energies = [*energies[1 - _MEMORY :], energy]
        across = _dot(change, response)
        if across > 0 and step % 2:
            length = _dot(change, change) / across
        elif across > 0:
            length = across / _dot(response, response)
        else:
            length = safe_length
    return _One(
        traction=traction,
        slip=slip,
        slipping=slipping,
        at_limit=discs.on_rim(traction),
        iterations=step,
        converged=bool(done),
    )
