"""External image encoders: a CLIP or its vision tower in a directory of transformers' format.

They stand for the vision-based baselines of the paper's appendix A, TVL and UniTouch, where a user
has such a checkpoint. Both were published in other layouts (TVL: timm and OpenCLIP; UniTouch:
ImageBind), which have to be converted first. The encoder is frozen and takes our rendered frames.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import torch
import torch.nn.functional as F
from torch import Tensor

from cltp.checkpoints.manifest import WeightsError, check_manifest
from cltp.checkpoints.weight_files import (
    CONFIG,
    check_sizes,
    digest,
    read_config,
    require_finite,
)
from cltp.data.sampler import Batch
from cltp.encoder.strict_loading import load_strictly
from cltp.errors import TouchError
from cltp.tactile.point_layout import EVEN, PointLayout

_CLIP_MEAN = (0.48145466, 0.4578275, 0.40821073)
_CLIP_STD = (0.26862954, 0.26130258, 0.27577711)
"""Pixels of CLIP (Radford et al. 2021), for checkpoints without preprocessor_config.json."""

KINDS = ("clip", "clip_vision_model")
"""``model_type`` of directories that are read."""


@dataclass(frozen=True, slots=True)
class VisionCheckpoint:
    """An image encoder in place of ``cltp.checkpoints.frozen.Frozen``.

    Attributes:
        model: The encoder, in evaluation mode, without gradients.
        mean, std: Mean and spread of its pixels, shape (3, 1, 1).
        sha256: SHA-256 of weights and preprocessing.
    """

    model: Any
    mean: Tensor
    std: Tensor
    sha256: str
    sees_images: ClassVar[bool] = True
    layout: ClassVar[PointLayout] = EVEN

    def encode(self, batch: Batch, frames: Tensor | None) -> tuple[Tensor, Tensor]:
        """As ``cltp.checkpoints.frozen.Frozen.encode``; it can't do without frames.

        Raises:
            TouchError: There are none.
        """
        if frames is None:
            raise TouchError("an image encoder needs frames, got points alone")
        return self.read(frames)

    @torch.inference_mode()
    def read(self, inputs: Tensor) -> tuple[Tensor, Tensor]:
        """Class token and maximum over patches (B, 2 C), and the aligned feature, of frames.

        Args:
            inputs: Frames (B, 3, H, W), 0 to 1; brought to the encoder's size bilinearly.
        """
        size = int(self.model.config.image_size)
        pixels = F.interpolate(inputs, (size, size), mode="bilinear", antialias=True)
        output = self.model((pixels - self.mean) / self.std, output_hidden_states=True)
        hidden = output.last_hidden_state
        pooled = torch.cat([hidden[:, 0], hidden[:, 1:].amax(dim=1)], dim=1)
        return pooled, output.image_embeds


def load_vision_checkpoint(folder: Path) -> VisionCheckpoint:
    """Read a CLIP, or its vision tower with its projection, strictly.

    Args:
        folder: ``config.json`` and weights as transformers writes them; the mean and spread of
            pixels from ``preprocessor_config.json``, CLIP's own where there is none.

    Raises:
        WeightsError: It is missing, of another kind, damaged, or its weights are not finite or not
            those of its configuration.
    """
    check_manifest(folder, required=False)
    check_sizes(folder)
    config = read_config(folder / CONFIG)
    kind = config.get("model_type")
    if kind not in KINDS:
        raise WeightsError(
            f"{folder} holds a model of type {kind!r}; an image encoder needs one of "
            f"{', '.join(KINDS)} in transformers' format (convert other layouts first)"
        )
    from transformers import CLIPVisionModelWithProjection

    model = load_strictly(
        CLIPVisionModelWithProjection,
        folder,
        "image encoder",
        expected=lambda name: kind != "clip" or "vision" in name,
        error_class=WeightsError,
    )
    mean, std = _pixels(folder)
    require_finite(folder, model.state_dict())
    checksum = digest(model.state_dict(), f"{mean.tolist()} {std.tolist()}")
    return VisionCheckpoint(model.eval().requires_grad_(False), mean, std, checksum)


def _pixels(folder: Path) -> tuple[Tensor, Tensor]:
    path = folder / "preprocessor_config.json"
    processing = read_config(path) if path.exists() else {}
    mean, std = (
        processing.get(name, usual)
        for name, usual in (("image_mean", _CLIP_MEAN), ("image_std", _CLIP_STD))
    )
    try:
        parts = [torch.tensor(part, dtype=torch.float32).view(3, 1, 1) for part in (mean, std)]
    except (TypeError, ValueError, RuntimeError):
        raise WeightsError(f"{path}: image_mean and image_std must have three numbers") from None
    if not all(part.isfinite().all() for part in parts) or not (parts[1] > 0).all():
        raise WeightsError(f"{path}: image_std must be positive")
    return parts[0], parts[1]
