"""Messages of an episode for viewers of MCAP: transforms, pictures, text and numbers.

They repeat what the other messages of a step hold exactly, in Foxglove's schemas, so that Foxglove
and rerun show an episode without an export. ``read_episode`` needs none of them but the camera's
frame.

    /tf             foxglove.FrameTransforms  base -> tcp -> gel [m]
    /touch/heights  foxglove.CompressedImage  the gel's heights in colour, with the scale
    /touch/camera   foxglove.CompressedImage  the camera's frame, where the sensor has a camera
    /text           foxglove.Log              D_t and what was done; a survived failure as a warning
    /numbers        tacgrasp.Numbers          forces, contract and contact by name, units in names

The TCP is taken to be the middle between the pads: the gel lies half an opening from it.
"""

from __future__ import annotations

import math
from enum import StrEnum
from typing import Any

import numpy as np
from foxglove_schemas_protobuf.CompressedImage_pb2 import CompressedImage
from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms
from foxglove_schemas_protobuf.Log_pb2 import Log
from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from google.protobuf.message import DecodeError, Message

from cltp.tactile.cloud import FloatArray, Stamp
from cltp.tactile.measure import contact_state
from primitives.contract import Contract
from primitives.execution import PadAxes
from tacgrasp.episodes.height_image import height_png
from tacgrasp.episodes.record import EpisodeEnd, StepRecord, end_label
from tacgrasp.episodes.touch_message import FRAME_ID, wall_ns

BASE, TCP = "base", "tcp"
"""Frames of the arm; the gel's is that of the cloud."""


class ViewTopic(StrEnum):
    """MCAP channels for viewers."""

    TRANSFORMS = "/tf"
    HEIGHTS = "/touch/heights"
    CAMERA = "/touch/camera"
    TEXT = "/text"
    NUMBERS = "/numbers"


NUMBERS = (
    "felt_n",
    "felt_low_n",
    "felt_high_n",
    "goal_low_n",
    "goal_high_n",
    "limit_n",
    "commanded_n",
    "depth_mm",
    "x_mm",
    "y_mm",
    "area_percent",
    "opening_mm",
    "confidence",
    "step_ms",
)
"""Fields of ``tacgrasp.Numbers``; one that is not known in a step is left out of its message."""


def _numbers_class() -> Any:
    """The protobuf class of ``tacgrasp.Numbers``: optional doubles in the order of ``NUMBERS``."""
    file = descriptor_pb2.FileDescriptorProto(
        name="tacgrasp/Numbers.proto", package="tacgrasp", syntax="proto3"
    )
    message = file.message_type.add(name="Numbers")
    for index, name in enumerate(NUMBERS):
        message.field.add(
            name=name,
            number=index + 1,
            label=descriptor_pb2.FieldDescriptorProto.LABEL_OPTIONAL,
            type=descriptor_pb2.FieldDescriptorProto.TYPE_DOUBLE,
            proto3_optional=True,
            oneof_index=index,
        )
    for name in NUMBERS:
        message.oneof_decl.add(name=f"_{name}")
    pool = descriptor_pool.DescriptorPool()
    pool.Add(file)
    return message_factory.GetMessageClass(pool.FindMessageTypeByName("tacgrasp.Numbers"))


Numbers = _numbers_class()

SCHEMAS: dict[str, Any] = {
    ViewTopic.TRANSFORMS: FrameTransforms,
    ViewTopic.HEIGHTS: CompressedImage,
    ViewTopic.CAMERA: CompressedImage,
    ViewTopic.TEXT: Log,
    ViewTopic.NUMBERS: Numbers,
}
"""Protobuf class of each channel's messages."""


def step_messages(
    record: StepRecord, contract: Contract | None, pad: PadAxes | None
) -> dict[str, bytes]:
    """A step for viewers.

    Args:
        record: The step.
        contract: Contract in force; None in a record without one.
        pad: The pad's axes in the TCP frame; without them the gel has no place on the arm.
    """
    messages: dict[str, Message] = {
        ViewTopic.TRANSFORMS: _transforms(record, pad),
        ViewTopic.HEIGHTS: _image(record.stamp, FRAME_ID, height_png(record.cloud), "png"),
        ViewTopic.NUMBERS: Numbers(**numbers(record, contract)),
    }
    if record.camera_jpeg is not None:
        messages[ViewTopic.CAMERA] = _image(record.stamp, "camera", record.camera_jpeg, "jpeg")
    if text := step_text(record):
        level = Log.WARNING if record.note else Log.INFO
        messages[ViewTopic.TEXT] = _log(record.stamp, level, text, "policy")
    return {topic: message.SerializeToString() for topic, message in messages.items()}


def end_messages(end: EpisodeEnd) -> dict[str, bytes]:
    """The end of an episode for viewers, as text."""
    label = end_label(end.reason, end.truth)
    level = Log.INFO if label == "success" else Log.WARNING
    level = Log.ERROR if end.reason == "fault" else level
    message = _log(end.stamp, level, f"end: {label} - {end.message}", "end")
    return {ViewTopic.TEXT: message.SerializeToString()}


def numbers(record: StepRecord, contract: Contract | None) -> dict[str, float]:
    """The numbers of a step by their names in ``NUMBERS``; only those that are known."""
    state = contact_state(record.cloud, in_contact=record.in_contact)
    known = {
        "commanded_n": record.gripper.force_n,
        "opening_mm": 1000 * record.gripper.width_m,
        "step_ms": record.step_ms,
    }
    if record.felt_force_n is not None:
        felt = record.felt_force_n
        known |= {"felt_n": felt.value, "felt_low_n": felt.low, "felt_high_n": felt.high}
    if contract is not None and contract.force_n is not None:
        band = contract.force_n if record.need is None else record.need.force_n
        known |= {"goal_low_n": band.low, "goal_high_n": band.high}
    if contract is not None and contract.limit_n is not None:
        known["limit_n"] = contract.limit_n
    if state.in_contact:
        known |= {"depth_mm": state.depth_mm, "x_mm": state.x_mm, "y_mm": state.y_mm}
        known["area_percent"] = 100 * state.area_fraction
    if record.decision is not None:
        known["confidence"] = record.decision.confidence
    return {name: known[name] for name in NUMBERS if name in known}


def step_text(record: StepRecord) -> str:
    """D_t, the command that followed and what was survived; '' where nothing was said."""
    parts = [record.decision.text] if record.decision is not None else []
    if record.executed is not None and record.executed.primitive is not None:
        parts.append(f"[{record.executed.primitive}: {record.executed.sent}]")
    return " ".join([*parts, *([f"({record.note})"] if record.note else [])])


def decode_image(data: bytes) -> bytes:
    """The image file in a message; its pixels are not decoded.

    Raises:
        ValueError: Not an image message.
    """
    message = CompressedImage()
    try:
        message.ParseFromString(data)
    except DecodeError as error:
        raise ValueError(f"not a foxglove.CompressedImage: {error}") from None
    return bytes(message.data)


def quaternion(rotvec_rad: FloatArray) -> FloatArray:
    """Unit quaternion x, y, z, w of a rotation vector, shape (3,) [rad]."""
    angle = float(np.linalg.norm(rotvec_rad))
    if angle < 1e-12:
        return np.array([0.0, 0.0, 0.0, 1.0])
    return np.array([*(rotvec_rad * (math.sin(angle / 2) / angle)), math.cos(angle / 2)])


def tcp_from_gel(pad: PadAxes, width_m: float) -> tuple[FloatArray, FloatArray]:
    """Position of the gel's origin in the TCP frame [m], and its orientation as a quaternion.

    The gel's z, into the gel, points away from the object: half an opening along it lies the pad.
    """
    from scipy.spatial.transform import Rotation  # loaded by the first move anyway

    x, y = np.array(pad.x_tcp), np.array(pad.y_tcp)
    z = np.cross(x, y)
    rotation = Rotation.from_matrix(np.stack([x, y, z], axis=1))
    return z * width_m / 2, np.asarray(rotation.as_quat())


def _transforms(record: StepRecord, pad: PadAxes | None) -> FrameTransforms:
    message = FrameTransforms()
    pose = record.tcp_pose
    _add_transform(message, record.stamp, (BASE, TCP), pose.position_m, quaternion(pose.rotvec_rad))
    if pad is not None:
        position_m, turn = tcp_from_gel(pad, record.gripper.width_m)
        _add_transform(message, record.stamp, (TCP, FRAME_ID), position_m, turn)
    return message


def _add_transform(
    message: FrameTransforms,
    stamp: Stamp,
    frames: tuple[str, str],
    position_m: FloatArray,
    turn: FloatArray,
) -> None:
    transform = message.transforms.add(parent_frame_id=frames[0], child_frame_id=frames[1])
    transform.timestamp.FromNanoseconds(wall_ns(stamp))
    for axis, value in zip("xyz", position_m, strict=True):
        setattr(transform.translation, axis, float(value))
    for axis, value in zip("xyzw", turn, strict=True):
        setattr(transform.rotation, axis, float(value))


def _image(stamp: Stamp, frame_id: str, data: bytes, kind: str) -> CompressedImage:
    message = CompressedImage(frame_id=frame_id, data=data, format=kind)
    message.timestamp.FromNanoseconds(wall_ns(stamp))
    return message


def _log(stamp: Stamp, level: Any, text: str, name: str) -> Log:
    message = Log(level=level, message=text, name=name)
    message.timestamp.FromNanoseconds(wall_ns(stamp))
    return message
