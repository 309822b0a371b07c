"""Rigid probes by kind and size [mm]: ``ball:9.5``, ``flat:4``, ``cylinder:6``.

Not here: the catalogue of objects (``sim.objects.catalogue``), pressing (``sim.gel.layer``).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from cltp.tactile.cloud import FloatArray
from cltp.tactile.states import Shape

MIN_MM, MAX_MM = 0.2, 500.0


@dataclass(frozen=True, slots=True, kw_only=True)
class ProbeShape:
    """A rigid probe, its tip at the origin.

    Attributes:
        kind: A key of ``KINDS``.
        size_mm: Diameter, or edge of a square face [mm].

    Raises:
        ValueError: The kind is unknown, or the size out of ``MIN_MM`` to ``MAX_MM``.
    """

    kind: str
    size_mm: float

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise ValueError(f"unknown probe {self.kind!r}; known: {', '.join(KINDS)}")
        if not MIN_MM <= self.size_mm <= MAX_MM:
            raise ValueError(
                f"the size of a {self.kind} must be {MIN_MM} to {MAX_MM:g} mm, got {self.size_mm}"
            )

    @classmethod
    def named(cls, name: str) -> ProbeShape:
        """Read the name of a probe, such as ``ball:9.5``.

        Raises:
            ValueError: The name is not a kind and a size, or the kind or size is out of range.
        """
        kind, _, size = name.partition(":")
        try:
            size_mm = float(size)
        except ValueError:
            examples = ", ".join(f"{kind}:{size_name}" for kind, (size_name, _, _) in KINDS.items())
            raise ValueError(f"expected a probe such as {examples} in mm, got {name!r}") from None
        return cls(kind=kind, size_mm=size_mm)

    @property
    def shape(self) -> Shape:
        return KINDS[self.kind][1]

    def behind_mm(self, x_mm: FloatArray, y_mm: FloatArray) -> FloatArray:
        """Depth of its surface behind its tip, same shape as ``x_mm``; inf outside of it [mm]."""
        return KINDS[self.kind][2](x_mm, y_mm, self.size_mm)


def _cap(r: FloatArray, radius_mm: float) -> FloatArray:
    inside = np.abs(r) < radius_mm
    # (R² - r²) as (R - r)(R + r), and the height as r² / (R + ...): no cancellation near the tip.
    root = np.sqrt(np.clip((radius_mm - r) * (radius_mm + r), 0, None))
    return np.where(inside, r**2 / (radius_mm + root), np.inf)


KINDS: dict[str, tuple[str, Shape, Callable[[FloatArray, FloatArray, float], FloatArray]]] = {
    "ball": ("DIAMETER", Shape.SPHERE, lambda x, y, d: _cap(np.hypot(x, y), 0.5 * d)),
    # the side of a rod along x, longer than any sensing area
    "cylinder": ("DIAMETER", Shape.CYLINDER, lambda x, y, d: _cap(np.abs(y), 0.5 * d) + 0.0 * x),
    "flat": (
        "EDGE",
        Shape.CUBOID,
        lambda x, y, edge: np.where(np.fmax(abs(x), abs(y)) <= 0.5 * edge, 0.0, np.inf),
    ),
}
"""Of each kind: the meaning of its size, the shape label of its contact, and its surface."""
