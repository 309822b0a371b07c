"""A hold at rest and an unload, frame by frame, for the slip calibration of a sensor.

Not here: what is made of the frames (``cltp.tactile.shear.slip_calibration``).
"""

from __future__ import annotations

from cltp.errors import TouchError
from cltp.tactile.shear.field import ShearField
from tacgrasp.drivers.opening import check_open
from tacgrasp.rig.gel_sense import GelSense
from tacgrasp.rig.protocols import Rig, ShearSensor
from tacgrasp.rig.release import CLEAR_M, let_go, opened_afterwards

UNLOAD_STEPS, LEAST_FACTOR = 10, 0.4
"""Steps of the unload, and the force at its end over that of the hold. Our choice: a contact that
nothing pulls at does not slide under either."""


def held_frames(
    rig: Rig, force_n: float, hold_s: float
) -> tuple[list[ShearField], list[ShearField]]:
    """Grip, hold at rest, then let the force fall step by step, and let go: on every way out.

    Args:
        rig: Devices, open, with an object between the fingers that stands by itself.
        force_n: Commanded force of the hold [N].
        hold_s: Duration of the hold [s].

    Returns:
        Frames of the hold, and of the unload.

    Raises:
        TouchError: The sensor measures no shear, can't be read, or nothing is held.
        RobotError: The gripper is not open, or failed; the message says if it may still hold.
    """
    check_open(rig.gripper)
    sense = GelSense(rig.sensor)
    sense.take_reference()
    with opened_afterwards(lambda: let_go(rig.gripper, CLEAR_M)):
        first_n = min(force_n, rig.first_force_n)
        rig.gripper.grip(first_n)
        if not sense.read_contact():
            more = "--force-n" if first_n == force_n else "gripper.first_force_n"
            raise TouchError(
                f"nothing is felt at {first_n:g} N: put a firm object between the fingers, or give "
                f"more {more}"
            )
        if first_n < force_n:  # no more than the rig's first force until something is felt
            rig.gripper.grip(force_n)
        hold = [_frame(rig) for _ in range(round(hold_s * rig.sensor.spec.frame_hz))]
        unload = []
        for step in range(1, UNLOAD_STEPS + 1):
            rig.gripper.grip(force_n * (1 - (1 - LEAST_FACTOR) * step / UNLOAD_STEPS))
            unload += [_frame(rig) for _ in range(2)]
        return hold, unload


def _frame(rig: Rig) -> ShearField:
    rig.sensor.read(1)
    field = rig.sensor.last_shear() if isinstance(rig.sensor, ShearSensor) else None
    if field is None:
        raise TouchError(
            f"{rig.sensor.spec.name} measures no shear here: only taxels that send displacements "
            "and marker gels have slips to calibrate"
        )
    return field
