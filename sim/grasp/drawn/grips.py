"""Grips that grow ever firmer on a standing body while the fingers rise: what the pad shows.

For training what tells how much a held contact could still carry. Not here: faster loads
(``sim.grasp.drawn.loads``), errors of a sensor.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from cltp.tactile.sensors import SensorSpec
from cltp.tactile.shear.field import ShearField
from sim.gel.shear.layer import Shear
from sim.gel.shear.sensed import shear_field
from sim.grasp.bodies import Range
from sim.grasp.drawn.loads import BODIES
from sim.grasp.fingers import FlatFingers, Patch
from sim.grasp.pad_shear import coarse
from sim.grasp.rig import build
from sim.grasp.world import Grasp

OVERLOAD = Range(low=0.4, high=2.7, log=True)
"""Weight over what the first grip's friction holds: the range of friction, and more."""

LEAST_GRIP_N = 0.05
"""Least true force of a grip [N]. Our choice: a third of what a berry's band begins with."""

OFFSET_MM = (4.0, 3.0)
"""Largest offsets of the body on the pad along x and y [mm]: where a strawberry's contract ends."""

SPEED_M_S = Range(low=0.001, high=0.006, log=True)
"""Speed of the rise [m/s]."""

STEP = (1.05, 1.2)
"""Factor from one grip to the next."""

MOST_GRIPS, MOST_RESERVE = 30, 3.5
"""Most grips of a body, and the friction over its load from which no further one is drawn."""

FRAME_S, FRAMES = 0.01, 12
"""Period of the frames [s], and how many of each grip are kept, the last ones."""

RISES_AGAIN = 0.3
"""Fraction of the grips of a hanging body under which the fingers go on rising."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DrawnGrip:
    """A body under one of the grips.

    Attributes:
        reserve: Friction over the load of its whole weight; below 1 it still stands.
        hangs: Whether it has left its support.
        force_n: True force of either finger [N].
    """

    reserve: float
    hangs: bool
    force_n: float
    _fingers: FlatFingers
    _states: tuple[tuple[Shear, Patch], ...]

    def fields(self, sensor: SensorSpec, seconds: float) -> list[ShearField]:
        """The frames of its last ``seconds`` that a sensor on this gel sees, without errors."""
        every = max(1, round(1.0 / (sensor.frame_hz * FRAME_S)))
        count = max(1, round(seconds * sensor.frame_hz))
        states = self._states[::-1][::every][:count]
        layer = self._fingers.shear.shear_layer
        return [
            shear_field(layer, shear, coarse(self._fingers, patch.height_mm), sensor)
            for shear, patch in states[::-1]
        ]


def drawn_grips(seed: int) -> Iterator[DrawnGrip]:
    """The grips of one body, lightest first; it is let go of where the pads leave it."""
    rng = np.random.default_rng([seed, 77])
    offset_mm = (OFFSET_MM[0] * rng.uniform(-1, 1), OFFSET_MM[1] * rng.uniform(-1, 1))
    rig = build(
        str(rng.choice(BODIES)),
        seed,
        sensor_name="taxels",
        start_offset_mm=offset_mm,
        gripper_force_gain=1.0,
    )
    grasp, overload = rig.grasp, OVERLOAD.quantile(rng.random())
    least_n = grasp.fingers.slip_minimum_n([(0.0, 0.0)])
    grasp.close(max(LEAST_GRIP_N, least_n / overload))
    grasp.beat = frames = _Frames(grasp)
    speed_m_s = SPEED_M_S.quantile(rng.random())
    for _ in range(MOST_GRIPS):
        frames.kept.clear()
        seconds = (FRAMES + 1) * FRAME_S
        if not grasp.hangs or rng.random() < RISES_AGAIN:
            grasp.move((0.0, 1000 * speed_m_s * seconds), speed_m_s, 2.5)
        else:
            grasp.wait(seconds)
        patch = grasp.patch
        if patch is None or len(frames.kept) < FRAMES:
            return
        reserve = grasp.fingers.resistance(patch, (0.0, 0.0)).margin
        yield DrawnGrip(
            reserve=reserve,
            hangs=grasp.hangs,
            force_n=patch.force_n,
            _fingers=grasp.fingers,
            _states=tuple(frames.kept[-FRAMES:]),
        )
        if reserve > MOST_RESERVE:
            return
        grasp.adjust(patch.force_n * rng.uniform(*STEP))


class _Frames:
    """Keeps what the pad shows, every ``FRAME_S``; a ``sim.grasp.world.Beat``."""

    def __init__(self, grasp: Grasp) -> None:
        self._grasp = grasp
        self.kept: list[tuple[Shear, Patch]] = []

    def until_next_s(self) -> float:
        return FRAME_S

    def passed(self, seconds: float) -> None:
        del seconds
        pad, patch = self._grasp.shear, self._grasp.patch
        if pad is not None and pad.shear is not None and patch is not None:
            self.kept.append((pad.shear, patch))
