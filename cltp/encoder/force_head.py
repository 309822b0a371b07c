"""Force out of the pressure that explains the heights, and out of what the heads read.

Heads behind a transformer read forces of clean contacts 8 % off in the median. Mechanics is 2 % off
where it knows outline and zero of the contact, and far off where it does not. This small network
weighs both. It is fitted after the training of encoder and heads, which it leaves as they are.

Not here: the pressure (``cltp.gel.pressure``), the heads (``cltp.encoder.heads``), drawing the
contacts that it is fitted by (``cltp.train.calibration``).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import torch
import torch.nn.functional as F
from torch import Tensor, nn

from cltp.encoder.heads_output import HeadsOutput
from cltp.encoder.quantiles import pinball, widening
from cltp.gel.pressure import NUM_FEATURES, pressure_features
from cltp.tactile.states import NUMBERS, Side

HIDDEN = 64
"""Width of both hidden layers. Our choice: 7,500 weights."""

STEPS, BATCH, RATE = 6000, 512, 2e-3
"""How long and how fast it is fitted."""

FARTHEST = 6.0
"""Standard deviations beyond which an input counts as so far, so that nothing is extrapolated."""

_FORCE = NUMBERS.index("force_n")
NUM_INPUTS = NUM_FEATURES + 3 * len(NUMBERS) + 1 + len(Side)
"""Width of ``force_inputs``."""


class ReadForce(NamedTuple):
    """Forces of B contacts, transformed as by ``cltp.encoder.heads.transformed``.

    Attributes:
        value: Shape (B,).
        margins: Shape (B, 2), how far below and above it the interval reaches.
    """

    value: Tensor
    margins: Tensor


class ForceHead(nn.Module):
    """Reads the force of contacts."""

    mean: Tensor
    spread: Tensor
    widening: Tensor

    def __init__(self) -> None:
        super().__init__()
        self.register_buffer("mean", torch.zeros(NUM_INPUTS))
        self.register_buffer("spread", torch.ones(NUM_INPUTS))
        self.register_buffer("widening", torch.ones(1))
        self.layers = nn.Sequential(
            nn.Linear(NUM_INPUTS, HIDDEN),
            nn.GELU(),
            nn.Linear(HIDDEN, HIDDEN),
            nn.GELU(),
        )
        self.out = nn.Linear(HIDDEN, 3)

    def forward(self, inputs: Tensor) -> ReadForce:
        """Forces of ``force_inputs`` (B, 48)."""
        scaled = ((inputs - self.mean) / self.spread).clamp(-FARTHEST, FARTHEST)
        change, below, above = self.out(self.layers(scaled)).unbind(-1)
        margins = F.softplus(torch.stack([below, above], dim=-1)) * self.widening
        return ReadForce(inputs[:, NUM_FEATURES + _FORCE] + change, margins)

    def fit(
        self, inputs: Tensor, truth: Tensor, weights: Tensor | None = None, seed: int = 0
    ) -> None:
        """Learn from contacts that touch.

        Args:
            inputs: Their ``force_inputs``, shape (N, 48).
            truth: Their transformed forces, shape (N,).
            weights: How much each counts for the intervals, shape (N,), 1 in the mean; None for
                all alike.
            seed: Random seed of the order.
        """
        self.mean.copy_(inputs.mean(0))
        self.spread.copy_(inputs.std(0) + 1e-3)
        self.widening.fill_(1.0)
        with torch.no_grad():  # it begins with what the heads read
            self.out.weight.zero_()
            self.out.bias.copy_(torch.tensor([0.0, -2.0, -2.0]))
        optimiser = torch.optim.AdamW(self.parameters(), lr=RATE, weight_decay=0.02)
        schedule = torch.optim.lr_scheduler.OneCycleLR(optimiser, RATE, total_steps=STEPS)
        weights = torch.ones_like(truth) if weights is None else weights
        order = torch.Generator().manual_seed(seed)
        for _ in range(STEPS):
            rows = torch.randint(len(truth), (BATCH,), generator=order)
            force = self(inputs[rows])
            errors = truth[rows] - force.value
            ends = pinball(errors.detach(), force.margins)
            loss = errors.abs().mean() + (weights[rows] * ends).mean()
            optimiser.zero_grad()
            loss.backward()
            optimiser.step()
            schedule.step()

    @torch.no_grad()
    def widen(self, inputs: Tensor, truth: Tensor) -> None:
        """Set the intervals by contacts that touch and that nothing was learned from."""
        self.widening.fill_(1.0)
        force = self(inputs)
        factor = widening((truth - force.value)[:, None], force.margins[:, None])
        self.widening.copy_(factor)


@torch.no_grad()
def force_inputs(points: Tensor, read: HeadsOutput) -> Tensor:
    """What a ``ForceHead`` takes: shape (B, 48).

    Args:
        points: Scaled grids of points, shape (B, N, 3).
        read: What heads with intervals read of the same contacts.
    """
    assert read.margins is not None, "a force head needs heads with intervals"
    clouds = points.float().cpu().numpy()
    pressure = torch.from_numpy(np.stack([pressure_features(cloud) for cloud in clouds]))
    parts = (read.numbers, read.margins.flatten(1), read.touching[:, None], read.cut)
    return torch.cat([pressure.to(points.device), *(part.float() for part in parts)], dim=1)
