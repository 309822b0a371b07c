"""Seeds on all cores: results in order, and one line when a process is killed."""

import os
import signal

import pytest
from rich.console import Console

from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.pool import each_result

CONSOLE = Console(quiet=True)


def squared_or_killed(seed: int) -> int:
    if seed == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    return seed * seed


def test_results_come_in_the_order_of_their_seeds_and_a_killed_process_is_told_in_one_line():
    results = each_result(CONSOLE, "squares", squared_or_killed, range(9), workers=1)
    assert [next(results) for _ in range(3)] == [0, 1, 4]
    with pytest.raises(UsageError, match=r"was killed .*--resume") as caught:
        next(results)
    assert "\n" not in str(caught.value)
