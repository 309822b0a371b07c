"""Heights of a sensor's gel around a ball, from our elastic layer: targets for its calibration."""

from __future__ import annotations

import numpy as np
import torch
from numpy.typing import NDArray

from cltp.processor import torch_threads
from cltp.sensing.ball_presses import ProfileTable
from sim.gel.layer import ElasticLayer, Press, gel_of

PITCH_MM = 0.1
_HALF = 120  # elements: 12 mm on each side, more than three thicknesses of the gel
DEPTHS_MM = np.linspace(0.1, 1.4, 14)


@torch_threads()
def ball_profiles(sensor_name: str, diameter_mm: float) -> ProfileTable:
    """Solve presses of a rigid ball at ``DEPTHS_MM``, those above 0.8 of its radius left out.

    Raises:
        ValueError: The gel of this sensor is unknown.
    """
    ball = diameter_mm / 2
    depths = DEPTHS_MM[0.8 * ball > DEPTHS_MM]
    positions = (np.arange(2 * _HALF + 1) - _HALF) * PITCH_MM
    r = np.hypot(positions[:, None], positions[None, :])
    gap = np.where(r < ball, ball - np.sqrt(np.clip(ball**2 - r**2, 0, None)), np.inf)
    gel = ElasticLayer(gel_of(sensor_name), rows=len(r), columns=len(r), pitch_mm=PITCH_MM)
    rows: list[NDArray[np.float32]] = []
    press: Press | None = None
    for depth in depths:
        press = gel.press_to_depth(
            torch.from_numpy(gap)[None], torch.tensor(float(depth)), start=press, tol=1e-3
        )
        rows.append(press.height_mm[0, _HALF, _HALF:].numpy())
    return ProfileTable(
        depths_mm=depths,
        r_mm=np.linspace(0.0, _HALF * PITCH_MM, _HALF + 1),
        height_mm=np.array(rows, dtype=np.float64),
    )
