"""``python -m sim.emulators KIND [OPTIONS]``: run one emulator until its process is told to end."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Mapping, Sequence

import tyro

from sim.emulators.options import OPTIONS

MODULES: Mapping[str, str] = {
    "ur": "sim.emulators.ur.controller_process",
    "dynamixel": "sim.emulators.dynamixel.bus_process",
    "taxels": "sim.emulators.taxels.array",
    "rig": "sim.emulators.rig",
}
"""Module of each kind; its ``run(options)`` prints one ready line and returns at the end."""


def main(argv: Sequence[str]) -> int:
    """Run the emulator that the first word names; 2 when there is no such kind."""
    if not argv or argv[0] not in MODULES:
        kind = repr(argv[0]) if argv else "nothing"
        sys.stderr.write(f"expected an emulator out of {', '.join(MODULES)}, got {kind}\n")
        return 2
    kind = argv[0]
    options: object = tyro.cli(OPTIONS[kind], args=argv[1:], prog=f"python -m sim.emulators {kind}")
    importlib.import_module(MODULES[kind]).run(options)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
