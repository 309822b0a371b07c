"""``tacgrasp emulate ur|dynamixel|taxels|rig``: emulators in the foreground, until Ctrl-C.

The options of each kind are those of ``python -m sim.emulators`` (``sim.emulators.options``).
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

from sim.emulators.options import OPTIONS, RigOptions
from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse, subcommand


def main(argv: Sequence[str]) -> int:
    """Run an emulator and print its addresses; Ctrl-C ends it."""
    kind, rest = subcommand("emulate", argv, {kind: str(o.__doc__) for kind, o in OPTIONS.items()})
    if kind is None:
        return 0
    options: object = parse(OPTIONS[kind], rest, prog=f"tacgrasp emulate {kind}")  # refused at once
    if isinstance(options, RigOptions):
        from tacgrasp.rig.factory import check_object

        check_object(options.object, options.object_mesh, is_emulated=True)
    emulate(kind, rest, time.sleep)
    return 0


def emulate(kind: str, options: Sequence[str], sleep: Callable[[float], None]) -> None:
    """Start an emulator, print its addresses and wait until Ctrl-C, or until it ends by itself.

    Raises:
        UsageError: The emulator could not start, or ended by itself.
    """
    from primitives import RobotError
    from sim.emulators.process.spawn import EmulatorProcess
    from tacgrasp.console import make_console, working

    console = make_console()
    try:
        with working(f"starting the {kind} emulator"):
            emulator = EmulatorProcess(kind, *options)
    except RobotError as error:
        raise UsageError(str(error)) from None
    with emulator:
        try:
            for name, value in emulator.ready.items():
                console.print(f"{name:14}{value}")
            console.print("running; Ctrl-C ends it")
            while emulator.running:
                sleep(0.2)
        except KeyboardInterrupt:
            console.print("ended")
            return
    raise UsageError(f"the {kind} emulator ended by itself")
