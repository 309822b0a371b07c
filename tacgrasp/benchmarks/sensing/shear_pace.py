"""Part of ``tacgrasp bench gel``: friction at the rate of the closed loop, its error and its cost.

The coarse form (``sim.gel.shear.coarse``) and the full one, on the pressure's own grid and to a
tolerance of 1e-4, follow the same motions of balls whose force changes by a tenth: to and fro,
sideways and turning.

Not here: closed forms (``shear``).
"""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from cltp.processor import torch_threads
from cltp.tactile.sensors import sensor_named
from sim.gel.layer import ElasticLayer, gel_of
from sim.gel.shear.coarse import FACTOR, LOOP_TOL, CoarseShear
from sim.gel.shear.layer import Shear, ShearLayer
from sim.gel.shear.sensed import TAXELS, shear_field
from sim.grasp.fingers import grid_of
from tacgrasp.benchmarks.figures import Figure, times_ms

SENSOR = "gelsight_mini"
STEPS, FRICTION = 60, 0.5
BALLS = ((15.0, 1.0), (7.5, 3.0), (60.0, 3.0))
"""Radius [mm] and force [N] of each ball: a berry held lightly and firmly, and a flat side."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Path:
    """Pressures and motions of a ball, step by step.

    Attributes:
        layer: The gel, on the world's grid.
        pressure_kpa: (STEPS, H, W) [kPa].
        height_mm: Surface under it, the same shape [mm].
        force_n: Normal force, (STEPS,) [N].
        motion: (STEPS, 3), as ``ShearLayer.step`` takes it.
    """

    layer: ElasticLayer
    pressure_kpa: Tensor
    height_mm: Tensor
    force_n: NDArray[np.float64]
    motion: Tensor


def path_of(ball_mm: float, force_n: float, steps: int = STEPS) -> Path:
    """A ball that is moved to and fro by a quarter of a millimetre and turned by 0.03 rad."""
    sensor = sensor_named(SENSOR)
    rows, columns = grid_of(sensor)
    pitch = sensor.width_mm / columns
    layer = ElasticLayer(gel_of(SENSOR), rows=rows, columns=columns, pitch_mm=pitch)
    y = (torch.arange(rows) - (rows - 1) / 2) * pitch
    x = (torch.arange(columns) - (columns - 1) / 2) * pitch
    square = y[:, None] ** 2 + x**2
    cap = ball_mm - (ball_mm**2 - square).clamp(min=0).sqrt()
    gap = torch.where(square < ball_mm**2, cap, torch.inf).expand(steps, -1, -1)
    phase = 2 * np.pi * np.linspace(0, 1, steps)
    forces = force_n * (1 + 0.1 * np.sin(3 * phase))
    press = layer.press_to_force(gap, torch.from_numpy(forces).float(), tol=1e-3)
    pose = np.stack(
        [0.25 * np.sin(1.5 * phase), 0.075 * np.sin(0.7 * phase), 0.03 * np.sin(phase)], 1
    )
    motion = np.diff(pose, axis=0, prepend=pose[:1])
    return Path(
        layer=layer,
        pressure_kpa=press.pressure_kpa,
        height_mm=press.height_mm,
        force_n=forces,
        motion=torch.from_numpy(motion).float(),
    )


def follow(path: Path, shear_layer: ShearLayer | CoarseShear) -> list[Shear]:
    """The contact after each step of a path."""
    shears: list[Shear] = []
    for k in range(len(path.motion)):
        before = shears[-1] if shears else None
        shears.append(
            shear_layer.step(before, path.pressure_kpa[k : k + 1], path.motion[k : k + 1])
        )
    return shears


@dataclass(frozen=True, slots=True, kw_only=True)
class PaceError:
    """Differences of the coarse form from the full one along a path.

    Attributes:
        force: (STEPS,) of the tangential force, over mu P.
        stick: (STEPS,) of the stick fraction.
    """

    force: NDArray[np.float64]
    stick: NDArray[np.float64]


def pace_error(path: Path) -> PaceError:
    """Follow a path in both forms."""
    full = follow(path, ShearLayer(path.layer, friction=FRICTION))
    coarse = follow(path, CoarseShear(path.layer, friction=FRICTION))
    pairs = list(zip(full, coarse, strict=True))
    force = np.array([(b.force_n - a.force_n).norm().item() for a, b in pairs])
    stick = np.array([(b.stick_fraction - a.stick_fraction).item() for a, b in pairs])
    return PaceError(force=force / (FRICTION * path.force_n), stick=stick)


def _durations(paths: list[Path]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Duration of each coarse step, on the wall and of one core's work [ms]."""
    wall, core = [], []
    for path in paths:
        layer = CoarseShear(path.layer, friction=FRICTION)
        follow(path, layer)  # makes the kernels
        before: Shear | None = None
        for k in range(len(path.motion)):
            began, worked = time.perf_counter(), time.thread_time()
            before = layer.step(before, path.pressure_kpa[k : k + 1], path.motion[k : k + 1])
            core.append(1e3 * (time.thread_time() - worked))
            wall.append(1e3 * (time.perf_counter() - began))
    return np.array(wall), np.array(core)


@torch_threads()
def pace() -> list[Figure]:
    """Errors of the coarse form, and durations of its steps."""
    paths = [path_of(*ball) for ball in BALLS]
    errors = [pace_error(path) for path in paths]
    force = 100 * np.concatenate([error.force for error in errors])
    stick = 100 * np.concatenate([error.stick for error in errors])
    wall, core = _durations(paths)
    path, coarse = paths[0], CoarseShear(paths[0].layer, friction=FRICTION)
    layer = coarse.shear_layer
    last, height = follow(path, coarse)[-1], coarse.coarse(path.height_mm[-1:])
    sensor = sensor_named(SENSOR)
    field = times_ms(lambda: shear_field(layer, last, height, sensor), 50)
    full = ShearLayer(path.layer, friction=FRICTION)
    began = time.thread_time()
    follow(path, full)
    full_ms = 1e3 * (time.thread_time() - began) / len(path.motion)
    note = f"{len(BALLS)} balls, {STEPS} steps each, elements × {FACTOR}, tol {LOOP_TOL:g}"
    taxels = f"{TAXELS[0]} × {TAXELS[1]} points"
    worst, rms = np.abs(stick).max(), np.sqrt(np.mean(stick**2))
    core_note = "one core's work, whatever else runs; limit 5 ms"
    rows = [
        ("pace_force_error_percent", "force, worst, of the limit", force.max(), "%", note),
        ("pace_stick_error_percent", "stick fraction, worst", worst, "%", note),
        ("pace_stick_rms_percent", "stick fraction, RMS", rms, "%", note),
        ("ms_median", "a step, median", np.median(wall), "ms", "wall clock"),
        ("ms_p99", "a step, p99", np.percentile(wall, 99), "ms", "wall clock"),
        ("core_ms_median", "a step, median", np.median(core), "ms", core_note),
        ("core_ms_p99", "a step, p99", np.percentile(core, 99), "ms", core_note),
        ("field_ms", "what a sensor sees of it", np.median(field), "ms", taxels),
        ("full_ms", "a step of the full form, mean", full_ms, "ms", "one core's work"),
    ]
    return [
        Figure(f"shear_{key}", f"Coarse shear: {what}", float(value), unit, text)
        for key, what, value, unit, text in rows
    ]
