"""Checks of a gripper's servos before they may move; nothing is written to the servos here.

A failed check refuses the start; ``tacgrasp doctor`` prints all of them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from tacgrasp.drivers.check import Finding
from tacgrasp.drivers.dynamixel import registers as reg
from tacgrasp.drivers.dynamixel.bus import Bus
from tacgrasp.drivers.dynamixel.errors import BusError, BusFault
from tacgrasp.drivers.dynamixel.settings import BAUDS, DynamixelSettings, ServoSettings

WIZARD = "with the DYNAMIXEL Wizard"
_MARGIN_FRACTION = 0.1  # of the travel; a servo may stand so far outside of it


class _Check(NamedTuple):
    """Result of one check; the advice is used when ``ok`` is False."""

    name: str
    ok: bool
    detail: str
    advice: str


def startup_findings(bus: Bus, settings: DynamixelSettings) -> Sequence[Finding]:
    """Check every servo; a servo that is missing or of another model gets no further checks."""
    findings: list[Finding] = []
    for servo in settings.servos:
        model = _model(bus, settings, servo)
        findings.append(_finding(servo, model))
        if model.ok:
            findings += [_finding(servo, check(bus, settings, servo)) for check in _CHECKS]
    return findings


def _finding(servo: ServoSettings, check: _Check) -> Finding:
    return Finding(
        device="gripper",
        name=f"servo {servo.id} {check.name}",
        ok=check.ok,
        detail=check.detail,
        advice="" if check.ok else check.advice,
    )


def _model(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> _Check:
    try:
        number = bus.ping(servo.id)
    except BusError as error:
        if error.kind is BusFault.LOST:
            raise
        detail = f"expected {settings.model} at id {servo.id}, {settings.baud} baud; {error}"
        return _Check("model", False, detail, _search_other_bauds(bus, settings, servo))
    expected = reg.MODELS[settings.model].number
    if number in reg.WITHOUT_CURRENT:
        advice = (
            "this model has no current control and can't hold a force; use one of "
            + ", ".join(sorted(reg.MODELS))
        )
    else:
        advice = "give the rig's file the right model and id, or mount the right servo"
    detail = reg.model_name(number)
    if number != expected:
        detail += f", expected {settings.model}"
    return _Check("model", number == expected, detail, advice)


def _search_other_bauds(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> str:
    """Advice for a silent servo: ping it at the other baud rates, without patience for each."""
    bus.arm_is_moving = lambda: True
    for baud in BAUDS:
        if baud == settings.baud:
            continue
        try:
            bus.open(baud)
            bus.ping(servo.id)
        except BusError as error:
            if error.kind is BusFault.LOST:
                raise
            continue
        finally:
            bus.open()
        return f"it answers at {baud} baud: give the rig's file baud: {baud}"
    return (
        "it answers at no other baud rate either; check that the power is on, the cable, the id, "
        "and that the port is the gripper's"
    )


def _firmware(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> _Check:
    version = bus.read_number(servo.id, reg.FIRMWARE, 1)
    return _Check(
        "firmware",
        version >= reg.WATCHDOG_FIRMWARE,
        f"version {version}, {reg.WATCHDOG_FIRMWARE} or later is needed for the bus watchdog",
        f"update it {WIZARD}",
    )


def _mode(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> _Check:
    mode, expected = bus.read_number(servo.id, reg.OPERATING_MODE, 1), reg.CURRENT_BASED_POSITION
    return _Check(
        "operating mode",
        mode == expected,
        f"{mode}, expected {expected} (current-based position)",
        f"set register {reg.OPERATING_MODE} to {expected} {WIZARD}, torque off",
    )


def _drive_mode(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> _Check:
    mode = bus.read_number(servo.id, reg.DRIVE_MODE, 1)
    wrong_bits = mode & (reg.TIME_BASED | reg.TORQUE_BY_GOAL)
    return _Check(
        "drive mode",
        not wrong_bits,
        f"{mode:#04x}, expected a velocity-based profile and no torque-on by goal (bits 2, 3 off)",
        f"set register {reg.DRIVE_MODE} to {mode & ~wrong_bits} {WIZARD}, torque off",
    )


def _status_return(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> _Check:
    level = bus.read_number(servo.id, reg.STATUS_RETURN, 1)
    detail = f"{level}, expected 2 (every instruction is answered)"
    advice = f"set register {reg.STATUS_RETURN} to 2 {WIZARD}"
    return _Check("status return level", level == 2, detail, advice)


def _shutdown(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> _Check:
    mask = bus.read_number(servo.id, reg.SHUTDOWN, 1)
    missing = reg.NEEDED_SHUTDOWN & ~mask
    detail = f"{mask:#04x}"
    if missing:
        detail += f", it would not let go when {reg.hardware_error_text(missing)}"
    advice = f"set register {reg.SHUTDOWN} to {mask | missing} {WIZARD}, torque off"
    return _Check("shutdown mask", not missing, detail, advice)


def _current_limit(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> _Check:
    unit_ma = reg.MODELS[settings.model].unit_ma
    limit_ma = bus.read_number(servo.id, reg.CURRENT_LIMIT, 2) * unit_ma
    return _Check(
        "current limit",
        limit_ma >= settings.max_current_ma,
        f"{limit_ma:.0f} mA, max_current_ma is {settings.max_current_ma:.0f}",
        f"lower max_current_ma in the rig's file, or raise register {reg.CURRENT_LIMIT} {WIZARD}",
    )


def _hardware_error(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> _Check:
    error = bus.read_number(servo.id, reg.HARDWARE_ERROR, 1)
    advice = "remove the cause, then reboot the servo or switch its power off and on"
    return _Check("hardware error", error == 0, reg.hardware_error_text(error) or "none", advice)


def _voltage(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> _Check:
    volts, low, high = (
        0.1 * bus.read_number(servo.id, address, 2)
        for address in (reg.VOLTAGE, reg.MIN_VOLTAGE, reg.MAX_VOLTAGE)
    )
    detail = f"{volts:.1f} V, allowed {low:.1f} to {high:.1f} V"
    advice = "check the power supply, its cable and its rating"
    return _Check("voltage", low <= volts <= high, detail, advice)


def _temperature(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> _Check:
    celsius, limit_c = bus.read_number(servo.id, reg.TEMPERATURE, 1), settings.max_temperature_c
    detail = f"{celsius} °C, at most {limit_c:g} °C"
    advice = "let it cool; if it is cold to the touch, its sensor is broken"
    return _Check("temperature", celsius <= limit_c, detail, advice)


def _position(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> _Check:
    """The position must lie in the travel: mode 5 ignores limits, and a reboot loses the turns."""
    ticks = bus.read_number(servo.id, reg.PRESENT_POSITION, 4, signed=True)
    low, high = sorted((servo.open_ticks, servo.closed_ticks))
    margin = round(_MARGIN_FRACTION * (high - low))
    return _Check(
        "position",
        low - margin <= ticks <= high + margin,
        f"{ticks} ticks, its travel is {low} to {high}",
        "the turn count is lost on a reboot, or the linkage has moved: with torque off turn the "
        "fingers into their travel, and check open_ticks and closed_ticks",
    )


_CHECKS: Sequence[Callable[[Bus, DynamixelSettings, ServoSettings], _Check]] = (
    _firmware,
    _mode,
    _drive_mode,
    _status_return,
    _shutdown,
    _current_limit,
    _hardware_error,
    _voltage,
    _temperature,
    _position,
)
