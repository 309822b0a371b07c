"""Tactile clouds as ``foxglove.PointCloud`` messages in metres, restored bit for bit.

Viewers count in metres, a cloud in float32 millimetres. Metres in float64 hold both: a float32
times 0.001 in float64 and back is off by 2**-52 of its value, and rounds to the same float32.
Format 1 had float32 millimetres, and is still read.
"""

from __future__ import annotations

import numpy as np
from foxglove_schemas_protobuf.PackedElementField_pb2 import PackedElementField
from foxglove_schemas_protobuf.PointCloud_pb2 import PointCloud
from google.protobuf.message import DecodeError

from cltp.tactile.cloud import Stamp, TactileCloud
from cltp.tactile.force_scale import UNCALIBRATED, ForceScale
from cltp.tactile.sensors import SensorSpec

FRAME_ID = "gel"
_METRES = [(name, 8 * i, PackedElementField.FLOAT64) for i, name in enumerate("xyz")]
_MILLIMETRES = [(name, 4 * i, PackedElementField.FLOAT32) for i, name in enumerate("xyz")]
_MM_PER_M = 1000.0


def wall_ns(stamp: Stamp) -> int:
    """Wall clock of a stamp in whole nanoseconds; MCAP allows no negative time."""
    return max(0, round(stamp.wall_s * 1e9))


def encode_cloud(cloud: TactileCloud, stamp: Stamp) -> bytes:
    """Serialise a cloud [m]; ``stamp`` is the time of a cloud without a stamp of its own."""
    points_m = cloud.points_mm.astype("<f8") / _MM_PER_M
    message = PointCloud(frame_id=FRAME_ID, point_stride=3 * points_m.itemsize)
    message.timestamp.FromNanoseconds(wall_ns(cloud.stamp or stamp))
    message.pose.orientation.w = 1.0  # identity: the points are in the gel frame already
    for name, offset, kind in _METRES:
        message.fields.add(name=name, offset=offset, type=kind)
    message.data = points_m.tobytes()
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
    in_metres = layout == _METRES
    stride = 24 if in_metres else 12
    known = layout in (_METRES, _MILLIMETRES) and message.point_stride == stride
    if not known or len(message.data) % stride:
        raise ValueError(f"the cloud's fields are {layout}; expected x, y, z as float64 [m]")
    stored = np.frombuffer(message.data, dtype="<f8" if in_metres else "<f4").reshape(-1, 3)
    with np.errstate(over="ignore"):  # infinite points are refused by the cloud
        points_mm = (stored * _MM_PER_M if in_metres else stored).astype(np.float32)
    return TactileCloud(points_mm=points_mm, sensor=sensor, stamp=stamp, force_scale=force_scale)
