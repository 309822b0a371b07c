"""``tacgrasp jog``: move a rig by keyboard in small limited steps, and see the contact."""

from __future__ import annotations

import math
import os
import select
import sys
import termios
import tty
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rich.console import Console
from rich.control import Control
from rich.segment import ControlType

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse

if TYPE_CHECKING:
    from tacgrasp.bringup.jog import Jogger, JogSettings
    from tacgrasp.config.schema import RunConfig
    from tacgrasp.rig.protocols import Rig

REFRESH_S = 0.4
"""Interval between displays of the contact while no key is pressed [s]."""


@dataclass(frozen=True)
class JogFlags:
    """Move a rig by hand, one small step for each key; ? lists the keys.

    Nothing moves before the first key: the arm does not go to its start pose.

    Without a terminal, every character of standard input is a key.

    Attributes:
        rig: Name of a rig, or path of its YAML file.
        task: Task whose clear_mm the gripper opens by.
        seed: Random seed of the simulated or emulated world.
        force_n: Force of the first grip [N]; the rig's first force if omitted.
        open: Open the gripper of real devices by 10 mm and end, whatever arm, sensor and the
            gripper's calibration are like: they are not needed.
    """

    rig: str = "sim"
    task: str = "strawberry"
    seed: int = 0
    force_n: float | None = None
    open: bool = False

    def __post_init__(self) -> None:
        if self.force_n is not None and not 0 < self.force_n < math.inf:
            raise UsageError(f"--force-n must be above 0 N, got {self.force_n:g}")


def main(argv: Sequence[str]) -> int:
    """Jog until q, Ctrl-C or the end of the input."""
    flags = parse(JogFlags, argv, prog="tacgrasp jog")
    from primitives.execution import PadAxes
    from primitives.limits import clamp_force
    from tacgrasp.bringup.jog import HELP, Jogger, JogSettings
    from tacgrasp.config.layers import load
    from tacgrasp.config.terms import task_terms
    from tacgrasp.console import make_console
    from tacgrasp.rig.factory import make_rig

    config, _ = load(flags.task, flags.rig, os.environ)
    hardware = None if config.hardware is None else config.hardware.without_start_pose()
    config = config.model_copy(update={"seed": flags.seed, "hardware": hardware})
    limits, out = config.limits(), make_console()
    if flags.open:
        out.print(_opened_alone(config))
        return 0
    rig = make_rig(config, must_grip=False)
    try:
        force_n = rig.first_force_n if flags.force_n is None else flags.force_n
        settings = JogSettings(force_n=clamp_force(force_n, limits).value)
        axes = PadAxes(x_tcp=config.pad.x_axis, y_tcp=config.pad.y_axis)
        jogger = Jogger(
            rig,
            limits,
            axes,
            clear_mm=config.primitives.clear_mm,
            limit_n=task_terms(config).force.limit_n,
            max_gain=config.gripper.max_force_gain,
        )
        for line in HELP:
            out.print(line)
        if sys.stdin.isatty():
            with _keyboard() as keys:
                _jog(keys, jogger, settings, out)
        else:
            _jog(_characters(sys.stdin.read), jogger, settings, out)
    finally:
        rig.arm.stop()
        if out.is_terminal:
            out.print()  # ends the line of the contact
        if kept := _kept_grip(rig):
            out.print(kept)
        rig.disconnect()
    return 0


def _opened_alone(config: RunConfig) -> str:
    """Open the gripper of a rig of real devices; what was done.

    Raises:
        UsageError: The rig has no real devices.
        RobotError: The gripper can't be reached, or does not open.
    """
    from tacgrasp.rig.driver_choice import connect_gripper_of
    from tacgrasp.rig.release import CLEAR_M

    if config.hardware is None or config.devices != "hardware":
        raise UsageError("--open is for real devices; name their file with --rig")
    gripper = connect_gripper_of(config.hardware.gripper, must_grip=False).gripper
    try:
        state = gripper.open_by(CLEAR_M)
    finally:
        gripper.disconnect()
    return f"the gripper is open: {1000 * state.width_m:.1f} mm between the fingers"


def _kept_grip(rig: Rig) -> str:
    """That the gripper goes on gripping; '' where it does not, or its state can't be read."""
    from primitives import RobotError

    try:
        state = rig.gripper.state()
    except RobotError:
        return ""
    if not state.closed:
        return ""
    # a gripper without a calibration does not know its force
    force = f"{state.force_n:.2f} N commanded, " if state.force_n > 0 else ""
    return f"the gripper keeps its grip: {force}{1000 * state.width_m:.1f} mm"


def _jog(keys: Iterator[str], jogger: Jogger, settings: JogSettings, out: Console) -> None:
    from cltp import TouchError
    from primitives import LimitError
    from tacgrasp.bringup.jog import JogAction, key_command

    for key in keys:
        result = ""
        if key:
            command, settings = key_command(key, settings)
            if command is JogAction.QUIT:
                return
            try:
                result = jogger.carry_out(command) if command is not None else "ready"
            except (LimitError, TouchError) as error:  # nothing was sent
                result = f"refused: {error}"
        try:
            contact = jogger.contact()
        except TouchError as error:
            contact = f"no touch: {error}"
        line = f"step {settings.step_mm:g} mm, force {settings.force_n:.2f} N | {contact}"
        _show(out, line, result)


def _show(out: Console, line: str, result: str) -> None:
    if not out.is_terminal:
        out.print(f"{result} | {line}" if result else line)
        return
    clear_line = Control(ControlType.CARRIAGE_RETURN, (ControlType.ERASE_IN_LINE, 2))
    if result:
        out.control(clear_line)
        out.print(result, soft_wrap=True)
    out.control(clear_line)
    # cut to the width: only the last part of a wrapped line would be overwritten
    out.print(line[: out.width - 1], end="", soft_wrap=True)


def _characters(read: Callable[[int], str]) -> Iterator[str]:
    while key := read(1):
        if key != "\n":
            yield key


@contextmanager
def _keyboard() -> Iterator[Iterator[str]]:
    """Single keys of the terminal, '' after ``REFRESH_S`` without one; restores the terminal."""
    descriptor = sys.stdin.fileno()
    before = termios.tcgetattr(descriptor)
    tty.setcbreak(descriptor)

    def keys() -> Iterator[str]:
        while True:
            ready, _, _ = select.select([descriptor], [], [], REFRESH_S)
            yield os.read(descriptor, 1).decode("latin-1") if ready else ""

    try:
        yield keys()
    finally:
        with suppress(termios.error):  # a terminal that was closed
            termios.tcsetattr(descriptor, termios.TCSADRAIN, before)
