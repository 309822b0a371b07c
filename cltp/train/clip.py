"""Stage 'clip': align a small CLIP on rendered contacts and their captions, to be frozen then.

A stock CLIP has seen enough language to tell "left" from "right" before it sees a contact; a small
one that begins at random has not, and a contrast alone leaves it there: while both words mean the
same to the tower of language, the tower of images gains nothing by telling them apart, and the
other way round. So the tower of language also has to let its texts be read back: which class each
one names, by the nearest of learned directions that are dropped afterwards.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import torch
import torch.nn.functional as F
from torch import Tensor, nn
from transformers import CLIPModel

from cltp.checkpoints.tac3d_llm import save_clip
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import Augmentation, Batch, Sampler
from cltp.encoder.clip_towers import image_features, small_clip, text_features
from cltp.encoder.losses import CltpLoss
from cltp.tactile.states import CLASSES
from cltp.texts.tokenizer import Words
from cltp.train.clip_feature_cache import rendered
from cltp.train.curves import plot_curves
from cltp.train.distributed import Workers
from cltp.train.prefetch import ahead
from cltp.train.stage import ProgressReport, Schedule, Stage, silent
from cltp.train.text_targets import Sayings, drawn_prompts, fits, say, true_of

SCHEDULE = Schedule(steps=400, batch_size=128, learning_rate=1e-3)

READ_SCALE = 16.0
"""Of cosines when texts are read back; about what the learned temperature comes to."""

RENDERED = Augmentation(noise_level=0.0, uncalibrated=0.0)
"""Images are of the clean gel, as the paper's are rendered from simulation."""


class Meanings(nn.Module):
    """A direction for every class, by which texts are read back from their features.

    Args:
        feature_dim: Width F of the features.
    """

    def __init__(self, feature_dim: int) -> None:
        super().__init__()
        self.directions = nn.ParameterList(
            torch.randn(len(names), feature_dim) for names in CLASSES.values()
        )

    def loss(self, spoken: Tensor, said: Sayings) -> Tensor:
        """Cross-entropy of the classes that texts name, given their features (B, F)."""
        unit = F.normalize(spoken, dim=1)
        terms = []
        for column, directions in enumerate(self.directions):
            named = said.named[:, column] & (said.classes[:, column] >= 0)
            if named.any():
                near = unit[named.to(unit.device)] @ F.normalize(directions, dim=1).T
                goal = said.classes[named, column].to(unit.device)
                terms.append(F.cross_entropy(READ_SCALE * near, goal))
        return torch.stack(terms).mean() if terms else 0.0 * spoken.sum()


class _Learner(nn.Module):
    def __init__(self, clip: CLIPModel) -> None:
        super().__init__()
        self.clip, self.loss = clip, CltpLoss()
        self.meanings = Meanings(clip.text_projection.out_features)


def train_clip(
    data_dir: Path,
    out_dir: Path,
    words: Words,
    *,
    schedule: Schedule = SCHEDULE,
    dim: int = 128,
    texts: str = "mixed",
    several: bool = True,
    prompt_weight: float = 1.0,
    read_weight: float = 1.0,
    seed: int = 0,
    report: ProgressReport = silent,
    workers: Workers | None = None,
) -> Path:
    """Train, or go on training, and write ``out_dir/clip``.

    Args:
        data_dir: A data set of contacts; its training split is used.
        out_dir: Folder of weights; checkpoints lie in its ``.training``.
        words: The tokenizer of captions.
        schedule: How long and how fast.
        dim: Width of the towers and of the shared space.
        texts: What is said of contacts, out of ``cltp.train.text_targets.KINDS``.
        several: Whether all texts that are true of a contact belong to its image.
        prompt_weight: Of a contrast with one prompt for every class, dimension by dimension.
        read_weight: Of reading texts back.
        seed: Of weights, order and mirroring.
        report: Told about progress.
        workers: The processes that train together.

    Raises:
        TouchError: The data can't be read, or a checkpoint is of another training.
    """
    workers = workers or Workers()
    data = ContactDataset(data_dir, split=Split.TRAIN)
    torch.manual_seed(seed)
    learner = _Learner(small_clip(words, dim=dim)).to(workers.device)
    identity = {
        "data": data.checksum(),
        "seed": seed,
        "dim": dim,
        "words": words.fingerprint(),
        "variant": f"{texts} {several} {prompt_weight} {read_weight} {workers.count}",
    }
    stage = Stage("clip", out_dir / ".training", learner, schedule, identity, workers=workers)
    folder = out_dir / "clip"
    if stage.done and folder.exists():
        return folder
    batches = ahead(_batches(data, seed, stage, workers))

    def losses(step: int) -> dict[str, Tensor]:
        batch, pixels = next(batches)
        rng = np.random.default_rng([seed, 56, workers.part(step)])
        said = say(batch.states, texts, rng)
        with workers.autocast():
            spoken = text_features(learner.clip, words, said.texts).float()
            images = image_features(learner.clip, pixels.to(workers.device)).float()
        belong = true_of(said, workers.device) if several else None
        terms = {"contrast": learner.loss.contrast(images, spoken, belong)}
        if prompt_weight > 0:
            found = _prompt_terms(learner, words, images, said.classes.to(workers.device), rng)
            terms |= {name: prompt_weight * term for name, term in found.items()}
        if read_weight > 0:
            terms["read"] = read_weight * learner.meanings.loss(spoken, said)
        near = (spoken @ images.T).argmax(dim=1).cpu()
        right = fits(said.classes, said.classes, said.named)[near, torch.arange(len(near))]
        temperature = 1 / learner.loss.contrast.scale.detach()
        return terms | {"right": right.float().mean(), "temperature": temperature}

    learner.train()
    stage.run(losses, report)
    if workers.is_first:
        plot_curves(stage.curves, stage.curves.with_suffix(".png"))
        save_clip(folder, learner.clip.cpu().eval(), words)
    workers.wait()
    return folder


def _prompt_terms(
    learner: _Learner, words: Words, images: Tensor, classes: Tensor, rng: np.random.Generator
) -> dict[str, Tensor]:
    drawn = drawn_prompts(rng)
    found = text_features(learner.clip, words, [text for of_slot in drawn for text in of_slot])
    parts = found.float().split([len(of_slot) for of_slot in drawn])
    return {
        f"prompt_{slot}": learner.loss.against_prompts(images, part, classes[:, column])
        for column, (slot, part) in enumerate(zip(CLASSES, parts, strict=True))
    }


def _batches(
    data: ContactDataset, seed: int, stage: Stage, workers: Workers
) -> Iterator[tuple[Batch, Tensor]]:
    sampler = Sampler(data, RENDERED, seed=seed)
    size = workers.share(stage.schedule.batch_size)
    for step in range(stage.step, stage.schedule.steps):
        batch = sampler.numbered(size, workers.part(step))
        yield batch, rendered(data, batch)
