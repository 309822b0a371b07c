"""``tacgrasp calibrate pad-axes``: orientation of the pad on the tool centre point of a rig."""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass
from typing import TYPE_CHECKING

from tacgrasp.base.errors import UsageError

if TYPE_CHECKING:
    from primitives import execution


@dataclass(frozen=True)
class CalibratePadAxesFlags:
    """Find the axes of the pad, from small moves with a contact or from your own look.

    They are axes in the frame of the tool centre point (TCP), for a rig's file.

    With --rig: from its present pose the arm goes 2 mm to both sides along every axis of the TCP,
    and the gripper closes on a fixed object at the middle of the pad. Without it: name the axes of
    the TCP that point to the pad's right and to the palm, by flags or at the prompt.

    Attributes:
        rig: Name of a rig, or path of its YAML file; its devices move.
        force_n: Force of every grip [N]; the rig's first force if omitted.
        clear_mm: Distance by which the gripper opens between grips [mm], above 4.
        object: Object between the fingers of a simulated or emulated rig.
        seed: Random seed of the simulated or emulated world.
        right: Axis of the TCP that points to the pad's right, like +x.
        palm: Axis of the TCP that points to the palm, like --palm=-z.
    """

    rig: str | None = None
    force_n: float | None = None
    clear_mm: float = 6.0
    object: str = "cherry_tomato"
    seed: int = 0
    right: str = ""
    palm: str = ""


def run(flags: CalibratePadAxesFlags) -> None:
    """Find the axes and print the lines of the rig's file."""
    if flags.rig is not None and (flags.right or flags.palm):
        raise UsageError("give --rig to measure, or --right and --palm, not both")
    from tacgrasp.bringup.pad_axes import as_yaml, axes_named
    from tacgrasp.console import make_console

    console = make_console()
    if flags.rig is not None:
        axes = _measured_axes(flags, flags.rig)
    else:
        right = flags.right or _ask("Which axis of the TCP points to the pad's right (+x ... -z)? ")
        axes = axes_named(
            right, flags.palm or _ask("Which points from the fingertip to the palm? ")
        )
    console.print("for the rig's file:")
    for line in as_yaml(axes):
        console.print(line)


def _ask(question: str) -> str:
    if not sys.stdin.isatty():
        raise UsageError("without a terminal give --rig to measure, or --right and --palm")
    return input(question)


def _measured_axes(flags: CalibratePadAxesFlags, rig_name: str) -> execution.PadAxes:
    from tacgrasp.bringup.pad_axes import find_pad_axes
    from tacgrasp.config.layers import load
    from tacgrasp.console import make_console
    from tacgrasp.rig.factory import make_centred_rig, make_rig

    config, _ = load(None, rig_name, os.environ)
    hardware = None if config.hardware is None else config.hardware.without_start_pose()
    config = config.model_copy(
        update={"object": flags.object, "seed": flags.seed, "hardware": hardware}
    )
    console = make_console()
    rig = make_rig(config) if config.devices == "hardware" else make_centred_rig(config)
    try:
        measured = find_pad_axes(
            rig,
            config.limits(),
            force_n=rig.first_force_n if flags.force_n is None else flags.force_n,
            clear_mm=flags.clear_mm,
            report=console.print,
        )
    finally:
        rig.arm.stop()
        rig.disconnect()
    console.print(f"largest misfit {measured.misfit_mm:.2f} mm")
    return measured.axes
