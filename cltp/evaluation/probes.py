"""Small networks on a frozen encoder: classes (the paper's table 2) and numbers with intervals.

Classes are read by one MLP a dimension, as in the paper. Numbers, beyond the paper, are read by
several MLPs that predict a mean and a spread for each quantity. Each learns without a part of the
objects, so that they disagree where a contact resembles nothing that all of them learned from.
Their intervals are then scaled on contacts that none learned from until 90 % of the true values lie
inside (split conformal prediction).

Source: paper, section 5.2; conformal intervals scaled by a predicted spread after Lei et al.,
'Distribution-Free Predictive Inference for Regression', 2018; members that disagree after
Lakshminarayanan et al., 'Simple and Scalable Predictive Uncertainty Estimation using Deep
Ensembles', 2017.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from cltp.data.sampler import Batch
from cltp.encoder.heads import StateHeads, restored, transformed
from cltp.errors import TouchError
from cltp.evaluation.features import EncodedContacts
from cltp.evaluation.scores import Predictions, best_classes
from cltp.tactile.states import CLASSES, NUMBERS
from cltp.train.recipes import Schedule
from cltp.train.stage import ProgressReport, silent

SCHEDULE = Schedule(steps=1500, batch_size=256, learning_rate=1e-3)
COVERAGE = 0.9
"""Fraction of the true values that shall lie inside their intervals."""
HIDDEN = 256
LEAST_SPREAD = 1e-3
"""Standard deviation below which a feature counts as constant: that of rounding to 16 bits."""

_DEPTH = list(CLASSES).index("depth")


@torch.inference_mode()
def predict_with_heads(
    heads: StateHeads, encoded: EncodedContacts, batches: Sequence[Batch]
) -> Predictions:
    """What state heads that were trained with the encoder predict of encoded batches."""
    outputs, first = [], 0
    for batch in batches:
        pooled = encoded.pooled[first : first + len(batch.points)]
        outputs.append(heads.read(pooled, torch.from_numpy(batch.points)))
        first += len(batch.points)
    logits = [torch.cat(parts) for parts in zip(*(o.logits for o in outputs), strict=True)]
    numbers = torch.cat([output.numbers for output in outputs])
    return Predictions(best_classes(logits), restored(numbers).numpy())


class _ScaledMlp(nn.Module):
    """An MLP on features brought to mean 0 and variance 1."""

    def __init__(self, pooled: Tensor, outputs: int) -> None:
        super().__init__()
        self.mean = pooled.mean(0)
        spread = pooled.std(0)
        # What is the same in all that is learned from tells nothing: the pad of one sensor.
        self.spread = torch.where(spread < LEAST_SPREAD, torch.inf, spread)
        self.mlp = nn.Sequential(
            nn.Linear(pooled.shape[1], HIDDEN), nn.GELU(), nn.Linear(HIDDEN, outputs)
        )

    def forward(self, pooled: Tensor) -> Tensor:
        outputs: Tensor = self.mlp((pooled - self.mean) / self.spread)
        return outputs


@dataclass(frozen=True, slots=True)
class ProbeTraining:
    """How each network of a probe learns.

    Attributes:
        seed: Random seed of the weights, of the order of contacts and of the objects left out.
        report: Receives the progress.
        schedule: Length and learning rate.
    """

    seed: int = 0
    report: ProgressReport = silent
    schedule: Schedule = SCHEDULE

    def fit(
        self, model: nn.Module, count: int, loss: Callable[[Tensor], Tensor], name: str
    ) -> None:
        """Train by AdamW on random rows out of ``count``; ``loss`` takes the numbers of rows.

        Raises:
            TouchError: The loss became infinite.
        """
        rng, schedule = torch.Generator().manual_seed(self.seed), self.schedule
        optimiser = torch.optim.AdamW(
            model.parameters(), lr=schedule.learning_rate, weight_decay=schedule.weight_decay
        )
        for step in range(schedule.steps):
            value = loss(torch.randint(count, (schedule.batch_size,), generator=rng))
            if not torch.isfinite(value):
                raise TouchError(f"{name}: the loss became {float(value.detach())} in step {step}")
            for group in optimiser.param_groups:
                group["lr"] = schedule.rate(step)
            optimiser.zero_grad()
            value.backward()
            optimiser.step()
            if step % 100 == 99 or step + 1 == schedule.steps:
                self.report(name, step + 1, schedule.steps, {"loss": float(value.detach())})


class ClassProbes:
    """One MLP for each dimension, on frozen features.

    Args:
        encoded: Contacts to learn from.
        training: How each of them learns.

    Raises:
        TouchError: A feature is not finite.
    """

    def __init__(self, encoded: EncodedContacts, training: ProbeTraining) -> None:
        if not encoded.pooled.isfinite().all():
            rows = (~encoded.pooled.isfinite().all(dim=1)).nonzero()[:8, 0]
            raise TouchError(f"features of contacts {encoded.index[rows].tolist()} are not finite")
        self._probes: list[nn.Module] = []
        for column, (dimension, names) in enumerate(CLASSES.items()):
            torch.manual_seed(1000 * training.seed + column)
            labelled = (encoded.classes[:, column] >= 0).nonzero()[:, 0]
            pooled, labels = encoded.pooled[labelled], encoded.classes[labelled, column]
            probe = _ScaledMlp(encoded.pooled, len(names))

            def loss(
                rows: Tensor, probe: nn.Module = probe, x: Tensor = pooled, y: Tensor = labels
            ) -> Tensor:
                return F.cross_entropy(probe(x[rows]), y[rows])

            if len(labelled):
                training.fit(probe, len(labelled), loss, f"probe {dimension}")
            self._probes.append(probe.eval())

    @torch.no_grad()
    def probabilities(self, encoded: EncodedContacts) -> list[Tensor]:
        """Probabilities of the classes of each dimension, (N, classes) each."""
        return [probe(encoded.pooled).softmax(dim=1) for probe in self._probes]


class NumberInterval(NamedTuple):
    """Numbers with their intervals, in the units of ``NUMBERS``.

    Attributes:
        value, low, high: Shape (N, 5).
        position_mm: Shape (N,), radius about the position of the value [mm].
    """

    value: Tensor
    low: Tensor
    high: Tensor
    position_mm: Tensor


class IntervalScale(NamedTuple):
    """Half widths of intervals, in predicted spreads.

    Attributes:
        numbers: Shape (5,), of each number.
        position: Of the distance from the position.
    """

    numbers: Tensor
    position: float


MEMBERS = 5
"""MLPs that read numbers; each leaves out a fifth of the objects."""

DISAGREEMENT = 64.0
"""Weight of the variance between members beside the variance that they predict. Our choice:
members share an encoder and most objects, so that they disagree less than they are wrong."""


class NumberProbe:
    """Mean and spread of ``NUMBERS`` for each contact that touches.

    Args:
        encoded: Contacts to learn from.
        objects: Shape (N,), number of the object of each contact.
        training: How each member learns.
    """

    def __init__(self, encoded: EncodedContacts, objects: Tensor, training: ProbeTraining) -> None:
        touching = encoded.classes[:, _DEPTH] >= 0
        every = objects.unique()
        rng = torch.Generator().manual_seed(training.seed)
        part = torch.randperm(len(every), generator=rng) % MEMBERS
        part_of = part[torch.searchsorted(every, objects)]
        self._members = []
        for member in range(MEMBERS):
            learned = touching & (part_of != member)
            # A single object can't be left out.
            rows = (learned if learned.any() else touching).nonzero()[:, 0]
            name = f"probe numbers {member + 1} of {MEMBERS}"
            of_member = replace(training, seed=MEMBERS * training.seed + member)
            self._members.append(_train_member(encoded, rows, of_member, name))

    def _mean_and_spread(self, pooled: Tensor) -> tuple[Tensor, Tensor]:
        """Of all members together, transformed, (N, 5) each."""
        predicted = [_mean_and_spread(member, pooled) for member in self._members]
        means, spreads = (torch.stack(part) for part in zip(*predicted, strict=True))
        between = means.var(dim=0)
        return means.mean(dim=0), (spreads.square().mean(dim=0) + DISAGREEMENT * between).sqrt()

    @torch.no_grad()
    def calibrate(self, encoded: EncodedContacts) -> IntervalScale:
        """Scale intervals on contacts that were not learned from, with the noise of their use."""
        touching = encoded.classes[:, _DEPTH] >= 0
        mean, spread = self._mean_and_spread(encoded.pooled[touching])
        numbers = encoded.numbers[touching]
        error = (transformed(numbers) - mean).abs() / spread
        value = restored(mean)
        distance = (value[:, 1:3] - numbers[:, 1:3]).norm(dim=1) / spread[:, 1:3].norm(dim=1)
        # The finite-sample correction of conformal prediction: one more than the fraction.
        rank = min(len(error), math.ceil((len(error) + 1) * COVERAGE)) - 1
        return IntervalScale(error.sort(dim=0).values[rank], float(distance.sort().values[rank]))

    @torch.no_grad()
    def intervals(self, encoded: EncodedContacts, scale: IntervalScale) -> NumberInterval:
        """Numbers with their intervals."""
        mean, spread = self._mean_and_spread(encoded.pooled)
        reach = spread * scale.numbers
        radius = spread[:, 1:3].norm(dim=1) * scale.position
        return NumberInterval(
            restored(mean), restored(mean - reach), restored(mean + reach), radius
        )


def _train_member(
    encoded: EncodedContacts, rows: Tensor, training: ProbeTraining, name: str
) -> _ScaledMlp:
    torch.manual_seed(training.seed)
    pooled, truth = encoded.pooled[rows], transformed(encoded.numbers[rows])
    model = _ScaledMlp(encoded.pooled, 2 * len(NUMBERS))

    def loss(chosen: Tensor) -> Tensor:
        mean, spread = _mean_and_spread(model, pooled[chosen])
        likelihood = ((truth[chosen] - mean) / spread).square() / 2 + spread.log()
        # Absolute errors pull the mean too: a spread that is too wide would excuse it.
        pull = F.smooth_l1_loss(mean, truth[chosen], beta=0.02, reduction="none")
        return (likelihood + pull).mean()

    training.fit(model, len(rows), loss, name)
    return model.eval()


def _mean_and_spread(member: _ScaledMlp, pooled: Tensor) -> tuple[Tensor, Tensor]:
    mean, spread = member(pooled).chunk(2, dim=-1)
    return mean, F.softplus(spread - 2) + 1e-3


def score_intervals(intervals: NumberInterval, encoded: EncodedContacts) -> dict[str, float]:
    """Median errors, and percent of the true values inside the intervals, of contacts that touch.

    Returns:
        ``depth_mm``, ``position_mm``, ``area_percent`` and ``force_percent`` (of the true value),
        and ``coverage_depth``, ``coverage_position``, ``coverage_area``, ``coverage_force`` in %;
        ``width_depth`` and so on: median widths of the intervals, in the units of the errors.
    """
    touching = encoded.classes[:, _DEPTH] >= 0
    truth = encoded.numbers[touching]
    value, low, high, radius = (part[touching] for part in intervals)
    error = (value - truth).abs()
    distance = error[:, 1:3].norm(dim=1)
    inside = ((low <= truth) & (truth <= high)).float().mean(0)
    wide = high - low
    area, force = truth[:, 3].clamp_min(1e-3), truth[:, 4].clamp_min(0.05)
    return {
        "depth_mm": float(error[:, 0].median()),
        "position_mm": float(distance.median()),
        "area_percent": 100 * float((error[:, 3] / area).median()),
        "force_percent": 100 * float((error[:, 4] / force).median()),
        "coverage_depth": 100 * float(inside[0]),
        "coverage_position": 100 * float((distance <= radius).float().mean()),
        "coverage_area": 100 * float(inside[3]),
        "coverage_force": 100 * float(inside[4]),
        "width_depth": float(wide[:, 0].median()),
        "width_position": float(2 * radius.median()),
        "width_area": 100 * float((wide[:, 3] / area).median()),
        "width_force": 100 * float((wide[:, 4] / force).median()),
    }
