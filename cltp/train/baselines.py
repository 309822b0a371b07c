"""Pre-training of the encoders that CLTP is compared with, on the same contacts.

``point_mae``, ``point_bert``: clouds alone (``cltp.encoder.masked_modelling``). Point-BERT's
    vocabulary takes a quarter of the steps, so that every method has the same number in all.
``tvl``, ``unitouch``: vision-based, after the paper's appendix A: an encoder of tactile frames is
    aligned with a frozen tower of language. TVL (Fu et al. 2024) names how a surface feels: our
    texture words. UniTouch (Yang et al. 2024) names the material of the object: our names of
    objects with their texture. No text names depth, position or area. Both methods also have
    photographs of the object, which a simulated press lacks; UniTouch's tokens for each sensor are
    left out, since training has one sensor.
``random``: nothing is learned; the floor.
"""

from __future__ import annotations

import dataclasses
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from torch import Tensor, nn

from cltp.checkpoints.frozen import noisy_frames, save_frozen
from cltp.checkpoints.tac3d_llm import load_clip
from cltp.data.dataset import ContactDataset
from cltp.data.prefetch import prefetched
from cltp.data.sampler import Augmentation, Batch, Sampler
from cltp.encoder.all_gather import gathered
from cltp.encoder.clip_towers import Towers
from cltp.encoder.encoder import EncoderConfig, TactileEncoder
from cltp.encoder.heads import targets
from cltp.encoder.losses import ContrastiveLoss
from cltp.encoder.masked_modelling import PointBert, PointMae, ShapeWords, patch_size, patches
from cltp.errors import TouchError
from cltp.train.clip_feature_cache import fingerprint
from cltp.train.finite_check import check_batch
from cltp.train.methods import ALIGNED_METHODS, IMAGE_METHODS, TRAINING_ORDER
from cltp.train.recipes import Schedule
from cltp.train.stage import Stage, TrainingRun

BASELINES = tuple(name for name in TRAINING_ORDER if name not in ALIGNED_METHODS)

_VOCABULARY_FRACTION = 0.25
_COLDEST = 0.0625  # Gumbel temperature falls from 1 to this. Source: Point-BERT, section 4

Losses = Callable[[Batch, int], dict[str, Tensor]]


def train_baseline(
    method: str,
    run: TrainingRun,
    config: EncoderConfig,
    schedule: Schedule,
    *,
    augmentation: Augmentation | None = None,
    clip_dir: Path | None = None,
) -> Path:
    """Train, or continue training, and write ``run.out / "encoder"``.

    Args:
        method: Out of ``BASELINES``.
        run: Data, folder, seed, progress and processes.
        config: Sizes of the encoder.
        schedule: How long and how fast the encoder learns.
        augmentation: How contacts are varied.
        clip_dir: Folder of the towers, for vision-based methods.

    Raises:
        TouchError: Data, towers or checkpoint can't be used, the encoder does not take the input of
            the method, or a batch is not finite.
    """
    if method not in BASELINES:
        raise TouchError(f"unknown method {method!r}; known: {', '.join(BASELINES)}")
    if method != "random" and config.variant.takes_images != (method in IMAGE_METHODS):
        taken = "image" if method in IMAGE_METHODS else "points"
        raise TouchError(f"{method} needs an encoder of {taken}, got tokenizer {config.tokenizer}")
    device = run.workers.device
    work = _Work(run, run.dataset(), config, schedule, augmentation or Augmentation())
    torch.manual_seed(run.seed)
    encoder = TactileEncoder(config).to(device)
    if method == "point_mae":
        mae = PointMae(encoder, patch_size(config)).to(device)
        work.train_masked(method, mae, schedule)
    elif method == "point_bert":
        _train_point_bert(encoder, work)
    elif method in IMAGE_METHODS:
        if clip_dir is None:
            raise TouchError(f"{method} is aligned with a tower of language; name a CLIP")
        _train_vision(method, encoder, load_clip(clip_dir), work)
    if run.workers.is_first:
        save_frozen(run.out / "encoder", encoder.cpu(), method)
    run.workers.wait()
    return run.out / "encoder"


@dataclass(frozen=True, slots=True)
class _Work:
    """What the stages of a method share, and how one is run."""

    run: TrainingRun
    data: ContactDataset
    config: EncoderConfig
    schedule: Schedule
    augmentation: Augmentation

    def train(
        self,
        name: str,
        model: nn.Module,
        losses: Losses,
        schedule: Schedule | None = None,
        towers: Towers | None = None,
    ) -> None:
        sizes, variant = self.config.identity, self.augmentation.identity
        identity = {"data": self.data.checksum(), "config": sizes, "variant": variant}
        if towers is not None:
            identity["towers"] = fingerprint(towers)
        stage = Stage(name, self.run, model, schedule or self.schedule, identity)
        layout = self.config.variant.layout
        sampler = Sampler(self.data, self.augmentation, seed=self.run.seed, layout=layout)
        batches = prefetched(stage.batches(sampler))

        def terms(step: int) -> dict[str, Tensor]:
            batch = next(batches)
            check_batch(name, step, self.data, batch, targets(batch.states))
            with self.run.workers.autocast():
                return losses(batch, step)

        stage.train(terms)
        if self.run.workers.is_first:
            stage.plot()

    def train_masked(self, name: str, model: PointMae | PointBert, schedule: Schedule) -> None:
        def losses(batch: Batch, step: int) -> dict[str, Tensor]:
            return model.losses(self.points(batch), self.torch_rng(step))

        self.train(name, model, losses, schedule)

    def points(self, batch: Batch) -> Tensor:
        return torch.from_numpy(batch.points).to(self.run.workers.device)

    def torch_rng(self, step: int) -> torch.Generator:
        """Random generator of a step, the same wherever a training is continued."""
        number = int(self.rng(step).integers(2**62))
        return torch.Generator().manual_seed(number)

    def rng(self, step: int) -> np.random.Generator:
        return np.random.default_rng([self.run.seed, 66, self.run.workers.part(step)])


def _train_point_bert(encoder: TactileEncoder, work: _Work) -> None:
    words = ShapeWords(encoder.config.dim, patch_size(encoder.config)).to(work.run.workers.device)
    steps = max(1, round(_VOCABULARY_FRACTION * work.schedule.steps))

    def word_losses(batch: Batch, step: int) -> dict[str, Tensor]:
        with torch.no_grad():
            cloud = patches(encoder, work.points(batch))
        temperature = max(_COLDEST, _COLDEST ** (step / steps))
        return words.losses(cloud, temperature, work.torch_rng(step))

    word_schedule = dataclasses.replace(work.schedule, steps=steps)
    work.train("point_bert_words", words, word_losses, word_schedule)
    bert = PointBert(encoder, words).to(work.run.workers.device)
    rest = max(1, work.schedule.steps - steps)
    work.train_masked("point_bert", bert, dataclasses.replace(work.schedule, steps=rest))


class _VisionLearner(nn.Module):
    def __init__(self, encoder: TactileEncoder) -> None:
        super().__init__()
        self.encoder, self.contrast = encoder, ContrastiveLoss()


def _train_vision(method: str, encoder: TactileEncoder, towers: Towers, work: _Work) -> None:
    if encoder.config.feature_dim != towers.feature_dim:
        raise TouchError(
            f"the encoder's feature has width {encoder.config.feature_dim}, the towers' "
            f"{towers.feature_dim}; choose a preset that fits"
        )
    learner = _VisionLearner(encoder).to(work.run.workers.device)
    text_features: dict[str, Tensor] = {}

    def losses(batch: Batch, step: int) -> dict[str, Tensor]:
        texts = surface_texts(method, work.data, batch)
        for text in texts:
            if text not in text_features:
                text_features[text] = towers.texts([text])[0].cpu()
        pixels = noisy_frames(batch.height_mm, batch.sensors, work.augmentation, work.rng(step))
        vision = encoder(pixels.to(work.run.workers.device)).feature.float()
        language = torch.stack([text_features[text] for text in texts]).to(work.run.workers.device)
        numbers = torch.tensor([zlib.crc32(text.encode()) for text in texts], device=vision.device)
        numbers = gathered(numbers)
        t2l = learner.contrast(vision, language, numbers[:, None] == numbers[None])
        return {"t2l": t2l, "temperature": 1 / learner.contrast.scale.detach()}

    work.train(method, learner, losses, towers=towers)


def surface_texts(method: str, data: ContactDataset, batch: Batch) -> list[str]:
    """Texts for a vision-based method: how contacts feel (``tvl``), or what the objects are."""
    texts = []
    for index, state in zip(batch.index, batch.states, strict=True):
        texture = f"{state.texture} " if state.texture is not None else ""
        if method == "tvl":
            texts.append(f"The surface feels {texture}to the touch.")
        else:
            name = str(data.column("object")[index]).replace("_", " ")
            texts.append(f"A touch of a {texture}{name}.")
    return texts
