"""The truth of a grasp over time: the body is held, slides, falls or is bruised.

Rigid-body dynamics of one body against the friction of two patches (``sim.grasp.fingers``). This is
no physics engine: the body touches nothing but its support. In-plane rotation counts as slip, but
the body's surface is not turned with it.

Fingers that rise take the weight off the support as the gel gives way. Where friction can't carry
all of it, the body stays where it stands and the pads slide along it. A body that slides down out
of a grip in the air comes to rest once it is back on its support.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from sim.grasp.fingers import FlatFingers, Patch, Resistance
from sim.grasp.pad_shear import PadShear

SLIPPED_MM = 1.0
DROPPED_MM = 12.0
SPUN_MM = 30.0
"""Slip from which sliding is not simulated any further: a body that turned so far hangs."""

RISE_MM = 0.1
"""Longest part of a rise from the support that is made in one [mm]: half of what the gel gives way
under a strawberry."""

_FOLLOW_MM = 0.05  # slide after which the contact is solved anew
_ROUNDING_MM = 1e-9  # a body no higher stands: heights are sums of many steps
_SAME_PRESSURE = 1.02  # a grip shifted on the grid changes the pressure by less than 2 %


def trapezoid_s(
    distance_m: float, speed_m_s: float, acceleration_m_s2: float
) -> tuple[float, float]:
    """Duration of each ramp and of the cruise between them on a straight path [s]."""
    speed = min(speed_m_s, math.sqrt(distance_m * acceleration_m_s2))
    return speed / acceleration_m_s2, distance_m / speed - speed / acceleration_m_s2


class Beat(Protocol):
    """What is to happen in the middle of a motion or wait, at a rate of its own."""

    def until_next_s(self) -> float:
        """Time until it is due [s], above 0."""

    def passed(self, seconds: float) -> None:
        """Time has passed in the world; may change the grip by ``Grasp.adjust``."""


@dataclass(slots=True)
class Grasp:
    """The evolving truth of one body and one pair of fingers.

    Attributes:
        fingers: Contact and friction.
        body_xy_mm: Position of the body's origin, in the world's pad axes [mm].
        pad_xy_mm: Position of the pad's centre [mm].
        patch: Patch of the held body, None while the fingers are open or hold nothing.
        slip_mm: Distance that the body has slid along the pads, turning included [mm]. The pads'
            way along a body that still stands counts until it leaves its support.
        slid_mm: The same in the air alone, without turning [mm].
        grips: Number of times that the fingers closed or changed their force.
        contacts: Number of commands that changed the contact with the gel.
        peak_force_n, peak_kpa: Largest true force and pressure so far.
        shear: Shear of the camera's pad; None follows none, which costs nothing.
        beat: Divides every load into parts, and is told of each; None for none.
    """

    fingers: FlatFingers
    body_xy_mm: tuple[float, float]
    pad_xy_mm: tuple[float, float] = (0.0, 0.0)
    patch: Patch | None = None
    slip_mm: float = 0.0
    slid_mm: float = 0.0
    dropped: bool = False
    bruised_at_start: bool = False
    bruised: bool = False
    grips: int = 0
    contacts: int = 0
    peak_force_n: float = 0.0
    peak_kpa: float = 0.0
    shear: PadShear | None = None
    beat: Beat | None = None
    _speed: float = field(default=0.0, repr=False)
    _lifted_mm: float = field(default=0.0, repr=False)
    _stood_mm: float = field(default=0.0, repr=False)  # of ``slip_mm``, while it stood
    _share: float = field(default=0.0, repr=False)  # of the weight that the pads carry, 0 to 1

    @property
    def offset_mm(self) -> tuple[float, float]:
        """The body's origin on the pad [mm, gel frame]."""
        return (
            self.body_xy_mm[0] - self.pad_xy_mm[0],
            self.body_xy_mm[1] - self.pad_xy_mm[1],
        )

    @property
    def hangs(self) -> bool:
        """Whether the body has left its support in the fingers."""
        return self.patch is not None and bool(self._lifted_mm > 0)

    def close(self, force_n: float) -> None:
        """Close with, or adjust a grip to, a true force [N].

        A bruise is counted when the pressure exceeds both the limit and the body's peak so far
        (flesh yields no further under less): for the first grip as ``bruised_at_start``, for a
        later one as ``bruised``.
        """
        self.adjust(force_n)
        if self.hangs:
            self.load((0.0, 0.0), 0.05)

    def adjust(self, force_n: float) -> None:
        """As ``close``, for a grip that changes within a motion: no time passes.

        Args:
            force_n: True force [N].
        """
        self.grips += 1
        self.contacts += 1
        if self.dropped or not self.fingers.reaches(self.offset_mm):
            self._let_go()
            return
        self.patch = self.fingers.press(self.offset_mm, force_n)
        if self.shear is not None:
            self.shear.press(self.patch)
        self.peak_force_n = max(self.peak_force_n, force_n)
        if self._bruises(self.patch):
            if self.grips == 1:
                self.bruised_at_start = True
            else:
                self.bruised = True

    def _bruises(self, patch: Patch) -> bool:
        """Note the pressure of a new patch; whether it is beyond the limit and any before."""
        before = self.peak_kpa * _SAME_PRESSURE
        self.peak_kpa = max(self.peak_kpa, patch.peak_kpa)
        return patch.peak_kpa > max(before, self.fingers.bruise_kpa)

    def open(self) -> None:
        """Open the fingers; a lifted body falls, without harm from up to 1 mm above its support."""
        if self.patch is not None:
            self.dropped = self.dropped or self._lifted_mm > 1.0
            (x_mm, y_mm), (up_x, up_y) = self.body_xy_mm, self.fingers.up
            self.body_xy_mm = (x_mm - self._lifted_mm * up_x, y_mm - self._lifted_mm * up_y)
        self._lifted_mm = 0.0
        self._let_go()
        self.contacts += 1
        self._speed = 0.0

    def _let_go(self) -> None:
        self.patch, self._share = None, 0.0
        if self.shear is not None:
            self.shear.clear()

    def move(self, by_mm: tuple[float, float], speed_m_s: float, acceleration_m_s2: float) -> float:
        """Move the fingers on a straight line with a trapezoidal speed; returns its duration [s].

        A held body moves with them, and slides while the load exceeds the friction of both patches.
        Until it is lifted, its support carries its weight.
        """
        distance = math.hypot(*by_mm) / 1000
        if distance == 0:
            return 0.0
        ux, uy = by_mm[0] / 1000 / distance, by_mm[1] / 1000 / distance
        ramp, cruise = trapezoid_s(distance, speed_m_s, acceleration_m_s2)
        push = (ux * acceleration_m_s2, uy * acceleration_m_s2)
        if self.patch is not None and self._lifted_mm == 0 and self._rise_mm(by_mm) > 0:
            self._rise(by_mm, push, (ramp, cruise))
            return 2 * ramp + cruise
        self.displace(by_mm)
        if self.hangs:
            self.load(push, ramp)
            self.load((0.0, 0.0), cruise)
            self.load((-push[0], -push[1]), ramp)
        return 2 * ramp + cruise

    def _rise_mm(self, by_mm: tuple[float, float]) -> float:
        """How far up a motion of the pad goes [mm]."""
        return by_mm[0] * self.fingers.up[0] + by_mm[1] * self.fingers.up[1]

    def _rise(
        self, by_mm: tuple[float, float], push: tuple[float, float], times_s: tuple[float, float]
    ) -> None:
        """Rise with a body that stands on its support.

        Args:
            by_mm: Motion of the fingers [mm].
            push: Their acceleration in the first ramp [m/s²], the opposite of that in the last.
            times_s: Duration of each ramp, and of the motion between the two [s].
        """
        length_mm, (ramp, cruise) = math.hypot(*by_mm), times_s
        most_mm_s, made, speed = length_mm / (ramp + cruise), 0.0, 0.0
        try:
            for sign, seconds in ((1.0, ramp), (0.0, cruise), (-1.0, ramp)):
                gain = sign * most_mm_s / ramp
                for part_s in self._parts(seconds):
                    part = max(0.0, speed * part_s + gain * part_s**2 / 2) / length_mm
                    made, speed = made + part, speed + gain * part_s
                    self._rise_by((part * by_mm[0], part * by_mm[1]))
                    if self.hangs:
                        self._load((sign * push[0], sign * push[1]), part_s)
        finally:  # nothing, or what a motion that was cut short is taken back from
            self.displace(((1 - made) * by_mm[0], (1 - made) * by_mm[1]))

    def _rise_by(self, by_mm: tuple[float, float]) -> None:
        """A part of a rise: off the support, in the air, or along a body that stays."""
        count = max(1, math.ceil(math.hypot(*by_mm) / RISE_MM))
        step = (by_mm[0] / count, by_mm[1] / count)
        for _ in range(count):
            if self.patch is None or self._lifted_mm > 0:
                self.displace(step)
                continue
            give_mm = self.fingers.give_mm(self.patch)
            share = min(1.0, self._share + self._rise_mm(step) / give_mm)
            resistance = self.fingers.resistance(self.patch, (0.0, 0.0), share)
            if resistance.margin < 1:
                self._slide_along(self.patch, step)
            else:
                self._share = share
                if self.shear is not None:
                    load_n = self.fingers.load_on(self.patch, (0.0, 0.0), share)
                    self.shear.carry(self.patch, load_n)
                self._displace(step)
                if share == 1:
                    self._lifted_mm = self._rise_mm(step)
                    self.slip_mm, self._stood_mm = self.slip_mm - self._stood_mm, 0.0

    def _slide_along(self, patch: Patch, by_mm: tuple[float, float]) -> None:
        """Move the pads along a body that stands on its support."""
        self.pad_xy_mm = (self.pad_xy_mm[0] + by_mm[0], self.pad_xy_mm[1] + by_mm[1])
        self.slip_mm += math.hypot(*by_mm)
        self._stood_mm += math.hypot(*by_mm)
        if self.shear is not None:
            self.shear.slide(patch, np.array([-by_mm[0], -by_mm[1], 0.0]))
        self._follow(patch)

    def _follow(self, patch: Patch) -> None:
        """Press anew where the body has slid to; let go of one that is beside the pads."""
        if not self.fingers.reaches(self.offset_mm):
            self._let_go()
        elif math.dist(patch.offset_mm, self.offset_mm) > _FOLLOW_MM:
            self.patch = self.fingers.press(self.offset_mm, patch.force_n)
            self.bruised |= self._bruises(self.patch)

    def displace(self, by_mm: tuple[float, float]) -> None:
        """Put the fingers, and a held body with them, elsewhere; no time passes."""
        self._displace(by_mm)
        if self.patch is not None:
            lifted_mm = self._lifted_mm + self._rise_mm(by_mm)
            self._lifted_mm = lifted_mm if lifted_mm > _ROUNDING_MM else 0.0

    def _displace(self, by_mm: tuple[float, float]) -> None:
        """As ``displace``, of a body that its support still carries."""
        self.pad_xy_mm = (self.pad_xy_mm[0] + by_mm[0], self.pad_xy_mm[1] + by_mm[1])
        if self.patch is not None:
            self.body_xy_mm = (self.body_xy_mm[0] + by_mm[0], self.body_xy_mm[1] + by_mm[1])

    def wait(self, seconds: float) -> None:
        """Let time pass; a lifted body that friction can't hold slides."""
        if self.hangs:
            self.load((0.0, 0.0), seconds)
        else:
            for _ in self._parts(seconds):
                pass

    def load(self, acceleration_m_s2: tuple[float, float], seconds: float) -> None:
        """Slide under a constant load for a while; the patch follows in steps of 0.5 mm."""
        for part_s in self._parts(seconds):
            self._load(acceleration_m_s2, part_s)

    def _parts(self, seconds: float) -> Iterator[float]:
        """The parts that the beat makes of a time [s]; it is told of each once that has passed."""
        if self.beat is None:
            yield seconds
            return
        left_s = seconds
        while left_s > 1e-9:
            part_s = min(left_s, self.beat.until_next_s())
            yield part_s
            left_s -= part_s
            self.beat.passed(part_s)

    def _load(self, acceleration_m_s2: tuple[float, float], seconds: float) -> None:
        remaining_s = seconds
        while (
            remaining_s > 1e-9
            and self.patch is not None
            and self._lifted_mm > 0
            and self.slip_mm < SPUN_MM
        ):
            resistance = self.fingers.resistance(self.patch, acceleration_m_s2)
            if resistance.margin >= 1 and self._speed <= 0:
                if self.shear is not None:
                    self.shear.carry(
                        self.patch, self.fingers.load_on(self.patch, acceleration_m_s2)
                    )
                return
            gain = resistance.excess_n / self.fingers.inertia_kg(resistance.motion)
            step = min(remaining_s, self._time_to_slide(gain, 0.5e-3 / resistance.patch_speed))
            slide_mm = 1000 * max(0.0, self._speed * step + gain * step**2 / 2)
            self._speed = max(0.0, self._speed + gain * step)
            self._slide(resistance, slide_mm)
            remaining_s -= step

    def _time_to_slide(self, gain: float, distance_m: float) -> float:
        """Time until a slide covers a distance or, with a negative ``gain`` [m/s²], stops [s]."""
        if gain < 0:
            stop = self._speed / -gain
            if self._speed * stop / 2 <= distance_m:
                return max(stop, 1e-6)
        root = math.sqrt(max(0.0, self._speed**2 + 2 * gain * distance_m))
        return max(1e-6, 2 * distance_m / (self._speed + root)) if self._speed + root > 0 else 1e-3

    def _slide(self, resistance: Resistance, slide_mm: float) -> None:
        self.slip_mm += slide_mm * resistance.patch_speed
        x, y = resistance.motion[0] * slide_mm, resistance.motion[1] * slide_mm
        self.body_xy_mm = (self.body_xy_mm[0] + x, self.body_xy_mm[1] + y)
        if self.shear is not None and self.patch is not None:
            self.shear.slide(self.patch, resistance.motion * slide_mm)
        self.slid_mm += math.hypot(x, y)
        is_lost = self.slid_mm > DROPPED_MM or not self.fingers.reaches(self.offset_mm)
        if is_lost or self.patch is None:
            self.dropped = True
            self._let_go()
            return
        self._lifted_mm = max(0.0, self._lifted_mm + self._rise_mm((x, y)))
        if self._lifted_mm == 0:
            self._speed, self._share = 0.0, min(1.0, resistance.margin)
        self._follow(self.patch)

    @property
    def slipped(self) -> bool:
        """Whether the body has slid by a millimetre or more, by displacement or by rotation."""
        return self.slip_mm >= SLIPPED_MM
