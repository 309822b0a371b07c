"""``tacgrasp jog``: move a rig by keyboard in small limited steps, and see what it feels."""

from __future__ import annotations

import os
import select
import sys
import termios
import tty
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rich.console import Console
from rich.control import Control
from rich.segment import ControlType

from tacgrasp.cli.flags import parse

if TYPE_CHECKING:
    from tacgrasp.bringup.jog import Jogger, JogSettings

LOOK_S = 0.4
"""How often the contact is shown while no key is pressed [s]."""


@dataclass(frozen=True)
class JogFlags:
    """Move a rig by hand; one key is one small step. ? lists the keys.

    Nothing moves before the first key: the arm does not go to its start pose.

    Without a terminal, every character of standard input is a key.

    Attributes:
        rig: Name of a rig, or the path of its YAML file.
        task: Whose clear_mm is used to open.
        seed: Of the simulated or emulated world.
        force_n: First force [N]; the rig's first force when not given.
    """

    rig: str = "sim"
    task: str = "strawberry"
    seed: int = 0
    force_n: float | None = None


def main(argv: Sequence[str]) -> int:
    """Jog until q, Ctrl-C or the end of the input."""
    flags = parse(JogFlags, argv, prog="tacgrasp jog")
    from primitives.execution import PadAxes
    from primitives.limits import clamp_force
    from tacgrasp.bringup.jog import HELP, Jogger, JogSettings
    from tacgrasp.config.layers import load
    from tacgrasp.console import make_console
    from tacgrasp.rig.factory import make_rig

    config, _ = load(flags.task, flags.rig, os.environ)
    hardware = None if config.hardware is None else config.hardware.where_it_stands()
    config = config.model_copy(update={"seed": flags.seed, "hardware": hardware})
    limits, out = config.limits(), make_console()
    rig = make_rig(config)
    try:
        asked_n = rig.first_force_n if flags.force_n is None else flags.force_n
        settings = JogSettings(force_n=clamp_force(asked_n, limits).value)
        axes = PadAxes(x_tcp=config.pad.x_axis, y_tcp=config.pad.y_axis)
        jogger = Jogger(rig, limits, axes, clear_mm=config.primitives.clear_mm)
        for line in HELP:
            out.print(line)
        if sys.stdin.isatty():
            with _keyboard() as keys:
                _jog(keys, jogger, settings, out)
        else:
            _jog(_characters(sys.stdin.read), jogger, settings, out)
    finally:
        rig.arm.stop()
        rig.disconnect()
        if out.is_terminal:
            out.print()  # what is said next has a line of its own
    return 0


def _jog(keys: Iterator[str], jogger: Jogger, settings: JogSettings, out: Console) -> None:
    from cltp import TouchError
    from primitives import LimitError
    from tacgrasp.bringup.jog import Quit, command_of

    for key in keys:
        said = ""
        if key:
            command, settings = command_of(key, settings)
            if isinstance(command, Quit):
                return
            try:
                said = jogger.carry_out(command) if command is not None else "ready"
            except LimitError as error:
                said = f"refused: {error}"
        try:
            felt = jogger.contact()
        except TouchError as error:
            felt = f"no touch: {error}"
        line = f"step {settings.step_mm:g} mm, force {settings.force_n:.2f} N | {felt}"
        _show(out, line, said)


def _show(out: Console, line: str, said: str) -> None:
    if not out.is_terminal:
        out.print(f"{said} | {line}" if said else line)
        return
    anew = Control(ControlType.CARRIAGE_RETURN, (ControlType.ERASE_IN_LINE, 2))
    if said:
        out.control(anew)
        out.print(said, soft_wrap=True)
    out.control(anew)
    # cut to the width: of a line that is broken into two, only the second would be overwritten
    out.print(line[: out.width - 1], end="", soft_wrap=True)


def _characters(read: Callable[[int], str]) -> Iterator[str]:
    while key := read(1):
        if key != "\n":
            yield key


@contextmanager
def _keyboard() -> Iterator[Iterator[str]]:
    """Single keys of the terminal, '' when none came for a while; the terminal is set back."""
    descriptor = sys.stdin.fileno()
    before = termios.tcgetattr(descriptor)
    tty.setcbreak(descriptor)

    def keys() -> Iterator[str]:
        while True:
            ready, _, _ = select.select([descriptor], [], [], LOOK_S)
            yield os.read(descriptor, 1).decode("latin-1") if ready else ""

    try:
        yield keys()
    finally:
        termios.tcsetattr(descriptor, termios.TCSADRAIN, before)
