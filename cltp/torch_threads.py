"""How many threads torch computes on, for a while."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import torch


@contextmanager
def torch_threads(count: int = 1) -> Iterator[None]:
    """Let torch compute on ``count`` threads; also a decorator.

    One thread suits work that is too small to share: on a busy machine, threads that wait for each
    other have taken twenty times as long. The order of sums, and so the last bits of a result,
    depends on the number of threads.
    """
    before = torch.get_num_threads()
    torch.set_num_threads(count)
    try:
        yield
    finally:
        torch.set_num_threads(before)
