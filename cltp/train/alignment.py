"""Stage 'cltp': align the tactile encoder with the frozen towers (paper, section 4).

Minimises L_T2L + L_T2I, and beside them, beyond the paper, what ``cltp.heads`` reads from the
encoder: classes and numbers make it precise enough to act on.
"""

from __future__ import annotations

import dataclasses
from pathlib import Path

import torch
from torch import Tensor, nn

from cltp.captions import caption
from cltp.clip import Towers
from cltp.contacts import Split
from cltp.dataset import ContactDataset
from cltp.encoder import EncoderConfig, TactileEncoder
from cltp.heads import StateHeads, Targets, targets
from cltp.losses import CltpLoss
from cltp.samples import Augmentation, Batch, Sampler
from cltp.train.ahead import ahead
from cltp.train.stage import Report, Schedule, Stage, device, silent
from cltp.train.towers import rendered
from cltp.weights import load_clip, save_encoder

SCHEDULE = Schedule(steps=6000, batch_size=32, learning_rate=1e-3)


class _Learner(nn.Module):
    def __init__(self, config: EncoderConfig) -> None:
        super().__init__()
        self.encoder = TactileEncoder(config)
        self.heads = StateHeads(2 * config.dim)
        self.loss = CltpLoss()


class FrozenFeatures:
    """Features of captions and images, computed once each: the towers don't change.

    Args:
        towers: Frozen.
        data: Whose images they are.
    """

    def __init__(self, towers: Towers, data: ContactDataset) -> None:
        self._towers, self._data = towers, data
        self._texts: dict[str, Tensor] = {}
        self._images: dict[tuple[int, bool, bool], Tensor] = {}

    def texts(self, batch: Batch) -> Tensor:
        """Features of the captions of a batch, shape (B, F)."""
        captions = [caption(state) for state in batch.states]
        new = sorted({text for text in captions if text not in self._texts})
        if new:
            self._texts.update(zip(new, self._towers.texts(new).cpu(), strict=True))
        return torch.stack([self._texts[text] for text in captions])

    def images(self, batch: Batch) -> Tensor:
        """Features of the images of a batch, shape (B, F)."""
        keys = [
            (int(i), bool(x), bool(y)) for i, (x, y) in zip(batch.index, batch.mirror, strict=True)
        ]
        if any(key not in self._images for key in keys):
            found = self._towers.images(rendered(self._data, batch)).cpu().half()
            self._images.update(zip(keys, found, strict=True))
        return torch.stack([self._images[key] for key in keys]).float()


def train_cltp(
    data_dir: Path,
    out_dir: Path,
    *,
    config: EncoderConfig | None = None,
    schedule: Schedule = SCHEDULE,
    augmentation: Augmentation | None = None,
    head_weight: float = 1.0,
    with_images: bool = True,
    shuffle_labels: bool = False,
    seed: int = 0,
    report: Report = silent,
) -> Path:
    """Train, or go on training, and write ``out_dir/encoder``.

    Args:
        data_dir: A data set of contacts; its training split is used.
        out_dir: Folder of weights, with ``clip`` in it.
        config: Sizes of the encoder; its feature is made as wide as CLIP's.
        schedule: How long and how fast.
        augmentation: How contacts are varied.
        head_weight: Of the state heads' terms; 0 is the paper's loss alone.
        with_images: False leaves L_T2I out (the paper's ablation).
        shuffle_labels: Gives each contact the label of another: a control that must not learn.
        seed: Of weights, order, noise and mirroring.
        report: Told about progress.

    Raises:
        TouchError: Data, towers or checkpoint can't be used.
    """
    data = ContactDataset(data_dir, split=Split.TRAIN)
    towers = load_clip(out_dir / "clip").to(device())
    config = _as_wide_as(config or EncoderConfig(), towers.feature_dim)
    torch.manual_seed(seed)
    learner = _Learner(config).to(device())
    identity = {
        "data": data.checksum(),
        "seed": seed,
        "config": str(config),
        "variant": f"{head_weight} {with_images} {shuffle_labels} {augmentation}",
    }
    stage = Stage("cltp", out_dir / ".training", learner, schedule, identity)
    folder = out_dir / "encoder"
    if stage.done and folder.exists():
        return folder
    frozen = FrozenFeatures(towers, data)
    sampler = Sampler(data, augmentation, seed=seed, shuffle_labels=shuffle_labels)
    batches = ahead(sampler.training(schedule.batch_size, stage.step))

    def losses(step: int) -> dict[str, Tensor]:
        batch = next(batches)
        encoded = learner.encoder(torch.from_numpy(batch.points).to(device()))
        images = frozen.images(batch).to(device()) if with_images else None
        terms = learner.loss(encoded.feature, frozen.texts(batch).to(device()), images)
        if head_weight > 0:
            wanted = Targets(*(part.to(device()) for part in targets(batch.states)))
            found = learner.heads.losses(encoded.pooled, wanted)
            terms |= {name: head_weight * term for name, term in found.items()}
        return terms

    learner.train()
    stage.run(losses, report)
    learner.cpu().eval()
    save_encoder(folder, learner.encoder, learner.heads)
    return folder


def _as_wide_as(config: EncoderConfig, feature_dim: int) -> EncoderConfig:
    return dataclasses.replace(config, feature_dim=feature_dim)
