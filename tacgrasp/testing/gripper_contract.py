"""What every Gripper must do; run by subclassing ``GripperContract`` with a fixture ``gripper``.

A subclass may set ``force_n`` (a force that the device takes) and ``tolerance_m``.
"""

from __future__ import annotations

import math

import pytest

from primitives import LimitError
from primitives.devices import AdjustableGripper, Gripper


class GripperContract:
    """Subclass as Test... and give a fixture ``gripper`` that yields an open, connected gripper."""

    force_n = 1.0
    too_much_n = 1e6
    tolerance_m = 5e-4

    def test_an_open_gripper_presses_nothing(self, gripper: Gripper) -> None:
        state = gripper.state()
        assert (state.closed, state.force_n) == (False, 0.0)
        assert math.isfinite(state.width_m)
        assert state.width_m >= 0

    def test_gripping_closes_and_reports_the_commanded_force(self, gripper: Gripper) -> None:
        before = gripper.state().width_m
        state = gripper.grip(self.force_n)
        assert state.closed
        assert state.force_n == pytest.approx(self.force_n)
        assert state.width_m <= before + self.tolerance_m
        assert gripper.state() == state

    def test_a_grip_can_be_adjusted_up_and_down(self, gripper: Gripper) -> None:
        gripper.grip(self.force_n)
        assert gripper.grip(1.5 * self.force_n).force_n == pytest.approx(1.5 * self.force_n)
        assert gripper.grip(0.65 * self.force_n).force_n == pytest.approx(0.65 * self.force_n)

    def test_a_gripper_that_adjusts_at_once_takes_a_closed_grip_alone(
        self, gripper: Gripper
    ) -> None:
        if not isinstance(gripper, AdjustableGripper):
            pytest.skip("this gripper has no adjust")
        with pytest.raises(LimitError):
            gripper.adjust(self.force_n)
        gripper.grip(self.force_n)
        assert gripper.adjust(1.2 * self.force_n).force_n == pytest.approx(1.2 * self.force_n)
        for refused in (self.too_much_n, math.nan, 0.0):
            with pytest.raises(LimitError):
                gripper.adjust(refused)
        assert gripper.state().force_n == pytest.approx(1.2 * self.force_n)

    def test_opening_frees_the_object_by_as_much_as_asked(self, gripper: Gripper) -> None:
        closed = gripper.grip(self.force_n)
        state = gripper.open_by(0.005)
        assert (state.closed, state.force_n) == (False, 0.0)
        assert state.width_m - closed.width_m == pytest.approx(0.005, abs=self.tolerance_m)

    @pytest.mark.parametrize("force", [0.0, -1.0, math.nan, math.inf])
    def test_a_force_that_is_none_is_refused_and_nothing_moves(
        self, gripper: Gripper, force: float
    ) -> None:
        before = gripper.state()
        with pytest.raises(LimitError):
            gripper.grip(force)
        assert gripper.state() == before

    def test_a_force_beyond_the_device_is_refused_and_nothing_moves(self, gripper: Gripper) -> None:
        before = gripper.state()
        with pytest.raises(LimitError):
            gripper.grip(self.too_much_n)
        assert gripper.state() == before

    def test_stop_keeps_the_grip_and_can_be_called_again(self, gripper: Gripper) -> None:
        gripper.grip(self.force_n)
        gripper.stop()
        gripper.stop()
        assert gripper.state().closed

    def test_disconnect_can_be_called_again_and_stop_after_it(self, gripper: Gripper) -> None:
        gripper.disconnect()
        gripper.disconnect()
        gripper.stop()
