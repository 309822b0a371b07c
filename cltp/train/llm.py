"""Stages 'text', 'projector' and 'joint' of Tac3D-LLM (paper, section 5.3, after LLaVA).

text: the language model alone learns how contacts are described and which advice they get.
projector: encoder and language model are frozen; the MLP between them learns by captioning, which
    is all that the paper does.
joint: projector and language model learn captions, questions and advice together; the encoder
    stays as CLTP left it.

The texts about a contact come from ``Lessons``; this package knows no goals and no actions. Words
and advice are learned from the truth, numbers from the readings of the encoder's heads. Written
digit by digit, the most probable digits of the true number are not its most probable value: where
0.97 and 1.03 are equally probable, the first digit is arbitrary and the next ones follow it. A
reading can be copied instead.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol

import numpy as np
import torch
from torch import Tensor, nn

from cltp.checkpoints.manifest import manifest_digest
from cltp.checkpoints.tac3d_llm import (
    load_encoder,
    load_tac3d_llm,
    save_tac3d_llm,
)
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import Augmentation, Sampler
from cltp.encoder.encoder import Encoded
from cltp.encoder.heads import scaled_force, with_read_numbers
from cltp.llm.causal_lm import Language, small_lm
from cltp.llm.tac3d_llm import Projector, Tac3dLlm
from cltp.tactile.states import ContactState
from cltp.texts.exchange_packing import Exchange, Packed, pack
from cltp.texts.tokenizer import Words
from cltp.train.prefetch import prefetched
from cltp.train.recipes import Schedule
from cltp.train.stage import Stage, TrainingRun

STAGES = {
    "text": Schedule(steps=300, batch_size=24, learning_rate=2e-3),
    "projector": Schedule(steps=200, batch_size=32, learning_rate=2e-3),
    "joint": Schedule(steps=1800, batch_size=16, learning_rate=1e-3),
}

FINE_TUNING = {"joint": Schedule(steps=1200, batch_size=16, learning_rate=6e-4)}
"""The stages of a training that starts from other weights."""

UNIT_FACTORS = (0.5, 2.0)
"""Range of the factors from nominal newtons to newtons, log-uniform. Our choice: wider than units
differ, so that the language model takes newtons from the readings, which a calibration scales."""

ACTION_WEIGHT = 4.0
"""Weight of the one token that moves the robot, beside about sixty that describe."""


class Lessons(Protocol):
    """The exchanges that a language model learns about a contact."""

    def captions(self, reading: ContactState, rng: np.random.Generator) -> Sequence[Exchange]:
        """Descriptions of a contact, in one or more wordings; ``reading`` as in ``mixed``."""
        ...

    def mixed(
        self, state: ContactState, reading: ContactState, rng: np.random.Generator
    ) -> Sequence[Exchange]:
        """Captions, questions and advice on a contact.

        Args:
            state: The truth, from which advice comes.
            reading: The same words with the numbers as the encoder's heads read them.
            rng: Draws wordings.
        """
        ...


def train_words(
    data_dir: Path,
    lessons: Lessons,
    *,
    size: int = 1024,
    num_contacts: int = 4000,
    seed: int = 0,
    texts: Sequence[str] = (),
    whole: Sequence[str] = (),
) -> Words:
    """Learn the tokenizer from the exchanges about contacts of a data set.

    Args:
        data_dir: The data set.
        lessons: The exchanges about its contacts.
        size: Largest number of tokens. Each costs 2 bytes for each channel of every model that
            embeds it; the language model's two tables are one.
        num_contacts: Number of contacts that are talked about.
        seed: Draws contacts and wordings.
        texts: Further texts, such as a person may write.
        whole: Words that become one token each, however rare: such as a person may write alone.

    Raises:
        TouchError: The data set can't be read, or ``size`` is too small for ``whole``.
    """
    data = ContactDataset(data_dir, split=Split.TRAIN)
    rng = np.random.default_rng([seed, 77])
    learned = list(texts)
    for index in rng.integers(len(data), size=num_contacts):
        state = data.state(int(index))
        for exchange in (*lessons.mixed(state, state, rng), *lessons.captions(state, rng)):
            learned += [exchange.prompt, exchange.reply]
    return Words.train(learned, size, whole)


def train_llm(
    run: TrainingRun,
    words: Words,
    lessons: Lessons,
    schedules: Mapping[str, Schedule] | None = None,
    *,
    dim: int = 192,
    layers: int = 4,
    augmentation: Augmentation | None = None,
    start: Path | None = None,
) -> Path:
    """Train, or continue training, and write ``projector`` and ``lm`` into ``run.out``.

    Args:
        run: Data, folder with ``encoder`` in it, seed and progress.
        words: The tokenizer.
        lessons: The exchanges about contacts.
        schedules: How long and how fast each stage learns; ``STAGES``, or ``FINE_TUNING`` with a
            start, when not given.
        dim: Hidden width of the language model.
        layers: Number of its layers.
        augmentation: How contacts are varied.
        start: Folder of weights whose projector and language model are trained on; random ones
            when not given.

    Raises:
        TouchError: Data, encoder, start or a checkpoint can't be used.
    """
    data = run.dataset()
    encoder, heads = load_encoder(run.out / "encoder")
    torch.manual_seed(run.seed)
    if start is None:
        language = Language(small_lm(words, dim=dim, layers=layers), words=words)
        projector = Projector(encoder.config.dim, language.dim)
    else:
        begun = load_tac3d_llm(start, lm_folder=start / "lm")
        language, projector = begun.language, begun.projector
    model = Tac3dLlm(encoder, heads, projector, language).to(run.workers.device)
    learner = _Learner(run, model, words, data, lessons, augmentation)
    identity = {
        "data": data.checksum(),
        # Tells encoders apart; a stage must not continue behind another one.
        "encoder": float(sum(p.detach().double().abs().sum() for p in encoder.parameters())),
        "words": words.fingerprint(),
        "lm": f"{dim} {layers} {augmentation}",
    }
    if start is not None:
        identity["start"] = manifest_digest(start / "projector")
    learned = nn.ModuleList([model.projector, model.lm])  # in every stage: checkpoints then chain
    schedules = schedules or (STAGES if start is None else FINE_TUNING)
    for number, name in enumerate(STAGES, start=1):
        if name not in schedules:
            continue
        model.requires_grad_(False)
        model.projector.requires_grad_(name in ("projector", "joint"))
        model.lm.requires_grad_(name in ("text", "joint"))
        learner.train(Stage(name, run, learned, schedules[name], identity), number)
    save_tac3d_llm(run.out, model.cpu().eval())
    return run.out


@dataclass(frozen=True, slots=True)
class _Learner:
    run: TrainingRun
    model: Tac3dLlm
    words: Words
    data: ContactDataset
    lessons: Lessons
    augmentation: Augmentation | None

    def train(self, stage: Stage, number: int) -> None:
        batches = prefetched(self._batches(stage, number))

        def losses(step: int) -> dict[str, Tensor]:
            encoded, factors, packed = next(batches)
            packed = Packed(*(part.to(self.run.workers.device) for part in packed))
            touch = None
            if encoded is not None and factors is not None:
                touch = self.model.projected(encoded, factors.to(self.run.workers.device))
            return self.model.loss(touch, packed)

        stage.train(losses)

    def _batches(
        self, stage: Stage, number: int
    ) -> Iterator[tuple[Encoded | None, Tensor | None, Packed]]:
        seed = 1000 * self.run.seed + number
        sampler = Sampler(self.data, self.augmentation, seed=seed, layout=self.model.layout)
        size = stage.schedule.batch_size
        for step in range(stage.step, stage.schedule.steps):
            rng = np.random.default_rng([self.run.seed, number, step])
            if stage.name == "text":
                states = [self.data.state(int(i)) for i in rng.integers(len(self.data), size=size)]
                encoded, readings, num_touch = None, states, 0
                factors = None
            else:
                batch = sampler.numbered(size, step)
                states, num_touch = batch.states, self.model.num_touch
                with torch.no_grad():
                    points = torch.from_numpy(batch.points).to(self.run.workers.device)
                    encoded = self.model.encoder(points)
                    numbers = self.model.heads(encoded.pooled).numbers
                factors = _unit_factors(size, rng)
                states = [
                    replace(state, force_n=state.force_n * factor)
                    for state, factor in zip(states, factors.tolist(), strict=True)
                ]
                readings = with_read_numbers(states, scaled_force(numbers.cpu(), factors))
            exchanges = [
                self.lessons.captions(reading, rng)
                if stage.name == "projector"
                else self.lessons.mixed(state, reading, rng)
                for state, reading in zip(states, readings, strict=True)
            ]
            packed = pack(self.words, exchanges, num_touch, action_weight=ACTION_WEIGHT)
            yield encoded, factors, packed


def _unit_factors(size: int, rng: np.random.Generator) -> Tensor:
    """Newtons per nominal newton of each sample's unit, shape (size,); of half of them 1."""
    low, high = (math.log(limit) for limit in UNIT_FACTORS)
    drawn = np.exp(rng.uniform(low, high, size)) ** (rng.random(size) < 0.5)
    return torch.from_numpy(drawn.astype(np.float32))
