"""Contract suites: what every arm, gripper, sensor and policy must do, for pytest.

Subclass a suite as ``Test...`` and give it the device or policy:

    from tacgrasp.testing import SensorContract

    class TestMySensor(SensorContract):
        @pytest.fixture
        def sensor(self):
            ...

Needs pytest. Not here: tests of tacgrasp's own devices (``tests/contracts``).

May import: cltp, cltp.tactile, policies, policies.extraction, primitives, tacgrasp.rig.
"""

import pytest

pytest.register_assert_rewrite(
    *(f"tacgrasp.testing.{name}_contract" for name in ("arm", "gripper", "policy", "sensor"))
)

from tacgrasp.testing.arm_contract import ArmContract  # noqa: E402 - after the rewriting
from tacgrasp.testing.gripper_contract import GripperContract  # noqa: E402
from tacgrasp.testing.policy_contract import CLOUDS, CONTRACT, PolicyContract  # noqa: E402
from tacgrasp.testing.sensor_contract import SensorContract  # noqa: E402

__all__ = [
    "CLOUDS",
    "CONTRACT",
    "ArmContract",
    "GripperContract",
    "PolicyContract",
    "SensorContract",
]
