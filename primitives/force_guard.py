"""The hard limit of a contract, kept where a command to the gripper is written.

A contract speaks of felt newtons, a gripper is sent commanded ones. The ratio between them is
hidden until something is felt; from then on it is known within an interval (``primitives.gain``). A
command is sent only if it, times the upper end of that interval, stays within the limit; and if it
does so even with a sensor that has lost sensitivity, except for what the contract needs at least.
Policy, jog and replay all command through the same ``GuardedGripper``.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from primitives.devices import AdjustableGripper, Gripper, GripperState
from primitives.errors import LimitError
from primitives.gain import GainEstimate, GainEstimator
from primitives.sense import Interval

NEEDED = 1.1
"""Part of the least force of a contract that may be commanded. Our choice: what is felt varies by
so much from grip to grip, and a force just at the end of the band would often be felt below it."""


class GuardedGripper:
    """A ``primitives.devices.Gripper`` that stays within a felt force.

    Args:
        gripper: The gripper.
        limit_n: Felt force that is never exceeded [N]; infinite for none (a benchmark's baseline).
        max_gain: Largest ratio of true to commanded force that the rig states, used until
            something is felt.

    Raises:
        LimitError: A number is not positive, or the ratio is not finite.
    """

    def __init__(self, gripper: Gripper, *, limit_n: float, max_gain: float) -> None:
        if not (limit_n > 0 and math.isfinite(max_gain) and max_gain > 0):
            raise LimitError(
                f"a guard needs a limit above 0 N and a finite ratio above 0, got {limit_n} N and "
                f"{max_gain}"
            )
        self._gripper = gripper
        self._limit_n, self._needed_n = limit_n, 0.0
        self._gains = GainEstimator(max_gain)
        self.open_by, self.stop = gripper.open_by, gripper.stop  # passed through
        self.disconnect = gripper.disconnect

    @property
    def limit_n(self) -> float:
        """Felt force that is never exceeded [N]."""
        return self._limit_n

    @property
    def gain(self) -> Interval | None:
        """Ratio of felt to commanded force, of the clearest reading; None before any was felt."""
        return self._gains.bound

    @property
    def gain_estimate(self) -> GainEstimate | None:
        """The same of all grips so far; None before anything was felt."""
        return self._gains.estimate

    @property
    def most_n(self) -> float:
        """Largest command that is sent [N]."""
        most_n, gain = self._limit_n / self._gains.most, self.gain
        if gain is None:
            return most_n
        return max(most_n, min(self._needed_n / gain.value, self._limit_n / gain.high))

    @property
    def why_no_more(self) -> str:
        """Why no more than ``most_n`` is sent, and what lets more through, for people."""
        factor, gain = self._limit_n / self.most_n, self.gain
        pressed = (
            f"{self.most_n:.3g} N commanded may press {self._limit_n:.3g} N, the contract's limit"
        )
        if gain is not None and factor <= 1.01 * gain.high:
            return (
                f"{pressed}: this contact's force is felt to within a factor of "
                f"{gain.high / gain.value:.2g}; a higher limit lets more through"
            )
        return (
            f"{pressed}, as far as is known: {factor:.2g} times as much; a smaller "
            "gripper.max_force_gain in the rig's file lets more through, if the gripper keeps to it"
        )

    def keep_to(self, limit_n: float, needed_n: float) -> None:
        """Set another limit; the executor alone does so, from its contract.

        Args:
            limit_n: Felt force that is never exceeded [N].
            needed_n: Felt force that a contract needs at least [N]; 0 for none.
        """
        self._limit_n, self._needed_n = limit_n, NEEDED * needed_n

    def feel(self, felt: Interval | None) -> None:
        """Learn the ratio from the force that is felt under the present command."""
        state = self._gripper.state()
        if felt is not None and state.closed:
            self._gains.feel(felt, state.force_n)

    def feel_growth(self, felt_n: float, commanded_n: float) -> None:
        """Widen the ratio's bounds for a force [N] that clearly grew under one command [N].

        It asks the gripper nothing, so that it may be called for each frame.
        """
        self._gains.rise(felt_n, commanded_n)

    def state(self) -> GripperState:
        """State of the gripper."""
        return self._gripper.state()

    def grip(self, force_n: float) -> GripperState:
        """Grip with a command [N], lowered to ``most_n`` where it is above; the state says so.

        Raises:
            LimitError: The command is not finite or not positive.
            RobotError: As the gripper raises it.
        """
        return self._within(force_n, self._gripper.grip)

    def adjust(self, force_n: float) -> GripperState:
        """As ``grip``, for a closed grip: a gripper that can returns before it has settled.

        Raises:
            LimitError: As ``grip``, or the grip is open.
            RobotError: As the gripper raises it.
        """
        gripper = self._gripper
        quick = gripper.adjust if isinstance(gripper, AdjustableGripper) else gripper.grip
        return self._within(force_n, quick)

    def _within(self, force_n: float, send: Callable[[float], GripperState]) -> GripperState:
        """Send a command, lowered to ``most_n``."""
        if not (math.isfinite(force_n) and force_n > 0):
            raise LimitError(f"a grip needs a finite force above 0 N, got {force_n}")
        self._gains.new_grip()
        if force_n <= self.most_n * (1 + 1e-9):
            return send(force_n)
        most_n = self.most_n
        note = (
            f"command {force_n:.3g} N lowered to {most_n:.3g} N: times "
            f"{self._limit_n / most_n:.2g} (felt over commanded) it may reach the contract's limit "
            f"of {self._limit_n:.3g} N"
        )
        return replace(send(most_n), clamped=note)
