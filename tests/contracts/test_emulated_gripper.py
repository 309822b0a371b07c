"""The Gripper contract on the Dynamixel driver and emulated servos, through the real SDK."""

import pytest

from sim.emulators.dynamixel.bus_process import DynamixelEmulator
from sim.emulators.dynamixel.fingers import SpringLoad
from sim.emulators.dynamixel.options import ServoOptions
from tacgrasp.drivers.dynamixel.gripper import connect_gripper
from tacgrasp.testing import GripperContract
from tests.fakes.emulated_servos import emulated_gripper

pytest.importorskip("dynamixel_sdk")


class TestEmulatedGripper(GripperContract):
    model, num_servos = "XC330-T288", 1

    @pytest.fixture
    def gripper(self, tmp_path):
        emulator = DynamixelEmulator(
            SpringLoad(width_m=0.08), ServoOptions(model=self.model, num_servos=self.num_servos)
        )
        settings = emulated_gripper(
            emulator.serial_port, tmp_path, model=self.model, num_servos=self.num_servos
        )
        gripper = connect_gripper(settings, folder=tmp_path)
        yield gripper
        gripper.disconnect()
        emulator.close()


class TestEmulatedGripperOfTwoServos(TestEmulatedGripper):
    model, num_servos = "XM430-W350", 2
