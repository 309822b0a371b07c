"""Show an episode, a rig or a sensor in a stream of rerun.

Nothing moves while a rig is shown. Not here: the viewer's process (``tacgrasp.viewer.server``).
"""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from cltp.sensing.frames import jpeg_of
from primitives.devices import GripperState, Pose
from primitives.execution import PadAxes
from tacgrasp.base.stop_signals import until_ctrl_c
from tacgrasp.config.schema import RunConfig
from tacgrasp.episodes import Episode, EpisodeHeader
from tacgrasp.rig.protocols import CameraSensor, Rig, TactileSensor
from tacgrasp.viewer.scene import APPLICATION, RerunScene

if TYPE_CHECKING:
    import rerun as rr

RATE_HZ = 10.0
"""Readings a second of a live view. Our choice: smooth for people, light for the devices."""


def show_episode(episode: Episode, stream: rr.RecordingStream) -> int:
    """Log a recorded episode; returns its number of steps."""
    scene = RerunScene(stream, episode.header.contract, episode.header.pad)
    for step in episode.steps:
        scene.step(step)
    if episode.end is not None:
        scene.end(episode.end)
    return len(episode.steps)


def recording_id(header: EpisodeHeader) -> str:
    """Name of an episode's recording: rerun merges those of one name."""
    return f"{header.task} {header.stamp.wall_s:.6f} {header.seed}"


def write_rrd(episode: Episode, path: Path) -> None:
    """Write an episode as a file of rerun, with its layout.

    Raises:
        OSError: The file can't be written.
    """
    import rerun

    path.touch()  # an error of the disk is raised here
    stream = rerun.RecordingStream(APPLICATION, recording_id=recording_id(episode.header))
    stream.save(path)
    show_episode(episode, stream)
    stream.flush()
    stream.disconnect()


def pad_of(config: RunConfig) -> PadAxes:
    """The pad's axes of a configured rig."""
    return PadAxes(x_tcp=config.pad.x_axis, y_tcp=config.pad.y_axis)


def show_rig(rig: Rig, config: RunConfig, stream: rr.RecordingStream, seconds: float) -> int:
    """Log sensor, arm and gripper as they are, until the time is over; returns the readings.

    Raises:
        TouchError: The sensor has failed.
        RobotError: Arm or gripper have failed.
    """
    scene = RerunScene(stream, None, pad_of(config))
    return _watch(rig.sensor, seconds, scene, arm=lambda: (rig.arm.pose(), rig.gripper.state()))


def show_sensor(sensor: TactileSensor, stream: rr.RecordingStream, seconds: float) -> int:
    """Log a sensor alone, until the time is over; returns the readings.

    Raises:
        TouchError: The sensor has failed.
    """
    return _watch(sensor, seconds, RerunScene(stream, None, None), arm=lambda: None)


def _watch(
    sensor: TactileSensor,
    seconds: float,
    scene: RerunScene,
    *,
    arm: Callable[[], tuple[Pose, GripperState] | None],
) -> int:
    number, start_s, due_s = 0, time.monotonic(), time.monotonic()
    with until_ctrl_c():
        while time.monotonic() - start_s < seconds:
            cloud = sensor.read()
            frame = sensor.last_frame() if isinstance(sensor, CameraSensor) else None
            jpeg = None if frame is None else jpeg_of(frame)
            scene.reading(time.monotonic(), number, cloud, arm(), jpeg)
            number += 1
            due_s = max(due_s + 1 / RATE_HZ, time.monotonic())
            time.sleep(max(0.0, due_s - time.monotonic()))
    return number
