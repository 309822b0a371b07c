"""Tokens of the state heads' readings, for the language model: numbers that it can copy.

Beyond the paper, which passes on the encoder's tokens alone: from those, a language model of a few
million weights, trained for minutes, learns to write a millimetre only coarsely. Here each number
becomes a token of its phases at ten, a hundred, a thousand and ten thousand times the last digit
that is written, so that each digit is a direction of the embedding.

Source: Fourier number embeddings (Zhou et al., FoNE, 2025), here of measured numbers.
"""

from __future__ import annotations

import math

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from cltp.encoder.heads import HeadsOutput, restored
from cltp.tactile.states import CLASSES, NUMBERS, Side

LAST_DIGIT = {"depth_mm": 0.01, "x_mm": 0.1, "y_mm": 0.1, "area_fraction": 0.001, "force_n": 0.01}
"""The last digit of each number as it is written, in its unit."""

PERIODS = (10.0, 100.0, 1000.0, 10000.0)
"""Periods of the phases, in last digits."""

NUM_READINGS = 1 + len(NUMBERS)


class ReadingTokens(nn.Module):
    """The heads' readings as tokens: one for all words, one for each number.

    Args:
        dim: Width D of the tokens.
    """

    unit: Tensor
    periods: Tensor

    def __init__(self, dim: int) -> None:
        super().__init__()
        num_words = sum(len(names) for names in CLASSES.values()) + 1 + len(Side)
        self.words = nn.Linear(num_words, dim)
        self.numbers = nn.ModuleList(nn.Linear(1 + 2 * len(PERIODS), dim) for _ in NUMBERS)
        self.out = nn.Linear(dim, dim)
        unit = torch.tensor([LAST_DIGIT[name] for name in NUMBERS])
        self.register_buffer("unit", unit, persistent=False)
        self.register_buffer("periods", torch.tensor(PERIODS), persistent=False)

    def forward(self, readings: HeadsOutput) -> Tensor:
        """Output of ``StateHeads`` to tokens (B, 1 + 5, D)."""
        logits, numbers, touching, cut = readings[:4]
        classes = [scores.softmax(-1) for scores in logits]
        words = torch.cat([*classes, touching.sigmoid()[:, None], cut.sigmoid()], dim=-1)
        features = self.features(numbers)
        tokens = [self.words(words)]
        tokens += [layer(features[:, i]) for i, layer in enumerate(self.numbers)]
        return self.out(F.gelu(torch.stack(tokens, dim=1)))

    def features(self, numbers: Tensor) -> Tensor:
        """Transformed numbers (B, 5) beside the sines and cosines of their phases: (B, 5, 9)."""
        digits = restored(numbers) / self.unit
        phases = 2 * math.pi * digits[..., None] / self.periods
        return torch.cat([numbers[..., None], phases.sin(), phases.cos()], dim=-1)
