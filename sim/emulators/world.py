"""The world shared by the emulated arm, gripper and sensor: one ``sim.grasp.world.Grasp``.

It is drawn as the simulated rig of the same object and seed (same body, position on the pad,
gripper force gain, sensor unit and noise of every contact), so that a strawberry slips and bruises
alike. A thread of its own solves the contacts. The emulated devices have to answer within
milliseconds; only a closing gripper waits for that thread.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import asdict
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from primitives.errors import RobotError
from sim.emulators.process.control import Facts
from sim.emulators.ur.motion import MotionSegment
from sim.grasp.devices import settled_width_m
from sim.grasp.rig import SimRig
from sim.grasp.world import trapezoid_s

T = TypeVar("T")

SLIDE_PERIOD_S = 0.02
"""Longest period at which a sliding body is updated while nothing is commanded [s]."""

ANSWER_S = 10.0
"""Longest wait for the solver [s]; a contact takes about 10 ms on an idle core."""


class SharedWorld:
    """One body between two fingers, used from several threads.

    Time is real: a lifted body that can't be held slides on while nothing is commanded. A motion is
    solved with its commanded speed and acceleration, as in the simulated rig.
    """

    def __init__(self, rig: SimRig, clock: Callable[[], float] = time.monotonic) -> None:
        """Take over a new simulated rig; its own devices must not be used any more."""
        self._rig, self._clock = rig, clock
        self.slide_period_s = SLIDE_PERIOD_S
        self._began_s = self._solved_until_s = clock()
        self._base_from_tcp = Rotation.from_rotvec(np.array(rig.start_pose.rotvec_rad))
        self._published = (0, 0.0)
        self._surface_mm = rig.sensor.surface_mm()
        self._solver = ThreadPoolExecutor(1, thread_name_prefix="world")
        self._last: Future[Any] = self._solver.submit(lambda: None)

    def follow(self, segment: MotionSegment) -> None:
        """Follow a segment of the TCP that has just ended; returns when it is solved.

        Raises:
            RobotError: The solver failed or does not answer.
        """
        ended_s = self._clock()
        x_mm, y_mm = self._on_pad(segment, turns=True)
        distance_m = math.hypot(x_mm, y_mm) / 1000
        if distance_m == 0:
            return
        speed_m_s, acceleration_m_s2 = segment.speed_m_s, segment.acceleration_m_s2
        ramp_s, cruise_s = trapezoid_s(distance_m, speed_m_s, acceleration_m_s2)

        def move() -> None:
            self._wait_until(ended_s - 2 * ramp_s - cruise_s)
            self._rig.grasp.move((x_mm, y_mm), speed_m_s, acceleration_m_s2)
            self._solved_until_s = max(self._solved_until_s, ended_s)

        self._solve(move)

    def _on_pad(self, segment: MotionSegment, *, turns: bool = False) -> tuple[float, float]:
        """Displacement of a segment along the pad's axes [mm]; notes that the tool has turned."""
        axes = (self._rig.pad_x_in_tcp, self._rig.pad_y_in_tcp)
        x_mm, y_mm = (
            float(1000 * self._base_from_tcp.apply(axis) @ segment.by_base_m) for axis in axes
        )
        if turns:
            self._base_from_tcp = Rotation.from_rotvec(segment.rotvec_rad) * self._base_from_tcp
        return x_mm, y_mm

    def width_under(self, force_n: float) -> float:
        """Close, or adjust a grip, with a commanded force [N].

        Returns:
            Opening at which the fingers settle [m]; 0 with nothing between them.

        Raises:
            ValueError: The force is not positive.
            RobotError: The solver failed or does not answer.
        """
        if not (math.isfinite(force_n) and force_n > 0):
            raise ValueError(f"fingers close with a force above 0 N, got {force_n}")
        at_s = self._clock()

        def close() -> float:
            self._wait_until(at_s)
            self._press(force_n * self._rig.gripper.force_gain)
            return settled_width_m(self._rig.grasp)

        return self._solve(close)

    def _press(self, force_n: float) -> None:
        """Close, or adjust a grip, with a true force [N]; called by the solver."""
        self._rig.grasp.close(force_n)

    def release(self) -> None:
        """Open the fingers; returns at once."""
        at_s = self._clock()

        def open_() -> None:
            self._wait_until(at_s)
            self._rig.grasp.open()

        self._submit(open_)

    def height_mm(self) -> NDArray[np.float32]:
        """A new frame of the gel now, shape (rows, columns) [mm], for one thread at a time.

        Never waits: while a contact is being solved, the frame shows the gel before it.
        """
        now_s = self._clock()
        is_holding = self._rig.grasp.patch is not None
        if is_holding and self._last.done() and now_s - self._solved_until_s > self.slide_period_s:
            self._submit(lambda: self._wait_until(now_s))
        return self._rig.sensor.frame_mm(self._surface_mm, now_s - self._began_s)

    def inject(self, fault: str, **details: float | str) -> None:
        """Raise ``ValueError``: the world has no faults."""
        raise ValueError(f"the world has no fault {fault!r}; faults are the devices'")

    def clear(self) -> None:
        """Nothing to end: the world has no faults."""

    def facts(self) -> Facts:
        """``sim.grasp.rig.Truth``, and the numbers of grips and of solved contacts.

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

        return self._solve(truth)

    def close(self) -> None:
        self._solver.shutdown(wait=False, cancel_futures=True)

    def _solve(self, change: Callable[[], T]) -> T:
        try:
            return self._submit(change).result(ANSWER_S)
        except TimeoutError:
            raise RobotError(f"the emulated world did not answer within {ANSWER_S:g} s") from None

    def _submit(self, change: Callable[[], T]) -> Future[T]:
        """Queue a change and publish the gel after it. Changes happen in the order of calls."""
        return self._submit_now(change)

    def _submit_now(self, change: Callable[[], T]) -> Future[T]:
        if self._last.done():
            self._last.result()  # raises an error of the solver

        def run() -> T:
            result = change()
            self._publish()
            return result

        future = self._solver.submit(run)
        self._last = future
        return future

    def _publish(self) -> None:
        """Show the gel as it is now; called by the solver."""
        version = (self._rig.grasp.contacts, self._rig.grasp.slip_mm)
        if version != self._published:
            self._surface_mm = self._rig.sensor.surface_mm()
            self._published = version

    def _wait_until(self, at_s: float) -> None:
        if at_s > self._solved_until_s:
            self._rig.grasp.wait(at_s - self._solved_until_s)
            self._solved_until_s = at_s
