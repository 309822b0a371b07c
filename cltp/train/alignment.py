"""Stage 'cltp': align the tactile encoder with the frozen towers (paper, section 4).

Minimises L_T2L + L_T2I and, beyond the paper, the losses of the state heads
(``cltp.encoder.heads``): classes and numbers make the encoder precise enough to act on.
"""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import NamedTuple

import numpy as np
import torch
from torch import Tensor, nn

from cltp.checkpoints.manifest import MANIFEST, manifest_digest
from cltp.checkpoints.tac3d_llm import load_clip, load_encoder, save_encoder
from cltp.data.prefetch import prefetched
from cltp.data.sampler import Augmentation, Batch, Sampler
from cltp.encoder.encoder import EncoderConfig, TactileEncoder
from cltp.encoder.force_head import ForceHead
from cltp.encoder.heads import StateHeads, Targets, targets
from cltp.encoder.losses import CltpLoss
from cltp.errors import TouchError
from cltp.train.calibration import calibrate_heads, fit_force
from cltp.train.clip_feature_cache import FrozenFeatures, fingerprint
from cltp.train.finite_check import check_batch
from cltp.train.recipes import CLTP_SCHEDULE, CltpRecipe, Schedule
from cltp.train.stage import Stage, TrainingRun
from cltp.train.text_targets import TextTargets, draw_texts, matches_of_all, prompt_terms


class _Learner(nn.Module):
    def __init__(self, config: EncoderConfig) -> None:
        super().__init__()
        self.encoder = TactileEncoder(config)
        self.heads = StateHeads.of(config)
        self.loss = CltpLoss()


def train_cltp(
    run: TrainingRun,
    config: EncoderConfig,
    schedule: Schedule = CLTP_SCHEDULE,
    recipe: CltpRecipe | None = None,
    *,
    with_images: bool = True,
    augmentation: Augmentation | None = None,
    clip_dir: Path | None = None,
    start: Path | None = None,
) -> Path:
    """Train, or continue training, and write ``run.out / "encoder"``.

    Args:
        run: Data, folder, seed, progress and processes.
        config: Sizes of the encoder; its feature is made as wide as CLIP's.
        schedule: How long and how fast the encoder learns.
        recipe: What is minimised.
        with_images: Whether L_T2I is minimised too; the paper's ablation goes without.
        augmentation: How contacts are varied.
        clip_dir: Folder of the towers; ``run.out / "clip"`` when not given.
        start: Folder of an encoder with its heads that is trained on; random ones when not given.

    Raises:
        TouchError: Data, towers, start or checkpoint can't be used, or a batch is not finite.
    """
    workers, seed, recipe = run.workers, run.seed, recipe or CltpRecipe()
    data = run.dataset()
    clip_dir = clip_dir or run.out / "clip"
    towers = load_clip(clip_dir).to(workers.device)
    config = dataclasses.replace(config, feature_dim=towers.feature_dim)
    torch.manual_seed(seed)
    learner = _Learner(config).to(workers.device)
    force = None if start is None else _take(start, learner)
    if recipe.coarse:
        augmentation = dataclasses.replace(augmentation or Augmentation(), coarse=recipe.coarse)
    if recipe.clean is not None:
        augmentation = dataclasses.replace(augmentation or Augmentation(), clean=recipe.clean)
    noise = augmentation and augmentation.identity
    identity = {
        "data": data.checksum(),
        "config": config.identity,
        "variant": f"{recipe.identity} {with_images} False {noise}",
        "towers": fingerprint(towers),
    }
    if start is not None:
        identity["start"] = manifest_digest(start)
    folder = run.out / "encoder"
    stage = Stage("cltp", run, learner, schedule, identity)
    if stage.done and (folder / MANIFEST).exists():  # the last file that is written
        return folder
    layout = config.variant.layout
    sampler = Sampler(
        data,
        augmentation,
        seed=seed,
        layout=layout,
        moved=recipe.moved,
        also_fraction=run.also_fraction,
    )
    cache = clip_dir.parent / ".training" if workers.is_first else None
    frozen = FrozenFeatures(towers, data, cache)
    samples = prefetched(
        _sample(step, run, frozen, recipe, with_images, batch)
        for step, batch in enumerate(stage.batches(sampler), start=stage.step)
    )
    stage.train(lambda step: _terms(step, run, learner, frozen, recipe, next(samples)))
    if workers.is_first:
        frozen.save()
        stage.plot()
        learner.cpu().eval()
        calibrate_heads(run, learner.encoder, learner.heads, augmentation)
        fit_force(run, learner.encoder, learner.heads, augmentation, force)
        save_encoder(folder, learner.encoder, learner.heads)
    workers.wait()
    return folder


def _take(start: Path, learner: _Learner) -> ForceHead | None:
    """Begin with an encoder and its heads; their force head, which is not trained, is returned."""
    encoder, heads = load_encoder(start)
    expected = learner.encoder.config
    if encoder.config != expected or not heads.has_intervals:
        raise TouchError(
            f"the encoder in {start} can't be trained on as {expected.tokenizer!r}: it has other "
            "sizes; name its own --preset, or train without --start"
        )
    learner.encoder.load_state_dict(encoder.state_dict())
    force, heads.force = heads.force, None
    learner.heads.load_state_dict(heads.state_dict())
    return force


class _Sample(NamedTuple):
    """A batch with all that is computed of it before the encoder's turn."""

    points: Tensor
    labels: Targets
    texts: TextTargets
    language: Tensor
    images: Tensor | None
    rng: np.random.Generator


def _sample(
    step: int,
    run: TrainingRun,
    frozen: FrozenFeatures,
    recipe: CltpRecipe,
    with_images: bool,
    batch: Batch,
) -> _Sample:
    """The sample of a step, in the thread that prepares the next ones."""
    labels = targets(batch.states)
    check_batch("cltp", step, frozen.data, batch, labels)
    rng = np.random.default_rng([run.seed, 55, run.workers.part(step)])
    texts = draw_texts(batch.states, recipe.texts, rng)
    return _Sample(
        points=torch.from_numpy(batch.points),
        labels=labels,
        texts=texts,
        language=frozen.texts(texts.texts),
        images=frozen.images(batch) if with_images and recipe.contrast_weight > 0 else None,
        rng=rng,
    )


def _terms(
    step: int,
    run: TrainingRun,
    learner: _Learner,
    frozen: FrozenFeatures,
    recipe: CltpRecipe,
    sample: _Sample,
) -> dict[str, Tensor]:
    """Terms of a step, over this process's part of its batch and the others' negatives."""
    device, loss = run.workers.device, learner.loss
    with run.workers.autocast():
        encoded = learner.encoder(sample.points.to(device))
    feature = encoded.feature.float()
    matches = matches_of_all(sample.texts, device) if recipe.texts == "mixed" else None
    images = None if sample.images is None else sample.images.to(device)
    terms: dict[str, Tensor] = {}
    if recipe.contrast_weight > 0:
        contrast = loss(feature, sample.language.to(device), images, matches)
        terms = {name: recipe.contrast_weight * term for name, term in contrast.items()}
    if recipe.prompt_weight > 0:
        classes = sample.texts.classes.to(device)
        prompts = prompt_terms(loss, feature, classes, frozen.texts, sample.rng)
        terms |= {name: recipe.prompt_weight * t for name, t in prompts.items()}
    if recipe.head_weight > 0:
        labels = Targets(*(part.to(device) for part in sample.labels))
        head_terms = learner.heads.losses(encoded.pooled.float(), labels)
        terms |= {name: recipe.head_weight * t for name, t in head_terms.items()}
    return terms | {"temperature": 1 / loss.contrast.scale.detach()}


def train_heads(
    run: TrainingRun,
    encoder: TactileEncoder,
    schedule: Schedule,
    augmentation: Augmentation | None = None,
) -> StateHeads:
    """Train, or continue training, state heads on a frozen encoder that has none.

    So an encoder of another method is compared behind the same language model: its readings are as
    good as its own tokens are.

    Args:
        run: Data, folder of the checkpoint, seed, progress and processes.
        encoder: The encoder; it is not changed.
        schedule: How long and how fast the heads learn.
        augmentation: How contacts are varied.

    Raises:
        TouchError: Data or checkpoint can't be used, or a batch is not finite.
    """
    data, device, config = run.dataset(), run.workers.device, encoder.config
    encoder = encoder.to(device).eval().requires_grad_(False)
    torch.manual_seed(run.seed)
    heads = StateHeads.of(config).to(device)
    weights = float(sum(p.double().abs().sum() for p in encoder.parameters()))
    identity = {
        "data": data.checksum(),
        "config": config.identity,
        "variant": str(augmentation and augmentation.identity),
    }
    stage = Stage("heads", run, heads, schedule, {**identity, "encoder": weights})
    sampler = Sampler(data, augmentation, seed=run.seed, layout=config.variant.layout)
    batches = prefetched(stage.batches(sampler))

    def terms(step: int) -> dict[str, Tensor]:
        batch = next(batches)
        labels = targets(batch.states)
        check_batch("heads", step, data, batch, labels)
        with torch.no_grad(), run.workers.autocast():
            pooled = encoder(torch.from_numpy(batch.points).to(device)).pooled.float()
        return heads.losses(pooled, Targets(*(part.to(device) for part in labels)))

    stage.train(terms)
    heads = heads.cpu().eval()
    calibrate_heads(run, encoder.cpu(), heads, augmentation)
    fit_force(run, encoder, heads, augmentation)
    return heads
