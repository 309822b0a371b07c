"""Image encoders that others trained, by path: a CLIP or its vision tower in transformers' format.

For the vision-based baselines of the paper's appendix A, TVL and UniTouch, if a user has such a
checkpoint as a directory of transformers. Both were published in layouts of their own (TVL: timm
and OpenCLIP; UniTouch: ImageBind), which are not read: they have to be converted first. What is
read is used as it is: frozen, never trained further, shown our rendered frames.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import torch
import torch.nn.functional as F
from safetensors import SafetensorError
from torch import Tensor

from cltp.checkpoints.tac3d_llm import WeightsError
from cltp.data.sampler import Batch
from cltp.errors import TouchError
from cltp.tactile.point_layout import EVEN, Sampling

_CLIP_MEAN = (0.48145466, 0.4578275, 0.40821073)
_CLIP_STD = (0.26862954, 0.26130258, 0.27577711)
"""Of CLIP's images (Radford et al. 2021), for checkpoints without preprocessor_config.json."""

KINDS = ("clip", "clip_vision_model")
"""``model_type`` of directories that are read."""


@dataclass(frozen=True, slots=True)
class VisionCheckpoint:
    """An image encoder in place of ``cltp.checkpoints.frozen.Frozen``.

    Attributes:
        model: In evaluation mode, without gradients.
        mean, std: Of its images, shape (3, 1, 1).
        sha256: Of weights and preprocessing.
    """

    model: Any
    mean: Tensor
    std: Tensor
    sha256: str

    @property
    def sees_images(self) -> bool:
        """Always: it takes rendered frames."""
        return True

    @property
    def sampling(self) -> Sampling:
        """Of points that it does not take."""
        return EVEN

    def encode(self, batch: Batch, frames: Tensor | None) -> tuple[Tensor, Tensor]:
        """As ``cltp.checkpoints.frozen.Frozen.encode``; it can't do without frames.

        Raises:
            TouchError: There are none.
        """
        if frames is None:
            raise TouchError("an image encoder needs frames, got points alone")
        return self.read(frames)

    @torch.inference_mode()
    def read(self, taken: Tensor) -> tuple[Tensor, Tensor]:
        """Class token and maximum over patches (B, 2 C), and the aligned feature, of frames.

        Args:
            taken: Frames (B, 3, H, W), 0 to 1; brought to the encoder's size bilinearly.
        """
        size = int(self.model.config.image_size)
        pixels = F.interpolate(taken, (size, size), mode="bilinear", antialias=True)
        found = self.model((pixels - self.mean) / self.std, output_hidden_states=True)
        hidden = found.last_hidden_state
        pooled = torch.cat([hidden[:, 0], hidden[:, 1:].amax(dim=1)], dim=1)
        return pooled, found.image_embeds


def load_vision_checkpoint(folder: Path) -> VisionCheckpoint:
    """Read a CLIP, or its vision tower with its projection, strictly.

    Args:
        folder: ``config.json`` and weights as transformers writes them; the mean and spread of
            pixels from ``preprocessor_config.json``, CLIP's own where there is none.

    Raises:
        WeightsError: It is missing, of another kind, damaged, or its weights are not finite or not
            those of its configuration.
    """
    config = _json(folder / "config.json")
    kind = config.get("model_type")
    if kind not in KINDS:
        raise WeightsError(
            f"{folder} holds a model of type {kind!r}; an image encoder needs one of "
            f"{', '.join(KINDS)} in transformers' format (convert other layouts first)"
        )
    from transformers import CLIPVisionModelWithProjection

    try:
        loaded: Any = CLIPVisionModelWithProjection.from_pretrained(
            folder, local_files_only=True, output_loading_info=True, dtype=torch.float32
        )
        model, info = loaded
    except (OSError, ValueError, RuntimeError, SafetensorError) as error:
        first = str(error).splitlines()[0]
        raise WeightsError(f"no image encoder could be read from {folder}: {first}") from error
    other = [name for name in info["unexpected_keys"] if kind != "clip" or "vision" in name]
    if info["missing_keys"] or other or info["mismatched_keys"]:
        wrong = sorted([*info["missing_keys"], *other, *map(str, info["mismatched_keys"])])
        raise WeightsError(f"{folder} lacks or adds weights: {', '.join(wrong[:5])}")
    mean, std = _pixels(folder)
    total = hashlib.sha256(f"{mean.tolist()} {std.tolist()}".encode())
    for name, value in sorted(model.state_dict().items()):
        if not torch.isfinite(value).all():
            raise WeightsError(f"{folder}: {name} is not finite")
        total.update(name.encode() + value.contiguous().numpy().tobytes())
    return VisionCheckpoint(model.eval().requires_grad_(False), mean, std, total.hexdigest())


def _pixels(folder: Path) -> tuple[Tensor, Tensor]:
    path = folder / "preprocessor_config.json"
    told = _json(path) if path.exists() else {}
    mean, std = told.get("image_mean", _CLIP_MEAN), told.get("image_std", _CLIP_STD)
    try:
        parts = [torch.tensor(part, dtype=torch.float32).view(3, 1, 1) for part in (mean, std)]
    except (TypeError, ValueError, RuntimeError):
        raise WeightsError(f"{path}: image_mean and image_std must have three numbers") from None
    if not all(part.isfinite().all() for part in parts) or not (parts[1] > 0).all():
        raise WeightsError(f"{path}: image_std must be positive")
    return parts[0], parts[1]


def _json(path: Path) -> dict[str, Any]:
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise WeightsError(f"{path} can't be read: {error}") from error
    if not isinstance(found, dict):
        raise WeightsError(f"{path} is no configuration")
    return found
