"""What small networks read from a frozen encoder: classes (the paper's table 2) and numbers.

One MLP a dimension, as in the paper. For numbers, beyond the paper, several that say how sure they
are: a mean and a spread for each quantity. Each learns without a part of the objects, so that they
disagree where a contact is like nothing that all of them know. Their intervals are then stretched
on contacts that none learned from until they hold 90 % of them (split conformal prediction).

Source: paper, section 5.2; conformal intervals scaled by a predicted spread after Lei et al.,
'Distribution-Free Predictive Inference for Regression', 2018; several that disagree after
Lakshminarayanan et al., 'Simple and Scalable Predictive Uncertainty Estimation using Deep
Ensembles', 2017.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from cltp.encoder.heads import restored, transformed
from cltp.errors import TouchError
from cltp.evaluation.features import Observed
from cltp.tactile.states import CLASSES, NUMBERS
from cltp.train.stage import ProgressReport, Schedule, silent

SCHEDULE = Schedule(steps=1500, batch_size=256, learning_rate=1e-3)
COVERAGE = 0.9
HIDDEN = 256


@dataclass(frozen=True, slots=True)
class Judged:
    """How right classes are.

    Attributes:
        right: By dimension, share right, 0 to 1; NaN where nothing could be judged.
        confusion: By dimension, counts, shape (classes, classes): truth by row, said by column.
        count: Contacts.
    """

    right: Mapping[str, float]
    confusion: Mapping[str, Tensor]
    count: int


def judge(said: Tensor, classes: Tensor) -> Judged:
    """Compare classes.

    Args:
        said: Shape (N, 5), class numbers in the order of ``CLASSES``; -1 for none.
        classes: Shape (N, 5), the truth; -1 where nobody named one, which is not judged.
    """
    right, confusion = {}, {}
    for column, (slot, names) in enumerate(CLASSES.items()):
        known = classes[:, column] >= 0
        truth, found = classes[known, column], said[known, column]
        right[slot] = float((truth == found).float().mean()) if known.any() else math.nan
        told = found >= 0
        flat = truth[told] * len(names) + found[told]
        confusion[slot] = torch.bincount(flat, minlength=len(names) ** 2).view(len(names), -1)
    return Judged(right, confusion, len(classes))


class _Scaled(nn.Module):
    """An MLP on features brought to mean 0 and variance 1."""

    def __init__(self, pooled: Tensor, outputs: int) -> None:
        super().__init__()
        self.mean = pooled.mean(0)
        self.spread = pooled.std(0).clamp_min(1e-4)
        self.mlp = nn.Sequential(
            nn.Linear(pooled.shape[1], HIDDEN), nn.GELU(), nn.Linear(HIDDEN, outputs)
        )

    def forward(self, pooled: Tensor) -> Tensor:
        found: Tensor = self.mlp((pooled - self.mean) / self.spread)
        return found


def _fit(
    model: nn.Module,
    count: int,
    loss: Callable[[Tensor], Tensor],
    schedule: Schedule,
    name: str,
    seed: int,
    report: ProgressReport,
) -> None:
    """AdamW with the schedule of the stages, over rows drawn from ``count``."""
    rng = torch.Generator().manual_seed(seed)
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
            report(name, step + 1, schedule.steps, {"loss": float(value.detach())})


class ClassProbes:
    """One MLP for each dimension, on frozen features.

    Args:
        seen: What they learn from.
        schedule: How long and how fast each learns.
        seed: Of their weights and order.
        report: Told about progress.

    Raises:
        TouchError: Features or labels are not finite.
    """

    def __init__(
        self,
        seen: Observed,
        *,
        schedule: Schedule = SCHEDULE,
        seed: int = 0,
        report: ProgressReport = silent,
    ) -> None:
        if not seen.pooled.isfinite().all():
            rows = (~seen.pooled.isfinite().all(dim=1)).nonzero()[:8, 0]
            raise TouchError(f"features of contacts {seen.index[rows].tolist()} are not finite")
        self._probes: list[nn.Module] = []
        for column, (slot, names) in enumerate(CLASSES.items()):
            torch.manual_seed(1000 * seed + column)
            known = (seen.classes[:, column] >= 0).nonzero()[:, 0]
            pooled, goal = seen.pooled[known], seen.classes[known, column]
            probe = _Scaled(seen.pooled, len(names))

            def loss(
                rows: Tensor, probe: nn.Module = probe, x: Tensor = pooled, y: Tensor = goal
            ) -> Tensor:
                return F.cross_entropy(probe(x[rows]), y[rows])

            if len(known):
                _fit(probe, len(known), loss, schedule, f"probe {slot}", seed, report)
            self._probes.append(probe.eval())

    @torch.no_grad()
    def said(self, seen: Observed) -> Tensor:
        """Classes, shape (N, 5)."""
        return torch.stack([probe(seen.pooled).argmax(1) for probe in self._probes], dim=1)

    @torch.no_grad()
    def sure(self, seen: Observed) -> list[Tensor]:
        """Probabilities of the classes of each dimension, (N, classes) each."""
        return [probe(seen.pooled).softmax(dim=1) for probe in self._probes]


@dataclass(frozen=True, slots=True)
class Interval:
    """A number with what it is probably between, in the unit of ``NUMBERS``.

    Attributes:
        value: Shape (N, 5).
        low: Shape (N, 5).
        high: Shape (N, 5).
        away_mm: Shape (N,): within this distance of the value lies the place of the contact [mm].
    """

    value: Tensor
    low: Tensor
    high: Tensor
    away_mm: Tensor


@dataclass(frozen=True, slots=True)
class IntervalScale:
    """How intervals are stretched to hold their share.

    Attributes:
        each: Shape (5,), in predicted spreads.
        place: For the distance of the place.
    """

    each: Tensor
    place: float


MEMBERS = 5
"""Readers of numbers; each leaves out as small a part of the objects."""

DISAGREEMENT = 64.0
"""What the variance between members counts for beside the one that they say. Our choice: members
share an encoder and most objects, so that they disagree less than they are wrong."""


class NumberProbe:
    """Mean and spread of ``NUMBERS`` for each contact that touches.

    Args:
        seen: What it learns from.
        things: Shape (N,), the number of the object that each contact is of.
        schedule: How long and how fast each member learns.
        seed: Of weights, order and which objects are left out.
        report: Told about progress.
    """

    def __init__(
        self,
        seen: Observed,
        things: Tensor,
        *,
        schedule: Schedule = SCHEDULE,
        seed: int = 0,
        report: ProgressReport = silent,
    ) -> None:
        touching = seen.classes[:, _DEPTH] >= 0
        every = things.unique()
        rng = torch.Generator().manual_seed(seed)
        part = torch.randperm(len(every), generator=rng) % MEMBERS
        part_of = part[torch.searchsorted(every, things)]
        self._members = []
        for member in range(MEMBERS):
            known = touching & (part_of != member)
            # One object alone can't be left out.
            rows = (known if known.any() else touching).nonzero()[:, 0]
            name = f"probe numbers {member + 1} of {MEMBERS}"
            of_member = MEMBERS * seed + member
            self._members.append(_number_member(seen, rows, schedule, of_member, name, report))

    def _spoken(self, pooled: Tensor) -> tuple[Tensor, Tensor]:
        """Mean and spread, transformed, (N, 5) each."""
        told = [_told(member, pooled) for member in self._members]
        means, spreads = torch.stack([m for m, _ in told]), torch.stack([s for _, s in told])
        apart = means.var(dim=0)
        return means.mean(dim=0), (spreads.square().mean(dim=0) + DISAGREEMENT * apart).sqrt()

    @torch.no_grad()
    def calibrate(self, seen: Observed, coverage: float = COVERAGE) -> IntervalScale:
        """How far intervals must reach, from contacts that were not learned from.

        Args:
            seen: Read with the noise that the intervals shall hold for.
            coverage: Share of the truth that they shall hold.
        """
        touching = seen.classes[:, _DEPTH] >= 0
        mean, spread = self._spoken(seen.pooled[touching])
        numbers = seen.numbers[touching]
        off = (transformed(numbers) - mean).abs() / spread
        value = restored(mean)
        away = (value[:, 1:3] - numbers[:, 1:3]).norm(dim=1) / spread[:, 1:3].norm(dim=1)
        # The finite-sample correction of conformal prediction: one more than the share asks for.
        rank = min(len(off), math.ceil((len(off) + 1) * coverage))
        return IntervalScale(off.sort(dim=0).values[rank - 1], float(away.sort().values[rank - 1]))

    @torch.no_grad()
    def said(self, seen: Observed, stretch: IntervalScale) -> Interval:
        """Numbers with their intervals."""
        mean, spread = self._spoken(seen.pooled)
        reach = spread * stretch.each
        away = spread[:, 1:3].norm(dim=1) * stretch.place
        return Interval(restored(mean), restored(mean - reach), restored(mean + reach), away)


def _number_member(
    seen: Observed, rows: Tensor, schedule: Schedule, seed: int, name: str, report: ProgressReport
) -> _Scaled:
    """One reader of numbers, which has learned from some rows."""
    torch.manual_seed(seed)
    pooled, goal = seen.pooled[rows], transformed(seen.numbers[rows])
    model = _Scaled(seen.pooled, 2 * len(NUMBERS))

    def loss(chosen: Tensor) -> Tensor:
        mean, spread = _told(model, pooled[chosen])
        off = goal[chosen] - mean
        # The mean is pulled by absolute errors too: a spread that is too wide would excuse it.
        told = (off / spread).square() / 2 + spread.log()
        return (told + F.smooth_l1_loss(mean, goal[chosen], beta=0.02, reduction="none")).mean()

    _fit(model, len(rows), loss, schedule, name, seed, report)
    return model.eval()


def _told(member: _Scaled, pooled: Tensor) -> tuple[Tensor, Tensor]:
    mean, spread = member(pooled).chunk(2, dim=-1)
    return mean, F.softplus(spread - 2) + 1e-3


_DEPTH = list(CLASSES).index("depth")


def number_scores(said: Interval, seen: Observed) -> dict[str, float]:
    """Median errors and shares held by the intervals, of contacts that touch.

    Returns:
        ``depth_mm``, ``position_mm``, ``area_percent`` and ``force_percent`` (of the truth), and
        ``coverage_depth``, ``coverage_position``, ``coverage_area``, ``coverage_force`` in %.
    """
    touching = seen.classes[:, _DEPTH] >= 0
    truth = seen.numbers[touching]
    value, low, high = (part[touching] for part in (said.value, said.low, said.high))
    off = (value - truth).abs()
    away = off[:, 1:3].norm(dim=1)
    held = ((low <= truth) & (truth <= high)).float().mean(0)
    return {
        "depth_mm": float(off[:, 0].median()),
        "position_mm": float(away.median()),
        "area_percent": 100 * float((off[:, 3] / truth[:, 3].clamp_min(1e-3)).median()),
        "force_percent": 100 * float((off[:, 4] / truth[:, 4].clamp_min(0.05)).median()),
        "coverage_depth": 100 * float(held[0]),
        "coverage_position": 100 * float((away <= said.away_mm[touching]).float().mean()),
        "coverage_area": 100 * float(held[3]),
        "coverage_force": 100 * float(held[4]),
    }
