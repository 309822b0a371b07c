"""Commands to the devices are noted from both sides, and lie in the episode."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from primitives import LimitError
from primitives.devices import Pose
from sim.grasp.rig import build
from tacgrasp.episodes import EpisodeWriter, read_episode
from tacgrasp.episodes.command_log import Command, CommandLog, LoggedArm, LoggedGripper
from tests.fakes.episode_samples import end, header, same, step_record


@pytest.fixture
def log():
    steps = iter(range(100))
    return CommandLog(lambda: float(next(steps)))


@pytest.fixture
def rig():
    return build("strawberry", 1, start_offset_mm=(0.0, 0.0))


def moved(pose: Pose, x_m: float) -> Pose:
    return Pose(position_m=pose.position_m + np.array([x_m, 0, 0]), rotvec_rad=pose.rotvec_rad)


def test_a_move_is_noted_as_asked_sent_and_reached(log, rig):
    arm = LoggedArm(rig.arm, log, lambda: "moveL 1 2 3")
    arm.move_to(moved(rig.start_pose, 0.003), speed_m_s=0.1, acceleration_m_s2=0.2)
    (command,) = log.take()
    pose = "(0.45300, -0.10000, 0.20000) m, (3.1416, 0.0000, 0.0000) rad"
    assert command == Command(
        device="arm",
        asked=f"move to {pose} at 0.1 m/s, 0.2 m/s²",
        sent="moveL 1 2 3",
        reached=pose,
        error="",
        started_s=0.0,
        ended_s=1.0,
    )
    assert log.take() == ()


def test_grips_and_openings_are_noted_in_order(log, rig):
    gripper = LoggedGripper(rig.gripper, log, lambda: "goal current 12")
    gripper.grip(1.5)
    gripper.open_by(0.002)
    gripper.stop()
    commands = log.take()
    assert [c.asked for c in commands] == ["grip with 1.5 N", "open by 2 mm", "stop"]
    assert commands[0].reached.startswith("closed, ")
    assert commands[0].reached.endswith("1.5 N commanded")
    assert commands[1].reached.startswith("open, ")


def test_a_refused_command_is_noted_with_why_and_with_nothing_reached(log, rig):
    arm = LoggedArm(rig.arm, log, lambda: "")
    with pytest.raises(LimitError, match="reach"):
        arm.move_to(moved(rig.start_pose, 3.0))
    (command,) = log.take()
    assert (command.sent, command.reached) == ("", "")
    assert "reach of 0.9 m" in command.error


def test_commands_are_read_from_an_episode_as_they_were_written(tmp_path: Path, log, rig):
    arm = LoggedArm(rig.arm, log, lambda: "moveL")
    arm.move_to(moved(rig.start_pose, np.pi / 1000))
    first = log.take()
    arm.stop()
    written = replace(step_record(0), commands=first)
    last = replace(end(), commands=log.take())
    path = tmp_path / "e.mcap"
    with EpisodeWriter(path, header()) as writer:
        writer.write_step(written)
        writer.write_step(step_record(1))
        writer.finish(last)
    episode = read_episode(path)
    assert same(episode.steps, (written, step_record(1)))
    assert same(episode.end, last)
    assert [c.asked for c in episode.end.commands] == ["stop"]
