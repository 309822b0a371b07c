"""Make one row of the tables: train its encoder, measure everything of it, write one file.

    OUT/TOWERS-seedS/clip/           the towers that the rows of one seed share
    OUT/TOWERS-seedS/ROW/encoder/    the encoder; about.json and minutes.json beside it
    OUT/TOWERS-seedS/ROW/results/    encoded contacts, single results, failures with pictures

The same command continues where it was stopped: stages at their checkpoints, encoded contacts where
they are; probes and scores, which take less, are computed again. An encoder that is there is taken
as it is. Not here: the list of rows (``report.rows``).
"""

from __future__ import annotations

import json
import platform
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from importlib.metadata import version
from pathlib import Path

from cltp.atomic_write import write_atomically
from cltp.data.dataset import ContactDataset
from cltp.errors import TouchError
from cltp.tactile.cloud import NUM_POINTS
from cltp.train.methods import ALIGNED_METHODS, IMAGE_METHODS
from cltp.train.recipes import Schedule
from cltp.train.stage import ProgressReport
from tacgrasp import __version__
from tacgrasp.pretraining.checkpoints import TrainedMethod, find_method_of_data
from tacgrasp.pretraining.evaluate import probe, retrieval, zero_shot
from tacgrasp.pretraining.evaluation_run import EvaluationRun
from tacgrasp.pretraining.geometric_baseline import geometric_baseline, heights_alone
from tacgrasp.pretraining.methods import ABOUT, pretrain, pretrain_clip, pretraining_run
from tacgrasp.pretraining.report.row_file import RowFile, measured, save_row
from tacgrasp.pretraining.report.rows import BUDGET, CLIP, ROWS, RowRecipe, row_command
from tacgrasp.pretraining.report.store import GEOMETRIC_BASELINE, Result

VIEWS = 2
"""How often probes are shown each training contact, with other noise each time."""

_WRITE_S = 10.0


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
    precision: str = "no"

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
        precision = "" if self.precision == "no" else f" --precision {self.precision}"
        return row_command(self.name, self.seed) + given + precision

    @property
    def group(self) -> Path:
        """Folder of the rows with the same towers; what is tried out has one of its own."""
        tried = "" if self.samples is None else f"-{self.samples}-samples"
        return self.out / f"{self.recipe.towers}-seed{self.seed}{tried}"

    @property
    def folder(self) -> Path:
        return self.group / self.name


class WorkClock:
    """Seconds of work by part, kept in a file so that they add up over interruptions.

    Args:
        path: The JSON file.
        clock: Source of the time [s].
    """

    def __init__(self, path: Path, clock: Callable[[], float] = time.monotonic) -> None:
        self._path, self._clock = path, clock
        try:
            self.seconds: dict[str, float] = json.loads(path.read_text(encoding="utf-8"))
        except FileNotFoundError:
            self.seconds = {}
        except (OSError, ValueError) as error:
            raise TouchError(f"{path} can't be read; delete it: {error}") from error
        self._part, self._since_s, self._written_s = "", clock(), clock()

    @contextmanager
    def part(self, name: str) -> Iterator[None]:
        """Count what happens inside as part ``name``."""
        self._part, self._since_s = name, self._clock()
        try:
            yield
        finally:
            self._add()
            self._write()

    def watched(self, report: ProgressReport) -> ProgressReport:
        """A progress report that also counts, so that little is lost when the process is killed."""

        def counted(stage: str, step: int, steps: int, scores: Mapping[str, float]) -> None:
            self._add()
            if self._clock() - self._written_s > _WRITE_S:
                self._write()
            report(stage, step, steps, scores)

        return counted

    def minutes(self, name: str) -> float | None:
        """Minutes of a part; None where it was done elsewhere."""
        seconds = self.seconds.get(name)
        return None if seconds is None else round(seconds / 60, 2)

    def _add(self) -> None:
        now_s = self._clock()
        self.seconds[self._part] = self.seconds.get(self._part, 0.0) + now_s - self._since_s
        self._since_s = now_s

    def _write(self) -> None:
        self._path.parent.mkdir(parents=True, exist_ok=True)
        write_atomically(self._path, json.dumps(self.seconds) + "\n")
        self._written_s = self._clock()


def make_row(request: RowRequest) -> tuple[Path, list[Result]]:
    """Train, or take up what was trained; measure; write the file.

    Returns:
        Path of the file, and the results in it.

    Raises:
        UsageError: The file can't be written.
        TouchError: Data, a checkpoint or an encoder can't be used.
    """
    recipe = request.recipe
    clock = WorkClock(request.folder / "minutes.json")
    clip_minutes: dict[str, float | None] = {}
    with pretraining_run(
        request.group,
        request.learned,
        seed=request.seed,
        command=request.command,
        threads=request.threads,
        precision=request.precision,
    ) as run:
        evaluation = EvaluationRun(
            weights=request.group,
            data=request.data,
            results=request.folder / "results",
            limit=request.limit,
            seed=request.seed,
            command=request.command,
            report=clock.watched(run.report),
        )
        if recipe.method == GEOMETRIC_BASELINE:
            with clock.part("measure"):
                results = _baseline(evaluation, recipe)
            variant = recipe.variant
            no_encoder = TrainedMethod(
                folder=request.folder, variant=variant, budget=None, points=NUM_POINTS
            )
            return _written(request, no_encoder, clock, {}, results)
        if recipe.method in (*ALIGNED_METHODS, *IMAGE_METHODS):
            clip_clock = WorkClock(request.group / "clip-minutes.json")
            if clip_clock.seconds or not (request.group / "clip").exists():
                with clip_clock.part("clip"):
                    watched = replace(run, report=clip_clock.watched(run.report))
                    pretrain_clip(watched, recipe.clip, _clip_schedule(request))
            clip_minutes = {"clip": clip_clock.minutes("clip")}
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
        evaluated = replace(trained, data=evaluation.checksum)
        evaluation = replace(evaluation, encoders={recipe.method: evaluated})
        with clock.part("measure"):
            results = probe(evaluation, views=VIEWS)
            if recipe.method in ALIGNED_METHODS:
                results += zero_shot(evaluation) + retrieval(evaluation)
    variant = ", ".join([trained.variant, *recipe.remarks])
    return _written(request, replace(trained, variant=variant), clock, clip_minutes, results)


def _clip_schedule(request: RowRequest) -> Schedule:
    """CLIP's own; where a row is tried out, the same part of it as of the budget."""
    part = 1.0 if request.samples is None else request.samples / BUDGET
    return replace(CLIP, steps=max(1, round(CLIP.steps * part)))


def _baseline(run: EvaluationRun, recipe: RowRecipe) -> list[Result]:
    """What is computed without an encoder; direct computation stands in both tables."""
    if recipe.variant == "heights alone":
        return heights_alone(run, VIEWS)
    tables = ("zero_shot", "probe")
    return [r for t in tables for r in geometric_baseline(run, t, run.evaluation_splits())]


def _written(
    request: RowRequest,
    trained: TrainedMethod,
    clock: WorkClock,
    clip_minutes: dict[str, float | None],
    results: list[Result],
) -> tuple[Path, list[Result]]:
    parts = ("train", "measure") if request.recipe.samples else ("measure",)
    row = RowFile(
        row=request.name,
        seed=request.seed,
        method=request.recipe.method,
        variant=trained.variant,
        command=request.command,
        data=results[0].data,
        learned_from=trained.data if trained.budget is not None else None,
        budget=trained.budget,
        points=trained.points,
        minutes=clip_minutes | {part: clock.minutes(part) for part in parts},
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
    return save_row(request.results, row), row.results()
