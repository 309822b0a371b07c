"""Loads on held bodies, drawn: lifts, pulls and jolts, of which about half are more than is held.

For measuring what a slip detector sees and when. Not here: the dynamics (``sim.grasp.holding``),
sensors' errors.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from cltp.tactile.cloud import FloatArray
from cltp.tactile.sensors import SensorSpec, sensor_named
from cltp.tactile.shear.field import ShearField
from sim.gel.layer import gel_of
from sim.gel.shear.sensed import shear_field
from sim.grasp.bodies import Range, draw_body
from sim.grasp.fingers import GRAVITY_M_S2, FlatFingers
from sim.grasp.holding import Holding, HoldState
from sim.grasp.pad_shear import SLIDING_STICK

AFTER_S = 0.15
"""Time for which a load is followed once it has risen, or once a jolt has ended [s]."""

LEAST_GRIP_N = 0.15
"""Least true force of a grip [N]: the low end of the strawberry's band."""

BODIES = ("cherry_tomato", "egg", "peg", "strawberry")
"""Kinds of the bodies. Those that plugins add are not among them, so that a seed stays its load."""

OVERLOAD = Range(low=0.25, high=1.9)
"""Peak load over what friction of both pads resists without torsion. Our choice: half slip."""

RAMP_S = {
    "lift": Range(low=0.02, high=0.15, log=True),
    "pull": Range(low=0.05, high=0.5, log=True),
    "jolt": Range(low=0.06, high=0.25, log=True),
}
"""Duration of the rise of a lift or pull, and of all of a jolt [s]. Our choice: from a lift's start
to a hand that pulls."""

GRIP = Range(low=1.3, high=4.0, log=True)
"""Force of a grip over the least that would hold the weight without torsion, of a pull or jolt."""

OFFSET_MM = (3.0, 2.0)
"""Largest offsets of the body on the pad along x and y [mm]."""


STEP_S = 0.01
"""Step of the dynamics [s]."""

GONE_S = 0.1
"""Time for which a load is followed once the body is gone [s]. Our choice: two periods of a camera,
and a reflex that takes its time; a sensor goes on giving frames of a gel that nothing touches."""

_CARRY_STEPS = 15
_ROUNDING_S = 1e-9


class LoadKind(StrEnum):
    """What happens to the held body."""

    LIFT = "lift"  # the weight comes on
    PULL = "pull"  # the weight is carried; a force rises to its peak and stays
    JOLT = "jolt"  # the weight is carried; a force rises and falls like half a sine


@dataclass(frozen=True, slots=True, kw_only=True)
class DrawnLoad:
    """A held body and the load on it over time.

    Attributes:
        kind: What happens.
        object_name: Kind of the body.
        fingers: Body, gel and friction.
        offset_mm: The body's origin on the pad [mm, gel frame].
        force_n: True force of either finger [N].
        ramp_s: How long it rises, from time 0 on; a jolt lasts as long [s].
        carried_n: Shape (2,), load before [N].
        extra_n: Shape (2,), what comes on top of it at the peak [N].
    """

    kind: LoadKind
    object_name: str
    fingers: FlatFingers
    offset_mm: tuple[float, float]
    force_n: float
    ramp_s: float
    carried_n: FloatArray
    extra_n: FloatArray

    @property
    def duration_s(self) -> float:
        """Time for which the load is followed [s]."""
        return self.ramp_s + AFTER_S

    def load_n(self, t_s: float) -> FloatArray:
        """Load on the body at a time, shape (2,) [N]."""
        part = t_s / self.ramp_s
        if self.kind is LoadKind.JOLT:
            rise = math.sin(math.pi * part) if 0 < part < 1 else 0.0
        else:
            rise = min(1.0, max(0.0, part))
        return np.asarray(self.carried_n + rise * self.extra_n)


def draw_load(seed: int, sensor_name: str) -> DrawnLoad:
    """Draw body, grip and load of a seed; the same for every sensor on the same gel.

    Raises:
        TouchError: The sensor is unknown.
        ValueError: No gel is known for the sensor.
    """
    rng = np.random.default_rng([seed, 25])
    sensor = sensor_named(sensor_name)
    name = str(rng.choice(BODIES))
    body = draw_body(name, rng)
    fingers = FlatFingers(body, sensor, gel_of(sensor_name))
    kind = LoadKind(str(rng.choice([each.value for each in LoadKind])))
    overload, grip = OVERLOAD.quantile(rng.random()), GRIP.quantile(rng.random())
    weight_n = body.mass_kg * GRAVITY_M_S2
    down = -np.array(fingers.up)
    angle = rng.uniform(0, 2 * math.pi)
    if kind is LoadKind.LIFT:
        force_n = max(LEAST_GRIP_N, weight_n / (2 * body.friction * overload))
        carried, extra = np.zeros(2), weight_n * down
    else:
        force_n = max(LEAST_GRIP_N, grip * weight_n / (2 * body.friction))
        carried = weight_n * down
        aim = np.array([math.cos(angle), math.sin(angle)])
        extra = _up_to(carried, aim, overload * 2 * body.friction * force_n)
    return DrawnLoad(
        kind=kind,
        object_name=name,
        fingers=fingers,
        offset_mm=(
            OFFSET_MM[0] * rng.uniform(-1, 1),
            OFFSET_MM[1] * rng.uniform(-1, 1),
        ),
        force_n=force_n,
        ramp_s=RAMP_S[kind.value].quantile(rng.random()),
        carried_n=carried,
        extra_n=extra,
    )


def _up_to(carried_n: FloatArray, direction: FloatArray, total_n: float) -> FloatArray:
    """The force along a direction that makes the load as large as ``total_n``, or none."""
    along = float(carried_n @ direction)
    root = along**2 - float(carried_n @ carried_n) + total_n**2
    length = -along + math.sqrt(root) if root > 0 else 0.0
    return np.asarray(max(0.0, length) * direction)


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadFrame:
    """A held body at one moment of its load.

    Attributes:
        t_s: Time since the load began to change, negative before [s].
        stick_fraction: Fraction of the normal force that rests on points that stick, 0 to 1.
        slipped_mm: Slide since the load began [mm].
        force_n: True force of either finger [N].
        state: The body.
    """

    t_s: float
    state: HoldState
    stick_fraction: float
    slipped_mm: float
    force_n: float

    def field_of(self, sensor: SensorSpec) -> ShearField:
        """What a sensor on this gel sees, without errors."""
        layer = self.state.fingers.shear.shear_layer
        return shear_field(layer, self.state.shear, self.state.height_mm, sensor)

    @property
    def slides(self) -> bool:
        """Whether all of the contact slides."""
        return self.slipped_mm > 0 and self.stick_fraction <= SLIDING_STICK


class LoadStepper:
    """The body of a drawn load, held at rest under what it carries, then stepped through the load.

    Args:
        drawn: The load.

    Attributes:
        frame: The body now; at time 0 before the load comes on.
        ends_s: Time of the load at which it is over, or the body gone for ``GONE_S`` [s].

    Raises:
        ValueError: The pads don't reach the body.
    """

    def __init__(self, drawn: DrawnLoad) -> None:
        self._drawn = drawn
        self._holding = Holding(drawn.fingers, drawn.force_n, offset_mm=drawn.offset_mm)
        steps = _CARRY_STEPS if drawn.carried_n.any() else 2
        for k in range(steps):
            part = min(1.0, (k + 1) / (_CARRY_STEPS - 3))
            state = self._holding.step(STEP_S, drawn.force_n, part * drawn.carried_n)
        self._before_mm = state.slipped_mm
        self.frame = self._frame(0.0, state, drawn.force_n)
        self.ends_s = drawn.duration_s

    def step(self, dt_s: float, t_s: float, force_n: float) -> LoadFrame:
        """The body a time ``dt_s`` later [s], at ``t_s`` of the load [s], under a force [N]."""
        state = self._holding.step(dt_s, force_n, self._drawn.load_n(t_s))
        if state.dropped and not self.frame.state.dropped:
            self.ends_s = t_s + GONE_S
        self.frame = self._frame(t_s, state, force_n)
        return self.frame

    def _frame(self, t_s: float, state: HoldState, force_n: float) -> LoadFrame:
        return LoadFrame(
            t_s=t_s,
            state=state,
            stick_fraction=state.stick_fraction,
            slipped_mm=state.slipped_mm - self._before_mm,
            force_n=force_n,
        )


def follow(
    drawn: DrawnLoad,
    *,
    quiet: int,
    force_n: Callable[[float], float] | None = None,
) -> Iterator[LoadFrame]:
    """A load step by step, every ``STEP_S``, until it is over or the body is gone for ``GONE_S``.

    Args:
        drawn: The load.
        quiet: Frames at rest before it.
        force_n: True force of either finger by time [N]; None keeps the drawn one.

    Raises:
        ValueError: The pads don't reach the body.
    """
    stepper = LoadStepper(drawn)
    for k in range(quiet):
        yield replace(stepper.frame, t_s=(k - quiet) * STEP_S)
    step = 0
    while step * STEP_S < stepper.ends_s - _ROUNDING_S:
        step += 1
        t_s = step * STEP_S
        yield stepper.step(STEP_S, t_s, drawn.force_n if force_n is None else force_n(t_s))
