"""Shards made by the workers of a dask.distributed cluster.

A shard travels back as the bytes of its two files, so that the machines share no disk. A worker
that dies loses the shards that it was making, which others make again; a worker that joins is given
some. Shards depend on the recipe and their number alone, so that none of this changes a byte.

Not here: files and progress (``tacgrasp.datasets.generate``).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import islice
from typing import Any

import torch

from cltp.data.dataset_writer import PackedShard
from cltp.errors import TouchError
from tacgrasp.base.errors import UsageError
from tacgrasp.base.worker_pool import one_thread
from tacgrasp.datasets.recipes import DatasetRecipe, make_packed

RETRIES = 10
"""Number of times that a shard is tried again after the death of its worker or an error."""

CONNECT_S = 20
AHEAD = 4
"""Shards under way for each thread of the cluster: enough to keep it busy, few enough for the
memory of this machine."""


@contextmanager
def cluster_at(address: str) -> Iterator[Cluster]:
    """Connect to the scheduler at an address.

    Raises:
        UsageError: dask.distributed is not installed, or no scheduler answers.
    """
    try:
        from distributed import Client
    except ImportError:
        raise UsageError(
            "--on needs dask.distributed, which is not installed: pip install 'tacgrasp[scale]'"
        ) from None
    try:
        client = Client(address, timeout=CONNECT_S, set_as_default=False)
    except (OSError, ValueError) as error:
        raise UsageError(
            f"--on {address}: no scheduler answers within {CONNECT_S} s ({error}); start one with "
            "'dask scheduler' and give the address that it prints"
        ) from None
    with client:
        yield Cluster(address=address, client=client)


@dataclass(frozen=True, slots=True, kw_only=True)
class Cluster:
    """A connection to a scheduler, ``client``, at an address."""

    address: str
    client: Any

    def make(
        self, plan: DatasetRecipe, jobs: Sequence[tuple[int, int]]
    ) -> Iterator[tuple[int, PackedShard]]:
        """Make shards; yields number and bytes of each as it arrives.

        Args:
            plan: The recipe.
            jobs: Number of each shard and of its contacts.

        Raises:
            TouchError: A worker has other software, or the cluster fails to make a shard.
        """
        from distributed import as_completed

        left, numbers = iter(jobs), {}

        def submitted(job: tuple[int, int]) -> Any:
            facts = plan.about(), torch.__version__
            future = self.client.submit(
                make_remotely, plan, *facts, *job, retries=RETRIES, pure=False
            )
            numbers[future.key] = job[0]
            return future

        threads = sum(self.client.nthreads().values())
        first = [submitted(job) for job in islice(left, AHEAD * max(threads, 1))]
        waiting = as_completed(first, loop=self.client.loop)
        for future in waiting:
            number = numbers.pop(future.key)
            try:
                shard = future.result()
            except TouchError:
                raise
            except Exception as error:  # whatever a worker raised, or KilledWorker
                raise TouchError(
                    f"the cluster at {self.address} failed to make shard {number}: {error}; the "
                    "same command goes on from there"
                ) from error
            future.release()
            yield number, shard
            for job in islice(left, 1):
                waiting.add(submitted(job))


def make_remotely(
    plan: DatasetRecipe, about: dict[str, str], torch_version: str, number: int, count: int
) -> PackedShard:
    """Make a shard on a worker; refuse to with software that would give other bytes."""
    if plan.about() != about or torch.__version__ != torch_version:
        raise TouchError(
            f"a worker of the cluster has torch {torch.__version__} and recipe {plan.about()}; "
            f"expected torch {torch_version} and recipe {about}: install the same "
            "version of tacgrasp"
        )
    one_thread()  # the bytes depend on the number of threads
    return make_packed(plan, number, count)
