"""The processes that train together: the device and the precision of each.

A single process needs no setup. Several are started by ``accelerate launch`` (or torchrun) around
the same command; each takes its part of every batch, negatives are gathered
(``cltp.encoder.all_gather``), gradients are averaged, and the first process alone writes files.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from typing import Any

import torch

from cltp.errors import TouchError

_log = logging.getLogger(__name__)

PRECISIONS = ("no", "bf16")


@dataclass(frozen=True, slots=True, kw_only=True)
class Workers:
    """This process and the others; by default one process on the accelerator, else on the CPU.

    Attributes:
        device: Device of this process.
        index: Number of this process, from 0.
        count: Number of processes.
        wait: Returns when all processes have called it.
        precision: Out of ``PRECISIONS``.
        autocast: A context in which matrix products are computed in this precision.
    """

    device: torch.device = field(
        default_factory=lambda: torch.device("cuda" if torch.cuda.is_available() else "cpu")
    )
    index: int = 0
    count: int = 1
    wait: Callable[[], None] = lambda: None
    precision: str = "no"
    autocast: Callable[[], AbstractContextManager[Any]] = nullcontext

    @property
    def is_first(self) -> bool:
        """Whether this process writes files and reports."""
        return self.index == 0

    def per_process(self, batch_size: int) -> int:
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
        """Number of this process's part of a step's batch, over the parts of all steps."""
        return step * self.count + self.index


def joined_workers(precision: str = "no") -> Workers:
    """The workers that accelerate finds in the environment; a single one when none are there.

    Args:
        precision: ``no`` (32 bits) or ``bf16``.

    Raises:
        TouchError: An unknown precision.
    """
    if precision not in PRECISIONS:
        raise TouchError(f"unknown precision {precision!r}; known: {', '.join(PRECISIONS)}")
    from accelerate import Accelerator  # its import takes a second

    accelerator = Accelerator(mixed_precision=precision, cpu=not torch.cuda.is_available())
    if precision == "bf16" and accelerator.device.type == "cpu" and (times := bf16_slowdown()) > 1:
        _log.warning(
            "products of matrices in bf16 take %.1f times as long as in 32 bits on this processor; "
            "--precision no is faster, and needs a folder of its own",
            times,
        )
    return Workers(
        device=accelerator.device,
        index=accelerator.process_index,
        count=accelerator.num_processes,
        wait=accelerator.wait_for_everyone,
        precision=precision,
        autocast=accelerator.autocast,
    )


def bf16_slowdown() -> float:
    """How many times as long as in 32 bits a product of matrices takes in bf16, measured here.

    Processors without instructions for it take ten times as long, others about half the time.
    """
    times_s = []
    for dtype in (torch.bfloat16, torch.float32):
        matrix = torch.ones(512, 512, dtype=dtype)
        times_s.append(min(_product_s(matrix) for _ in range(4)))
    return times_s[0] / times_s[1]


def _product_s(matrix: torch.Tensor) -> float:
    begin_s = time.perf_counter()
    _ = matrix @ matrix
    return time.perf_counter() - begin_s
