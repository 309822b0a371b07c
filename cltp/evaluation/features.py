"""Features of contacts from a frozen encoder: computed once, stored on disk in blocks.

Probes, zero-shot classification and retrieval read the same features, so that an encoder sees a
contact once. Blocks are written atomically: after ``kill -9`` the whole blocks remain, and the next
run computes the others.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray
from safetensors import SafetensorError
from safetensors.torch import load_file, save_file
from torch import Tensor

from cltp.atomic_write import replacing
from cltp.checkpoints.frozen import FrozenEncoder, noisy_frames
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import NOISY, Augmentation, Batch, Sampler
from cltp.errors import TouchError
from cltp.tactile.point_layout import EVEN, PointLayout
from cltp.tactile.states import NUMBERS
from cltp.train.stage import ProgressReport, silent
from cltp.train.text_targets import class_numbers

_BATCH = 64
BLOCK = 32 * _BATCH


@dataclass(frozen=True, slots=True)
class EncodedContacts:
    """Features of contacts with their labels.

    Attributes:
        pooled: Shape (N, 2 C), float32.
        feature: Shape (N, F), float32; in the space shared with texts where the method aligns.
        classes: Shape (N, 5), in the order of ``CLASSES``; -1 without a label.
        numbers: Shape (N, 5), ``cltp.tactile.states.NUMBERS``.
        index: Shape (N,), numbers of the contacts in their split.
    """

    pooled: Tensor
    feature: Tensor
    classes: Tensor
    numbers: Tensor
    index: Tensor

    def __len__(self) -> int:
        return len(self.index)


def encode_contacts(
    encoder: FrozenEncoder,
    data: ContactDataset,
    noise: Augmentation,
    *,
    views: int = 1,
    limit: int | None = None,
    seed: int = 0,
    cache: Path | None = None,
    report: ProgressReport = silent,
) -> EncodedContacts:
    """Encode contacts, by way of half precision, in which blocks are stored.

    Args:
        encoder: The frozen encoder.
        data: A split.
        noise: Sensor noise that is added.
        views: How often each contact is encoded, with other noise each time.
        limit: Number of contacts, chosen by the seed; None for all.
        seed: Random seed of the noise and of the choice.
        cache: Folder for blocks; without one nothing is stored.
        report: Receives the progress.

    Raises:
        TouchError: A block on disk is damaged.
    """
    rows = selected_rows(len(data), views=views, limit=limit, seed=seed)
    key = {
        "encoder": encoder.sha256,
        "data": data.checksum(),
        "splits": sorted(set(data.column("split").tolist())),
        "noise": noise.identity,
        "seed": seed,
        "order": hashlib.sha256(rows.tobytes()).hexdigest(),
    }
    name = hashlib.sha256(json.dumps(key, sort_keys=True).encode()).hexdigest()[:20]
    sampler = Sampler(data, noise, seed=seed, layout=encoder.layout)
    blocks = []
    for first in range(0, len(rows), BLOCK):
        number, of_block = first // BLOCK, rows[first : first + BLOCK]
        path = cache / name / f"block-{number:05d}.safetensors" if cache is not None else None
        if path is not None and path.exists():
            block = _read_block(path, len(of_block))
        else:
            block = _encode_block(encoder, sampler, of_block, first // _BATCH)
            if path is not None:
                path.parent.mkdir(parents=True, exist_ok=True)
                with replacing(path) as part:
                    save_file(block, part)
        blocks.append(block)
        report("encode", first + len(of_block), len(rows), {})
    return _joined(blocks)


def encode_batches(encoder: FrozenEncoder, batches: Sequence[Batch]) -> EncodedContacts:
    """Encode batches that are drawn already, with an encoder of points, in full precision."""
    return _joined([_encode_batch(encoder, batch, None) for batch in batches])


def selected_rows(
    size: int, *, views: int = 1, limit: int | None = None, seed: int = 0
) -> NDArray[np.int64]:
    """Which contacts of a split are evaluated, ``views`` times one after the other."""
    chosen = np.random.default_rng([seed, 31]).permutation(size)[:limit]
    return np.tile(np.sort(chosen), views)


def numbered_batches(
    sampler: Sampler, rows: NDArray[np.int64], first_step: int = 0
) -> Iterator[tuple[Batch, int]]:
    """Batches of contacts with the numbers of their steps, on which the noise depends."""
    for step, first in enumerate(range(0, len(rows), _BATCH), start=first_step):
        yield sampler.batch(rows[first : first + _BATCH], step), step


def random_batches(
    data: ContactDataset,
    limit: int,
    noise: Augmentation = NOISY,
    *,
    seed: int = 0,
    layout: PointLayout = EVEN,
) -> list[Batch]:
    """Noisy clouds of up to ``limit`` contacts spread over a split, the same at every call."""
    sampler = Sampler(data, noise, seed=seed, layout=layout)
    chosen = np.random.default_rng(seed).permutation(len(data))[:limit]
    parts = np.array_split(chosen, -(-len(chosen) // _BATCH))
    return [sampler.batch(part, number) for number, part in enumerate(parts)]


def _read_block(path: Path, size: int) -> dict[str, Tensor]:
    try:
        block = load_file(path)
    except (OSError, SafetensorError) as error:
        raise TouchError(f"features in {path} are damaged; delete the file: {error}") from error
    if any(len(part) != size for part in block.values()):
        raise TouchError(f"features in {path} are of other contacts; delete the file")
    return block


def _encode_block(
    encoder: FrozenEncoder, sampler: Sampler, rows: NDArray[np.int64], first_step: int
) -> dict[str, Tensor]:
    parts = []
    for batch, step in numbered_batches(sampler, rows, first_step):
        frames = None
        if encoder.sees_images:
            rng = np.random.default_rng([sampler.seed, 67, step])
            frames = noisy_frames(batch.height_mm, batch.sensors, sampler.augmentation, rng)
        parts.append(_encode_batch(encoder, batch, frames))
    block = {key: torch.cat([part[key] for part in parts]).contiguous() for key in parts[0]}
    return block | {key: block[key].half() for key in ("pooled", "feature")}


def _encode_batch(encoder: FrozenEncoder, batch: Batch, frames: Tensor | None) -> dict[str, Tensor]:
    pooled, feature = encoder.encode(batch, frames)
    numbers = [[getattr(state, name) for name in NUMBERS] for state in batch.states]
    return {
        "pooled": pooled,
        "feature": feature,
        "classes": class_numbers(batch.states),
        "numbers": torch.tensor(numbers),
        "index": torch.from_numpy(batch.index).long(),
    }


def _joined(parts: Sequence[dict[str, Tensor]]) -> EncodedContacts:
    columns = {key: torch.cat([part[key] for part in parts]) for key in parts[0]}
    columns |= {key: columns[key].float() for key in ("pooled", "feature")}
    return EncodedContacts(**columns)
