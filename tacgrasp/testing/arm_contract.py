"""What every Arm must do; run by subclassing ``ArmContract`` with a fixture ``arm``.

A subclass may set ``tolerance_m`` (how exactly a pose is reached), and ``outside_m``, a position
that the device itself refuses (None where it refuses nothing). Moves stay within 3 mm of the start.
"""

from __future__ import annotations

import numpy as np
import pytest

from primitives import LimitError
from primitives.devices import Arm, Pose


def shifted(pose: Pose, x_mm: float, y_mm: float, z_mm: float) -> Pose:
    """A pose beside another, in the base frame."""
    step_m = 1e-3 * np.array([x_mm, y_mm, z_mm])
    return Pose(position_m=pose.position_m + step_m, rotvec_rad=pose.rotvec_rad)


class ArmContract:
    """Subclass as Test... and give a fixture ``arm`` that yields a connected, resting arm."""

    tolerance_m = 1e-4
    outside_m: tuple[float, float, float] | None = None

    def test_a_resting_arm_reports_one_pose(self, arm: Arm) -> None:
        first, second = arm.pose(), arm.pose()
        assert second.position_m == pytest.approx(first.position_m, abs=self.tolerance_m)

    @pytest.mark.parametrize("step", [(3, 0, 0), (0, -3, 0), (0, 0, 3)])
    def test_a_move_ends_where_it_was_asked_and_says_so(
        self, arm: Arm, step: tuple[float, float, float]
    ) -> None:
        target = shifted(arm.pose(), *step)
        reached = arm.move_to(target)
        assert reached.position_m == pytest.approx(target.position_m, abs=self.tolerance_m)
        assert arm.pose().position_m == pytest.approx(reached.position_m, abs=self.tolerance_m)
        assert arm.pose().rotvec_rad == pytest.approx(target.rotvec_rad, abs=1e-3)

    def test_there_and_back_is_where_it_was(self, arm: Arm) -> None:
        start = arm.pose()
        arm.move_to(shifted(start, 0, 0, 3))
        back = arm.move_to(start)
        assert back.position_m == pytest.approx(start.position_m, abs=self.tolerance_m)

    def test_a_pose_outside_the_device_is_refused_without_moving(self, arm: Arm) -> None:
        if self.outside_m is None:
            pytest.skip("this device refuses no position")
        start = arm.pose()
        far = Pose(position_m=np.array(self.outside_m), rotvec_rad=start.rotvec_rad)
        with pytest.raises(LimitError):
            arm.move_to(far)
        assert arm.pose().position_m == pytest.approx(start.position_m, abs=self.tolerance_m)

    def test_stop_can_be_called_again_and_again(self, arm: Arm) -> None:
        start = arm.pose()
        arm.stop()
        arm.stop()
        assert arm.pose().position_m == pytest.approx(start.position_m, abs=self.tolerance_m)

    def test_disconnect_can_be_called_again_and_stop_after_it(self, arm: Arm) -> None:
        arm.disconnect()
        arm.disconnect()
        arm.stop()
