"""Hard limits of a rig's file: task, environment and flags may narrow them, never widen them.

Not here: checking commands against the limits (``primitives.limits``).
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from tacgrasp.base.errors import UsageError
from tacgrasp.config.schema import ArmConfig, GripperConfig, RunConfig

_Comparison = Callable[[Any, Any], bool]

_AT_MOST: tuple[_Comparison, str] = (operator.le, "at most")
_AT_LEAST: tuple[_Comparison, str] = (operator.ge, "at least")

LIMITS: Mapping[str, tuple[_Comparison, str]] = {
    "arm.workspace_low_m": _AT_LEAST,
    "arm.workspace_high_m": _AT_MOST,
    "arm.max_step_mm": _AT_MOST,
    "arm.max_travel_mm": _AT_MOST,
    "arm.max_speed_m_s": _AT_MOST,
    "gripper.min_force_n": _AT_LEAST,
    "gripper.max_force_n": _AT_MOST,
    "gripper.first_force_n": _AT_MOST,
    "gripper.max_force_gain": _AT_LEAST,  # a smaller one lets larger commands through
}
"""Every limit, with the allowed side of the file's value. Where the file has none
(``first_force_n`` of a simulated world), nothing is bounded; a number in it can't become None."""


@dataclass(frozen=True, slots=True)
class HardLimits:
    """Limits of a rig's file, or the model's defaults where the file has none."""

    arm: ArmConfig
    gripper: GripperConfig

    def check(self, config: RunConfig, source_of: Callable[[str], str]) -> None:
        """Refuse a configuration that is wider than the rig's file.

        Args:
            config: Configuration after environment or flags.
            source_of: Returns the source of a dotted path's value.

        Raises:
            UsageError: A limit is wider; the message names it, both values and the file to change.
        """
        for path, (is_within, side) in LIMITS.items():
            section, field = path.split(".")
            hard = getattr(getattr(self, section), field)
            value = getattr(getattr(config, section), field)
            if hard is None:
                continue
            if value is None or not all(
                is_within(a, b) for a, b in zip(_numbers(value), _numbers(hard), strict=True)
            ):
                raise UsageError(
                    f"{source_of(path)}: {path} must be {side} the rig's hard limit {_text(hard)}, "
                    f"got {_text(value)}; limits can be narrowed here, and widened only in the "
                    f"rig's file ({config.rig})"
                )


def _numbers(value: float | tuple[float, ...]) -> tuple[float, ...]:
    return value if isinstance(value, tuple) else (value,)


def _text(value: float | tuple[float, ...] | None) -> str:
    if value is None:
        return "none"
    numbers = ", ".join(f"{number:g}" for number in _numbers(value))
    return f"[{numbers}]" if isinstance(value, tuple) else numbers
