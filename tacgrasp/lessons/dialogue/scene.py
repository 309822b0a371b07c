"""What a question is asked about: a contact, the contract if there is one, and a mass if known.

``AskedScene.values`` are the names that the truth of a question is written in.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from cltp.tactile.sensors import SENSORS, SensorSpec
from cltp.tactile.states import NO_CONTACT_STATE, ContactState, Side
from policies.contract_steps import target_of
from policies.teacher import LESSON_MOVE_STEP_MM, Advice, Reason, teacher
from primitives.contract import (
    DEFAULT_AREA,
    DEFAULT_DEPTH_MM,
    Band,
    Contract,
    default_limit_n,
)

HOLDING_N_PER_G = 0.0205
"""Grip that surely holds a gram [N/g]. Source: two fingers with friction 0.3, the least of the
benchmark's draws, lifting at 2.5 m/s²: (9.81 + 2.5) / (2 · 0.3) mN."""

PER_GRAM = rf"(?:gram_n|{re.escape(str(HOLDING_N_PER_G))})"
"""Pattern of it in an expression: its name, or its value."""

LIFT, HOLD = "lift", "hold"
"""Values of ``action`` where no primitive is advised: the grasp is good, or nothing would help."""

Value = float | str | bool | None
"""Value of a name; None where it has none in this scene."""


class ForceBand(StrEnum):
    """The felt force against the contract's band."""

    BELOW = "below"
    WITHIN = "within"
    ABOVE = "above"


@dataclass(frozen=True, slots=True, kw_only=True)
class AskedScene:
    """A contact under a contract.

    Attributes:
        state: The contact.
        contract: The contract of the episode; None where none was made, or it is refused.
        mass_g: Mass of the object where somebody told it [g].
        told_limit_n: Limit that somebody told, which counts before the contract's [N].
        sensor: Sensor of the contact.
    """

    state: ContactState = NO_CONTACT_STATE
    contract: Contract | None = None
    mass_g: float | None = None
    told_limit_n: float | None = None
    sensor: SensorSpec = field(default_factory=lambda: SENSORS["gelsight_mini"])

    def __post_init__(self) -> None:
        if self.contract is not None and self.contract.refused:
            raise ValueError(f"a refused contract answers nothing: {self.contract.refused}")
        if self.mass_g is not None and not 0 < self.mass_g < math.inf:
            raise ValueError(f"a mass must be above 0 g and finite, got {self.mass_g:g} g")
        if self.told_limit_n is not None and not 0 < self.told_limit_n < math.inf:
            raise ValueError(f"a limit must be above 0 N and finite, got {self.told_limit_n:g} N")

    @property
    def advice(self) -> Advice | None:
        """What the teacher advises; None without a contract."""
        if self.contract is None:
            return None
        goal = target_of(self.contract)
        return teacher(self.state, goal, move_step_mm=LESSON_MOVE_STEP_MM)

    def values(self) -> Mapping[str, Value]:
        """Values by name; lengths in mm, forces in N, masses in g, the area in percent."""
        known = {
            "gram_n": HOLDING_N_PER_G,
            "pad_width_mm": self.sensor.width_mm,
            "pad_height_mm": self.sensor.height_mm,
        }
        return {**self._felt(), **self._agreed(), **known}

    def _felt(self) -> dict[str, Value]:
        state = self.state
        touched = state.in_contact
        force_n = state.force_n if math.isfinite(state.force_n) else None
        is_wide = abs(state.x_mm) > abs(state.y_mm)
        return {
            "contact": touched,
            "depth_mm": state.depth_mm,
            "x_mm": state.x_mm,
            "y_mm": state.y_mm,
            "area_percent": 100 * state.area_fraction,
            "area_mm2": state.area_fraction * self.sensor.area_mm2,
            "force_n": force_n,
            "shape": _word(state.shape),
            "texture": _word(state.texture),
            "depth": _word(state.depth),
            "position": _word(state.position),
            "area": _word(state.area),
            "cut": bool(state.cut),
            **{f"cut_{side}": side in state.cut for side in Side},
            "cut_sides": (" and ".join(s for s in Side if s in state.cut) or "none")
            if touched
            else None,
            "wholeness": ("cut" if state.cut else "whole") if touched else None,
            "side_x": ("left" if state.x_mm < 0 else "right") if touched else None,
            "side_y": ("fingertip" if state.y_mm < 0 else "palm") if touched else None,
            "worse_axis": ("horizontal" if is_wide else "vertical") if touched else None,
            "holds_g": None if force_n is None else force_n / HOLDING_N_PER_G,
        }

    def _agreed(self) -> dict[str, Value]:
        names = ("band_low_n", "band_high_n", "limit_n", "force_band", "action", "reason")
        advice = self.advice
        if self.contract is None or advice is None:
            known = {"limit_n": self.told_limit_n, "mass_g": self.mass_g}
            return {**dict.fromkeys(names), **known}
        terms, force_n = self.contract.terms, self.state.force_n
        band = terms.force_n
        side = (
            ForceBand.BELOW
            if force_n < band.low
            else ForceBand.ABOVE
            if force_n > band.high
            else ForceBand.WITHIN
        )
        return {
            "band_low_n": band.low,
            "band_high_n": band.high,
            "limit_n": terms.limit_n,
            "force_band": side.value if math.isfinite(force_n) else None,
            "action": action_word(advice),
            "reason": advice.reason.value,
            "mass_g": self.mass_g,
        }


REASONS = tuple(reason.value for reason in Reason)
"""Values of ``reason``."""


def action_word(advice: Advice) -> str:
    """A primitive's name, ``LIFT`` on success, else ``HOLD``."""
    if advice.action is not None:
        return advice.action.value
    return LIFT if advice.success else HOLD


def band_contract(low_n: float, high_n: float, limit_n: float | None = None) -> Contract:
    """A contract of a force band [N], with the place of the tasks and no demand on depth and area.

    Raises:
        LimitError: The band is not positive, or reaches above the limit.
    """
    band = Band(low=low_n, high=high_n)
    return Contract(
        text="",
        summary="hold it",
        force_n=band,
        limit_n=default_limit_n(band) if limit_n is None else limit_n,
        slip_mm=1.0,
        x_mm=Band(low=-4.0, high=4.0),
        y_mm=Band(low=-3.0, high=3.0),
        depth_mm=DEFAULT_DEPTH_MM,
        area_fraction=DEFAULT_AREA,
    )


def _word(word: StrEnum | None) -> str | None:
    return None if word is None else word.value


NAMES = tuple(AskedScene().values())
"""Names that a truth may use."""
