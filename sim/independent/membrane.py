"""A gel as independent springs under a stretched membrane, pressed by a rigid body.

The deflection u [mm] is the least energy k u²/2 + T |∇u|²/2 over the gel that leaves no body inside
it. Outside a contact it decays as exp(-r / l), l = √(T / k). There is no rise beside a contact, and
no coupling through the volume: this differs from the elastic layer of ``sim.gel`` on purpose.

Source: Winkler foundation with a membrane (Filonenko-Borodich), any text on foundations. Solved by
projected successive over-relaxation (Cryer 1971).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cltp.tactile.cloud import FloatArray

_TOLERANCE_MM = 2e-5
_MAX_SWEEPS = 600


@dataclass(frozen=True, slots=True, kw_only=True)
class MembraneGel:
    """Properties of a gel.

    Attributes:
        decay_mm: Length over which the deflection beside a contact falls to 1/e [mm].
        springs_n_per_mm3: Pressure over deflection of the springs [N/mm² per mm].
    """

    decay_mm: float
    springs_n_per_mm3: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> MembraneGel:
        """Draw a gel; both ranges are our choice: the profile beside a real ball ends in 2 mm."""
        return cls(decay_mm=rng.uniform(0.35, 0.8), springs_n_per_mm3=rng.uniform(0.10, 0.25))


@dataclass(frozen=True, slots=True, kw_only=True)
class MembranePress:
    """A solved press.

    Attributes:
        height_mm: Shape (H, W), indentation [mm].
        pressure_kpa: Same shape, 0 where the body does not touch [kPa].
    """

    height_mm: FloatArray
    pressure_kpa: FloatArray


def press(gap_mm: FloatArray, depth_mm: float, gel: MembraneGel, pitch_mm: float) -> MembranePress:
    """Press a body into a gel.

    Args:
        gap_mm: Shape (H, W), depth of the body's surface behind its foremost point [mm].
        depth_mm: Path of the body into the gel [mm].
        gel: The gel.
        pitch_mm: Pitch of the grid [mm].

    Raises:
        ValueError: The depth is not positive.
    """
    if not 0 < depth_mm < math.inf:
        raise ValueError(f"a press needs a depth above 0 mm, got {depth_mm}")
    body = depth_mm - gap_mm
    coupling = (gel.decay_mm / pitch_mm) ** 2
    # The spectral radius of the unprojected Jacobi step gives the best over-relaxation.
    radius = 4 * coupling / (1 + 4 * coupling)
    relaxation = 2 / (1 + math.sqrt(1 - radius**2))
    padded = np.pad(np.maximum(body, 0.0), 1, mode="edge")
    for _ in range(_MAX_SWEEPS):
        if _sweep(padded, body, coupling, relaxation) < _TOLERANCE_MM:
            break
    inner = padded[1:-1, 1:-1]
    touching = inner <= body
    load = np.where(touching, inner - coupling * _laplacian(padded), 0.0)
    return MembranePress(
        height_mm=inner.copy(),
        # A point held up by its neighbours alone keeps a load of rounding size: still contact.
        pressure_kpa=np.where(touching, 1e3 * gel.springs_n_per_mm3 * load.clip(min=1e-6), 0.0),
    )


def _sweep(padded: FloatArray, body: FloatArray, coupling: float, relaxation: float) -> float:
    """Relax all points once, in four interleaved grids; the largest change [mm]."""
    inner, largest = padded[1:-1, 1:-1], 0.0
    for row, column in ((0, 0), (1, 1), (0, 1), (1, 0)):
        _close(padded)
        points = (slice(row, None, 2), slice(column, None, 2))
        old = inner[points]
        neighbours = (
            padded[:-2, 1:-1][points]
            + padded[2:, 1:-1][points]
            + padded[1:-1, :-2][points]
            + padded[1:-1, 2:][points]
        )
        free = coupling / (1 + 4 * coupling) * neighbours
        new = np.maximum(body[points], old + relaxation * (free - old))
        largest = max(largest, float(np.abs(new - old).max()))
        inner[points] = new
    _close(padded)
    return largest


def _close(padded: FloatArray) -> None:
    """No slope across the border."""
    padded[0], padded[-1] = padded[1], padded[-2]
    padded[:, 0], padded[:, -1] = padded[:, 1], padded[:, -2]


def _laplacian(padded: FloatArray) -> NDArray[np.float64]:
    inner = padded[1:-1, 1:-1]
    sides = padded[:-2, 1:-1] + padded[2:, 1:-1] + padded[1:-1, :-2] + padded[1:-1, 2:]
    return np.asarray(sides - 4 * inner)
