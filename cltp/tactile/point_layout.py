"""Layout of a cloud's points on the sensing area: even, or contact-adaptive.

The points form a lattice of n × n cells with one point in each. In an even layout all cells are
alike (the paper's uniform sampling). In a contact-adaptive layout rows and columns lie closer
together where heights stand out: neighbours in the lattice stay neighbours, and the positions of
the points carry the local density. Loads no torch.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from cltp.errors import TouchError
from cltp.tactile.encoder_input import LATTICE

LEAST_MM = 0.1
"""A height map that stays below this counts as untouched: its noise attracts no points."""

_RISE = (0.1, 0.4)
"""Fractions of the largest height between which the weight of a row rises from 0 to 1. Our choice:
a ball's contact ends at half of its depth (Hertz), a flat punch's at nearly all of it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sampling:
    """Layout of points.

    Attributes:
        side: Rows and columns of the lattice; ``side``² points.
        contact_fraction: Fraction of rows and columns, 0 to below 1, that goes to the contact; the
            others are spread evenly.

    Raises:
        TouchError: A value is out of range.
    """

    side: int = LATTICE
    contact_fraction: float = 0.0

    def __post_init__(self) -> None:
        if self.side < 2 or not 0 <= self.contact_fraction < 1:
            raise TouchError(f"a lattice needs a side of 2 and a fraction in [0, 1), got {self}")

    @property
    def adaptive(self) -> bool:
        """Whether the layout depends on the heights."""
        return self.contact_fraction > 0

    def positions(
        self, height_mm: NDArray[np.floating], rng: np.random.Generator
    ) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Positions as fractions of the sensing area from its top left, jittered in their cells.

        An adaptive layout follows the heights (H, W) [mm] as the sensor reports them, with noise.

        Returns:
            u (side²,) to the right and v (side²,) downwards, row by row.
        """
        row, column = _cells(self.side)
        jitter = rng.random((2, self.side**2), np.float32)
        u, v = (column + jitter[0]) / self.side, (row + jitter[1]) / self.side
        if not self.adaptive:
            return u, v
        return self._adapted(u, height_mm.max(axis=0)), self._adapted(v, height_mm.max(axis=1))

    def _adapted(
        self, even: NDArray[np.float32], profile_mm: NDArray[np.floating]
    ) -> NDArray[np.float32]:
        """Even fractions of an axis, moved to where the profile along that axis stands out."""
        low, high = np.array(_RISE) * max(float(profile_mm.max()), LEAST_MM)
        weight = np.clip((profile_mm - low) / (high - low), 0, 1)
        total = float(weight.sum())
        if total == 0 or float(profile_mm.max()) < LEAST_MM:
            return even
        spread_evenly = (1 - self.contact_fraction) / len(weight)
        density = spread_evenly + self.contact_fraction * weight / total
        cumulative = np.concatenate([[0.0], np.cumsum(density)])
        ends = np.linspace(0, 1, len(cumulative))
        return np.interp(even, cumulative / cumulative[-1], ends).astype(np.float32)


@lru_cache(maxsize=4)
def _cells(side: int) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    row, column = (a.ravel().astype(np.float32) for a in np.mgrid[0:side, 0:side])
    return row, column


EVEN = Sampling()
"""The paper's: 1024 points, uniformly."""

CONTACT_ADAPTIVE = Sampling(contact_fraction=0.6)
"""1024 points, most of them in the contact."""

FINE = Sampling(side=2 * LATTICE)
"""4096 points, uniformly."""
