"""What is looked at before a gripper's servos may move; nothing is written to them here.

The same findings refuse a start and are printed by ``tacgrasp doctor``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from tacgrasp.drivers.check import Finding
from tacgrasp.drivers.dynamixel import registers as at
from tacgrasp.drivers.dynamixel.bus import Bus
from tacgrasp.drivers.dynamixel.errors import BusError, Trouble
from tacgrasp.drivers.dynamixel.settings import BAUDS, DynamixelSettings, ServoSettings

WIZARD = "with the DYNAMIXEL Wizard"
_MARGIN_SHARE = 0.1  # of the travel, that a servo may stand outside of it


def start_findings(bus: Bus, settings: DynamixelSettings) -> Sequence[Finding]:
    """Look at every servo; a servo that is missing or of another kind is not asked further."""
    findings: list[Finding] = []
    for servo in settings.servos:
        found = _who(bus, settings, servo)
        findings.append(found)
        if found.ok:
            findings += [look(bus, settings, servo) for look in _LOOKS]
    return findings


def _finding(
    servo: ServoSettings, name: str, ok: bool, found: str, advice: Callable[[], str] | str
) -> Finding:
    told = "" if ok else advice if isinstance(advice, str) else advice()
    return Finding(
        device="gripper", name=f"servo {servo.id} {name}", ok=ok, found=found, advice=told
    )


def _who(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> Finding:
    try:
        number = bus.ping(servo.id)
    except BusError as error:
        if error.trouble is Trouble.LOST:
            raise
        return _finding(
            servo,
            "model",
            False,
            f"expected {settings.model} at id {servo.id}, {settings.baud} baud; {error}",
            lambda: _elsewhere(bus, settings, servo),
        )
    wanted = at.MODELS[settings.model].number
    if number in at.WITHOUT_CURRENT:
        advice = (
            "this model has no current control and can't hold a force; use one of "
            + ", ".join(sorted(at.MODELS))
        )
    else:
        advice = "give the rig's file the right model and id, or mount the right servo"
    found = at.model_name(number)
    if number != wanted:
        found += f", expected {settings.model}"
    return _finding(servo, "model", number == wanted, found, advice)


def _elsewhere(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> str:
    """Whether the servo answers at another baud rate; asked quickly, since there are many."""
    bus.hurried = lambda: True
    for baud in BAUDS:
        if baud == settings.baud:
            continue
        try:
            bus.open(baud)
            bus.ping(servo.id)
        except BusError as error:
            if error.trouble is Trouble.LOST:
                raise
            continue
        finally:
            bus.open()
        return f"it answers at {baud} baud: give the rig's file baud: {baud}"
    return (
        "it answers at no other baud rate either; check that the power is on, the cable, the id, "
        "and that the port is the gripper's"
    )


def _firmware(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> Finding:
    version = bus.read_number(servo.id, at.FIRMWARE, 1)
    return _finding(
        servo,
        "firmware",
        version >= at.WATCHDOG_FIRMWARE,
        f"version {version}, {at.WATCHDOG_FIRMWARE} or later is needed for the bus watchdog",
        f"update it {WIZARD}",
    )


def _mode(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> Finding:
    mode = bus.read_number(servo.id, at.OPERATING_MODE, 1)
    return _finding(
        servo,
        "operating mode",
        mode == at.CURRENT_BASED_POSITION,
        f"{mode}, expected {at.CURRENT_BASED_POSITION} (current-based position)",
        f"set register {at.OPERATING_MODE} to {at.CURRENT_BASED_POSITION} {WIZARD}, torque off",
    )


def _drive_mode(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> Finding:
    mode = bus.read_number(servo.id, at.DRIVE_MODE, 1)
    wrong = mode & (at.TIME_BASED | at.TORQUE_BY_GOAL)
    return _finding(
        servo,
        "drive mode",
        not wrong,
        f"{mode:#04x}, expected a velocity-based profile and no torque-on by goal (bits 2, 3 off)",
        f"set register {at.DRIVE_MODE} to {mode & ~wrong} {WIZARD}, torque off",
    )


def _answers(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> Finding:
    level = bus.read_number(servo.id, at.STATUS_RETURN, 1)
    return _finding(
        servo,
        "status return level",
        level == 2,
        f"{level}, expected 2 (every instruction is answered)",
        f"set register {at.STATUS_RETURN} to 2 {WIZARD}",
    )


def _shutdown(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> Finding:
    mask = bus.read_number(servo.id, at.SHUTDOWN, 1)
    missing = at.NEEDED_SHUTDOWN & ~mask
    found = f"{mask:#04x}"
    if missing:
        found += f", it would not let go when {at.error_words(missing)}"
    return _finding(
        servo,
        "shutdown mask",
        not missing,
        found,
        f"set register {at.SHUTDOWN} to {mask | missing} {WIZARD}, torque off",
    )


def _current_limit(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> Finding:
    unit_ma = at.MODELS[settings.model].unit_ma
    limit_ma = bus.read_number(servo.id, at.CURRENT_LIMIT, 2) * unit_ma
    return _finding(
        servo,
        "current limit",
        limit_ma >= settings.max_current_ma,
        f"{limit_ma:.0f} mA, max_current_ma is {settings.max_current_ma:.0f}",
        f"lower max_current_ma in the rig's file, or raise register {at.CURRENT_LIMIT} {WIZARD}",
    )


def _hardware_error(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> Finding:
    error = bus.read_number(servo.id, at.HARDWARE_ERROR, 1)
    return _finding(
        servo,
        "hardware error",
        error == 0,
        at.error_words(error) or "none",
        "remove the cause, then reboot the servo or switch its power off and on",
    )


def _voltage(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> Finding:
    volts, low, high = (
        0.1 * bus.read_number(servo.id, address, 2)
        for address in (at.VOLTAGE, at.MIN_VOLTAGE, at.MAX_VOLTAGE)
    )
    return _finding(
        servo,
        "voltage",
        low <= volts <= high,
        f"{volts:.1f} V, allowed {low:.1f} to {high:.1f} V",
        "check the power supply, its cable and its rating",
    )


def _temperature(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> Finding:
    celsius = bus.read_number(servo.id, at.TEMPERATURE, 1)
    return _finding(
        servo,
        "temperature",
        celsius <= settings.max_temperature_c,
        f"{celsius} °C, at most {settings.max_temperature_c:g} °C",
        "let it cool; if it is cold to the touch, its sensor is broken",
    )


def _position(bus: Bus, settings: DynamixelSettings, servo: ServoSettings) -> Finding:
    """Mode 5 counts turns and ignores position limits; a reboot forgets the turns."""
    ticks = bus.read_number(servo.id, at.PRESENT_POSITION, 4, signed=True)
    low, high = sorted((servo.open_ticks, servo.closed_ticks))
    margin = round(_MARGIN_SHARE * (high - low))
    return _finding(
        servo,
        "position",
        low - margin <= ticks <= high + margin,
        f"{ticks} ticks, its travel is {low} to {high}",
        "the turn count is lost on a reboot, or the linkage has moved: with torque off turn the "
        "fingers into their travel, and check open_ticks and closed_ticks",
    )


_LOOKS: Sequence[Callable[[Bus, DynamixelSettings, ServoSettings], Finding]] = (
    _firmware,
    _mode,
    _drive_mode,
    _answers,
    _shutdown,
    _current_limit,
    _hardware_error,
    _voltage,
    _temperature,
    _position,
)
