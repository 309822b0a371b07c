"""Stage 'cltp': align the tactile encoder with the frozen towers (paper, section 4).

Minimises L_T2L + L_T2I and, beyond the paper, the losses of the state heads
(``cltp.encoder.heads``): classes and numbers make the encoder precise enough to act on.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from torch import Tensor, nn

from cltp.checkpoints.tac3d_llm import load_clip, save_encoder
from cltp.checkpoints.weight_files import CONFIG
from cltp.data.sampler import Augmentation, Batch, Sampler
from cltp.encoder.encoder import EncoderConfig, TactileEncoder
from cltp.encoder.heads import StateHeads, Targets, targets
from cltp.encoder.losses import CltpLoss
from cltp.tactile.states import CLASSES
from cltp.train.clip_feature_cache import FrozenFeatures
from cltp.train.distributed import Workers
from cltp.train.finite_check import check_batch
from cltp.train.prefetch import prefetched
from cltp.train.recipes import CLTP_SCHEDULE, CltpRecipe, Schedule
from cltp.train.stage import Stage, TrainingRun
from cltp.train.text_targets import draw_prompts, draw_texts, matches_of_all


class _Learner(nn.Module):
    def __init__(self, config: EncoderConfig) -> None:
        super().__init__()
        self.encoder = TactileEncoder(config)
        self.heads = StateHeads(2 * config.dim)
        self.loss = CltpLoss()


def train_cltp(
    run: TrainingRun,
    config: EncoderConfig,
    schedule: Schedule = CLTP_SCHEDULE,
    recipe: CltpRecipe | None = None,
    *,
    with_images: bool = True,
    also: Sequence[Path] = (),
    augmentation: Augmentation | None = None,
    clip_dir: Path | None = None,
    shuffle_labels: bool = False,
) -> Path:
    """Train, or continue training, and write ``run.out / "encoder"``.

    Args:
        run: Data, folder, seed, progress and processes.
        config: Sizes of the encoder; its feature is made as wide as CLIP's.
        schedule: How long and how fast the encoder learns.
        recipe: What is minimised.
        with_images: Whether L_T2I is minimised too; the paper's ablation goes without.
        also: Further data sets to learn from, in one random order with the first.
        augmentation: How contacts are varied.
        clip_dir: Folder of the towers; ``run.out / "clip"`` when not given.
        shuffle_labels: Gives each contact the label of another: a control that must not learn.

    Raises:
        TouchError: Data, towers or checkpoint can't be used, or a batch is not finite.
    """
    workers, seed, recipe = run.workers, run.seed, recipe or CltpRecipe()
    data = run.dataset(also)
    clip_dir = clip_dir or run.out / "clip"
    towers = load_clip(clip_dir).to(workers.device)
    config = dataclasses.replace(config, feature_dim=towers.feature_dim)
    torch.manual_seed(seed)
    learner = _Learner(config).to(workers.device)
    identity = {
        "data": data.checksum(),
        "config": config.identity,
        "variant": f"{recipe} {with_images} {shuffle_labels} {augmentation}",
    }
    folder = run.out / "encoder"
    stage = Stage("cltp", run, learner, schedule, identity)
    if stage.done and (folder / CONFIG).exists():  # the last file that is written
        return folder
    sampler = Sampler(
        data,
        augmentation,
        seed=seed,
        sampling=config.sampling,
        moved=recipe.moved,
        shuffle_labels=shuffle_labels,
    )
    cache = clip_dir.parent / ".training" if workers.is_first else None
    frozen = FrozenFeatures(towers, data, cache)
    losses = _Losses(
        learner=learner,
        frozen=frozen,
        recipe=recipe,
        with_images=with_images,
        batches=prefetched(stage.batches(sampler)),
        workers=workers,
        seed=seed,
    )
    stage.train(losses)
    if workers.is_first:
        frozen.save()
        stage.plot()
        learner.cpu().eval()
        save_encoder(folder, learner.encoder, learner.heads)
    workers.wait()
    return folder


@dataclass(frozen=True, slots=True, kw_only=True)
class _Losses:
    """From the number of a step to its terms."""

    learner: _Learner
    frozen: FrozenFeatures
    recipe: CltpRecipe
    with_images: bool
    batches: Iterator[Batch]
    workers: Workers
    seed: int

    def __call__(self, step: int) -> dict[str, Tensor]:
        """Terms of a step, over this process's part of its batch and the others' negatives."""
        batch, device = next(self.batches), self.workers.device
        labels = targets(batch.states)
        check_batch("cltp", step, self.frozen.data, batch, labels)
        rng = np.random.default_rng([self.seed, 55, self.workers.part(step)])
        texts = draw_texts(batch.states, self.recipe.texts, rng)
        language = self.frozen.texts(texts.texts).to(device)
        images = self.frozen.images(batch).to(device) if self.with_images else None
        loss = self.learner.loss
        with self.workers.autocast():
            encoded = self.learner.encoder(torch.from_numpy(batch.points).to(device))
        feature = encoded.feature.float()
        matches = matches_of_all(texts, device) if self.recipe.shares_texts else None
        terms = loss(feature, language, images, matches)
        if self.recipe.prompt_weight > 0:
            prompt_terms = self._prompt_terms(feature, texts.classes.to(device), rng)
            terms |= {name: self.recipe.prompt_weight * t for name, t in prompt_terms.items()}
        if self.recipe.head_weight > 0:
            labels = Targets(*(part.to(device) for part in labels))
            head_terms = self.learner.heads.losses(encoded.pooled.float(), labels)
            terms |= {name: self.recipe.head_weight * t for name, t in head_terms.items()}
        return terms | {"temperature": 1 / loss.contrast.scale.detach()}

    def _prompt_terms(
        self, feature: Tensor, classes: Tensor, rng: np.random.Generator
    ) -> dict[str, Tensor]:
        terms = {}
        for column, (slot, texts) in enumerate(zip(CLASSES, draw_prompts(rng), strict=True)):
            prompts = self.frozen.texts(texts).to(feature.device)
            terms[f"prompt_{slot}"] = self.learner.loss.against_prompts(
                feature, prompts, classes[:, column]
            )
        return terms
