"""How long an emulator's process lives: one ready line, then until it is told to end.

It ends on SIGTERM, on Ctrl-C and when its standard input closes, so that it never outlives the
process that started it.
"""

from __future__ import annotations

import json
import os
import signal
import sys
import threading
from collections.abc import Mapping
from types import FrameType

Ready = Mapping[str, str | int | float | bool | None]
"""What whoever started an emulator has to know: addresses, ports, by name."""


def announce_and_wait(ready: Ready) -> None:
    """Print ``ready`` as one JSON line and return when the process is to end.

    Call it from the main thread (it takes SIGTERM and SIGINT); the emulator's own threads run on.
    """
    told = threading.Event()

    def tell(signum: int, frame: FrameType | None) -> None:
        told.set()

    signal.signal(signal.SIGTERM, tell)
    signal.signal(signal.SIGINT, tell)
    threading.Thread(target=_until_stdin_closes, args=(told,), daemon=True).start()
    sys.stdout.write(json.dumps(dict(ready)) + "\n")
    sys.stdout.flush()
    while not told.wait(0.2):  # a bare wait would not let the signal's Python code run at once
        pass


def _until_stdin_closes(told: threading.Event) -> None:
    # os.read, not sys.stdin: a thread blocked inside a buffered reader hinders the exit
    while os.read(0, 4096):
        pass
    told.set()
