"""Make a data set of simulated contacts: worker processes, progress, resumable after ``kill -9``.

A recipe (``tacgrasp.datasets.recipes``) cuts the work into shards. A shard exists when its index
file does. Its bytes depend on the recipe and on its number alone, so any number of workers on any
number of machines can make the missing ones, and the result is that of an undisturbed run.
"""

from __future__ import annotations

import json
import logging
import re
from collections.abc import Iterator, Mapping
from concurrent.futures import as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import ExitStack
from pathlib import Path

from rich.console import Console

from cltp.data.dataset import ContactDataset
from cltp.data.dataset_writer import DatasetWriter, PackedShard, shard_stem
from cltp.errors import TouchError
from cltp.processor import torch_threads
from tacgrasp.base.errors import UsageError
from tacgrasp.base.folders import check_folder
from tacgrasp.base.worker_pool import num_cores, worker_pool
from tacgrasp.console import count_progress
from tacgrasp.datasets.card import write_card
from tacgrasp.datasets.cluster import Cluster, cluster_at
from tacgrasp.datasets.recipes import DatasetRecipe, make_packed, recipe
from tacgrasp.datasets.requests import GenerateRequest

log = logging.getLogger(__name__)


def generate(request: GenerateRequest, console: Console | None = None) -> None:
    """Make a data set, or the missing shards of one; a complete one is left as it is.

    Args:
        request: The set; another number of workers does not change the result, and the device
            'cuda' gives heights within 2 µm of 'cpu'.
        console: Console for the progress bar; by default standard error.

    Raises:
        UsageError: A value out of range, or a folder that holds the data of another command.
        TouchError: The folder is not a data set of this version, or can't be written.
    """
    workers = num_cores() if request.workers is None else request.workers
    if workers < 1:
        raise UsageError(f"expected at least 1 worker, got {workers}")
    if request.on is not None and request.workers is not None:
        raise UsageError("--workers is for this machine; the cluster of --on has its own workers")
    plan, out = recipe(request), request.out
    with ExitStack() as opened:
        cluster = None if request.on is None else opened.enter_context(cluster_at(request.on))
        _make_missing(plan, request, workers, cluster, console)
    command = plan.card_command()
    if command is not None and is_complete(out):
        try:
            write_card(out, command)
        except OSError as error:
            raise TouchError(f"can't write the card of {out}: {error}") from error


def _make_missing(
    plan: DatasetRecipe,
    request: GenerateRequest,
    workers: int,
    cluster: Cluster | None,
    console: Console | None,
) -> None:
    """Make the shards of a request that are not there yet."""
    out, sizes = request.out, plan.shard_sizes()
    numbers = _part_of(len(sizes), request.shard)
    _open(out, plan.about())
    _clear(out, numbers)
    jobs = [
        (out, number, sizes[number])
        for number in numbers
        if not shard_stem(out, _part(number)).with_suffix(".parquet").exists()
    ]
    with count_progress(console) as progress:
        bar = progress.add_task("contacts", total=sum(sizes[number] for number in numbers))
        progress.advance(bar, sum(sizes[n] for n in numbers) - sum(job[2] for job in jobs))
        for number in _made(jobs, plan, min(workers, len(jobs)), cluster):
            progress.advance(bar, sizes[number])


def is_complete(out: Path) -> bool:
    """Whether a folder holds all contacts of its data set.

    Raises:
        TouchError: The folder is not a data set of this version.
    """
    try:
        data = ContactDataset(out, partial=True)
    except TouchError:
        if (out / "dataset.json").exists() and not any(out.glob("shard-*.parquet")):
            return False
        raise
    return len(data) == int(data.about.get("contacts", len(data)))


def _part_of(shards: int, part: str | None) -> list[int]:
    """Numbers of the shards that this machine makes."""
    if part is None:
        return list(range(shards))
    match = re.fullmatch(r"(\d+)/(\d+)", part)
    if match is None or not 1 <= int(match[1]) <= int(match[2]):
        raise UsageError(
            f"--shard expects i/n with i from 1 to n, such as 1/4 to 4/4 on four machines, "
            f"got {part!r}"
        )
    return list(range(int(match[1]) - 1, shards, int(match[2])))


_Job = tuple[Path, int, int]
"""Folder, number of the shard, and number of its contacts."""


def _made(
    jobs: list[_Job], plan: DatasetRecipe, workers: int, cluster: Cluster | None
) -> Iterator[int]:
    """Make shards here or on a cluster; yields each one's number once it is on disk."""
    if cluster is None:
        yield from _make_shards(jobs, plan, workers)
    elif jobs:
        out = jobs[0][0]
        for number, shard in cluster.make(plan, [(n, size) for _, n, size in jobs]):
            store_shard(out, number, shard)
            yield number


def _make_shards(jobs: list[_Job], plan: DatasetRecipe, workers: int) -> Iterator[int]:
    """Make shards in this or in worker processes; yields each one's number once it is on disk."""
    if workers <= 1:
        with torch_threads():  # as in a worker: the bytes depend on the number of threads
            for job in jobs:
                yield _make_shard(job, plan)
        return
    try:
        with worker_pool(workers) as pool:
            try:
                for future in as_completed([pool.submit(_make_shard, job, plan) for job in jobs]):
                    yield future.result()
            except KeyboardInterrupt:
                log.warning("stopping, once the workers have; the same command goes on from there")
                raise
    except BrokenProcessPool as error:
        raise TouchError(
            "a worker that made contacts was killed (out of memory?); the same command goes on "
            "where it stopped, with fewer --workers if need be"
        ) from error


def _make_shard(job: _Job, plan: DatasetRecipe) -> int:
    out, number, count = job
    store_shard(out, number, make_packed(plan, number, count))
    return number


def store_shard(out: Path, number: int, shard: PackedShard) -> None:
    """Write a shard to a data set.

    Raises:
        TouchError: It can't be written.
    """
    try:
        shard.write(shard_stem(out, _part(number)))
    except OSError as error:
        raise TouchError(
            f"can't write contacts to {out}: {error}; the same command goes on from there"
        ) from error


def _open(out: Path, about: Mapping[str, str]) -> None:
    """Start a data set, or check that the folder belongs to this one.

    Raises:
        UsageError: The folder was made by another command.
        TouchError: The folder is not a data set of this version, or can't be written.
    """
    check_folder(out, "the data set")
    _check_own(out)
    try:
        DatasetWriter(out, about=about)
        stored = json.loads((out / "dataset.json").read_text()).get("about", {})
    except OSError as error:
        raise TouchError(f"can't write contacts to {out}: {error}") from error
    differing = [
        f"{name} {stored.get(name)!r} instead of {about.get(name)!r}"
        for name in sorted({*stored, *about})
        if stored.get(name) != about.get(name)
    ]
    if differing:
        raise UsageError(
            f"{out} holds the data of another command: {', '.join(differing)}; "
            "choose another folder or delete this one"
        )


def _check_own(out: Path) -> None:
    """Check that nothing of somebody else's lies in a folder that is no data set yet.

    Raises:
        UsageError: Files lie there, which shards and card would be mixed with.
        TouchError: The folder can't be read.
    """
    if not out.is_dir() or (out / "dataset.json").exists():
        return
    try:
        others = sorted(each.name for each in out.iterdir() if each.suffix != ".part")
    except OSError as error:
        raise TouchError(f"can't write contacts to {out}: {error}") from error
    if others and not others[0].startswith("shard-"):
        raise UsageError(
            f"--out {out} is no data set and holds other files ({others[0]}"
            f"{', …' if len(others) > 1 else ''}); name a new folder or an empty one"
        )


def _clear(out: Path, numbers: list[int]) -> None:
    """Remove the half-written files of these shards, and of the header.

    Another machine may be writing its own shards to the same folder.
    """
    own = {f"shard-{_part(number)}-" for number in numbers}
    try:
        for path in out.glob("*.part"):
            if path.name[:13] in own or not path.name.startswith("shard-"):
                path.unlink(missing_ok=True)
    except OSError as error:
        raise TouchError(f"can't write contacts to {out}: {error}") from error


def _part(shard: int) -> str:
    return f"s{shard:05d}"
