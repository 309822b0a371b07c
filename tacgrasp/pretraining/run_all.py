"""What ``tacgrasp train`` does for methods: one of them, their probes, or everything in pieces.

All of it can be stopped at any time and started again by the same command: stages go on at their
checkpoints, encoded contacts are kept, and a result is written as soon as it is measured.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

import torch
from transformers.utils.logging import disable_progress_bar

from cltp.data.dataset import ContactDataset
from cltp.train.distributed import joined
from cltp.train.progress import Bar
from cltp.train.stage import ProgressReport
from cltp.train.tensorboard import Board
from tacgrasp.pretraining.evaluate import probe, retrieval, zero_shot
from tacgrasp.pretraining.evaluation_run import EvaluationRun
from tacgrasp.pretraining.methods import METHODS, Wish, pretrain, pretrain_clip
from tacgrasp.pretraining.report.report import report


@dataclass(frozen=True, slots=True, kw_only=True)
class Order:
    """What was asked for on the command line; see ``tacgrasp.cli.train.Pretrain``."""

    out: Path
    data: Path
    results: Path
    preset: str | None = None
    steps: int | None = None
    batch_size: int | None = None
    clip_steps: int | None = None
    with_images: bool = True
    also: Path | None = None
    texts: str = "mixed"
    prompt_weight: float = 1.0
    head_weight: float = 1.0
    read_weight: float = 1.0
    moved: float = 0.0
    precision: str = "no"
    seed: int = 0
    seeds: int = 1
    threads: int | None = None
    tensorboard: bool = False
    command: str = "tacgrasp train"

    def wish(self, steps: int | None, batch_size: int | None) -> Wish:
        """A pre-training of so many steps."""
        return Wish(
            preset=self.preset,
            steps=steps,
            batch_size=batch_size,
            texts=self.texts,
            prompt_weight=self.prompt_weight,
            head_weight=self.head_weight,
            read_weight=self.read_weight,
            moved=self.moved,
            with_images=self.with_images,
            also=self.also,
        )


def carry_out(stage: str, order: Order) -> None:
    """Do one stage.

    Args:
        stage: ``clip``, a method with dashes, ``probe``, or ``all-methods``.
        order: What was asked for.

    Raises:
        UsageError: An unknown preset, or what is needed first was not trained.
        TouchError: Data, weights or a checkpoint can't be used.
    """
    disable_progress_bar()  # of reading and writing weights, over in milliseconds
    for data in (order.data, order.also):
        if data is not None:
            ContactDataset(data)  # complains before anything else is done
    torch.set_num_threads(order.threads or os.cpu_count() or 1)
    method = stage.replace("-", "_")
    with ExitStack() as open_ones:
        if order.tensorboard and stage != "probe":
            board = open_ones.enter_context(Board(order.out / "tensorboard"))
        else:
            board = None
        bar = open_ones.enter_context(Bar())
        shown = bar if board is None else _both(bar, board)
        if stage in ("clip", "all-methods"):
            _clip(order, shown)
        if stage == "all-methods":
            for each in METHODS:
                _train(each, order, shown)
            _measure(order, bar)
        elif stage == "probe":
            for number in range(order.seeds):
                probe(_place(order, bar, number))
        elif stage != "clip":
            _train("cltp_no_image" if not order.with_images else method, order, shown)


def _both(one: ProgressReport, other: ProgressReport) -> ProgressReport:
    def told(stage: str, step: int, steps: int, scores: Mapping[str, float]) -> None:
        one(stage, step, steps, scores)
        other(stage, step, steps, scores)

    return told


def _clip(order: Order, bar: ProgressReport) -> None:
    workers = joined(order.precision)
    wish = order.wish(order.clip_steps, None)
    pretrain_clip(order.out, order.data, wish, seed=order.seed, report=bar, workers=workers)


def _train(method: str, order: Order, bar: ProgressReport) -> None:
    def named(stage: str, step: int, steps: int, scores: object) -> None:
        told = scores if isinstance(scores, dict) else {}
        bar(stage if stage.startswith(method) else f"{method} {stage}", step, steps, told)

    pretrain(
        method,
        order.out,
        order.data,
        order.wish(order.steps, order.batch_size),
        seed=order.seed,
        command=order.command,
        report=named,
        workers=joined(order.precision),
    )


def _place(order: Order, bar: ProgressReport, number: int = 0) -> EvaluationRun:
    return EvaluationRun(
        weights=order.out,
        data=order.data,
        results=order.results,
        seed=order.seed + number,
        command=order.command,
        report=bar,
    )


def _measure(order: Order, bar: ProgressReport) -> None:
    zero_shot(_place(order, bar))
    retrieval(_place(order, bar))
    probe(_place(order, bar))
    for number in range(1, order.seeds):
        probe(_place(order, bar, number), ("cltp",))
    report(order.results, order.results, weights=order.out)
