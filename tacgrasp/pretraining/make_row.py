"""Make one row of the tables: train its encoder, measure everything of it, write one file.

    OUT/TOWERS-seedS/clip/           the towers that the rows of one seed share
    OUT/TOWERS-seedS/ROW/encoder/    the encoder; about.json and minutes.json beside it
    OUT/TOWERS-seedS/ROW/results/    encoded contacts, single results, failures with pictures

The same command continues where it was stopped: stages at their checkpoints, encoded contacts where
they are; probes and scores, which take less, are computed again. An encoder that is there is taken
as it is. Not here: the list of rows (``report.rows``), rows of captions
(``tacgrasp.training.captions.caption_row``).
"""

from __future__ import annotations

import platform
from collections.abc import Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from importlib.metadata import version
from pathlib import Path

from cltp.data.dataset import ContactDataset
from cltp.tactile.cloud import NUM_POINTS
from cltp.train.methods import ALIGNED_METHODS
from cltp.train.recipes import Schedule
from tacgrasp import __version__
from tacgrasp.pretraining.checkpoints import TrainedMethod, find_method_of_data
from tacgrasp.pretraining.evaluate import probe, retrieval, zero_shot
from tacgrasp.pretraining.evaluation_run import EvaluationRun
from tacgrasp.pretraining.geometric_baseline import geometric_baseline, heights_alone
from tacgrasp.pretraining.methods import (
    ABOUT,
    PretrainingRun,
    pretrain,
    pretrain_clip,
    pretraining_run,
)
from tacgrasp.pretraining.report.row_file import RowFile, measured, save_row
from tacgrasp.pretraining.report.rows import BUDGET, PRECISION, ROWS, RowRecipe, row_command
from tacgrasp.pretraining.report.store import GEOMETRIC_BASELINE, Result
from tacgrasp.pretraining.work_clock import WorkClock

VIEWS = 2
"""How often probes are shown each training contact, with other noise each time."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RowRequest:
    """What one row is made of.

    Attributes:
        name: Name out of ``report.rows.ROWS``.
        seed: Random seed of pre-training, noise and probes.
        data: The set ``paper``, which is measured on.
        full: The set ``full``, for rows that learn from it.
        out: Folder of encoders and of all that lasts while a row is made.
        results: Folder of the rows' files.
        samples: Samples that the encoder sees; the row's own number when not given.
        limit: Largest number of contacts of each split that are measured; None for all.
        threads: Threads of torch; one for each core when not given.
        precision: Out of ``cltp.train.distributed.PRECISIONS``.
    """

    name: str
    seed: int
    data: Path
    full: Path
    out: Path
    results: Path
    samples: int | None = None
    limit: int | None = None
    threads: int | None = None
    precision: str = PRECISION

    @property
    def recipe(self) -> RowRecipe:
        return ROWS[self.name]

    @property
    def learned(self) -> Path:
        """The data set that is learned from."""
        return self.data if self.recipe.learns_from == "paper" else self.full

    @property
    def samples_seen(self) -> int:
        own = self.recipe.samples
        return own if self.samples is None or own == 0 else self.samples

    @property
    def command(self) -> str:
        """The command, without folders."""
        flags = {"samples": self.samples, "limit": self.limit}
        given = "".join(f" --{name} {value}" for name, value in flags.items() if value is not None)
        precision = "" if self.precision == PRECISION else f" --precision {self.precision}"
        return row_command(self.name, self.seed) + given + precision

    @property
    def group(self) -> Path:
        """Folder of the rows with the same towers; what is tried out has one of its own."""
        tried = {"samples": self.samples, "contacts": self.limit}
        parts = [f"-{value}-{name}" for name, value in tried.items() if value is not None]
        parts += [] if self.precision == PRECISION else [f"-precision-{self.precision}"]
        return self.out / "".join([f"{self.recipe.towers}-seed{self.seed}", *parts])

    @property
    def folder(self) -> Path:
        return self.group / self.name

    def training(self) -> AbstractContextManager[PretrainingRun]:
        """What all its stages of training share."""
        return pretraining_run(
            self.group,
            self.learned,
            seed=self.seed,
            command=self.command,
            threads=self.threads,
            precision=self.precision,
        )


def make_row(request: RowRequest) -> tuple[Path, list[Result]]:
    """Train, or take up what was trained; measure; write the file.

    Returns:
        Path of the file, and the results in it.

    Raises:
        UsageError: The file can't be written.
        TouchError: Data, a checkpoint or an encoder can't be used.
    """
    clock = WorkClock(request.folder / "minutes.json")
    clip_clock = WorkClock(request.group / "clip-minutes.json")
    with request.training() as run:
        if request.recipe.method == GEOMETRIC_BASELINE:
            trained = TrainedMethod(
                folder=request.folder,
                variant=request.recipe.variant,
                budget=None,
                points=NUM_POINTS,
            )
        else:
            trained = trained_encoder(request, run, clock, clip_clock)
        evaluation = EvaluationRun(
            weights=request.group,
            data=request.data,
            results=request.folder / "results",
            limit=request.limit,
            seed=request.seed,
            command=request.command,
            report=clock.watched(run.report),
        )
        with clock.part("measure"):
            results = _measured(evaluation, request.recipe, trained)
    minutes = {"clip": clip_clock.minutes("clip")} if request.recipe.has_towers else {}
    parts = ("train", "measure") if request.recipe.samples else ("measure",)
    minutes |= {part: clock.minutes(part) for part in parts}
    row = row_of(request, trained, minutes, results)
    path = save_row(request.results, row)
    clock.finish()
    return path, row.results()


def trained_encoder(
    request: RowRequest, run: PretrainingRun, clock: WorkClock, clip_clock: WorkClock
) -> TrainedMethod:
    """Train CLIP and the encoder of a row, each where it is not there already."""
    recipe, clip = request.recipe, request.group / "clip"
    if recipe.has_towers and (clip_clock.seconds or not clip.exists()):
        with clip_clock.part("clip"):
            watched = replace(run, report=clip_clock.watched(run.report))
            pretrain_clip(watched, recipe.clip, _clip_schedule(request))
        clip_clock.finish()
    if "train" in clock.seconds or not (request.folder / ABOUT).exists():
        with clock.part("train"):
            pretrain(
                recipe.method,
                replace(run, report=clock.watched(run.report)),
                recipe.schedule(request.samples_seen),
                preset=recipe.preset,
                recipe=recipe.recipe,
                name=request.name,
            )
    learned = ContactDataset(request.learned).checksum()
    trained = find_method_of_data(recipe.method, request.group, learned, request.name)
    return replace(trained, variant=", ".join([trained.variant, *recipe.remarks]))


def _clip_schedule(request: RowRequest) -> Schedule:
    """CLIP's own; where a row is tried out, the same part of it as of the budget."""
    part = 1.0 if request.samples is None else request.samples / BUDGET
    usual = request.recipe.clip_schedule
    return replace(usual, steps=max(1, round(usual.steps * part)))


def _measured(run: EvaluationRun, recipe: RowRecipe, trained: TrainedMethod) -> list[Result]:
    """Everything that is measured of a row; direct computation stands in both tables."""
    if recipe.variant == "heights alone":
        return heights_alone(run, VIEWS)
    if recipe.method == GEOMETRIC_BASELINE:
        splits = run.evaluation_splits()
        return [r for t in ("zero_shot", "probe") for r in geometric_baseline(run, t, splits)]
    run = replace(run, encoders={recipe.method: replace(trained, data=run.checksum)})
    results = probe(run, views=VIEWS)
    is_aligned = recipe.method in ALIGNED_METHODS
    return results + (zero_shot(run) + retrieval(run) if is_aligned else [])


def row_of(
    request: RowRequest,
    trained: TrainedMethod,
    minutes: Mapping[str, float | None],
    results: list[Result],
) -> RowFile:
    """What is written of a row that was measured."""
    learned, checksums = None, {"data": results[0].data}
    if trained.budget is not None:
        learned = ContactDataset(request.learned).origin
        checksums["learned_from"] = trained.data or ""
    return RowFile(
        row=request.name,
        seed=request.seed,
        method=request.recipe.method,
        variant=trained.variant,
        command=request.command,
        data=ContactDataset(request.data).origin,
        learned_from=learned,
        checksums=checksums,
        budget=trained.budget,
        points=trained.points,
        minutes=minutes,
        limit=request.limit,
        precision=request.precision,
        device=trained.device,
        versions={
            "tacgrasp": __version__,
            "python": platform.python_version(),
            **{name: version(name) for name in ("torch", "numpy")},
        },
        **measured(results),
    )
