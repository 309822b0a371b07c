"""Workers end with the process that started them, however it ends."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tacgrasp.base.worker_pool import THREADS, worker_pool
from tests.paths import ROOT

LONGEST_S = 5.0
"""Time within which no worker may be left [s]."""

BENCHMARK = ["bench", "strawberry", "--episodes", "4000", "--policies", "rules"]


def children(pid: int) -> set[int]:
    """All processes below one."""
    direct: set[int] = set()
    for task in Path(f"/proc/{pid}/task").glob("*/children"):
        direct |= {int(child) for child in task.read_text().split()}
    return direct.union(*map(children, direct))


def is_alive(pid: int) -> bool:
    try:
        status = Path(f"/proc/{pid}/stat").read_text()
    except FileNotFoundError:
        return False
    return status.rpartition(")")[2].split()[0] != "Z"


def wait_for_workers(process: subprocess.Popen[bytes], count: int) -> set[int]:
    """Processes below a benchmark once its workers (and a helper of multiprocessing) run."""
    for _ in range(300):
        found = children(process.pid)
        if len(found) > count:
            return found
        time.sleep(0.1)
    raise AssertionError(f"{len(found)} processes instead of more than {count}")


@pytest.mark.parametrize(
    ("number", "wait_s"),
    [
        pytest.param(signal.SIGTERM, 3.0, id="terminated at work"),
        pytest.param(signal.SIGKILL, 0.0, id="killed while they start"),
    ],
)
def test_a_benchmark_that_is_ended_leaves_no_worker_behind(number: int, wait_s: float) -> None:
    with subprocess.Popen(
        [sys.executable, "-m", "tacgrasp", *BENCHMARK],
        cwd=ROOT,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    ) as process:
        workers = wait_for_workers(process, len(os.sched_getaffinity(0)))
        time.sleep(wait_s)
        process.send_signal(number)
        deadline = time.monotonic() + LONGEST_S
        left = workers
        while left and time.monotonic() < deadline:
            time.sleep(0.1)
            left = {pid for pid in workers if is_alive(pid)}
        process.kill()
    for pid in left:
        os.kill(pid, signal.SIGKILL)
    assert not left


def test_an_error_in_the_block_cancels_what_has_not_begun() -> None:
    began = time.monotonic()
    with pytest.raises(RuntimeError, match="enough"), worker_pool(1) as pool:
        futures = [pool.submit(time.sleep, 0.2) for _ in range(1000)]
        futures[0].result()
        raise RuntimeError("enough")
    assert time.monotonic() - began < 60  # of 200 s in all
    assert futures[-1].cancelled()


def num_threads() -> int:
    """Threads of this process once numpy has multiplied matrices."""
    import numpy as np

    square = np.ones((300, 300))
    assert (square @ square).shape == square.shape
    return len(list(Path("/proc/self/task").iterdir()))


def variables() -> dict[str, str | None]:
    return {name: os.environ.get(name) for name in THREADS}


def test_each_worker_multiplies_with_one_thread_and_the_environment_is_left_as_it_was(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.delenv(THREADS[0], raising=False)
    monkeypatch.setenv(THREADS[1], "7")
    before = variables()
    with worker_pool(1) as pool:
        assert set(pool.submit(variables).result().values()) == {"1"}
        assert pool.submit(num_threads).result() <= 2  # one more waits for the parent's end
    assert variables() == before
