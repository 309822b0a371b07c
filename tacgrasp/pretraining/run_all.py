"""The stages of ``tacgrasp train`` that pre-train: one method, its probes, or all methods.

Each can be stopped at any time and started again by the same command: stages continue at their
checkpoints, encoded contacts are stored, and a result is written as soon as it is measured.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path

import torch
from transformers.utils.logging import disable_progress_bar

from cltp.data.dataset import ContactDataset
from cltp.train.distributed import joined_workers
from cltp.train.methods import TRAINING_ORDER
from cltp.train.progress import Bar
from cltp.train.recipes import ClipRecipe, CltpRecipe, Schedule
from cltp.train.stage import ProgressReport
from cltp.train.tensorboard import TensorBoardReport
from tacgrasp.datasets.trainable import check_trainable
from tacgrasp.pretraining.evaluate import probe, retrieval, zero_shot
from tacgrasp.pretraining.evaluation_run import EvaluationRun
from tacgrasp.pretraining.methods import PretrainingRun, pretrain, pretrain_clip
from tacgrasp.pretraining.report.report import report


@contextmanager
def pretraining_run(
    out: Path,
    data: Path,
    *,
    seed: int,
    command: str,
    threads: int | None = None,
    precision: str = "no",
    tensorboard: bool = False,
) -> Iterator[PretrainingRun]:
    """Open what the stages of one command share, with progress on the terminal.

    Args:
        out: Folder of all methods.
        data: A data set of contacts.
        seed: Seed of weights, order and noise.
        command: The command line, for ``about.json``.
        threads: Threads of torch; one for each core when not given.
        precision: Out of ``cltp.train.distributed.PRECISIONS``.
        tensorboard: Whether curves are also written into ``out / "tensorboard"``.

    Raises:
        TouchError: There is no data set, one that is not to be learned from, or tensorboard is
            not installed.
    """
    disable_progress_bar()  # of reading and writing weights, over in milliseconds
    check_trainable(ContactDataset(data))  # before anything else is done
    torch.set_num_threads(threads or os.cpu_count() or 1)
    with ExitStack() as opened:
        reports: list[ProgressReport] = [opened.enter_context(Bar())]
        if tensorboard:
            reports.append(opened.enter_context(TensorBoardReport(out / "tensorboard")))

        def report_all(stage: str, step: int, steps: int, scores: Mapping[str, float]) -> None:
            for one in reports:
                one(stage, step, steps, scores)

        yield PretrainingRun(
            out=out,
            data=data,
            seed=seed,
            command=command,
            report=report_all,
            workers=joined_workers(precision),
        )


def run_probes(run: PretrainingRun, results: Path, seeds: int) -> None:
    """Train and measure probes on every encoder of a run's folder, for several seeds.

    Raises:
        UsageError: No encoder was trained.
        TouchError: Data, an encoder or a result can't be used.
    """
    run.announce("probe", results)
    for number in range(seeds):
        probe(_evaluation(run, results, number))


def run_all_methods(
    run: PretrainingRun,
    results: Path,
    clip: tuple[ClipRecipe, Schedule],
    cltp: tuple[CltpRecipe, Schedule],
    *,
    seeds: int,
    preset: str | None = None,
) -> None:
    """Pre-train CLIP and every method, measure them, and write the report.

    Args:
        run: Folders, seed, progress and processes.
        results: Folder of results and of the report.
        clip: What CLIP minimises, and how long and how fast it learns.
        cltp: What CLTP minimises, and how long and how fast each method learns.
        seeds: Number of seeds of probes, counted from the run's; those after the first for CLTP
            alone.
        preset: Encoder of all methods; each method's own when not given.

    Raises:
        UsageError: An unknown preset.
        TouchError: Data, weights or a checkpoint can't be used.
    """
    pretrain_clip(run, *clip)
    recipe, schedule = cltp
    for method in TRAINING_ORDER:
        pretrain(method, run, schedule, preset=preset, recipe=recipe)
    run.announce("results", results)
    evaluation = _evaluation(run, results)
    zero_shot(evaluation)
    retrieval(evaluation)
    probe(evaluation)
    for number in range(1, seeds):
        probe(_evaluation(run, results, number), ("cltp",))
    report(results, results, weights=run.out)


def _evaluation(run: PretrainingRun, results: Path, number: int = 0) -> EvaluationRun:
    return EvaluationRun(
        weights=run.out,
        data=run.data,
        results=results,
        seed=run.seed + number,
        command=run.command,
        report=run.report,
    )
