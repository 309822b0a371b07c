"""Make a row of the table of captions: an encoder, a language model behind it, its ratings.

    OUT/TOWERS-seedS/BEHIND/         the encoder of another row, trained where it is not there
    OUT/TOWERS-seedS/ROW/            weights: that encoder, frozen, with state heads where it had
                                     none, and a projector and a language model behind it

The three of the paper differ in the encoder alone (``tacgrasp.training.other_encoder``). Here the
language model learns captions and nothing else, in the stages and the number of steps of the one
that is shipped. The same command continues where it was stopped.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from cltp.evaluation.splits import LEARNING_NOISE
from cltp.texts.exchange_packing import Exchange
from cltp.texts.told import ToldContact
from cltp.train.llm import STAGES, train_llm, train_words
from cltp.train.recipes import HEADS_SCHEDULE
from tacgrasp.lessons.exchanges import caption_exchange
from tacgrasp.policy_factory import shipped_weights
from tacgrasp.pretraining.checkpoints import TrainedMethod
from tacgrasp.pretraining.make_row import RowRequest, row_of, trained_encoder
from tacgrasp.pretraining.report.row_file import save_row
from tacgrasp.pretraining.report.rows import SHIPPED
from tacgrasp.pretraining.report.store import Result
from tacgrasp.pretraining.work_clock import WorkClock
from tacgrasp.training.captions.evaluate import CONTACTS, CaptionRun, rate_captions
from tacgrasp.training.other_encoder import take_other_encoder

TEXTS = 4
"""Captions of each contact in a step, each asked for in other words: so many texts as the shipped
model learns about it."""


class CaptionLessons:
    """Captions alone, as ``cltp.train.llm.Lessons``."""

    def captions(self, felt: ToldContact, rng: np.random.Generator) -> Sequence[Exchange]:
        return [caption_exchange(felt, rng)]

    def mixed(self, felt: ToldContact, rng: np.random.Generator) -> Sequence[Exchange]:
        return [caption_exchange(felt, rng) for _ in range(TEXTS)]

    def questions(self, num: int, rng: np.random.Generator) -> Sequence[Exchange]:
        return ()


def make_caption_row(request: RowRequest) -> tuple[Path, list[Result]]:
    """Train, or take up what was trained; rate the captions; write the file.

    The row of the shipped weights has the ratings of trivial captions beside its own.

    Returns:
        Path of the file, and the results in it.

    Raises:
        UsageError: The file can't be written.
        TouchError: Data, a checkpoint, an encoder or weights can't be used.
    """
    recipe, clock = request.recipe, WorkClock(request.folder / "minutes.json")
    is_shipped = recipe.behind == SHIPPED
    if is_shipped:
        trained = TrainedMethod(folder=shipped_weights(), variant=recipe.variant, budget=None)
        minutes: dict[str, float | None] = {}
    else:
        trained, minutes = _learned(request, clock)
    with clock.part("measure"):
        rated = rate_captions(
            CaptionRun(
                weights=shipped_weights() if is_shipped else request.folder,
                data=request.data,
                results=request.folder / "results",
                contacts=min(CONTACTS, request.limit or CONTACTS),
                seed=request.seed,
                command=request.command,
            )
        )
    minutes |= {"measure": clock.minutes("measure")}
    row = row_of(request, trained, minutes, rated if is_shipped else rated[:1])
    path = save_row(request.results, row)
    clock.finish()
    return path, row.results()


def _learned(
    request: RowRequest, clock: WorkClock
) -> tuple[TrainedMethod, dict[str, float | None]]:
    """Train the encoder and the language model, each where it is not there; minutes of both."""
    encoder = replace(request, name=request.recipe.behind)
    encoder_clock = WorkClock(encoder.folder / "minutes.json")
    clip_clock = WorkClock(request.group / "clip-minutes.json")
    with request.training() as run:
        trained = trained_encoder(encoder, run, encoder_clock, clip_clock)
        learning = replace(run, out=request.folder, report=clock.watched(run.report))
        with clock.part("language"):
            take_other_encoder(trained.folder, learning, HEADS_SCHEDULE.steps)
            lessons = CaptionLessons()
            words = train_words(request.learned, lessons, seed=request.seed)
            train_llm(learning, words, lessons, STAGES, augmentation=LEARNING_NOISE, questions={})
    minutes = {"clip": clip_clock.minutes("clip")} if request.recipe.has_towers else {}
    minutes |= {"train": encoder_clock.minutes("train"), "language": clock.minutes("language")}
    return replace(trained, variant=f"our small one, {trained.variant}"), minutes
