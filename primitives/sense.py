"""What the executor is told by touch while it closes: contact or none, and the force that is felt.

``primitives`` imports nothing of ours; the runtime gives the functions.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from primitives.errors import LimitError


@dataclass(frozen=True, slots=True, kw_only=True)
class Interval:
    """A reading with its uncertainty; the unit is in the name of the quantity.

    Attributes:
        value: Best estimate.
        low, high: Bounds that hold the true value in about nine cases of ten.

    Raises:
        LimitError: A number is not finite, or they are not in order.
    """

    value: float
    low: float
    high: float

    def __post_init__(self) -> None:
        numbers = (self.low, self.value, self.high)
        if not all(map(math.isfinite, numbers)) or not self.low <= self.value <= self.high:
            raise LimitError(f"an interval needs finite low <= value <= high, got {numbers}")


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactSense:
    """Touch during a closing.

    Attributes:
        take_reference: Takes the gel as it is as untouched; called with open fingers.
        in_contact: Reads one new frame; whether something touches the gel.
        felt_force: Force in that frame [N]; None without contact or without a reading.
    """

    take_reference: Callable[[], None]
    in_contact: Callable[[], bool]
    felt_force: Callable[[], Interval | None]
