"""A ball pressed into a gel and lifted periodically: the height source of an array without a world.

The gel takes the bare shape of the sphere, without contact mechanics.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray


class PressedBall:
    """A rigid ball of 3 mm radius; a ``sim.emulators.taxels.array.HeightSource``.

    Args:
        rows: Rows of the grid.
        columns: Columns of the grid.
        seed: Random seed of the noise.
        clock: Monotonic [s].
    """

    PITCH_MM = 0.2
    PERIOD_S = 4.0

    def __init__(
        self, rows: int, columns: int, seed: int = 0, clock: Callable[[], float] = time.monotonic
    ) -> None:
        row, column = np.mgrid[0:rows, 0:columns]
        r_mm = np.hypot(row - (rows - 1) / 2, column - (columns - 1) / 2) * self.PITCH_MM
        self._ball_mm = np.sqrt(np.clip(3.0**2 - r_mm**2, 0, None)) - 3.0
        self._rng, self._clock, self._began = np.random.default_rng(seed), clock, clock()

    def height_mm(self) -> NDArray[np.float32]:
        """Heights [mm]: 0.3 to 0.9 mm deep, with 5 µm of noise."""
        phase = 2 * np.pi * (self._clock() - self._began) / self.PERIOD_S
        clean = np.clip(self._ball_mm + 0.6 + 0.3 * np.sin(phase), 0, None)
        return (clean + self._rng.normal(0, 0.005, clean.shape)).astype(np.float32)
