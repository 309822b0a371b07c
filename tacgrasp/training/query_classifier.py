"""Train the classifier of questions: the words of a question to the query that it means.

It learns from wordings that the grammar of questions draws, as the language model does. Some of
their words are hidden, and unrelated ones stand between or around them, so that the meaning is
taken from whatever is known.

Not here: its use beside the language model (``tacgrasp.lessons.understanding``), the network
(``cltp.texts.text_classifier``).
"""

from __future__ import annotations

import hashlib
import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from rich.console import Console
from torch import Tensor
from torch.nn import functional

from cltp.atomic_write import write_atomically
from cltp.checkpoints.stored_classifier import save_classifier
from cltp.data.prefetch import prefetched
from cltp.texts.text_classifier import ClassifierConfig, TextClassifier, WordBatch
from cltp.train.progress import Bar
from cltp.train.recipes import Schedule
from cltp.train.stage import Stage, TrainingRun
from tacgrasp.base.worker_pool import worker_pool
from tacgrasp.console import count_progress
from tacgrasp.lessons.dialogue.whole_wordings import whole_wordings
from tacgrasp.lessons.query_classifier import class_of
from tacgrasp.lessons.question_draws import WHOLE, composed_exchange, whole_exchange
from tacgrasp.lessons.slips import FIXED

BATCH, RATE, DECAY = 192, 1e-3, 0.01
"""Questions of a step, learning rate at its peak, weight decay. Our choice."""

POOL = 16
"""Steps whose questions are drawn together and sorted by their length, so that little is padded:
a step takes a quarter of the time (measured on one core)."""

LEAST_DRAWN = 3
"""Times that a query must have been drawn to be a class: what is rarer is left to the model."""

HIDDEN = 0.12
"""Fraction of words that are hidden. Our choice."""

STRANGE, AROUND = 0.25, 0.25
"""Fraction of questions with unrelated words between theirs, and of those with the begin of another
question before or after them. Our choice."""

SMOOTHING = 0.03
"""Probability that is spread over all classes in the loss."""

BLOCK = 5_000

HELD_OUT = 4_000


@dataclass(frozen=True, slots=True, kw_only=True)
class QueryClassifierRequest:
    """What is trained.

    Attributes:
        out: Folder of the classifier.
        questions: Wordings that are drawn.
        steps: Optimiser steps.
        seed: Seed of wordings, weights and order.
    """

    out: Path
    questions: int = 800_000
    steps: int = 6000
    seed: int = 0


def train(request: QueryClassifierRequest, console: Console) -> float:
    """Draw wordings, train on them, write the classifier; the fraction right of some held out.

    Raises:
        TouchError: A checkpoint is of another training.
        OSError: A file can't be written.
    """
    drawn = _drawn(request, console)
    counts = Counter(name for _, name in drawn)
    frequent = {name for name, times in counts.items() if times >= LEAST_DRAWN}
    whole = {class_of(query) for each in whole_wordings() for _, query in each.variants()}
    classes = tuple(sorted(frequent | whole))
    numbers = {name: number for number, name in enumerate(classes)}
    known = [(text.split(), numbers[name]) for text, name in drawn if name in numbers]
    held_out = known[:HELD_OUT]
    texts = {tuple(words) for words, _ in held_out}
    learned = [one for one in known[HELD_OUT:] if tuple(one[0]) not in texts]
    torch.manual_seed(request.seed)
    model = TextClassifier(ClassifierConfig(classes=classes))
    with Bar() as report:
        run = TrainingRun(data=request.out, out=request.out, seed=request.seed, report=report)
        schedule = Schedule(
            steps=request.steps, batch_size=BATCH, learning_rate=RATE, weight_decay=DECAY
        )
        identity = {
            "questions": request.questions,
            "drawn": _digest(f"{text}\t{name}" for text, name in drawn),
            "learned": len(learned),
            "classes": classes,
        }
        stage = Stage("queries", run, model, schedule, identity)
        steps = range(stage.step, request.steps)
        noise = _Noise(learned, numbers)
        batches = prefetched(_batches(model, noise, request.seed, steps))

        def losses(_: int) -> Mapping[str, Tensor]:
            batch, meant = next(batches)
            logits = model(batch)
            loss = functional.cross_entropy(logits, meant, label_smoothing=SMOOTHING)
            right = (logits.detach().argmax(1) == meant).float().mean()
            return {"query": loss, "right": right}

        stage.train(losses)
    model.eval()
    save_classifier(request.out, model)
    return _right(model, held_out)


def _drawn(request: QueryClassifierRequest, console: Console) -> list[tuple[str, str]]:
    """Plain words and class of wordings; those of an earlier start are taken."""
    block = _digest(draw_block((request.seed, 0)))  # tells one grammar from another
    name = f"questions-{request.questions}-{request.seed}-{block}.tsv"
    path = request.out / ".training" / name
    if not path.exists():
        blocks = [(request.seed, block) for block in range(math.ceil(request.questions / BLOCK))]
        with worker_pool() as pool, count_progress(console) as progress:
            results = progress.track(
                pool.map(draw_block, blocks), len(blocks), description="wordings"
            )
            lines = [line for some in results for line in some][: request.questions]
        path.parent.mkdir(parents=True, exist_ok=True)
        write_atomically(path, "\n".join(lines) + "\n")
    rows = path.read_text(encoding="utf-8").splitlines()
    return [(text, name) for text, _, name in (row.partition("\t") for row in rows)]


def _digest(lines: Iterable[str]) -> str:
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()[:12]


def draw_block(place: tuple[int, int]) -> list[str]:
    """Lines of wordings, a tab and their classes, by seed and number of the block."""
    rng = np.random.default_rng([*place, 58])
    drawn = [composed_exchange(rng) for _ in range(BLOCK)]
    return [f"{one.prompt}\t{class_of(one.reply)}" for one in drawn]


class _Noise:
    """Questions to learn from, and what disturbs them: unrelated words, parts of other questions.

    Args:
        known: Words and class of questions that patterns compose.
        numbers: Number of each class.
    """

    def __init__(self, known: Sequence[tuple[list[str], int]], numbers: Mapping[str, int]) -> None:
        self.known = known
        self._numbers = numbers
        self._strange = sorted({word for text, _ in known for word in text} - FIXED)

    def drawn(self, rng: np.random.Generator) -> tuple[list[str], int]:
        """Words and class of a question: of a composed one, or of one that was written whole."""
        if rng.random() >= WHOLE:
            return self.known[int(rng.integers(len(self.known)))]
        whole = whole_exchange(rng)
        return whole.prompt.split(), self._numbers[class_of(whole.reply)]

    def around(self, words: list[str], rng: np.random.Generator) -> list[str]:
        """A question with what may stand between and around its words."""
        chance = rng.random()
        if chance < STRANGE:
            words = list(words)
            for _ in range(int(rng.integers(1, 4))):
                at = int(rng.integers(len(words) + 1))
                if at == 0 or words[at - 1] not in FIXED:
                    words.insert(at, self._strange[int(rng.integers(len(self._strange)))])
        elif chance < STRANGE + AROUND:
            other, _ = self.known[int(rng.integers(len(self.known)))]
            begin = [word for word in other[: int(rng.integers(1, 4))] if word not in FIXED]
            words = begin + words if rng.random() < 0.5 else words + begin
        return words


def _batches(
    model: TextClassifier, noise: _Noise, seed: int, steps: range
) -> Iterator[tuple[WordBatch, Tensor]]:
    """Batches of these steps; ``POOL`` steps share questions, each has those of one length."""
    number, pool = -1, []
    for step in steps:
        if step // POOL != number:
            number = step // POOL
            pool = _pool(noise, np.random.default_rng([seed, number, 59]), model.config.longest)
        texts, meant = zip(*pool[step % POOL], strict=True)
        seen = [word in FIXED for words in texts for word in words]
        rng = np.random.default_rng([seed, step, 60])
        hidden = torch.from_numpy(rng.random(len(seen)) < HIDDEN) & ~torch.tensor(seen)
        yield model.batch(texts, hidden), torch.tensor(meant)


def _pool(
    noise: _Noise, rng: np.random.Generator, longest: int
) -> list[list[tuple[list[str], int]]]:
    """Questions of ``POOL`` steps, disturbed: batches of like lengths, in any order."""
    chosen = (noise.drawn(rng) for _ in range(POOL * BATCH))
    drawn = [(noise.around(words, rng)[:longest], number) for words, number in chosen]
    drawn.sort(key=lambda each: len(each[0]))
    return [drawn[int(at) * BATCH :][:BATCH] for at in rng.permutation(POOL)]


def _right(model: TextClassifier, known: Sequence[tuple[list[str], int]]) -> float:
    with torch.inference_mode():
        right = [
            (
                model(model.batch([words for words, _ in some])).argmax(1)
                == torch.tensor([n for _, n in some])
            )
            for some in (known[at : at + 200] for at in range(0, len(known), 200))
        ]
    return float(torch.cat(right).float().mean()) if right else 0.0
