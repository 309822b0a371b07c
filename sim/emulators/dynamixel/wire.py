"""The serial line of the emulated servos: a pty under a name that stays.

A pty has no real baud rate, but it carries the one that a client sets: at another one than the
servos' nothing is understood, as on a wire.
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
from pathlib import Path


class Wire:
    """A pty whose slave side a client opens.

    One thread reads and writes; the plug may be pulled from any. The reader then closes the
    descriptors, so that it never waits on a number that already means another file.

    Attributes:
        link: The name that stays; it points to the slave side, also after plugging in again.
        plugged: Whether it is there.
    """

    def __init__(self) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix="dynamixel-")
        self.link = Path(self._folder.name) / "port"
        self._taken: int | None = None
        self._master = self._slave = -1
        self.plugged = False
        self._wanted = True
        self._follow()

    def plug_in(self) -> None:
        """Plug in, or in again: the name then means another pty. Idempotent."""
        self._wanted = True

    def unplug(self) -> None:
        """Pull the plug: a client that has it open gets errors. Idempotent."""
        self.give_back()
        self._wanted = False

    def _follow(self) -> None:
        """Do what was last wanted: open or close the pty."""
        if self._wanted == self.plugged:
            return
        self.link.unlink(missing_ok=True)
        if self._wanted:
            self._master, self._slave = pty.openpty()
            tty.setraw(self._slave)  # before a client sets it up, nothing must be echoed
            os.set_blocking(self._master, False)
            self.link.symlink_to(os.ttyname(self._slave))
        else:
            os.close(self._slave)
            os.close(self._master)
        self.plugged = self._wanted

    def take(self) -> None:
        """Hold the line as another program would.

        Raises:
            ValueError: A client has it already.
        """
        if self._taken is not None:
            return
        descriptor = os.open(self.link, os.O_RDWR | os.O_NOCTTY)
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            os.close(descriptor)
            raise ValueError("the port can't be taken: a client has it") from None
        self._taken = descriptor

    def give_back(self) -> None:
        """Let others have the line. Idempotent."""
        if self._taken is not None:
            os.close(self._taken)
            self._taken = None

    def baud(self) -> int:
        """What the client has set [bit/s]; 0 when it is none that is known."""
        return _SPEEDS.get(termios.tcgetattr(self._slave)[5], 0)

    def read(self, wait_s: float) -> bytes:
        """What has come within a while, empty when nothing has or nothing is plugged in."""
        self._follow()
        if not self.plugged:
            return b""
        ready, _, _ = select.select([self._master], [], [], wait_s)
        return os.read(self._master, 4096) if ready else b""

    def write(self, data: bytes) -> None:
        """Send; what a client that does not read leaves no room for is lost, as on a wire."""
        if not self.plugged:
            return
        try:
            os.write(self._master, data)
        except BlockingIOError:
            return

    def close(self) -> None:
        """Unplug for good, when nobody reads any more. Idempotent."""
        self.unplug()
        self._follow()
        self._folder.cleanup()


_SPEEDS: Mapping[int, int] = {
    getattr(termios, f"B{baud}"): baud
    for baud in (9600, 57600, 115200, 1000000, 2000000, 3000000, 4000000)
}
