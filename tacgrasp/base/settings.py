"""Base class of every section of the configuration.

Sections live beside what they configure: ``tacgrasp.config.schema`` for tasks, limits and the loop,
``tacgrasp.drivers`` for each device of a rig.
"""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import BaseModel, ConfigDict, Field, PrivateAttr

Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Interval = tuple[Number, Number]
Vector = tuple[Number, Number, Number]


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
