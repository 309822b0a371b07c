"""An encoder that learns nothing: the heights of a cloud's points in falling order.

Probes on it show what the 1024 points tell of depth and area without their positions: a baseline
that is learned, beside the one that is computed (``cltp.evaluation.geometric_baseline``).
"""

from __future__ import annotations

import torch
from torch import Tensor

from cltp.data.sampler import Batch
from cltp.encoder.class_token import encoded_ranks, height_quantiles, piecewise_linear
from cltp.tactile.point_layout import EVEN

_SAMPLES, _GRADES = 64, 60


class HeightsAlone:
    """A ``cltp.checkpoints.frozen.FrozenEncoder`` without weights."""

    sha256 = f"heights alone, {_SAMPLES} and {_GRADES} grades"
    sees_images = False
    layout = EVEN

    def encode(self, batch: Batch, frames: Tensor | None) -> tuple[Tensor, Tensor]:
        """Scaled heights and their piecewise linear encoding (B, 1024), and no feature (B, 1)."""
        del frames
        return self.read(torch.from_numpy(batch.points))

    def read(self, inputs: Tensor) -> tuple[Tensor, Tensor]:
        """The same of scaled points (B, 1024, 3)."""
        heights = height_quantiles(inputs, _SAMPLES)
        grades = piecewise_linear(heights[:, encoded_ranks(_SAMPLES)], _GRADES)
        return torch.cat([heights, grades], dim=1), torch.zeros(len(inputs), 1)
