"""Seeds of a benchmark on all cores.

Not here: what is done with a seed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures.process import BrokenProcessPool
from typing import TypeVar

from rich.console import Console
from rich.progress import Progress

from tacgrasp.base.errors import UsageError
from tacgrasp.base.worker_pool import worker_pool

T = TypeVar("T")


def each_result(
    console: Console,
    name: str,
    function: Callable[[int], T],
    seeds: Sequence[int],
    *,
    workers: int | None = None,
) -> Iterator[T]:
    """Results of a function for each seed, in their order, from one process a core.

    Args:
        console: Shows the progress when it is a terminal.
        name: Words beside the progress bar.
        function: A function of a module, or a partial of one; sent to the processes.
        seeds: Random seeds, or other numbers.
        workers: Number of processes; None for one a core.

    Raises:
        UsageError: A process was killed from outside.
    """
    with (
        worker_pool(workers) as pool,
        Progress(console=console, disable=not console.is_terminal) as progress,
    ):
        task = progress.add_task(name, total=len(seeds))
        try:
            for result in pool.map(function, seeds, chunksize=1 + min(len(seeds) // 200, 9)):
                yield result
                progress.advance(task)
        except BrokenProcessPool:
            raise UsageError(
                "a process of the benchmark was killed (out of memory?); free memory, then start "
                "it again, with --resume where it has that"
            ) from None
