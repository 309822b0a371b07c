"""The serial line of the emulated servos: a pty under a constant name.

A pty has no real baud rate, but it reports the one that a client sets. At a baud rate other than
the servos' no instruction is understood, as on a real line.
"""

from __future__ import annotations

import fcntl
import os
import pty
import select
import tempfile
import termios
import tty
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

from sim.emulators.dynamixel.control_table import BAUDS


class Wire:
    """A pty whose slave side a client opens.

    One thread reads and writes; any thread may unplug. The reading thread then closes the
    descriptors, so that it never waits on a number that already belongs to another file.

    Attributes:
        link: Symbolic link to the slave side, at the same path after every plugging in.
        plugged: The pty is open.
    """

    def __init__(self) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix="dynamixel-")
        self.link = Path(self._folder.name) / "port"
        self._lock_fd: int | None = None
        self._master = self._slave = -1
        self.plugged = False
        self._requested = True
        self._update()

    def plug_in(self) -> None:
        """Plug in, or plug in again: the link then points to another pty. Idempotent."""
        self._requested = True

    def unplug(self) -> None:
        """Unplug: a client that has the port open gets errors. Idempotent."""
        self.unlock()
        self._requested = False

    def _update(self) -> None:
        requested = self._requested  # another thread may change it meanwhile
        if requested == self.plugged:
            return
        self.link.unlink(missing_ok=True)
        if requested:
            self._master, self._slave = pty.openpty()
            tty.setraw(self._slave)  # nothing must be echoed before a client sets it up
            os.set_blocking(self._master, False)
            self.link.symlink_to(os.ttyname(self._slave))
        else:
            os.close(self._slave)
            os.close(self._master)
        self.plugged = requested

    def lock(self) -> None:
        """Lock the port as another program would.

        Raises:
            ValueError: A client has locked it.
        """
        if self._lock_fd is not None:
            return
        descriptor = os.open(self.link, os.O_RDWR | os.O_NOCTTY)
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            os.close(descriptor)
            raise ValueError("the port can't be taken: a client has it") from None
        self._lock_fd = descriptor

    def unlock(self) -> None:
        if self._lock_fd is not None:
            os.close(self._lock_fd)
            self._lock_fd = None

    def baud(self) -> int:
        """Baud rate that the client has set [bit/s]; 0 for an unknown one."""
        return _SPEEDS.get(termios.tcgetattr(self._slave)[5], 0)

    def read(self, wait_s: float) -> bytes:
        """Bytes received within ``wait_s``; empty without any, or when unplugged."""
        self._update()
        if not self.plugged:
            return b""
        ready, _, _ = select.select([self._master], [], [], wait_s)
        return os.read(self._master, 4096) if ready else b""

    def write(self, data: bytes) -> None:
        """Send; bytes beyond the buffer of a client that does not read are lost, as on a line."""
        if not self.plugged:
            return
        with suppress(BlockingIOError):
            os.write(self._master, data)

    def close(self) -> None:
        """Unplug for good, once no thread reads any more. Idempotent."""
        self.unplug()
        self._update()
        self._folder.cleanup()


_SPEEDS: Mapping[int, int] = {getattr(termios, f"B{baud}"): baud for baud in BAUDS}
