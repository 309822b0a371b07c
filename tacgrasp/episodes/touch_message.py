"""Tactile clouds as ``foxglove.PointCloud`` messages in metres, restored bit for bit.

Viewers count in metres, a cloud in float32 millimetres. A point has x, y, z in float32 metres, and
rx, ry, rz in int8: by how many steps of float32 a thousand times the metres miss the millimetres.
Format 1 had float32 millimetres alone, and is still read.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from foxglove_schemas_protobuf.PackedElementField_pb2 import PackedElementField
from foxglove_schemas_protobuf.PointCloud_pb2 import PointCloud
from google.protobuf.message import DecodeError
from numpy.typing import NDArray

from cltp.tactile.cloud import Stamp, TactileCloud
from cltp.tactile.force_scale import UNCALIBRATED, ForceScale
from cltp.tactile.sensors import SensorSpec

FRAME_ID = "gel"
_METRES = np.dtype([(name, "<f4") for name in "xyz"] + [(f"r{name}", "i1") for name in "xyz"])
_MILLIMETRES = np.dtype([(name, "<f4") for name in "xyz"])
_KINDS = {"f": PackedElementField.FLOAT32, "i": PackedElementField.INT8}
_SIGN = -(1 << 31)


def wall_ns(stamp: Stamp) -> int:
    """Wall clock of a stamp in whole nanoseconds; MCAP allows no negative time."""
    return max(0, round(stamp.wall_s * 1e9))


def encode_cloud(cloud: TactileCloud, stamp: Stamp) -> bytes:
    """Serialise a cloud [m]; ``stamp`` is the time of a cloud without a stamp of its own."""
    packed = _packed(cloud.points_mm)
    message = PointCloud(frame_id=FRAME_ID, point_stride=packed.itemsize)
    message.timestamp.FromNanoseconds(wall_ns(cloud.stamp or stamp))
    message.pose.orientation.w = 1.0  # identity: the points are in the gel frame already
    for name, offset, kind in _layout(packed.dtype):
        message.fields.add(name=name, offset=offset, type=kind)
    message.data = packed.tobytes()
    return message.SerializeToString()


def decode_cloud(
    data: bytes,
    sensor: SensorSpec,
    stamp: Stamp | None,
    force_scale: ForceScale = UNCALIBRATED,
) -> TactileCloud:
    """Restore a cloud from ``encode_cloud``, of this format or of format 1.

    Raises:
        ValueError: Not a point cloud of ours.
        TouchError: The points don't fit ``sensor``.
    """
    message = PointCloud()
    try:
        message.ParseFromString(data)
    except DecodeError as error:
        raise ValueError(f"not a foxglove.PointCloud: {error}") from None
    layout = [(f.name, f.offset, f.type) for f in message.fields]
    kind = next((k for k in (_METRES, _MILLIMETRES) if layout == _layout(k)), None)
    if kind is None or message.point_stride != kind.itemsize or len(message.data) % kind.itemsize:
        raise ValueError(f"the cloud's fields are {layout}; expected x, y, z and rx, ry, rz [m]")
    packed = np.frombuffer(message.data, dtype=kind)
    columns = [packed[name] for name in "xyz"]
    if kind is _METRES:
        columns = [
            _stepped(_millimetres(metres), packed[f"r{name}"])
            for name, metres in zip("xyz", columns, strict=True)
        ]
    return TactileCloud(
        points_mm=np.stack(columns, axis=1), sensor=sensor, stamp=stamp, force_scale=force_scale
    )


def _packed(points_mm: NDArray[np.float32]) -> NDArray[np.void]:
    """Points in metres with their steps; in millimetres where float32 has no such metres."""
    points_m = (points_mm.astype(np.float64) / 1000).astype(np.float32)
    steps = _steps(points_mm) - _steps(_millimetres(points_m))
    if np.abs(steps).max() > np.iinfo(np.int8).max:  # below 1e-35 mm: never of a gel
        return np.ascontiguousarray(points_mm).view(_MILLIMETRES).ravel()
    packed = np.empty(len(points_mm), _METRES)
    for axis, name in enumerate("xyz"):
        packed[name], packed[f"r{name}"] = points_m[:, axis], steps[:, axis]
    return packed


def _layout(kind: np.dtype[np.void]) -> list[tuple[str, int, int]]:
    fields: Mapping[str, Any] = kind.fields or {}
    return [(name, int(fields[name][1]), _KINDS[fields[name][0].kind]) for name in kind.names or ()]


def _millimetres(metres: NDArray[np.float32]) -> NDArray[np.float32]:
    with np.errstate(over="ignore", invalid="ignore"):  # such points are refused by the cloud
        return (metres.astype(np.float64) * 1000).astype(np.float32)


def _steps(values: NDArray[np.float32]) -> NDArray[np.int64]:
    """Numbers of float32 in their order: neighbours differ by 1."""
    bits = np.ascontiguousarray(values, dtype=np.float32).view(np.int32).astype(np.int64)
    return np.where(bits < 0, _SIGN - bits, bits)


def _stepped(values: NDArray[np.float32], steps: NDArray[np.int8]) -> NDArray[np.float32]:
    """The numbers of float32 that lie so many steps from ``values``."""
    ordered = _steps(values) + steps
    bits = np.where(ordered < 0, _SIGN - ordered, ordered)
    return np.where(steps == 0, values, bits.astype(np.int32).view(np.float32))  # keeps -0.0
