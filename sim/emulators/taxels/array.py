"""A serial taxel array on a pty: it sends the heights of a gel as packets, and can have faults.

The packets are those of ``cltp.sensing.taxel_packets``, so the driver of the real array reads them;
only the port differs. A symbolic link stands for the stable id under /dev/serial/by-id: it goes
when the array is unplugged and comes back with it.

Not here: the gel, a ``HeightSource`` (``sim.emulators.world``; a pressed ball in a process alone).
"""

from __future__ import annotations

import os
import select
import tempfile
import threading
import time
import tty
from collections.abc import Callable
from contextlib import closing, suppress
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from cltp.sensing.taxel_packets import PacketParser, TaxelFrame, TaxelMark, counts_of, encode_frame
from sim.emulators.process.control import Facts
from sim.emulators.process.lifetime import request_real_time, serve
from sim.emulators.taxels.ball import PressedBall
from sim.emulators.taxels.options import TaxelOptions

FAULTS = {
    "unplugged": "the port disappears, as when the cable is pulled; clear plugs it in again",
    "stall": "frames stop, the port stays",
    "black": "every height is zero, as from a dead camera behind the gel",
    "saturated": "every count is at its largest value",
    "torn": "the next packets (count=1) break off half-way",
    "flipped": "the next packets (count=1) have one bit wrong",
    "repeated": "the next packets (count=1) are sent twice",
    "garbage": "bytes that are no packets, as from another device",
}
"""Names and effects of the faults."""

_COUNTED = ("torn", "flipped", "repeated")
_SATURATED = np.iinfo(np.int16).max
_APPLIED_S = 2.0


class HeightSource(Protocol):
    """The gel under the array. Called from the emulator's own thread."""

    def height_mm(self) -> NDArray[np.float32]:
        """Reconstructed heights of the gel now, shape (rows, columns) [mm]."""


class TaxelEmulator:
    """The array; one thread of its own owns the pty. An ``Emulated`` device.

    Attributes:
        port: Path of the link to the pty.
    """

    def __init__(
        self,
        source: HeightSource,
        *,
        link: Path,
        along_mm: Callable[[], NDArray[np.float32]] | None = None,
        rate_hz: float = 30.0,
        seed: int = 0,
    ) -> None:
        """Plug the array in.

        Args:
            source: The gel.
            along_mm: Displacements along the gel now, shape (rows, columns, 2) [mm, gel frame],
                called after the heights; None sends packets of version 1, without them.
            link: Free path for the symbolic link to the pty.
            rate_hz: Frames per second.
            seed: Random seed of the garbage bytes.

        Raises:
            ValueError: The rate is not within 1 to 200 Hz.
            OSError: The link can't be created.
        """
        if not 1 <= rate_hz <= 200:
            raise ValueError(f"an array sends 1 to 200 frames a second, got {rate_hz}")
        self.port = str(link)
        self._link, self._source, self._rate_hz = link, source, rate_hz
        self._along_mm = along_mm
        self._rng = np.random.default_rng(seed)
        self._faults: dict[str, int] = {}
        self._injected_s: float | None = None
        self._condition = threading.Condition()  # guards faults; notified once they apply
        self._changed = self._ending = False
        self._frames = self._marks = 0
        self._sequence = self._mark = 0
        self._parser = PacketParser()
        self._wake_out, self._wake_in = os.pipe()
        self._master = self._slave = -1
        self._plug()
        self._thread = threading.Thread(target=self._run, name="taxel array", daemon=True)
        self._thread.start()

    def inject(self, fault: str, **details: float | str) -> None:
        """Start one of ``FAULTS``; return once it applies.

        Raises:
            ValueError: No such fault, or a detail that it does not take.
        """
        if fault not in FAULTS:
            raise ValueError(f"unknown fault {fault!r} of the array; known: {', '.join(FAULTS)}")
        count = details.pop("count", 1) if fault in _COUNTED else 1
        if details or not isinstance(count, int | float) or count < 1:
            raise ValueError(f"{fault}: expected at most count >= 1, got {details or count}")
        with self._condition:
            self._faults[fault] = int(count)
            self._injected_s = time.monotonic()
        self._apply()

    def clear(self) -> None:
        """End all faults; an unplugged array is plugged in again, under the same link."""
        with self._condition:
            self._faults.clear()
        self._apply()

    def facts(self) -> Facts:
        with self._condition:
            ago_s = None if self._injected_s is None else time.monotonic() - self._injected_s
            return {
                "serial_port": self.port,
                "plugged": self._master >= 0,
                "rate_hz": self._rate_hz,
                "frames_sent": float(self._frames),
                "marks_received": float(self._marks),
                "faults": ", ".join(self._faults) or "none",
                "injected_ago_ms": None if ago_s is None else 1e3 * ago_s,
            }

    def close(self) -> None:
        with self._condition:
            if self._ending:
                return
            self._ending = True
        os.write(self._wake_in, b"!")
        self._thread.join(timeout=5)
        os.close(self._wake_in)
        os.close(self._wake_out)

    def _apply(self) -> None:
        """Wake the thread and wait until the change of faults applies."""
        with self._condition:
            if self._ending:
                return
            self._changed = True
            os.write(self._wake_in, b"!")
            self._condition.wait_for(lambda: not self._changed, timeout=_APPLIED_S)

    def _run(self) -> None:
        request_real_time(inherited=False)
        due = time.monotonic()
        try:
            while self._wait(max(0.0, due - time.monotonic())):
                if time.monotonic() < due:
                    continue
                due = max(due + 1 / self._rate_hz, time.monotonic() - 1 / self._rate_hz)
                if self._master >= 0 and "stall" not in self._faults:
                    self._send(self._next_bytes())
        finally:
            self._unplug()

    def _wait(self, wait_s: float, *, to_write: bool = False) -> bool:
        """Wait for the time, a mark, room to write or a change; False at the end."""
        plugged = self._master >= 0
        reads = [self._wake_out, *([self._master] if plugged else [])]
        readable, _, _ = select.select(
            reads, [self._master] if plugged and to_write else [], [], wait_s
        )
        if self._wake_out in readable:
            os.read(self._wake_out, 64)
        if plugged and self._master in readable:
            self._read_marks()
        with self._condition:
            if "unplugged" in self._faults:
                self._unplug()
            elif self._master < 0 and not self._ending:
                self._plug()
            self._changed = False
            self._condition.notify_all()
            return not self._ending

    def _read_marks(self) -> None:
        with suppress(BlockingIOError):
            for packet in self._parser.feed(os.read(self._master, 4096)):
                if isinstance(packet, TaxelMark):
                    self._mark, self._marks = packet.mark, self._marks + 1

    def _next_bytes(self) -> bytes:
        clock_us = int(time.monotonic() * 1e6)
        mark = self._mark  # before the capture: the frame is newer than the mark
        counts = counts_of(self._source.height_mm())
        along = None if self._along_mm is None else counts_of(self._along_mm())
        if "garbage" in self._faults:
            return self._rng.bytes(counts.size)
        if "black" in self._faults or "saturated" in self._faults:
            level = 0 if "black" in self._faults else _SATURATED
            counts = np.full_like(counts, level)
            along = None if along is None else np.full_like(along, level)
        self._sequence = (self._sequence + 1) % 2**32
        packet = encode_frame(
            TaxelFrame(
                sequence=self._sequence,
                mark=mark,
                clock_us=clock_us,
                counts_um=counts,
                along_um=along,
            )
        )
        if self._take("torn"):
            return packet[: len(packet) // 2]
        if self._take("flipped"):
            middle = len(packet) // 2
            return packet[:middle] + bytes([packet[middle] ^ 4]) + packet[middle + 1 :]
        if self._take("repeated"):
            return 2 * packet
        return packet

    def _take(self, fault: str) -> bool:
        """Whether a counted fault applies to this packet; lowers its count by one."""
        with self._condition:
            remaining = self._faults.pop(fault, 0)
            if remaining > 1:
                self._faults[fault] = remaining - 1
            return remaining > 0

    def _send(self, data: bytes) -> None:
        """Write all bytes as fast as the host reads them; a pty buffers only 4 kB."""
        rest, master = memoryview(data), self._master
        while len(rest) and self._master == master:
            try:
                rest = rest[os.write(master, rest) :]
            except BlockingIOError:
                if not self._wait(0.05, to_write=True):
                    return
        self._frames += 1

    def _plug(self) -> None:
        self._master, self._slave = os.openpty()
        tty.setraw(self._slave)  # bytes pass unchanged
        os.set_blocking(self._master, False)
        self._link.symlink_to(os.ttyname(self._slave))
        self._sequence = self._mark = 0  # counters restart with the power

    def _unplug(self) -> None:
        if self._master < 0:
            return
        self._link.unlink(missing_ok=True)
        os.close(self._master)
        os.close(self._slave)
        self._master = self._slave = -1


def run(options: TaxelOptions) -> None:
    """Run an array with a ball pressed into it, until the process is to end."""
    with tempfile.TemporaryDirectory(prefix="taxels-") as folder:
        ball = PressedBall(options.rows, options.columns, options.seed)
        link = Path(folder) / "taxel-array"
        along_mm = ball.along_mm if options.shear else None
        emulator = TaxelEmulator(ball, link=link, along_mm=along_mm, rate_hz=options.rate_hz)
        with closing(emulator) as array:
            serve({"taxels": array}, {"serial_port": array.port})
