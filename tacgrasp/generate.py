"""Make a data set of simulated contacts: worker processes, progress, resumable after ``kill -9``.

Work is cut into shards of ``SHARD_GROUPS`` groups. A shard exists when its index file does, and its
bytes depend on the seed and its number alone; so whatever is missing is made, by any number of
workers, and the result is that of an undisturbed run.

Not here: what contacts are made (``sim.contacts``), files (``cltp.dataset``).
"""

from __future__ import annotations

import contextlib
import json
import math
import multiprocessing
import os
import threading
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path

import torch
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from cltp.dataset import ContactDataset, DatasetWriter
from cltp.errors import TouchError
from cltp.sensors import sensor_named
from sim.contacts import GROUP_CONTACTS, make_group
from sim.rig import BENCHMARK_SEED
from tacgrasp.errors import UsageError

MAKER = "1"
"""Version of what is made; counted up when the same seed makes other contacts."""

SHARD_GROUPS = 5
SHARD_CONTACTS = SHARD_GROUPS * GROUP_CONTACTS


def generate(
    out: Path,
    *,
    contacts: int = 24_000,
    seed: int = 0,
    workers: int | None = None,
    sensor_name: str = "gelsight_mini",
    console: Console | None = None,
) -> None:
    """Make a data set, or what is missing of it; a complete one is left as it is.

    Args:
        out: Folder; made when missing.
        contacts: How many.
        seed: Draws everything; below ``BENCHMARK_SEED``.
        workers: Processes; by default one for each core. Does not change the result.
        sensor_name: Whose field is pressed.
        console: Where progress is shown; by default standard error.

    Raises:
        UsageError: A value makes no sense, or the folder holds the data of another command.
        TouchError: The folder is no data set of this version, or can't be written.
    """
    if workers is None:
        workers = len(os.sched_getaffinity(0))
    if contacts < 1 or not 0 <= seed < BENCHMARK_SEED or workers < 1:
        raise UsageError(
            f"expected at least 1 contact, at least 1 worker and a seed from 0 to "
            f"{BENCHMARK_SEED - 1} (larger ones are for benchmarks), got {contacts} contacts, "
            f"{workers} workers, seed {seed}"
        )
    sensor_named(sensor_name)
    _open(out, {"seed": str(seed), "contacts": str(contacts), "sensor": sensor_name})
    shards = range(math.ceil(contacts / SHARD_CONTACTS))
    missing = [shard for shard in shards if not _index_of(out, shard).exists()]
    jobs = {
        shard: (out, shard, min(SHARD_CONTACTS, contacts - shard * SHARD_CONTACTS), seed)
        for shard in missing
    }
    with _progress(console) as progress:
        bar = progress.add_task("contacts", total=contacts)
        progress.advance(bar, contacts - sum(job[2] for job in jobs.values()))
        for shard in _done(list(jobs.values()), sensor_name, min(workers, len(jobs))):
            progress.advance(bar, jobs[shard][2])


def is_complete(out: Path) -> bool:
    """Whether a folder holds all of the contacts that it was made to hold.

    Raises:
        TouchError: It is no data set of this version.
    """
    try:
        data = ContactDataset(out)
    except TouchError:
        if (out / "dataset.json").exists() and not any(out.glob("shard-*.parquet")):
            return False
        raise
    return len(data) == int(data.about.get("contacts", len(data)))


_Job = tuple[Path, int, int, int]


def _done(jobs: list[_Job], sensor_name: str, workers: int) -> Iterator[int]:
    """Make shards here or in processes of their own; yields each one's number when it is safe."""
    if workers <= 1:
        with _one_thread():
            for job in jobs:
                yield _make_shard(job, sensor_name)
        return
    spawn = multiprocessing.get_context("spawn")  # torch's threads don't survive a fork
    pool = ProcessPoolExecutor(workers, mp_context=spawn, initializer=_start_worker)
    try:
        for made in as_completed([pool.submit(_make_shard, job, sensor_name) for job in jobs]):
            yield made.result()
    except BrokenProcessPool as error:
        raise TouchError(
            "a worker that made contacts was killed (out of memory?); the same command goes on "
            "where it stopped, with fewer --workers if need be"
        ) from error
    finally:
        pool.shutdown(cancel_futures=True)


def _make_shard(job: _Job, sensor_name: str) -> int:
    out, shard, count, seed = job
    sensor = sensor_named(sensor_name)
    first = shard * SHARD_GROUPS
    groups = range(first, first + math.ceil(count / GROUP_CONTACTS))
    contacts = [contact for group in groups for contact in make_group(seed, group, sensor)]
    try:
        with DatasetWriter(out, part=_part(shard), shard_size=count) as writer:
            for contact in contacts[:count]:
                writer.add(contact)
    except OSError as error:
        raise TouchError(f"can't write contacts to {out}: {error}") from error
    return shard


def _start_worker() -> None:
    torch.set_num_threads(1)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """A worker whose parent was killed would wait for work for ever."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


@contextlib.contextmanager
def _one_thread() -> Iterator[None]:
    """As in a worker: the order of sums, and so the bytes, depends on the number of threads."""
    before = torch.get_num_threads()
    torch.set_num_threads(1)
    try:
        yield
    finally:
        torch.set_num_threads(before)


def _open(out: Path, wanted: dict[str, str]) -> None:
    """Start or go on with a data set, without what an interrupted writer left half written.

    Raises:
        UsageError: The folder was made by another command.
        TouchError: It is no data set of this version, or can't be written.
    """
    about = {"made_by": "tacgrasp data generate", "maker": MAKER, **wanted}
    try:
        DatasetWriter(out, about=about)
        found = json.loads((out / "dataset.json").read_text()).get("about", {})
        if found != about:
            differing = [
                f"{name} {found.get(name)!r} instead of {value!r}"
                for name, value in about.items()
                if found.get(name) != value
            ]
            raise UsageError(
                f"{out} holds the data of another command: {', '.join(differing)}; "
                "choose another folder or delete this one"
            )
        for left_over in out.glob("*.part"):
            left_over.unlink()
    except OSError as error:
        raise TouchError(f"can't write contacts to {out}: {error}") from error


def _part(shard: int) -> str:
    return f"s{shard:05d}"


def _index_of(out: Path, shard: int) -> Path:
    return out / f"shard-{_part(shard)}-00000.parquet"


def _progress(console: Console | None) -> Progress:
    return Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(),
        console=console or Console(stderr=True),
    )
