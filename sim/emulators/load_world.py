"""A drawn load in real time, behind an emulated taxel array and an emulated gripper.

For the time that a slip takes through the wire to the gripper's registers: the body is that of
``sim.grasp.drawn.loads``, stepped with its inertia (``sim.grasp.holding``), and nothing but the
array's packets and the gripper's commands goes in or out.

Not here: a whole rig's world (``sim.emulators.world``), the wires.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from cltp.tactile.shear.field import ShearField
from cltp.tactile.shear.noise import ShearUnit
from sim.grasp.devices import ADJUST_S
from sim.grasp.drawn.loads import STEP_S, DrawnLoad, LoadFrame, LoadStepper


class LoadWorld:
    """One drawn load at a time; height source and load of the emulated devices.

    Args:
        drawn: The load; the body is held at rest until ``run``.
        unit: Errors of the sensor.
        rng: Draws them.
        clock: Monotonic [s].

    Attributes:
        drawn: The load.

    Raises:
        ValueError: The pads don't reach the body.
    """

    def __init__(
        self,
        drawn: DrawnLoad,
        unit: ShearUnit,
        rng: np.random.Generator,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.drawn, self._unit, self._rng, self._clock = drawn, unit, rng, clock
        self._sensor = drawn.fingers.sensor
        self._stepper = LoadStepper(drawn)
        self._field = self._stepper.frame.field_of(self._sensor)
        self._seen: ShearField | None = None
        self._forces: list[tuple[float, float]] = []
        self._began_s = 0.0

    @property
    def commands(self) -> tuple[tuple[float, float], ...]:
        """Forces that the registers asked for, with the time since the load began [s, N]."""
        return tuple((at_s - self._began_s, force_n) for at_s, force_n in list(self._forces))

    def run(self) -> list[LoadFrame]:
        """Let the load come on in real time, until it is over or the body is gone for ``GONE_S``.

        A step takes as long as one of the benchmark's dynamics; where computing takes longer, the
        next one is as much longer.

        Returns:
            The body after each step, by the time at which it could first be seen.
        """
        stepper, self._began_s = self._stepper, self._clock()
        frames, at_s = [stepper.frame], 0.0
        while at_s < stepper.ends_s:
            to_s = max(at_s + STEP_S, self._clock() - self._began_s)
            frame = stepper.step(to_s - at_s, to_s, self._force_at(self._began_s + to_s))
            seen = frame.field_of(self._sensor)
            time.sleep(max(0.0, self._began_s + to_s - self._clock()))
            self._field = seen
            frames.append(replace(frame, t_s=self._clock() - self._began_s))
            at_s = to_s
        return frames

    def height_mm(self) -> NDArray[np.float32]:
        """Heights of a new frame, at the taxels [mm]."""
        self._seen = self._unit.apply(self._field, self._rng)
        return self._grid(self._seen)[:, :, 2]

    def along_mm(self) -> NDArray[np.float32]:
        """Displacements of that frame along the gel, shape (rows, columns, 2) [mm]."""
        assert self._seen is not None  # heights come first
        return self._grid(self._seen)[:, :, :2]

    def width_under(self, force_n: float) -> float:
        """Note a command; returns the opening at which the fingers rest [m]."""
        self._forces.append((self._clock(), force_n))
        return self.drawn.fingers.body.thickness_mm / 1000

    def release(self) -> None:
        """Nothing to note: the next load is another world."""

    def _grid(self, seen: ShearField) -> NDArray[np.float32]:
        rows, columns = self._sensor.shear_grid or (0, 0)
        return seen.displacement_mm.reshape(rows, columns, 3)

    def _force_at(self, at_s: float) -> float:
        """True force at a time of the clock [s]: a command comes into force ``ADJUST_S`` later."""
        forces = [force_n for sent_s, force_n in list(self._forces) if sent_s + ADJUST_S <= at_s]
        return forces[-1] if forces else self.drawn.force_n
