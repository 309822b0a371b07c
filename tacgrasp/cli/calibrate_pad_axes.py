"""``tacgrasp calibrate pad-axes``: how the pad sits on the tool centre point of a rig."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse

if TYPE_CHECKING:
    from primitives import execution


@dataclass(frozen=True)
class CalibratePadAxesFlags:
    """Find the axes of the pad in the frame of the tool centre point (TCP), for a rig's file.

    With a rig: from where it stands, the hand goes 2 mm to both sides along every axis of the TCP
    and closes on an object that stays where it is, at the middle of the pad. Without one: answer,
    or give, which axes of the TCP point to the pad's right and to the palm.

    Attributes:
        rig: Name of a rig, or the path of its YAML file; its devices move.
        force_n: Of every grip [N]; the rig's first force when not given.
        clear_mm: How far the gripper opens between grips [mm].
        object: What the simulated or emulated world has between the fingers.
        seed: Of that world.
        right: Axis of the TCP towards the pad's right, like +x.
        palm: Axis of the TCP towards the palm; --palm=-z for one that begins with a minus.
    """

    rig: str | None = None
    force_n: float | None = None
    clear_mm: float = 4.0
    object: str = "cherry_tomato"
    seed: int = 0
    right: str = ""
    palm: str = ""


def main(argv: Sequence[str]) -> None:
    """Axes of the pad: from small moves with a contact, or from what you see."""
    flags = parse(CalibratePadAxesFlags, argv, prog="tacgrasp calibrate pad-axes")
    if flags.rig is not None and (flags.right or flags.palm):
        raise UsageError("give --rig to measure, or --right and --palm, not both")
    from tacgrasp.bringup.pad_axes import as_yaml
    from tacgrasp.console import make_console

    out = make_console()
    axes = _named(flags) if flags.rig is None else _measured(flags, flags.rig)
    out.print("for the rig's file:")
    for line in as_yaml(axes):
        out.print(line)


def _named(flags: CalibratePadAxesFlags) -> execution.PadAxes:
    from tacgrasp.bringup.pad_axes import axes_named

    right = flags.right or _asked("Which axis of the TCP points to the pad's right (+x ... -z)? ")
    palm = flags.palm or _asked("Which points from the fingertip to the palm? ")
    return axes_named(right, palm)


def _asked(question: str) -> str:
    if not sys.stdin.isatty():
        raise UsageError("without a terminal give --rig to measure, or --right and --palm")
    return input(question)


def _measured(flags: CalibratePadAxesFlags, rig_name: str) -> execution.PadAxes:
    from tacgrasp.bringup.pad_axes import find_pad_axes
    from tacgrasp.config.layers import load
    from tacgrasp.console import make_console
    from tacgrasp.rig.factory import make_rig

    config, _ = load(None, rig_name, os.environ)
    hardware = None if config.hardware is None else config.hardware.where_it_stands()
    config = config.model_copy(
        update={"object": flags.object, "seed": flags.seed, "hardware": hardware}
    )
    out, rig = make_console(), make_rig(config)
    try:
        found = find_pad_axes(
            rig,
            config.limits(),
            force_n=rig.first_force_n if flags.force_n is None else flags.force_n,
            clear_mm=flags.clear_mm,
            report=out.print,
        )
    finally:
        rig.arm.stop()
        rig.disconnect()
    out.print(f"largest misfit {found.misfit_mm:.2f} mm")
    return found.axes
