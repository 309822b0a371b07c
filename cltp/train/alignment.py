"""Stage 'cltp': align the tactile encoder with the frozen towers (paper, section 4).

Minimises L_T2L + L_T2I, and beside them, beyond the paper, what ``cltp.encoder.heads`` reads from
the
encoder: classes and numbers make it precise enough to act on.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import torch
from torch import Tensor, nn

from cltp.checkpoints.tac3d_llm import load_clip, save_encoder
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import Augmentation, Sampler
from cltp.encoder.encoder import DEFAULT_PRESETS, PRESETS, EncoderConfig, TactileEncoder
from cltp.encoder.heads import StateHeads, Targets, targets
from cltp.encoder.losses import CltpLoss
from cltp.tactile.states import CLASSES
from cltp.train.clip_feature_cache import FrozenFeatures
from cltp.train.curves import plot_curves
from cltp.train.distributed import Workers
from cltp.train.finite_check import check_batch
from cltp.train.prefetch import ahead
from cltp.train.stage import ProgressReport, Schedule, Stage, silent
from cltp.train.text_targets import drawn_prompts, say, true_of

SCHEDULE = Schedule(steps=5000, batch_size=64, learning_rate=2e-3)


@dataclass(frozen=True, slots=True, kw_only=True)
class Recipe:
    """What is minimised.

    Attributes:
        with_images: False leaves L_T2I out (the paper's ablation).
        texts: What is said of contacts, out of ``cltp.train.text_targets.KINDS``; the paper's
            captions.
        several: Whether all texts that are true of a contact belong to it, not its own alone.
        prompt_weight: Of a contrast with one prompt for every class, dimension by dimension; 0 is
            the paper.
        head_weight: Of the state heads' terms; 0 is the paper.
        moved: Share of contacts that are shifted and turned on the pad (``cltp.data.placement``).
    """

    with_images: bool = True
    texts: str = "caption"
    several: bool = False
    prompt_weight: float = 0.0
    head_weight: float = 1.0
    moved: float = field(default=0.0, repr=False)  # trainings from before it still go on


RECIPE = Recipe(texts="mixed", several=True, prompt_weight=1.0)
"""What weights are trained by when nothing else is asked for.

Measured with a prompt weight of 0.2 on 1,417 unseen noisy contacts, shape / texture / depth /
position / area, % right by the paper's prompts, with a linear feature on a frozen encoder and a
text tower trained in 400 steps of 128: captions alone 27 / 51 / 59 / 82 / 58; mixed, each text to
its own contact alone 73 / 82 / 81 / 94 / 82; mixed, each to all that it fits 78 / 86 / 83 / 96 /
86, and 75 / 85 / 84 / 95 / 78 where the very prompts of the test were held back; captions and the
prompt contrast 78 / 85 / 84 / 96 / 88; both 79 / 87 / 84 / 96 / 86. Duplicate captions alone make
no difference: texts that are equal share what they win in any case.
"""


class _Learner(nn.Module):
    def __init__(self, config: EncoderConfig) -> None:
        super().__init__()
        self.encoder = TactileEncoder(config)
        self.heads = StateHeads(2 * config.dim)
        self.loss = CltpLoss()


def train_cltp(
    data_dir: Path,
    out_dir: Path,
    *,
    also: Sequence[Path] = (),
    config: EncoderConfig | None = None,
    schedule: Schedule = SCHEDULE,
    augmentation: Augmentation | None = None,
    recipe: Recipe | None = None,
    clip_dir: Path | None = None,
    shuffle_labels: bool = False,
    seed: int = 0,
    report: ProgressReport = silent,
    workers: Workers | None = None,
) -> Path:
    """Train, or go on training, and write ``out_dir/encoder``.

    Beside its checkpoint, in ``out_dir/.training``, lie ``cltp.csv`` and ``cltp.png``: the terms of
    every step, and the temperature.

    Args:
        data_dir: A data set of contacts; its training split is used.
        out_dir: Folder of weights.
        also: Further data sets to learn from, in one order with the first.
        config: Sizes of the encoder; its feature is made as wide as CLIP's.
        schedule: How long and how fast; the batch is that of all processes together.
        augmentation: How contacts are varied.
        recipe: What is minimised; ``RECIPE`` when not given.
        clip_dir: The towers; ``out_dir/clip`` when not given.
        shuffle_labels: Gives each contact the label of another: a control that must not learn.
        seed: Of weights, order, noise and mirroring.
        report: Told about progress.
        workers: The processes that train together.

    Raises:
        TouchError: Data, towers or checkpoint can't be used, or a batch is not finite.
    """
    workers, recipe = workers or Workers(), recipe or RECIPE
    data = ContactDataset(data_dir, split=Split.TRAIN, also=also)
    clip_dir = clip_dir or out_dir / "clip"
    towers = load_clip(clip_dir).to(workers.device)
    config = _as_wide_as(config or PRESETS[DEFAULT_PRESETS["cltp"]], towers.feature_dim)
    torch.manual_seed(seed)
    learner = _Learner(config).to(workers.device)
    identity = {
        "data": data.checksum(),
        "seed": seed,
        "config": config.identity,
        "variant": _variant(recipe, shuffle_labels, augmentation, workers),
    }
    folder = out_dir / "encoder"
    stage = Stage("cltp", out_dir / ".training", learner, schedule, identity, workers=workers)
    if stage.done and folder.exists():
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
    run = _Run(learner, frozen, recipe, sampler, workers, seed)
    run.prepare(stage)
    learner.train()
    stage.run(run.losses, report)
    if workers.is_first:
        frozen.save()
        plot_curves(stage.curves, stage.curves.with_suffix(".png"))
        learner.cpu().eval()
        save_encoder(folder, learner.encoder, learner.heads)
    workers.wait()
    return folder


def _variant(
    recipe: Recipe, shuffle_labels: bool, augmentation: Augmentation | None, workers: Workers
) -> str:
    """What tells trainings apart; as it was before recipes for those that there were then."""
    plain = Recipe(with_images=recipe.with_images, head_weight=recipe.head_weight)
    known = f"{recipe.head_weight} {recipe.with_images} {shuffle_labels} {augmentation}"
    if recipe.moved > 0:
        known = f"{known} moved {recipe.moved}"
    return known if recipe == plain and workers.count == 1 else f"{known} {recipe} {workers.count}"


class _Run:
    """One training: from a step's number to its terms."""

    def __init__(
        self,
        learner: _Learner,
        frozen: FrozenFeatures,
        recipe: Recipe,
        sampler: Sampler,
        workers: Workers,
        seed: int,
    ) -> None:
        self.learner, self.frozen, self.recipe = learner, frozen, recipe
        self.sampler, self.workers, self.seed = sampler, workers, seed

    def prepare(self, stage: Stage) -> None:
        size = self.workers.share(stage.schedule.batch_size)
        parts = (self.workers.part(step) for step in range(stage.step, stage.schedule.steps))
        self._batches = ahead(self.sampler.numbered(size, part) for part in parts)

    def losses(self, step: int) -> dict[str, Tensor]:
        """Terms of a step, over this process's part of its batch and the others' negatives."""
        batch, to = next(self._batches), self.workers.device
        wanted = targets(batch.states)
        check_batch("cltp", step, self.sampler.dataset, batch, wanted)
        rng = np.random.default_rng([self.seed, 55, self.workers.part(step)])
        said = say(batch.states, self.recipe.texts, rng)
        texts = self.frozen.texts(said.texts).to(to)
        images = self.frozen.images(batch).to(to) if self.recipe.with_images else None
        loss = self.learner.loss
        with self.workers.autocast():
            encoded = self.learner.encoder(torch.from_numpy(batch.points).to(to))
        feature = encoded.feature.float()
        belong = true_of(said, to) if self.recipe.several else None
        terms = loss(feature, texts, images, belong)
        if self.recipe.prompt_weight > 0:
            found = self._prompt_terms(feature, said.classes.to(to), rng)
            terms |= {name: self.recipe.prompt_weight * term for name, term in found.items()}
        if self.recipe.head_weight > 0:
            goals = Targets(*(part.to(to) for part in wanted))
            found = self.learner.heads.losses(encoded.pooled.float(), goals)
            terms |= {name: self.recipe.head_weight * term for name, term in found.items()}
        return terms | {"temperature": 1 / loss.contrast.scale.detach()}

    def _prompt_terms(
        self, feature: Tensor, classes: Tensor, rng: np.random.Generator
    ) -> dict[str, Tensor]:
        terms = {}
        for column, (slot, texts) in enumerate(zip(CLASSES, drawn_prompts(rng), strict=True)):
            found = self.frozen.texts(texts).to(feature.device)
            goal = classes[:, column]
            terms[f"prompt_{slot}"] = self.learner.loss.against_prompts(feature, found, goal)
        return terms


def _as_wide_as(config: EncoderConfig, feature_dim: int) -> EncoderConfig:
    return dataclasses.replace(config, feature_dim=feature_dim)
