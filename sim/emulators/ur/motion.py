"""Motions of a tool centre point over time: lines, ramps to a speed, stops, servoing.

Each motion is a pure function of the time since it began. Speeds change linearly (trapezoids), as a
UR's interpreter plans them, without jerk limit or following error. Not here: starting and ending
motions (``sim.emulators.ur.urscript``), joints (``sim.emulators.ur.kinematics``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from sim.emulators.ur.kinematics import Floats, matrix, rotvec

AT_REST = np.zeros(6)
AT_REST.setflags(write=False)


def norm(vector: Floats) -> float:
    """Length of a vector."""
    return math.sqrt(float(vector @ vector))


RATES = (1e-6, 1e3)
"""Least and largest speed or acceleration of a motion [m/s, rad/s, m/s², rad/s²].

A real arm accepts less. Beyond these the times of a motion leave the numbers of a computer.
"""


def checked_rate(value: float) -> float:
    """A speed or an acceleration.

    Raises:
        ValueError: Not within ``RATES``.
    """
    if not RATES[0] <= value <= RATES[1]:  # False for NaN
        raise ValueError(f"a speed or an acceleration lies within {RATES}, got {value}")
    return value


@dataclass(frozen=True, slots=True)
class ToolState:
    """Pose and velocity of the tool centre point.

    Attributes:
        position_m: Position, shape (3,) [m, base].
        rotation: Rotation matrix (3, 3), base from TCP.
        twist: Velocity and angular velocity (6,) [m/s, rad/s, base].
    """

    position_m: Floats
    rotation: Floats
    twist: Floats

    def path_to(self, position_m: Floats, rotation: Floats) -> Floats:
        """Displacement and rotation vector (6,) to another pose [m, rad, base]."""
        return np.concatenate([position_m - self.position_m, rotvec(rotation @ self.rotation.T)])

    def moved(self, path: Floats, twist: Floats) -> ToolState:
        """The state after a path (6,), with another twist."""
        rotation = self.rotation
        if float(np.abs(path[3:]).max()) > 1e-12:
            rotation = matrix(path[3:]) @ rotation
        return ToolState(self.position_m + path[:3], rotation, twist)


@dataclass(frozen=True, slots=True)
class MotionSegment:
    """A straight motion of the tool centre point from rest to rest.

    Attributes:
        by_base_m: Displacement, shape (3,) [m, base]: planned when it begins, actual when it ended.
        rotvec_rad: Rotation, shape (3,) [rad, base], likewise.
        speed_m_s, acceleration_m_s2: As commanded when it began.
    """

    by_base_m: Floats
    rotvec_rad: Floats
    speed_m_s: float
    acceleration_m_s2: float


class Motion(Protocol):
    """A motion that begins at its time 0."""

    @property
    def duration_s(self) -> float:
        """Time of its end [s]; infinite for a motion that another one has to end."""

    def at(self, t_s: float) -> ToolState:
        """The state at a time [s]."""


@dataclass(frozen=True, slots=True)
class Rest:
    """Standing still."""

    state: ToolState
    duration_s: float = math.inf

    def at(self, t_s: float) -> ToolState:
        return self.state


class Line:
    """A straight line from rest to rest with a trapezoidal speed."""

    def __init__(
        self,
        start: ToolState,
        position_m: Floats,
        rotation: Floats,
        speed: float,
        acceleration: float,
    ) -> None:
        """Plan the line; speed [m/s] and acceleration [m/s²], in rad where the turn is longer.

        Raises:
            ValueError: A number is not finite, or speed or acceleration is not within ``RATES``.
        """
        numbers = (*position_m.tolist(), *rotation.ravel().tolist())
        if not all(math.isfinite(v) for v in numbers):
            raise ValueError(f"a line needs finite numbers, got {numbers}")
        checked_rate(speed)
        checked_rate(acceleration)
        self._start, self._end = start, ToolState(position_m, rotation, AT_REST)
        self._by = start.path_to(position_m, rotation)
        self._length = max(norm(self._by[:3]), norm(self._by[3:]))
        self._acceleration = acceleration
        self._top = min(speed, math.sqrt(self._length * acceleration))
        self._ramp_s = self._top / acceleration
        self.duration_s = self._length / self._top + self._ramp_s if self._length > 0 else 0.0

    @property
    def path(self) -> Floats:
        """Planned displacement and rotation vector, (6,) [m, rad, base]."""
        return self._by

    def at(self, t_s: float) -> ToolState:
        if t_s >= self.duration_s:
            return self._end
        remaining_s = self.duration_s - t_s
        if t_s < self._ramp_s:
            path, speed = 0.5 * self._acceleration * t_s**2, self._acceleration * t_s
        elif remaining_s < self._ramp_s:
            path = self._length - 0.5 * self._acceleration * remaining_s**2
            speed = self._acceleration * remaining_s
        else:
            path = self._top * (t_s - 0.5 * self._ramp_s)
            speed = self._top
        fraction = path / self._length
        return self._start.moved(fraction * self._by, self._by * (speed / self._length))


class Ramp:
    """A change of velocity at a constant rate, then that velocity: ``speedl`` and every stop."""

    def __init__(self, start: ToolState, twist: Floats, seconds: float, until_s: float) -> None:
        """Change from the present twist to ``twist`` (6,) within ``seconds``; end at ``until_s``.

        Raises:
            ValueError: A number is not finite, or a speed beyond ``RATES``.
        """
        fits = (np.abs(twist) <= RATES[1]).all()  # False for NaN
        if not (fits and math.isfinite(seconds) and seconds >= 0):
            raise ValueError(f"a speed must be finite, got {twist.tolist()} within {seconds} s")
        self._start, self._twist, self._seconds = start, twist, seconds
        self.duration_s = until_s

    def at(self, t_s: float) -> ToolState:
        within = min(t_s, self._seconds)
        fraction = within / self._seconds if self._seconds > 0 else 1.0
        twist = self._start.twist + fraction * (self._twist - self._start.twist)
        path = 0.5 * (self._start.twist + twist) * within + self._twist * (t_s - within)
        return self._start.moved(path, twist)


def stop_in(start: ToolState, seconds: float) -> Ramp:
    """Come to rest within a time [s], along the present course."""
    return Ramp(start, AT_REST, seconds, seconds)


def stop_at(start: ToolState, deceleration: float) -> Ramp:
    """Come to rest with a deceleration [m/s²], or [rad/s²] where the tool only turns."""
    speed = norm(start.twist[:3]) or norm(start.twist[3:])
    return stop_in(start, speed / deceleration)


def run_at(start: ToolState, twist: Floats, acceleration: float, until_s: float) -> Ramp:
    """Change to a twist (6,) with an acceleration [m/s²]; end at ``until_s`` [s]."""
    change = twist - start.twist
    size = norm(change[:3]) or norm(change[3:])
    return Ramp(start, twist, size / acceleration, until_s)


LOOKAHEAD_S = (0.03, 0.2)
"""Range of the look-ahead time of ``servoj`` [s]. Source: URScript manual."""


class ServoMotion:
    """An exponential approach to a goal, as ``servoj`` makes with its look-ahead time."""

    duration_s = math.inf

    def __init__(
        self, start: ToolState, position_m: Floats, rotation: Floats, lookahead_s: float
    ) -> None:
        self._start, self._by = start, start.path_to(position_m, rotation)
        self._tau_s = min(LOOKAHEAD_S[1], max(LOOKAHEAD_S[0], lookahead_s))

    def at(self, t_s: float) -> ToolState:
        remaining = math.exp(-t_s / self._tau_s)
        return self._start.moved((1.0 - remaining) * self._by, self._by * (remaining / self._tau_s))
