"""Quantile loss of intervals, and the factor that makes them hold what they shall hold.

Source: conformalized quantile regression, Romano, Patterson and Candès, 2019, with a factor where
they have a term.
"""

from __future__ import annotations

import torch
from torch import Tensor

COVERAGE = 0.9
"""Fraction of contacts whose true number lies in its interval."""


def pinball(errors: Tensor, margins: Tensor) -> Tensor:
    """Quantile loss of the two ends of margins (..., 2) around errors (...): shape (...)."""
    tail = (1 - COVERAGE) / 2
    below, above = -errors - margins[..., 0], errors - margins[..., 1]  # both positive outside
    ends = torch.stack([below, above])
    return torch.maximum((1 - tail) * ends, -tail * ends).sum(0)


def widening(errors: Tensor, margins: Tensor) -> Tensor:
    """Factor on each number's margins that makes them hold ``COVERAGE`` of the errors.

    Args:
        errors: Truth less value of N contacts, shape (N, K).
        margins: How far the intervals reach below and above, shape (N, K, 2).

    Returns:
        Shape (K,).
    """
    below, above = (margins + 1e-9).unbind(-1)
    needed = torch.maximum(-errors / below, errors / above)
    rank = min(1.0, COVERAGE * (1 + 1 / len(needed)))
    return needed.quantile(rank, dim=0)
