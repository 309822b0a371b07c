"""Pre-training of the encoders that CLTP is compared with, on the same contacts.

``point_mae``, ``point_bert``: clouds alone (``cltp.encoder.masked_modelling``). Point-BERT's
vocabulary takes a
    quarter of the steps, so that every method has the same number in all.
``tvl``, ``unitouch``: vision-based, after the paper's appendix A: an encoder of tactile frames is
    aligned with a frozen tower of language. TVL (Fu et al. 2024) speaks of how a surface feels: our
    texture words. UniTouch (Yang et al. 2024) binds touch to what is touched, its material: our
    names of objects with their texture. Neither hears of depth, position or area. Both also have
    photographs of the object, which a simulated press has not; UniTouch's tokens for each sensor
    are left out, since training has one sensor.
``random``: nothing is learned; the floor.
"""

from __future__ import annotations

import zlib
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import torch
from torch import Tensor, nn

from cltp.checkpoints.frozen import noisy_frames, save_frozen
from cltp.checkpoints.tac3d_llm import load_clip
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import Augmentation, Batch, Sampler
from cltp.encoder.all_gather import gathered
from cltp.encoder.clip_towers import Towers
from cltp.encoder.encoder import DEFAULT_PRESETS, PRESETS, EncoderConfig, TactileEncoder
from cltp.encoder.heads import targets
from cltp.encoder.losses import ContrastiveLoss
from cltp.encoder.masked_modelling import PointBert, PointMae, ShapeWords, patches
from cltp.errors import TouchError
from cltp.tactile.sensors import sensor_named
from cltp.train.curves import plot_curves
from cltp.train.distributed import Workers
from cltp.train.finite_check import check_batch
from cltp.train.prefetch import ahead
from cltp.train.stage import ProgressReport, Schedule, Stage, silent

METHODS = ("point_mae", "point_bert", "tvl", "unitouch", "random")

_VOCABULARY_SHARE = 0.25
_COLDEST = 0.0625  # Gumbel temperature falls from 1 to this. Source: Point-BERT, section 4

Losses = Callable[[Batch, int], dict[str, Tensor]]


def train_baseline(
    method: str,
    data_dir: Path,
    out_dir: Path,
    *,
    config: EncoderConfig | None = None,
    schedule: Schedule,
    augmentation: Augmentation | None = None,
    clip_dir: Path | None = None,
    seed: int = 0,
    report: ProgressReport = silent,
    workers: Workers | None = None,
) -> Path:
    """Train, or go on training, and write ``out_dir/encoder``.

    Args:
        method: Out of ``METHODS``.
        data_dir: A data set of contacts; its training split is used.
        out_dir: Folder of this method.
        config: Sizes of the encoder.
        schedule: How long and how fast.
        augmentation: How contacts are varied.
        clip_dir: The towers, for vision-based methods.
        seed: Of weights, order, noise and masks.
        report: Told about progress.
        workers: The processes that train together.

    Raises:
        TouchError: Data, towers or checkpoint can't be used, the encoder does not take what the
            method shows it, or a batch is not finite.
    """
    if method not in METHODS:
        raise TouchError(f"unknown method {method!r}; known: {', '.join(METHODS)}")
    config = config or PRESETS[DEFAULT_PRESETS[method]]
    sees = "image" if method in ("tvl", "unitouch") else "points"
    if method != "random" and (config.tokenizer == "image") != (sees == "image"):
        raise TouchError(f"{method} needs an encoder of {sees}, got tokenizer {config.tokenizer}")
    data = ContactDataset(data_dir, split=Split.TRAIN)
    work = _Work(data, out_dir, schedule, augmentation, seed, report, workers or Workers(), config)
    torch.manual_seed(seed)
    encoder = TactileEncoder(config).to(work.workers.device)
    if method == "point_mae":
        mae = PointMae(encoder, _group_size(config)).to(work.workers.device)
        work.run(
            method, mae, lambda batch, step: mae.losses(work.points(batch), work.torch_rng(step))
        )
    elif method == "point_bert":
        _point_bert(encoder, work)
    elif method != "random":
        if clip_dir is None:
            raise TouchError(f"{method} is aligned with a tower of language; name a CLIP")
        _vision(method, encoder, load_clip(clip_dir), work)
    if work.workers.is_first:
        save_frozen(out_dir / "encoder", encoder.cpu(), method)
    work.workers.wait()
    return out_dir / "encoder"


def _group_size(config: EncoderConfig) -> int:
    return config.group_size if config.tokenizer == "fps" else 16


class _Work:
    """What all methods share: data, schedule, and how a stage is run over them."""

    def __init__(
        self,
        data: ContactDataset,
        out_dir: Path,
        schedule: Schedule,
        augmentation: Augmentation | None,
        seed: int,
        report: ProgressReport,
        workers: Workers,
        config: EncoderConfig,
    ) -> None:
        self.data, self.schedule, self.seed, self.workers = data, schedule, seed, workers
        self.augmentation = augmentation or Augmentation()
        self._folder, self._report, self._config = out_dir / ".training", report, config

    def run(
        self, name: str, model: nn.Module, losses: Losses, schedule: Schedule | None = None
    ) -> None:
        schedule = schedule or self.schedule
        identity = {
            "data": self.data.checksum(),
            "seed": self.seed,
            "config": self._config.identity,
            "variant": f"{self.augmentation} {self.workers.count}",
        }
        stage = Stage(name, self._folder, model, schedule, identity, workers=self.workers)
        batches = ahead(self._batches(stage.step, schedule))

        def terms(step: int) -> dict[str, Tensor]:
            batch = next(batches)
            check_batch(name, step, self.data, batch, targets(batch.states))
            with self.workers.autocast():
                return losses(batch, step)

        model.train()
        stage.run(terms, self._report)
        if self.workers.is_first and stage.curves.exists():
            plot_curves(stage.curves, stage.curves.with_suffix(".png"))

    def _batches(self, first: int, schedule: Schedule) -> Iterator[Batch]:
        sampler = Sampler(
            self.data, self.augmentation, seed=self.seed, sampling=self._config.sampling
        )
        size = self.workers.share(schedule.batch_size)
        for step in range(first, schedule.steps):
            yield sampler.numbered(size, self.workers.part(step))

    def points(self, batch: Batch) -> Tensor:
        return torch.from_numpy(batch.points).to(self.workers.device)

    def torch_rng(self, step: int) -> torch.Generator:
        """Draws of a step, the same wherever a training is taken up again."""
        number = int(self.rng(step).integers(2**62))
        return torch.Generator().manual_seed(number)

    def rng(self, step: int) -> np.random.Generator:
        return np.random.default_rng([self.seed, 66, self.workers.part(step)])


def _point_bert(encoder: TactileEncoder, work: _Work) -> None:
    size = _group_size(encoder.config)
    words = ShapeWords(encoder.config.dim, size).to(work.workers.device)
    steps = max(1, round(_VOCABULARY_SHARE * work.schedule.steps))

    def first(batch: Batch, step: int) -> dict[str, Tensor]:
        with torch.no_grad():
            seen = patches(encoder, work.points(batch))
        warmth = max(_COLDEST, _COLDEST ** (step / steps))
        return words.losses(seen, warmth, work.torch_rng(step))

    work.run("point_bert_words", words, first, _shortened(work.schedule, steps))
    bert = PointBert(encoder, words).to(work.workers.device)
    rest = _shortened(work.schedule, max(1, work.schedule.steps - steps))
    work.run(
        "point_bert",
        bert,
        lambda batch, step: bert.losses(work.points(batch), work.torch_rng(step)),
        rest,
    )


def _shortened(schedule: Schedule, steps: int) -> Schedule:
    return Schedule(
        steps=steps,
        batch_size=schedule.batch_size,
        learning_rate=schedule.learning_rate,
        weight_decay=schedule.weight_decay,
        warm_up=schedule.warm_up,
        largest_gradient=schedule.largest_gradient,
    )


class _Seeing(nn.Module):
    def __init__(self, encoder: TactileEncoder) -> None:
        super().__init__()
        self.encoder, self.contrast = encoder, ContrastiveLoss()


def _vision(method: str, encoder: TactileEncoder, towers: Towers, work: _Work) -> None:
    if encoder.config.feature_dim != towers.feature_dim:
        raise TouchError(
            f"the encoder's feature has width {encoder.config.feature_dim}, the towers' "
            f"{towers.feature_dim}; choose a preset that fits"
        )
    learner = _Seeing(encoder).to(work.workers.device)
    known: dict[str, Tensor] = {}
    sensors = work.data.column("sensor")

    def losses(batch: Batch, step: int) -> dict[str, Tensor]:
        texts = felt_texts(method, work.data, batch)
        for text in texts:
            if text not in known:
                known[text] = towers.texts([text])[0].cpu()
        pixels = noisy_frames(
            batch.height_mm,
            [sensor_named(sensors[index]) for index in batch.index],
            work.augmentation,
            work.rng(step),
        )
        seen = encoder(pixels.to(work.workers.device)).feature.float()
        spoken = torch.stack([known[text] for text in texts]).to(work.workers.device)
        names = torch.tensor([zlib.crc32(text.encode()) for text in texts], device=seen.device)
        names = gathered(names)
        fits = names[:, None] == names[None]
        terms = {"t2l": learner.contrast(seen, spoken, fits)}
        return terms | {"temperature": 1 / learner.contrast.scale.detach()}

    work.run(method, learner, losses)


def felt_texts(method: str, data: ContactDataset, batch: Batch) -> list[str]:
    """What a vision-based method is told of contacts: how they feel, or what they are."""
    texts = []
    for index, state in zip(batch.index, batch.states, strict=True):
        feel = f"{state.texture} " if state.texture is not None else ""
        if method == "tvl":
            texts.append(f"The surface feels {feel}to the touch.")
        else:
            name = str(data.column("object")[index]).replace("_", " ")
            texts.append(f"A touch of a {feel}{name}.")
    return texts
