"""Make a data set of simulated contacts: worker processes, progress, resumable after ``kill -9``.

A recipe (``tacgrasp.datasets.recipes``) cuts the work into shards. A shard exists when its index
file does, and its bytes depend on the recipe and its number alone; so whatever is missing is made,
by any number of workers and on any number of machines, and the result is that of an undisturbed
run.

Not here: what contacts are made (``sim.tcl3d.series``, ``sim.starter.contacts``), files
(``cltp.data.dataset``).
"""

from __future__ import annotations

import contextlib
import json
import multiprocessing
import os
import re
import threading
from collections.abc import Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path

import torch
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from cltp.data.dataset import ContactDataset, DatasetWriter
from cltp.errors import TouchError
from tacgrasp.base.errors import UsageError
from tacgrasp.datasets.card import write_card
from tacgrasp.datasets.recipes import Recipe, recipe


def generate(
    out: Path,
    *,
    contacts: int | None = None,
    seed: int = 0,
    workers: int | None = None,
    sensor_name: str = "gelsight_mini",
    set_name: str = "starter",
    meshes: Path | None = None,
    shard: str | None = None,
    device: str = "cpu",
    console: Console | None = None,
) -> None:
    """Make a data set, or what is missing of it; a complete one is left as it is.

    Args:
        out: Folder; made when missing.
        contacts: How many; by default as many as the set has.
        seed: Draws everything; below ``sim.grasp.rig.BENCHMARK_SEED``.
        workers: Processes; by default one for each core. Does not change the result.
        sensor_name: Whose field is pressed; only for the set ``starter``.
        set_name: Which set: a key of ``tacgrasp.datasets.recipes.SETS``.
        meshes: Folder of meshes whose contacts are added; only for the set ``tcl3d``.
        shard: "i/n": only the i-th of n parts, 1 to n, for several machines.
        device: Where contacts are computed; 'cuda' gives heights within 2 µm of 'cpu'.
        console: Where progress is shown; by default standard error.

    Raises:
        UsageError: A value makes no sense, or the folder holds the data of another command.
        TouchError: The folder is no data set of this version, or can't be written.
    """
    if workers is None:
        workers = len(os.sched_getaffinity(0))
    if workers < 1:
        raise UsageError(f"expected at least 1 worker, got {workers}")
    what = recipe(
        set_name,
        contacts=contacts,
        seed=seed,
        sensor_name=sensor_name,
        meshes=meshes,
        device=device,
    )
    sizes = what.shard_sizes()
    mine = _part_of(len(sizes), shard)
    _open(out, what.about())
    _clear(out, mine)
    jobs = [(out, number, sizes[number]) for number in mine if not _index_of(out, number).exists()]
    with _progress(console) as progress:
        bar = progress.add_task("contacts", total=sum(sizes[number] for number in mine))
        progress.advance(bar, sum(sizes[n] for n in mine) - sum(job[2] for job in jobs))
        for number in _done(jobs, what, min(workers, len(jobs))):
            progress.advance(bar, sizes[number])
    if what.carded and is_complete(out):
        try:
            write_card(out, what.command())
        except OSError as error:
            raise TouchError(f"can't write the card of {out}: {error}") from error


def is_complete(out: Path) -> bool:
    """Whether a folder holds all of the contacts that it was made to hold.

    Raises:
        TouchError: It is no data set of this version.
    """
    try:
        data = ContactDataset(out, partial=True)
    except TouchError:
        if (out / "dataset.json").exists() and not any(out.glob("shard-*.parquet")):
            return False
        raise
    return len(data) == int(data.about.get("contacts", len(data)))


def _part_of(shards: int, which: str | None) -> list[int]:
    """Numbers of the shards that this machine makes."""
    if which is None:
        return list(range(shards))
    found = re.fullmatch(r"(\d+)/(\d+)", which)
    if found is None or not 1 <= int(found[1]) <= int(found[2]):
        raise UsageError(
            f"--shard expects i/n with i from 1 to n, such as 1/4 to 4/4 on four machines, "
            f"got {which!r}"
        )
    return list(range(int(found[1]) - 1, shards, int(found[2])))


_Job = tuple[Path, int, int]
"""Folder, number of the shard, and how many contacts it holds."""


def _done(jobs: list[_Job], what: Recipe, workers: int) -> Iterator[int]:
    """Make shards here or in processes of their own; yields each one's number when it is safe."""
    if workers <= 1:
        with _one_thread():
            for job in jobs:
                yield _make_shard(job, what)
        return
    spawn = multiprocessing.get_context("spawn")  # torch's threads don't survive a fork
    pool = ProcessPoolExecutor(workers, mp_context=spawn, initializer=_start_worker)
    try:
        for made in as_completed([pool.submit(_make_shard, job, what) for job in jobs]):
            yield made.result()
    except BrokenProcessPool as error:
        raise TouchError(
            "a worker that made contacts was killed (out of memory?); the same command goes on "
            "where it stopped, with fewer --workers if need be"
        ) from error
    finally:
        pool.shutdown(cancel_futures=True)


def _make_shard(job: _Job, what: Recipe) -> int:
    out, number, count = job
    contacts = what.make(number)
    if len(contacts) != count:
        raise RuntimeError(f"shard {number} has {len(contacts)} contacts instead of {count}")
    try:
        with DatasetWriter(out, part=_part(number), shard_size=count) as writer:
            for contact in contacts:
                writer.add(contact)
    except OSError as error:
        raise TouchError(
            f"can't write contacts to {out}: {error}; the same command goes on from there"
        ) from error
    return number


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


def _open(out: Path, about: Mapping[str, str]) -> None:
    """Start or go on with a data set.

    Raises:
        UsageError: The folder was made by another command.
        TouchError: It is no data set of this version, or can't be written.
    """
    try:
        DatasetWriter(out, about=about)
        found = json.loads((out / "dataset.json").read_text()).get("about", {})
    except OSError as error:
        raise TouchError(f"can't write contacts to {out}: {error}") from error
    differing = [
        f"{name} {found.get(name)!r} instead of {about.get(name)!r}"
        for name in sorted({*found, *about})
        if found.get(name) != about.get(name)
    ]
    if differing:
        raise UsageError(
            f"{out} holds the data of another command: {', '.join(differing)}; "
            "choose another folder or delete this one"
        )


def _clear(out: Path, mine: list[int]) -> None:
    """Remove what an interrupted writer left half written of these shards, and of the header.

    Other shards may be in the making on another machine that writes to the same folder.
    """
    own = {f"shard-{_part(number)}-" for number in mine}
    try:
        for left_over in out.glob("*.part"):
            if left_over.name[:13] in own or not left_over.name.startswith("shard-"):
                left_over.unlink(missing_ok=True)
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
