"""``tacgrasp simulate press``: one thing pressed into one sensor's gel.

Not here: the gel (``sim``), data sets of contacts (``tacgrasp.datasets.generate``).
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray
from rich.console import Console

from cltp.errors import TouchError
from cltp.tactile.cloud import TactileCloud, cloud_from_heights, grid_axes_mm
from cltp.tactile.markers import marker_cloud
from cltp.tactile.sensor_noise import NoiseUnit, spread_of
from cltp.tactile.sensors import SensorSpec, sensor_named
from cltp.tactile.states import ContactState, Shape, Texture
from cltp.texts.captions import caption, numeric_caption
from cltp.torch_threads import torch_threads
from sim.gel.fine.fine import FineLayer
from sim.gel.gap import NO_BODY_MM
from sim.gel.layer import Press, gel_of
from sim.objects.catalogue import object_named
from sim.objects.ray_casting import cast_pad_rays
from sim.starter.probes import ProbeShape
from sim.tcl3d.contact_geometry import ContactGeometry
from sim.tcl3d.labels import in_contact, label
from sim.tcl3d.poses import draw_pose
from sim.tcl3d.shape_labels import name_shape
from tacgrasp.base.errors import UsageError
from tacgrasp.base.torch_device import usable_device

NOISES = ("none", "unit", "uncalibrated")
"""No noise; a drawn unit; a drawn unit whose gradients nobody calibrated."""

_LEAST_GRID, _MOST_GRID = 24, 1280
_POSES = 40
_ROUGH_PIXELS = 12  # under fewer, a ball's force was up to 20 % off that of a thick layer


@dataclass(frozen=True, slots=True, kw_only=True)
class Pressed:
    """One press.

    Attributes:
        sensor: Whose gel.
        height_mm: Shape (H, W), true surface over the whole field, row 0 at the top, + into the
            gel [mm].
        pressure_kpa: Same shape [kPa].
        force_n: Normal force [N].
        state: Labels, from the truth.
        seen_mm: Heights as the sensor reports them, (H, W) [mm]; None without noise, or for a
            sensor that tracks markers.
        cloud: Points as the sensor reports them.
    """

    sensor: SensorSpec
    height_mm: NDArray[np.float32]
    pressure_kpa: NDArray[np.float32]
    force_n: float
    state: ContactState
    seen_mm: NDArray[np.float32] | None
    cloud: TactileCloud


@dataclass(frozen=True, slots=True, kw_only=True)
class Request:
    """What to press.

    Attributes:
        object: A probe such as ball:9.5, or the name of an object of the catalogue.
        depth_mm: Its tip below the undeformed surface [mm].
        sensor: Name of the sensor.
        x_mm, y_mm: Where its tip is [mm, gel frame].
        turn_deg: Its rotation in the plane [°].
        grid: Columns and rows; None is the sensor's own.
        noise: One of ``NOISES``.
        seed: Draws the noise, and the pose of an object.
        device: Where torch computes.
    """

    object: str
    depth_mm: float
    sensor: str = "gelsight_mini"
    x_mm: float = 0.0
    y_mm: float = 0.0
    turn_deg: float = 0.0
    grid: tuple[int, int] | None = None
    noise: str = "none"
    seed: int = 0
    device: str = "cpu"


@torch_threads()  # fields this small only make threads wait for each other
def press(request: Request) -> Pressed:
    """Press a thing to a depth.

    Raises:
        UsageError: An unknown object, sensor, noise or device, a grid or depth that makes no sense,
            or a thing that misses the gel.
    """
    sensor = _sensor(request)
    laid = _laid(request, sensor)
    columns, rows = request.grid or (sensor.columns, sensor.rows)
    layer = FineLayer(
        gel_of(sensor.name),
        rows=rows,
        columns=columns,
        pitch_mm=sensor.width_mm / columns,
        body_modulus_mpa=laid.modulus_mpa,
        device=usable_device(request.device),
    )
    with torch.inference_mode():
        solved = layer.press_to_depth(torch.from_numpy(laid.gap_mm)[None], request.depth_mm)
    if not bool(solved.converged.all()):
        raise TouchError(f"the press of {request.object} did not converge; try another --grid")
    return _read(solved, request, sensor, laid)


def _read(solved: Press, request: Request, sensor: SensorSpec, laid: _Laid) -> Pressed:
    pressure, force_n = solved.pressure_kpa.cpu(), float(solved.force_n)
    height_mm = solved.height_mm[0].cpu().numpy()
    pitch_mm = sensor.width_mm / pressure.shape[2]
    closed = in_contact(pressure, pitch_mm)[0]
    shape = laid.shape
    if shape is None:
        touch = ContactGeometry(
            gap_mm=np.minimum(laid.gap_mm, NO_BODY_MM),  # as where data sets are made: never inf
            cells=laid.cells,
            cell_table=object_named(request.object).cells,
            touching=pressure[0].numpy() > 0,
            closed=closed,
            depth_mm=float(height_mm.max()),
            pitch_mm=pitch_mm,
        )
        shape = name_shape(touch).shape
    state = label(
        height_mm=height_mm,
        pressure_kpa=pressure[0].numpy(),
        touching=closed,
        force_n=force_n,
        sensor=sensor,
        shape=shape,
        texture=Texture.SMOOTH,
    )
    rng = np.random.default_rng(request.seed)
    unit = _unit(request.noise, sensor, rng)
    seen_mm = None
    if sensor.markers is not None:
        cloud = marker_cloud(height_mm, sensor, unit=unit, rng=rng)
    else:
        seen_mm = None if unit is None else unit.apply(height_mm, sensor, rng)
        cloud = cloud_from_heights(height_mm if seen_mm is None else seen_mm, sensor, rng=rng)
    return Pressed(
        sensor=sensor,
        height_mm=height_mm,
        pressure_kpa=pressure[0].numpy(),
        force_n=force_n,
        state=state,
        seen_mm=seen_mm,
        cloud=cloud,
    )


def _sensor(request: Request) -> SensorSpec:
    try:
        sensor = sensor_named(request.sensor)
    except TouchError as error:
        raise UsageError(f"--sensor: {error}") from None
    if not 0 < request.depth_mm < sensor.gel_mm:
        raise UsageError(
            f"--depth-mm must be above 0 and below the {sensor.gel_mm} mm gel of {sensor.name}, "
            f"got {request.depth_mm}"
        )
    if not np.isfinite([request.x_mm, request.y_mm, request.turn_deg]).all():
        raise UsageError(
            "--x-mm, --y-mm and --turn-deg must be finite numbers, "
            f"got {request.x_mm}, {request.y_mm} and {request.turn_deg}"
        )
    if request.noise not in NOISES:
        raise UsageError(f"--noise must be one of {', '.join(NOISES)}, got {request.noise!r}")
    if request.grid is not None:
        columns, rows = request.grid
        square = abs(columns * sensor.rows - rows * sensor.columns) < sensor.columns
        if not (min(columns, rows) >= _LEAST_GRID and max(columns, rows) <= _MOST_GRID and square):
            raise UsageError(
                f"--grid must be {_LEAST_GRID} to {_MOST_GRID} columns and rows with the field's "
                f"proportions ({sensor.columns}x{sensor.rows}), got {columns}x{rows}"
            )
    return sensor


@dataclass(frozen=True, slots=True, kw_only=True)
class _Laid:
    """What lies over the pad: a probe, whose shape is known, or an object of the catalogue.

    Attributes:
        gap_mm: Shape (H, W), behind its tip; inf where nothing is [mm].
        shape: Of a probe; None is named from where it touches.
        cells: Shape (H, W), which part of an object's surface is there; -1 where none is.
        modulus_mpa: Of a soft object [MPa]; None if it is rigid.
    """

    gap_mm: NDArray[np.float64]
    shape: Shape | None
    cells: NDArray[np.int64]
    modulus_mpa: float | None


def _laid(request: Request, sensor: SensorSpec) -> _Laid:
    columns, rows = request.grid or (sensor.columns, sensor.rows)
    x, y = np.meshgrid(*grid_axes_mm(sensor, rows, columns))
    x, y, turn = x - request.x_mm, y - request.y_mm, np.radians(request.turn_deg)
    u, v = x * np.cos(turn) + y * np.sin(turn), y * np.cos(turn) - x * np.sin(turn)
    if ":" not in request.object:
        return _object(request, sensor, u, v)
    try:
        probe = ProbeShape.named(request.object)
    except ValueError as error:
        raise UsageError(f"--object: {error}") from None
    behind = probe.behind_mm(u, v)
    nearest = float(behind.min())
    if not nearest < request.depth_mm:
        why = "no part of it is over the field"
        if np.isfinite(nearest):
            why = f"what is over the field lies {nearest:.2g} mm behind the tip"
        raise _missed(request, sensor, why)
    cells = np.where(np.isfinite(behind), 0, -1)
    return _Laid(gap_mm=behind, shape=probe.shape, cells=cells, modulus_mpa=None)


def _missed(request: Request, sensor: SensorSpec, why: str) -> UsageError:
    return UsageError(
        f"{request.object} at x {request.x_mm:g}, y {request.y_mm:g} mm misses the gel: {why} "
        f"({sensor.name} sees ±{sensor.width_mm / 2:.1f}, ±{sensor.height_mm / 2:.1f} mm); "
        "move it with --x-mm and --y-mm, press deeper, or take a finer --grid"
    )


def _object(
    request: Request, sensor: SensorSpec, x: NDArray[np.float64], y: NDArray[np.float64]
) -> _Laid:
    """An object of the catalogue, its bare surface, in a pose that the seed draws."""
    try:
        thing = object_named(request.object)
    except ValueError as error:
        raise UsageError(f"--object: {error}; or a probe such as ball:9.5") from None
    rng = np.random.default_rng(request.seed)
    for _ in range(_POSES):
        pose = draw_pose(thing, rng, sensor, request.depth_mm)
        felt = cast_pad_rays(thing, pose.object_from_pad, pose.point, x, y)
        if felt is not None:
            there = felt.gap_mm < NO_BODY_MM
            cells = np.full(there.shape, -1, dtype=np.int64)
            cells[there] = thing.cell(torch.from_numpy(felt.points[there])).numpy()
            gap = np.where(there, felt.gap_mm, np.inf)
            return _Laid(gap_mm=gap, shape=None, cells=cells, modulus_mpa=thing.modulus_mpa)
    raise _missed(request, sensor, f"none of {_POSES} poses brings it to the pad")


def _unit(noise: str, sensor: SensorSpec, rng: np.random.Generator) -> NoiseUnit | None:
    if noise == "none":
        return None
    spread = spread_of(sensor)
    ratio = spread.gain_log_ratio if noise == "uncalibrated" else 0.0
    return NoiseUnit.draw(rng, gain_log_ratio=ratio, spread=spread)


def run(request: Request, out: Path | None) -> None:
    """Press, print the figures, and write them to ``out`` (.npz) if given.

    Raises:
        UsageError: As ``press``, or ``out`` can't be written.
    """
    done = press(request)
    area_mm2 = done.state.area_fraction * done.sensor.area_mm2
    pixels = int((done.pressure_kpa > 0).sum())
    touching = pixels / done.pressure_kpa.size * done.sensor.area_mm2
    rows, columns = done.height_mm.shape
    to = Console(soft_wrap=True, highlight=False)
    to.print(f"object    {request.object}, tip {request.depth_mm:g} mm below the surface")
    to.print(f"sensor    {done.sensor.name}, {columns}x{rows}, noise {request.noise}")
    to.print(f"force     {done.force_n:.3f} N")
    to.print(f"area      {touching:.2f} mm² under pressure, {area_mm2:.2f} mm² felt as contact")
    to.print(f"pressure  {done.pressure_kpa.max():.1f} kPa at most")
    to.print(f"surface   {done.height_mm.min():+.3f} to {done.height_mm.max():+.3f} mm")
    to.print(f"label     {caption(done.state)}")
    to.print(f"          {numeric_caption(done.state, done.sensor)}")
    if pixels < _ROUGH_PIXELS:
        to.print(
            f"note      only {pixels} pixels touch: force and area are rough; a finer --grid helps"
        )
    if out is not None:
        _write(out, request, done)
        to.print(f"written   {out}")


def _write(out: Path, request: Request, done: Pressed) -> None:
    values: dict[str, Any] = {
        "height_mm": done.height_mm,
        "pressure_kpa": done.pressure_kpa,
        "force_n": np.float64(done.force_n),
        "mm_per_px": np.float64(done.sensor.width_mm / done.height_mm.shape[1]),
        "cloud_mm": done.cloud.points_mm,
        "sensor": np.str_(done.sensor.name),
        "object": np.str_(request.object),
        "depth_mm": np.float64(request.depth_mm),
        "caption": np.str_(caption(done.state)),
    }
    if done.seen_mm is not None:
        values["seen_mm"] = done.seen_mm
    beside = out.with_name(f"{out.name}.{os.getpid()}.part")
    try:
        with beside.open("wb") as file:
            np.savez_compressed(file, allow_pickle=False, **values)
        beside.replace(out)
    except OSError as error:
        beside.unlink(missing_ok=True)
        raise UsageError(f"--out {out} can't be written: {error}") from None
