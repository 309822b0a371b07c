"""Fingers closed by emulated servos, and the load between them.

The linkage is linear: a servo's ticks give the opening of the fingers; two servos move one finger
each, both equally far. Force is linear in current: zero up to the friction, then a constant number
of newtons per milliampere.

The load is solved once per squeeze, in a thread of its own, since solving a contact takes time;
meanwhile the fingers stand still and the servo reports that it is moving. The object follows at
once when the force is changed: the friction of a real gear, which resists it, is not emulated.
"""

from __future__ import annotations

import logging
import queue
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

from sim.emulators.dynamixel import control_table as at
from sim.emulators.dynamixel.servo import EmulatedServo

_log = logging.getLogger(__name__)

LET_GO_M = 0.2e-3
"""Opening at which the fingers have left an object. Our choice: a little over a tick."""

_SAME_M = 1e-5
_STEP_S = 0.002
_LONGEST_S = 0.5


class GripLoad(Protocol):
    """The object between the fingers."""

    def width_under(self, force_n: float) -> float:
        """Close, or adjust a grip, with a commanded force [N].

        Returns the opening [m] at which the fingers settle; 0 with nothing between them.
        """

    def release(self) -> None:
        """Note that the fingers have left the object."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SpringLoad:
    """A block on a spring, always between the fingers; ``GripLoad``.

    Attributes:
        width_m: Width without a force [m].
        stiffness_n_m: Stiffness of the spring [N/m].
    """

    width_m: float = 0.03
    stiffness_n_m: float = 2000.0

    def width_under(self, force_n: float) -> float:
        return max(0.0, self.width_m - force_n / self.stiffness_n_m)

    def release(self) -> None:
        """Nothing to note: a spring has no state."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Linkage:
    """Conversion of ticks and current to opening and force.

    Attributes:
        open_ticks, closed_ticks: Position of a servo with the fingers open and closed; the second
            of two servos is mounted mirrored.
        open_width_m: Opening at ``open_ticks`` [m]; it is 0 at ``closed_ticks``.
        newtons_per_ma: Slope of force over current [N/mA]. Default: 1.15 N·m/A (XC330-T288) on
            levers of 40 mm that move both fingers.
        friction_ma: Current at which the fingers begin to press [mA].
    """

    open_ticks: int = 2496
    closed_ticks: int = 1600
    open_width_m: float = 0.11
    newtons_per_ma: float = 0.0144
    friction_ma: float = 12.0

    def __post_init__(self) -> None:
        if self.open_ticks == self.closed_ticks:
            raise ValueError("open_ticks and closed_ticks must differ")
        if min(self.open_width_m, self.newtons_per_ma) <= 0 or self.friction_ma < 0:
            raise ValueError("width and slope must be above 0, friction not below it")

    def ticks(self, index: int, width_m: float) -> float:
        """Position of servo 0 or 1 at an opening."""
        fraction = width_m / self.open_width_m
        first = self.closed_ticks + fraction * (self.open_ticks - self.closed_ticks)
        return first if index == 0 else 4096 - first

    def width_m(self, index: int, ticks: float) -> float:
        first = ticks if index == 0 else 4096 - ticks
        return (
            self.open_width_m * (first - self.closed_ticks) / (self.open_ticks - self.closed_ticks)
        )

    def force_n(self, current_ma: float) -> float:
        return max(0.0, abs(current_ma) - self.friction_ma) * self.newtons_per_ma


class Fingers:
    """One or two servos with fingers on them. Not thread-safe: the caller holds a lock.

    Attributes:
        squeezes: Number of squeezes of the load.
        releases: Number of releases of the load.
        load_error: Error of the load; empty without one.
    """

    def __init__(
        self,
        servos: Sequence[EmulatedServo],
        linkage: Linkage,
        load: GripLoad,
        lock: threading.RLock,
    ) -> None:
        self._servos, self._linkage, self._load, self._lock = servos, linkage, load, lock
        self.squeezes = self.releases = 0
        self.load_error = ""
        self._squeezed = False
        self._num_solved = 0
        self._now_s = time.monotonic()
        self._jobs: queue.SimpleQueue[Callable[[], None] | None] = queue.SimpleQueue()
        for index, servo in enumerate(servos):
            servo.position = linkage.ticks(index, linkage.open_width_m)
            servo.closing = 1 if linkage.ticks(index, 0.0) > servo.position else -1
        self._thread = threading.Thread(target=self._work, name="load", daemon=True)
        self._thread.start()

    @property
    def width_m(self) -> float:
        return self._mean(lambda servo: servo.position)

    @property
    def force_n(self) -> float:
        if not self._squeezed or not all(servo.torque for servo in self._servos):
            return 0.0
        return min(self._linkage.force_n(servo.current_ma) for servo in self._servos)

    @property
    def busy(self) -> bool:
        return any(servo.moving for servo in self._servos)

    def on_written(self, addresses: frozenset[int]) -> None:
        """Squeeze, open or drop after a write to these registers."""
        if at.TORQUE in addresses and not all(servo.torque for servo in self._servos):
            self.drop()
        elif addresses & {at.GOAL_CURRENT, at.GOAL_POSITION}:
            goal_m = self._goal_m()
            if goal_m < self.width_m - _SAME_M or (
                self._squeezed and goal_m < self.width_m + _SAME_M
            ):
                self._squeeze()
            else:
                self._set_waiting(False)

    def drop(self) -> None:
        """Stop pressing: torque is off."""
        self._set_waiting(False)
        self._let_go()

    def step(self, now_s: float) -> None:
        remaining_s = min(_LONGEST_S, now_s - self._now_s)
        self._now_s = now_s
        while remaining_s > 0:
            for servo in self._servos:
                servo.step(min(_STEP_S, remaining_s))
            remaining_s -= _STEP_S
        if self._squeezed and self._is_released():
            self._let_go()

    def close(self) -> None:
        self._jobs.put(None)
        self._thread.join(timeout=2)

    def _goal_m(self) -> float:
        return self._mean(lambda servo: float(servo.table[at.GOAL_POSITION]))

    def _mean(self, ticks_of: Callable[[EmulatedServo], float]) -> float:
        widths = [self._linkage.width_m(i, ticks_of(s)) for i, s in enumerate(self._servos)]
        return sum(widths) / len(widths)

    def _squeeze(self) -> None:
        currents = [servo.goal_current_ma for servo in self._servos]
        force_n = self._linkage.force_n(min(currents))
        if not all(servo.torque for servo in self._servos) or force_n <= 0:
            return
        self._squeezed = True
        self.squeezes += 1
        number = self.squeezes
        self._set_waiting(True)
        self._jobs.put(lambda: self._solve(force_n, number))

    def _solve(self, force_n: float, number: int) -> None:
        try:
            width_m = self._load.width_under(force_n)
        except Exception as error:  # any load, any error: report it and keep serving the bus
            _log.exception("the load failed")
            self.load_error = f"{type(error).__name__}: {error}"
            return
        with self._lock:
            self._num_solved = number
            if number == self.squeezes and self._squeezed:
                for index, servo in enumerate(self._servos):
                    servo.stop = self._linkage.ticks(index, width_m)
                self._set_waiting(False)

    def _is_released(self) -> bool:
        if self.squeezes != self._num_solved:
            return False
        stops = [servo.stop for servo in self._servos]
        if any(stop is None for stop in stops):
            return True
        contact_m = self._mean(lambda servo: servo.stop if servo.stop is not None else 0.0)
        goal_m = self._goal_m()
        if goal_m <= contact_m + _SAME_M:
            return False
        return self.width_m > min(contact_m + LET_GO_M, goal_m - _SAME_M)

    def _let_go(self) -> None:
        if not self._squeezed:
            return
        self._squeezed = False
        self.releases += 1
        for servo in self._servos:
            servo.stop = None
        self._jobs.put(self._load.release)

    def _set_waiting(self, waiting: bool) -> None:
        for servo in self._servos:
            servo.waiting = waiting
            servo.publish()

    def _work(self) -> None:
        while (job := self._jobs.get()) is not None:
            job()
