"""The gel is held to its picture of the untouched gel before the first grasp, and only then."""

from pathlib import Path

import pytest

from cltp import TouchError
from primitives import RobotError
from primitives.devices import Pose
from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tacgrasp.episodes.command_log import CommandLog
from tacgrasp.policy_factory import make_policy
from tacgrasp.rig.hardware import HardwareRig, RealClock
from tacgrasp.run import run_recorded
from tests.fakes.loop_fakes import FakeRig


def rig_with(sensor, start_pose: Pose) -> HardwareRig:
    """A rig of drivers whose other devices are not asked for anything."""
    return HardwareRig(
        arm=None, gripper=None, sensor=sensor, clock=RealClock(), commands=CommandLog(lambda: 0.0),
        start_pose=start_pose, first_force_n=1.0, survived=str,
    )  # fmt: skip


class Stale:
    def expect_untouched(self) -> None:
        raise TouchError("stale background: take a new one")


def config(folder: Path, **changes: object) -> RunConfig:
    return load("strawberry")[0].model_copy(update={"policy": "rules", "record": folder, **changes})


def test_a_stale_background_ends_a_run_before_anything_moves_and_no_episode_is_begun(tmp_path):
    fake = FakeRig()
    rig = rig_with(Stale(), fake.start_pose)
    fake.expect_untouched = rig.expect_untouched
    settings = config(tmp_path)
    with pytest.raises(RobotError, match=r"stale background.*open them: tacgrasp jog"):
        run_recorded(fake, make_policy("rules", settings), settings)
    assert fake.calls == []
    assert not list(tmp_path.iterdir())


def test_in_a_dry_run_somebody_holds_the_object_and_the_gel_is_touched(tmp_path):
    fake, asked = FakeRig(), []
    fake.expect_untouched = lambda: asked.append("untouched")
    settings = config(tmp_path, dry_run=True)
    outcome, _ = run_recorded(fake, make_policy("rules", settings), settings)
    assert outcome.turns == 1
    assert not asked


def test_of_a_sensor_without_such_a_picture_nothing_is_asked():
    rig_with(object(), FakeRig().start_pose).expect_untouched()
