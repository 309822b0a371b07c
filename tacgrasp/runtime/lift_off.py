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

from primitives.contract import Contract
from primitives.devices import Pose
from primitives.sense import Interval
from tacgrasp.config.schema import VerifyConfig
from tacgrasp.rig.protocols import Rig
from tacgrasp.runtime.reflex_hold import ReflexHold
from tacgrasp.runtime.steps import Steps

GRAVITY_M_S2 = 9.81

RISES = 3
"""Most rises of ``verify.lift_off_mm`` until the object hangs still. Our choice: in a second a grip
grows fivefold."""

STILL_S, STILL_FRAMES = 0.2, 6
"""Least time without a slip, and fewest frames of it, after which an object hangs still. Our
choice: two means of the reflex."""

MARGIN = 1.15
"""Factor on the force that the motions ahead need. Our choice: the error of the reserve."""

SETTLE_S = 0.1
"""Time that the gripper is given for the change [s]."""


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
    felt: Interval | None,
    load_m_s2: float,
) -> LiftOff:
    """Rise until the object hangs still, then ask for the force that the next motions need.

    Without a reflex nothing moves.

    Args:
        rig: The devices.
        steps: Steps of the episode.
        settings: Distance and speed.
        contract: The contract that is kept.
        felt: Force that is felt before; None where that is not known.
        load_m_s2: Largest acceleration that the object is held against afterwards, weight included.

    Raises:
        TouchError: The reflex had no reading for too long.
        RobotError: Arm or gripper failed.
    """
    start = rig.arm.pose()
    still_s = max(STILL_S, STILL_FRAMES / rig.sensor.spec.frame_hz)
    with steps.keeping(contract, felt, standing=True) as hold:
        if hold is None:
            return LiftOff()
        for rise in range(1, RISES + 1):
            _rise(rig, start, rise * settings.lift_off_mm, settings)
            rig.clock.sleep(still_s)
            if hold.still_s >= still_s:
                break
        else:
            height_mm = RISES * settings.lift_off_mm
            return LiftOff(problem=f"it still slips {height_mm:g} mm above where it stood")
        reserve = 0.0 if hold.reserve is None else max(0.0, hold.reserve.middle)
        _prepare(rig, hold, MARGIN * load_m_s2 / GRAVITY_M_S2 / math.exp(reserve))
        return LiftOff(floor_n=hold.memory.floor_n)


def _rise(rig: Rig, start: Pose, height_mm: float, settings: VerifyConfig) -> None:
    position_m = start.position_m.copy()
    position_m[2] += height_mm / 1000
    rig.arm.move_to(
        Pose(position_m=position_m, rotvec_rad=start.rotvec_rad),
        speed_m_s=settings.lift_off_speed_m_s,
        acceleration_m_s2=settings.acceleration_m_s2,
    )


def _prepare(rig: Rig, hold: ReflexHold, factor: float) -> None:
    """Let the reflex multiply the force, once."""
    hold.standing = False
    hold.ahead_n = max(1.0, factor) * rig.gripper.state().force_n
    rig.clock.sleep(SETTLE_S)


def largest_load_m_s2(accelerations_m_s2: list[tuple[float, float]]) -> float:
    """The largest of some accelerations, (sideways, upwards), with the weight [m/s²]."""
    return max(math.hypot(side, GRAVITY_M_S2 + up) for side, up in accelerations_m_s2)
