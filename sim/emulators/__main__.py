"""``python -m sim.emulators KIND [OPTIONS]``: run one emulator until it is told to end."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Sequence

MODULES = {
    "ur": "sim.emulators.ur.controller_process",
    "dynamixel": "sim.emulators.dynamixel.bus_process",
    "taxels": "sim.emulators.taxels.array",
    "rig": "sim.emulators.rig",
}
"""The module of each kind; it has ``main(argv) -> exit code`` and prints one ready line."""


def main(argv: Sequence[str]) -> int:
    """Run the emulator that the first word names; 2 when there is no such kind."""
    if not argv or argv[0] not in MODULES:
        got = repr(argv[0]) if argv else "nothing"
        sys.stderr.write(f"expected an emulator out of {', '.join(MODULES)}, got {got}\n")
        return 2
    return int(importlib.import_module(MODULES[argv[0]]).main(list(argv[1:])))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
