"""The faults that drivers must survive, refuse or stop for: the rows of the fault matrix.

Each names what an emulator is told to do and what the driver has to say about it. Not here:
injecting and timing them (``tacgrasp.benchmarks.faults.injection``).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from types import MappingProxyType


class InjectionPhase(StrEnum):
    """When a fault happens, and what must come of it."""

    START = "start"  # before connecting: refused within 2 s, nothing moves
    MOTION = "motion"  # while the arm moves: at rest within 150 ms, the driver says why
    TRANSIENT = "transient"  # passes: survived within 100 ms, counted, the arm moves on


@dataclass(frozen=True, slots=True, kw_only=True)
class FaultCase:
    """One fault.

    Attributes:
        name: Of the row.
        device: Emulated device that it happens to: ur, dynamixel or taxels.
        fault: As the emulator calls it.
        phase: When it happens.
        told: Words of which one must be in what the operator is told; for a transient fault, in
            the count of what was survived.
        details: Of the fault.
    """

    name: str
    device: str
    fault: str
    phase: InjectionPhase
    told: tuple[str, ...]
    details: Mapping[str, float | str] = field(default_factory=lambda: MappingProxyType({}))


def _start(name: str, device: str, fault: str, *told: str, **details: float | str) -> FaultCase:
    return FaultCase(
        name=name,
        device=device,
        fault=fault,
        phase=InjectionPhase.START,
        told=told,
        details=details,
    )


def _motion(name: str, device: str, fault: str, *told: str, **details: float | str) -> FaultCase:
    return FaultCase(
        name=name,
        device=device,
        fault=fault,
        phase=InjectionPhase.MOTION,
        told=told,
        details=details,
    )


def _transient(name: str, device: str, fault: str, *told: str) -> FaultCase:
    return FaultCase(
        name=name, device=device, fault=fault, phase=InjectionPhase.TRANSIENT, told=told
    )


STALE_BACKGROUND = "sensor: stale background"
"""Needs no emulator: a GelSight Mini whose background is too old, refused before it is opened."""

CASES: tuple[FaultCase, ...] = (
    _start("UR: mute at connect", "ur", "mute", "said nothing", "silent"),
    _start("UR: garbage at connect", "ur", "garbage", "no UR", "expected", "not"),
    _start("UR: wrong version", "ur", "wrong_version", "version", "10.8"),
    _start("UR: local control", "ur", "local_control", "remote"),
    _start("UR: speed slider at 0", "ur", "speed_slider", "speed"),
    _start("UR: register in use", "ur", "register_in_use", "in use", "another"),
    _motion("UR: link drop", "ur", "link_drop", "lost", "link", "connection"),
    _motion("UR: freeze", "ur", "freeze", "old", "stale", "data", "frozen"),
    _motion("UR: protective stop", "ur", "protective_stop", "protective"),
    _motion("UR: safeguard stop", "ur", "safeguard_stop", "safeguard"),
    _motion("UR: emergency stop", "ur", "emergency_stop", "emergency"),
    _motion("UR: program stopped", "ur", "program_stopped", "program"),
    _motion(
        "UR: controller restart", "ur", "controller_restart", "lost", "link", "mode", "restart"
    ),
    _motion("UR: contact force", "ur", "contact_force", "force"),
    _start("gripper: wrong model", "dynamixel", "wrong_model", "model"),
    _start("gripper: wrong baud", "dynamixel", "wrong_baud", "baud", garbage=1),
    _start("gripper: port taken", "dynamixel", "port_taken", "another program", "taken", "lock"),
    _motion("gripper: silence", "dynamixel", "silence", "does not answer"),
    _motion("gripper: alert", "dynamixel", "alert", "hardware error"),
    _motion("gripper: overload shutdown", "dynamixel", "overload", "overload"),
    _motion("gripper: over-temperature", "dynamixel", "over_temperature", "heat", "hot", "°C"),
    _motion("gripper: unplugged", "dynamixel", "unplug", "gone", "unplugged"),
    _transient("gripper: single CRC error", "dynamixel", "bad_crc", "corrupt"),
    _transient("gripper: late reply", "dynamixel", "late_reply", "late"),
    _transient("gripper: partial reply", "dynamixel", "partial_reply", "corrupt", "silent"),
    _start("sensor: unplugged at start", "taxels", "unplugged", "port", "no serial"),
    _start(STALE_BACKGROUND, "", "", "ago, expected"),
    _motion("sensor: stall", "taxels", "stall", "no fresh frame"),
    _motion("sensor: black frames", "taxels", "black", "dead or dark"),
    _transient("sensor: torn packet", "taxels", "torn", "damaged"),
)
"""Every fault that an emulator can show, in the order of the table."""
