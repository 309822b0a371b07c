"""A simulated rig with one fault, and a watch on its truth: wrappers around its devices.

A fault of the world or the sensor comes a drawn time after the first contact, within a motion or
wait too where the reflex runs; else with the next call of a device.

Not here: faulty replies (``tacgrasp.benchmarks.limits.replies``).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from cltp.errors import TouchError
from cltp.tactile.cloud import Stamp, TactileCloud
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.shear.field import ShearField
from primitives.devices import Arm, GripperState, Pose
from sim.grasp.devices import ADJUST_S
from sim.grasp.rig import SimRig, Truth
from tacgrasp.benchmarks.limits.draw import Fault, FaultKind
from tacgrasp.benchmarks.limits.watch import Bounds, ForceWatch

WAIT_S = 0.2
"""Time that a reading waits for a fresh frame before it is an error [s]. Our choice: five periods
of a camera."""

LIFTED_M = 0.001


class World:
    """The world of one episode: when the fault comes, what it does at once, and the true force.

    Attributes:
        came_s: Simulated time at which the fault came [s]; None before.
        is_deadly: Whether the change itself bruised the body, or left it a force that can't hold
            it in the air, so that nobody could end verified.
    """

    def __init__(self, rig: SimRig, fault: Fault, watch: ForceWatch, bounds: Bounds) -> None:
        self.rig, self.fault, self.watch, self.bounds = rig, fault, watch, bounds
        self.came_s: float | None = None
        self.is_deadly = False
        self._contact_s: float | None = None
        self._restore: tuple[float, float] | None = None  # (time [s], true force [N])
        self._is_timed = fault.kind in (
            FaultKind.STALL,
            FaultKind.DRIFT,
            FaultKind.DEPTH,
            FaultKind.GRIPPER,
            FaultKind.JERK,
        )

    @property
    def now_s(self) -> float:
        """Simulated time [s]."""
        return self.rig.clock.simulated_s

    @property
    def force_n(self) -> float:
        """True force [N]; 0 where nothing is held."""
        patch = self.rig.grasp.patch
        return 0.0 if patch is None else patch.force_n

    @property
    def is_lifted(self) -> bool:
        """Whether the arm is above the start pose."""
        rise_m = self.rig.arm.pose().position_m[2] - self.rig.start_pose.position_m[2]
        return bool(rise_m > LIFTED_M)

    @property
    def is_stalled(self) -> bool:
        """Whether the sensor gives no frames now."""
        if self.fault.kind is not FaultKind.STALL or self.came_s is None:
            return False
        return self.now_s < self.came_s + self.fault.size

    def until_next_s(self) -> float:
        """Time until the world changes by itself [s], above 0; infinite where it does not."""
        due_s = math.inf
        if self._restore is not None:
            due_s = self._restore[0]
        elif self._is_timed and self.came_s is None and self._contact_s is not None:
            due_s = self._contact_s + self.fault.onset_s
        return max(due_s - self.now_s, 1e-6)

    def look(self, *, in_motion: bool = False) -> None:
        """Let what is due happen, and sample the force; called around every call of a device."""
        now_s = self.now_s
        self.watch.sample(now_s, self.force_n)
        if self._restore is not None and (not in_motion or now_s >= self._restore[0] - 1e-9):
            self._press(self._restore[1])
            self._restore = None
        if self._contact_s is None and self.force_n > 0:
            self._contact_s = now_s
        if not self._is_timed or self.came_s is not None or self._contact_s is None:
            return
        if now_s >= self._contact_s + self.fault.onset_s - 1e-9:
            self.came_s = now_s
            self._happen(in_motion=in_motion)

    def command(self) -> None:
        """A command has changed the grip: the gripper no longer gives way to a jerk."""
        self._restore = None
        self.watch.sample(self.now_s, self.force_n)

    def _happen(self, *, in_motion: bool) -> None:
        grasp, bruised = self.rig.grasp, self.rig.grasp.bruised
        if self.fault.kind is FaultKind.GRIPPER:
            factor = self.fault.size / self.rig.gripper.force_gain
            self.rig.gripper.force_gain = self.fault.size
            if grasp.patch is None:
                return
            self._press(factor * self.force_n)
            lost = self.is_lifted and self._margin() < 1
            self.is_deadly = lost or grasp.bruised != bruised
        elif self.fault.kind is FaultKind.JERK and grasp.patch is not None:
            before_n = self.force_n
            self._jerk()
            self._press(self.fault.press * before_n)
            self.is_deadly = grasp.bruised != bruised
            if in_motion:
                self._restore = (self.now_s + ADJUST_S, before_n)
            else:
                self._press(before_n)  # before anybody looks: a reading takes longer than that

    def _margin(self) -> float:
        """Friction over load of the body in the air, at rest; below 1 it falls at once."""
        patch = self.rig.grasp.patch
        if patch is None:
            return 0.0
        return self.rig.grasp.fingers.resistance(patch, (0.0, 0.0)).margin

    def _jerk(self) -> None:
        """Push the body: in the air by an acceleration, on its support by a shift."""
        grasp, fault = self.rig.grasp, self.fault
        x, y = math.cos(fault.angle), math.sin(fault.angle)
        if self.is_lifted:
            beat, grasp.beat = grasp.beat, None
            grasp.load((fault.size * x, fault.size * y), fault.seconds)
            grasp.load((0.0, 0.0), fault.seconds)  # until it is at rest again
            grasp.beat = beat
        else:
            left, up = grasp.body_xy_mm
            grasp.body_xy_mm = (left + fault.shift_mm * x, up + fault.shift_mm * y)

    def _press(self, force_n: float) -> None:
        """Press with another true force [N], without a command."""
        if self.rig.grasp.patch is not None and force_n > 0:
            self.rig.grasp.adjust(force_n)
        self.watch.sample(self.now_s, self.force_n, is_change=True)


class FaultyClock:
    """The simulated clock; the world may change in the middle of its waits and calls."""

    def __init__(self, world: World) -> None:
        self._world, self._clock = world, world.rig.clock
        self.monotonic, self.wall = self._clock.monotonic, self._clock.wall
        self.stamp = self._clock.stamp

    @property
    def simulated_s(self) -> float:
        """Simulated time so far [s]."""
        return self._clock.simulated_s

    def sleep(self, seconds: float) -> None:
        """Let simulated time pass.

        Raises:
            Hung: The episode takes too long.
        """
        self._world.look()
        self._clock.sleep(seconds)
        self._world.look()
        self._world.bounds.check(self.simulated_s)

    def call_every(self, period_s: float, call: Callable[[], None] | None) -> None:
        """Call a function regularly, and let the world change in between; None ends it."""
        self._clock.call_every(period_s, call)
        self._world.command() if call is None else self._world.look()
        self._world.rig.grasp.beat = None if call is None else self

    def until_next_s(self) -> float:
        """Time until something is due [s]."""
        return min(self._clock.until_next_s(), self._world.until_next_s())

    def passed(self, seconds: float) -> None:
        """Time has passed within a motion or wait."""
        self._clock.passed(seconds)
        self._world.look(in_motion=True)
        self._world.bounds.check(self.simulated_s, counts=False)


class FaultyGripper:
    """The simulated gripper, whose force gain may become another one."""

    def __init__(self, world: World) -> None:
        self._world, self._gripper = world, world.rig.gripper
        self.state, self.stop = self._gripper.state, self._gripper.stop
        self.disconnect = self._gripper.disconnect

    def grip(self, force_n: float) -> GripperState:
        """Close, or adjust the grip, to a commanded force [N]."""
        return self._commanded(lambda: self._gripper.grip(force_n))

    def adjust(self, force_n: float) -> GripperState:
        """Ask for another force [N] of a closed grip, and return at once."""
        return self._commanded(lambda: self._gripper.adjust(force_n))

    def open_by(self, clear_m: float) -> GripperState:
        """Open by ``clear_m`` [m]."""
        return self._commanded(lambda: self._gripper.open_by(clear_m))

    def _commanded(self, call: Callable[[], GripperState]) -> GripperState:
        self._world.look()
        state = call()
        self._world.command()
        return state


class FaultySensor:
    """The simulated sensor, whose frames may stop, jump or be scaled."""

    def __init__(self, world: World) -> None:
        self._world, self._sensor = world, world.rig.sensor
        self._last: ShearField | None = None
        self._last_s = 0.0  # simulated time of its capture
        self._is_referenced = False  # whether a drift that came is in the reference
        self.disconnect = self._sensor.disconnect

    @property
    def spec(self) -> SensorSpec:
        return self._sensor.spec

    def read(self, frames: int = 1) -> TactileCloud:
        """The faulty cloud.

        Raises:
            TouchError: The sensor gives no frames.
            Hung: The episode takes too long.
        """
        self._wait()
        cloud = self._sensor.read(frames)
        self._world.look()
        points = np.array(cloud.points_mm)
        points[:, 2] = self._faulty(points[:, :2], points[:, 2])
        return replace(cloud, points_mm=points)

    def take_reference(self) -> None:
        """Take the gel as untouched, drift and all.

        Raises:
            TouchError: The sensor gives no frames.
            Hung: The episode takes too long.
        """
        self._wait()
        self._sensor.take_reference()
        self._world.look()
        self._is_referenced = self._world.came_s is not None

    def last_shear(self) -> ShearField | None:
        """The shear field of the frames that the last cloud came from; None without any."""
        return self._faulty_shear(self._sensor.last_shear())

    def newest_shear(self) -> ShearField | None:
        """The shear field of the newest frame, an old one in a stall; None without any."""
        now_s = self._world.now_s
        if not self._world.is_stalled:
            self._last, self._last_s = self._faulty_shear(self._sensor.newest_shear()), now_s
        if self._last is None:
            return None
        now, age_s = self._world.rig.clock.stamp(), now_s - self._last_s
        stamp = Stamp(monotonic_s=now.monotonic_s - age_s, wall_s=now.wall_s - age_s)
        return replace(self._last, stamp=stamp)

    def _wait(self) -> None:
        """Wait for a fresh frame, not for ever."""
        world = self._world
        world.look()
        world.bounds.check(world.now_s)
        if not world.is_stalled:
            return
        world.rig.clock.sleep(WAIT_S)
        world.look()
        if world.is_stalled:
            raise TouchError(f"no fresh frame came within {1000 * WAIT_S:.0f} ms; check the sensor")

    def _faulty_shear(self, field: ShearField | None) -> ShearField | None:
        if field is None or self._world.came_s is None:
            return field
        moved = np.array(field.displacement_mm)
        moved[:, 2] = self._faulty(field.positions_mm, moved[:, 2])
        return replace(field, displacement_mm=moved)

    def _faulty(self, xy_mm: NDArray[np.float32], z_mm: NDArray[np.float32]) -> NDArray[np.float32]:
        """Depths of points [mm], shape (N,), as the faulty unit gives them."""
        world, fault = self._world, self._world.fault
        if world.came_s is None:
            return z_mm
        if fault.kind is FaultKind.DEPTH:
            return (fault.size * z_mm).astype(np.float32)
        if fault.kind is FaultKind.DRIFT and not self._is_referenced:
            across = 2 * xy_mm[:, 0] / self.spec.width_mm  # broad, a little tilted
            return (z_mm + fault.size * (1 + 0.3 * across)).astype(np.float32)
        return z_mm


class FaultyArm:
    """The simulated arm; the force is sampled around its motions."""

    def __init__(self, world: World) -> None:
        self._world, self._arm = world, world.rig.arm
        self.pose, self.stop, self.disconnect = self._arm.pose, self._arm.stop, self._arm.disconnect

    def move_to(
        self, pose: Pose, *, speed_m_s: float = 0.05, acceleration_m_s2: float = 0.5
    ) -> Pose:
        """Move on a straight line."""
        self._world.look()
        reached = self._arm.move_to(pose, speed_m_s=speed_m_s, acceleration_m_s2=acceleration_m_s2)
        self._world.look()
        return reached


class FaultyRig:
    """A ``tacgrasp.rig.protocols.Rig`` around a simulated one."""

    def __init__(self, world: World) -> None:
        rig = world.rig
        self._rig = rig
        self.arm: Arm = FaultyArm(world)
        self.gripper, self.sensor = FaultyGripper(world), FaultySensor(world)
        self.clock = FaultyClock(world)
        self.start_pose, self.first_force_n = rig.start_pose, rig.first_force_n
        self.force_step_n = rig.force_step_n
        self.expect_untouched, self.commands = rig.expect_untouched, rig.commands
        self.disconnect = rig.disconnect

    def truth(self) -> Truth:
        """True state of the world."""
        return self._rig.truth()
