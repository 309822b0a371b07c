"""Signed distances of outlines in a plane, from which indenters are cut.

A signed distance is negative inside [mm]. Where outlines meet it may be a bound instead of the
exact distance, which only rounds or sharpens a rim a little.

Not here: surfaces (``sim.starter.surfaces``).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from cltp.tactile.cloud import FloatArray

Point = tuple[float, float]


def rectangle(u: FloatArray, v: FloatArray, half_u: float, half_v: float) -> FloatArray:
    """Rectangle of sides ``2 half_u`` × ``2 half_v`` [mm] about the origin."""
    beside_u, beside_v = np.abs(u) - half_u, np.abs(v) - half_v
    outside = np.hypot(beside_u.clip(min=0), beside_v.clip(min=0))
    return np.asarray(outside + np.maximum(beside_u, beside_v).clip(max=0))


def circle(u: FloatArray, v: FloatArray, radius: float) -> FloatArray:
    """Circle [mm] about the origin."""
    return np.asarray(np.hypot(u, v) - radius)


def convex(u: FloatArray, v: FloatArray, corners: Sequence[Point]) -> FloatArray:
    """Convex polygon with ``corners`` [mm] in counter-clockwise order."""
    distance = np.full(np.shape(u), -np.inf)
    for (u0, v0), (u1, v1) in zip(corners, [*corners[1:], corners[0]], strict=True):
        length = math.hypot(u1 - u0, v1 - v0)
        normal_u, normal_v = (v1 - v0) / length, -(u1 - u0) / length
        distance = np.maximum(distance, (u - u0) * normal_u + (v - v0) * normal_v)
    return distance


def segment(u: FloatArray, v: FloatArray, start: Point, end: Point) -> FloatArray:
    """Distance from the segment between two points [mm]; never negative."""
    along_u, along_v = end[0] - start[0], end[1] - start[1]
    fraction = ((u - start[0]) * along_u + (v - start[1]) * along_v) / (along_u**2 + along_v**2)
    fraction = fraction.clip(0, 1)
    return np.asarray(
        np.hypot(u - start[0] - fraction * along_u, v - start[1] - fraction * along_v)
    )


def arc(u: FloatArray, v: FloatArray, radius: float, half_angle: float) -> FloatArray:
    """Distance from an arc about the origin, symmetric about +u [mm]; never negative.

    Args:
        u: Positions [mm].
        v: Positions [mm].
        radius: Radius of the arc [mm].
        half_angle: Angle of the arc to either side of +u [rad]; π closes it to a circle.
    """
    inside_arc = np.abs(np.arctan2(v, u)) <= half_angle
    end_u, end_v = radius * math.cos(half_angle), radius * math.sin(half_angle)
    to_end = np.hypot(u - end_u, np.abs(v) - end_v)
    return np.where(inside_arc, np.abs(np.hypot(u, v) - radius), to_end)
