"""Images of contacts for the image tower: the deformed gel, shaded.

The paper renders the surface as a mesh seen from the sensor. Ours is lit from the left (red) and
from the top (green), and its indentation is the third colour, so that slope and depth both show.
"""

from __future__ import annotations

import numpy as np
import torch
import torch.nn.functional as F
from numpy.typing import NDArray
from torch import Tensor

from cltp.tactile.sensors import SensorSpec

IMAGE_PX = 64
"""Edge of an image; the whole sensing area is stretched to a square."""

SLOPE_GAIN = 1.5
"""Shading per slope: ±1/3, about the steepest slope of a gel, spans the whole range."""


def render(height_mm: NDArray[np.floating], sensor: SensorSpec) -> Tensor:
    """Shade a height map (H, W) [mm], clean or noisy, row 0 = top: shape (3, 64, 64), 0 to 1."""
    heights = torch.from_numpy(np.ascontiguousarray(height_mm, dtype=np.float32))
    small = F.interpolate(heights[None, None], (IMAGE_PX, IMAGE_PX), mode="area")[0, 0]
    down, right = torch.gradient(small)
    slope_x = right * (IMAGE_PX / sensor.width_mm)
    slope_y = -down * (IMAGE_PX / sensor.height_mm)
    return torch.stack(
        [
            (0.5 + SLOPE_GAIN * slope_x).clamp(0, 1),
            (0.5 + SLOPE_GAIN * slope_y).clamp(0, 1),
            (0.1 + small / sensor.max_depth_mm).clamp(0, 1),
        ]
    )
