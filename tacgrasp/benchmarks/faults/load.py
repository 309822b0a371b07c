"""A load on all processor cores: child processes that only count."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

SPINNERS_PER_CORE = 2
"""Our choice: with one, the scheduler still finds a free slice for every other thread."""


@contextmanager
def busy_cores(wanted: bool) -> Iterator[Sequence[subprocess.Popen[bytes]]]:
    """Keep all cores busy inside the ``with``, if wanted; gives the processes that do it."""
    number = SPINNERS_PER_CORE * len(os.sched_getaffinity(0)) if wanted else 0
    # A pipe that closes with this process ends a spinner that outlives it.
    code = "import threading,sys,os\nthreading.Thread(target=lambda:(sys.stdin.read(),os._exit(0)))"
    command = [sys.executable, "-c", f"{code}.start()\nwhile True: pass"]
    spinners = [subprocess.Popen(command, stdin=subprocess.PIPE) for _ in range(number)]
    try:
        yield spinners
    finally:
        for spinner in spinners:
            spinner.kill()
            if spinner.stdin is not None:
                spinner.stdin.close()
            spinner.wait()
