"""Worker processes that share the cores, one thread each, and end with whoever started them.

Not here: what they do. Loads torch in the workers alone.
"""

from __future__ import annotations

import multiprocessing
import os
import threading
from collections.abc import Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager


def num_cores() -> int:
    """Number of cores that this process may use."""
    return len(os.sched_getaffinity(0))


THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
"""Variables that bound the threads of numpy, scipy and torch in a process."""


@contextmanager
def worker_pool(workers: int | None = None) -> Iterator[ProcessPoolExecutor]:
    """A pool that is ended on every way out of the block; what has not begun is then cancelled.

    When this process is killed, each worker ends at once by itself.

    Args:
        workers: Number of processes; None for one a core.
    """
    spawn = multiprocessing.get_context("spawn")  # torch's threads don't survive a fork
    with _inherited(dict.fromkeys(THREADS, "1")):
        pool = ProcessPoolExecutor(
            workers or num_cores(), mp_context=spawn, initializer=_start_worker
        )
        try:
            yield pool
        finally:
            pool.shutdown(cancel_futures=True)


@contextmanager
def _inherited(variables: Mapping[str, str]) -> Iterator[None]:
    """Set variables of the environment for processes that start in the block.

    numpy's threads are counted as it is imported, before any code of a worker can say how many.
    """
    before = {name: os.environ.get(name) for name in variables}
    os.environ.update(variables)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


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
