"""Seeds of a benchmark on all cores.

Not here: what is done with a seed.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import TypeVar

from rich.console import Console
from rich.progress import Progress

from tacgrasp.benchmarks.figures import one_thread

T = TypeVar("T")


def map_seeds(
    console: Console, name: str, function: Callable[[int], T], seeds: Sequence[int]
) -> list[T]:
    """Results of a function for each seed, in their order, from one process a core.

    Args:
        console: Shows the progress when it is a terminal.
        name: Words beside the progress bar.
        function: A function of a module, or a partial of one; sent to the processes.
        seeds: Random seeds.
    """
    results: list[T] = []
    # spawned, not forked: torch's threads don't survive a fork
    with (
        ProcessPoolExecutor(os.cpu_count(), get_context("spawn"), initializer=one_thread) as pool,
        Progress(console=console, disable=not console.is_terminal) as progress,
    ):
        task = progress.add_task(name, total=len(seeds))
        for result in pool.map(function, seeds, chunksize=1 + len(seeds) // 200):
            results.append(result)
            progress.advance(task)
    return results
