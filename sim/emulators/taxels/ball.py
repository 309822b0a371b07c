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

    def along_mm(self) -> NDArray[np.float32]:
        """Displacements along the gel, (rows, columns, 2) [mm], with 5 µm of noise.

        The gel follows sideways where it is pressed, to and fro by a tenth of its depth.
        """
        phase = self._phase()
        depth = self._depth_mm(phase)
        along = np.stack([0.1 * np.cos(phase) * depth, np.zeros_like(depth)], axis=2)
        return self._noisy(along)

    def height_mm(self) -> NDArray[np.float32]:
        """Heights [mm]: 0.3 to 0.9 mm deep, with 5 µm of noise."""
        return self._noisy(self._depth_mm(self._phase()))

    def _phase(self) -> float:
        return 2 * np.pi * (self._clock() - self._began) / self.PERIOD_S

    def _depth_mm(self, phase: float) -> NDArray[np.float64]:
        return np.clip(self._ball_mm + 0.6 + 0.3 * np.sin(phase), 0, None)

    def _noisy(self, clean_mm: NDArray[np.float64]) -> NDArray[np.float32]:
        return (clean_mm + self._rng.normal(0, 0.005, clean_mm.shape)).astype(np.float32)
