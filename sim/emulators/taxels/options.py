"""Options of the emulated taxel array."""

from __future__ import annotations

from dataclasses import dataclass

MAX_SIDE = 255
"""Most rows or columns: any such grid fits into a packet (``cltp.sensing.taxel_packets``)."""

MAX_RATE_HZ = 200.0


@dataclass(frozen=True, slots=True, kw_only=True)
class TaxelOptions:
    """A serial taxel array with a ball pressed into it.

    Attributes:
        rows: rows of the grid
        columns: columns of the grid
        rate_hz: frames per second
        seed: random seed of the height noise
        shear: send displacements along the gel too, in packets of version 2
    """

    rows: int = 60
    columns: int = 80
    rate_hz: float = 30.0
    seed: int = 0
    shear: bool = False

    def __post_init__(self) -> None:
        given = f"{self.rows} and {self.columns}"
        if not (1 <= self.rows <= MAX_SIDE and 1 <= self.columns <= MAX_SIDE):
            raise ValueError(f"--rows and --columns must be 1 to {MAX_SIDE}, got {given}")
        if not 1 <= self.rate_hz <= MAX_RATE_HZ:
            given = f"{self.rate_hz:g}"
            raise ValueError(f"--rate-hz: an array sends 1 to 200 frames a second, got {given}")
        if self.seed < 0:
            raise ValueError(f"--seed must be 0 or more, got {self.seed}")
