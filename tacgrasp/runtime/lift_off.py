"""Lift off slowly, so that the reflex finds the force that just holds the object.

The fingers rise a few millimetres from where the object stands. Pads that hold too lightly slide
along it, which drops nothing; the reflex raises the force until they carry it. What then just
holds the weight tells what the faster motions after it need, whatever mass and friction are.

Source: people raise grip and load force together while they lift, and adjust the ratio of the two
to the friction within the first contact (Johansson and Westling 1984, as in ``policies.reflex``).
Distances and margins are our choice.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cltp.tactile.shear.held_indentation import MEAN_FRAMES
from primitives.contract import Contract
from primitives.devices import Pose
from tacgrasp.config.schema import VerifyConfig
from tacgrasp.rig.protocols import Rig
from tacgrasp.runtime.reflex_hold import QUIET_FRAMES, ReflexHold
from tacgrasp.runtime.steps import Readings, Steps

GRAVITY_M_S2 = 9.81

RISES = 10
"""Most rises of ``verify.lift_off_mm`` until the object hangs still, never higher than the lift.
Our choice: by ``HELD_TIGHTER`` alone a grip grows fourfold."""

LEFT_BEHIND = 0.5
"""Part of a rise by which the indentation may move along the pad if the object hangs. One that
stands stays behind by all of it."""

HELD_TIGHTER = 1.15
"""Factor on the force after a rise in which it was left behind and no slip was told."""

STILL_S, STILL_FRAMES = 0.2, 6
"""Least time without a slip, and fewest frames of it, after which an object hangs still. Our
choice: two means of the reflex."""

MARGIN = 1.1
"""Factor on the force that the next motion needs. Our choice: half the error of the reserve."""

CLEAR_MM = 5.0
"""Least height above the support at which it is rocked, never above the lift [mm]. Our choice: more
than slides away in a rock, since an object that stands again shows nothing."""

ROCKS = ((0.45, 0.05), (0.65, 0.07), (0.82, 0.09), (1.0, 0.11), (1.0, 1.0))
"""Parts of the shake's acceleration and of its way by which a hanging object is rocked in turn.
What hangs beside the middle of the grip turns in it, which no rest shows. Our choice: what slides
falls by the square of the time, so that all but the last take 0.03 s each way."""

PREPARED = 0.65
"""Part of the shake's acceleration that the force is raised for before the first rock, as the
reserve tells it. Our choice: less than the last rock needs; what holds little more than its weight
slides on for centimetres once it slides."""

ROCKED_TIMES = 3
"""Most rocks of one size. Our choice: a larger one shows whether the force is enough."""

ROCKED, SLID_PER_MM, MOST_ROCKED = 1.05, 0.2, 1.3
"""Factor on the force after a rock in which the object slipped, what is added to it for each
millimetre that it slid, and the largest factor. Our choice: what lacks much slides far, and a slide
of 4 mm brings it to the pad's edge."""

MOST_RISE_MM = 2.0
"""Most that the fingers rise after a rock, never above the lift [mm]. Our choice: twice what slides
in a short one."""

LEAST_SLID_MM, LEAST_SPREADS = 0.2, 1.5
"""Way of the indentation in a rock from which it has slid [mm], and the same in standard deviations
of what noise makes of it; half of both where a frame looked like a slip. Our choice: one rock in
ten of a noisy unit then counts without a slip."""

SPARE = 1.08
"""Factor on what holds through the last rock. Our choice: half a step."""

SETTLE_S = 0.1
"""Time that the gripper is given for a change [s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LiftOff:
    """What a lift-off has found.

    Attributes:
        problem: Why the object can't be lifted; '' if it hangs, or nothing was moved.
        floor_n: Command that the motions after it need [N]; 0 where nothing was found.
    """

    problem: str = ""
    floor_n: float = 0.0


def lift_off(
    rig: Rig,
    steps: Steps,
    settings: VerifyConfig,
    contract: Contract,
    before: Readings,
    side_m: NDArray[np.float64],
) -> LiftOff:
    """Rise until the object hangs still, then rock it ever harder, up to the shake.

    Without a reflex nothing moves.

    Args:
        rig: The devices.
        steps: Steps of the episode.
        settings: Distances, speeds and accelerations.
        contract: The contract that is kept.
        before: Readings before it.
        side_m: Way of the shake, base frame [m].

    Raises:
        TouchError: The reflex had no reading for too long.
        RobotError: Arm or gripper failed.
    """
    start = rig.arm.pose()
    still_s = max(STILL_S, STILL_FRAMES / rig.sensor.spec.frame_hz)
    num_rises = min(RISES, math.floor(settings.lift_mm / settings.lift_off_mm))
    with steps.keeping(contract, before, standing=True) as hold:
        if hold is None:
            return LiftOff()
        rig.clock.sleep(still_s)
        for rise in range(1, num_rises + 1):
            before_mm = hold.place_mm
            up_m = np.array([0.0, 0.0, rise * settings.lift_off_mm / 1000])
            steps.may_hang = True
            _go(rig, shifted(start, up_m), settings.lift_off_speed_m_s, settings.acceleration_m_s2)
            rig.clock.sleep(still_s)
            if hold.still_s < still_s:
                continue
            if _moved_mm(before_mm, hold.place_mm) <= LEFT_BEHIND * settings.lift_off_mm:
                break
            _raise(rig, hold, HELD_TIGHTER)
            rig.clock.sleep(still_s)
        else:
            height_mm = num_rises * settings.lift_off_mm
            return LiftOff(problem=f"it still slips {height_mm:g} mm above where it stood")
        is_shaken = settings.shakes > 0 and settings.shake_mm > 0
        side_m_s2 = PREPARED * settings.shake_acceleration_m_s2 if is_shaken else 0.0
        load_m_s2 = max(
            math.hypot(GRAVITY_M_S2, side_m_s2), GRAVITY_M_S2 + settings.acceleration_m_s2
        )
        _raise(rig, hold, max(1.0, MARGIN * load_m_s2 / GRAVITY_M_S2 / _reserve(hold)))
        clear_mm = min(max(CLEAR_MM, rise * settings.lift_off_mm), settings.lift_mm)
        clear = shifted(start, np.array([0.0, 0.0, clear_mm / 1000]))
        _go(rig, clear, settings.lift_off_speed_m_s, settings.acceleration_m_s2)
        _hang(rig, hold)
        rig.clock.sleep(still_s)
        top_m = float(start.position_m[2]) + settings.lift_mm / 1000
        for part, way in ROCKS if is_shaken else ():
            if not _rock(rig, hold, settings, part, way * side_m, top_m):
                return LiftOff(problem="it slides on at the largest force that its limit allows")
        _raise(rig, hold, SPARE)
        return LiftOff(floor_n=hold.memory.floor_n)


def _moved_mm(before_mm: tuple[float, float] | None, after_mm: tuple[float, float] | None) -> float:
    """Way of the indentation along the pad [mm]; 0 where it is not known."""
    if before_mm is None or after_mm is None:
        return 0.0
    return math.dist(before_mm, after_mm)


def _reserve(hold: ReflexHold) -> float:
    """What a hanging object could carry over its weight, 1 at least."""
    return 1.0 if hold.reserve is None else max(1.0, math.exp(hold.reserve.middle))


def _rock(
    rig: Rig,
    hold: ReflexHold,
    settings: VerifyConfig,
    part: float,
    side_m: NDArray[np.float64],
    top_m: float,
) -> bool:
    """Rock with a part of the shake's acceleration, there and back, until nothing slips in it.

    Where the object does, the reflex raises the force; after the rock more is added for the way
    that it slid, and the fingers rise by as much, at most to ``top_m`` in the base frame: on its
    support it would show nothing more.

    Returns:
        Whether to go on: it slips no more, or the force has grown.
    """
    here, began_n = rig.arm.pose(), rig.gripper.state().force_n
    acceleration_m_s2 = part * settings.shake_acceleration_m_s2
    for _ in range(ROCKED_TIMES):
        began_s, began_mm = hold.seen_s, hold.indented_mm
        hold.is_rocked = True
        for pose in (shifted(here, side_m), here):
            _go(rig, pose, settings.speed_m_s, acceleration_m_s2)
        hold.rest()
        rig.clock.sleep(max(STILL_S, (MEAN_FRAMES + 1) / rig.sensor.spec.frame_hz))
        hold.is_rocked = False
        slid_mm = _moved_mm(began_mm, hold.indented_mm)
        least_mm = max(LEAST_SLID_MM, LEAST_SPREADS * hold.spread_mm)
        if hold.called_s > began_s:
            least_mm /= 2
        if hold.slipped_s <= began_s and slid_mm < least_mm:
            return True
        _raise(rig, hold, min(MOST_ROCKED, ROCKED + SLID_PER_MM * slid_mm))
        rise_m = max(0.0, min(slid_mm / 1000, MOST_RISE_MM / 1000, top_m - here.position_m[2]))
        here = shifted(here, np.array([0.0, 0.0, rise_m]))
        _go(rig, here, settings.lift_off_speed_m_s, settings.acceleration_m_s2)
        _hang(rig, hold)  # elsewhere on the pad
    return rig.gripper.state().force_n > began_n


def _hang(rig: Rig, hold: ReflexHold) -> None:
    """Wait until the place of what hangs at rest is known."""
    hold.hang()
    rig.clock.sleep((QUIET_FRAMES + 1) / rig.sensor.spec.frame_hz)


def _go(rig: Rig, pose: Pose, speed_m_s: float, acceleration_m_s2: float) -> None:
    rig.arm.move_to(pose, speed_m_s=speed_m_s, acceleration_m_s2=acceleration_m_s2)


def _raise(rig: Rig, hold: ReflexHold, factor: float) -> None:
    """Let the reflex multiply the force, once."""
    hold.ahead_n = factor * rig.gripper.state().force_n
    rig.clock.sleep(SETTLE_S)


def shifted(pose: Pose, offset_m: NDArray[np.float64]) -> Pose:
    """A pose moved along the axes of its frame [m]."""
    return Pose(position_m=pose.position_m + offset_m, rotvec_rad=pose.rotvec_rad)
