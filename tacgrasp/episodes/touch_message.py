"""Tactile clouds as ``foxglove.PointCloud`` messages in metres, restored bit for bit.

Viewers count in metres, a cloud in float32 millimetres. A point has x, y, z in float32 metres, and
rx, ry, rz in int8: by how many steps of float32 a thousand times the metres miss the millimetres.
Format 1 had float32 millimetres alone, and is still read.

Shear fields are JSON, of the same exactness.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from foxglove_schemas_protobuf.PackedElementField_pb2 import PackedElementField
from foxglove_schemas_protobuf.PointCloud_pb2 import PointCloud
from google.protobuf.message import DecodeError
from numpy.typing import NDArray

from cltp.tactile.cloud import Stamp, TactileCloud
from cltp.tactile.force_scale import UNCALIBRATED, ForceScale
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.shear.field import ShearField

FRAME_ID = "gel"
_METRES = np.dtype([(name, "<f4") for name in "xyz"] + [(f"r{name}", "i1") for name in "xyz"])
_MILLIMETRES = np.dtype([(name, "<f4") for name in "xyz"])
_KINDS = {"f": PackedElementField.FLOAT32, "i": PackedElementField.INT8}


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
        bits = [_millimetres(metres).view(np.int32) for metres in columns]
        columns = [
            (each + packed[f"r{name}"]).view(np.float32)
            for name, each in zip("xyz", bits, strict=True)
        ]
    return TactileCloud(
        points_mm=np.stack(columns, axis=1), sensor=sensor, stamp=stamp, force_scale=force_scale
    )


def _packed(points_mm: NDArray[np.float32]) -> NDArray[np.void]:
    """Points in metres with their steps; in millimetres where float32 has no such metres."""
    points_m = (points_mm.astype(np.float64) / 1000).astype(np.float32)
    # two numbers of one sign: neighbours in float32 differ by 1 in their bits
    steps = points_mm.view(np.int32) - _millimetres(points_m).view(np.int32)
    if np.abs(steps).max() > np.iinfo(np.int8).max:  # below 1e-35 mm: never of a gel
        return np.ascontiguousarray(points_mm).view(_MILLIMETRES).ravel()
    packed = np.empty(len(points_mm), _METRES)
    for axis, name in enumerate("xyz"):
        packed[name], packed[f"r{name}"] = points_m[:, axis], steps[:, axis]
    return packed


def _layout(kind: np.dtype[np.void]) -> list[tuple[str, int, int]]:
    names = kind.names or ()
    offsets = np.cumsum([0, *(kind[name].itemsize for name in names)])
    return [
        (name, int(offset), _KINDS[kind[name].kind])
        for name, offset in zip(names, offsets, strict=False)
    ]


def _millimetres(metres: NDArray[np.float32]) -> NDArray[np.float32]:
    with np.errstate(over="ignore", invalid="ignore"):  # such points are refused by the cloud
        return (metres.astype(np.float64) * 1000).astype(np.float32)


@dataclass(frozen=True, slots=True, kw_only=True)
class ShearMessage:
    """A shear field as it lies in the file.

    Attributes:
        index: Number of the step.
        stamp: Start of the step, on both clocks [s].
        captured: Time of capture of the field, None where it had no clock [s].
        positions_mm: x and y of the points, point by point [mm, gel frame].
        displacement_mm: x, y and z of their displacements, z into the gel, point by point [mm].
        force_n: x, y and z of the forces on them, likewise [N]; None where the sensor gives none.
    """

    index: int
    stamp: Stamp
    captured: Stamp | None
    positions_mm: NDArray[np.float64]
    displacement_mm: NDArray[np.float64]
    force_n: NDArray[np.float64] | None = None

    @classmethod
    def of(cls, field: ShearField, *, index: int, stamp: Stamp) -> ShearMessage:
        """The message of a step's field."""
        return cls(
            index=index,
            stamp=stamp,
            captured=field.stamp,
            positions_mm=field.positions_mm.ravel().astype(np.float64),
            displacement_mm=field.displacement_mm.ravel().astype(np.float64),
            force_n=None if field.force_n is None else field.force_n.ravel().astype(np.float64),
        )

    def field(self, sensor: SensorSpec) -> ShearField:
        """The field, measured by the sensor of the episode.

        Raises:
            ValueError: The numbers are not those of whole points.
            TouchError: They are no field of this sensor.
        """
        return ShearField(
            positions_mm=self.positions_mm.reshape(-1, 2).astype(np.float32),
            displacement_mm=self.displacement_mm.reshape(-1, 3).astype(np.float32),
            force_n=None
            if self.force_n is None
            else self.force_n.reshape(-1, 3).astype(np.float32),
            sensor=sensor,
            stamp=self.captured,
        )
