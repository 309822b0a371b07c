"""Motions of a tool centre point in time: lines, ramps to a speed, stops, servoing.

Each is a pure function of the time since it began. Speeds change linearly (trapezoids), as a UR's
interpreter plans them; no jerk limit and no following error. Not here: who starts and ends them
(``ur_program``), joints (``ur_kinematics``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from sim.emulators.ur.kinematics import Floats, matrix, rotvec

AT_REST = np.zeros(6)
AT_REST.setflags(write=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class ToolState:
    """Where the tool centre point is and how it moves.

    Attributes:
        position_m: Shape (3,) [m, base].
        turn: Rotation matrix (3, 3), base from TCP.
        twist: Speed and angular speed (6,) [m/s, rad/s, base].
    """

    position_m: Floats
    turn: Floats
    twist: Floats


class Motion(Protocol):
    """A motion that began at time 0 of its own."""

    @property
    def duration_s(self) -> float:
        """When it ends [s]; infinite for one that goes on until it is ended."""
        ...

    def at(self, t_s: float) -> ToolState:
        """The place at a time since the beginning [s]."""
        ...


@dataclass(frozen=True, slots=True)
class Rest:
    """Standing still."""

    place: ToolState
    duration_s: float = math.inf

    def at(self, t_s: float) -> ToolState:
        """Always the same place."""
        return self.place


class Line:
    """A straight line from rest to rest with a trapezoidal speed."""

    def __init__(
        self, start: ToolState, position_m: Floats, turn: Floats, speed: float, acceleration: float
    ) -> None:
        """Plan it; speed [m/s] and acceleration [m/s²], in rad where only the tool turns.

        Raises:
            ValueError: A number is not finite, or speed or acceleration not above 0.
        """
        numbers = (*position_m.tolist(), *turn.ravel().tolist(), speed, acceleration)
        if not (all(math.isfinite(v) for v in numbers) and speed > 0 and acceleration > 0):
            raise ValueError(f"a line needs finite numbers and a speed above 0, got {numbers}")
        self._start, self._position_m, self._turn = start, position_m, turn
        self._by_m = position_m - start.position_m
        self._by_rad = rotvec(turn @ start.turn.T)
        length_m = math.sqrt(float(self._by_m @ self._by_m))
        self._length = length_m or math.sqrt(float(self._by_rad @ self._by_rad))
        self._acceleration = acceleration
        self._top = min(speed, math.sqrt(self._length * acceleration))
        self._ramp_s = self._top / acceleration
        self.duration_s = self._length / self._top + self._ramp_s if self._length > 0 else 0.0

    def at(self, t_s: float) -> ToolState:
        """The place at ``t_s`` [s]."""
        if t_s >= self.duration_s:
            return ToolState(position_m=self._position_m, turn=self._turn, twist=AT_REST)
        left_s = self.duration_s - t_s
        if t_s < self._ramp_s:
            way, speed = 0.5 * self._acceleration * t_s**2, self._acceleration * t_s
        elif left_s < self._ramp_s:
            way = self._length - 0.5 * self._acceleration * left_s**2
            speed = self._acceleration * left_s
        else:
            way = self._top * (t_s - 0.5 * self._ramp_s)
            speed = self._top
        share = way / self._length
        turn = self._start.turn
        if float(np.abs(self._by_rad).max()) > 1e-9:
            turn = matrix(share * self._by_rad) @ turn
        twist = np.concatenate([self._by_m, self._by_rad]) * (speed / self._length)
        return ToolState(
            position_m=self._start.position_m + share * self._by_m, turn=turn, twist=twist
        )


class Ramp:
    """A change of speed at a constant rate, then that speed for ever: ``speedl`` and every stop."""

    def __init__(self, start: ToolState, twist: Floats, seconds: float, until_s: float) -> None:
        """Go over from the present speed to ``twist`` (6,) within ``seconds``; end at ``until_s``.

        Raises:
            ValueError: A number is not finite.
        """
        if not (np.isfinite(twist).all() and math.isfinite(seconds) and seconds >= 0):
            raise ValueError(f"a speed must be finite, got {twist.tolist()} within {seconds} s")
        self._start, self._twist, self._seconds = start, twist, seconds
        self.duration_s = until_s

    def at(self, t_s: float) -> ToolState:
        """The place at ``t_s`` [s]."""
        within = min(t_s, self._seconds)
        share = within / self._seconds if self._seconds > 0 else 1.0
        twist = self._start.twist + share * (self._twist - self._start.twist)
        way = 0.5 * (self._start.twist + twist) * within + self._twist * (t_s - within)
        turn = self._start.turn
        if float(np.abs(way[3:]).max()) > 1e-12:
            turn = matrix(way[3:]) @ turn
        return ToolState(position_m=self._start.position_m + way[:3], turn=turn, twist=twist)


def stop_in(start: ToolState, seconds: float) -> Ramp:
    """Come to rest within a time [s], on the present course."""
    return Ramp(start, AT_REST, seconds, seconds)


def stop_at(start: ToolState, deceleration: float) -> Ramp:
    """Come to rest with a deceleration [m/s²] (of the turning [rad/s²] where only that is)."""
    speed = math.sqrt(float(start.twist[:3] @ start.twist[:3]))
    if speed == 0:
        speed = math.sqrt(float(start.twist[3:] @ start.twist[3:]))
    return stop_in(start, speed / deceleration)


def run_at(start: ToolState, twist: Floats, acceleration: float, until_s: float) -> Ramp:
    """Go over to a speed (6,) with an acceleration [m/s²]; end at ``until_s`` [s]."""
    change = twist - start.twist
    size = math.sqrt(float(change[:3] @ change[:3])) or math.sqrt(float(change[3:] @ change[3:]))
    return Ramp(start, twist, size / acceleration, until_s)


class ServoMotion:
    """Approach a goal exponentially, as ``servoj`` does by its look-ahead."""

    duration_s = math.inf

    def __init__(
        self, start: ToolState, position_m: Floats, turn: Floats, lookahead_s: float
    ) -> None:
        self._start, self._position_m, self._turn = start, position_m, turn
        self._tau_s = max(0.01, lookahead_s)
        self._by = np.concatenate([
            position_m - start.position_m, rotvec(turn @ start.turn.T)
        ])  # fmt: skip

    def at(self, t_s: float) -> ToolState:
        """The place at ``t_s`` [s]."""
        left = math.exp(-t_s / self._tau_s)
        way = (1.0 - left) * self._by
        return ToolState(
            position_m=self._start.position_m + way[:3],
            turn=matrix(way[3:]) @ self._start.turn,
            twist=self._by * (left / self._tau_s),
        )
