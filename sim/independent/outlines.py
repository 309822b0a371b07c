"""Signed distances [mm] in the plane, negative inside: polygons, superellipses, polylines, moons.

Not here: the outlines of contacts to learn from (``sim.full.drawn.outlines``), which are others on
purpose.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from cltp.tactile.cloud import FloatArray


def polygon(u: FloatArray, v: FloatArray, corners: FloatArray) -> FloatArray:
    """Any simple polygon, convex or not; ``corners`` (N, 2) in either order."""
    squared, inside = np.full(np.shape(u), np.inf), np.zeros(np.shape(u), dtype=np.bool_)
    for (a_u, a_v), (b_u, b_v) in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        squared = np.minimum(squared, _squared_to_segment(u, v, (a_u, a_v), (b_u, b_v)))
        if a_v != b_v:
            crosses = (a_v > v) != (b_v > v)
            inside ^= crosses & (u < a_u + (b_u - a_u) * (v - a_v) / (b_v - a_v))
    return np.asarray(np.where(inside, -1.0, 1.0) * np.sqrt(squared))


def superellipse(
    u: FloatArray, v: FloatArray, half_u: float, half_v: float, power: float
) -> FloatArray:
    """|u / a|ⁿ + |v / b|ⁿ = 1; a distance near its rim only, to first order."""
    level = (np.abs(u / half_u) ** power + np.abs(v / half_v) ** power) ** (1 / power)
    return np.asarray((level - 1) * min(half_u, half_v))


def moon(u: FloatArray, v: FloatArray, radius: float, bite: float, shift: float) -> FloatArray:
    """A circle less another one, of radius ``bite``, shifted by ``shift`` along u [mm]."""
    return np.maximum(np.hypot(u, v) - radius, bite - np.hypot(u - shift, v))


def polyline(u: FloatArray, v: FloatArray, points: FloatArray) -> FloatArray:
    """Distance from an open line through ``points`` (N, 2), N ≥ 2 [mm]."""
    squared = np.full(np.shape(u), np.inf)
    for start, end in pairwise(points):
        squared = np.minimum(squared, _squared_to_segment(u, v, tuple(start), tuple(end)))
    return np.asarray(np.sqrt(squared))


def bow(
    half_length: float,
    turn_rad: float,
    offset: float = 0.0,
    part: tuple[float, float] = (-1.0, 1.0),
) -> FloatArray:
    """Points (17, 2) of a line along u that turns by ``turn_rad`` from end to end.

    Args:
        half_length: Half its length [mm].
        turn_rad: 0 for a straight line; a circle's arc otherwise.
        offset: Distance of the line from the one without offset, to its left [mm].
        part: The part between these ends, where the whole goes from -1 to 1.
    """
    s = np.linspace(*part, 17)
    if abs(turn_rad) < 1e-3:
        return np.stack([s * half_length, np.full_like(s, offset)], axis=1)
    radius = 2 * half_length / turn_rad
    angle = 0.5 * s * turn_rad
    inner = radius - offset
    return np.stack([inner * np.sin(angle), radius - inner * np.cos(angle)], axis=1)


def _squared_to_segment(
    u: FloatArray, v: FloatArray, start: tuple[float, ...], end: tuple[float, ...]
) -> FloatArray:
    along_u, along_v = end[0] - start[0], end[1] - start[1]
    from_u, from_v = u - start[0], v - start[1]
    t = (from_u * along_u + from_v * along_v) / (along_u**2 + along_v**2)
    t = t.clip(0, 1)
    return np.asarray((from_u - t * along_u) ** 2 + (from_v - t * along_v) ** 2)
