"""The result of one transaction with a servo: a reply, or one of four kinds of fault."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from primitives.errors import RobotError

STATUS_ERRORS = {
    1: "it failed",
    2: "it does not know the instruction",
    3: "it received a wrong CRC",
    4: "the value is out of range",
    5: "the length is wrong",
    6: "the value is beyond a limit",
    7: "it can't be written now (torque on, hardware error, or the bus watchdog has tripped)",
}
"""Meanings of the error numbers in a status packet."""


class BusFault(Enum):
    """Kind of a fault on the bus."""

    SILENT = "no reply"
    CORRUPT = "a corrupt reply"
    REFUSED = "refused"
    LOST = "the port is gone"


class BusError(RobotError):
    """A failed transaction.

    Attributes:
        kind: Kind of the fault.
        timed_out: Whether the wait for the reply ran out, so that (the rest of) it may still come.
    """

    def __init__(self, kind: BusFault, message: str, *, timed_out: bool = False) -> None:
        super().__init__(message)
        self.kind, self.timed_out = kind, timed_out


@dataclass(frozen=True, slots=True, kw_only=True)
class BusReply:
    """The data in a servo's reply, and whether the servo reports a hardware error (alert bit)."""

    data: bytes
    alert: bool


@dataclass(slots=True, kw_only=True)
class BusFaultCounts:
    """Transient faults from which the driver recovered since the bus was opened."""

    silent: int = 0
    corrupt: int = 0
    late: int = 0
    rewritten: int = 0
    rebuilt: int = 0

    def __str__(self) -> str:
        return (
            f"{self.silent} without a reply, {self.corrupt} corrupt, {self.late} late, "
            f"{self.rewritten} written again, port rebuilt {self.rebuilt} times"
        )
