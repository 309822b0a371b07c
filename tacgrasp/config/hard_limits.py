"""What a rig's file allows is final: environment and flags may narrow its limits, never widen them.

Not here: holding commands to the limits (``primitives.limits``).
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from typing import Any

from tacgrasp.base.errors import UsageError
from tacgrasp.config.schema import ArmConfig, GripperConfig, RunConfig

_Holds = Callable[[Any, Any], bool]

_AT_MOST: tuple[_Holds, str] = (operator.le, "at most")
_AT_LEAST: tuple[_Holds, str] = (operator.ge, "at least")

LIMITS: Mapping[str, tuple[_Holds, str]] = {
    "arm.workspace_low_m": _AT_LEAST,
    "arm.workspace_high_m": _AT_MOST,
    "arm.max_step_mm": _AT_MOST,
    "arm.max_travel_mm": _AT_MOST,
    "arm.max_speed_m_s": _AT_MOST,
    "gripper.min_force_n": _AT_LEAST,
    "gripper.max_force_n": _AT_MOST,
}
"""Every limit, and on which side of the file's value another may lie."""


class HardLimits:
    """The limits of a rig's file, with the model's own where the file has none."""

    def __init__(self, arm: ArmConfig, gripper: GripperConfig) -> None:
        self._sections: Mapping[str, ArmConfig | GripperConfig] = {"arm": arm, "gripper": gripper}

    def check(self, config: RunConfig, where: Callable[[str], str]) -> None:
        """Refuse a configuration that is wider than the rig's file.

        Args:
            config: After environment or flags.
            where: Says of a dotted path where its value came from.

        Raises:
            UsageError: A limit is wider; names it, both values and where to change it.
        """
        for path, (holds, side) in LIMITS.items():
            section, field = path.split(".")
            hard = getattr(self._sections[section], field)
            given = getattr(getattr(config, section), field)
            pairs = zip(_numbers(given), _numbers(hard), strict=True)
            if not all(holds(a, b) for a, b in pairs):
                raise UsageError(
                    f"{where(path)}: {path} must be {side} the rig's hard limit {_shown(hard)}, "
                    f"got {_shown(given)}; limits can be narrowed here, and widened only in the "
                    f"rig's file ({config.rig})"
                )


def _numbers(value: float | tuple[float, ...]) -> tuple[float, ...]:
    return value if isinstance(value, tuple) else (value,)


def _shown(value: float | tuple[float, ...]) -> str:
    numbers = ", ".join(f"{number:g}" for number in _numbers(value))
    return f"[{numbers}]" if isinstance(value, tuple) else numbers
