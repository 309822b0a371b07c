"""The registry of the fault benchmark: one entry per fault, with its injection and expectation.

A new fault needs its effect in the emulator of its device (``sim.emulators``), an entry here, and
the driver's reaction, where the driver has none yet. Not here: injection and timing
(``tacgrasp.benchmarks.faults.injection``).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from functools import partial
from types import MappingProxyType


class InjectionPhase(StrEnum):
    """When a fault is injected, and what is required then."""

    START = "start"  # before connecting: refused within 2 s, nothing moves
    MOTION = "motion"  # while the arm moves: at rest within 150 ms, the driver names the reason
    TRANSIENT = "transient"  # passes: survived within 100 ms, counted, the arm moves on


@dataclass(frozen=True, slots=True, kw_only=True)
class FaultCase:
    """One fault.

    Attributes:
        name: Row of the table.
        phase: Time of the injection.
        device: Device with the fault: ur, dynamixel or taxels, all emulated, or gelsight, with
            a file for its only fault.
        fault: Name of the fault in the device's emulator.
        expected: Words, one of which must be in the message to the operator; for a transient fault,
            in the driver's fault counts.
        details: Details of the fault for the emulator.
        holding: Whether the fingers grip the object when the fault comes.
    """

    name: str
    phase: InjectionPhase
    device: str
    fault: str
    expected: tuple[str, ...]
    details: Mapping[str, float | str]
    holding: bool = False


def _case(
    phase: InjectionPhase,
    name: str,
    device: str,
    fault: str,
    *expected: str,
    holding: bool = False,
    **details: float,
) -> FaultCase:
    return FaultCase(
        name=name,
        phase=phase,
        device=device,
        fault=fault,
        expected=expected,
        details=MappingProxyType(details),
        holding=holding,
    )


_start = partial(_case, InjectionPhase.START)
_motion = partial(_case, InjectionPhase.MOTION)
_transient = partial(_case, InjectionPhase.TRANSIENT)

CASES: tuple[FaultCase, ...] = (
    _start("UR: mute at connect", "ur", "mute", "said nothing", "silent"),
    _start("UR: garbage at connect", "ur", "garbage", "no UR", "expected", "not"),
    _start("UR: wrong version", "ur", "wrong_version", "version", "10.8"),
    _start("UR: local control", "ur", "local_control", "remote"),
    _start("UR: speed slider at 0", "ur", "speed_slider", "speed"),
    _start("UR: register in use", "ur", "register_in_use", "in use", "another"),
    _motion("UR: link drop", "ur", "link_drop", "lost", "link", "connection"),
    _motion("UR: freeze", "ur", "freeze", "old", "stale", "data", "frozen", "hung"),
    _motion("UR: protective stop", "ur", "protective_stop", "protective"),
    _motion("UR: safeguard stop", "ur", "safeguard_stop", "safeguard"),
    _motion("UR: emergency stop", "ur", "emergency_stop", "emergency"),
    _motion("UR: program stopped", "ur", "program_stopped", "program"),
    _motion(
        "UR: controller restart", "ur", "controller_restart", "lost", "link", "mode", "restart"
    ),
    _motion("UR: contact force", "ur", "contact_force", "contact force"),
    _motion("UR: force not a number", "ur", "not_finite", "not finite"),
    _start("gripper: wrong model", "dynamixel", "wrong_model", "model"),
    _start("gripper: wrong baud", "dynamixel", "wrong_baud", "baud", garbage=1),
    _start("gripper: port taken", "dynamixel", "port_taken", "another program", "taken", "lock"),
    _motion("gripper: silence", "dynamixel", "silence", "does not answer"),
    _motion("gripper: alert", "dynamixel", "alert", "hardware error"),
    _motion("gripper: overload shutdown", "dynamixel", "overload", "overload"),
    _motion("gripper: over-temperature", "dynamixel", "over_temperature", "heat", "hot", "°C"),
    _motion(
        "gripper: truncated replies", "dynamixel", "partial_reply", "half a packet", count=1000
    ),
    _motion("gripper: restart while holding", "dynamixel", "reboot", "restarted", holding=True),
    _motion("gripper: unplugged", "dynamixel", "unplug", "gone", "unplugged"),
    _transient("gripper: single CRC error", "dynamixel", "bad_crc", "corrupt"),
    _transient("gripper: late reply", "dynamixel", "late_reply", "late"),
    _transient("gripper: partial reply", "dynamixel", "partial_reply", "corrupt", "silent"),
    _start("sensor: unplugged at start", "taxels", "unplugged", "port", "no serial"),
    _start("sensor: stale background", "gelsight", "stale_background", "ago, expected"),
    _motion("sensor: stall", "taxels", "stall", "no fresh frame"),
    _motion("sensor: black frames", "taxels", "black", "dead or dark"),
    _transient("sensor: torn packet", "taxels", "torn", "damaged"),
)
"""All faults, in the order of the table."""
