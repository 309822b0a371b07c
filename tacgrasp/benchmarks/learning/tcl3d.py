"""``tacgrasp bench tcl3d``: what contacts of the data set cost at a sensor's own resolution.

One run makes series of contacts at 320 × 240 from the object to the caption: contact geometry,
solve, labels, caption; on as many processes as asked for, one thread each. Beside every stage
stands a floor that no way of doing it could beat; beside the solve, its error against the solve on
the whole grid. Cost over contacts and over pixels is fitted, not assumed.

The data set itself stores a quarter of this resolution and costs accordingly less.
"""

from __future__ import annotations

import json
import math
import subprocess
import time
from dataclasses import asdict
from functools import partial
from pathlib import Path

import numpy as np
import torch
from rich.console import Console
from rich.table import Table

from sim.gel.layer import ElasticLayer
from tacgrasp.base.errors import UsageError
from tacgrasp.base.worker_pool import worker_pool
from tacgrasp.benchmarks.figures import times_ms, write_figures
from tacgrasp.benchmarks.learning.timed_contacts import (
    COLUMNS,
    ROWS,
    STAGES,
    StageTimes,
    make,
    resolution,
    scene_of,
    solve,
)
from tacgrasp.benchmarks.settings import Tcl3dSettings

LIMIT_PER_S, DEVICE_LIMIT_PER_S = 40.0, 2000.0
_GRIDS = ((60, 80), (120, 160), (240, 320), (480, 640))
_COUNTS = (4, 8, 16, 32)
_WARM_UP = 6


def _worker(numbers: list[int], device: str) -> StageTimes:
    make(numbers[:_WARM_UP], device)  # the first calls of libraries take longer
    return make(numbers, device)


def throughput(series: int, workers: int, device: str) -> tuple[float, list[StageTimes]]:
    """Contacts per second while all processes work, and each one's times."""
    parts = [list(range(first, series, workers)) for first in range(workers)]
    with worker_pool(workers) as pool:
        times = list(pool.map(_worker, parts, [device] * workers))
    # All processes were at work from the last begin to the first end.
    span = min(each.end_s for each in times) - max(each.begin_s for each in times)
    if span <= 0:
        raise UsageError(f"{series} series are too few for {workers} workers; make more --series")
    return sum(each.contacts / (each.end_s - each.begin_s) for each in times), times


def floors_ms(times: StageTimes, repeats: int = 5) -> dict[str, float]:
    """Least possible time of each stage per contact, measured here [ms].

    Geometry: writing the gap map once. Solve: bare forward and inverse FFTs of the sizes and
    numbers that the solver used, without empty rows. Labels: reading heights and pressures once.
    Caption: 0.
    """
    gap_map = torch.rand(ROWS, COLUMNS)
    copy_ms = min(times_ms(gap_map.clone, 50))
    fft_ms = 0.0
    for (rows, padded_rows, padded_columns), count in times.transforms.items():
        along = torch.rand(rows, padded_columns)
        half = torch.fft.rfft(along)
        down = torch.rand(half.shape[1], padded_rows, dtype=half.dtype)
        for transform in (
            partial(torch.fft.rfft, along),
            partial(torch.fft.fft, down),
            partial(torch.fft.ifft, down),
            partial(torch.fft.irfft, half, n=padded_columns),
        ):
            fft_ms += count * min(times_ms(transform, repeats))
    return {
        "geometry": copy_ms,
        "solve": fft_ms / times.contacts,
        "labels": 2 * copy_ms,
        "caption": 0.0,
    }


def shortcut_error_um(series: int) -> dict[str, float]:
    """Errors of the heights of some series against a solve on the whole grid [µm]."""
    worst, spread, area = [], [], []
    with resolution(ROWS, COLUMNS):
        for number in range(series):
            request, scene, approach = scene_of(number, "cpu")
            press = solve(request, scene, approach, "cpu")
            whole = ElasticLayer(
                request.gel,
                rows=ROWS,
                columns=COLUMNS,
                pitch_mm=request.sensor.width_mm / COLUMNS,
                body_modulus_mpa=request.obj.modulus_mpa,
            )
            gap = torch.from_numpy(scene.gap_mm.astype(np.float32)).expand(len(approach), -1, -1)
            with torch.inference_mode():
                truth = whole.press_to_depth(gap, torch.tensor(approach), tol=1e-5)
            error = 1e3 * (press.height_mm - truth.height_mm).abs().flatten(1).numpy()
            worst += error.max(axis=1).tolist()
            spread += np.sqrt((error**2).mean(axis=1)).tolist()
            touching = [(p.pressure_kpa > 0).float().mean((1, 2)) for p in (press, truth)]
            area += (100 * (touching[0] - touching[1]).abs()).tolist()
    return {
        "rms_um_p50": float(np.median(spread)),
        "rms_um_max": max(spread),
        "worst_um_p50": float(np.median(worst)),
        "worst_um_max": max(worst),
        "area_points_max": max(area),
    }


def exponents(series: int) -> dict[str, float]:
    """Exponents of the growth of time with contacts, and with n log n of n pixels."""
    make(list(range(_COUNTS[-1])), grid=_GRIDS[0])
    by_count = [_seconds(count, (120, 160)) for count in _COUNTS]
    by_grid = []
    for grid in _GRIDS:
        make(list(range(2)), grid=grid)
        by_grid.append(_seconds(series, grid))
    work = [rows * columns * math.log(rows * columns) for rows, columns in _GRIDS]
    return {
        "contacts_exponent": _slope([float(c) for c in _COUNTS], by_count),
        "pixels_exponent_of_n_log_n": _slope(work, by_grid),
    }


def _seconds(series: int, grid: tuple[int, int]) -> float:
    """Processor time of this thread for some series [s]."""
    begin = time.process_time()
    make(list(range(series)), grid=grid)
    return time.process_time() - begin


def _slope(x: list[float], y: list[float]) -> float:
    return float(np.polyfit(np.log(x), np.log(y), 1)[0])


def tacto_frame(python: Path) -> dict[str, float]:
    """Time of one frame of TACTO's own renderer [ms], in the interpreter where it is installed.

    Raises:
        UsageError: It does not run there; the message holds its last line.
    """
    script = Path(__file__).with_name("tacto_frame.py")
    done = subprocess.run(
        [str(python), str(script)], capture_output=True, text=True, timeout=300, check=False
    )
    if done.returncode != 0:
        lines = (done.stderr or done.stdout).strip().splitlines() or ["nothing"]
        raise UsageError(f"TACTO does not run in {python}: {lines[-1]}")
    times = json.loads(done.stdout.strip().splitlines()[-1])
    return {f"tacto_{name}": float(value) for name, value in times.items()}


def run(settings: Tcl3dSettings) -> bool:
    """Measure, print, write the figures; returns whether the limit was kept.

    Raises:
        UsageError: Too few series, or TACTO does not run.
        OSError: The file can't be written.
    """
    series, workers, device = settings.series, settings.workers, settings.device
    rate, times = throughput(series, workers, device)
    limit = LIMIT_PER_S if device == "cpu" else DEVICE_LIMIT_PER_S
    torch.set_num_threads(1)
    contacts = sum(each.contacts for each in times)
    stages = {s: 1e3 * sum(each.stage_s[s] for each in times) / contacts for s in STAGES}
    figures = {
        "contacts": float(contacts),
        "workers": float(workers),
        "contacts_per_s": rate,
        "contacts_per_s_on_free_cores": 1e3 * workers / sum(stages.values()),
    }
    figures |= {f"{stage}_ms": value for stage, value in stages.items()}
    figures["processor_ms"] = sum(stages.values())
    floors = floors_ms(times[0])
    figures |= {f"{stage}_floor_ms": value for stage, value in floors.items()}
    figures |= shortcut_error_um(max(2, series // 8)) | exponents(max(4, series // 8))
    if settings.tacto is not None:
        figures |= tacto_frame(settings.tacto)
    _print(figures, device, limit)
    made = [asdict(each) for each in times]
    for each in made:
        each["transforms"] = [[*size, n] for size, n in sorted(each["transforms"].items())]
    write_figures(settings.json, {"device": device, "made": made, **figures})
    return rate >= limit


def _print(f: dict[str, float], device: str, limit: float) -> None:
    table = Table("figure", "value", "floor", "note", title=f"TCL3D at {COLUMNS}×{ROWS}, {device}")
    table.add_row(
        "contacts a second",
        f"{f['contacts_per_s']:.1f}",
        "",
        f"{f['workers']:.0f} processes of one thread; limit {limit:g}",
    )
    if device == "cpu":  # an accelerator has no processor time
        table.add_row(
            "the same, on free cores",
            f"{f['contacts_per_s_on_free_cores']:.1f}",
            "",
            "from the processor time below; equal on an idle machine",
        )
    notes = ("writing the map", "bare FFTs of the same sizes", "reading both maps", "")
    for stage, note in zip(STAGES, notes, strict=True):
        floor = f"{f[f'{stage}_floor_ms']:.2f} ms"
        table.add_row(stage, f"{f[f'{stage}_ms']:.2f} ms", floor, note)
    table.add_row(
        "error of heights",
        f"{f['rms_um_p50']:.2f} µm rms",
        "",
        f"worst contact {f['rms_um_max']:.2f} rms; worst pixel {f['worst_um_max']:.1f} µm, median "
        f"contact's {f['worst_um_p50']:.1f}; against the whole grid at tol 1e-5",
    )
    table.add_row(
        "error of area",
        f"{f['area_points_max']:.2f} points",
        "",
        "percent of the sensing area, worst",
    )
    table.add_row("grows with contacts", f"n^{f['contacts_exponent']:.2f}", "", "1 is linear")
    table.add_row(
        "grows with pixels",
        f"(n log n)^{f['pixels_exponent_of_n_log_n']:.2f}",
        "",
        "80×60 to 640×480; whole pipeline",
    )
    if "tacto_wall_ms" in f:
        table.add_row(
            "TACTO's renderer",
            f"{f['tacto_wall_ms']:.1f} ms",
            "",
            f"a frame of its own, {f['tacto_cpu_ms']:.1f} ms of processor; ours "
            f"{1e3 / f['contacts_per_s']:.1f} ms, {f['processor_ms']:.1f} ms of processor",
        )
    Console().print(table)
