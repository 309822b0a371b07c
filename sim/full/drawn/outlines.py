"""Signed distances of outlines in a plane, and distances from lines, that surfaces are cut from.

Signed distances are negative inside [mm]. Arguments u and v are positions of one shape [mm].
"""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from scipy.spatial import cKDTree

from cltp.tactile.cloud import FloatArray


def polygon(u: FloatArray, v: FloatArray, corners: FloatArray) -> FloatArray:
    """Signed distance from a simple polygon, convex or not.

    Args:
        u: Positions [mm].
        v: Positions [mm].
        corners: Shape (N, 2), in order [mm].
    """
    squared = np.full(np.shape(u), np.inf)
    inside = np.zeros(np.shape(u), dtype=np.bool_)
    for (u0, v0), (u1, v1) in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        along_u, along_v = u1 - u0, v1 - v0
        off_u, off_v = u - u0, v - v0
        fraction = (off_u * along_u + off_v * along_v) / (along_u**2 + along_v**2)
        fraction = fraction.clip(0, 1)
        squared = np.minimum(
            squared, (off_u - fraction * along_u) ** 2 + (off_v - fraction * along_v) ** 2
        )
        if v0 != v1:
            crosses = ((v0 <= v) != (v1 <= v)) & (off_u < off_v * along_u / along_v)
            inside ^= crosses
    distance = np.sqrt(squared)
    return np.where(inside, -distance, distance)


def rectangle(u: FloatArray, v: FloatArray, half_u: float, half_v: float) -> FloatArray:
    """Signed distance from a rectangle about the origin."""
    beside_u, beside_v = np.abs(u) - half_u, np.abs(v) - half_v
    outside = np.hypot(beside_u.clip(min=0), beside_v.clip(min=0))
    return np.asarray(outside + np.maximum(beside_u, beside_v).clip(max=0))


def rounded_power(
    u: FloatArray, v: FloatArray, half_u: float, half_v: float, power: float
) -> FloatArray:
    """Signed distance, to first order, from |u/a|^p + |v/b|^p = 1: an ellipse at power 2."""
    scaled_u, scaled_v = np.abs(u) / half_u + 1e-9, np.abs(v) / half_v + 1e-9
    largest = np.maximum(scaled_u, scaled_v)
    ratio_u, ratio_v = scaled_u / largest, scaled_v / largest  # no overflow of high powers
    total = ratio_u**power + ratio_v**power
    level = largest * total ** (1 / power)
    steep_u, steep_v = ratio_u ** (power - 1) / half_u, ratio_v ** (power - 1) / half_v
    slope = np.hypot(steep_u, steep_v) * total ** (1 / power - 1)
    return np.asarray((level - 1) / slope)


def arc(u: FloatArray, v: FloatArray, radius: float, half_angle: float) -> FloatArray:
    """Distance from an arc about the origin, symmetric about +u; π closes it to a circle [rad]."""
    on_arc = np.abs(np.arctan2(v, u)) <= half_angle
    end_u, end_v = radius * math.cos(half_angle), radius * math.sin(half_angle)
    to_end = np.hypot(u - end_u, np.abs(v) - end_v)
    return np.where(on_arc, np.abs(np.hypot(u, v) - radius), to_end)


def curve(u: FloatArray, v: FloatArray, points: FloatArray) -> FloatArray:
    """Distance from a line through points (N, 2)."""
    squared = np.full(np.shape(u), np.inf)
    for (u0, v0), (u1, v1) in pairwise(points):
        along_u, along_v = u1 - u0, v1 - v0
        fraction = ((u - u0) * along_u + (v - v0) * along_v) / (along_u**2 + along_v**2)
        fraction = fraction.clip(0, 1)
        squared = np.minimum(
            squared, (u - u0 - fraction * along_u) ** 2 + (v - v0 - fraction * along_v) ** 2
        )
    return np.sqrt(squared)


def bent(half: float, turn: float, offset: float = 0.0, *, num: int = 13) -> FloatArray:
    """Points (num, 2) along a line about the origin that turns by an angle [rad] over its length.

    Args:
        half: Half of its length [mm].
        turn: Change of its direction [rad]; 0 is straight.
        offset: Distance to a parallel line, towards +v [mm].
        num: Number of points; a straight line has two.
    """
    if abs(turn) < 1e-3:
        return np.array([[-half, offset], [half, offset]])
    radius = 2 * half / turn
    angle = np.linspace(-turn / 2, turn / 2, num)
    at = radius - offset
    return np.stack([at * np.sin(angle), radius - at * np.cos(angle)], axis=1)


def nearest(u: FloatArray, v: FloatArray, centres: FloatArray, count: int) -> np.ndarray:
    """Indices of the ``count`` nearest of some centres (N, 2) at each position, (..., count)."""
    count = min(count, len(centres))
    _, index = cKDTree(centres).query(np.stack([u, v], axis=-1), k=count)
    return np.asarray(index.reshape(*np.shape(u), count), dtype=np.int64)
