"""Tactile clouds as ``foxglove.PointCloud`` messages, bit for bit in float32 millimetres."""

from __future__ import annotations

import numpy as np
from foxglove_schemas_protobuf.PackedElementField_pb2 import PackedElementField
from foxglove_schemas_protobuf.PointCloud_pb2 import PointCloud
from google.protobuf.message import DecodeError

from cltp.tactile.cloud import Stamp, TactileCloud
from cltp.tactile.force_scale import UNCALIBRATED, ForceScale
from cltp.tactile.sensors import SensorSpec

FRAME_ID = "gel"
_LAYOUT = [(name, 4 * i, PackedElementField.FLOAT32) for i, name in enumerate("xyz")]
_LITTLE = np.dtype("<f4")


def wall_ns(stamp: Stamp) -> int:
    """Wall clock of a stamp in whole nanoseconds; MCAP allows no negative time."""
    return max(0, round(stamp.wall_s * 1e9))


def encode_cloud(cloud: TactileCloud, stamp: Stamp) -> bytes:
    """Serialise a cloud; ``stamp`` is the time of a cloud without a stamp of its own."""
    points = cloud.points_mm.astype(_LITTLE, copy=False)
    message = PointCloud(frame_id=FRAME_ID, point_stride=3 * _LITTLE.itemsize)
    message.timestamp.FromNanoseconds(wall_ns(cloud.stamp or stamp))
    message.pose.orientation.w = 1.0  # identity: the points are in the gel frame already
    for name, offset, kind in _LAYOUT:
        message.fields.add(name=name, offset=offset, type=kind)
    message.data = points.tobytes()
    return message.SerializeToString()


def decode_cloud(
    data: bytes,
    sensor: SensorSpec,
    stamp: Stamp | None,
    force_scale: ForceScale = UNCALIBRATED,
) -> TactileCloud:
    """Restore a cloud from ``encode_cloud``.

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
    if layout != _LAYOUT or message.point_stride != 12 or len(message.data) % 12:
        raise ValueError(f"the cloud's fields are {layout}; expected x, y, z as float32 [mm]")
    points = np.frombuffer(message.data, dtype=_LITTLE).reshape(-1, 3)
    return TactileCloud(
        points_mm=points.astype(np.float32, copy=False),
        sensor=sensor,
        stamp=stamp,
        force_scale=force_scale,
    )
