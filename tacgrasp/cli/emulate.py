"""``tacgrasp emulate ur|dynamixel|taxels|rig``: emulators in the foreground, until Ctrl-C."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated

import tyro

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse, subcommand

HELP = {
    "ur": "A UR controller: dashboard, script and RTDE ports on a loopback address.",
    "dynamixel": "A DynamixelFlags bus on a serial port, with fingers on a spring.",
    "taxels": "A serial taxel array with a ball pressed into it.",
    "rig": "All three around one object, for a rig file of your own.",
}


@dataclass(frozen=True)
class UrFlags:
    """Emulate a UR controller.

    Attributes:
        host: Loopback address.
        version: Of PolyScope, major.minor.
    """

    host: str = "127.0.0.2"
    version: str = "5.12"


@dataclass(frozen=True)
class DynamixelFlags:
    """Emulate a DynamixelFlags bus.

    Attributes:
        model: Of the servos.
        servos: How many, 1 or 2.
        baud: Of the bus [bit/s].
    """

    model: str = "XC330-T288"
    servos: int = 1
    baud: int = 1_000_000


@dataclass(frozen=True)
class TaxelFlags:
    """Emulate a serial taxel array.

    Attributes:
        rows: Of the grid.
        columns: Of the grid.
        rate_hz: Frames a second.
    """

    rows: int = 60
    columns: int = 80
    rate_hz: float = 30.0


@dataclass(frozen=True)
class EmulatedRigFlags:
    """Emulate arm, gripper and sensor around one object.

    Attributes:
        object: What is between the fingers.
        seed: Draws it, as in the simulated rig.
        sensor: Whose field the taxels cover.
        host: Loopback address of the arm; one that is free when not given.
    """

    object: str = "strawberry"
    seed: int = 0
    sensor: str = "gelsight_mini"
    host: Annotated[str | None, tyro.conf.arg(name="host")] = None


KINDS: Mapping[str, type] = {
    "ur": UrFlags,
    "dynamixel": DynamixelFlags,
    "taxels": TaxelFlags,
    "rig": EmulatedRigFlags,
}


def main(argv: Sequence[str]) -> int:
    """Run an emulator and say where it can be reached; Ctrl-C ends it."""
    kind, rest = subcommand("emulate", argv, HELP)
    if kind is None:
        return 0
    flags: object = parse(KINDS[kind], rest, prog=f"tacgrasp emulate {kind}")
    emulate(kind, options_of(flags), time.sleep)
    return 0


def options_of(flags: object) -> list[str]:
    """The emulator's own options for what was asked for."""
    given = {name: getattr(flags, name) for name in type(flags).__annotations__}
    return [
        part
        for name, value in given.items()
        if value is not None
        for part in (f"--{name.replace('_', '-')}", str(value))
    ]


def emulate(kind: str, options: Sequence[str], sleep: Callable[[float], None]) -> None:
    """Start an emulator, print its addresses and wait until Ctrl-C, or until it ends by itself.

    Raises:
        UsageError: It could not start; says why.
    """
    from primitives import RobotError
    from sim.emulators.process.spawn import EmulatorProcess
    from tacgrasp.console import console

    out = console()
    try:
        emulator = EmulatorProcess(kind, *options)
    except RobotError as error:
        raise UsageError(str(error)) from None
    with emulator:
        for name, value in emulator.ready.items():
            out.print(f"{name:14}{value}")
        out.print("running; Ctrl-C ends it")
        try:
            while emulator.running:
                sleep(0.2)
        except KeyboardInterrupt:
            out.print("ended")
            return
    raise UsageError(f"the {kind} emulator ended by itself")
