"""The reaction to one injected fault, and the limits that it has to keep.

Not here: the injection (``tacgrasp.benchmarks.faults.injection``).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tacgrasp.benchmarks.faults.cases import FaultCase
from tacgrasp.rig.hardware import HardwareRig

REFUSED_S = 2.0
STOPPED_MS, LOADED_MS = 150.0, 250.0
RECOVERED_MS = 100.0
"""Longest permitted times: refusal at the start, rest in motion (also with all cores busy, which
holds for the recovery too), recovery of a transient fault."""


@dataclass(frozen=True, slots=True, kw_only=True)
class InjectionResult:
    """The reaction to one injected fault.

    Attributes:
        detected: The driver reported the fault as expected, in time.
        message: Message to the operator.
        noticed_ms: Time from the injection until the program noticed, by holding the arm or by a
            fault [ms]; for a fault at the start the time of the refusal, for a transient fault, the
            time to the next good value.
        stop_ms: Time from the injection until the arm was at rest [ms], by the emulator; None
            without a motion.
        moved: Arm or fingers moved although they must not, or did not stop.
        hung: A call did not return.
        invented: A value was returned that was not measured.
        episode: State of the recorded episode; '' without one.
        spurious: Another fault was reported than the injected one, or one before it.
    """

    detected: bool
    message: str
    noticed_ms: float
    stop_ms: float | None = None
    moved: bool = False
    hung: bool = False
    invented: bool = False
    episode: str = ""
    spurious: bool = False


def is_expected(case: FaultCase, message: str) -> bool:
    """Whether a message tells of the fault."""
    return any(word.lower() in message.lower() for word in case.expected)


def noticed_s(rig: HardwareRig, injected_s: float, ended_s: float) -> float:
    """Time at which the rig held the arm or ended its move, whichever came first [s]."""
    held_s = float("nan") if rig.guard is None else rig.guard.last_hold_s
    return held_s if injected_s <= held_s < ended_s else ended_s


def read_device(rig: HardwareRig, device: str) -> NDArray[np.float64]:
    """Measured values of a device: position of the tool [m], opening [m], or heights [mm]."""
    if device == "ur":
        return rig.arm.pose().position_m
    if device == "dynamixel":
        return np.array([rig.gripper.state().width_m])
    return np.array(rig.sensor.read().points_mm[:, 2], dtype=np.float64)
