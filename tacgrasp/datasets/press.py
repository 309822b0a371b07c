"""One object pressed into one sensor's gel (``tacgrasp simulate press``)."""

from __future__ import annotations

import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray

from cltp.atomic_write import replacing
from cltp.errors import TouchError
from cltp.processor import torch_threads
from cltp.tactile.cloud import TactileCloud, cloud_from_heights, grid_axes_mm
from cltp.tactile.markers import marker_cloud
from cltp.tactile.sensor_noise import NoiseUnit, spread_of
from cltp.tactile.sensors import SensorSpec, sensor_named
from cltp.tactile.states import ContactState, Shape, Texture
from cltp.texts.captions import caption, numeric_caption
from sim.gel.fine.fine import FineLayer
from sim.gel.gap import NO_BODY_MM
from sim.gel.layer import ElasticLayer, Press, gel_of
from sim.objects.catalogue import object_named
from sim.objects.probes import ProbeShape
from sim.objects.ray_casting import cast_pad_rays
from sim.tcl3d.contact_geometry import ContactGeometry
from sim.tcl3d.labels import in_contact, label
from sim.tcl3d.poses import draw_pose
from sim.tcl3d.shape_labels import name_shape
from tacgrasp.base.errors import UsageError
from tacgrasp.base.result_file import check_ending
from tacgrasp.base.torch_device import usable_device
from tacgrasp.console import make_console
from tacgrasp.datasets.requests import PressRequest

NOISES = ("none", "unit", "uncalibrated")
"""No noise; a random calibrated unit; a random unit with uncalibrated gradients."""

_LEAST_GRID, _MOST_GRID = 24, 1280
_POSES = 40
_ROUGH_PIXELS = 12  # with fewer in contact, a ball's force was up to 20 % off


@dataclass(frozen=True, slots=True, kw_only=True)
class PressResult:
    """The gel under one press, and what the sensor reports of it.

    Attributes:
        sensor: The sensor.
        height_mm: Shape (H, W), true surface over the sensing area, row 0 at the top, positive
            into the gel [mm].
        pressure_kpa: Pressure, same shape [kPa].
        force_n: Normal force [N].
        state: Labels, from the truth.
        seen_mm: Shape (H, W), heights as the sensor reports them [mm]; None without noise, or for
            a sensor that tracks markers.
        cloud: Points as the sensor reports them.
    """

    sensor: SensorSpec
    height_mm: NDArray[np.float32]
    pressure_kpa: NDArray[np.float32]
    force_n: float
    state: ContactState
    seen_mm: NDArray[np.float32] | None
    cloud: TactileCloud


@torch_threads()
def press(request: PressRequest) -> PressResult:
    """Press an object to a depth.

    Raises:
        UsageError: An unknown object, sensor, noise or device, a grid or depth out of range,
            or an object that misses the gel.
    """
    sensor = _sensor(request)
    surface = _surface(request, sensor)
    columns, rows = request.columns_rows or (sensor.columns, sensor.rows)
    layer = ElasticLayer(
        gel_of(sensor.name),
        rows=rows,
        columns=columns,
        pitch_mm=sensor.width_mm / columns,
        body_modulus_mpa=surface.modulus_mpa,
        device=usable_device(request.device),
    )
    with torch.inference_mode():
        solved = FineLayer(layer).press_to_depth(
            torch.from_numpy(surface.gap_mm)[None], request.depth_mm
        )
    if not bool(solved.converged.all()):
        raise TouchError(f"the press of {request.object} did not converge; try another --grid")
    return _read(solved, request, sensor, surface)


def _read(
    solved: Press, request: PressRequest, sensor: SensorSpec, surface: _Surface
) -> PressResult:
    pressure, force_n = solved.pressure_kpa.cpu(), float(solved.force_n)
    height_mm = solved.height_mm[0].cpu().numpy()
    pitch_mm = sensor.width_mm / pressure.shape[2]
    closed = in_contact(pressure, pitch_mm)[0]
    shape = surface.shape
    if shape is None:
        touch = ContactGeometry(
            gap_mm=np.minimum(surface.gap_mm, NO_BODY_MM),  # as where data sets are made: never inf
            cells=surface.cells,
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
    unit = seen_mm = None
    if request.noise != "none":
        spread = spread_of(sensor)
        ratio = spread.gain_log_ratio if request.noise == "uncalibrated" else 0.0
        unit = NoiseUnit.draw(rng, gain_log_ratio=ratio, spread=spread)
    if sensor.markers is not None:
        cloud = marker_cloud(height_mm, sensor, unit=unit, rng=rng)
    else:
        seen_mm = None if unit is None else unit.apply(height_mm, sensor, rng)
        cloud = cloud_from_heights(height_mm if seen_mm is None else seen_mm, sensor, rng=rng)
    return PressResult(
        sensor=sensor,
        height_mm=height_mm,
        pressure_kpa=pressure[0].numpy(),
        force_n=force_n,
        state=state,
        seen_mm=seen_mm,
        cloud=cloud,
    )


def _sensor(request: PressRequest) -> SensorSpec:
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
    if request.columns_rows is not None:
        columns, rows = request.columns_rows
        square = abs(columns * sensor.rows - rows * sensor.columns) < sensor.columns
        if not (min(columns, rows) >= _LEAST_GRID and max(columns, rows) <= _MOST_GRID and square):
            raise UsageError(
                f"--grid must be {_LEAST_GRID} to {_MOST_GRID} columns and rows with the sensor's "
                f"proportions ({sensor.columns}x{sensor.rows}), got {columns}x{rows}"
            )
    return sensor


@dataclass(frozen=True, slots=True, kw_only=True)
class _Surface:
    """The surface over the pad: of a probe, whose shape is known, or of a catalogue object.

    Attributes:
        gap_mm: Shape (H, W), distance behind the tip; inf where there is no body [mm].
        shape: Shape class of a probe; None for an object, whose class depends on the contact.
        cells: Shape (H, W), index of the part of the object's surface; -1 where there is none.
        modulus_mpa: Young's modulus of a soft object [MPa]; None for a rigid one.
    """

    gap_mm: NDArray[np.float64]
    shape: Shape | None
    cells: NDArray[np.int64]
    modulus_mpa: float | None


def _surface(request: PressRequest, sensor: SensorSpec) -> _Surface:
    columns, rows = request.columns_rows or (sensor.columns, sensor.rows)
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
        reason = "no part of it is over the sensing area"
        if np.isfinite(nearest):
            reason = f"its part over the sensing area lies {nearest:.2g} mm behind the tip"
        raise _missed(request, sensor, reason)
    cells = np.where(np.isfinite(behind), 0, -1)
    return _Surface(gap_mm=behind, shape=probe.shape, cells=cells, modulus_mpa=None)


def _missed(request: PressRequest, sensor: SensorSpec, reason: str) -> UsageError:
    return UsageError(
        f"{request.object} at x {request.x_mm:g}, y {request.y_mm:g} mm misses the gel: {reason} "
        f"({sensor.name} sees ±{sensor.width_mm / 2:.1f}, ±{sensor.height_mm / 2:.1f} mm); "
        "move it with --x-mm and --y-mm, press deeper, or take a finer --grid"
    )


def _object(
    request: PressRequest, sensor: SensorSpec, x: NDArray[np.float64], y: NDArray[np.float64]
) -> _Surface:
    """The bare surface of a catalogue object, in a random pose."""
    try:
        obj = object_named(request.object)
    except ValueError as error:
        raise UsageError(f"--object: {error}; or a probe such as ball:9.5") from None
    rng = np.random.default_rng(request.seed)
    for _ in range(_POSES):
        pose = draw_pose(obj, rng, sensor, request.depth_mm)
        view = cast_pad_rays(obj, pose.object_from_pad, pose.point, x, y)
        if view is not None:
            mask = view.gap_mm < NO_BODY_MM
            cells = np.full(mask.shape, -1, dtype=np.int64)
            cells[mask] = obj.cell(torch.from_numpy(view.points[mask])).numpy()
            gap = np.where(mask, view.gap_mm, np.inf)
            return _Surface(gap_mm=gap, shape=None, cells=cells, modulus_mpa=obj.modulus_mpa)
    raise _missed(request, sensor, f"none of {_POSES} poses brings it to the pad")


def run(request: PressRequest) -> None:
    """Press an object, print the figures, and write them to the request's file, if any.

    Raises:
        UsageError: As ``press``, or the file can't be written, is not called .npz, or another than
            an earlier press stands there.
    """
    if request.out is not None:
        check_ending(request.out, ".npz")
        _check_replaceable(request.out)
    result = press(request)
    area_mm2 = result.state.area_fraction * result.sensor.area_mm2
    pixels = int((result.pressure_kpa > 0).sum())
    touching = pixels / result.pressure_kpa.size * result.sensor.area_mm2
    rows, columns = result.height_mm.shape
    console = make_console()
    console.print(f"object    {request.object}, tip {request.depth_mm:g} mm below the surface")
    console.print(f"sensor    {result.sensor.name}, {columns}x{rows}, noise {request.noise}")
    console.print(f"force     {result.force_n:.3f} N")
    console.print(
        f"area      {touching:.2f} mm² under pressure, {area_mm2:.2f} mm² sensed as contact"
    )
    console.print(f"pressure  {result.pressure_kpa.max():.1f} kPa at most")
    console.print(f"surface   {result.height_mm.min():+.3f} to {result.height_mm.max():+.3f} mm")
    console.print(f"label     {caption(result.state)}")
    console.print(f"          {numeric_caption(result.state, result.sensor)}")
    if pixels < _ROUGH_PIXELS:
        console.print(
            f"note      only {pixels} pixels touch: force and area are rough; a finer --grid helps"
        )
    if request.out is not None:
        _write(request.out, request, result)
        console.print(f"written   {request.out}")


def _check_replaceable(out: Path) -> None:
    """Refuse to replace what is no earlier press, as a measured map."""
    if not out.is_file() or not out.stat().st_size:
        return
    try:
        with zipfile.ZipFile(out) as file:
            names = {name.removesuffix(".npy") for name in file.namelist()}
    except (OSError, zipfile.BadZipFile):
        names = set()
    if not names >= {"height_mm", "pressure_kpa", "force_n", "depth_mm", "caption"}:
        raise UsageError(
            f"--out {out} exists and is no earlier press, so it is not replaced; name another file"
        )


def _write(out: Path, request: PressRequest, result: PressResult) -> None:
    values: dict[str, Any] = {
        "height_mm": result.height_mm,
        "pressure_kpa": result.pressure_kpa,
        "force_n": np.float64(result.force_n),
        "mm_per_px": np.float64(result.sensor.width_mm / result.height_mm.shape[1]),
        "cloud_mm": result.cloud.points_mm,
        "sensor": np.str_(result.sensor.name),
        "object": np.str_(request.object),
        "depth_mm": np.float64(request.depth_mm),
        "caption": np.str_(caption(result.state)),
    }
    if result.seen_mm is not None:
        values["seen_mm"] = result.seen_mm
    elif result.sensor.markers is not None:  # such a sensor sees no heights between its markers
        values["points_mm"] = result.cloud.points_mm
    try:
        with replacing(out) as part, part.open("wb") as file:
            np.savez_compressed(file, allow_pickle=False, **values)
    except OSError as error:
        raise UsageError(f"--out {out} can't be written: {error.strerror or error}") from None
