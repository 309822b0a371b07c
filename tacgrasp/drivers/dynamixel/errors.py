"""What a transaction with a servo may come to: an answer, or one of four kinds of trouble."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from primitives.errors import RobotError

_ERRORS = {
    1: "it failed",
    2: "it does not know the instruction",
    3: "it received a wrong CRC",
    4: "the value is out of range",
    5: "the length is wrong",
    6: "the value is beyond a limit",
    7: "it can't be written now (torque on, hardware error, or the bus watchdog has tripped)",
}


class Trouble(Enum):
    """What went wrong on the bus."""

    SILENT = "no answer"
    CORRUPT = "a corrupt answer"
    REFUSED = "refused"
    LOST = "the port is gone"


class BusError(RobotError):
    """A transaction failed.

    Attributes:
        trouble: How.
        waited: The time for an answer ran out, so that (the rest of) one may still come.
    """

    def __init__(self, trouble: Trouble, message: str, *, waited: bool = False) -> None:
        super().__init__(message)
        self.trouble, self.waited = trouble, waited


@dataclass(frozen=True, slots=True, kw_only=True)
class Answer:
    """What a servo answered: its data, and whether it reports a hardware error."""

    data: bytes
    alert: bool


@dataclass(slots=True, kw_only=True)
class Counts:
    """Transient faults that were survived since the bus was opened."""

    silent: int = 0
    corrupt: int = 0
    late: int = 0
    rewritten: int = 0
    rebuilt: int = 0

    def __str__(self) -> str:
        return (
            f"{self.silent} without an answer, {self.corrupt} corrupt, {self.late} late, "
            f"{self.rewritten} written again, port rebuilt {self.rebuilt} times"
        )


def refusal_words(number: int) -> str:
    """What the error number of a status packet says."""
    return _ERRORS.get(number, f"error {number}")
