"""Limits of all commands: a step or a force is clamped, everything else is refused.

Pure functions of numbers. A step and a force are clamped and the clamp is reported, since a smaller
one still serves the request. A pose outside the workspace, or travel beyond the limit, is refused:
no smaller one is known to be harmless. Not here: the execution (``primitives.execution``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from primitives.devices import Pose
from primitives.errors import LimitError


@dataclass(frozen=True, slots=True, kw_only=True)
class Limits:
    """Bounds of all commands of one episode.

    Attributes:
        max_step_mm: Longest single move [mm].
        workspace_low_m, workspace_high_m: Opposite corners of the box around all positions of the
            tool centre point [m, base frame]; three numbers each.
        max_travel_mm: Longest path of the tool centre point over an episode [mm].
        min_force_n, max_force_n: Range of commanded forces [N].
        max_speed_m_s: Speed of every move [m/s].

    Raises:
        LimitError: A bound is not finite or not positive, or a range is empty; the message names
            it.
    """

    max_step_mm: float
    workspace_low_m: tuple[float, float, float]
    workspace_high_m: tuple[float, float, float]
    max_travel_mm: float
    min_force_n: float
    max_force_n: float
    max_speed_m_s: float

    def __post_init__(self) -> None:
        for name in (
            "max_step_mm", "max_travel_mm", "min_force_n", "max_force_n", "max_speed_m_s"
        ):  # fmt: skip
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0):
                raise LimitError(f"{name} must be finite and above 0, got {value}")
        if self.min_force_n > self.max_force_n:
            raise LimitError(
                f"min_force_n {self.min_force_n} is above max_force_n {self.max_force_n}"
            )
        for name in ("workspace_low_m", "workspace_high_m"):
            corner = tuple(float(v) for v in getattr(self, name))
            if len(corner) != 3 or not all(math.isfinite(v) for v in corner):
                raise LimitError(f"{name} must be three finite numbers [m], got {corner}")
            object.__setattr__(self, name, corner)
        corners = zip("xyz", self.workspace_low_m, self.workspace_high_m, strict=True)
        for axis, low, high in corners:
            if low >= high:
                raise LimitError(f"the workspace is empty along {axis}: {low} m to {high} m")


@dataclass(frozen=True, slots=True, kw_only=True)
class LimitedValue:
    """A number after the limits.

    Attributes:
        value: The value that may be sent, in the unit of the request.
        note: Description of the change by the limits; '' without a change.
    """

    value: float
    note: str = ""


def clamp_step(step_mm: float, limits: Limits) -> LimitedValue:
    """Clamp the length of a step to ``max_step_mm``.

    Raises:
        LimitError: The length is not finite or negative.
    """
    if not (math.isfinite(step_mm) and step_mm >= 0):
        raise LimitError(f"a step needs a finite length of at least 0 mm, got {step_mm}")
    if step_mm > limits.max_step_mm:
        note = f"step {step_mm:.3g} mm shortened to max_step_mm {limits.max_step_mm:.3g}"
        return LimitedValue(value=limits.max_step_mm, note=note)
    return LimitedValue(value=step_mm)


def clamp_force(force_n: float, limits: Limits) -> LimitedValue:
    """Clamp a force to ``min_force_n`` and ``max_force_n``.

    Raises:
        LimitError: The force is not finite or not positive.
    """
    if not (math.isfinite(force_n) and force_n > 0):
        raise LimitError(f"a grip needs a finite force above 0 N, got {force_n}")
    if force_n > limits.max_force_n:
        note = f"force {force_n:.3g} N lowered to max_force_n {limits.max_force_n:.3g}"
        return LimitedValue(value=limits.max_force_n, note=note)
    if force_n < limits.min_force_n:
        note = f"force {force_n:.3g} N raised to min_force_n {limits.min_force_n:.3g}"
        return LimitedValue(value=limits.min_force_n, note=note)
    return LimitedValue(value=force_n)


def check_workspace(pose: Pose, limits: Limits) -> None:
    """Refuse a pose whose position lies outside the workspace.

    Raises:
        LimitError: It is outside; the message names axis, value and bound.
    """
    bounds = zip(
        "xyz", pose.position_m, limits.workspace_low_m, limits.workspace_high_m, strict=True
    )
    for axis, value, low, high in bounds:
        if not low <= value <= high:
            raise LimitError(
                f"{axis} = {value:.4f} m would leave the workspace ({low} to {high} m); "
                "nothing was sent. Widen the rig's workspace or start elsewhere"
            )


def check_travel(travelled_mm: float, step_mm: float, limits: Limits) -> None:
    """Refuse a move that would exceed the travel allowed over an episode.

    Raises:
        LimitError: The travel would exceed the limit, or is not finite.
    """
    total = travelled_mm + step_mm
    if not (math.isfinite(total) and travelled_mm >= 0 and step_mm >= 0):
        raise LimitError(f"travel must be finite and at least 0 mm, got {travelled_mm} + {step_mm}")
    if total > limits.max_travel_mm:
        raise LimitError(
            f"{travelled_mm:.1f} mm travelled and {step_mm:.1f} mm to go exceed max_travel_mm "
            f"{limits.max_travel_mm:.1f}; nothing was sent. Start a new episode"
        )


def distance_mm(a: Pose, b: Pose) -> float:
    """Distance between the positions of two poses [mm]."""
    difference: NDArray[np.float64] = a.position_m - b.position_m
    return 1e3 * float(np.linalg.norm(difference))
