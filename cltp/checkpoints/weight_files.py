"""A module's weights on disk: ``config.json`` and ``model.safetensors`` in one folder."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import torch
from safetensors import SafetensorError
from safetensors.torch import load_file, save_file
from torch import Tensor, nn

from cltp.atomic_write import replacing, write_atomically
from cltp.errors import TouchError

CONFIG, WEIGHTS = "config.json", "model.safetensors"


class WeightsError(TouchError):
    """Weights are missing, damaged or don't fit together."""


def save_weights(folder: Path, config: Mapping[str, Any], state: Mapping[str, Tensor]) -> None:
    """Write weights, and their configuration last: a folder without one is incomplete."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / CONFIG).unlink(missing_ok=True)
    with replacing(folder / WEIGHTS) as part:
        save_file({name: value.contiguous() for name, value in state.items()}, part)
    write_atomically(folder / CONFIG, json.dumps(dict(config), indent=2) + "\n")


def read_config(path: Path) -> dict[str, Any]:
    """Read a configuration.

    Raises:
        WeightsError: It can't be read, or is no JSON object.
    """
    try:
        config = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise WeightsError(f"{path} can't be read: {error}") from error
    if not isinstance(config, dict):
        raise WeightsError(f"{path} is no configuration")
    return config


def load_weights(folder: Path, module: nn.Module) -> None:
    """Read weights into a module, in 32 bits.

    Raises:
        WeightsError: One is missing, of another shape, unknown or not finite, or the file is
            damaged.
    """
    path = folder / WEIGHTS
    try:
        state = {name: value.float() for name, value in load_file(path).items()}
        module.load_state_dict(state, strict=True)
    except (OSError, SafetensorError, RuntimeError) as error:
        reason = str(error).splitlines()[0]
        raise WeightsError(f"{path} is damaged or does not match its config: {reason}") from error
    require_finite(path, module.state_dict())


def digest(state: Mapping[str, Tensor], text: str = "") -> str:
    """SHA-256 of a text and of named tensors in the order of their names."""
    total = hashlib.sha256(text.encode())
    for name in sorted(state):
        total.update(name.encode() + state[name].cpu().contiguous().numpy().tobytes())
    return total.hexdigest()


def require_finite(source: Path, state: Mapping[str, Tensor]) -> None:
    """Refuse weights that are not finite.

    Raises:
        WeightsError: It names the first one.
    """
    for name, value in state.items():
        if not torch.isfinite(value).all():
            raise WeightsError(f"{source}: {name} is not finite; train again")
