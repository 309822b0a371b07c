"""Serial ports by stable names: which there are, and which one a rig's file means.

``/dev/ttyUSB0`` is whatever was plugged in first; the names under ``/dev/serial/by-id`` and the
serial numbers of the adapters stay. A rig's file may give any of them.

Not here: opening a port. Whoever opens one takes it with ``claim``, so that two programs never talk
on it at the same time.
"""

from __future__ import annotations

import fcntl
import os
import termios
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from primitives.errors import RobotError

BY_ID = Path("/dev/serial/by-id")


@dataclass(frozen=True, slots=True, kw_only=True)
class SerialPort:
    """A serial port of this computer.

    Attributes:
        device: Its path, like /dev/ttyUSB0.
        stable_id: Its name under /dev/serial/by-id; empty when it has none.
        serial_number: Of the USB adapter; empty when it tells none.
        description: What the adapter calls itself.
    """

    device: str
    stable_id: str
    serial_number: str
    description: str

    def __str__(self) -> str:
        name = f"{BY_ID / self.stable_id}" if self.stable_id else self.device
        number = f", serial number {self.serial_number}" if self.serial_number else ""
        return f"{name} ({self.description}{number})"


def serial_ports(by_id: Path = BY_ID) -> Sequence[SerialPort]:
    """The serial ports that this computer has now, adapters with a USB identity only."""
    from serial.tools import list_ports

    links = {}
    if by_id.is_dir():
        links = {str(link.resolve()): link.name for link in sorted(by_id.iterdir())}
    ports = [
        SerialPort(
            device=port.device,
            stable_id=links.get(str(Path(port.device).resolve()), ""),
            serial_number=port.serial_number or "",
            description=port.description or "no description",
        )
        for port in list_ports.comports()
        if port.vid is not None or str(Path(port.device).resolve()) in links
    ]
    return sorted(ports, key=lambda port: port.device)


def find_port(
    wanted: str, what: str, ports: Sequence[SerialPort] | None = None, by_id: Path = BY_ID
) -> str:
    """The path of the one port that a rig's file means.

    Args:
        wanted: A path; or a name under /dev/serial/by-id, a part of one, or the adapter's serial
            number.
        what: The device, for the error: 'the gripper'.
        ports: Those to choose from; this computer's when not given.
        by_id: Where the stable names are.

    Raises:
        RobotError: No port, or more than one, is meant; the message lists those that exist.
    """
    if os.sep in wanted:
        if Path(wanted).exists():
            return wanted
        raise RobotError(f"no serial port {wanted} for {what}; {_listed(ports, by_id)}")
    known = serial_ports(by_id) if ports is None else ports
    exact = [port for port in known if wanted in (port.stable_id, port.serial_number)]
    meant = exact or [port for port in known if wanted and wanted in port.stable_id]
    if len(meant) == 1:
        return meant[0].device
    how = f"{len(meant)} serial ports match" if meant else "no serial port matches"
    raise RobotError(f"{how} {wanted!r} for {what}; {_listed(known, by_id)}")


def adapter_serial(path: str, ports: Sequence[SerialPort] | None = None) -> str:
    """Serial number of the USB adapter at a path; empty when it tells none."""
    real = str(Path(path).resolve())
    known = serial_ports() if ports is None else ports
    return next((p.serial_number for p in known if str(Path(p.device).resolve()) == real), "")


def _listed(ports: Sequence[SerialPort] | None, by_id: Path) -> str:
    known = serial_ports(by_id) if ports is None else ports
    if not known:
        return (
            "this computer has no USB serial adapter now: check the cable, and that you may read "
            "the port (group dialout)"
        )
    return "there are: " + "; ".join(str(port) for port in known)


def claim(descriptor: int, path: str, what: str) -> None:
    """Take an open serial port for this program alone, until it is closed.

    Two locks, since programs honour one or the other: ``flock`` (pyserial's ``exclusive``), and
    ``TIOCEXCL``, by which the kernel refuses any further opening but root's.

    Raises:
        RobotError: Another program has it.
    """
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        fcntl.ioctl(descriptor, termios.TIOCEXCL)
    except OSError:
        raise RobotError(taken(path, what)) from None


def taken(path: str, what: str) -> str:
    """What to tell a person when another program has the port."""
    return (
        f"the serial port {path} of {what} is in use by another program; end that one first "
        f"(to see which: fuser {path})"
    )
