import gc
import os

# Models this small lose by sharing a step among threads. Before torch, and for every child process.
os.environ.setdefault("OMP_NUM_THREADS", "1")

import signal
from collections.abc import Iterator

import pytest
import torch
from hypothesis import settings

# A busy machine fails no test. The same code meets the same examples: a red test is the change's.
settings.register_profile("repeatable", deadline=None, derandomize=True)
settings.load_profile("repeatable")


def pytest_collection_finish() -> None:
    """What was imported and collected stays: no search for garbage goes through it again."""
    gc.collect()
    gc.freeze()


@pytest.fixture(scope="session", autouse=True)
def ctrl_c_is_heard() -> Iterator[None]:
    """A shell starts what runs in its background deaf to Ctrl-C, and what that starts in turn."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture(scope="module")
def threads_as_before() -> Iterator[None]:
    """Commands set the number of threads: other modules have that which they began with."""
    before = torch.get_num_threads()
    yield
    torch.set_num_threads(before)


@pytest.fixture(scope="module")
def one_thread(threads_as_before: None) -> None:
    """Models this small lose by sharing a step among threads, most of all on a busy machine."""
    torch.set_num_threads(1)
