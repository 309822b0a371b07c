"""Tokens of the state heads' readings, for the language model: numbers that it can copy.

Beyond the paper, which passes on the encoder's tokens alone: from those, a language model of a few
million weights, trained for minutes, learns to write a millimetre only coarsely. Here each number
becomes a token of its phases, and those of the ends of its interval, at ten, a hundred, a thousand
and ten thousand times the last digit that is written, so that each digit is a direction of the
embedding. A reading that is left out becomes a token that says so.

Source: Fourier number embeddings (Zhou et al., FoNE, 2025), here of measured numbers.
"""

from __future__ import annotations

import math

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from cltp.encoder.heads import transformed
from cltp.encoder.readings import HeadReadings
from cltp.tactile.states import CLASSES, NUMBERS, Side

LAST_DIGIT = {"depth_mm": 0.01, "x_mm": 0.1, "y_mm": 0.1, "area_fraction": 0.001, "force_n": 0.01}
"""The last digit of each number as it is written, in its unit."""

PERIODS = (10.0, 100.0, 1000.0, 10000.0)
"""Periods of the phases, in last digits."""

NUM_READINGS = 1 + len(NUMBERS)


class ReadingTokens(nn.Module):
    """The readings as tokens: one for all words, one for each number with its interval.

    Args:
        dim: Width D of the tokens.
    """

    unit: Tensor
    periods: Tensor

    def __init__(self, dim: int) -> None:
        super().__init__()
        num_words = sum(len(names) for names in CLASSES.values()) + 1 + len(Side)
        num_features = 3 * (1 + 2 * len(PERIODS))
        self.words = nn.Linear(num_words, dim)
        self.numbers = nn.ModuleList(nn.Linear(num_features, dim) for _ in NUMBERS)
        self.left_out = nn.Parameter(torch.zeros(NUM_READINGS, dim))
        self.out = nn.Linear(dim, dim)
        unit = torch.tensor([LAST_DIGIT[name] for name in NUMBERS])
        self.register_buffer("unit", unit, persistent=False)
        self.register_buffer("periods", torch.tensor(PERIODS), persistent=False)

    def forward(self, readings: HeadReadings, given: Tensor | None = None) -> Tensor:
        """Readings of B contacts to tokens (B, 6, D).

        Args:
            readings: The readings.
            given: Shape (B, 6), bool: whether words and each number are given, or left out; None
                gives all.
        """
        touching, cut = readings.touching[:, None], readings.cut
        words = self.words(torch.cat([*readings.words, touching, cut], dim=-1))
        features = self.features(readings)
        numbers = [layer(features[:, i]) for i, layer in enumerate(self.numbers)]
        tokens = torch.stack([words, *numbers], dim=1)
        if given is not None:
            tokens = torch.where(given[..., None], tokens, self.left_out.to(tokens.dtype))
        return self.out(F.gelu(tokens))

    def features(self, readings: HeadReadings) -> Tensor:
        """Numbers and the ends of their intervals with sines and cosines of phases: (B, 5, 27)."""
        numbers = torch.stack([readings.values, readings.low, readings.high])
        phases = 2 * math.pi * (numbers / self.unit)[..., None] / self.periods
        parts = torch.cat([transformed(numbers)[..., None], phases.sin(), phases.cos()], dim=-1)
        return parts.permute(1, 2, 0, 3).flatten(2)
