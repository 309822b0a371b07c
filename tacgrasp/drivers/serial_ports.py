"""Serial ports by stable names: listing them, and finding the port of a rig's file.

``/dev/ttyUSB0`` depends on the order of plugging in; the names under ``/dev/serial/by-id`` and the
serial numbers of the adapters are stable. A rig's file may give any of these.

Not here: opening a port. A driver that opens a port calls ``claim``, so that two programs never use
it at the same time.
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
        device: Path, like /dev/ttyUSB0.
        stable_id: Name under /dev/serial/by-id; empty for none.
        serial_number: Serial number of the USB adapter; empty for none.
        description: Description by the adapter.
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
    """List the present serial ports of this computer; only adapters with a USB identity."""
    from serial.tools import list_ports

    links = {}
    if by_id.is_dir():
        links = {link.resolve(): link.name for link in sorted(by_id.iterdir())}
    ports = [
        SerialPort(
            device=port.device,
            stable_id=links.get(Path(port.device).resolve(), ""),
            serial_number=port.serial_number or "",
            description=port.description or "no description",
        )
        for port in list_ports.comports()
        if port.vid is not None or Path(port.device).resolve() in links
    ]
    return sorted(ports, key=lambda port: port.device)


def find_port(
    name: str, device: str, ports: Sequence[SerialPort] | None = None, by_id: Path = BY_ID
) -> str:
    """Path of the one port with the name in a rig's file.

    Args:
        name: A path; or a name under /dev/serial/by-id, a part of one, or the adapter's serial
            number.
        device: The device, for the error: 'the gripper'.
        ports: The ports to choose from; None is this computer's.
        by_id: Folder of the stable names.

    Raises:
        RobotError: No port, or more than one, has the name; the message lists the present ports.
    """
    if os.sep in name and Path(name).exists():
        return name
    present = serial_ports(by_id) if ports is None else ports
    if os.sep in name:
        raise RobotError(f"no serial port {name} for {device}; {_listed(present)}")
    exact = [port for port in present if name in (port.stable_id, port.serial_number)]
    matches = exact or [port for port in present if name and name in port.stable_id]
    if len(matches) == 1:
        return matches[0].device
    problem = f"{len(matches)} serial ports match" if matches else "no serial port matches"
    raise RobotError(f"{problem} {name!r} for {device}; {_listed(present)}")


def adapter_serial(path: str) -> str:
    """Serial number of the USB adapter at a path; empty for none."""
    real, ports = Path(path).resolve(), serial_ports()
    return next((p.serial_number for p in ports if Path(p.device).resolve() == real), "")


def _listed(ports: Sequence[SerialPort]) -> str:
    if not ports:
        return (
            "this computer has no USB serial adapter now: check the cable, and that you may read "
            "the port (group dialout)"
        )
    return "there are: " + "; ".join(map(str, ports))


def claim(descriptor: int, path: str, device: str) -> None:
    """Lock an open serial port for this program, until it is closed.

    Two locks, since a program honours one or the other: ``flock`` (pyserial's ``exclusive``), and
    ``TIOCEXCL``, by which the kernel refuses any further opening but root's.

    Raises:
        RobotError: Another program uses the port.
    """
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        fcntl.ioctl(descriptor, termios.TIOCEXCL)
    except OSError:
        raise RobotError(in_use_message(path, device)) from None


def in_use_message(path: str, device: str) -> str:
    """Error message for a port in use by another program."""
    return (
        f"the serial port {path} of {device} is in use by another program; end that one first "
        f"(to see which: fuser {path})"
    )
