"""Heads that read a contact state from the encoder's pooled tokens, and their targets.

Beyond the paper, whose encoder learns from captions and images alone: numbers, which its section on
limitations names, make the tokens precise enough to act on. Used in pre-training beside the
contrastive losses, and in evaluation.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from cltp.encoder.encoder import EncoderConfig
from cltp.encoder.force_head import ForceHead, force_inputs
from cltp.encoder.heads_output import HeadsOutput
from cltp.encoder.quantiles import pinball, widening
from cltp.tactile.states import CLASSES, NUMBERS, ContactState, Side

SMALLEST_FORCE_N = 0.05
"""Forces are learned as logarithms; below this force, errors count in newtons."""

LEAST_CONTACTS = 20
"""Fewest contacts to calibrate by. Our choice: a tail of 5 % is then one contact."""

USUAL = 0.998
"""Fraction of contacts whose measured depth does not contradict the one that is read."""

IGNORED = -1

_FORCE = NUMBERS.index("force_n")


class Targets(NamedTuple):
    """Labels of a batch for the heads.

    Attributes:
        classes: Shape (B, 5), indices into ``CLASSES``; ``IGNORED`` where there is no label.
        numbers: Shape (B, 5), transformed ``NUMBERS``.
        touching: Shape (B,), 1 where there is contact.
        cut: Shape (B, 4), 1 for each side that cuts the contact.
    """

    classes: Tensor
    numbers: Tensor
    touching: Tensor
    cut: Tensor


def targets(states: Sequence[ContactState]) -> Targets:
    """Targets of labelled states."""
    words = [[(names, getattr(s, slot)) for slot, names in CLASSES.items()] for s in states]
    classes = [[IGNORED if w is None else names.index(w) for names, w in row] for row in words]
    numbers = torch.tensor([[getattr(s, n) for n in NUMBERS] for s in states], dtype=torch.float32)
    return Targets(
        classes=torch.tensor(classes),
        numbers=transformed(numbers),
        touching=torch.tensor([float(s.in_contact) for s in states]),
        cut=torch.tensor([[float(side in s.cut) for side in Side] for s in states]),
    )


def transformed(numbers: Tensor) -> Tensor:
    """Bring ``NUMBERS`` (..., 5) to a common size: lengths scaled, area by root, force by log."""
    depth, x, y, area, force = numbers.unbind(-1)
    softened = torch.log1p(force.clamp(min=0) / SMALLEST_FORCE_N) / 2
    return torch.stack([depth / 0.3, x / 5, y / 5, area.clamp(min=0).sqrt() / 0.3, softened], -1)


def restored(values: Tensor) -> Tensor:
    """Inverse of ``transformed``."""
    depth, x, y, area, force = values.unbind(-1)
    newtons = SMALLEST_FORCE_N * torch.expm1(2 * force.clamp(0, 5))
    return torch.stack([depth * 0.3, x * 5, y * 5, (area.clamp(min=0) * 0.3) ** 2, newtons], dim=-1)


class StateHeads(nn.Module):
    """All heads behind one hidden layer.

    Intervals are learned as quantiles. Afterwards one factor for each number widens them until they
    hold nine tenths of the truth, on contacts that nothing was learned from: those of training have
    smaller errors (``cltp.encoder.quantiles``).
    ``force``, where there is one, then reads the force anew.

    Args:
        pooled_dim: Width of ``Encoded.pooled``.
        hidden_dim: Width of the hidden layer.
        intervals: Whether the numbers have intervals.
        in_cells: Whether places are read in cells, whose edge the last of the pooled tokens tells
            (``Encoded.pooled``). So a place is right on a larger pad, without larger cells having
            to be learned from.
    """

    lengths_along: Tensor
    widening: Tensor | None
    contradiction: Tensor | None

    def __init__(
        self,
        pooled_dim: int,
        hidden_dim: int = 256,
        *,
        intervals: bool = True,
        in_cells: bool = False,
    ) -> None:
        super().__init__()
        count = len(NUMBERS)
        self.in_cells = in_cells
        self.sizes = [len(names) for names in CLASSES.values()]
        self.sizes += [count, 1, len(Side)] + ([2 * count] if intervals else [])
        self.hidden = nn.Linear(pooled_dim, hidden_dim)
        self.out = nn.Linear(hidden_dim, sum(self.sizes))
        self.register_buffer("widening", torch.ones(count) if intervals else None)
        along = torch.tensor([name in ("x_mm", "y_mm") for name in NUMBERS])
        self.register_buffer("lengths_along", along, persistent=False)
        anything = torch.tensor([-1e3, 1e3])  # until they are calibrated, nothing contradicts
        self.register_buffer("contradiction", anything if intervals else None)
        self.force: ForceHead | None = None

    @classmethod
    def of(cls, config: EncoderConfig, *, intervals: bool = True) -> StateHeads:
        """Heads for an encoder, with random weights."""
        return cls(config.pooled_dim, intervals=intervals, in_cells=config.counts_cells)

    @property
    def has_intervals(self) -> bool:
        return self.widening is not None

    def forward(self, pooled: Tensor) -> HeadsOutput:
        """Read states from ``Encoded.pooled`` (B, 2 C)."""
        parts = self.out(F.gelu(self.hidden(pooled))).split(self.sizes, -1)
        logits, (numbers, touching, cut) = parts[: len(CLASSES)], parts[len(CLASSES) :][:3]
        units = self._units(pooled)
        margins = None
        if self.widening is not None:
            margins = F.softplus(parts[-1]).unflatten(-1, (len(NUMBERS), 2))
            margins = margins * (self.widening * units)[..., None]
        return HeadsOutput(logits, numbers * units, touching[:, 0], cut, margins)

    def read(self, pooled: Tensor, points: Tensor) -> HeadsOutput:
        """``forward``, with the force of the force head, where there is one.

        Args:
            pooled: ``Encoded.pooled``, shape (B, 2 C).
            points: The scaled points that were encoded, shape (B, N, 3).
        """
        output: HeadsOutput = self(pooled)
        if self.force is None or output.margins is None:
            return output
        force = self.force(force_inputs(points, output))
        numbers, margins = output.numbers.clone(), output.margins.clone()
        numbers[:, _FORCE], margins[:, _FORCE] = force
        return output._replace(numbers=numbers, margins=margins)

    def _units(self, pooled: Tensor) -> Tensor:
        """What each number is read in, over what it is told in: (B, 5), or (1,) for ones."""
        if not self.in_cells:
            return pooled.new_ones(1)
        return torch.where(self.lengths_along, pooled[:, -1:].exp(), 1.0)

    def calibrate(self, *read: tuple[Tensor, Targets]) -> None:
        """Widen the intervals until they hold nine tenths of contacts that nothing learned from.

        One factor for each number: ends that were fitted anew by so few contacts were wider for
        the same part of new ones. With fewer than ``LEAST_CONTACTS`` that touch, the intervals
        stay as they are.

        Args:
            read: Pooled tokens (N, 2 C) and labels of the contacts, under one kind of noise each;
                the intervals are wide enough for every one.
        """
        touching = [labels.touching > 0 for _, labels in read]
        if self.widening is None or min(int(each.sum()) for each in touching) < LEAST_CONTACTS:
            return
        self.widening.fill_(1.0)
        factors = [
            self._needed(pooled[touched], labels.numbers[touched])
            for (pooled, labels), touched in zip(read, touching, strict=True)
        ]
        self.widening.copy_(torch.stack(factors).amax(0))

    @torch.no_grad()
    def _needed(self, pooled: Tensor, truth: Tensor) -> Tensor:
        """Factor (5,) by which the margins of contacts (N, 2 C) are too narrow for (N, 5)."""
        read = self(pooled)
        assert read.margins is not None  # as ``calibrate`` has seen
        return widening(truth - read.numbers, read.margins)

    @torch.no_grad()
    def calibrate_contradiction(self, pooled: Tensor, labels: Targets, measured_mm: Tensor) -> None:
        """Set how far a measured depth may lie outside the interval of the one that is read.

        Args:
            pooled: As for ``calibrate``, which comes before.
            labels: As for ``calibrate``.
            measured_mm: Depths that were measured directly, shape (N,) [mm].
        """
        touched = labels.touching > 0
        if self.contradiction is None or int(touched.sum()) < LEAST_CONTACTS:
            return
        output = self(pooled[touched])
        assert output.margins is not None  # as there are intervals
        depth, below, above = _ends(output.numbers[:, 0], output.margins[:, 0])
        away = outside(measured_mm[touched], depth, below, above)
        tail = (1 - USUAL) / 2
        self.contradiction.copy_(away.quantile(torch.tensor([tail, 1 - tail])))

    def losses(self, pooled: Tensor, labels: Targets) -> dict[str, Tensor]:
        """Named terms, each a mean over the batch."""
        logits, numbers, touching, cut, margins = self(pooled)
        terms = {}
        for column, (slot, scores) in enumerate(zip(CLASSES, logits, strict=True)):
            classes = labels.classes[:, column]
            total = F.cross_entropy(scores, classes, ignore_index=IGNORED, reduction="sum")
            terms[slot] = total / (classes != IGNORED).sum().clamp(min=1)
        errors = F.smooth_l1_loss(numbers, labels.numbers, beta=0.1, reduction="none")
        terms["numbers"] = (errors * labels.touching[:, None]).sum(1).mean()
        terms["touching"] = F.binary_cross_entropy_with_logits(touching, labels.touching)
        terms["cut"] = F.binary_cross_entropy_with_logits(cut, labels.cut)
        if margins is not None:
            beyond = pinball(labels.numbers - numbers.detach(), margins)
            terms["margins"] = (beyond * labels.touching[:, None]).sum(1).mean()
        return terms


def _ends(depth: Tensor, margins: Tensor) -> tuple[Tensor, Tensor, Tensor]:
    """A transformed depth (B,) and its margins (B, 2) as depth, low and high end [mm]."""
    numbers = torch.zeros(3, len(depth), len(NUMBERS), dtype=depth.dtype, device=depth.device)
    numbers[..., 0] = torch.stack([depth, depth - margins[:, 0], depth + margins[:, 1]])
    mm = restored(numbers)[..., 0]
    return mm[0], mm[1].clamp(min=0), mm[2]


def outside(measured: Tensor, value: Tensor, low: Tensor, high: Tensor) -> Tensor:
    """How far measured numbers lie from values, in widths of the interval on their side."""
    is_above = measured > value
    width = torch.where(is_above, high - value, value - low).clamp(min=1e-6)
    return (measured - value) / width
