"""Stages 'text', 'projector', 'joint' and 'words' of Tac3D-LLM (paper, section 5.3, after LLaVA).

text: the language model learns how contacts are described and which advice follows, behind readings
    alone that are drawn around the truth; and, without any touch, what a question asks for.
projector: encoder and language model are frozen; the MLP between them learns by captioning, which
    is all that the paper does.
joint: projector and language model learn captions, advice and questions together; the encoder
    stays as CLTP left it. Some readings are left out or wrong (``cltp.llm.unsure_readings``), so
    that the touch tokens are listened to.
words: the same with many contacts and one text about each: words come from the touch tokens, which
    are as many as there are contacts.

The texts about a contact come from ``Lessons``; this package knows no targets and no actions. Words
are learned from the truth, numbers from the readings of the encoder's heads. Written digit by
digit, the most probable digits of the true number are not its most probable value: where 0.97 and
1.03 are equally probable, the first digit is arbitrary and the next ones follow it. A reading can
be copied instead.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import takewhile
from pathlib import Path
from typing import NamedTuple, Protocol

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
from cltp.data.prefetch import prefetched
from cltp.data.sampler import Augmentation, Batch, Sampler
from cltp.encoder.encoder import Encoded
from cltp.encoder.readings import HeadReadings, readings_of
from cltp.llm.causal_lm import Language, small_lm
from cltp.llm.reading_tokens import NUM_READINGS
from cltp.llm.tac3d_llm import Projector, Tac3dLlm
from cltp.llm.unsure_readings import ShownReadings, drawn_readings, shown, told_numbers
from cltp.tactile.force_scale import UNCALIBRATED_SPREAD
from cltp.tactile.states import CLASSES, ContactState
from cltp.texts.exchange_packing import Exchange, ExchangeTokens, Packed, pack
from cltp.texts.tokenizer import Words
from cltp.texts.told import ToldContact
from cltp.train.recipes import Schedule
from cltp.train.stage import Stage, TrainingRun

STAGES = {
    "text": Schedule(steps=1200, batch_size=16, learning_rate=2e-3),
    "projector": Schedule(steps=200, batch_size=32, learning_rate=2e-3),
    "joint": Schedule(steps=700, batch_size=16, learning_rate=1e-3),
    "words": Schedule(steps=200, batch_size=48, learning_rate=8e-4),
}

FINE_TUNING = {"joint": Schedule(steps=1200, batch_size=16, learning_rate=6e-4)}
"""The stages of a training that starts from other weights."""

OWN_STEPS = 300
"""Steps of such a training on few contacts of one's own, mixed with ours."""

UNIT_FACTORS = (0.5, 2.0)
"""Range of the factors from nominal newtons to newtons, log-uniform. Our choice: wider than units
differ, so that the language model takes newtons from the readings, which a calibration scales."""

UNCALIBRATED = 0.15
"""Fraction of contacts of units without a force calibration, whose forces have wide intervals."""

IN_DOUBT = 0.2
"""Fraction of contacts with words in doubt: each word in a third of them."""

BEFORE_TOUCH = ("text", "encoder")
"""The stage that goes on behind another encoder: it does not use any."""

QUESTIONS = {"text": 256, "joint": 128, "words": 64}
"""Questions in each step of a stage, besides its contacts."""

OWN_QUESTIONS = {"joint": 32}
"""The same where one's own contacts are learned: questions are about none, and are known already;
so few keep them."""

QUESTION_ROW = 8
"""Questions in one sequence: more would leave more of its attention unused."""

QUESTIONS_PER_CONTACT = 6
"""Questions beside each contact from which the tokenizer learns."""

ACTION_WEIGHT = 4.0
"""Weight of the one token that moves the robot, beside about sixty that describe."""


class Lessons(Protocol):
    """The exchanges that a language model learns."""

    def captions(self, felt: ToldContact, rng: np.random.Generator) -> Sequence[Exchange]:
        """Descriptions of a contact, in one or more wordings."""
        ...

    def mixed(self, felt: ToldContact, rng: np.random.Generator) -> Sequence[Exchange]:
        """Captions and advice on a contact; ``rng`` draws wordings."""
        ...

    def questions(self, num: int, rng: np.random.Generator) -> Sequence[Exchange]:
        """Questions about no contact, with what they ask for; none where ``num`` is too few."""
        ...


def train_words(
    data_dir: Path,
    lessons: Lessons,
    *,
    size: int = 10_240,
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
        felt = ToldContact(state=data.state(int(index)))
        about = (*lessons.mixed(felt, rng), *lessons.captions(felt, rng))
        for exchange in (*about, *lessons.questions(QUESTIONS_PER_CONTACT, rng)):
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
    language: Path | None = None,
    questions: Mapping[str, int] = QUESTIONS,
) -> Path:
    """Train, or continue training, and write ``projector`` and ``lm`` into ``run.out``.

    Args:
        run: Data, folder with ``encoder`` in it, seed and progress.
        words: The tokenizer.
        lessons: The exchanges about contacts.
        schedules: How long and how fast each stage learns; ``STAGES``, or ``FINE_TUNING`` with a
            start, when not given; without ``text`` where there is a ``language``.
        dim: Hidden width of the language model.
        layers: Number of its layers.
        augmentation: How contacts are varied.
        start: Folder of weights whose projector and language model are trained on; random ones
            when not given.
        language: Folder of weights whose language model is trained on behind a random projector.
        questions: Questions in each step of a stage, besides its contacts.

    Raises:
        TouchError: Data, encoder, start, language or a checkpoint can't be used.
    """
    data = run.dataset()
    encoder, heads = load_encoder(run.out / "encoder")
    torch.manual_seed(run.seed)
    if (folder := start or language) is None:
        lm = Language(small_lm(words, dim=dim, layers=layers), words=words)
    else:
        begun = load_tac3d_llm(folder, lm_folder=folder / "lm")
        lm = begun.language
    projector = Projector(encoder.config.dim, lm.dim) if start is None else begun.projector
    model = Tac3dLlm(encoder, heads, projector, lm).to(run.workers.device)
    learner = ExchangeLearner(run, model, words, data, lessons, augmentation, questions)
    identity = {
        "data": data.checksum(),
        # Tells encoders apart; a stage must not continue behind another one.
        "encoder": float(sum(p.detach().double().abs().sum() for p in encoder.parameters())),
        "words": words.fingerprint(),
        "lm": f"{dim} {layers} {augmentation and augmentation.identity}",
    }
    if start is not None:
        identity["start"] = manifest_digest(start / "projector")
    if language is not None:
        identity["language"] = manifest_digest(language / "lm")
    if questions != QUESTIONS:
        identity["questions"] = str(sorted(questions.items()))
    learned = nn.ModuleList([model.projector, model.lm])  # in every stage: checkpoints then chain
    if schedules is None:
        schedules = STAGES if start is None else FINE_TUNING
        if language is not None:
            schedules = {name: s for name, s in schedules.items() if name != "text"}
    schedules = {name: schedules[name] for name in STAGES if name in schedules}
    for number, name in enumerate(STAGES, start=1):
        if name not in schedules:
            continue
        made_of = {key: value for key, value in identity.items() if (name, key) != BEFORE_TOUCH}
        made_of |= earlier(schedules, name)
        model.requires_grad_(False)
        model.projector.requires_grad_(name != "text")
        model.lm.requires_grad_(name != "projector")
        learner.train(Stage(name, run, learned, schedules[name], made_of), number)
    if run.workers.is_first:
        save_tac3d_llm(run.out, model.cpu().eval())
    run.workers.wait()
    return run.out


def earlier(schedules: Mapping[str, Schedule], name: str) -> dict[str, str]:
    """What a stage goes on from, for its identity: the stages before it, with their schedules.

    Args:
        schedules: The stages of a training in their order.
        name: The stage.
    """
    before = takewhile(lambda each: each != name, schedules)
    text = "; ".join(f"{each}: {schedules[each]}" for each in before)
    return {"before": text} if text else {}


class _Sample(NamedTuple):
    """A batch with all that is computed of it before the language model's turn."""

    encoded: Encoded | None
    shown: ShownReadings
    packed: Packed
    questions: Packed | None


@dataclass(frozen=True, slots=True)
class ExchangeLearner:
    """Teaches a model the exchanges about contacts, a stage at a time.

    Attributes:
        run: Seed, progress and processes.
        model: The model; what of it is learned is the stage's.
        words: Its tokenizer.
        data: The contacts.
        lessons: The exchanges about them.
        augmentation: How they are varied.
        questions: Questions in each step of a stage, besides its contacts.
    """

    run: TrainingRun
    model: Tac3dLlm
    words: ExchangeTokens
    data: ContactDataset
    lessons: Lessons
    augmentation: Augmentation | None
    questions: Mapping[str, int]

    def train(self, stage: Stage, number: int) -> None:
        """Do the remaining steps of a stage, the ``number``-th of a training."""
        samples = prefetched(self._samples(stage, number))
        model, device = self.model, self.run.workers.device

        def losses(step: int) -> dict[str, Tensor]:
            encoded, shown, packed, questions = next(samples)
            packed = Packed(*(part.to(device) for part in packed))
            readings, given = shown.readings.to(device), shown.given.to(device)
            with self.run.workers.autocast():
                if encoded is None:
                    touch = model.projector.readings(readings, given)
                else:
                    touch = model.projected(encoded, readings, given)
                terms = model.loss(touch, packed)
                if questions is not None:
                    asked = Packed(*(part.to(device) for part in questions))
                    terms["questions"] = model.loss(None, asked)["language"]
                return terms

        stage.train(losses)

    def _samples(self, stage: Stage, number: int) -> Iterator[_Sample]:
        seed = 1000 * self.run.seed + number
        sampler = Sampler(
            self.data,
            self.augmentation,
            seed=seed,
            layout=self.model.layout,
            also_fraction=self.run.also_fraction,
        )
        size = self.run.workers.per_process(stage.schedule.batch_size)
        for step in map(self.run.workers.part, range(stage.step, stage.schedule.steps)):
            rng = np.random.default_rng([self.run.seed, number, step])
            factors, spreads = _units(size, rng)
            if stage.name == "text":
                chosen = rng.integers(len(self.data), size=size)
                states = _in_newtons([self.data.state(int(i)) for i in chosen], factors)
                encoded, readings = None, drawn_readings(states, rng)
                told, num_touch = ShownReadings(readings, *_all_given(size)), NUM_READINGS
            else:
                batch = sampler.numbered(size, step)
                states, num_touch = _in_newtons(batch.states, factors), self.model.num_touch
                encoded, readings = self._felt(batch, factors, spreads)
                told = shown(readings, rng)
            felt = [_felt(states[row], readings, row, rng) for row in told.meant.tolist()]
            exchanges = [self._exchanges(stage.name, each, rng) for each in felt]
            packed = pack(self.words, exchanges, num_touch, action_weight=ACTION_WEIGHT)
            yield _Sample(encoded, told, packed, self._questions(stage.name, rng))

    def _exchanges(
        self, stage: str, felt: ToldContact, rng: np.random.Generator
    ) -> Sequence[Exchange]:
        if stage == "projector" or (stage == "words" and rng.random() < 0.5):
            return self.lessons.captions(felt, rng)
        exchanges = self.lessons.mixed(felt, rng)
        return exchanges[-1:] if stage == "words" else exchanges

    def _questions(self, stage: str, rng: np.random.Generator) -> Packed | None:
        asked = self.lessons.questions(self.questions.get(stage, 0), rng)
        rows = [asked[at : at + QUESTION_ROW] for at in range(0, len(asked), QUESTION_ROW)]
        return pack(self.words, rows, 0) if rows else None

    @torch.no_grad()
    def _felt(self, batch: Batch, factors: Tensor, spreads: Tensor) -> tuple[Encoded, HeadReadings]:
        """Encoding and readings of a batch; the readings on the CPU."""
        points = torch.from_numpy(batch.points).to(self.run.workers.device)
        with self.run.workers.autocast():
            encoded = self.model.encoder(points)
        encoded = Encoded(*(part.float() for part in encoded))
        output = self.model.heads.read(encoded.pooled, points)
        device = encoded.pooled.device
        readings = readings_of(output, factors.to(device), spreads.to(device))
        return encoded, readings.to(torch.device("cpu"))


def _all_given(size: int) -> tuple[Tensor, Tensor]:
    return torch.ones(size, NUM_READINGS, dtype=torch.bool), torch.arange(size)


def _units(size: int, rng: np.random.Generator) -> tuple[Tensor, Tensor]:
    """Newtons per nominal newton of each sample's unit, of half of them 1, and its spread: (B,)."""
    low, high = (math.log(limit) for limit in UNIT_FACTORS)
    factors = np.exp(rng.uniform(low, high, size)) ** (rng.random(size) < 0.5)
    spreads = UNCALIBRATED_SPREAD * (rng.random(size) < UNCALIBRATED)
    return torch.from_numpy(factors.astype(np.float32)), torch.from_numpy(
        spreads.astype(np.float32)
    )


def _in_newtons(states: Sequence[ContactState], factors: Tensor) -> list[ContactState]:
    return [
        replace(state, force_n=state.force_n * factor)
        for state, factor in zip(states, factors.tolist(), strict=True)
    ]


def _felt(
    state: ContactState, readings: HeadReadings, row: int, rng: np.random.Generator
) -> ToldContact:
    """What is to be told of a contact: its words, the numbers that are read, drawn doubts."""
    if not state.in_contact:
        return ToldContact(state=state)
    numbers, ends = told_numbers(readings, row)
    rivals = {}
    if rng.random() < IN_DOUBT:
        for chances, (name, classes) in zip(readings.words, CLASSES.items(), strict=True):
            others = [word for word in classes if word != getattr(state, name)]
            if getattr(state, name) is None or rng.random() > 1 / 3:
                continue
            likely = max(others, key=lambda w: float(chances[row, classes.index(w)]))
            is_near = rng.random() < 0.7
            rivals[name] = likely if is_near else others[int(rng.integers(len(others)))]
    read = replace(state, **numbers)  # type: ignore[arg-type]  # names of numbers alone
    return ToldContact(state=read, ends=ends, rivals=rivals)
