"""Result of one check of a device, for ``tacgrasp doctor``."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

EMULATOR_ADVICE = (
    "it is an emulator on this computer, which had no time for it or has ended it: end other work "
    "and start again"
)
"""What to do about a silent device that is emulated: it has no cable."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """Result of one check.

    Attributes:
        device: Device: arm, gripper, sensor, or a part of the rig's file.
        name: Name of the check.
        ok: Whether the check has passed.
        detail: Measured or read values, with units.
        advice: What to do; required when ``ok`` is False.

    Raises:
        ValueError: A failed check without advice.
    """

    device: str
    name: str
    ok: bool
    detail: str
    advice: str = ""

    def __post_init__(self) -> None:
        if not self.ok and not self.advice:
            raise ValueError(f"{self.device} {self.name}: no advice for {self.detail!r}")


def finding(device: str, name: str, ok: bool, detail: str, advice: str = "") -> Finding:
    """A finding; its advice is dropped when the check has passed."""
    return Finding(device=device, name=name, ok=ok, detail=detail, advice="" if ok else advice)


def force_limit_problem(max_force_n: float, device_n: float) -> str:
    """Why a rig's largest force does not fit its gripper; empty where it does.

    Args:
        max_force_n: The rig's ``gripper.max_force_n`` [N].
        device_n: Largest force that the gripper can be commanded [N].
    """
    if max_force_n <= device_n:
        return ""
    return (
        f"gripper.max_force_n {max_force_n:g} N is beyond this gripper, whose calibration and "
        f"current allow {device_n:.2f} N; lower it in the rig's file"
    )


def force_limit_finding(max_force_n: float, device_n: float) -> Finding:
    """Whether a rig's largest force fits its gripper; the arguments of ``force_limit_problem``."""
    problem = force_limit_problem(max_force_n, device_n)
    detail = f"{max_force_n:g} N at most, of {device_n:.2f} N that the gripper can make"
    advice = f"a run is refused: {problem}"
    return finding("gripper", "largest force", not problem, detail, advice)


def read_durations_ms(read: Callable[[], object], count: int) -> tuple[float, float, float]:
    """Median, 99 % quantile and maximum of the durations of ``count`` reads [ms]."""
    durations_ms = []
    for _ in range(count):
        start_s = time.perf_counter()
        read()
        durations_ms.append(1e3 * (time.perf_counter() - start_s))
    p50, p99, longest = np.percentile(durations_ms, [50, 99, 100])
    return float(p50), float(p99), float(longest)
