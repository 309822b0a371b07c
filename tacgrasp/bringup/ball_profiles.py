"""How a sensor's gel lies around a ball, from our elastic layer: targets for its calibration."""

from __future__ import annotations

import numpy as np
import torch

from cltp.sensing.ball_presses import ProfileTable
from cltp.torch_threads import torch_threads
from sim.gel.layer import ElasticLayer, Press, gel_of

PITCH_MM = 0.1
_HALF = 120  # elements: 12 mm on each side, more than three thicknesses of the gel
DEPTHS_MM = np.linspace(0.1, 1.4, 14)


@torch_threads()
def ball_profiles(sensor_name: str, diameter_mm: float) -> ProfileTable:
    """Solve presses of a rigid ball of ``diameter_mm`` [mm] at ``DEPTHS_MM``, or to its equator.

    Raises:
        ValueError: No gel is known for this sensor.
    """
    ball = diameter_mm / 2
    depths = DEPTHS_MM[0.8 * ball > DEPTHS_MM]
    at = (np.arange(2 * _HALF + 1) - _HALF) * PITCH_MM
    r = np.hypot(at[:, None], at[None, :])
    gap = np.where(r < ball, ball - np.sqrt(np.clip(ball**2 - r**2, 0, None)), np.inf)
    gel = ElasticLayer(gel_of(sensor_name), rows=len(at), columns=len(at), pitch_mm=PITCH_MM)
    rows, press = [], None
    for depth in depths:
        press = _pressed(gel, torch.from_numpy(gap)[None], float(depth), press)
        rows.append(press.height_mm[0, _HALF, _HALF:].numpy())
    return ProfileTable(
        depths_mm=depths,
        r_mm=np.linspace(0.0, _HALF * PITCH_MM, _HALF + 1),
        height_mm=np.array(rows, dtype=np.float64),
    )


def _pressed(gel: ElasticLayer, gap: torch.Tensor, depth_mm: float, start: Press | None) -> Press:
    return gel.press_to_depth(gap, torch.tensor(depth_mm), start=start, tol=1e-3)
