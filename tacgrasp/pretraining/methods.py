"""Pre-train by one method on a data set, into a folder of its own.

    OUT/clip/              the towers that all methods share
    OUT/METHOD/encoder/    the encoder of a method; OUT/METHOD/about.json: how it was trained

Every stage continues where it was stopped, and is skipped when it is done. Not here: measuring
(``tacgrasp.pretraining.evaluate``) and rows of tables (``tacgrasp.pretraining.make_row``).
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import torch
from rich.console import Console
from transformers.utils.logging import disable_progress_bar

from cltp.atomic_write import copy_folder, write_atomically
from cltp.checkpoints.manifest import manifest_digest
from cltp.data.dataset import ContactDataset
from cltp.encoder.encoder import PRESETS
from cltp.evaluation.splits import LEARNING_NOISE
from cltp.train.alignment import train_cltp
from cltp.train.baselines import train_baseline
from cltp.train.clip import train_clip
from cltp.train.distributed import joined_workers
from cltp.train.llm import train_words
from cltp.train.methods import ALIGNED_METHODS, METHODS
from cltp.train.progress import Bar
from cltp.train.recipes import CLIP_SCHEDULE, CLTP_SCHEDULE, ClipRecipe, CltpRecipe, Schedule
from cltp.train.stage import ProgressReport, TrainingRun
from cltp.train.tensorboard import TensorBoardReport
from tacgrasp.base.errors import UsageError
from tacgrasp.datasets.trainable import check_trainable
from tacgrasp.lessons.exchanges import TouchLessons

ABOUT = "about.json"


@dataclass(frozen=True, slots=True, kw_only=True)
class PretrainingRun(TrainingRun):
    """What all stages of one command share; ``out`` is the folder of all methods.

    Attributes:
        command: The command line, for ``about.json``.
    """

    command: str

    def announce(self, stage: str, folder: Path) -> None:
        if self.workers.is_first:
            line = f"{stage}: writing {folder}"
            Console(soft_wrap=True).print(line, markup=False, highlight=False)


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


def pretrain_clip(
    run: PretrainingRun, recipe: ClipRecipe | None = None, schedule: Schedule = CLIP_SCHEDULE
) -> Path:
    """Align the small CLIP that every method shares.

    Raises:
        TouchError: Data or a checkpoint can't be used.
    """
    run.announce("clip", run.out / "clip")
    words = train_words(run.data, TouchLessons(), seed=run.seed)
    return train_clip(run, words, schedule, recipe)


def pretrain(
    method: str,
    run: PretrainingRun,
    schedule: Schedule = CLTP_SCHEDULE,
    *,
    preset: str | None = None,
    recipe: CltpRecipe | None = None,
    also: Path | None = None,
    also_fraction: float | None = None,
    start: Path | None = None,
    name: str | None = None,
) -> Path:
    """Train one method behind the towers in ``run.out / "clip"``.

    Args:
        method: Out of ``cltp.train.methods.METHODS``.
        run: Folders, seed, progress and processes.
        schedule: How long and how fast the encoder learns.
        preset: Encoder, out of ``cltp.encoder.encoder.PRESETS``; the method's own when not given.
        recipe: What CLTP minimises.
        also: A further data set that CLTP learns from.
        also_fraction: Fraction of it in each batch; None draws every contact equally often.
        start: Folder of weights whose encoder CLTP trains on, behind its towers.
        name: Name of the method's folder in ``run.out``; the method's when not given.

    Returns:
        The method's folder.

    Raises:
        UsageError: An unknown method or preset.
        TouchError: Data, towers or a checkpoint can't be used.
        OSError: A file can't be written.
    """
    if method not in METHODS:
        raise UsageError(f"unknown method {method!r}; known: {', '.join(METHODS)}")
    preset, recipe = preset or METHODS[method].preset, recipe or CltpRecipe()
    if preset not in PRESETS:
        raise UsageError(f"unknown preset {preset!r}; known: {', '.join(PRESETS)}")
    if also is not None:
        check_trainable(ContactDataset(also))
    folder = run.out / (name or method)
    run.announce(method, folder / "encoder")
    config, clip = PRESETS[preset], run.out / "clip"
    training = replace(
        run,
        out=folder,
        report=labelled(run.report, method),
        also=() if also is None else (also,),
        also_fraction=also_fraction,
    )
    if start is not None:
        if run.workers.is_first and not clip.exists():
            copy_folder(start / "clip", clip)
        run.workers.wait()
    if method in ALIGNED_METHODS:
        train_cltp(
            training,
            config,
            schedule,
            recipe,
            with_images=method == "cltp",
            augmentation=LEARNING_NOISE,
            clip_dir=clip,
            start=None if start is None else start / "encoder",
        )
    else:
        train_baseline(
            method, training, config, schedule, augmentation=LEARNING_NOISE, clip_dir=clip
        )
    if run.workers.is_first:
        device = run.workers.device
        about: dict[str, object] = {
            "method": method,
            "preset": preset,
            "steps": 0 if method == "random" else schedule.steps,
            "batch_size": schedule.batch_size,
            "recipe": asdict(recipe) if method in ALIGNED_METHODS else None,
            "data": ContactDataset(run.data).checksum(),
            "seed": run.seed,
            "device": torch.cuda.get_device_name(device) if device.type == "cuda" else device.type,
            "command": run.command,
        }
        if schedule.optimiser != "adamw":
            about["optimiser"] = schedule.optimiser
        if also is not None:
            about["also"] = ContactDataset(also).checksum()
            about["also_fraction"] = also_fraction
        if start is not None:
            about["start"] = manifest_digest(start / "encoder")
        _write_about(folder / ABOUT, about)
    return folder


def labelled(report: ProgressReport, method: str) -> ProgressReport:
    """Put the method before the names of stages that don't begin with it."""

    def labelled_report(stage: str, step: int, steps: int, scores: Mapping[str, float]) -> None:
        report(stage if stage.startswith(method) else f"{method} {stage}", step, steps, scores)

    return labelled_report


def _write_about(path: Path, about: dict[str, object]) -> None:
    """Write how an encoder was trained; a training that was done before keeps its device."""
    try:
        before = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        before = {}
    if {**before, "device": about["device"], "command": about["command"]} == about:
        about["device"] = before.get("device", about["device"])
    write_atomically(path, json.dumps(about, indent=2) + "\n")
