"""Bodies of revolution as height fields towards a finger, on the grid of all bodies.

Not here: which bodies there are (``sim.grasp.bodies``, ``sim.grasp.fruit``).
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from cltp.tactile.cloud import FloatArray
from sim.gel.gap import NO_BODY_MM

PITCH_MM = 0.15
HALF_SPAN_MM = 24.0
GRID_MM = np.arange(-HALF_SPAN_MM, HALF_SPAN_MM + PITCH_MM / 2, PITCH_MM)

BodyShape = tuple[FloatArray, tuple[float, float], float, float]
"""Height field on ``GRID_MM``, centre of mass, radius of gyration and thickness [mm], as in
``sim.grasp.bodies.Body``."""


def oval(diameter: float, taper: float = 0.0) -> Callable[[FloatArray], FloatArray]:
    """Radius [mm] of an ellipsoid, narrower by ``taper`` towards its upper end."""

    def radius(s: FloatArray) -> FloatArray:
        u = 2 * np.clip(s, 0, 1) - 1
        return diameter / 2 * np.sqrt(np.clip(1 - u**2, 0, None)) / (1 + taper * u)

    return radius


def revolved(
    radius: Callable[[FloatArray], FloatArray],
    length: float,
    roll: float,
    relief: Callable[[FloatArray, FloatArray], FloatArray] | None = None,
) -> BodyShape:
    """Height field of a body of revolution whose axis lies in the plane between the fingers.

    Args:
        radius: Radius [mm] at the fraction s of the length, 0 at the lower end.
        length: Length along the axis [mm].
        roll: Tilt of the axis from the vertical, in the pad's plane [rad].
        relief: Added height [mm] at (s, angle about the axis), such as seeds.
    """
    x, y = np.meshgrid(GRID_MM, -GRID_MM)
    s = np.linspace(0, 1, 401)
    r = radius(s)
    widest = float(s[r >= r.max() - 1e-9].mean())
    # along and across the axis, from the widest point, which is the nearest to the finger
    t = x * math.sin(roll) + y * math.cos(roll)
    u = x * math.cos(roll) - y * math.sin(roll)
    fraction = widest + t / length
    reach = radius(fraction)
    hit = (reach > np.abs(u)) & (fraction > 0) & (fraction < 1)
    front = np.sqrt(np.clip(reach**2 - u**2, 0, None))
    if relief is not None:
        front = front + relief(fraction, np.arctan2(u, front))
    gap = np.where(hit, front[hit].max() - front, NO_BODY_MM)
    weight = r**2
    centroid = float((s * weight).sum() / weight.sum())
    along = (centroid - widest) * length
    spread = float(np.sqrt(((s - centroid) ** 2 * weight).sum() / weight.sum())) * length
    gyration = math.hypot(spread, float(np.sqrt((r**2 * weight).sum() / weight.sum()) / 2))
    com = (along * math.sin(roll), along * math.cos(roll))
    return gap, com, gyration, 2 * float(r.max())
