"""The contracts of arm, gripper and sensor, run on the simulated rig."""

import pytest

from sim.grasp.rig import build
from tacgrasp.testing import ArmContract, GripperContract, SensorContract


class TestSimulatedArm(ArmContract):
    outside_m = (2.0, 0.0, 0.2)

    @pytest.fixture
    def arm(self):
        return build("strawberry", 1).arm


class TestSimulatedGripper(GripperContract):
    @pytest.fixture
    def gripper(self):
        return build("strawberry", 1, start_offset_mm=(0.0, 0.0)).gripper


class TestSimulatedSensor(SensorContract):
    @pytest.fixture
    def sensor(self):
        rig = build("strawberry", 1, start_offset_mm=(0.0, 0.0))
        rig.gripper.grip(1.0)
        return rig.sensor

    @pytest.fixture
    def untouched_sensor(self):
        return build("strawberry", 1).sensor


class TestSimulatedSensorOfAnUntouchedGel(SensorContract):
    @pytest.fixture
    def sensor(self):
        return build("strawberry", 1).sensor
