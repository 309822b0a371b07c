"""The motion by which a body under a tangential load comes to rest on a gel, if friction holds it.

``ShearLayer.step`` is given a motion and returns force and moment; here it is the other way round.

Not here: a body that slides, which needs its inertia (``sim.grasp.world``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import torch
from torch import Tensor

from sim.gel.shear.compliance import longitudinal_compliance
from sim.gel.shear.layer import Shear, ShearLayer

_EVALUATIONS = 20
_REACH = 3.0  # largest correction of the motion, in displacements at which the contact slides


@dataclass(frozen=True, slots=True, kw_only=True)
class Carried:
    """Contacts under given loads.

    Attributes:
        shear: Contacts at rest; where ``holds`` is False, those of the last motion that was tried.
        motion: Motion of the bodies, as ``ShearLayer.step`` takes it, (B, 3) [mm, mm, rad].
        holds: Whether friction carries the load, (B,) bool.
        evaluations: Number of motions that were tried.
    """

    shear: Shear
    motion: Tensor
    holds: Tensor
    evaluations: int


def carry(
    layer: ShearLayer,
    before: Shear | None,
    pressure_kpa: Tensor,
    load: Tensor,
    *,
    load_tol: float = 1e-3,
    tol: float = 1e-4,
) -> Carried:
    """Find the motions under which the contacts carry their loads.

    Force and moment are the gradient of a convex energy of the motion, so that there is one
    motion, up to the friction that holds. Found by a quasi-Newton method (BFGS) in three unknowns,
    about the contact's centre and with its radius times the turn, from the compliance of a wave as
    wide as the contact.

    Args:
        layer: Gel and friction.
        before: Contacts before the load; None is at rest.
        pressure_kpa: Pressure under the load, (B, H, W) [kPa].
        load: Force (x, y) [N] on the gel and moment about the grid's centre [N mm], (B, 3).
        load_tol: Largest error of a load over the friction of the contact.
        tol: As in ``ShearLayer.step``.

    Raises:
        ValueError: A shape or value is out of range.
    """
    load = torch.as_tensor(load, dtype=layer.layer.dtype, device=layer.layer.device)
    if load.ndim != 2 or load.shape[1] != 3 or not bool(torch.isfinite(load).all()):
        raise ValueError(
            f"load must be finite, (B, 3): force x and y in N, moment in N mm; got {load}"
        )
    motion = torch.zeros_like(load)
    shear = layer.step(before, pressure_kpa, motion, tol=tol)
    area = layer.layer.pitch_mm**2
    friction_n = layer.friction * 1e-3 * shear.pressure_kpa.sum((1, 2)) * area
    pressed = (shear.pressure_kpa > 0).sum((1, 2)).clamp(min=1)
    radius = (pressed * area / math.pi).sqrt()
    axes = _axes(layer, shear, radius)
    soft = longitudinal_compliance(2.0 / radius, layer.layer.material)
    if layer.body is not None:
        soft = soft + longitudinal_compliance(2.0 / radius, layer.body)
    soft = soft / (math.pi * radius**2)
    inverse = soft[:, None, None] * torch.eye(3, dtype=load.dtype, device=load.device)
    reach = (_REACH * soft * friction_n)[:, None]
    missing = _missing(shear, load, axes)
    holds = missing.norm(dim=1) <= load_tol * friction_n
    evaluations = 1
    while not bool(holds.all()) and evaluations < _EVALUATIONS:
        correction = torch.einsum("bij,bj->bi", inverse, missing)
        size = correction.norm(dim=1, keepdim=True).clamp(min=1e-30)
        correction = torch.where(holds[:, None], 0.0, correction * (reach / size).clamp(max=1.0))
        motion = motion + torch.einsum("bij,bj->bi", axes, correction)
        shear = layer.step(before, pressure_kpa, motion, start_kpa=shear.traction_kpa, tol=tol)
        left = _missing(shear, load, axes)
        inverse = _improved(inverse, correction, missing - left)
        missing, evaluations = left, evaluations + 1
        holds = missing.norm(dim=1) <= load_tol * friction_n
    return Carried(shear=shear, motion=motion, holds=holds, evaluations=evaluations)


def _axes(layer: ShearLayer, shear: Shear, radius: Tensor) -> Tensor:
    """Motion of the grid per motion of the contact, (B, 3, 3).

    The contact's motion is that of its centre of pressure and the turn about it times the radius,
    all [mm]; its loads then are forces [N], the transpose of this times those about the grid's
    centre.
    """
    share = shear.pressure_kpa / shear.pressure_kpa.sum((1, 2), keepdim=True).clamp(min=1e-30)
    turn_x, turn_y = (share[:, None] * layer.displacement_of_turn).sum((2, 3)).unbind(1)
    axes = torch.eye(3, dtype=share.dtype, device=share.device).repeat(len(share), 1, 1)
    axes[:, 0, 2], axes[:, 1, 2], axes[:, 2, 2] = -turn_x / radius, -turn_y / radius, 1.0 / radius
    return axes


def _missing(shear: Shear, load: Tensor, axes: Tensor) -> Tensor:
    """Load that the contacts do not carry yet, about their own axes, (B, 3) [N]."""
    carried = torch.cat([shear.force_n, shear.moment_nmm[:, None]], 1)
    return torch.einsum("bij,bi->bj", axes, load - carried)


def _improved(inverse: Tensor, correction: Tensor, carried: Tensor) -> Tensor:
    """BFGS update of the motion per load (B, 3, 3) by what a correction carried.

    It stays symmetric and positive, as the derivative of a convex energy's gradient is; where a
    correction carried next to nothing along itself, there is nothing to learn.
    """
    along = (correction * carried).sum(1)
    known = along > 1e-3 * correction.norm(dim=1) * carried.norm(dim=1)
    weight = torch.where(known, 1.0 / torch.where(known, along, 1.0), 0.0)[:, None, None]
    unit = torch.eye(3, dtype=inverse.dtype, device=inverse.device)
    left = unit - weight * correction[:, :, None] * carried[:, None, :]
    square = weight * correction[:, :, None] * correction[:, None, :]
    return left @ inverse @ left.transpose(1, 2) + square
