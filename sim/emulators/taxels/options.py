"""Options of the emulated taxel array."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class TaxelOptions:
    """A serial taxel array with a ball pressed into it.

    Attributes:
        rows: rows of the grid
        columns: columns of the grid
        rate_hz: frames per second
        seed: random seed of the height noise
    """

    rows: int = 60
    columns: int = 80
    rate_hz: float = 30.0
    seed: int = 0
