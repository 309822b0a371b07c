"""The fingers that emulated servos close, and what is between them.

Linear linkage: a servo's ticks give the opening of the fingers; of two servos each moves its own
finger, as far as the other. Current gives force on a line: nothing until friction is overcome, then
so many newtons a milliampere.

What is between the fingers is asked once for every squeeze, in a thread of its own, since solving a
contact takes time; meanwhile the fingers stand and the servo says that it is moving. The object
follows at once when the force is changed: the friction of a real gear, which holds against it, is
not emulated.
"""

from __future__ import annotations

import logging
import queue
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

from sim.emulators.dynamixel import control_table as at
from sim.emulators.dynamixel.servo import EmulatedServo

_log = logging.getLogger(__name__)

LET_GO_M = 0.2e-3
"""Opened by this much, the fingers have left what they held; our choice, a little over a tick."""

_SAME_M = 1e-5
_STEP_S = 0.002
_LONGEST_S = 0.5


class GripLoad(Protocol):
    """What may be between the fingers."""

    def width_under(self, force_n: float) -> float:
        """Close, or adjust a grip, with this force as the gripper believes it [N].

        Returns the opening [m] at which the fingers settle; 0 when nothing is between them.
        """
        ...

    def released(self) -> None:
        """The fingers have left the object."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class SpringLoad:
    """A block on a spring, always between the fingers; ``GripLoad``.

    Attributes:
        width_m: Uncompressed [m].
        stiffness_n_m: Of the spring [N/m].
    """

    width_m: float = 0.03
    stiffness_n_m: float = 2000.0

    def width_under(self, force_n: float) -> float:
        """Hooke's law."""
        return max(0.0, self.width_m - force_n / self.stiffness_n_m)

    def released(self) -> None:
        """The spring doesn't mind."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Linkage:
    """From ticks and current to opening and force.

    Attributes:
        open_ticks, closed_ticks: Position of a servo with the fingers open and closed; the second
            of two servos is mounted the other way round.
        open_width_m: Opening at ``open_ticks`` [m]; it is 0 at ``closed_ticks``.
        newtons_per_ma: Slope of force over current [N/mA]. Default: 1.15 N·m/A (XC330-T288) on
            levers of 40 mm that move both fingers.
        friction_ma: Current at which the fingers just begin to press [mA].
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
        share = width_m / self.open_width_m
        first = self.closed_ticks + share * (self.open_ticks - self.closed_ticks)
        return first if index == 0 else 4096 - first

    def width_m(self, index: int, ticks: float) -> float:
        """Opening that servo 0 or 1 stands for [m]."""
        first = ticks if index == 0 else 4096 - ticks
        return (
            self.open_width_m * (first - self.closed_ticks) / (self.open_ticks - self.closed_ticks)
        )

    def force_n(self, current_ma: float) -> float:
        """Force of a current [N]."""
        return max(0.0, abs(current_ma) - self.friction_ma) * self.newtons_per_ma


class Fingers:
    """One or two servos with fingers on them. Not thread-safe: the caller's lock guards it.

    Attributes:
        squeezes: How often the load was asked.
        releases: How often it was told that it is free.
        load_error: What the load raised, empty when nothing.
    """

    def __init__(
        self,
        servos: Sequence[EmulatedServo],
        linkage: Linkage,
        load: GripLoad,
        lock: threading.RLock,
        now_s: float,
    ) -> None:
        self._servos, self._linkage, self._load, self._lock = servos, linkage, load, lock
        self.squeezes = self.releases = 0
        self.load_error = ""
        self._squeezed = False
        self._asked = self._answered = 0
        self._now_s = now_s
        self._jobs: queue.SimpleQueue[Callable[[], None] | None] = queue.SimpleQueue()
        for index, servo in enumerate(servos):
            servo.position = linkage.ticks(index, linkage.open_width_m)
            servo.closing = 1 if linkage.ticks(index, 0.0) > servo.position else -1
        self._thread = threading.Thread(target=self._work, name="load", daemon=True)
        self._thread.start()

    @property
    def width_m(self) -> float:
        """Opening between the fingers [m]."""
        return self._mean(lambda servo: servo.position)

    @property
    def force_n(self) -> float:
        """Force with which the fingers press now [N]."""
        if not self._squeezed or not all(servo.torque for servo in self._servos):
            return 0.0
        return min(self._linkage.force_n(servo.current_ma) for servo in self._servos)

    @property
    def busy(self) -> bool:
        """Whether something moves or will."""
        return any(servo.moving for servo in self._servos)

    def written(self, addresses: frozenset[int]) -> None:
        """Registers were written: squeeze, open or drop as they now say."""
        if at.TORQUE in addresses and not all(servo.torque for servo in self._servos):
            self.dropped()
        elif addresses & {at.GOAL_CURRENT, at.GOAL_POSITION}:
            goal_m = self._goal_m()
            if goal_m < self.width_m - _SAME_M or (
                self._squeezed and goal_m < self.width_m + _SAME_M
            ):
                self._squeeze()
            else:
                self._wait(False)

    def dropped(self) -> None:
        """Torque is gone: the fingers press no more."""
        self._wait(False)
        self._let_go()

    def step(self, now_s: float) -> None:
        """Let the time until now pass."""
        left_s = min(_LONGEST_S, now_s - self._now_s)
        self._now_s = now_s
        while left_s > 0:
            for servo in self._servos:
                servo.step(min(_STEP_S, left_s))
            left_s -= _STEP_S
        if self._squeezed and self._has_left():
            self._let_go()

    def close(self) -> None:
        """End the load's thread. Idempotent."""
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
        self._asked += 1
        number = self._asked
        self._wait(True)
        self._jobs.put(lambda: self._ask(force_n, number))

    def _ask(self, force_n: float, number: int) -> None:
        try:
            width_m = self._load.width_under(force_n)
        except Exception as error:  # the load is anyone's: say it, and go on serving the bus
            _log.exception("the load failed")
            self.load_error = f"{type(error).__name__}: {error}"
            return
        with self._lock:
            self._answered = number
            if number == self._asked and self._squeezed:
                for index, servo in enumerate(self._servos):
                    servo.stop = self._linkage.ticks(index, width_m)
                self._wait(False)

    def _has_left(self) -> bool:
        if self._asked != self._answered:
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
        self._jobs.put(self._load.released)

    def _wait(self, waits: bool) -> None:
        for servo in self._servos:
            servo.waits = waits
            servo.publish()

    def _work(self) -> None:
        while (job := self._jobs.get()) is not None:
            job()
