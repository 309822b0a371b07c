"""Stage 'clip': align a small CLIP on rendered contacts and their captions, then freeze it.

A stock CLIP has seen enough language to tell "left" from "right" before it sees a contact. A small
one that begins at random has not, and a contrast alone leaves it there: while both words mean the
same to the tower of language, the tower of images gains nothing by telling them apart, and the
other way round. A second loss therefore reads the texts back from their features: the class that
each one names, by the nearest of learned directions, which are dropped after training.
"""

from __future__ import annotations

from functools import partial
from pathlib import Path

import numpy as np
import torch
import torch.nn.functional as F
from torch import Tensor, nn
from transformers import CLIPModel

from cltp.checkpoints.manifest import MANIFEST
from cltp.checkpoints.tac3d_llm import save_pretrained
from cltp.data.prefetch import prefetched
from cltp.data.sampler import Augmentation, Sampler
from cltp.encoder.clip_towers import image_features, small_clip, text_features
from cltp.encoder.losses import CltpLoss
from cltp.tactile.states import CLASSES
from cltp.texts.tokenizer import Words
from cltp.train.clip_feature_cache import rendered
from cltp.train.recipes import CLIP_SCHEDULE, ClipRecipe, Schedule
from cltp.train.stage import Stage, TrainingRun
from cltp.train.text_targets import TextTargets, draw_texts, matches, matches_of_all, prompt_terms

READ_SCALE = 16.0
"""Factor on the cosines between texts and classes; about the scale that the contrast learns."""

RENDERED = Augmentation(noise_level=0.0, uncalibrated=0.0)
"""Images show the clean gel, as the paper's are rendered from simulation."""


class ClassDirections(nn.Module):
    """A direction for every class, by which classes are read from the features of texts.

    Args:
        feature_dim: Width F of the features.
    """

    def __init__(self, feature_dim: int) -> None:
        super().__init__()
        self.directions = nn.ParameterList(
            torch.randn(len(names), feature_dim) for names in CLASSES.values()
        )

    def loss(self, features: Tensor, texts: TextTargets) -> Tensor:
        """Cross-entropy of the classes that texts name, given their features (B, F)."""
        unit = F.normalize(features, dim=1)
        terms = []
        for column, directions in enumerate(self.directions):
            named = texts.named[:, column] & (texts.classes[:, column] >= 0)
            if named.any():
                cosines = unit[named.to(unit.device)] @ F.normalize(directions, dim=1).T
                labels = texts.classes[named, column].to(unit.device)
                terms.append(F.cross_entropy(READ_SCALE * cosines, labels))
        return torch.stack(terms).mean() if terms else 0.0 * features.sum()


class _Learner(nn.Module):
    def __init__(self, clip: CLIPModel) -> None:
        super().__init__()
        self.clip, self.loss = clip, CltpLoss()
        self.class_directions = ClassDirections(clip.text_projection.out_features)


def train_clip(
    run: TrainingRun,
    words: Words,
    schedule: Schedule = CLIP_SCHEDULE,
    recipe: ClipRecipe | None = None,
    *,
    dim: int = 128,
) -> Path:
    """Train, or continue training, and write ``run.out / "clip"``.

    Args:
        run: Data, folder, seed, progress and processes.
        words: The tokenizer of captions.
        schedule: How long and how fast CLIP learns.
        recipe: What is minimised.
        dim: Width of the towers and of the shared space.

    Raises:
        TouchError: The data can't be read, or a checkpoint is of another training.
    """
    workers, seed, recipe = run.workers, run.seed, recipe or ClipRecipe()
    data = run.dataset()
    torch.manual_seed(seed)
    learner = _Learner(small_clip(words, dim=dim)).to(workers.device)
    identity = {
        "data": data.checksum(),
        "dim": dim,
        "words": words.fingerprint(),
        "variant": str(recipe),
    }
    stage = Stage("clip", run, learner, schedule, identity)
    folder = run.out / "clip"
    if stage.done and (folder / MANIFEST).exists():
        return folder
    sampler = Sampler(data, RENDERED, seed=seed)
    batches = prefetched((batch, rendered(batch)) for batch in stage.batches(sampler))
    encode = partial(text_features, learner.clip, words)

    def losses(step: int) -> dict[str, Tensor]:
        batch, pixels = next(batches)
        rng = np.random.default_rng([seed, 56, workers.part(step)])
        texts = draw_texts(batch.states, recipe.texts, rng)
        with workers.autocast():
            language = encode(texts.texts).float()
            images = image_features(learner.clip, pixels.to(workers.device)).float()
        matching = matches_of_all(texts, workers.device) if recipe.texts == "mixed" else None
        terms = {"contrast": learner.loss.contrast(images, language, matching)}
        if recipe.prompt_weight > 0:
            classes = texts.classes.to(workers.device)
            prompts = prompt_terms(learner.loss, images, classes, encode, rng)
            terms |= {name: recipe.prompt_weight * term for name, term in prompts.items()}
        if recipe.read_weight > 0:
            terms["read"] = recipe.read_weight * learner.class_directions.loss(language, texts)
        nearest = (language @ images.T).argmax(dim=1).cpu()
        true_texts = matches(texts.classes, texts.classes, texts.named)
        right = true_texts[nearest, torch.arange(len(nearest))]
        temperature = 1 / learner.loss.contrast.scale.detach()
        return terms | {"right": right.float().mean(), "temperature": temperature}

    stage.train(losses)
    if workers.is_first:
        stage.plot()
        save_pretrained(folder, learner.clip.cpu().eval(), words)
    workers.wait()
    return folder
