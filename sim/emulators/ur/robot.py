"""The body of an emulated UR: tool state, motions, joints and force sensor.

Each segment from rest to rest is reported to a listener, so that a simulated world can follow; a
line also when it begins. Not here: commands and programs, safety, the wire.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from sim.emulators.ur.kinematics import (
    A_M,
    D_M,
    READY_Q,
    Floats,
    as_frame,
    base_from_flange,
    checked_pose,
    jacobian,
    joints_of,
    matrix,
    rotvec,
)
from sim.emulators.ur.motion import (
    AT_REST,
    Line,
    Motion,
    MotionSegment,
    Rest,
    ToolState,
    norm,
    stop_at,
    stop_in,
)

STILL_M_S = 1e-3
"""Speed below which the tool counts as stopped."""

ARM_M = sum(map(abs, (*A_M, *D_M)))
"""Distance from the base that no posture exceeds [m]."""

LONGEST_TOOL_M = 2.0
"""Longest accepted TCP offset [m]. Our choice."""

SERVO_M_S2 = 1.0
"""Acceleration reported for a segment without a commanded one [m/s²]. Our choice."""

FORCE_BIAS_N = (0.8, -0.5, 2.0, 0.0, 0.0, 0.0)
"""Reading of the force sensor without a load until it is zeroed [N, N m]; not 0, as a real one."""


SegmentListener = Callable[[MotionSegment], Callable[[], bool]]
"""Called with a segment that has ended; returns a function: has the world followed it?"""


class Robot:
    """Tool, motion, joints and force of an emulated arm. Times are of one monotonic clock [s].

    Attributes:
        tool: Pose and velocity of the tool centre point now.
        tcp_offset: Flange to tool centre point, UR pose (6,) [m, rad].
        contact: External wrench on the tool (6,) [N, N m, base].
        speed_fraction: Speed slider, 0 to 1; it scales the speed of motions.
        on_begin: Called with the plan of each line that begins from rest; None for nobody.
        out_of_reach: A motion led to where no posture is; the arm stands, and must be stopped. A
            real one stops itself there (a protective stop).
    """

    def __init__(
        self, tcp: Floats, tcp_offset: Floats, listener: SegmentListener | None, now_s: float
    ):
        """Start at rest with the tool centre point at the UR pose ``tcp`` (6,).

        Raises:
            ValueError: No posture reaches the pose.
        """
        checked_pose(tcp)
        self.tcp_offset = checked_pose(tcp_offset)
        self.tool = ToolState(np.array(tcp[:3]), matrix(tcp[3:]), AT_REST)
        self.contact = np.zeros(6)
        self.speed_fraction = 1.0
        self._bias = np.array(FORCE_BIAS_N)
        self._zeroed = np.zeros(6)
        self._listener = listener
        self.on_begin: Callable[[MotionSegment], None] | None = None
        self._motion: Motion = Rest(self.tool)
        self._since_s, self._now_s, self._stopping = 0.0, now_s, False
        self._segment_start: tuple[ToolState, float, float] | None = None
        self._followed: Callable[[], bool] = lambda: True
        self.out_of_reach = False
        self._q = joints_of(self._flange(), READY_Q)
        self._q_of = self.tool
        self._peak_m_s = 0.0
        self._watched_from_s = now_s
        self._watched_speed = 0.0
        self.stopped_after_s: float | None = None

    @property
    def moving(self) -> bool:
        """A motion is under way, or the world has not yet followed the last one."""
        return not isinstance(self._motion, Rest) or not self._followed()

    @property
    def in_motion(self) -> bool:
        return not isinstance(self._motion, Rest)

    @property
    def speed_m_s(self) -> float:
        return norm(self.tool.twist[:3])

    def begin(self, motion: Motion, speed_m_s: float = 0.0, acceleration: float = 0.0) -> None:
        """Change to a motion that begins now; the numbers are for the listener."""
        if self._segment_start is None:
            self._segment_start = (self.tool, speed_m_s, acceleration)
            self._peak_m_s = 0.0
            if isinstance(motion, Line) and self.on_begin is not None:
                path = motion.path
                self.on_begin(MotionSegment(path[:3], path[3:], speed_m_s, acceleration))
        self._motion, self._since_s, self._stopping = motion, 0.0, False
        self.advance(self._now_s)

    def halt(self, deceleration_m_s2: float) -> None:
        if self.in_motion:
            self._stop(stop_at(self.tool, deceleration_m_s2))

    def halt_joints(self, deceleration_rad_s2: float) -> None:
        """Come to rest as ``stopj`` does, in the time that the fastest joint needs."""
        if self.in_motion:
            speed = float(np.abs(self.joint_speeds()).max())
            self._stop(stop_in(self.tool, speed / deceleration_rad_s2))

    def _stop(self, motion: Motion) -> None:
        # The slider does not stretch a stop; the speed from which it begins was scaled already.
        self._motion, self._since_s, self._stopping = motion, 0.0, True
        self.advance(self._now_s)

    def advance(self, now_s: float) -> None:
        passed_s = max(0.0, now_s - self._now_s)
        before_s, self._now_s = self._now_s, max(now_s, self._now_s)
        if not self.in_motion:
            return
        scale = 1.0 if self._stopping else self.speed_fraction
        earlier_s = self._since_s
        self._since_s += passed_s * scale
        tool = self._state_at(self._since_s, scale)
        if not self._within_reach(tool.position_m):
            self._lose_posture()
            return
        self.tool = tool
        self._peak_m_s = max(self._peak_m_s, self.speed_m_s)
        if self.stopped_after_s is None and self.speed_m_s < STILL_M_S and self._watched_speed > 0:
            at_s = self._crossing(earlier_s, self._since_s, scale)
            when_s = before_s + (at_s - earlier_s) / scale if scale > 0 else self._now_s
            self.stopped_after_s = max(0.0, when_s - self._watched_from_s)
        if self._since_s >= self._motion.duration_s:
            self._arrive()

    def watch_stop(self, now_s: float) -> None:
        """Measure the time from now until the tool is still; nothing when it is still already."""
        self.advance(now_s)
        self._watched_from_s, self.stopped_after_s = now_s, None
        self._watched_speed = self.speed_m_s if self.speed_m_s >= STILL_M_S else 0.0

    def _state_at(self, t_s: float, scale: float) -> ToolState:
        tool = self._motion.at(t_s)
        return tool if scale == 1.0 else replace(tool, twist=tool.twist * scale)

    def _crossing(self, low_s: float, high_s: float, scale: float) -> float:
        """Time of the motion, between two times, at which its speed fell below ``STILL_M_S``."""
        for _ in range(20):
            middle = 0.5 * (low_s + high_s)
            if norm(self._state_at(middle, scale).twist[:3]) < STILL_M_S:
                high_s = middle
            else:
                low_s = middle
        return high_s

    def _arrive(self) -> None:
        self.tool = replace(self.tool, twist=AT_REST)
        self._motion = Rest(self.tool)
        if self._segment_start is None:
            return
        start, speed_m_s, acceleration = self._segment_start
        self._segment_start = None
        if self._listener is not None:
            path = start.path_to(self.tool.position_m, self.tool.rotation)
            # Servoing has no commanded speed, and a faster motion may have taken over.
            if self._peak_m_s > 1.01 * speed_m_s:
                speed_m_s = self._peak_m_s
            speed_m_s = max(speed_m_s, STILL_M_S)
            acceleration = acceleration if acceleration > 0 else SERVO_M_S2
            segment = MotionSegment(path[:3], path[3:], speed_m_s, acceleration)
            self._followed = self._listener(segment)

    def tcp_pose(self) -> list[float]:
        """UR pose of the tool centre point, 6 numbers [m, rad]."""
        return [*self.tool.position_m.tolist(), *rotvec(self.tool.rotation).tolist()]

    def set_tcp(self, offset: Floats) -> None:
        """Change the tool: the joints stay, the tool centre point moves.

        Raises:
            ValueError: No UR pose, or too far from the flange.
        """
        offset = checked_pose(offset)
        if norm(offset[:3]) > LONGEST_TOOL_M:
            raise ValueError(f"a tool reaches at most {LONGEST_TOOL_M} m, got {offset.tolist()}")
        if self.in_motion:
            self._arrive()
        flange = self._flange()
        self.tcp_offset = offset
        tip = flange @ as_frame(self.tcp_offset)
        self.tool = ToolState(tip[:3, 3], tip[:3, :3], AT_REST)
        self._q_of = self.tool
        self._motion = Rest(self.tool)

    def joints(self) -> Floats:
        """Joint angles (6,) [rad]: the last ones when no posture reaches the tool's pose."""
        if self._q_of is not self.tool:
            self._q_of = self.tool
            try:
                self._q = joints_of(self._flange(), self._q)
            except ValueError:
                self._lose_posture()
        return self._q

    def joint_speeds(self) -> Floats:
        """Joint speeds (6,) [rad/s]."""
        if self.speed_m_s == 0 and not self.tool.twist.any():
            return np.zeros(6)
        q = self.joints()
        lever = base_from_flange(q)[:3, 3] - self.tool.position_m
        twist = self.tool.twist.copy()
        twist[:3] += np.cross(twist[3:], lever)
        try:
            speeds = np.linalg.solve(jacobian(q) + 1e-9 * np.eye(6), twist)
        except np.linalg.LinAlgError:  # exactly singular
            self._lose_posture()
            return np.zeros(6)
        return np.asarray(speeds, dtype=np.float64)

    def force(self) -> list[float]:
        """Reading of the force sensor, 6 numbers [N, N m, base]."""
        return (self._bias + self.contact - self._zeroed).tolist()

    def zero_force(self) -> None:
        """Make the present reading the sensor's zero."""
        self._zeroed = self._bias + self.contact

    def _within_reach(self, position_m: Floats) -> bool:
        """Whether a TCP's position is finite and not beyond the outstretched arm."""
        return norm(position_m) <= ARM_M + norm(self.tcp_offset[:3])  # False for NaN

    def _lose_posture(self) -> None:
        self.out_of_reach = True
        self.tool = replace(self.tool, twist=AT_REST)
        self._q_of = self.tool
        if self.in_motion:
            self._arrive()

    def _flange(self) -> Floats:
        frame = np.eye(4)
        frame[:3, :3], frame[:3, 3] = self.tool.rotation, self.tool.position_m
        return frame @ np.linalg.inv(as_frame(self.tcp_offset))
