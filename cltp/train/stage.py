"""One stage of training: its steps, its progress, and checkpoints that survive ``kill -9``.

A stage that is started again continues at its last checkpoint and ends with the same weights as one
that was never stopped: every random draw of a step depends on the seed and the step alone. A CSV
file beside the checkpoint holds the terms of every step (``cltp.train.curves``).
"""

from __future__ import annotations

import io
import json
import re
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol

import torch
from torch import Tensor, nn

from cltp.atomic_write import write_atomically
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import Batch, Sampler
from cltp.encoder.all_gather import averaged_gradients
from cltp.errors import TouchError
from cltp.train.curves import CurveFile, plot_curves
from cltp.train.distributed import Workers
from cltp.train.optimiser import Optimiser
from cltp.train.recipes import Schedule

_CONTENT = {"identity", "step", "model", "optimiser", "rng", "means"}
"""What a checkpoint holds."""

_FIELD = re.compile(r"(\w+)=([^=(,)]+|\([^()]*\))(?=[,)])|([a-z_]+) ([\d.e-]+)\b")
"""A field in the text of a dataclass and its value, a number or a flat tuple; or, behind it, a name
and a number."""

_LONGEST = 24
_DIGEST = re.compile(r"[0-9a-f]{12,}")


class ProgressReport(Protocol):
    """Receives the progress of a stage."""

    def __call__(self, stage: str, step: int, steps: int, scores: Mapping[str, float]) -> None:
        """Step ``step`` of ``steps`` is done; ``scores`` are means over the last steps."""
        ...


def silent(stage: str, step: int, steps: int, scores: Mapping[str, float]) -> None:
    """A ``ProgressReport`` that shows nothing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TrainingRun:
    """What every trainer needs: its data and folder, seed, progress and processes.

    Attributes:
        data: A data set of contacts; its training split is used.
        also: Further data sets, whose training splits are learned from too.
        also_fraction: Fraction of each batch that comes from ``also``; None draws every contact of
            all sets equally often.
        out: Folder of weights; checkpoints and curves lie in its ``.training``.
        seed: Seed of weights, order, noise and wordings.
        report: Receives the progress.
        workers: The processes that train together.
        checkpoint_s: Seconds between checkpoints.
    """

    data: Path
    out: Path
    seed: int = 0
    report: ProgressReport = silent
    workers: Workers = field(default_factory=Workers)
    checkpoint_s: float = 60.0
    also: Sequence[Path] = ()
    also_fraction: float | None = None

    def dataset(self) -> ContactDataset:
        """The training split, and after it those of the further data sets."""
        return ContactDataset(self.data, split=Split.TRAIN, also=self.also)


class Stage:
    """Runs one stage.

    Args:
        name: Name of the stage and of its checkpoint.
        run: Folder, seed, progress and processes.
        model: Everything that is learned, and everything whose state the checkpoint must hold.
        schedule: How long and how fast the stage learns.
        identity: What the stage is made of besides schedule, seed and number of processes: data,
            sizes, recipe. A checkpoint of another identity is refused, so that trainings never mix.
        clock: Source of the time for checkpoints [s].

    Raises:
        TouchError: The checkpoint can't be read, or belongs to another training.
    """

    def __init__(
        self,
        name: str,
        run: TrainingRun,
        model: nn.Module,
        schedule: Schedule,
        identity: Mapping[str, Any],
        *,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.name, self.model, self.schedule = name, model, schedule
        self._run, self._workers, self._clock = run, run.workers, clock
        self._means: dict[str, float] = {}
        self._path = run.out / ".training" / f"{name}.checkpoint"
        shared: dict[str, Any] = {
            "schedule": str(schedule),
            "seed": run.seed,
            "workers": run.workers.count,
        }
        if run.also_fraction is not None:  # checkpoints without one stay good
            shared["also_fraction"] = run.also_fraction
        if run.workers.precision != "no":
            shared["precision"] = run.workers.precision
        self._identity = json.dumps({**identity, **shared}, sort_keys=True)
        self._parameters = [p for p in model.parameters() if p.requires_grad]
        self._optimiser = Optimiser(model, schedule)
        self.step = self._restore()
        self.curves = self._path.with_suffix(".csv")
        self._curve = CurveFile(self.curves, self.step) if self._workers.is_first else None

    @property
    def done(self) -> bool:
        return self.step >= self.schedule.steps

    def batches(self, sampler: Sampler) -> Iterator[Batch]:
        """This process's parts of the batches of all remaining steps.

        Raises:
            TouchError: The processes can't share a batch evenly.
        """
        size = self._workers.per_process(self.schedule.batch_size)
        steps = range(self.step, self.schedule.steps)
        return (sampler.numbered(size, self._workers.part(step)) for step in steps)

    def train(self, losses: Callable[[int], Mapping[str, Tensor]]) -> None:
        """Do the remaining steps, and report every ten.

        Args:
            losses: Named terms of a step; the sum of those with gradients is minimised, the others
                are scores for people.

        Raises:
            TouchError: The loss is not finite.
        """
        self.model.train()
        saved_s = self._clock()
        while not self.done:
            terms = losses(self.step)
            total = sum((t for t in terms.values() if t.requires_grad), torch.tensor(0.0))
            if not torch.isfinite(total):
                raise TouchError(
                    f"{self.name}: the loss became {float(total.detach())} in step {self.step}; "
                    "lower the learning rate or look at the data"
                )
            self.model.zero_grad(set_to_none=True)
            total.backward()
            averaged_gradients(self._parameters)
            nn.utils.clip_grad_norm_(self._parameters, self.schedule.largest_gradient)
            self._optimiser.step(self.schedule.rate(self.step))
            self.step += 1
            values = {name: float(term.detach()) for name, term in terms.items()}
            for name, value in values.items():
                self._means[name] = 0.95 * self._means.get(name, value) + 0.05 * value
            if self._curve is not None:
                self._curve.add(self.step, self.schedule.rate(self.step - 1), values)
            if self._workers.is_first and (self.step % 10 == 0 or self.done):
                self._run.report(self.name, self.step, self.schedule.steps, self._means)
            if self._clock() - saved_s > self._run.checkpoint_s or self.done:
                self.save()
                saved_s = self._clock()
        self._workers.wait()

    def plot(self) -> None:
        """Draw the curves beside their CSV file."""
        if self.curves.exists():
            plot_curves(self.curves, self.curves.with_suffix(".png"))

    def save(self) -> None:
        """Write a checkpoint in the place of the last one."""
        if self._curve is None:
            return
        self._curve.flush()
        self._path.parent.mkdir(parents=True, exist_ok=True)
        content = {
            "identity": self._identity,
            "step": self.step,
            "model": self.model.state_dict(),
            "optimiser": self._optimiser.state(),
            "rng": torch.get_rng_state(),
            "means": self._means,
        }
        packed = io.BytesIO()  # torch's own writer turns a full disk into an error of its own
        torch.save(content, packed)
        write_atomically(self._path, packed.getvalue())

    def _restore(self) -> int:
        if not self._path.exists():
            return 0
        try:
            content = torch.load(self._path, map_location="cpu", weights_only=True)
        except OSError as error:
            raise TouchError(
                f"checkpoint {self._path} can't be read: {error.strerror or 'unknown error'}; make "
                "it readable, or train into another folder"
            ) from error
        except Exception as error:  # torch raises errors of many kinds, with words for programmers
            raise self._damaged() from error
        if not isinstance(content, dict) or not content.keys() >= _CONTENT:
            raise self._damaged()
        if content["identity"] != self._identity:
            differing = differences(content["identity"], self._identity)
            raise TouchError(
                f"checkpoint {self._path} is of another training: {', '.join(differing)}; delete "
                "it to start afresh, or train into another folder"
            )
        self.model.load_state_dict(content["model"])
        self._optimiser.restore(content["optimiser"])
        torch.set_rng_state(content["rng"])
        self._means = content["means"]
        return int(content["step"])

    def _damaged(self) -> TouchError:
        return TouchError(
            f"checkpoint {self._path} is damaged; delete it, and the same command starts the stage "
            f"{self.name} afresh"
        )


def differences(before: str, now: str) -> list[str]:
    """Name what differs between the identities of two stages, with its old and its new value.

    Many values are the text of a dataclass (``Schedule(steps=3, batch_size=8, ...)``), whose fields
    are compared singly.

    Args:
        before: Identity of the training that was begun.
        now: Identity of the one that was asked for.

    Returns:
        Such as ``steps 400 instead of 300``, one entry for each value; the old one comes first.
    """
    old, new = (dict(_values(json.loads(identity))) for identity in (before, now))
    return [
        f"{key.rpartition('.')[2]} {_short(old.get(key))} instead of {_short(new.get(key))}"
        for key in sorted({*old, *new})
        if old.get(key) != new.get(key)
    ]


def _values(content: dict[str, Any], above: str = "") -> Iterator[tuple[str, Any]]:
    """Every single value, by the names of what it lies in."""
    for name, value in content.items():
        key = f"{above}{name}"
        if isinstance(value, dict):
            yield from _values(value, f"{key}.")
        elif isinstance(value, str):
            for name_in, text, name_behind, number in _FIELD.findall(value):
                yield f"{key}.{name_in or name_behind}", text.strip("'") or number
            yield key, " ".join(re.findall(r"[\w.-]+", _FIELD.sub("", value)))
        else:
            yield key, value


def _short(value: Any) -> str:
    if value is None:
        return "none"
    text = f"{value:.6g}" if isinstance(value, float) else str(value)
    if _DIGEST.fullmatch(text):
        return text[:8]
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}…"
