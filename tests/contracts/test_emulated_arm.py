"""The contract of an arm, run through ur_rtde on an emulated UR controller."""

import os

import pytest

from sim.emulators.process.spawn import EmulatorProcess
from tacgrasp.drivers.ur.arm import connect_arm
from tacgrasp.testing import ArmContract
from tests.fakes.emulated_arm import emulated_arm

pytest.importorskip("rtde_control")


@pytest.fixture(scope="module")
def connected():
    """One arm for all tests; one that was disconnected is connected again before the next."""
    high, low = divmod(os.getpid() % (254 * 254), 254)
    with EmulatorProcess("ur", "--host", f"127.40.{high + 1}.{low + 1}") as emulator:
        arm = connect_arm(emulated_arm(str(emulator.ready["host"])))
        yield arm
        arm.disconnect()


class TestEmulatedArm(ArmContract):
    outside_m = (0.45, -0.10, 0.05)

    @pytest.fixture
    def arm(self, connected):
        if connected.fault:
            connected.reset()
        return connected
