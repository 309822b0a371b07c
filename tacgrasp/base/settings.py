"""Base class of every section of the configuration.

Sections live beside what they configure: ``tacgrasp.config.schema`` for tasks, limits and the loop,
``tacgrasp.drivers`` for each device of a rig.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Interval = tuple[Number, Number]
Vector = tuple[Number, Number, Number]


class SettingsBase(BaseModel):
    """A section of the configuration; unknown fields are refused."""

    model_config = ConfigDict(extra="forbid", frozen=True)
