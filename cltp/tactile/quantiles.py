"""Quantiles of heights, which every reading takes many of.

numpy's own take five times as long for a thousand numbers, most of it before they look at any.
Loads no torch.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

NORMAL = 1.4826
"""Standard deviation of normal noise over its median absolute deviation."""


def quantile(values: NDArray[np.floating], fraction: float) -> float:
    """A quantile of finite values of any shape, linear between neighbours.

    Args:
        values: At least one.
        fraction: 0 (the least) to 1 (the largest).
    """
    flat = values.ravel()
    below, part = divmod(fraction * (len(flat) - 1), 1)
    first = int(below)
    if not part:
        return float(np.partition(flat, first)[first])
    ends = np.partition(flat, (first, first + 1))[first : first + 2].tolist()
    return float(ends[0] + part * (ends[1] - ends[0]))


def median(values: NDArray[np.floating]) -> float:
    """Median of finite values of any shape, at least one."""
    return quantile(values, 0.5)


def spread_about(values: NDArray[np.floating], middle: float) -> float:
    """Standard deviation of normal noise by its median distance from a middle."""
    return NORMAL * median(np.abs(values - middle))
