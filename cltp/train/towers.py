"""Stage 'clip': align a small CLIP on rendered contacts and their captions, to be frozen then."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import torch
from torch import Tensor, nn
from transformers import CLIPModel

from cltp.captions import caption
from cltp.clip import image_features, small_clip, text_features
from cltp.contacts import Split
from cltp.dataset import ContactDataset
from cltp.losses import ContrastiveLoss
from cltp.samples import Augmentation, Batch, Sampler
from cltp.tokenizer import Words
from cltp.train.ahead import ahead
from cltp.train.features import rendered
from cltp.train.stage import Report, Schedule, Stage, device, silent
from cltp.weights import save_clip

SCHEDULE = Schedule(steps=500, batch_size=128, learning_rate=1e-3)

RENDERED = Augmentation(noise_level=0.0, uncalibrated=0.0)
"""Images are of the clean gel, as the paper's are rendered from simulation."""


class _Learner(nn.Module):
    def __init__(self, clip: CLIPModel) -> None:
        super().__init__()
        self.clip, self.loss = clip, ContrastiveLoss()


def train_clip(
    data_dir: Path,
    out_dir: Path,
    words: Words,
    *,
    schedule: Schedule = SCHEDULE,
    dim: int = 128,
    seed: int = 0,
    report: Report = silent,
) -> Path:
    """Train, or go on training, and write ``out_dir/clip``.

    Args:
        data_dir: A data set of contacts; its training split is used.
        out_dir: Folder of weights; checkpoints lie in its ``.training``.
        words: The tokenizer of captions.
        schedule: How long and how fast.
        dim: Width of the towers and of the shared space.
        seed: Of weights, order and mirroring.
        report: Told about progress.

    Raises:
        TouchError: The data can't be read, or a checkpoint is of another training.
    """
    data = ContactDataset(data_dir, split=Split.TRAIN)
    torch.manual_seed(seed)
    learner = _Learner(small_clip(words, dim=dim)).to(device())
    identity = {"data": data.checksum(), "seed": seed, "dim": dim, "words": words.fingerprint()}
    stage = Stage("clip", out_dir / ".training", learner, schedule, identity)
    folder = out_dir / "clip"
    if stage.done and folder.exists():
        return folder
    batches = ahead(_batches(data, seed, schedule, stage.step))

    def losses(step: int) -> dict[str, Tensor]:
        batch, pixels = next(batches)
        captions = [caption(state) for state in batch.states]
        texts = text_features(learner.clip, words, captions)
        images = image_features(learner.clip, pixels.to(device()))
        similar = (texts @ images.T).argmax(dim=1).cpu().numpy()
        right = np.mean([captions[found] == own for found, own in zip(similar, captions)])  # noqa: B905
        return {"contrast": learner.loss(images, texts), "right": torch.tensor(float(right))}

    learner.train()
    stage.run(losses, report)
    save_clip(folder, learner.clip.cpu().eval(), words)
    return folder


def _batches(
    data: ContactDataset, seed: int, schedule: Schedule, first_step: int
) -> Iterator[tuple[Batch, Tensor]]:
    sampler = Sampler(data, RENDERED, seed=seed)
    for batch in sampler.training(schedule.batch_size, first_step):
        yield batch, rendered(data, batch)
