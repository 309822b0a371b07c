"""A held body under a load that changes in time: what the pad feels, and how far the body slides.

For a controller that changes the gripper's force many times a second. In one step the gripper has
some force and the body some load along the pads; both contacts shear, stick and slip, with memory
(``sim.gel.shear``), and the body keeps its momentum. What friction can't hold accelerates the body,
as in ``sim.grasp.world``.

The body is rigid but for its flesh under the pads. It moves along the pads and turns about the
closing axis; both contacts are the same. A step ends where elastic and inertial forces balance the
load (backward Euler), so that vibrations that are faster than a step die out.

Not here: the gripper's own response, errors of a sensor.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from cltp.tactile.cloud import FloatArray
from cltp.tactile.shear.field import ShearField
from sim.gel.shear.coarse import LOOP_ITERATIONS, LOOP_TOL
from sim.gel.shear.layer import Shear
from sim.gel.shear.sensed import shear_field
from sim.grasp.fingers import GRAVITY_M_S2, FlatFingers
from sim.grasp.pad_shear import coarse, grid_axes, slides
from sim.grasp.world import DROPPED_MM

_LEAST_N = 0.05
_RATIO = 1.25
"""Forces at which pressures are solved are this and its multiples by powers of the ratio [N]; in
between, pressures are interpolated, which keeps their sum. Our choice: a contact's radius grows by
8 % from one to the next."""

_FOLLOW_MM = 0.5  # slide after which the pressure is solved anew; until then it is shifted

_LOAD_TOL = 0.02  # of the friction: what a step may leave to the next
_EVALUATIONS = 5
_LEAST_OF_STIFFNESS = 0.01


@dataclass(frozen=True, slots=True, kw_only=True)
class HoldState:
    """A held body at the end of a step.

    Attributes:
        slipped_mm: Distance that the body slid along the pads since the holding began: the mean
            over the contact, weighted by pressure, of the steps in which no part of it stuck [mm].
        stick_fraction: Fraction of the normal force that rests on points that stick, 0 to 1. It
            falls as the load nears what friction holds, and is about 0 while the body slides.
        dropped: Whether the body is no longer between the pads; nothing touches them any more.
        tangential_n: Shape (2,), force of the body on one pad along x and y [N].
        shear: The contact with one pad.
        height_mm: Surface of its gel under pressure alone, (1, H, W) on the grid of ``shear`` [mm].
        fingers: Body, gel and friction.
    """

    slipped_mm: float
    stick_fraction: float
    dropped: bool
    tangential_n: FloatArray
    shear: Shear
    height_mm: Tensor
    fingers: FlatFingers

    @property
    def field(self) -> ShearField:
        """What the pad's markers or taxels see, without errors; computed when asked for."""
        layer = self.fingers.shear.shear_layer
        return shear_field(layer, self.shear, self.height_mm, self.fingers.sensor)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Pressed:
    """A contact under some force: pressure [kPa] and height [mm] (1, H, W), push (3,) [N]."""

    pressure_kpa: Tensor
    height_mm: Tensor
    push_n: FloatArray

    def towards(self, other: _Pressed, part: float) -> _Pressed:
        """The contact at a part of the way to another one."""
        return _Pressed(
            pressure_kpa=torch.lerp(self.pressure_kpa, other.pressure_kpa, part),
            height_mm=torch.lerp(self.height_mm, other.height_mm, part),
            push_n=self.push_n + part * (other.push_n - self.push_n),
        )

    def moved(self, by_mm: FloatArray, pitch_mm: float) -> _Pressed:
        """The contact of a body that slid by (x, y) [mm, gel frame], less than an element or so.

        Args:
            by_mm: Shape (2,).
            pitch_mm: Side of an element [mm].
        """
        if not by_mm.any():
            return self
        columns, rows = by_mm[0] / pitch_mm, -by_mm[1] / pitch_mm  # row 0 is at the top
        return _Pressed(
            pressure_kpa=_shifted(self.pressure_kpa, rows, columns),
            height_mm=_shifted(self.height_mm, rows, columns),
            push_n=self.push_n,
        )


class Holding:
    """Steps a held body through forces and loads.

    A step takes a few milliseconds of one core; one in which the force comes to a range for the
    first time, or the body has slid half a millimetre, some 20 ms more.

    Args:
        fingers: Body, gel and friction.
        force_n: True force of the gripper at the start, > 0 [N].
        offset_mm: The body's origin on the pad at the start [mm, gel frame].
        shear: The contact's memory at the start; None is a grip without any load yet.

    Raises:
        ValueError: The force is not positive and finite, or the pads don't reach the body.

    Example:
        >>> holding = Holding(fingers, 1.0)
        >>> state = holding.step(0.01, 1.0, holding.weight_n())
    """

    def __init__(
        self,
        fingers: FlatFingers,
        force_n: float,
        *,
        offset_mm: tuple[float, float] = (0.0, 0.0),
        shear: Shear | None = None,
    ) -> None:
        _check_force(force_n)
        if not fingers.reaches(offset_mm):
            raise ValueError(f"nothing is held at {offset_mm} mm: the body is beside the pad")
        self._fingers, self._layer = fingers, fingers.shear.shear_layer
        self._offset_mm = self._pressed_mm = np.array(offset_mm, dtype=np.float64)
        self._ladder: dict[int, _Pressed] = {}
        pressed = self._pressed(force_n)
        self._shear = self._layer.step(shear, pressed.pressure_kpa, torch.zeros(1, 3))
        self._stiffness = self._sticking = self._first_stiffness()
        self._velocity_mm_s, self._normal_n = np.zeros(3), force_n
        self._slipped_mm, self._dropped = 0.0, False

    def weight_n(self, acceleration_m_s2: tuple[float, float] = (0.0, 0.0)) -> FloatArray:
        """Load of weight and inertia while the fingers accelerate along the pad's (x, y).

        Returns:
            Shape (2,) [N], as ``step`` takes it.
        """
        up = np.array(self._fingers.up)
        return -self._fingers.body.mass_kg * (GRAVITY_M_S2 * up + np.array(acceleration_m_s2))

    def step(
        self, dt_s: float, force_n: float, load_n: FloatArray | tuple[float, float]
    ) -> HoldState:
        """Let time pass under a force and a load.

        Args:
            dt_s: Duration, > 0 [s].
            force_n: True normal force of either finger at the end of the step, > 0 [N].
            load_n: Shape (2,), force on the body at its centre of mass, along the pad's x and y
                [N], of which each pad carries half; that of weight and inertia is ``weight_n``.

        Raises:
            ValueError: A value is out of range or not finite.
        """
        _check_force(force_n)
        load = np.asarray(load_n, dtype=np.float64)
        is_load = load.shape == (2,) and bool(np.isfinite(load).all())
        if not (0 < dt_s < math.inf and is_load):
            raise ValueError(
                f"a step needs dt_s > 0 and a load_n of shape (2,), all finite; got {dt_s}, {load}"
            )
        pressed = self._now_pressed(force_n)
        if not self._dropped:
            self._move(dt_s, pressed, np.append(load / 2, 0.0) + pressed.push_n)
        return self._state(pressed)

    def drag(self, force_n: float, motion_mm: FloatArray | tuple[float, float]) -> HoldState:
        """Move the body by hand, as a support does on which it stands while the fingers rise.

        It does not turn, and has no momentum afterwards.

        Args:
            force_n: As ``step`` takes it.
            motion_mm: Shape (2,), motion of the body along the pad's x and y [mm].

        Raises:
            ValueError: A value is out of range or not finite.
        """
        _check_force(force_n)
        motion = np.asarray(motion_mm, dtype=np.float64)
        if motion.shape != (2,) or not np.isfinite(motion).all():
            raise ValueError(f"a drag needs a motion_mm of shape (2,), all finite; got {motion}")
        pressed = self._now_pressed(force_n)
        if not self._dropped:
            before, carried = self._shear, self._axes() @ np.append(motion, 0.0)
            self._shear = self._layer.step(
                before, pressed.pressure_kpa, torch.as_tensor(carried)[None]
            )
            self._velocity_mm_s = np.zeros(3)
            self._slide(before, carried)
        return self._state(pressed)

    def _now_pressed(self, force_n: float) -> _Pressed:
        """The contact under a force where the body is now; nothing of a dropped one."""
        if self._dropped:
            self._shear = self._layer.at_rest()
            return self._nothing()
        slid_mm = self._offset_mm - self._pressed_mm
        return self._pressed(force_n).moved(slid_mm, self._layer.layer.pitch_mm)

    def _state(self, pressed: _Pressed) -> HoldState:
        return HoldState(
            slipped_mm=self._slipped_mm,
            stick_fraction=float(self._shear.stick_fraction),
            dropped=self._dropped,
            tangential_n=self._shear.force_n[0].double().numpy(),
            shear=self._shear,
            height_mm=pressed.height_mm,
            fingers=self._fingers,
        )

    def _move(self, dt_s: float, pressed: _Pressed, load_n: FloatArray) -> None:
        """Move the body, and the contacts with it, under a load about the centre of mass.

        Newton's method, with a stiffness that BFGS updates improve and that is kept from step to
        step. What the last evaluation leaves of the load, the next step finds.
        """
        before, axes, best_n = self._shear, self._axes(), math.inf
        normal_n = 1e-3 * float(pressed.pressure_kpa.sum()) * self._layer.layer.pitch_mm**2
        enough_n = _LOAD_TOL * self._layer.friction * normal_n
        inertia = self._inertia() / dt_s**2
        momentum_n = inertia * self._velocity_mm_s * dt_s
        motion_mm, best_mm, shear = np.zeros(3), np.zeros(3), before
        if slides(before) and normal_n > self._normal_n:  # it may stick again
            self._stiffness = self._sticking
        self._normal_n = normal_n
        carried_n = _carried(before, axes)
        for evaluation in range(_EVALUATIONS):
            missing_n = load_n + momentum_n - inertia * motion_mm - carried_n
            by_mm = np.linalg.solve(self._stiffness + np.diag(inertia), missing_n).astype(float)
            motion_mm = motion_mm + by_mm
            shear = self._layer.step(
                before,
                pressed.pressure_kpa,
                torch.as_tensor(axes @ motion_mm)[None],
                start_kpa=shear.traction_kpa,
                tol=LOOP_TOL,
                max_iterations=LOOP_ITERATIONS,
            )
            last_n, carried_n = carried_n, _carried(shear, axes)
            if evaluation > 0:
                self._stiffness = _improved(self._stiffness, by_mm, carried_n - last_n)
            left_n = load_n + momentum_n - inertia * motion_mm - carried_n
            error_n = float(np.linalg.norm(left_n))
            if error_n < best_n:
                best_n, best_mm, self._shear = error_n, motion_mm, shear
            if error_n <= enough_n:
                break
        self._velocity_mm_s = best_mm / dt_s
        self._slide(before, axes @ best_mm)

    def _slide(self, before: Shear, motion: FloatArray) -> None:
        """Count the slip of a step in which nothing sticks, and let the pressure follow."""
        after = self._shear
        if not slides(after):
            return
        move = torch.as_tensor(motion, dtype=after.held_mm.dtype)
        carried_mm = move[:2, None, None] + move[2] * self._layer.displacement_of_turn
        slip_mm = before.held_mm[0] + carried_mm - after.held_mm[0]
        weight = after.pressure_kpa[0] / after.pressure_kpa.sum()
        self._slipped_mm += float((weight * slip_mm.norm(dim=0)).sum())
        self._offset_mm = self._offset_mm + (weight * slip_mm).sum((1, 2)).double().numpy()
        offset_mm = (float(self._offset_mm[0]), float(self._offset_mm[1]))
        is_lost = self._slipped_mm > DROPPED_MM or not self._fingers.reaches(offset_mm)
        if is_lost:
            self._dropped = True
        elif math.dist(self._pressed_mm, offset_mm) > _FOLLOW_MM:
            self._pressed_mm = self._offset_mm
            self._ladder.clear()

    def _pressed(self, force_n: float) -> _Pressed:
        """The contact under a force, between the two of the ladder beside it."""
        step = max(0, math.floor(math.log(force_n / _LEAST_N, _RATIO)) + 1)
        below_n, above_n = _force_at(step - 1), _force_at(step)
        below, above = (self._at_step(each) for each in (step - 1, step))
        return below.towards(above, (force_n - below_n) / (above_n - below_n))

    def _at_step(self, step: int) -> _Pressed:
        """A contact of the ladder; nothing below its first."""
        if step < 0:
            return self._nothing()
        if step not in self._ladder:
            offset_mm = (float(self._pressed_mm[0]), float(self._pressed_mm[1]))
            patch = self._fingers.press(offset_mm, _force_at(step))
            self._ladder[step] = _Pressed(
                pressure_kpa=coarse(self._fingers, patch.pressure_kpa),
                height_mm=coarse(self._fingers, patch.height_mm),
                push_n=self._fingers.push_on(patch),
            )
        return self._ladder[step]

    def _nothing(self) -> _Pressed:
        empty = self._layer.at_rest().pressure_kpa
        return _Pressed(pressure_kpa=empty, height_mm=empty, push_n=np.zeros(3))

    def _axes(self) -> FloatArray:
        return grid_axes(self._fingers, self._offset_mm)

    def _inertia(self) -> FloatArray:
        """Half of the body's inertia along its three motions, (3,) [N s²/mm]."""
        return 1e-3 * np.array([self._fingers.inertia_kg(motion) for motion in np.eye(3)])

    def _first_stiffness(self) -> FloatArray:
        """Stiffness of the sticking contact, (3, 3) [N/mm], measured by small motions."""
        axes = self._axes()
        columns = []
        for by_mm in 1e-4 * np.eye(3):
            moved = self._layer.step(
                self._shear, self._shear.pressure_kpa, torch.as_tensor(axes @ by_mm)[None]
            )
            columns.append((_carried(moved, axes) - _carried(self._shear, axes)) / 1e-4)
        stiffness = np.stack(columns, axis=1)
        return np.asarray((stiffness + stiffness.T) / 2)


def _force_at(step: int) -> float:
    """Force of a step of the ladder [N]; 0 below its first."""
    return float(_LEAST_N * _RATIO**step) if step >= 0 else 0.0


def _shifted(grid: Tensor, rows: float, columns: float) -> Tensor:
    """A grid (1, H, W) shifted by parts of its elements; nothing comes in over its edges."""
    for dim, by in ((1, rows), (2, columns)):
        whole = math.floor(by)
        near, far = (_rolled(grid, dim, each) for each in (whole, whole + 1))
        grid = torch.lerp(near, far, by - whole)
    return grid


def _rolled(grid: Tensor, dim: int, by: int) -> Tensor:
    """A grid shifted by whole elements along a dimension, zeros at the edge."""
    rolled, count = torch.roll(grid, by, dim), min(abs(by), grid.shape[dim])
    if count:
        rolled.narrow(dim, 0 if by > 0 else grid.shape[dim] - count, count).zero_()
    return rolled


def _check_force(force_n: float) -> None:
    if not 0 < force_n < math.inf:
        raise ValueError(f"a body is held by a finite force > 0 N, got {force_n}")


def _carried(shear: Shear, axes: FloatArray) -> FloatArray:
    """Load that a contact carries, about the centre of mass, (3,) [N]."""
    load = torch.cat([shear.force_n[0], shear.moment_nmm])
    return np.asarray(axes.T @ load.double().numpy())


def _improved(stiffness: FloatArray, by_mm: FloatArray, carried_n: FloatArray) -> FloatArray:
    """BFGS update of a stiffness (3, 3) [N/mm] by what a motion carried.

    It stays symmetric and positive: along a motion that carried nothing, since the contact slides,
    it falls to a hundredth at most (Powell's damping).
    """
    guessed_n = stiffness @ by_mm
    guessed_mj, carried_mj = float(by_mm @ guessed_n), float(by_mm @ carried_n)
    if guessed_mj <= 0:
        return stiffness
    least = _LEAST_OF_STIFFNESS * guessed_mj
    if carried_mj < least:
        part = (guessed_mj - least) / (guessed_mj - carried_mj)
        carried_n = np.asarray(part * carried_n + (1 - part) * guessed_n)
        carried_mj = least
    return np.asarray(
        stiffness
        + np.outer(carried_n, carried_n) / carried_mj
        - np.outer(guessed_n, guessed_n) / guessed_mj
    )
