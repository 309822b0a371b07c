"""Carries out primitives on an arm and a gripper, inside the limits.

The paper leaves the execution open; on every rig it is the same (our choice):

* A move opens by ``clear_mm``, goes ``move_step_mm`` along an axis of the pad and closes to the
  last commanded force, and where nothing is felt under it further, as in an approach. A closed
  gripper would drag the object along.
* ``increase_force`` and ``decrease_force`` multiply the last force by 1.5 and 0.65, or, where the
  force is felt and the goal is known, bring the felt force towards the goal (``force_factor``).
* ``reset`` opens, returns to the start pose and grasps again. After a closing on nothing it opens
  as wide as before the first grasp, since the object stands where the fingers go back to.
* No command may press beyond the contract's limit (``primitives.force_guard``). A soft contact
  under a contract for hard things is held to the terms of soft ones.
* A first grasp and the grasp of a reset are an approach where touch is given: the force rises in
  small steps from almost nothing until something is felt, at most to ``first_force_n``, so that no
  object is pressed harder than it takes to find it. Without touch they close with that force.

Not here: the number of resets in an episode and the reaction to errors (``tacgrasp.loop``).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from primitives.contract import Band, Contract
from primitives.devices import Arm, Gripper, GripperState, Pose
from primitives.errors import LimitError
from primitives.force_guard import GuardedGripper
from primitives.gain import GainEstimate
from primitives.limits import (
    Limits,
    check_travel,
    check_workspace,
    clamp_force,
    clamp_step,
    distance_mm,
)
from primitives.primitive import PAD_DIRECTION, Primitive
from primitives.sense import ContactSense, Interval
from primitives.stiffness import StiffnessReader

INCREASE_FACTOR = 1.5
DECREASE_FACTOR = 0.65
"""Our choice: 1.5 × 0.65 is just below 1, so that one of each leaves a slightly lower force."""

MAX_INCREASE, MIN_DECREASE = 2.0, 0.5
"""Largest changes of the force towards a goal, as factors. Our choice: a felt force is off by up to
a third, so twice the force of a light grip stays far below the next bruise."""

AT_LIMIT = "the force is already at its limit"
"""Note of a change of force that sent nothing because of the limits."""

_NOTHING = "nothing"
"""``Executed.sent`` where no command went to a device."""

OVER = 1.1
"""Factor by which a change of force passes the end of the goal that it goes to. Our choice: the
felt force varies by some percent from frame to frame."""

APPROACH_FACTOR = 1.3
"""Factor between two commanded forces of an approach. Our choice: no more than what a berry that
bruises at 1.8 times its slip minimum stands above a force that is just not felt."""

APPROACH_STEP_N = 0.01
"""Least step of the commanded force during the approach [N]."""

READABLE_N = 0.06
"""Felt force from which a contact can be placed [N]; below it the drift of the gel is as deep as
the contact. Source: simulated berries were lost where they were felt at 0.02 to 0.03 N, and found
on the pad from 0.05 N on. The smallest ripe berry bruises at 0.28 N."""

READABLE_PART = 0.3
"""The same over the low end of the contract's force band, where that is more. Our choice: the pad's
edge raises the pressure of a force by less than three times."""

CLOSED_WIDTH_M = 0.001
"""Opening below which the fingers have closed on nothing [m]. Our choice: no object is so thin,
and a servo of 9 ticks a millimetre rests within 5 ticks of its goal. Fingers that leave a wider gap
when closed are closed by the approach up to its limit of force, and no further."""


def force_factor(*, increase: bool, felt: Interval | None, goal_n: Band | None) -> float:
    """Factor on the commanded force.

    Below the goal an increase goes just over its low end as felt, by at most ``MAX_INCREASE``;
    above it a decrease goes just under its high end, by at most ``MIN_DECREASE``. Inside the goal a
    change never leaves it. Without a felt force or a goal, and for a change away from the goal, the
    factors are ``INCREASE_FACTOR`` and ``DECREASE_FACTOR``.
    """
    plain = INCREASE_FACTOR if increase else DECREASE_FACTOR
    if felt is None or goal_n is None or felt.value <= 0:
        return plain
    low, high = goal_n.low, goal_n.high
    if low <= felt.value <= high:
        return min(plain, high / felt.value) if increase else max(plain, low / felt.value)
    if increase and felt.value < low:
        return min(MAX_INCREASE, min(low * OVER, high) / felt.value)
    if not increase and felt.value > high:
        return max(MIN_DECREASE, max(high / OVER, low) / felt.value)
    return plain


@dataclass(frozen=True, slots=True, kw_only=True)
class PadAxes:
    """The pad's axes in the frame of the tool centre point (TCP), from the rig's configuration.

    Attributes:
        x_tcp: Unit vector of the pad's +x (right), three numbers, TCP frame.
        y_tcp: Unit vector of the pad's +y (towards the palm), TCP frame.

    Raises:
        LimitError: An axis is not finite or not of unit length, or the axes are not perpendicular
            (within 1e-6).
    """

    x_tcp: tuple[float, float, float]
    y_tcp: tuple[float, float, float]

    def __post_init__(self) -> None:
        for name in ("x_tcp", "y_tcp"):
            axis = tuple(float(v) for v in getattr(self, name))
            norm = math.hypot(*axis)
            if len(axis) != 3 or not math.isfinite(norm) or abs(norm - 1) > 1e-6:
                raise LimitError(f"{name} must be a unit vector of three numbers, got {axis}")
            object.__setattr__(self, name, axis)
        dot = sum(a * b for a, b in zip(self.x_tcp, self.y_tcp, strict=True))
        if abs(dot) > 1e-6:
            raise LimitError(f"x_tcp and y_tcp must be perpendicular, their product is {dot:.3g}")


@dataclass(frozen=True, slots=True, kw_only=True)
class Executed:
    """Result of one primitive, or of the first grasp.

    Attributes:
        primitive: The primitive; None for the first grasp.
        asked: The command before the limits, in words and numbers.
        sent: The command after the limits, in words and numbers; 'nothing' when none was sent.
        reached: Measured pose of the TCP afterwards [base frame].
        force_n: Last commanded force afterwards [N]; 0 before any grip.
        width_m: Opening afterwards, as reported by the gripper [m].
        clamped: Changes by the limits, one note each.
        opened: Whether the gripper was opened on the way, so that the next contact is a new one.
        travel_mm: Measured path of the TCP over the episode so far [mm].
        dry_run: Whether sending was off; all but ``sent`` then describes the robot as it stands.
        started_s, ended_s: Begin and end on the executor's monotonic clock [s].
    """

    primitive: Primitive | None
    asked: str
    sent: str
    reached: Pose
    force_n: float
    width_m: float
    clamped: tuple[str, ...]
    opened: bool
    travel_mm: float
    dry_run: bool
    started_s: float
    ended_s: float

    @property
    def sent_nothing(self) -> bool:
        """Whether no command went to a device."""
        return self.sent == _NOTHING


def rotate(rotvec_rad: NDArray[np.float64], vector: NDArray[np.float64]) -> NDArray[np.float64]:
    """Turn a vector, shape (3,) in any unit, by a rotation vector, shape (3,) [rad]."""
    from scipy.spatial.transform import Rotation  # slow to import, and needed by moves alone

    turned = Rotation.from_rotvec(np.array(rotvec_rad)).apply(
        np.array(vector)
    )  # scipy takes no read-only arrays
    return np.asarray(turned, dtype=np.float64)


class Executor:
    """Carries out the primitives of one episode; keeps the travel and the last force."""

    def __init__(
        self,
        arm: Arm,
        gripper: Gripper,
        limits: Limits,
        *,
        clear_mm: float,
        move_step_mm: float,
        first_force_n: float,
        start_pose: Pose,
        pad_axes: PadAxes,
        clock: Callable[[], float],
        sense: ContactSense | None = None,
        contract: Contract | None = None,
        max_gain: float = 1.0,
        force_step_n: float = 0.0,
        dry_run: bool = False,
    ) -> None:
        """Take the devices; nothing is sent yet.

        Args:
            arm: Connected arm.
            gripper: Connected gripper.
            limits: Bounds of all commands.
            clear_mm: Opening before a move [mm].
            move_step_mm: Length of a move [mm]; clamped by the limits.
            first_force_n: Force of the first grasp and of a reset [N]; with ``sense`` the largest
                force until something is felt. Clamped by the limits.
            start_pose: Target of ``reset`` [base frame].
            pad_axes: The pad's axes in the TCP frame.
            clock: Monotonic clock [s].
            sense: Touch during a closing; None closes without feeling.
            contract: Contract of the episode: changes of the force go towards its band, and no
                command may press beyond its limit. None: neither (a benchmark's baseline).
            max_gain: Largest ratio of true to commanded force, until something is felt.
            force_step_n: Least change of the force that the gripper makes [N].
            dry_run: Whether to read the devices and send them nothing.

        Raises:
            LimitError: A size is not finite and positive, ``start_pose`` is outside the workspace,
                or the contract is refused.
        """
        for name, value in (("clear_mm", clear_mm), ("move_step_mm", move_step_mm)):
            if not (math.isfinite(value) and value > 0):
                raise LimitError(f"{name} must be finite and above 0, got {value}")
        check_workspace(start_pose, limits)
        clamp_force(first_force_n, limits)
        self._gripper = GuardedGripper(gripper, limit_n=math.inf, max_gain=max_gain)
        if contract is not None and contract.soft is not None:  # until it is known to be hard
            self._gripper.keep_to(min(contract.terms.limit_n, contract.soft.force_n.high), 0.0)
        elif contract is not None:
            self.keep(contract)
        self._arm, self._limits = arm, limits
        self._clear_m = clear_mm * 1e-3
        self._move_step_mm = move_step_mm
        self._first_force_n = first_force_n
        self._start_pose = start_pose
        self._axes = np.array([pad_axes.x_tcp, pad_axes.y_tcp])
        self._clock = clock
        self._sense, self._contract = sense, contract
        self._stiffness = StiffnessReader()
        self._approach_step_n = max(APPROACH_STEP_N, force_step_n)
        self._open_width_m = 0.0
        self._dry_run = dry_run
        self._force_n = 0.0
        self._read_under_n = 0.0  # command of the last reading, where a reflex changed it since
        self._travel_mm = 0.0

    @property
    def force_n(self) -> float:
        """Last commanded force [N]; 0 before the first grasp."""
        return self._force_n

    @property
    def gain(self) -> GainEstimate | None:
        """Ratio of felt to commanded force over all grips; None before anything was felt."""
        return self._gripper.gain_estimate

    def feel(self, felt: Interval | None) -> bool | None:
        """Learn from the force that is felt under the present grip.

        Returns:
            Whether the contact is soft, once that has been told under a contract that what is felt
            may object to; None before, and where it may not.
        """
        self._gripper.feel(felt)
        self._read_under_n = 0.0
        contract = self._contract
        if contract is None or contract.soft is None or felt is None:
            return None
        state = self._gripper.state()
        if state.closed:
            self._stiffness.feel(state.force_n, state.width_m, self._gripper.gain)
        if self._stiffness.is_soft is False:
            self.keep(contract)
        return self._stiffness.is_soft

    def keep(self, contract: Contract) -> None:
        """Keep another contract from now on; what is felt has objected to the one before."""
        self._contract = contract
        self._gripper.keep_to(contract.terms.limit_n, contract.terms.force_n.low)

    def aim_at(self, contract: Contract) -> None:
        """Go towards another force band of the same contract from now on; its limit stays."""
        self._contract = contract

    @property
    def open_width_m(self) -> float:
        """Opening before the first grasp [m]; 0 before it, and without touch."""
        return self._open_width_m

    @property
    def travel_mm(self) -> float:
        """Measured path of the TCP over the episode so far [mm]."""
        return self._travel_mm

    def grasp(self, force_n: float | None = None) -> Executed:
        """Approach, or close with the first force, at the present pose.

        Args:
            force_n: Close with this force at once instead (a replay) [N].

        Raises:
            RobotError: A device failed.
        """
        started = self._clock()
        if self._sense is not None:
            self._open_width_m = self._gripper.state().width_m
        first = self._first(force_n)
        sent, notes = self._close(first, feel=force_n is None)
        return self._done(
            None,
            asked=self._first_words(first, feel=force_n is None),
            sent=sent,
            notes=notes,
            opened=False,
            started=started,
        )

    def execute(self, primitive: Primitive, force_n: float | None = None) -> Executed:
        """Carry out one primitive.

        Args:
            primitive: The primitive.
            force_n: Commanded force after it instead of the executor's own choice (a replay) [N].

        Raises:
            LimitError: The primitive would leave the workspace or exceed the travel, or comes
                before the first grasp. Nothing was sent.
            RobotError: A device failed; the loop stops it.
        """
        if not self._dry_run and self._force_n <= 0:
            raise LimitError(f"{primitive} before the first grasp: call grasp() first")
        started = self._clock()
        if primitive in PAD_DIRECTION:
            return self._move(primitive, started, force_n)
        if primitive is Primitive.RESET:
            return self._reset(started, force_n)
        return self._change_force(primitive, started, force_n)

    @property
    def gripper_state(self) -> GripperState:
        """State of the gripper, which commands nothing."""
        return self._gripper.state()

    def most_felt_n(self, force_n: float) -> float:
        """Largest felt force that a command [N] can make, as far as is known [N]."""
        return force_n * self._gripper.limit_n / self._gripper.most_n

    @property
    def reach_n(self) -> float | None:
        """Largest felt force that the limit lets a command make [N]; None before any was felt."""
        gain = self._gripper.gain
        return None if gain is None else gain.value * self._gripper.most_n

    def feel_growth(self, felt_n: float) -> None:
        """A force [N] is felt under a command that has settled (a reflex, in any frame)."""
        self._gripper.feel_growth(felt_n, self._force_n)

    def correct_force(self, force_n: float) -> GripperState:
        """Change the force of a closed grip between two primitives, within all limits (a reflex).

        Raises:
            LimitError: Nothing is gripped, or the force is not finite and positive.
            RobotError: The gripper failed.
        """
        if self._dry_run or self._force_n <= 0:
            raise LimitError("nothing is gripped: there is no force to correct")
        state = self._gripper.adjust(clamp_force(force_n, self._limits).value)
        self._read_under_n = self._read_under_n or self._force_n
        self._force_n = state.force_n
        return state

    def _move(self, primitive: Primitive, started: float, force_n: float | None) -> Executed:
        step = clamp_step(self._move_step_mm, self._limits)
        here = self._arm.pose()
        pad_x, pad_y = PAD_DIRECTION[primitive]
        direction_tcp = pad_x * self._axes[0] + pad_y * self._axes[1]
        direction_base = rotate(here.rotvec_rad, direction_tcp)
        target = Pose(
            position_m=here.position_m + direction_base * step.value * 1e-3,
            rotvec_rad=here.rotvec_rad,
        )
        check_workspace(target, self._limits)
        check_travel(self._travel_mm, step.value, self._limits)
        note = ""
        if not self._dry_run:
            self._open_by(self._clear_m)
            self._go(here, target)
            self._take_reference()
            state = self._grip(clamp_force(force_n or self._force_n, self._limits).value)
            note = state.clamped
            if force_n is None and self._sense is not None:
                self._feel_for(state.width_m, self._sense)
        x, y, z = direction_base * step.value
        return self._done(
            primitive,
            asked=f"{self._move_step_mm:.3g} mm",
            sent=f"{step.value:.3g} mm, ({x:.2f}, {y:.2f}, {z:.2f}) mm in the base frame",
            notes=(step.note, note),
            opened=not self._dry_run,
            started=started,
        )

    def _reset(self, started: float, force_n: float | None) -> Executed:
        here = self._arm.pose()
        path_mm = distance_mm(here, self._start_pose)
        check_travel(self._travel_mm, path_mm, self._limits)
        if not self._dry_run:
            self._open_by(self._reset_clear_m())
            self._go(here, self._start_pose)
        first = self._first(force_n)
        sent, notes = self._close(first, feel=force_n is None)
        return self._done(
            Primitive.RESET,
            asked=f"start pose, {self._first_words(first, feel=force_n is None)}",
            sent=f"{path_mm:.3g} mm to the start pose, {sent}",
            notes=notes,
            opened=not self._dry_run,
            started=started,
        )

    def _change_force(
        self, primitive: Primitive, started: float, force_n: float | None
    ) -> Executed:
        increase = primitive is Primitive.INCREASE_FORCE
        before = self._force_n or clamp_force(self._first_force_n, self._limits).value
        felt = None if self._sense is None else self._sense.felt_force()
        band = None if self._contract is None else self._contract.terms.force_n
        factor = force_factor(increase=increase, felt=felt, goal_n=band)
        if self._may_be_soft():
            factor = min(factor, INCREASE_FACTOR)  # small steps until it is known to be hard
        request_n = force_n or (self._read_under_n or before) * factor
        force = clamp_force(request_n, self._limits)
        allowed_n = min(force.value, self._gripper.most_n)
        is_against = allowed_n < before if increase else allowed_n > before  # after a reflex's own
        unchanged = math.isclose(allowed_n, before, rel_tol=1e-9) or (
            is_against and (increase or force_n is None)
        )
        at_limit = force.note or allowed_n < force.value
        reason = AT_LIMIT if at_limit else "the goal leaves no room for a change"
        notes = [force.note, reason if unchanged else ""]
        if unchanged and allowed_n < force.value:
            notes.append(self._gripper.why_no_more)
        if not self._dry_run and not unchanged:
            state = self._grip(force.value)
            notes.append(state.clamped)
        return self._done(
            primitive,
            asked=f"{request_n:.3g} N",
            sent=_NOTHING if unchanged else f"{self._force_n:.3g} N",
            notes=tuple(notes),
            opened=False,
            started=started,
        )

    def _may_be_soft(self) -> bool:
        """Whether the contract is one for hard things, and the contact not known to be hard."""
        contract = self._contract
        return (
            contract is not None and contract.soft is not None and self._stiffness.is_soft is None
        )

    def _reset_clear_m(self) -> float:
        """Opening before a reset [m]: as before the first grasp where nothing is felt."""
        if self._sense is None or self._sense.felt_force() is not None:
            return self._clear_m
        return max(self._clear_m, self._open_width_m - self._gripper.state().width_m)

    def _first(self, force_n: float | None) -> float:
        return self._first_force_n if force_n is None else force_n

    def _first_words(self, force_n: float, *, feel: bool) -> str:
        if self._sense is None or not feel:
            return f"close with {force_n:.3g} N"
        return f"close until something is felt, at most {force_n:.3g} N"

    def _close(self, force_n: float, *, feel: bool) -> tuple[str, tuple[str, ...]]:
        """Close from open: by an approach where touch is given; what was sent, and notes."""
        force = clamp_force(force_n, self._limits)
        if self._sense is None or not feel:
            note = "" if self._dry_run else self._grip(force.value).clamped
            return f"close with {self._force_n or force.value:.3g} N", (force.note, note)
        if self._dry_run:
            return _NOTHING, ()
        self._take_reference()
        first_n = max(self._approach_step_n, self._limits.min_force_n)
        state = self._grip(min(first_n, force.value, self._gripper.most_n))
        if self._feel_for(state.width_m, self._sense):
            return f"close to {self._force_n:.3g} N, where something was felt", (force.note,)
        return f"close to {self._force_n:.3g} N; nothing was felt", (force.note,)

    def _feel_for(self, width_m: float, sense: ContactSense) -> bool:
        """Raise the force of a closed grip, in small steps, until it is felt; whether it is.

        Under a contract it goes on until the contact can be placed. It ends at the limit of an
        approach, and where the fingers have closed on nothing.
        """
        top_n = min(clamp_force(self._first_force_n, self._limits).value, self._gripper.most_n)
        while not (in_contact := sense.in_contact()) or not self._is_readable(sense):
            if in_contact:
                self._stiffness.feel(self._force_n, width_m, None)
            if self._force_n >= top_n or width_m < CLOSED_WIDTH_M:
                return in_contact
            step_n = max(self._approach_step_n, (APPROACH_FACTOR - 1) * self._force_n)
            width_m = self._grip(min(self._force_n + step_n, top_n)).width_m
        return True

    def _is_readable(self, sense: ContactSense) -> bool:
        """Whether what is felt is enough to tell where it is."""
        contract, felt = self._contract, sense.felt_force()
        if contract is None:
            return True
        band = (contract.soft or contract.terms).force_n
        least_n = READABLE_N if contract.needs else max(READABLE_N, READABLE_PART * band.low)
        return felt is not None and felt.value >= least_n

    def _take_reference(self) -> None:
        if self._sense is not None:
            self._sense.take_reference()

    def _grip(self, force_n: float) -> GripperState:
        state = self._gripper.grip(force_n)
        self._force_n = state.force_n if state.clamped else force_n
        return state

    def _open_by(self, clear_m: float) -> None:
        self._gripper.open_by(clear_m)
        self._stiffness.new_contact()

    def _go(self, here: Pose, target: Pose) -> None:
        try:
            reached = self._arm.move_to(target, speed_m_s=self._limits.max_speed_m_s)
        except LimitError:
            self._grip(self._force_n)  # the device refused and did not move: hold the object again
            raise
        self._travel_mm += distance_mm(here, reached)

    def _done(
        self,
        primitive: Primitive | None,
        *,
        asked: str,
        sent: str,
        notes: tuple[str, ...],
        opened: bool,
        started: float,
    ) -> Executed:
        state: GripperState = self._gripper.state()
        return Executed(
            primitive=primitive,
            asked=asked,
            sent=_NOTHING if self._dry_run else sent,
            reached=self._arm.pose(),
            force_n=self._force_n,
            width_m=state.width_m,
            clamped=tuple(n for n in notes if n),
            opened=opened,
            travel_mm=self._travel_mm,
            dry_run=self._dry_run,
            started_s=started,
            ended_s=self._clock(),
        )
