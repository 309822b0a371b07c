"""An encoder that learns nothing: the heights of a cloud's points in falling order.

What a probe reads of these is what the 1024 points say of depth and area without their places: a
ceiling that is learned, beside the one that is computed (``cltp.tactile.measure``).
"""

from __future__ import annotations

import torch
from torch import Tensor

from cltp.data.sampler import Batch
from cltp.encoder.tokenizers import bearing_curve, graded, graded_ranks
from cltp.tactile.point_layout import EVEN

_SAMPLES, _GRADES = 64, 60


class HeightsAlone:
    """A ``cltp.checkpoints.frozen.FrozenEncoder`` without weights."""

    sha256 = f"heights alone, {_SAMPLES} and {_GRADES} grades"
    sees_images = False
    sampling = EVEN

    def encode(self, batch: Batch, frames: Tensor | None) -> tuple[Tensor, Tensor]:
        """Heights, scaled and graded, shape (B, 1024) in all, and no feature (B, 1)."""
        del frames
        return self.read(torch.from_numpy(batch.points))

    def read(self, taken: Tensor) -> tuple[Tensor, Tensor]:
        """The same of scaled points (B, 1024, 3)."""
        curve = bearing_curve(taken, _SAMPLES)
        told = graded(curve[:, graded_ranks(_SAMPLES)], _GRADES)
        return torch.cat([curve, told], dim=1), torch.zeros(len(taken), 1)
