"""Where on the field a cloud has its points: evenly, or more of them where the gel is pressed.

A lattice of n × n cells with one point in each. Evenly, all cells are alike (the paper's uniform
sampling). Otherwise rows and columns crowd where heights stand out: the lattice stays a lattice,
whose neighbours are known, and the points say by their places how near to each other they are.
Loads no torch.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from cltp.errors import TouchError
from cltp.tactile.encoder_input import LATTICE

LEAST_MM = 0.1
"""A field whose heights stay below this is taken for untouched: its noise draws no points."""

_RISE = (0.1, 0.4)
"""Shares of the largest height between which a row comes to count as pressed. Our choice: a ball's
contact ends at half of its depth (Hertz), a flat punch's at nearly all of it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sampling:
    """How points are laid out.

    Attributes:
        side: Rows and columns of the lattice; ``side``² points.
        pressed: Share of them, 0 to below 1, that goes to rows and columns that are pressed; the
            others are spread evenly.

    Raises:
        TouchError: A value is out of range.
    """

    side: int = LATTICE
    pressed: float = 0.0

    def __post_init__(self) -> None:
        if self.side < 2 or not 0 <= self.pressed < 1:
            raise TouchError(f"a lattice needs a side of 2 and a share in [0, 1), got {self}")

    def places(
        self, height_mm: NDArray[np.floating], rng: np.random.Generator
    ) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Places on the field as shares from its top left, jittered inside their cells.

        Args:
            height_mm: Shape (H, W), as the sensor sees it: what is not seen draws no points [mm].
            rng: Of the jitter.

        Returns:
            u (side²,) to the right and v (side²,) downwards, row by row.
        """
        row, column = _cells(self.side)
        jitter = rng.random((2, self.side**2), np.float32)
        u, v = (column + jitter[0]) / self.side, (row + jitter[1]) / self.side
        if self.pressed == 0:
            return u, v
        return self._crowded(u, height_mm.max(axis=0)), self._crowded(v, height_mm.max(axis=1))

    def _crowded(
        self, even: NDArray[np.float32], profile_mm: NDArray[np.floating]
    ) -> NDArray[np.float32]:
        """Shares of an even axis, moved to where the profile along that axis stands out."""
        low, high = np.array(_RISE) * max(float(profile_mm.max()), LEAST_MM)
        weight = np.clip((profile_mm - low) / (high - low), 0, 1)
        total = float(weight.sum())
        if total == 0 or float(profile_mm.max()) < LEAST_MM:
            return even
        density = (1 - self.pressed) / len(weight) + self.pressed * weight / total
        passed = np.concatenate([[0.0], np.cumsum(density)])
        ends = np.linspace(0, 1, len(passed))
        return np.interp(even, passed / passed[-1], ends).astype(np.float32)


@lru_cache(maxsize=4)
def _cells(side: int) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    row, column = (a.ravel().astype(np.float32) for a in np.mgrid[0:side, 0:side])
    return row, column


EVEN = Sampling()
"""The paper's: 1024 points, uniformly."""

PRESSED = Sampling(pressed=0.6)
"""As many points, most of them in the contact."""

FINE = Sampling(side=2 * LATTICE)
"""Four times as many, uniformly."""
