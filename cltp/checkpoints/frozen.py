"""Encoders by any method, as they are stored, read back and frozen: pooled features of contacts.

``FOLDER/encoder`` is either what ``cltp.checkpoints.tac3d_llm.save_encoder`` wrote (CLTP, with
state heads) or what ``save_frozen`` wrote: an encoder alone, with the method that trained it. 32
bits: baselines are compared and not shipped.
"""

from __future__ import annotations

import dataclasses
import hashlib
import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np
import torch
from numpy.typing import NDArray
from safetensors import SafetensorError
from safetensors.torch import load_file, save_file
from torch import Tensor

from cltp.checkpoints.tac3d_llm import WeightsError, load_encoder
from cltp.data.sampler import Augmentation, Batch
from cltp.encoder.encoder import EncoderConfig, TactileEncoder
from cltp.errors import TouchError
from cltp.tactile.point_layout import Sampling
from cltp.tactile.render import render
from cltp.tactile.sensor_noise import NoiseUnit, spread_of
from cltp.tactile.sensors import SensorSpec

FORMAT = "tacgrasp-frozen-encoder"


class FrozenEncoder(Protocol):
    """Whatever makes features of contacts and learns no more: ``Frozen``, or others' encoders."""

    @property
    def sha256(self) -> str:
        """Of its weights."""
        ...

    @property
    def sees_images(self) -> bool:
        """Whether it takes rendered frames instead of points."""
        ...

    @property
    def sampling(self) -> Sampling:
        """How the points lie that it takes."""
        ...

    def encode(self, batch: Batch, frames: Tensor | None) -> tuple[Tensor, Tensor]:
        """Pooled tokens (B, P) and features (B, F) of a batch, with frames where it sees images."""
        ...

    def read(self, taken: Tensor) -> tuple[Tensor, Tensor]:
        """The same of scaled points (B, 1024, 3), or of frames (B, 3, 64, 64)."""
        ...


@dataclass(frozen=True, slots=True)
class Frozen:
    """An encoder that learns no more.

    Attributes:
        encoder: In evaluation mode, without gradients.
        sha256: Of its weights.
    """

    encoder: TactileEncoder
    sha256: str

    @property
    def sees_images(self) -> bool:
        """Whether it takes rendered frames instead of points."""
        return self.encoder.config.takes_images

    @property
    def sampling(self) -> Sampling:
        """How the points lie that it takes."""
        return self.encoder.config.sampling

    @torch.inference_mode()
    def encode(self, batch: Batch, frames: Tensor | None) -> tuple[Tensor, Tensor]:
        """Pooled tokens (B, 2 C) and aligned features (B, F) of a batch.

        Args:
            batch: Contacts.
            frames: Their noisy frames (``noisy_frames``), where the encoder sees images.
        """
        return self.read(frames if frames is not None else torch.from_numpy(batch.points))

    @torch.inference_mode()
    def read(self, taken: Tensor) -> tuple[Tensor, Tensor]:
        """Pooled tokens (B, 2 C) and aligned features (B, F) of scaled points, or of frames."""
        found = self.encoder(taken)
        return found.pooled, found.feature


def frozen(encoder: TactileEncoder) -> Frozen:
    """Freeze an encoder."""
    total = hashlib.sha256(encoder.config.identity.encode())
    for name, value in sorted(encoder.state_dict().items()):
        total.update(name.encode() + value.cpu().contiguous().numpy().tobytes())
    return Frozen(encoder.eval().requires_grad_(False), total.hexdigest())


def save_frozen(folder: Path, encoder: TactileEncoder, method: str) -> None:
    """Write an encoder without heads; the configuration last, so that nothing is read half."""
    folder.mkdir(parents=True, exist_ok=True)
    weights = {name: value.contiguous() for name, value in encoder.state_dict().items()}
    for name in ("config.json", "model.safetensors"):
        (folder / name).unlink(missing_ok=True)
    beside = folder / "model.safetensors.part"
    save_file(weights, beside)
    beside.replace(folder / "model.safetensors")
    config = {"format": FORMAT, "method": method, "encoder": dataclasses.asdict(encoder.config)}
    beside = folder / "config.json.part"
    beside.write_text(json.dumps(config, indent=2) + "\n", encoding="utf-8")
    beside.replace(folder / "config.json")


def load_frozen(folder: Path) -> Frozen:
    """Read an encoder that any method trained.

    Raises:
        WeightsError: It is missing, damaged, or its configuration does not match.
    """
    path = folder / "config.json"
    try:
        config = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise WeightsError(f"{folder} holds no encoder; train it with `tacgrasp train`") from None
    except (OSError, ValueError) as error:
        raise WeightsError(f"{path} can't be read: {error}") from error
    if not isinstance(config, dict) or config.get("format") != FORMAT:
        return frozen(load_encoder(folder)[0])
    try:
        encoder = TactileEncoder(EncoderConfig(**config["encoder"]))
        encoder.load_state_dict(load_file(folder / "model.safetensors"), strict=True)
    except (KeyError, TypeError, OSError, SafetensorError, RuntimeError, TouchError) as error:
        first = str(error).splitlines()[0]
        raise WeightsError(f"the encoder in {folder} does not match its config: {first}") from error
    return frozen(encoder)


def noisy_frames(
    height_mm: Sequence[NDArray[np.float32]],
    sensors: Sequence[SensorSpec],
    how: Augmentation,
    rng: np.random.Generator,
) -> Tensor:
    """Frames as the sensors would show contacts: rendered from noisy heights, (B, 3, 64, 64).

    The noise is of the same kind as that of ``Sampler.cloud``, drawn by itself.
    """
    frames = []
    for heights, sensor in zip(height_mm, sensors, strict=True):
        spread = spread_of(sensor)
        gain = spread.gain_log_ratio if rng.random() < how.uncalibrated else 0.0
        if how.noise_level > 0 and rng.random() >= how.clean:
            unit = NoiseUnit.draw(rng, how.noise_level, gain_log_ratio=gain, spread=spread)
            heights = unit.apply(heights, sensor, rng)
        frames.append(render(heights - np.float32(np.median(heights)), sensor))
    return torch.stack(frames)
