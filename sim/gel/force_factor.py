"""Force that a gel needs for the same indentation, over what the sensor's nominal gel needs.

Units of one model differ in stiffness and thickness. Heights tell the force only up to this factor,
which a force calibration of the unit finds.
"""

from __future__ import annotations

import math
from functools import lru_cache

import torch

from cltp.gel.compliance import GelMaterial
from sim.gel.layer import ElasticLayer, gel_of

BALL_RADIUS_MM = 7.5
DEPTHS_MM = (0.2, 0.4, 0.8)
"""Presses by which gels are compared. Our choice: about 0.3, 1 and 4 N on a GelSight Mini."""

_ROWS, _COLUMNS, _PITCH_MM = 60, 80, 0.25


@lru_cache(maxsize=64)
def force_factor(material: GelMaterial, sensor_name: str) -> float:
    """Geometric mean of the ratio of forces in the presses of a ball to ``DEPTHS_MM``.

    Exact for Young's modulus, whose ratio it is; of thickness and Poisson's ratio a few percent
    remain, which depend on the contact.

    Raises:
        ValueError: No gel is known for the sensor.
    """
    nominal = gel_of(sensor_name)
    if material == nominal:
        return 1.0
    forces, nominal_forces = _forces_n(material), _forces_n(nominal)
    return math.exp(float((forces / nominal_forces).log().mean()))


def _forces_n(material: GelMaterial) -> torch.Tensor:
    layer = ElasticLayer(material, rows=_ROWS, columns=_COLUMNS, pitch_mm=_PITCH_MM)
    y = (torch.arange(_ROWS) - (_ROWS - 1) / 2) * _PITCH_MM
    x = (torch.arange(_COLUMNS) - (_COLUMNS - 1) / 2) * _PITCH_MM
    square = y[:, None] ** 2 + x**2
    gap = BALL_RADIUS_MM - (BALL_RADIUS_MM**2 - square).clamp(min=0).sqrt()
    gap = torch.where(square < BALL_RADIUS_MM**2, gap, torch.inf)
    gaps = gap.expand(len(DEPTHS_MM), -1, -1)
    return layer.press_to_depth(gaps, torch.tensor(DEPTHS_MM), tol=1e-3).force_n
