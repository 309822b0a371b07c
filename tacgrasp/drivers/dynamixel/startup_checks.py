"""Checks of a gripper's servos before they may move; nothing is written to the servos here.

A failed check refuses the start; ``tacgrasp doctor`` prints all of them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from tacgrasp.drivers.check import Finding, finding
from tacgrasp.drivers.dynamixel import registers as reg
from tacgrasp.drivers.dynamixel.bus import Bus
from tacgrasp.drivers.dynamixel.errors import BusError, BusFault
from tacgrasp.drivers.dynamixel.settings import BAUDS, DynamixelSettings, ServoSettings

WIZARD = "with the DYNAMIXEL Wizard"
_MARGIN_FRACTION = 0.1  # of the travel; a servo may stand so far outside of it

_Check = tuple[str, bool, str, str]
"""Name, whether it has passed, read values, and the advice for a failed check."""


def startup_findings(bus: Bus, settings: DynamixelSettings) -> Sequence[Finding]:
    """Check every servo; a servo that is missing or of another model gets no further checks."""
    findings: list[Finding] = []
    for servo in settings.servos:
        checks = [_model(bus, settings, servo)]
        if checks[0][1]:
            checks += [*_configuration(bus, servo), *_condition(bus, settings, servo)]
        findings += [
            finding("gripper", f"servo {servo.id} {name}", ok, detail, advice)
            for name, ok, detail, advice in checks
        ]
    return findings


def _model(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> _Check:
    try:
        number = bus.ping(servo.id)
    except BusError as error:
        if error.kind is BusFault.LOST:
            raise
        detail = f"expected {settings.model} at id {servo.id}, {settings.baud} baud; {error}"
        return "model", False, detail, _search_other_bauds(bus, settings, servo)
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
    return "model", number == expected, detail, advice


def _search_other_bauds(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> str:
    """Advice for a silent servo: ping it at the other baud rates, without patience for each."""
    bus.patience_s = 0.0
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


def _configuration(bus: Bus, servo: ServoSettings) -> Iterator[_Check]:
    """Registers that a person sets once."""
    version = bus.read_number(servo.id, reg.FIRMWARE, 1)
    detail = f"version {version}, {reg.WATCHDOG_FIRMWARE} or later is needed for the bus watchdog"
    yield "firmware", version >= reg.WATCHDOG_FIRMWARE, detail, f"update it {WIZARD}"

    mode, expected = bus.read_number(servo.id, reg.OPERATING_MODE, 1), reg.CURRENT_BASED_POSITION
    detail = f"{mode}, expected {expected} (current-based position)"
    advice = f"set register {reg.OPERATING_MODE} to {expected} {WIZARD}, torque off"
    yield "operating mode", mode == expected, detail, advice

    mode = bus.read_number(servo.id, reg.DRIVE_MODE, 1)
    wrong = mode & (reg.TIME_BASED | reg.TORQUE_BY_GOAL)
    detail = f"{mode:#04x}, expected a velocity-based profile and no torque-on by goal"
    advice = f"set register {reg.DRIVE_MODE} to {mode & ~wrong} {WIZARD}, torque off"
    yield "drive mode", not wrong, f"{detail} (bits 2, 3 off)", advice

    level = bus.read_number(servo.id, reg.STATUS_RETURN, 1)
    detail = f"{level}, expected 2 (every instruction is answered)"
    advice = f"set register {reg.STATUS_RETURN} to 2 {WIZARD}"
    yield "status return level", level == 2, detail, advice

    mask = bus.read_number(servo.id, reg.SHUTDOWN, 1)
    detail = f"{mask:#04x}"
    if missing := reg.NEEDED_SHUTDOWN & ~mask:
        detail += f", it would not let go when {reg.hardware_error_text(missing)}"
    advice = f"set register {reg.SHUTDOWN} to {mask | missing} {WIZARD}, torque off"
    yield "shutdown mask", not missing, detail, advice


def _condition(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> Iterator[_Check]:
    """Limits and present state, compared with the settings."""
    limit_ma = bus.read_number(servo.id, reg.CURRENT_LIMIT, 2) * reg.MODELS[settings.model].unit_ma
    detail = f"{limit_ma:.0f} mA, max_current_ma is {settings.max_current_ma:.0f}"
    advice = f"lower max_current_ma in the rig's file, or raise register {reg.CURRENT_LIMIT}"
    yield "current limit", limit_ma >= settings.max_current_ma, detail, f"{advice} {WIZARD}"

    error = bus.read_number(servo.id, reg.HARDWARE_ERROR, 1)
    advice = "remove the cause, then reboot the servo or switch its power off and on"
    yield "hardware error", error == 0, reg.hardware_error_text(error) or "none", advice

    volts, low, high = (
        0.1 * bus.read_number(servo.id, address, 2)
        for address in (reg.VOLTAGE, reg.MIN_VOLTAGE, reg.MAX_VOLTAGE)
    )
    detail = f"{volts:.1f} V, allowed {low:.1f} to {high:.1f} V"
    advice = "check the power supply, its cable and its rating"
    yield "voltage", low <= volts <= high, detail, advice

    celsius, limit_c = bus.read_number(servo.id, reg.TEMPERATURE, 1), settings.max_temperature_c
    advice = "let it cool; if it is cold to the touch, its sensor is broken"
    yield "temperature", celsius <= limit_c, f"{celsius} °C, at most {limit_c:g} °C", advice

    # Mode 5 ignores position limits, and a reboot loses the turns.
    ticks = bus.read_number(servo.id, reg.PRESENT_POSITION, 4, signed=True)
    lowest, highest = sorted((servo.open_ticks, servo.closed_ticks))
    margin = round(_MARGIN_FRACTION * (highest - lowest))
    advice = (
        "the turn count is lost on a reboot, or the linkage has moved: with torque off turn the "
        "fingers into their travel, and check open_ticks and closed_ticks"
    )
    detail = f"{ticks} ticks, its travel is {lowest} to {highest}"
    yield "position", lowest - margin <= ticks <= highest + margin, detail, advice
