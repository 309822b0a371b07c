"""What every part of the configuration is made of: a model that refuses what it does not know.

Parts live beside what they configure: ``tacgrasp.config.schema`` for tasks, limits and the loop,
``tacgrasp.drivers`` for each device of a rig.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Interval = tuple[Number, Number]
Vector = tuple[Number, Number, Number]


class Section(BaseModel):
    """A part of the configuration: refuses fields that it does not know."""

    model_config = ConfigDict(extra="forbid", frozen=True)
