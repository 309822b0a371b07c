"""What a policy is given in a step: one cloud, its shear, and what the gripper knows."""

from __future__ import annotations

from dataclasses import dataclass

from cltp.tactile.cloud import TactileCloud
from cltp.tactile.force_scale import POSSIBLE_RATIO
from cltp.tactile.shear.field import ShearField
from primitives.sense import Interval


def is_impossible(felt_n: float, commanded_n: float | None) -> bool:
    """Whether a felt force [N] is one that no gripper makes of a command [N].

    False where no command is known, and with open fingers.
    """
    return commanded_n is not None and felt_n > POSSIBLE_RATIO * commanded_n > 0


@dataclass(frozen=True, slots=True, kw_only=True)
class Observation:
    """Readings at the start of a step.

    Attributes:
        cloud: Tactile cloud [mm, gel frame].
        in_contact: Whether something touches the gel, by test against the open fingers of the same
            closing; None where no such test was possible (a file, an old episode).
        width_m: Opening of the gripper [m]; None where it is not known.
        commanded_force_n: Force last commanded [N], 0 when open; None where it is not known.
        felt_force_n: Force that the contact suggests [N]; None without contact or reading, and
            where no gripper makes it of the command.
        shear: Displacements along the gel, of the same frame; None where the sensor gives none.
        t_s: Time since the episode began [s].
    """

    cloud: TactileCloud
    in_contact: bool | None = None
    width_m: float | None = None
    commanded_force_n: float | None = None
    felt_force_n: Interval | None = None
    shear: ShearField | None = None
    t_s: float = 0.0
