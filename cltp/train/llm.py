"""Stages 'text', 'projector' and 'joint' of Tac3D-LLM (paper, section 5.3, after LLaVA).

text: the language model alone learns how contacts are described and what is advised on them.
projector: encoder and language model are frozen; the MLP between learns by captioning, which is
    all that the paper does.
joint: projector and language model learn captions, questions and advice together; the encoder
    stays as CLTP left it.

What is said about a contact comes from ``Lessons``; this package knows no goals and no actions.
Words and advice are learned from the truth. Numbers are learned as the encoder's heads read them:
spoken digit by digit, the likeliest digits of the truth are not its likeliest number (where 0.97
and 1.03 are as likely, the first digit is a coin's toss and the next ones follow it), while the
reading is there to be copied.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Protocol

import numpy as np
import torch
from torch import Tensor, nn

from cltp.checkpoints.tac3d_llm import load_touching_encoder, save_tac3d_llm
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import Augmentation, Sampler
from cltp.encoder.encoder import Encoded, TactileEncoder
from cltp.encoder.heads import felt
from cltp.llm.causal_lm import Language, small_lm
from cltp.llm.tac3d_llm import Projector, Tac3dLlm
from cltp.tactile.states import ContactState
from cltp.texts.exchange_packing import Exchange, Packed, pack
from cltp.texts.tokenizer import Words
from cltp.train.prefetch import ahead
from cltp.train.stage import ProgressReport, Schedule, Stage, device, silent

TEXT = Schedule(steps=300, batch_size=24, learning_rate=2e-3)
PROJECTOR = Schedule(steps=200, batch_size=32, learning_rate=2e-3)
JOINT = Schedule(steps=1800, batch_size=16, learning_rate=1e-3)

ACTION_WEIGHT = 4.0
"""Of the one token that moves the robot, beside about sixty that describe."""


class Lessons(Protocol):
    """What can be asked and said about a contact."""

    def captions(self, felt: ContactState, rng: np.random.Generator) -> Sequence[Exchange]:
        """Descriptions of a contact, in one or more wordings; ``felt`` as in ``mixed``."""
        ...

    def mixed(
        self, state: ContactState, felt: ContactState, rng: np.random.Generator
    ) -> Sequence[Exchange]:
        """Captions, questions and advice on a contact.

        Args:
            state: The truth, from which advice comes.
            felt: The same words with the numbers that are to be said.
            rng: Draws wordings.
        """
        ...


def train_words(
    data_dir: Path, lessons: Lessons, *, size: int = 1024, num_contacts: int = 4000, seed: int = 0
) -> Words:
    """Learn the tokenizer from what is said about the contacts of a data set."""
    data = ContactDataset(data_dir, split=Split.TRAIN)
    rng = np.random.default_rng([seed, 77])
    texts: list[str] = []
    for index in rng.integers(len(data), size=num_contacts):
        state = data.state(int(index))
        for exchange in (*lessons.mixed(state, state, rng), *lessons.captions(state, rng)):
            texts += [exchange.prompt, exchange.reply]
    return Words.train(texts, size)


def train_llm(
    data_dir: Path,
    out_dir: Path,
    words: Words,
    lessons: Lessons,
    *,
    schedules: tuple[Schedule, Schedule, Schedule] = (TEXT, PROJECTOR, JOINT),
    dim: int = 192,
    layers: int = 4,
    augmentation: Augmentation | None = None,
    seed: int = 0,
    report: ProgressReport = silent,
) -> Path:
    """Train, or go on training, and write ``out_dir/projector`` and ``out_dir/lm``.

    Args:
        data_dir: A data set of contacts; its training split is used.
        out_dir: Folder of weights, with ``encoder`` in it.
        words: The tokenizer.
        lessons: What is said about contacts.
        schedules: Of the three stages.
        dim: Hidden width of the language model.
        layers: Its layers.
        augmentation: How contacts are varied.
        seed: Of weights, order, noise and wording.
        report: Told about progress.

    Raises:
        TouchError: Data, encoder or a checkpoint can't be used.
    """
    data = ContactDataset(data_dir, split=Split.TRAIN)
    encoder, heads = load_touching_encoder(out_dir / "encoder")
    torch.manual_seed(seed)
    lm = small_lm(words, dim=dim, layers=layers)
    language = Language(lm, words=words)
    projector = Projector(encoder.config.dim, language.dim)
    model = Tac3dLlm(encoder, heads, projector, language).to(device())
    learner = _Learner(model, data, lessons, augmentation, seed)
    identity = {
        "data": data.checksum(),
        "encoder": _fingerprint(encoder),
        "words": words.fingerprint(),
        "seed": seed,
        "lm": f"{dim} {layers} {augmentation}",
    }
    folder = out_dir / ".training"
    for name, schedule in zip(("text", "projector", "joint"), schedules, strict=True):
        learner.freeze(name)
        stage = Stage(name, folder, learner.learned(name), schedule, identity)
        learner.run(stage, name, report)
    save_tac3d_llm(out_dir, model.cpu().eval())
    return out_dir


def _fingerprint(encoder: TactileEncoder) -> float:
    """Tells encoders apart; a stage must not go on behind another one."""
    return float(sum(p.detach().double().abs().sum() for p in encoder.parameters()))


class _Learner:
    def __init__(
        self,
        model: Tac3dLlm,
        data: ContactDataset,
        lessons: Lessons,
        augmentation: Augmentation | None,
        seed: int,
    ) -> None:
        self.model, self.data, self.lessons, self.seed = model, data, lessons, seed
        self.augmentation = augmentation

    def freeze(self, stage: str) -> None:
        self.model.requires_grad_(False)
        if stage in ("projector", "joint"):
            self.model.projector.requires_grad_(True)
        if stage in ("text", "joint"):
            self.model.lm.requires_grad_(True)

    def learned(self, stage: str) -> nn.Module:
        """Projector and language model in every stage: checkpoints then chain."""
        del stage
        return nn.ModuleList([self.model.projector, self.model.lm])

    def run(self, stage: Stage, name: str, report: ProgressReport) -> None:
        self.model.train()
        batches = ahead(self._batches(name, stage))

        def losses(step: int) -> dict[str, Tensor]:
            encoded, packed = next(batches)
            packed = Packed(*(part.to(device()) for part in packed))
            touch = self.model.projected(encoded) if encoded is not None else None
            return self.model.loss(touch, packed)

        stage.run(losses, report)

    def _batches(self, name: str, stage: Stage) -> Iterator[tuple[Encoded | None, Packed]]:
        words = self.model.language.words
        if words is None:
            raise ValueError("a stock language model is not trained here")
        number = {"text": 1, "projector": 2, "joint": 3}[name]
        sampler = Sampler(self.data, self.augmentation, seed=1000 * self.seed + number)
        size, step = stage.schedule.batch_size, stage.step
        while True:
            rng = np.random.default_rng([self.seed, number, step])
            if name == "text":
                states = [self.data.state(int(i)) for i in rng.integers(len(self.data), size=size)]
                encoded, read, num_touch = None, states, 0
            else:
                batch = sampler.numbered(size, step)
                states, num_touch = batch.states, self.model.num_touch
                with torch.no_grad():
                    encoded = self.model.encoder(torch.from_numpy(batch.points).to(device()))
                    read = felt(states, self.model.heads(encoded.pooled).numbers)
            groups = [
                self.lessons.captions(said, rng)
                if name == "projector"
                else self.lessons.mixed(state, said, rng)
                for state, said in zip(states, read, strict=True)
            ]
            yield encoded, pack(words, groups, num_touch, action_weight=ACTION_WEIGHT)
            step += 1
