"""Encoders by any method, frozen: pooled features of contacts.

``FOLDER/encoder`` is written either by ``cltp.checkpoints.tac3d_llm.save_encoder`` (CLTP, with
state heads) or by ``save_frozen``: an encoder alone, with the method that trained it, in 32 bits,
since baselines are compared and not shipped.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from cltp.checkpoints.manifest import WeightsError, check_manifest
from cltp.checkpoints.parts import (
    ENCODER,
    StoredEncoder,
    check_model_type,
    check_room,
    named,
    random_encoder,
)
from cltp.checkpoints.weight_files import (
    CONFIG,
    digest,
    load_weights,
    read_config,
    save_weights,
)
from cltp.data.sampler import Augmentation, Batch
from cltp.encoder.encoder import TactileEncoder
from cltp.encoder.render import render
from cltp.tactile.point_layout import PointLayout
from cltp.tactile.sensor_noise import NoiseUnit, spread_of
from cltp.tactile.sensors import SensorSpec

FORMAT = "tacgrasp-frozen-encoder"


class FrozenEncoder(Protocol):
    """An encoder that is not trained further: ``Frozen``, or an external one."""

    @property
    def sha256(self) -> str:
        """SHA-256 of its weights."""
        ...

    @property
    def sees_images(self) -> bool:
        """Whether it takes rendered frames instead of points."""
        ...

    @property
    def layout(self) -> PointLayout:
        """How the points lie that it takes."""
        ...

    def encode(self, batch: Batch, frames: Tensor | None) -> tuple[Tensor, Tensor]:
        """Pooled tokens (B, P) and aligned features (B, F) of a batch.

        Args:
            batch: Contacts.
            frames: Their noisy frames (``noisy_frames``), where the encoder sees images.
        """
        ...

    def read(self, inputs: Tensor) -> tuple[Tensor, Tensor]:
        """The same of scaled points (B, N, 3), or of frames (B, 3, 64, 64)."""
        ...


@dataclass(frozen=True, slots=True)
class Frozen:
    """A trained encoder.

    Attributes:
        encoder: The encoder, in evaluation mode, without gradients.
        sha256: SHA-256 of its configuration and weights.
    """

    encoder: TactileEncoder
    sha256: str

    @property
    def sees_images(self) -> bool:
        return self.encoder.config.variant.takes_images

    @property
    def layout(self) -> PointLayout:
        return self.encoder.config.variant.layout

    @torch.inference_mode()
    def encode(self, batch: Batch, frames: Tensor | None) -> tuple[Tensor, Tensor]:
        return self.read(frames if frames is not None else torch.from_numpy(batch.points))

    @torch.inference_mode()
    def read(self, inputs: Tensor) -> tuple[Tensor, Tensor]:
        encoded = self.encoder(inputs)
        return encoded.pooled, encoded.feature


def frozen(encoder: TactileEncoder) -> Frozen:
    """Freeze an encoder."""
    checksum = digest(encoder.state_dict(), encoder.config.identity)
    return Frozen(encoder.eval().requires_grad_(False), checksum)


def save_frozen(folder: Path, encoder: TactileEncoder, method: str) -> None:
    """Write an encoder without heads, in 32 bits."""
    config = {
        **named(ENCODER, TactileEncoder),
        "format": FORMAT,
        "method": method,
        "encoder": dataclasses.asdict(encoder.config),
    }
    save_weights(folder, config, encoder.state_dict())


def load_frozen(folder: Path) -> Frozen:
    """Read an encoder that any method trained.

    Raises:
        WeightsError: It is missing, damaged, or its configuration does not match.
    """
    if not (folder / CONFIG).exists():
        raise WeightsError(f"{folder} holds no encoder; train it with `tacgrasp train`")
    check_manifest(folder)
    config = read_config(folder / CONFIG)
    if config.get("format") != FORMAT:
        return frozen(StoredEncoder.from_pretrained(folder).encoder)
    check_model_type(folder, config, ENCODER)
    check_room(folder, config)
    encoder = random_encoder(folder, config)
    load_weights(folder, encoder)
    return frozen(encoder)


def noisy_frames(
    height_mm: Sequence[NDArray[np.float32]],
    sensors: Sequence[SensorSpec],
    augmentation: Augmentation,
    rng: np.random.Generator,
) -> Tensor:
    """Frames as the sensors would show contacts: rendered from noisy heights, (B, 3, 64, 64).

    The noise is of the same kind as that of ``Sampler.cloud``, drawn by itself.
    """
    frames = []
    for heights, sensor in zip(height_mm, sensors, strict=True):
        spread = spread_of(sensor)
        gain = spread.gain_log_ratio if rng.random() < augmentation.uncalibrated else 0.0
        if augmentation.is_noisy and rng.random() >= augmentation.clean:
            levels = augmentation.draw_levels(rng)
            unit = NoiseUnit.draw(rng, levels, gain_log_ratio=gain, spread=spread)
            heights = unit.apply(heights, sensor, rng)
        frames.append(render(heights - np.float32(np.median(heights)), sensor))
    return torch.stack(frames)
