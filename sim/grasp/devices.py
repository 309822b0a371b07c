"""Simulated arm, gripper, tactile sensor and clock around one ``sim.grasp.world.Grasp``.

They observe only what real ones would: poses, commanded forces, a noisy gel. Time is simulated: the
clock jumps by the duration of motions and waits.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from cltp.errors import TouchError
from cltp.tactile.cloud import Stamp, TactileCloud, cloud_of_pixels, grid_axes_mm, heights_at
from cltp.tactile.force_scale import UNCALIBRATED, ForceScale
from cltp.tactile.sensor_noise import NoiseUnit, SlowDrift, smooth_field
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.shear.field import ShearField
from cltp.tactile.shear.noise import ShearUnit
from primitives.devices import GripperState, Pose
from primitives.errors import LimitError, RobotError
from sim.grasp.bodies import Range
from sim.grasp.fingers import grid_of
from sim.grasp.world import Grasp

START_POSE = Pose(
    position_m=np.array([0.45, -0.10, 0.20]), rotvec_rad=np.array([math.pi, 0.0, 0.0])
)
"""Fingers pointing down: TCP z along base -z, TCP x along base x."""

PadAxis = tuple[float, float, float]
PAD_X_IN_TCP: PadAxis = (1.0, 0.0, 0.0)
PAD_Y_IN_TCP: PadAxis = (0.0, 0.0, -1.0)

MAX_WIDTH_M = 0.11
MAX_FORCE_N = 20.0
REACH_M = 0.9
GRIP_S = 0.6
"""Time to close from open [s]."""

ADJUST_S = 0.03
"""Time to change the force of a closed grip [s]."""

REFERENCE_FRAMES = 5
CONTACT_ERROR = Range(low=0.007, high=0.05, log=True)
"""Standard deviation of the reconstruction error of a contact over its depth. Source: real presses
of a ball differ outside their contacts by 0.006 mm, of 0.87 mm depth, under a calibration of the
same unit; the upper end, for other units, is our choice."""

OPEN_SPEED_M_S = 0.05


class SimClock:
    """Clock of a simulated world: it moves by simulated motions, frames and waits alone.

    Time that the computer takes does not pass, so that an episode is the same on any computer.
    """

    def __init__(self) -> None:
        self._began_s, self._began_wall_s, self._offset_s = time.monotonic(), time.time(), 0.0
        self._grasp: Grasp | None = None
        self._period_s, self._left_s, self._made_s = math.inf, math.inf, 0.0
        self._call: Callable[[], None] | None = None
        self._pending: tuple[float, Callable[[], None]] | None = None

    def monotonic(self) -> float:
        return self._began_s + self._offset_s

    def wall(self) -> float:
        return self._began_wall_s + self._offset_s

    def sleep(self, seconds: float) -> None:
        """Let simulated time pass; the attached grasp follows."""
        if seconds < 0:
            raise ValueError(f"can't sleep for {seconds} s")
        if self._grasp is not None:
            self._grasp.wait(seconds)
        self.advance(seconds)

    def call_every(self, period_s: float, call: Callable[[], None] | None) -> None:
        """Call a function regularly while the world moves or waits; None ends it.

        Args:
            period_s: Period, in simulated time, > 0 [s].
            call: May raise, which ends the motion that it is called in.
        """
        if not period_s > 0:
            raise ValueError(f"a period needs to be above 0 s, got {period_s}")
        self._call, self._period_s, self._left_s = call, period_s, period_s
        if call is None and self._pending is not None:
            self._pending[1]()  # what was commanded still happens
            self._pending = None
        if self._grasp is not None:
            self._grasp.beat = None if call is None else self
        self._made_s = 0.0  # a motion that was cut short is not advanced by

    def call_after(self, delay_s: float, call: Callable[[], None]) -> None:
        """Call a function once, after a delay > 0 [s]; it takes the place of one still waiting.

        Without ``call_every``, which moves the world in parts, the delay passes at once.
        """
        if self._call is None:
            self.advance(delay_s)
            call()
        else:
            self._pending = (delay_s, call)

    def until_next_s(self) -> float:
        """Time until the next call is due [s]."""
        return min(self._left_s, math.inf if self._pending is None else self._pending[0])

    def passed(self, seconds: float) -> None:
        """Time has passed within a motion or wait; call what is due."""
        self._offset_s += seconds
        self._made_s += seconds
        if self._pending is not None:
            delay_s, change = self._pending
            self._pending = (delay_s - seconds, change)
            if delay_s - seconds <= 1e-9:
                self._pending = None
                change()
        self._left_s -= seconds
        if self._left_s <= 1e-9 and self._call is not None:
            self._left_s = self._period_s
            self._call()

    @property
    def simulated_s(self) -> float:
        """Duration of simulated motions, frames and waits so far [s]; the same in every run."""
        return self._offset_s

    def advance(self, seconds: float) -> None:
        """Advance the clock after a motion that the world has already made.

        Args:
            seconds: All of its duration; what ``passed`` has counted is not counted again.
        """
        self._offset_s += max(0.0, seconds - self._made_s)
        self._made_s = 0.0

    def attach(self, grasp: Grasp) -> None:
        """Attach the grasp that ``sleep`` acts on."""
        self._grasp = grasp

    def stamp(self) -> Stamp:
        return Stamp(monotonic_s=self.monotonic(), wall_s=self.wall())


class _Device:
    """A device that refuses commands and reads once it is disconnected."""

    _name: str
    _error: type[RobotError | TouchError] = RobotError
    _connected = True

    def disconnect(self) -> None:
        self._connected = False

    def _check_connected(self) -> None:
        if not self._connected:
            raise self._error(f"the simulated {self._name} is disconnected")


class SimArm(_Device):
    """Moves the pad of a simulated grasp; a ``primitives.devices.Arm``."""

    _name = "arm"

    def __init__(
        self,
        grasp: Grasp,
        clock: SimClock,
        pad_x_in_tcp: PadAxis = PAD_X_IN_TCP,
        pad_y_in_tcp: PadAxis = PAD_Y_IN_TCP,
    ) -> None:
        self._grasp, self._clock = grasp, clock
        self._pad_axes = (pad_x_in_tcp, pad_y_in_tcp)
        self._pose = START_POSE

    def pose(self) -> Pose:
        self._check_connected()
        return self._pose

    def move_to(
        self, pose: Pose, *, speed_m_s: float = 0.05, acceleration_m_s2: float = 0.5
    ) -> Pose:
        """Move on a straight line; the world moves the held body, or lets it slip."""
        self._check_connected()
        if not (0 < speed_m_s <= 1 and 0 < acceleration_m_s2 <= 10):
            raise LimitError(
                f"speed {speed_m_s} m/s or acceleration {acceleration_m_s2} m/s² is beyond the "
                "simulated arm (1 m/s, 10 m/s²)"
            )
        if np.linalg.norm(pose.position_m) > REACH_M:
            raise LimitError(
                f"position {pose.position_m.round(3).tolist()} m is beyond the simulated arm's "
                f"reach of {REACH_M} m"
            )
        if np.linalg.norm(pose.rotvec_rad - self._pose.rotvec_rad) > 1e-6:
            raise LimitError("the simulated arm keeps its orientation; only the position may move")
        base_from_tcp = Rotation.from_rotvec(np.array(self._pose.rotvec_rad))
        by_m = pose.position_m - self._pose.position_m
        by_mm = tuple(float(1000 * base_from_tcp.apply(axis) @ by_m) for axis in self._pad_axes)
        try:
            seconds = self._grasp.move((by_mm[0], by_mm[1]), speed_m_s, acceleration_m_s2)
            self._clock.advance(seconds)
        finally:
            self._pose = pose  # the world is there, of a motion that was cut short too
        return self._pose

    def stop(self) -> None:
        """Nothing to stop: simulated motions have ended when ``move_to`` returns."""


def settled_width_m(grasp: Grasp) -> float:
    """Opening at which closed fingers rest [m]: on the held body, 0 without one."""
    if grasp.patch is None:
        return 0.0
    return max(0.0, grasp.fingers.body.thickness_mm - 2 * grasp.patch.depth_mm) / 1000


class SimGripper(_Device):
    """Closes the fingers of a simulated grasp; a ``primitives.devices.Gripper``.

    Attributes:
        force_gain: Ratio of true to commanded force; hidden from policies.
    """

    _name = "gripper"

    def __init__(self, grasp: Grasp, clock: SimClock, force_gain: float) -> None:
        self._grasp, self._clock, self.force_gain = grasp, clock, force_gain
        self._state = GripperState(width_m=MAX_WIDTH_M, force_n=0.0, closed=False)

    def state(self) -> GripperState:
        self._check_connected()
        if self._state.closed and self._grasp.patch is None:
            return replace(self._state, width_m=0.0)  # what it held is gone
        return self._state

    def grip(self, force_n: float) -> GripperState:
        """Close, or adjust the grip, to a commanded force, which ``force_gain`` multiplies."""
        self._check_connected()
        if not (math.isfinite(force_n) and 0 < force_n <= MAX_FORCE_N):
            raise LimitError(f"force must lie in (0, {MAX_FORCE_N}] N, got {force_n}")
        self._clock.advance(ADJUST_S if self._state.closed else GRIP_S)
        self._grasp.close(force_n * self.force_gain)
        self._state = GripperState(
            width_m=settled_width_m(self._grasp), force_n=force_n, closed=True
        )
        return self._state

    def adjust(self, force_n: float) -> GripperState:
        """Ask for another force of a closed grip, and return at once; it is there ``ADJUST_S`` on.

        Raises:
            LimitError: The grip is open, or the force is out of range.
        """
        self._check_connected()
        if not (self._state.closed and 0 < force_n <= MAX_FORCE_N):
            raise LimitError(
                f"only a closed grip is adjusted, to (0, {MAX_FORCE_N}] N; closed "
                f"{self._state.closed}, {force_n} N"
            )
        self._state = replace(self._state, force_n=force_n)
        self._clock.call_after(ADJUST_S, lambda: self._settle(force_n))
        return self._state

    def _settle(self, force_n: float) -> None:
        self._grasp.adjust(force_n * self.force_gain)
        self._state = replace(self._state, width_m=settled_width_m(self._grasp))

    def open_by(self, clear_m: float) -> GripperState:
        """Open by ``clear_m`` [m]."""
        self._check_connected()
        if not (math.isfinite(clear_m) and clear_m > 0):
            raise LimitError(f"the gripper opens by a positive number of metres, got {clear_m}")
        self._grasp.open()
        width_m = min(MAX_WIDTH_M, self._state.width_m + clear_m)
        self._clock.advance((width_m - self._state.width_m) / OPEN_SPEED_M_S)
        self._state = GripperState(width_m=width_m, force_n=0.0, closed=False)
        return self._state

    def stop(self) -> None:
        """Nothing to stop; the grip is kept."""


class SimSensor(_Device):
    """A ``tacgrasp.rig.protocols.TactileSensor`` that reads the gel of a simulated grasp.

    Its errors: those of the unit, a slow drift that goes on in time whether the gel is touched or
    not, a reconstruction error that scales with the contact, and fine noise and missing points, new
    in every frame.
    ``take_reference`` takes the drift of the moment away.
    A sensor of shear reads the field of the same frames, with errors of its own generator.
    """

    _name, _error = "sensor", TouchError

    def __init__(
        self,
        grasp: Grasp,
        clock: SimClock,
        spec: SensorSpec,
        noise: NoiseUnit,
        seed: int,
        *,
        drift_level: float = 1.0,
        force_scale: ForceScale = UNCALIBRATED,
        shear_unit: ShearUnit | None = None,
    ) -> None:
        self._shear_unit, self._shear_rng = shear_unit, np.random.default_rng([seed, 9])
        self._last_shear: ShearField | None = None
        self._force_scale = force_scale
        self._grasp, self._clock, self._spec, self._seed = grasp, clock, spec, seed
        # The drift goes on in time instead, and a marker that is not detected is a missing point.
        point_loss = max(noise.point_loss, noise.marker_loss)
        self._noise = replace(noise, drift_mm=0.0, point_loss=point_loss)
        self._frame_rng = np.random.default_rng([seed, 4])
        rng = np.random.default_rng([seed, 5])
        self._shape = grid_of(spec)
        self._drift = SlowDrift.draw(rng, self._shape, spec, noise, drift_level)
        self._contact_error = drift_level * CONTACT_ERROR.quantile(rng.random())
        self._reference = np.zeros(self._shape, np.float32)

    @property
    def spec(self) -> SensorSpec:
        return self._spec

    def surface_mm(self) -> NDArray[np.float32]:
        """Surface with the reconstruction error of its contact alone, shape ``grid_of`` [mm].

        It changes with the contact only: no frame's noise and no drift is in it.
        """
        patch = self._grasp.patch
        if patch is None:
            return np.zeros(self._shape, np.float32)
        rng = np.random.default_rng([self._seed, 3, self._grasp.contacts])
        length_mm = rng.uniform(*self._noise.drift_length_mm)
        error = smooth_field(self._shape, self._spec, length_mm, rng)
        return patch.height_mm + self._contact_error * patch.height_mm.max() * error

    def frame_mm(self, surface_mm: NDArray[np.float32], t_s: float) -> NDArray[np.float32]:
        """A new frame of a surface [mm]: with the unit's errors, noise, and the drift at ``t_s``.

        Args:
            surface_mm: From ``surface_mm``, shape (rows, columns).
            t_s: Time of the episode [s].
        """
        noisy = self._noise.apply(surface_mm, self._spec, self._frame_rng)
        return noisy + self._drift.at(t_s)

    def take_reference(self) -> None:
        """Take the mean of some frames of the present gel as untouched."""
        self._check_connected()
        self._reference = self._mean_of(REFERENCE_FRAMES)

    def _mean_of(self, count: int) -> NDArray[np.float32]:
        """Mean of the next frames of the present gel, shape ``grid_of`` [mm]."""
        surface_mm, total = self.surface_mm(), np.zeros(self._shape, np.float32)
        for _ in range(count):
            self._clock.advance(1.0 / self._spec.frame_hz)
            total += self.frame_mm(surface_mm, self._clock.simulated_s)
        return total / np.float32(count)

    def read(self, frames: int = 1) -> TactileCloud:
        self._check_connected()
        heights_mm = self._mean_of(frames) - self._reference
        stamp = self._clock.stamp()
        if self._spec.markers is not None:
            heights_mm = at_cells(heights_mm, self._spec, *self._spec.markers)
        cloud = cloud_of_pixels(heights_mm, self._spec, stamp=stamp, force_scale=self._force_scale)
        self._last_shear = self._shear(stamp, frames)
        points = self._noise.received(cloud.points_mm, self._frame_rng)
        return cloud if points is cloud.points_mm else replace(cloud, points_mm=points)

    def last_shear(self) -> ShearField | None:
        """The shear field of the frames that the last cloud came from; None without any."""
        return self._last_shear

    def newest_shear(self) -> ShearField | None:
        """The shear field of the frame of this moment, without waiting; None without any.

        Raises:
            TouchError: The sensor is disconnected, or the frame can't be read.
        """
        self._check_connected()
        return self._shear(self._clock.stamp(), 1)

    def _shear(self, stamp: Stamp, frames: int) -> ShearField | None:
        if self._grasp.shear is None:
            return None
        return self.shear_frame(self._grasp.shear.field(stamp), frames)

    def shear_frame(self, field: ShearField, frames: int = 1) -> ShearField | None:
        """A true shear field as this unit reads it; None for a unit that measures none."""
        if self._shear_unit is None:
            return None
        return self._shear_unit.apply(field, self._shear_rng, frames=frames)


def at_cells(
    height_mm: NDArray[np.float32], spec: SensorSpec, rows: int, columns: int
) -> NDArray[np.float32]:
    """Heights in the middle of equal cells, (rows, columns) [mm]."""
    x, y = np.meshgrid(*grid_axes_mm(spec, rows, columns))
    heights = heights_at(height_mm.astype(np.float64), x.ravel(), y.ravel(), spec)
    return heights.reshape(rows, columns).astype(np.float32)
