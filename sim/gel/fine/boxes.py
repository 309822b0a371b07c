"""Boxes that hold contacts within a field, so that only they need to be solved finely.

Not here: solving (``sim.gel.fine.fine``).
"""

from __future__ import annotations

from dataclasses import dataclass

from scipy.fft import next_fast_len
from torch import Tensor

_MARGIN_CELLS = 2  # of the coarser grid, around its contact
_STEP_CPU, _STEP_DEVICE = 16, 80  # an accelerator wants few sizes, and many contacts of each
_OVERLAP_MM = 2e-4  # outside of a box; a fifth of what is stored


@dataclass(frozen=True, slots=True, kw_only=True)
class Box:
    """Part of a grid: first row and column, and how many."""

    top: int
    left: int
    rows: int
    columns: int

    def crop(self, field: Tensor) -> Tensor:
        """That part of a field (..., H, W)."""
        return field[..., self.top : self.top + self.rows, self.left : self.left + self.columns]


def boxes_around(contact: Tensor) -> list[Box]:
    """Boxes on the next finer grid around contacts (B, h, w); the whole of it where there is none.

    Sizes go by steps, so that few spectra are needed, and that many share one; steps are as many as
    a Fourier transform likes.
    """
    step = _STEP_CPU if contact.device.type == "cpu" else _STEP_DEVICE
    row_spans = _spans(contact.any(2).cpu(), step)
    column_spans = _spans(contact.any(1).cpu(), step)
    return [
        Box(top=vertical[0], rows=vertical[1], left=horizontal[0], columns=horizontal[1])
        for vertical, horizontal in zip(row_spans, column_spans, strict=True)
    ]


def _spans(mask: Tensor, step: int) -> list[tuple[int, int]]:
    """First element and length on the finer grid that hold each row of ``on`` (B, n)."""
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


def by_size(boxes: list[Box], *, one_by_one: bool) -> list[tuple[tuple[int, int], list[int]]]:
    """Contacts whose boxes are equally large; on a processor one by one, which fits its cache."""
    if one_by_one:
        return [((box.rows, box.columns), [i]) for i, box in enumerate(boxes)]
    groups: dict[tuple[int, int], list[int]] = {}
    for i, box in enumerate(boxes):
        groups.setdefault((box.rows, box.columns), []).append(i)
    return list(groups.items())


def escaped_from(boxes: list[Box], opening: Tensor) -> Tensor:
    """Which contacts overlap their bodies outside of their boxes, (B,).

    Args:
        boxes: Of the contacts.
        opening: Deformed gap, (B, H, W) [mm].
    """
    overlap = opening < -_OVERLAP_MM
    for box, one in zip(boxes, overlap, strict=True):
        box.crop(one).fill_(False)
    return overlap.flatten(1).any(1)
