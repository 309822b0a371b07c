"""Base class of every section of the configuration.

Sections live beside what they configure: ``tacgrasp.config.schema`` for tasks, limits and the loop,
``tacgrasp.drivers`` for each device of a rig.
"""

from __future__ import annotations

import math
from typing import Annotated, Self

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, PrivateAttr

Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Interval = tuple[Number, Number]
Vector = tuple[Number, Number, Number]

MOST_OFFSET_M = 1.0
"""Longest offset from the flange [m]: a longer one is in millimetres."""

MOST_TURN_RAD = 2 * math.pi
"""Longest rotation vector [rad]: a longer one is in degrees."""


def _in_metres(offset: Vector) -> Vector:
    if math.hypot(*offset) > MOST_OFFSET_M:
        raise ValueError(f"is longer than {MOST_OFFSET_M:g} m; is it in metres?")
    return offset


def _in_radians(turn: Vector) -> Vector:
    if math.hypot(*turn) > MOST_TURN_RAD:
        raise ValueError("turns by more than a whole turn; is it in radians?")
    return turn


FlangeOffset = Annotated[Vector, AfterValidator(_in_metres)]
"""Position in the flange frame [m]."""

RotationVector = Annotated[Vector, AfterValidator(_in_radians)]
"""Rotation vector [rad]."""


class SettingsBase(BaseModel):
    """A section of the configuration; unknown fields are refused."""

    model_config = ConfigDict(extra="forbid", frozen=True)
    _emulated: bool = PrivateAttr(default=False)

    @property
    def is_emulated(self) -> bool:
        """Whether this section names an emulated device; never set by a file or a flag."""
        return self._emulated

    def for_emulator(self, **changes: object) -> Self:
        """A changed copy of a device's section, which names its emulator."""
        copy = self.model_copy(update=changes)
        copy._emulated = True
        return copy
