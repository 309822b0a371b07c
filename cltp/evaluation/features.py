"""What a frozen encoder makes of the contacts of a split: computed once, kept on disk in blocks.

Probes, zero-shot scores and retrieval all read from here, so that an encoder sees a contact once.
A block is written beside and renamed: after ``kill -9`` whole blocks are left and the rest comes.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray
from safetensors import SafetensorError
from safetensors.torch import load_file, save_file
from torch import Tensor

from cltp.checkpoints.frozen import FrozenEncoder, noisy_frames
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import Augmentation, Batch, Sampler
from cltp.errors import TouchError
from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import NUMBERS
from cltp.train.stage import ProgressReport, silent
from cltp.train.text_targets import class_numbers

BLOCK = 2048
_BATCH = 64


@dataclass(frozen=True, slots=True)
class Observed:
    """Features of contacts, and the truth about them.

    Attributes:
        pooled: Shape (N, 2 C), float32.
        feature: Shape (N, F), float32: aligned, where the method aligns.
        classes: Shape (N, 5), in the order of ``CLASSES``; -1 where nobody named one.
        numbers: Shape (N, 5), ``cltp.tactile.states.NUMBERS``.
        index: Shape (N,), the contacts in their split.
    """

    pooled: Tensor
    feature: Tensor
    classes: Tensor
    numbers: Tensor
    index: Tensor

    def __len__(self) -> int:
        return len(self.index)


def observe(
    encoder: FrozenEncoder,
    data: ContactDataset,
    noise: Augmentation,
    *,
    views: int = 1,
    limit: int | None = None,
    seed: int = 0,
    cache: Path | None = None,
    report: ProgressReport = silent,
) -> Observed:
    """Encode contacts.

    Args:
        encoder: Frozen.
        data: A split; its every contact is seen ``views`` times, differently where noise is drawn.
        noise: How contacts are read.
        views: How often each is seen.
        limit: Only so many contacts, chosen by the seed.
        seed: Of noise and choice.
        cache: Folder for blocks; nothing is kept without.
        report: Told about progress.

    Raises:
        TouchError: A block on disk is damaged.
    """
    order = chosen_rows(len(data), views=views, limit=limit, seed=seed)
    of = {
        "encoder": encoder.sha256,
        "data": data.checksum(),
        "splits": sorted(set(data.column("split").tolist())),
        "noise": str(noise),
        "seed": seed,
        "order": hashlib.sha256(order.tobytes()).hexdigest(),
    }
    name = hashlib.sha256(json.dumps(of, sort_keys=True).encode()).hexdigest()[:20]
    sampler = Sampler(data, noise, seed=seed, sampling=encoder.sampling)
    blocks = []
    for number, first in enumerate(range(0, len(order), BLOCK)):
        path = cache / name / f"block-{number:05d}.safetensors" if cache is not None else None
        rows = order[first : first + BLOCK]
        if path is not None and path.exists():
            block = _read(path, len(rows))
        else:
            block = _block(encoder, sampler, rows, number)
            if path is not None:
                path.parent.mkdir(parents=True, exist_ok=True)
                beside = path.with_name(f"{path.name}.part")
                save_file(block, beside)
                beside.replace(path)
        blocks.append(block)
        report("encode", first + len(rows), len(order), {})
    joined = {key: torch.cat([block[key] for block in blocks]) for key in blocks[0]}
    return Observed(
        pooled=joined["pooled"].float(),
        feature=joined["feature"].float(),
        classes=joined["classes"],
        numbers=joined["numbers"],
        index=joined["index"],
    )


def chosen_rows(
    size: int, *, views: int = 1, limit: int | None = None, seed: int = 0
) -> NDArray[np.int64]:
    """Which contacts of a split are seen, ``views`` times one after the other."""
    chosen = np.random.default_rng([seed, 31]).permutation(size)[:limit]
    return np.tile(np.sort(chosen), views)


def read_block(
    sampler: Sampler, rows: NDArray[np.int64], number: int
) -> Iterator[tuple[Batch, int]]:
    """The batches of one block with the numbers of their steps, on which the noise depends."""
    for place, first in enumerate(range(0, len(rows), _BATCH)):
        step = number * (BLOCK // _BATCH) + place
        yield sampler.batch(rows[first : first + _BATCH], step), step


def _read(path: Path, size: int) -> dict[str, Tensor]:
    try:
        block = load_file(path)
    except (OSError, SafetensorError) as error:
        raise TouchError(f"features in {path} are damaged; delete the file: {error}") from error
    if any(len(part) != size for part in block.values()):
        raise TouchError(f"features in {path} are of other contacts; delete the file")
    return block


def _block(
    encoder: FrozenEncoder, sampler: Sampler, rows: NDArray[np.int64], number: int
) -> dict[str, Tensor]:
    parts: dict[str, list[Tensor]] = {}
    for batch, step in read_block(sampler, rows, number):
        frames = _frames(sampler, batch, step) if encoder.sees_images else None
        pooled, feature = encoder.encode(batch, frames)
        found = {
            "pooled": pooled.half(),
            "feature": feature.half(),
            "classes": class_numbers(batch.states),
            "numbers": torch.tensor(
                [[getattr(state, name) for name in NUMBERS] for state in batch.states]
            ),
            "index": torch.from_numpy(batch.index).long(),
        }
        for key, part in found.items():
            parts.setdefault(key, []).append(part)
    return {key: torch.cat(values).contiguous() for key, values in parts.items()}


def _frames(sampler: Sampler, batch: Batch, step: int) -> Tensor:
    names = sampler.dataset.column("sensor")
    sensors = [sensor_named(names[index]) for index in batch.index]
    rng = np.random.default_rng([sampler.seed, 67, step])
    return noisy_frames(batch.height_mm, sensors, sampler.augmentation, rng)
