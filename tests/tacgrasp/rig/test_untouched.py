"""The gel is held to its picture of the untouched gel before the first grasp, and only then."""

from pathlib import Path
from types import SimpleNamespace

import pytest

from cltp import TouchError
from primitives import RobotError
from primitives.devices import GripperState, Pose
from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tacgrasp.config.terms import contract_of
from tacgrasp.drivers.recorded.sensor import RecordedSensor
from tacgrasp.episodes.command_log import CommandLog
from tacgrasp.policy_factory import make_policy
from tacgrasp.rig.hardware import HardwareRig, RealClock
from tacgrasp.run import run_recorded
from tests.fakes.loop_fakes import SENSOR, FakeRig, touch

OPEN = GripperState(width_m=0.05, force_n=0.0, closed=False)


def rig_with(sensor, start_pose: Pose, state: GripperState = OPEN) -> HardwareRig:
    """A rig of drivers without an arm, and with a gripper that only has a state."""
    gripper = SimpleNamespace(state=lambda: state)
    return HardwareRig(
        arm=None, gripper=gripper, sensor=sensor, clock=RealClock(), start_pose=start_pose,
        command_log=CommandLog(lambda: 0.0), first_force_n=1.0, fault_counts=str,
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
        run_recorded(fake, make_policy("rules", settings), settings, contract_of(settings))
    assert fake.calls == []
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("state", "expected"),
    [
        (
            GripperState(width_m=0.03, force_n=0.42, closed=True),
            r"still grips, with 0\.42 N commanded and 30\.0 mm.*Support.*tacgrasp jog \(key o;",
        ),
        (
            GripperState(width_m=0.002, force_n=0.0, closed=False),
            r"2\.0 mm between the fingers, at least 5 mm are needed; open it.*tacgrasp jog",
        ),
    ],
)
def test_a_gripper_that_is_not_open_ends_a_run_before_anything_moves(
    tmp_path: Path, state: GripperState, expected: str
) -> None:
    fake = FakeRig()
    sensor = RecordedSensor("x", [touch], SENSOR, repeat=False)
    fake.expect_untouched = rig_with(sensor, fake.start_pose, state).expect_untouched
    settings = config(tmp_path)
    with pytest.raises(RobotError, match=expected):
        run_recorded(fake, make_policy("rules", settings), settings, contract_of(settings))
    assert fake.calls == []
    assert not list(tmp_path.iterdir())


def test_in_a_dry_run_somebody_holds_the_object_and_the_gel_is_touched(tmp_path):
    fake, checks = FakeRig(), []
    fake.expect_untouched = lambda: checks.append("untouched")
    settings = config(tmp_path, dry_run=True)
    outcome, _ = run_recorded(fake, make_policy("rules", settings), settings, contract_of(settings))
    assert outcome.num_steps == 1
    assert not checks


def test_a_recording_has_no_such_picture_and_plays_nothing_for_the_check():
    sensor = RecordedSensor("x", [touch], SENSOR, repeat=False)
    rig_with(sensor, FakeRig().start_pose).expect_untouched()
    sensor.read()  # its only touch is still there
