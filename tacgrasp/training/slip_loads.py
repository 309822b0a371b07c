"""True shear of simulated loads and drags for the training of the slip models, kept on disk.

Simulated once, seen by many noisy units. A block of seeds is a file; blocks that are there already
are not simulated again. Seeds from ``FIRST_SEED`` on are for this alone; benchmarks begin at
1,000,000.

Not here: the loads (``sim.grasp.drawn.loads``, ``sim.grasp.drawn.drags``), noise, the training.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from enum import StrEnum
from functools import partial
from pathlib import Path
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray
from rich.console import Console

from cltp.atomic_write import replacing
from cltp.errors import TouchError
from cltp.tactile.cloud import FloatArray
from cltp.tactile.sensors import sensor_named
from sim.grasp.bodies import Range
from sim.grasp.devices import ADJUST_S
from sim.grasp.drawn.drags import draw_drag, follow_drag
from sim.grasp.drawn.loads import STEP_S, draw_load, follow
from tacgrasp.base.worker_pool import worker_pool
from tacgrasp.console import count_progress

FIRST_SEED = 100

SENSORS = ("taxels", "gelsight_mini_markers")
"""Sensors that are trained; all have the same gel."""

BLOCK = 50
"""Seeds of a file."""

EVERY = 3
"""One seed in so many has a drag too, another one a load with a change of force. Our choice."""

FORCE_FACTOR = Range(low=0.75, high=2.0, log=True)
"""Factor of a change of force. Our choice: some steps of the reflex."""


class Course(StrEnum):
    """What happens to the held body."""

    LOAD = "load"  # as in the benchmark
    DRAG = "drag"
    CHANGED = "changed"  # a load, and in its course another force


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TrueLoad:
    """A load or drag without noise; the first of T frames, ``STEP_S`` apart, is that at rest.

    Attributes:
        seed: Its random seed.
        course: What happens.
        commanded: Number of the frame after which another force is commanded; -1 without one.
        moved_mm: Shape (T, N, 3), by sensor: displacement of all points, in the order of the grid.
        stick: Shape (T,), fraction of the force that rests on points that stick.
        slipped_mm: Shape (T,), slide since the load began [mm].
    """

    seed: int
    course: Course
    commanded: int
    moved_mm: dict[str, NDArray[np.float32]]
    stick: FloatArray
    slipped_mm: FloatArray


def simulate(folder: Path, seeds: range, console: Console) -> list[Path]:
    """Files of the loads of some seeds, whole blocks of them; what is not there is simulated.

    Raises:
        OSError: A file can't be written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    paths = {first: _path(folder, first) for first in range(seeds.start, seeds.stop, BLOCK)}
    missing = [first for first, path in paths.items() if not path.is_file()]
    if missing:
        with worker_pool() as pool, count_progress(console) as progress:
            done = pool.map(partial(write_block, folder), missing)
            for _ in progress.track(done, len(missing), description=f"blocks of {BLOCK} loads"):
                pass
    return list(paths.values())


def _path(folder: Path, first: int) -> Path:
    return folder / f"loads_{first}.npz"


def write_block(folder: Path, first: int) -> None:
    """Simulate the courses of a block of seeds, and write them."""
    loads = []
    for seed in range(first, first + BLOCK):
        also = {0: Course.DRAG, 1: Course.CHANGED}.get(seed % EVERY)
        for course in (Course.LOAD,) if also is None else (Course.LOAD, also):
            with suppress(ValueError):  # nothing is held
                loads.append(_true_load(seed, course))
    arrays: dict[str, NDArray[np.float32] | NDArray[np.int64]] = {
        name: np.concatenate([each.moved_mm[name] for each in loads]) for name in SENSORS
    }
    arrays["stick"] = np.concatenate([each.stick for each in loads]).astype(np.float32)
    arrays["slipped_mm"] = np.concatenate([each.slipped_mm for each in loads]).astype(np.float32)
    courses = list(Course)
    arrays["about"] = np.array(
        [(e.seed, courses.index(e.course), e.commanded, len(e.stick)) for e in loads],
        dtype=np.int64,
    )
    with replacing(_path(folder, first)) as part, part.open("wb") as file:
        np.savez(file, **arrays)  # type: ignore[arg-type]


def read_block(path: Path) -> Iterator[TrueLoad]:
    """The loads of a file.

    Raises:
        TouchError: The file holds none.
        OSError: It can't be read.
    """
    try:
        with np.load(path, allow_pickle=False) as held:
            arrays = {name: held[name] for name in (*SENSORS, "stick", "slipped_mm", "about")}
    except (EOFError, BadZipFile, ValueError, KeyError) as error:
        raise TouchError(f"{path} holds no loads: {error}; delete it") from None
    start, courses = 0, list(Course)
    for seed, course, commanded, count in arrays["about"].tolist():
        part = slice(start, start + count)
        start += count
        yield TrueLoad(
            seed=seed,
            course=courses[course],
            commanded=commanded,
            moved_mm={name: arrays[name][part] for name in SENSORS},
            stick=arrays["stick"][part].astype(np.float64),
            slipped_mm=arrays["slipped_mm"][part].astype(np.float64),
        )


def _true_load(seed: int, course: Course) -> TrueLoad:
    """A course of a seed.

    Raises:
        ValueError: The pads don't reach the body.
    """
    commanded = -1
    if course is Course.DRAG:
        frames = list(follow_drag(draw_drag(seed, SENSORS[0]), quiet=1))
    elif course is Course.LOAD:
        frames = list(follow(draw_load(seed, SENSORS[0]), quiet=1))
    else:
        rng, drawn = np.random.default_rng([seed, 30]), draw_load(seed, SENSORS[0])
        commanded = int(rng.integers(math.ceil(drawn.duration_s / STEP_S)))
        there_s, factor = commanded * STEP_S + ADJUST_S, FORCE_FACTOR.quantile(rng.random())

        def force_n(t_s: float) -> float:
            return drawn.force_n * (factor if t_s >= there_s - 1e-9 else 1.0)

        frames = list(follow(drawn, quiet=1, force_n=force_n))
    sensors = {name: sensor_named(name) for name in SENSORS}
    return TrueLoad(
        seed=seed,
        course=course,
        commanded=commanded,
        moved_mm={
            name: np.stack([frame.field_of(sensor).displacement_mm for frame in frames])
            for name, sensor in sensors.items()
        },
        stick=np.array([frame.stick_fraction for frame in frames]),
        slipped_mm=np.array([frame.slipped_mm for frame in frames]),
    )
