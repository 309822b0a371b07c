"""The processes that train together: which device each has, in which precision it computes.

One process needs nothing of this. Several are started by ``accelerate launch`` (or torchrun) around
the same command; each takes its share of every batch, negatives are gathered
(``cltp.encoder.all_gather``), gradients averaged, and the first process alone writes files.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from typing import Any

import torch

from cltp.errors import TouchError

PRECISIONS = ("no", "bf16")


def _nothing() -> None:
    """What a process alone waits for."""


def _exact() -> AbstractContextManager[Any]:
    return nullcontext()


@dataclass(frozen=True, slots=True, kw_only=True)
class Workers:
    """This process and those beside it; the default is one process on the CPU or accelerator.

    Attributes:
        device: Where it computes.
        index: Its number, from 0.
        count: How many there are.
        wait: Returns when all have come here.
        autocast: A context in which matrix products are computed in the chosen precision.
    """

    device: torch.device = field(
        default_factory=lambda: torch.device("cuda" if torch.cuda.is_available() else "cpu")
    )
    index: int = 0
    count: int = 1
    wait: Callable[[], None] = _nothing
    autocast: Callable[[], AbstractContextManager[Any]] = _exact

    @property
    def is_first(self) -> bool:
        """Whether this process writes files and reports."""
        return self.index == 0

    def share(self, batch_size: int) -> int:
        """Contacts of a batch that each process takes.

        Raises:
            TouchError: The batch can't be shared evenly.
        """
        if batch_size % self.count:
            raise TouchError(
                f"a batch of {batch_size} can't be shared by {self.count} processes; "
                "choose a multiple"
            )
        return batch_size // self.count

    def part(self, step: int) -> int:
        """The number of this process's part of the batch of a step, counting parts as batches."""
        return step * self.count + self.index


def joined(precision: str = "no") -> Workers:
    """The workers that accelerate finds in the environment; alone where nothing started several.

    Args:
        precision: ``no`` (32 bits) or ``bf16``.

    Raises:
        TouchError: An unknown precision.
    """
    if precision not in PRECISIONS:
        raise TouchError(f"unknown precision {precision!r}; known: {', '.join(PRECISIONS)}")
    from accelerate import Accelerator  # a second to import, and needed here alone

    accelerator = Accelerator(mixed_precision=precision, cpu=not torch.cuda.is_available())
    return Workers(
        device=accelerator.device,
        index=accelerator.process_index,
        count=accelerator.num_processes,
        wait=accelerator.wait_for_everyone,
        autocast=accelerator.autocast,
    )
