"""Drags of held bodies, drawn: fingers rise slowly along a body that its support still holds.

The body neither accelerates nor turns; it moves along the pads at a constant speed, which shears
the gel and then slides, or stops before that. For training what tells a slip.

Not here: loads that friction alone holds (``sim.grasp.drawn.loads``), the contact itself
(``sim.grasp.holding``).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from cltp.tactile.cloud import FloatArray
from cltp.tactile.sensors import sensor_named
from sim.gel.layer import gel_of
from sim.grasp.bodies import Range, draw_body
from sim.grasp.drawn.loads import BODIES, LEAST_GRIP_N, OFFSET_MM, STEP_S, LoadFrame
from sim.grasp.fingers import FlatFingers
from sim.grasp.holding import Holding

SPEED_MM_S = Range(low=3.0, high=20.0, log=True)
"""Speed of a drag [mm/s]. Our choice: fingers that rise slowly."""

FORCE_N = Range(low=LEAST_GRIP_N, high=2.0, log=True)
"""Force of either finger [N]. Our choice: from a berry's to a firm grip."""

TRAVEL_MM = Range(low=0.02, high=2.0, log=True)
"""How far the body is dragged [mm]. Our choice: from a tenth of what a gel gives to a loss."""

RISE_S = Range(low=0.02, high=0.2, log=True)
"""Time in which the speed rises [s]. Our choice."""

AFTER_S = 0.1
"""Time for which a body is followed once it rests again [s]."""

MOST_S = 0.7
"""Longest that a drag is followed [s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DrawnDrag:
    """A held body and its motion over time.

    Attributes:
        fingers: Body, gel and friction.
        offset_mm: The body's origin on the pad at first [mm, gel frame].
        force_n: True force of either finger [N].
        direction: Shape (2,), unit vector of the motion.
        speed_mm_s: Speed of the motion once it has risen [mm/s].
        rise_s: Time in which it rises [s].
        travel_mm: Length of the motion [mm].
    """

    fingers: FlatFingers
    offset_mm: tuple[float, float]
    force_n: float
    direction: FloatArray
    speed_mm_s: float
    rise_s: float
    travel_mm: float

    def moved_mm(self, t_s: float) -> float:
        """How far the body has come at a time [mm]."""
        since_s = max(0.0, t_s)
        risen_s = min(since_s, self.rise_s)
        way_mm = self.speed_mm_s * (risen_s**2 / (2 * self.rise_s) + since_s - risen_s)
        return min(self.travel_mm, way_mm)


def draw_drag(seed: int, sensor_name: str) -> DrawnDrag:
    """Draw body, grip and motion of a seed; the same for every sensor on the same gel.

    Raises:
        TouchError: The sensor is unknown.
        ValueError: No gel is known for the sensor.
    """
    rng = np.random.default_rng([seed, 29])
    body = draw_body(str(rng.choice(BODIES)), rng)
    angle = rng.uniform(0, 2 * math.pi)
    return DrawnDrag(
        fingers=FlatFingers(body, sensor_named(sensor_name), gel_of(sensor_name)),
        offset_mm=(OFFSET_MM[0] * rng.uniform(-1, 1), OFFSET_MM[1] * rng.uniform(-1, 1)),
        force_n=FORCE_N.quantile(rng.random()),
        direction=np.array([math.cos(angle), math.sin(angle)]),
        speed_mm_s=SPEED_MM_S.quantile(rng.random()),
        rise_s=RISE_S.quantile(rng.random()),
        travel_mm=TRAVEL_MM.quantile(rng.random()),
    )


def follow_drag(drawn: DrawnDrag, *, quiet: int) -> Iterator[LoadFrame]:
    """A drag step by step, every ``STEP_S``; it ends a while after the body has come to rest.

    Args:
        drawn: The drag.
        quiet: Frames at rest before it.

    Raises:
        ValueError: The pads don't reach the body.
    """
    holding = Holding(drawn.fingers, drawn.force_n, offset_mm=drawn.offset_mm)
    rest = holding.drag(drawn.force_n, (0.0, 0.0))
    for k in range(-quiet, math.ceil(MOST_S / STEP_S)):
        t_s = (k + 1) * STEP_S
        state = rest
        if k >= 0:
            step_mm = drawn.moved_mm(t_s) - drawn.moved_mm(t_s - STEP_S)
            state = holding.drag(drawn.force_n, step_mm * drawn.direction)
        yield LoadFrame(
            t_s=t_s,
            state=state,
            stick_fraction=state.stick_fraction,
            slipped_mm=state.slipped_mm,
            force_n=drawn.force_n,
        )
        if state.dropped or drawn.moved_mm(t_s - AFTER_S) >= drawn.travel_mm:
            return
