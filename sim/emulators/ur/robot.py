"""The body of an emulated UR: where its tool is, how it moves, what joints and force sensor say.

Knows motions, not the commands that ask for them. Each stretch from rest to rest is reported to a
listener, so that a simulated world can follow. Not here: programs, safety, the wire.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from sim.emulators.ur.kinematics import (
    READY_Q,
    Floats,
    as_frame,
    base_from_flange,
    inverse,
    jacobian,
    joints_of,
    matrix,
    rotvec,
)
from sim.emulators.ur.motion import AT_REST, Motion, Rest, ToolState, stop_at, stop_in

STILL_M_S = 1e-3
"""Below this speed the tool counts as stopped."""

FORCE_BIAS_N = (0.8, -0.5, 2.0, 0.0, 0.0, 0.0)
"""What the force sensor says of nothing until it is zeroed [N, N m]: as a real one, not 0."""


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionSegment:
    """A way of the tool from rest to rest.

    Attributes:
        by_base_m: Shape (3,) [m].
        rotvec_rad: Turn on the way, shape (3,) [rad].
        speed_m_s, acceleration_m_s2: As commanded when it began.
    """

    by_base_m: Floats
    rotvec_rad: Floats
    speed_m_s: float
    acceleration_m_s2: float


Report = Callable[[MotionSegment], Callable[[], bool]]
"""Takes a stretch that has ended; what it returns says whether the world has followed."""


class Robot:
    """Position, motion, joints and force of an emulated arm. Times are of one monotonic clock [s].

    Attributes:
        place: Where the tool centre point is now.
        tcp_offset: Flange to tool centre point, UR pose (6,) [m, rad].
        contact: Wrench on the tool (6,) [N, N m, base].
        speed_fraction: Speed slider, 0 to 1: motions run slower by it.
    """

    def __init__(self, tcp: Floats, tcp_offset: Floats, report: Report | None, now_s: float):
        """Start at rest with the tool centre point at ``tcp`` (6,).

        Raises:
            ValueError: No posture brings it there.
        """
        self.tcp_offset = np.array(tcp_offset, dtype=np.float64)
        self.place = ToolState(position_m=np.array(tcp[:3]), turn=matrix(tcp[3:]), twist=AT_REST)
        self.contact = np.zeros(6)
        self.speed_fraction = 1.0
        self._bias = np.array(FORCE_BIAS_N)
        self._zeroed = np.zeros(6)
        self._report = report
        self._motion: Motion = Rest(self.place)
        self._since_s, self._now_s, self._stopping = 0.0, now_s, False
        self._left: tuple[ToolState, float, float] | None = None
        self._followed: Callable[[], bool] = lambda: True
        self._q = joints_of(self._flange(), READY_Q)
        self._q_of = self.place
        self._watched_from_s = now_s
        self._watched_speed = 0.0
        self.stopped_after_s: float | None = None

    # -- motion ----------------------------------------------------------------------------------

    @property
    def moving(self) -> bool:
        """A motion is under way, or the world has not yet followed the last one."""
        return not isinstance(self._motion, Rest) or not self._followed()

    @property
    def in_motion(self) -> bool:
        """A motion is under way."""
        return not isinstance(self._motion, Rest)

    @property
    def speed_m_s(self) -> float:
        """Speed of the tool centre point [m/s]."""
        twist = self.place.twist
        return math.sqrt(float(twist[:3] @ twist[:3]))

    def begin(self, motion: Motion, speed_m_s: float = 0.0, acceleration: float = 0.0) -> None:
        """Go over to a motion that begins here and now; the numbers are for the listener."""
        if self._left is None:
            self._left = (self.place, speed_m_s, acceleration)
        self._motion, self._since_s, self._stopping = motion, 0.0, False
        self.advance(self._now_s)

    def halt(self, deceleration_m_s2: float) -> None:
        """Come to rest along the present course."""
        if self.in_motion:
            self._stop(stop_at(self.place, deceleration_m_s2))

    def halt_joints(self, deceleration_rad_s2: float) -> None:
        """Come to rest as ``stopj`` does: the fastest joint's deceleration decides how soon."""
        if self.in_motion:
            speed = float(np.abs(self.joint_speeds()).max())
            self._stop(stop_in(self.place, speed / deceleration_rad_s2))

    def _stop(self, motion: Motion) -> None:
        # The slider does not stretch a stop; the speed from which it begins was scaled already.
        self._motion, self._since_s, self._stopping = motion, 0.0, True
        self.advance(self._now_s)

    def advance(self, now_s: float) -> None:
        """Let time pass until ``now_s``."""
        passed_s = max(0.0, now_s - self._now_s)
        before_s, self._now_s = self._now_s, max(now_s, self._now_s)
        if not self.in_motion:
            return
        scale = 1.0 if self._stopping else self.speed_fraction
        earlier_s = self._since_s
        self._since_s += passed_s * scale
        self.place = self._placed(self._since_s, scale)
        if self.stopped_after_s is None and self.speed_m_s < STILL_M_S and self._watched_speed > 0:
            at_s = self._crossing(earlier_s, self._since_s, scale)
            when_s = before_s + (at_s - earlier_s) / scale if scale > 0 else self._now_s
            self.stopped_after_s = max(0.0, when_s - self._watched_from_s)
        if self._since_s >= self._motion.duration_s:
            self._arrive()

    def watch_stop(self, now_s: float) -> None:
        """Measure from now until the tool is still; nothing to measure when it is so already."""
        self.advance(now_s)
        self._watched_from_s, self.stopped_after_s = now_s, None
        self._watched_speed = self.speed_m_s if self.speed_m_s >= STILL_M_S else 0.0

    def _placed(self, t_s: float, scale: float) -> ToolState:
        place = self._motion.at(t_s)
        if scale == 1.0:
            return place
        return ToolState(position_m=place.position_m, turn=place.turn, twist=place.twist * scale)

    def _crossing(self, low_s: float, high_s: float, scale: float) -> float:
        """When between two of the motion's times its speed fell below ``STILL_M_S``."""
        for _ in range(20):
            middle = 0.5 * (low_s + high_s)
            twist = self._placed(middle, scale).twist
            if math.sqrt(float(twist[:3] @ twist[:3])) < STILL_M_S:
                high_s = middle
            else:
                low_s = middle
        return high_s

    def _arrive(self) -> None:
        self.place = ToolState(
            position_m=self.place.position_m, turn=self.place.turn, twist=AT_REST
        )
        self._motion = Rest(self.place)
        if self._left is None:
            return
        start, speed_m_s, acceleration = self._left
        self._left = None
        if self._report is not None:
            stretch = MotionSegment(
                by_base_m=self.place.position_m - start.position_m,
                rotvec_rad=rotvec(self.place.turn @ start.turn.T),
                speed_m_s=speed_m_s,
                acceleration_m_s2=acceleration,
            )
            self._followed = self._report(stretch)

    # -- what its sensors say --------------------------------------------------------------------

    def tcp_pose(self) -> list[float]:
        """Pose of the tool centre point, as a UR writes it (6 numbers) [m, rad]."""
        return [*self.place.position_m.tolist(), *rotvec(self.place.turn).tolist()]

    def set_tcp(self, offset: Floats) -> None:
        """Another tool: the joints stay where they are, the tool centre point is elsewhere."""
        flange = self._flange()
        self.tcp_offset = np.array(offset, dtype=np.float64)
        tip = flange @ as_frame(self.tcp_offset)
        self.place = ToolState(position_m=tip[:3, 3], turn=tip[:3, :3], twist=AT_REST)
        self._q_of = self.place
        self._motion = Rest(self.place)

    def joints(self) -> Floats:
        """Joint angles (6,) [rad].

        Raises:
            ValueError: The tool has been led where no posture reaches.
        """
        if self._q_of is not self.place:
            self._q = joints_of(self._flange(), self._q)
            self._q_of = self.place
        return self._q

    def joint_speeds(self) -> Floats:
        """Joint speeds (6,) [rad/s]."""
        if self.speed_m_s == 0 and not self.place.twist.any():
            return np.zeros(6)
        q = self.joints()
        lever = base_from_flange(q)[:3, 3] - self.place.position_m
        twist = self.place.twist.copy()
        twist[:3] += np.cross(twist[3:], lever)
        return np.asarray(np.linalg.solve(jacobian(q) + 1e-9 * np.eye(6), twist), dtype=np.float64)

    def force(self) -> list[float]:
        """What the force sensor says (6) [N, N m, base]."""
        return (self._bias + self.contact - self._zeroed).tolist()

    def zero_force(self) -> None:
        """Make what the sensor says now its zero."""
        self._zeroed = self._bias + self.contact

    def _flange(self) -> Floats:
        frame = np.eye(4)
        frame[:3, :3], frame[:3, 3] = self.place.turn, self.place.position_m
        return frame @ inverse(as_frame(self.tcp_offset))
