"""Worker processes that share the cores, one thread each, and end with whoever started them.

Not here: what they do. Loads torch in the workers alone.
"""

from __future__ import annotations

import multiprocessing
import os
import threading
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager


def num_cores() -> int:
    """Number of cores that this process may use."""
    return len(os.sched_getaffinity(0))


@contextmanager
def worker_pool(workers: int | None = None) -> Iterator[ProcessPoolExecutor]:
    """A pool that is ended on every way out of the block; what has not begun is then cancelled.

    When this process is killed, each worker ends at once by itself.

    Args:
        workers: Number of processes; None for one a core.
    """
    spawn = multiprocessing.get_context("spawn")  # torch's threads don't survive a fork
    pool = ProcessPoolExecutor(workers or num_cores(), mp_context=spawn, initializer=_start_worker)
    try:
        yield pool
    finally:
        pool.shutdown(cancel_futures=True)


def one_thread() -> None:
    """Keep this process to one thread: several that wait for each other cost much time."""
    import torch

    torch.set_num_threads(1)
    os.environ["OMP_NUM_THREADS"] = "1"


def _start_worker() -> None:
    threading.Thread(target=_end_with_parent, daemon=True).start()  # first: torch loads for seconds
    one_thread()


def _end_with_parent() -> None:
    """End the worker when its parent is killed; it would wait for work for ever."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
