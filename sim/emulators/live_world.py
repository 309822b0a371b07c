"""The world of emulators whose sensor measures shear: it follows every motion while it is made.

A reflex reads the gel in the middle of a lift, so that the world can't wait for its end. A line is
played in parts of a frame, in real time; where solving takes longer than a part, the next one is as
much longer, so that time is real on the whole. A change of the gripper's force comes in between two
parts.

Not here: the wire.
"""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from cltp.tactile.sensors import SensorSpec
from sim.emulators.ur.motion import MotionSegment
from sim.emulators.world import ANSWER_S, SharedWorld
from sim.grasp.devices import at_cells
from sim.grasp.rig import SimRig

T = TypeVar("T")

_SAME_M = 1e-6
"""Difference to its plan from which a motion was cut short [m]."""


def sends_shear(spec: SensorSpec) -> bool:
    """Whether a taxel array can send what this sensor measures: shear where its heights are."""
    return spec.shear_grid is not None and spec.shear_grid == spec.markers


class _CutShortError(Exception):
    """The arm was stopped in the middle of the line that is played."""


class LiveWorld(SharedWorld):
    """A world that moves while the arm does; its sensor is one that measures shear at taxels.

    Args:
        rig: A new simulated rig; its own devices must not be used any more.
        clock: Monotonic [s].

    Raises:
        ValueError: The rig's sensor measures no shear at the cells of its heights.
    """

    def __init__(self, rig: SimRig, clock: Callable[[], float] = time.monotonic) -> None:
        spec, shear = rig.sensor.spec, rig.grasp.shear
        if shear is None or not sends_shear(spec):
            raise ValueError(f"{spec.name} measures no shear at the cells of its heights")
        super().__init__(rig, clock)
        self._spec, self._pad_shear = spec, shear
        self.slide_period_s = self._period_s = 1.0 / spec.frame_hz
        self._field, self._field_of = shear.field(), shear.shear
        self._changes: queue.SimpleQueue[Callable[[], None] | None] = queue.SimpleQueue()
        self._guard = threading.Lock()  # of the next two
        self._plays = 0
        self._plan: tuple[MotionSegment, Future[None]] | None = None
        self._cut = threading.Event()

    def begin(self, plan: MotionSegment) -> None:
        """Play a line that the arm begins now, in real time; returns at once."""
        by_mm, began_s = self._on_pad(plan), self._clock()
        if by_mm == (0.0, 0.0):
            return
        self._cut.clear()
        with self._guard:
            future = self._submit_now(lambda: self._play(by_mm, plan, began_s))
            self._plays += 1
            self._plan = plan, future

    def follow(self, segment: MotionSegment) -> None:
        plan, self._plan = self._plan, None
        if plan is None:
            super().follow(segment)
            return
        planned, future = plan
        missing = segment.by_base_m - planned.by_base_m
        if float(np.abs(missing).max()) > _SAME_M:
            self._cut.set()
            self._changes.put(None)  # wakes the solver
        future.result(ANSWER_S)
        left = MotionSegment(missing, segment.rotvec_rad, 0.0, 0.0)
        by_mm = self._on_pad(left, turns=True)
        if by_mm != (0.0, 0.0):
            self._solve(lambda: self._rig.grasp.displace(by_mm))

    def along_mm(self) -> NDArray[np.float32]:
        """Displacements along the gel now, shape (rows, columns, 2) [mm, gel frame].

        Those of the frame that ``height_mm`` gave last, by the same thread.
        """
        seen = self._rig.sensor.shear_frame(self._field)
        assert seen is not None  # the sensor measures shear
        rows, columns = self._spec.shear_grid or (0, 0)
        return seen.displacement_mm[:, :2].reshape(rows, columns, 2)

    def height_mm(self) -> NDArray[np.float32]:
        """As of a ``SharedWorld``, at the taxels: shape (rows, columns) [mm]."""
        rows, columns = self._spec.markers or (0, 0)
        return at_cells(super().height_mm(), self._spec, rows, columns)

    def until_next_s(self) -> float:
        """Length of the next part of a motion [s]: longer where the world is late."""
        return max(self._period_s, self._clock() - self._solved_until_s)

    def passed(self, seconds: float) -> None:
        """Show the gel once this part of a motion is over, and let the gripper in meanwhile."""
        self._solved_until_s += seconds
        while (wait_s := self._solved_until_s - self._clock()) > 0:
            try:
                self._change(self._changes.get(timeout=wait_s))
            except queue.Empty:
                break
        while not self._changes.empty():
            self._change(self._changes.get())
        self._publish()

    def _change(self, change: Callable[[], None] | None) -> None:
        if change is not None:
            change()
        if self._cut.is_set():
            raise _CutShortError

    def _play(self, by_mm: tuple[float, float], plan: MotionSegment, began_s: float) -> None:
        """Make a motion, in the solver's thread."""
        grasp = self._rig.grasp
        if began_s > self._solved_until_s:
            grasp.wait(began_s - self._solved_until_s)
        self._solved_until_s, grasp.beat = began_s, self
        try:
            grasp.move(by_mm, plan.speed_m_s, plan.acceleration_m_s2)
        except _CutShortError:
            self._brake(by_mm, plan)
        finally:
            grasp.beat = None
            with self._guard:
                self._plays -= 1
                while not self._changes.empty():
                    change = self._changes.get()
                    if change is not None:
                        change()
            self._publish()

    def _brake(self, by_mm: tuple[float, float], plan: MotionSegment) -> None:
        """The deceleration of a line that was cut short, as it was commanded."""
        grasp = self._rig.grasp
        grasp.beat = None
        x, y = np.array(by_mm) / np.hypot(*by_mm) * plan.acceleration_m_s2
        ramp_s = plan.speed_m_s / plan.acceleration_m_s2
        grasp.load((-float(x), -float(y)), ramp_s)
        self._solved_until_s += ramp_s

    def _press(self, force_n: float) -> None:
        self._rig.grasp.adjust(force_n)  # time passes by itself

    def _wait_until(self, at_s: float) -> None:
        if self._rig.grasp.beat is None:
            super()._wait_until(at_s)

    def _submit(self, change: Callable[[], T]) -> Future[T]:
        """As of a ``SharedWorld``; in the middle of a motion the change comes between two parts."""
        future: Future[T] = Future()

        def run() -> None:
            try:
                future.set_result(change())
            except Exception as error:
                future.set_exception(error)

        with self._guard:
            if self._plays == 0:
                return super()._submit(change)
            self._changes.put(run)
        return future

    def _publish(self) -> None:
        super()._publish()
        if self._pad_shear.shear is not self._field_of:
            self._field, self._field_of = self._pad_shear.field(), self._pad_shear.shear
