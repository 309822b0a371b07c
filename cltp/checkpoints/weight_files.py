"""A module's weights on disk: ``config.json``, ``model.safetensors`` and ``manifest.json``."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import torch
from safetensors import SafetensorError
from safetensors.torch import load_file, save
from torch import Tensor, nn

from cltp.atomic_write import write_atomically
from cltp.checkpoints.manifest import MANIFEST, WeightsError, write_manifest

CONFIG, WEIGHTS = "config.json", "model.safetensors"

MAX_CONFIG_BYTES = 1_000_000


def save_weights(
    folder: Path,
    config: Mapping[str, Any],
    state: Mapping[str, Tensor],
    *,
    trained_with: Iterable[str] = (),
) -> None:
    """Write weights, and their manifest last: a folder without one is incomplete.

    Args:
        folder: Folder of the weights.
        config: Their configuration.
        state: The weights by name.
        trained_with: Parts beside the folder that these weights are good for alone.
    """
    folder.mkdir(parents=True, exist_ok=True)
    (folder / MANIFEST).unlink(missing_ok=True)
    write_atomically(folder / WEIGHTS, save({name: v.contiguous() for name, v in state.items()}))
    write_atomically(folder / CONFIG, json.dumps(dict(config), indent=2) + "\n")
    write_manifest(folder, trained_with=trained_with)


def require_files(folder: Path, *, command: str = "tacgrasp train all") -> None:
    """Refuse a folder without configuration or weights.

    Args:
        folder: Folder of the weights.
        command: Command that makes them, for the message.

    Raises:
        WeightsError: It names the missing file.
    """
    for name in (CONFIG, WEIGHTS):
        if not (Path(folder) / name).is_file():
            raise WeightsError(
                f"weights are missing: {Path(folder) / name} does not exist; "
                f"train them with `{command}` or name the right folder"
            )


def read_config(path: Path) -> dict[str, Any]:
    """Read a configuration.

    Raises:
        WeightsError: It can't be read, or is no JSON object.
    """
    try:
        if path.stat().st_size > MAX_CONFIG_BYTES:
            raise ValueError(f"larger than {MAX_CONFIG_BYTES} bytes")
        config = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError) as error:
        raise WeightsError(f"{path} can't be read: {error}") from error
    if not isinstance(config, dict):
        raise WeightsError(f"{path} is no configuration")
    return config


_LARGEST = {"num_hidden_layers": 200, "depth": 200, "vocab_size": 1_000_000}
_LARGEST_SIZE = 100_000


def check_sizes(folder: Path) -> None:
    """Refuse a stock configuration whose sizes no model has, before one is made of them.

    Raises:
        WeightsError: A size is no whole number, not positive, or beyond any model of this kind.
    """
    waiting = [read_config(folder / CONFIG)]
    while waiting:
        section = waiting.pop()
        waiting += [value for value in section.values() if isinstance(value, dict)]
        for name, value in section.items():
            if name not in _LARGEST and not name.endswith(("_size", "_heads", "projection_dim")):
                continue
            most = _LARGEST.get(name, _LARGEST_SIZE)
            if value is not None and not (type(value) is int and 1 <= value <= most):
                raise WeightsError(
                    f"{folder / CONFIG}: {name} must be a whole number of 1 to {most}, got "
                    f"{value!r:.40}"
                )


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
    except (OSError, SafetensorError, RuntimeError, ValueError, KeyError) as error:
        reason = (str(error) or repr(error)).splitlines()[-1].strip()
        raise WeightsError(
            f"{path} is damaged, or of another version, and does not match its config: {reason} "
            "Train it anew: tacgrasp train llm, or tacgrasp train cltp for an encoder alone"
        ) from error
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
