"""The world that the emulated arm, gripper and sensor share: one ``sim.grasp.world.Grasp``.

It is drawn as the simulated rig of the same object and seed (same body, place on the pad, worn
gripper, sensor unit and noise of every contact), so that a strawberry slips and bruises alike. A
thread of its own solves the contacts: of the emulated devices, which have to answer within
milliseconds, only a gripper that is closing waits for it.

Not here: the protocols, and the process around them (``sim.emulators.rig``).
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from concurrent.futures import TimeoutError as TooLate
from dataclasses import asdict
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from primitives.errors import RobotError
from sim.emulators.process.control import Facts
from sim.grasp.devices import settled_width_m
from sim.grasp.rig import SimRig
from sim.grasp.world import trapezoid_s

T = TypeVar("T")

TICK_S = 0.02
"""How often a body that slides is followed while nothing is commanded [s]."""

ANSWER_S = 10.0
"""Longest wait for the solver [s]; a contact takes about 10 ms on an idle core."""


class SharedWorld:
    """One body between two fingers, moved and asked from several threads.

    Time passes as it really does: what is lifted and can't be held slides on while nothing is
    commanded. A motion is solved with the speed and acceleration that were commanded, as in the
    simulated rig.
    """

    def __init__(self, rig: SimRig, clock: Callable[[], float] = time.monotonic) -> None:
        """Take a freshly built simulated rig; its own devices must not be used any more."""
        self._rig, self._clock = rig, clock
        self._until_s = clock()
        self._base_from_tcp = Rotation.from_rotvec(np.array(rig.start_pose.rotvec_rad))
        self._felt = (0, 0.0)
        self._height_mm = rig.sensor.height_mm()
        self._solver = ThreadPoolExecutor(1, thread_name_prefix="world")
        self._last: Future[Any] = self._solver.submit(lambda: None)

    def moved(
        self,
        by_base_m: NDArray[np.float64],
        rotvec_rad: NDArray[np.float64],
        speed_m_s: float,
        acceleration_m_s2: float,
    ) -> None:
        """The TCP has covered a straight segment; returns when the world has followed.

        Args:
            by_base_m: Shape (3,), what was really covered [m, base frame].
            rotvec_rad: Shape (3,), by what the TCP turned on the way [rad, base frame].
            speed_m_s: As commanded [m/s].
            acceleration_m_s2: As commanded [m/s²].

        Raises:
            RobotError: The solver failed or does not answer.
        """
        by_m, ended_s = np.array(by_base_m, dtype=float), self._clock()
        axes = (self._rig.pad_x_in_tcp, self._rig.pad_y_in_tcp)
        x_mm, y_mm = (float(1000 * self._base_from_tcp.apply(axis) @ by_m) for axis in axes)
        self._base_from_tcp = Rotation.from_rotvec(np.array(rotvec_rad)) * self._base_from_tcp
        distance_m = math.hypot(x_mm, y_mm) / 1000
        if distance_m == 0:
            return
        ramp_s, cruise_s = trapezoid_s(distance_m, speed_m_s, acceleration_m_s2)

        def move() -> None:
            self._wait_until(ended_s - 2 * ramp_s - cruise_s)
            self._rig.grasp.move((x_mm, y_mm), speed_m_s, acceleration_m_s2)
            self._until_s = max(self._until_s, ended_s)

        _answer(self._do(move))

    def width_under(self, force_n: float) -> float:
        """Close, or adjust a grip, with a force as the gripper believes it [N].

        Returns:
            Opening at which the fingers settle [m]; 0 when nothing is between them.

        Raises:
            ValueError: The force is not positive.
            RobotError: The solver failed or does not answer.
        """
        if not (math.isfinite(force_n) and force_n > 0):
            raise ValueError(f"fingers close with a force above 0 N, got {force_n}")
        at_s = self._clock()

        def close() -> float:
            self._wait_until(at_s)
            self._rig.grasp.close(force_n * self._rig.gripper.factor)
            return settled_width_m(self._rig.grasp)

        return _answer(self._do(close))

    def released(self) -> None:
        """The fingers have left the object; returns at once."""
        at_s = self._clock()

        def open_() -> None:
            self._wait_until(at_s)
            self._rig.grasp.open()

        self._do(open_)

    def height_mm(self) -> NDArray[np.float32]:
        """The gel as this sensor unit reconstructs it now; shape (rows, columns) [mm].

        Never waits: while a contact is being solved, the answer is the one before it.
        """
        now_s = self._clock()
        holds = self._rig.grasp.patch is not None
        if holds and self._last.done() and now_s - self._until_s > TICK_S:
            self._do(lambda: self._wait_until(now_s))
        return self._height_mm

    def inject(self, fault: str, **details: float | str) -> None:
        """The world has no faults; ``ValueError``."""
        raise ValueError(f"the world has no fault {fault!r}; faults are the devices'")

    def clear(self) -> None:
        """Nothing to take back."""

    def facts(self) -> Facts:
        """The truth as ``sim.grasp.rig.Truth`` has it, and how often fingers and gel were changed.

        Raises:
            RobotError: The solver failed or does not answer.
        """
        now_s = self._clock()

        def truth() -> dict[str, float | str | bool | None]:
            self._wait_until(now_s)
            facts = asdict(self._rig.truth())
            x_mm, y_mm = facts.pop("offset_mm")
            grasp = self._rig.grasp
            counts = {"grips": grasp.grips, "contacts": grasp.contacts}
            return {**facts, "offset_x_mm": x_mm, "offset_y_mm": y_mm, **counts}

        return _answer(self._do(truth))

    def close(self) -> None:
        """Solve no more. Idempotent."""
        self._solver.shutdown(wait=False, cancel_futures=True)

    def _do(self, change: Callable[[], T]) -> Future[T]:
        """Queue a change and publish the gel after it. Changes happen in the order of calls."""
        if self._last.done():
            self._last.result()  # an error of the solver must not pass unseen

        def changed() -> T:
            answer = change()
            felt = (self._rig.grasp.contacts, self._rig.grasp.slip_mm)
            if felt != self._felt:
                self._height_mm = self._rig.sensor.height_mm()
                self._felt = felt
            return answer

        done = self._solver.submit(changed)
        self._last = done
        return done

    def _wait_until(self, at_s: float) -> None:
        if at_s > self._until_s:
            self._rig.grasp.wait(at_s - self._until_s)
            self._until_s = at_s


def _answer(done: Future[T]) -> T:
    try:
        return done.result(ANSWER_S)
    except TooLate:
        raise RobotError(f"the emulated world did not answer within {ANSWER_S:g} s") from None
