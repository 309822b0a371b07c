"""Boxes around contacts: parts of a grid to which a fine solve is limited.

Not here: solving (``sim.gel.fine.fine``).
"""

from __future__ import annotations

from dataclasses import dataclass

from scipy.fft import next_fast_len
from torch import Tensor

_MARGIN_CELLS = 2  # elements of the coarser grid around its contact
_STEP_CPU, _STEP_DEVICE = 16, 80  # on an accelerator few sizes, with many contacts each, are faster
_OVERLAP_MM = 2e-4  # allowed outside of a box; a fifth of the stored resolution


@dataclass(frozen=True, slots=True, kw_only=True)
class Box:
    """Part of a grid: first row and column, numbers of rows and columns."""

    top: int
    left: int
    rows: int
    columns: int

    def crop(self, field: Tensor) -> Tensor:
        """That part of a grid (..., H, W)."""
        return field[..., self.top : self.top + self.rows, self.left : self.left + self.columns]


def boxes_around(contact: Tensor) -> list[Box]:
    """Boxes on the next finer grid around contacts (B, h, w); the whole grid where there is none.

    Sizes are multiples of a step, so that many contacts share a spectrum; the multiples are lengths
    that suit a Fourier transform.
    """
    step = _STEP_CPU if contact.device.type == "cpu" else _STEP_DEVICE
    row_spans = _spans(contact.any(2).cpu(), step)
    column_spans = _spans(contact.any(1).cpu(), step)
    return [
        Box(top=vertical[0], rows=vertical[1], left=horizontal[0], columns=horizontal[1])
        for vertical, horizontal in zip(row_spans, column_spans, strict=True)
    ]


def _spans(mask: Tensor, step: int) -> list[tuple[int, int]]:
    """First element and length, on the finer grid, of a span around each row of ``mask`` (B, n)."""
    size = mask.shape[1]
    spans = []
    for row in mask.numpy():
        occupied = row.nonzero()[0]
        low, high = (occupied[0], occupied[-1] + 1) if len(occupied) else (0, size)
        low, high = max(0, int(low) - _MARGIN_CELLS), min(size, int(high) + _MARGIN_CELLS)
        steps = next_fast_len(-(-2 * (high - low) // step), real=True)
        length = min(2 * size, steps * step)
        first = max(0, low + high - length // 2)
        spans.append((min(first, 2 * size - length), length))
    return spans


def escaped_from(boxes: list[Box], opening: Tensor) -> Tensor:
    """Mask of contacts that overlap their bodies outside of their boxes, (B,).

    Args:
        boxes: Boxes of the contacts.
        opening: Deformed gap, (B, H, W) [mm].
    """
    overlap = opening < -_OVERLAP_MM
    for box, one in zip(boxes, overlap, strict=True):
        box.crop(one).fill_(False)
    return overlap.flatten(1).any(1)
