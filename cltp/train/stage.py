"""One stage of training: a schedule, progress, and checkpoints that survive ``kill -9``.

A stage that is started again goes on at its last checkpoint and comes to the same weights as one
that was never stopped: whatever is drawn in a step depends on the seed and the step alone. Beside
the checkpoint grows a CSV file with the terms of every step (``cltp.train.curves``).
"""

from __future__ import annotations

import json
import math
import os
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import torch
from torch import Tensor, nn

from cltp.encoder.all_gather import averaged_gradients
from cltp.errors import TouchError
from cltp.train.curves import CurveFile
from cltp.train.distributed import Workers


class ProgressReport(Protocol):
    """Told how a stage gets on."""

    def __call__(self, stage: str, step: int, steps: int, scores: Mapping[str, float]) -> None:
        """Step ``step`` of ``steps`` is done; ``scores`` are means over the last steps."""
        ...


def silent(stage: str, step: int, steps: int, scores: Mapping[str, float]) -> None:
    """A report to nobody."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Schedule:
    """How long and how fast a stage learns: AdamW, warm-up, cosine to a hundredth.

    Attributes:
        steps: Optimiser steps.
        batch_size: Contacts in a step.
        learning_rate: At its peak.
        weight_decay: Of matrices; vectors (biases, norms) have none.
        warm_up: Share of the steps during which the rate rises.
        largest_gradient: Gradients are scaled down to this norm.

    Raises:
        TouchError: A value is not positive.
    """

    steps: int
    batch_size: int
    learning_rate: float
    weight_decay: float = 0.05
    warm_up: float = 0.05
    largest_gradient: float = 1.0

    def __post_init__(self) -> None:
        if min(self.steps, self.batch_size) < 1 or not self.learning_rate > 0:
            raise TouchError(f"a schedule needs positive steps, batch size and rate, got {self}")

    def rate(self, step: int) -> float:
        """Learning rate in step ``step``, counted from 0."""
        share = (step + 1) / self.steps
        if share < self.warm_up:
            return self.learning_rate * share / self.warm_up
        done = (share - self.warm_up) / (1 - self.warm_up)
        return self.learning_rate * (0.01 + 0.99 * 0.5 * (1 + math.cos(math.pi * done)))


def device() -> torch.device:
    """The accelerator when there is one, else the CPU."""
    return torch.device("cuda" if torch.cuda.is_available() else "cpu")


class Stage:
    """Runs one stage.

    Args:
        name: Of the stage; also of its checkpoint.
        folder: Where the checkpoint lies.
        model: Everything that is learned, and everything whose state must survive.
        schedule: How long and how fast.
        identity: What the stage is made of (seed, checksum of the data, sizes). A checkpoint of
            another identity is refused, so that no two trainings get mixed.
        workers: The processes that share each step; this one alone when not given.
        checkpoint_s: Seconds between checkpoints.
        clock: For checkpoints [s].
    """

    def __init__(
        self,
        name: str,
        folder: Path,
        model: nn.Module,
        schedule: Schedule,
        identity: Mapping[str, Any],
        *,
        workers: Workers | None = None,
        checkpoint_s: float = 60.0,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.name, self.model, self.schedule = name, model, schedule
        self._workers = workers or Workers()
        self._means: dict[str, float] = {}
        self._path = Path(folder) / f"{name}.checkpoint"
        self._identity = json.dumps({**identity, "schedule": str(schedule)}, sort_keys=True)
        self._checkpoint_s, self._clock = checkpoint_s, clock
        self._parameters = [p for p in model.parameters() if p.requires_grad]
        matrices = [p for p in self._parameters if p.ndim > 1]
        vectors = [p for p in self._parameters if p.ndim <= 1]
        groups: Sequence[dict[str, Any]] = [
            {"params": matrices, "weight_decay": schedule.weight_decay},
            {"params": vectors, "weight_decay": 0.0},
        ]
        self._optimiser = torch.optim.AdamW(
            [g for g in groups if g["params"]], lr=schedule.learning_rate, betas=(0.9, 0.98)
        )
        self.step = self._restore()
        self.curves = self._path.with_suffix(".csv")
        self._curve = CurveFile(self.curves, self.step) if self._workers.is_first else None

    @property
    def done(self) -> bool:
        """Whether all steps are done."""
        return self.step >= self.schedule.steps

    def run(
        self, losses: Callable[[int], Mapping[str, Tensor]], report: ProgressReport = silent
    ) -> dict[str, float]:
        """Do the remaining steps.

        Args:
            losses: Named terms of a step; those that need gradients are added and minimised, the
                others are scores for people.
            report: Told every few steps.

        Returns:
            Means of all terms over the last steps; empty when nothing remained.

        Raises:
            TouchError: The loss is not finite.
        """
        means = self._means
        saved = self._clock()
        began = self.step
        while not self.done:
            terms = losses(self.step)
            total = sum((t for t in terms.values() if t.requires_grad), torch.tensor(0.0))
            self._descend(total)
            self.step += 1
            for name, term in terms.items():
                value = float(term.detach())
                means[name] = 0.95 * means.get(name, value) + 0.05 * value
            self._note({name: float(term.detach()) for name, term in terms.items()})
            if self._workers.is_first and (self.step % 10 == 0 or self.done):
                report(self.name, self.step, self.schedule.steps, means)
            if self._clock() - saved > self._checkpoint_s or self.done:
                self.save()
                saved = self._clock()
        self._workers.wait()
        return means if self.step > began else {}

    def _note(self, terms: Mapping[str, float]) -> None:
        if self._curve is not None:
            self._curve.add(self.step, self.schedule.rate(self.step - 1), terms)

    def _descend(self, total: Tensor) -> None:
        if not torch.isfinite(total):
            raise TouchError(
                f"{self.name}: the loss became {float(total.detach())} in step {self.step}; "
                "lower the learning rate or look at the data"
            )
        for group in self._optimiser.param_groups:
            group["lr"] = self.schedule.rate(self.step)
        self._optimiser.zero_grad(set_to_none=True)
        total.backward()
        averaged_gradients(self._parameters)
        nn.utils.clip_grad_norm_(self._parameters, self.schedule.largest_gradient)
        self._optimiser.step()

    def save(self) -> None:
        """Write a checkpoint, beside the last one and then in its place."""
        if self._curve is None:
            return
        self._curve.flush()
        self._path.parent.mkdir(parents=True, exist_ok=True)
        beside = self._path.with_name(f"{self._path.name}.part")
        content = {
            "identity": self._identity,
            "step": self.step,
            "model": self.model.state_dict(),
            "optimiser": self._optimiser.state_dict(),
            "rng": torch.get_rng_state(),
            "means": self._means,
        }
        with beside.open("wb") as file:
            torch.save(content, file)
            file.flush()
            os.fsync(file.fileno())
        beside.replace(self._path)

    def _restore(self) -> int:
        if not self._path.exists():
            return 0
        try:
            content = torch.load(self._path, map_location="cpu", weights_only=True)
        except Exception as error:  # torch raises whatever its reader stumbles over
            raise TouchError(
                f"checkpoint {self._path} can't be read; delete it: {error}"
            ) from error
        if content["identity"] != self._identity:
            raise TouchError(
                f"checkpoint {self._path} is of a training with other data, seed or sizes; delete "
                "it to start afresh, or train into another folder"
            )
        self.model.load_state_dict(content["model"])
        self._optimiser.load_state_dict(content["optimiser"])
        torch.set_rng_state(content["rng"])
        self._means = content.get("means", {})
        return int(content["step"])
