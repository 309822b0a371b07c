"""tacgrasp's contract suites on what this package adds, and an episode with all of it."""

from pathlib import Path

import pytest
from tacgrasp_raspberry.devices import (
    ArmSettings,
    BenchArm,
    BenchGripper,
    BenchSensor,
    GripperSettings,
    SensorSettings,
)
from tacgrasp_raspberry.patient import PatientPolicy

from tacgrasp import api
from tacgrasp.testing import ArmContract, GripperContract, PolicyContract, SensorContract

RIG = Path(__file__).parents[1] / "rig.yaml"
BOX = {"workspace_low_m": (0.35, -0.2, 0.12), "workspace_high_m": (0.55, 0.0, 0.4)}


class TestArm(ArmContract):
    outside_m = (0.45, -0.10, 0.05)

    @pytest.fixture
    def arm(self):
        arm = BenchArm(ArmSettings(bench="test", **BOX))
        yield arm
        arm.disconnect()


class TestGripper(GripperContract):
    @pytest.fixture
    def gripper(self):
        gripper = BenchGripper(GripperSettings(bench="test", max_force_n=12.0))
        yield gripper
        gripper.disconnect()


class TestSensor(SensorContract):
    @pytest.fixture
    def sensor(self):
        sensor = BenchSensor(SensorSettings(bench="test"))
        yield sensor
        sensor.disconnect()


class TestPolicy(PolicyContract):
    def make(self):
        return PatientPolicy(move_step_mm=3.0)


@pytest.mark.parametrize("rig", ["sim", str(RIG)])
def test_an_episode_with_the_task_the_policy_and_either_rig_succeeds(rig, tmp_path):
    task = "raspberry" if rig == "sim" else "strawberry"
    run = api.configure(task, rig, policy="patient", seed=1, record=tmp_path)
    with api.connect(run) as devices:
        episode = api.run_episode(run, devices, api.make_policy(run))
    assert episode.outcome.reason == "success", episode.outcome.message
