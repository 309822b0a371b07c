"""Registers of Dynamixel X-series servos, and the models that can grip with a set current.

Source: ROBOTIS e-Manual, 'Control Table' of the X series; units of current as there.
"""

from __future__ import annotations

from dataclasses import dataclass

MODEL, FIRMWARE, DRIVE_MODE, OPERATING_MODE = 0, 6, 10, 11
MAX_VOLTAGE, MIN_VOLTAGE, CURRENT_LIMIT, SHUTDOWN = 32, 34, 38, 63
TORQUE, STATUS_RETURN, HARDWARE_ERROR, WATCHDOG = 64, 68, 70, 98
GOAL_CURRENT, GOAL_POSITION = 102, 116
PRESENT_POSITION = 132
VOLTAGE, TEMPERATURE = 144, 146

CURRENT_BASED_POSITION = 5
WATCHDOG_TRIPPED = 0xFF
WATCHDOG_UNIT_S = 0.020
WATCHDOG_FIRMWARE = 38
"""First firmware with a bus watchdog."""

TIME_BASED, TORQUE_BY_GOAL = 0x04, 0x08
"""Bits of the drive mode that would change the meaning of our goals."""

VELOCITY_TICKS_S = 0.229 / 60 * 4096
"""One unit of velocity, 0.229 rev/min [ticks/s]."""

HEAT, SHOCK, OVERLOAD = 0x04, 0x10, 0x20
NEEDED_SHUTDOWN = HEAT | SHOCK | OVERLOAD
"""Errors at which a servo must switch its torque off by itself, or it is destroyed."""

HARDWARE_ERRORS = {
    0x01: "input voltage out of its limits",
    0x04: "overheated",
    0x08: "motor encoder failed",
    0x10: "electrical shock or too little power",
    0x20: "overloaded",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class ServoModel:
    """A servo with current-based position control.

    Attributes:
        number: Model number in the reply to a ping.
        unit_ma: Current of one register unit [mA].
    """

    number: int
    unit_ma: float


MODELS = {
    "XM430-W350": ServoModel(number=1020, unit_ma=2.69),
    "XM430-W210": ServoModel(number=1030, unit_ma=2.69),
    "XM540-W270": ServoModel(number=1120, unit_ma=2.69),
    "XM540-W150": ServoModel(number=1130, unit_ma=2.69),
    "XH430-W350": ServoModel(number=1000, unit_ma=2.69),
    "XH430-W210": ServoModel(number=1010, unit_ma=2.69),
    "XC330-T181": ServoModel(number=1210, unit_ma=1.0),
    "XC330-T288": ServoModel(number=1220, unit_ma=1.0),
    "XC330-M181": ServoModel(number=1230, unit_ma=1.0),
    "XC330-M288": ServoModel(number=1240, unit_ma=1.0),
}

WITHOUT_CURRENT = {1060: "XL430-W250", 1070: "XC430-W150", 1080: "XC430-W240"}
"""Models whose register 126 is load, not current. They can't hold a force."""


def model_name(number: int) -> str:
    """Name of a model number; the number itself for an unknown model."""
    names = {model.number: name for name, model in MODELS.items()} | WITHOUT_CURRENT
    return names.get(number, f"model number {number}")


def hardware_error_text(bits: int) -> str:
    """Meaning of a hardware error status; empty for none."""
    texts = [text for bit, text in HARDWARE_ERRORS.items() if bits & bit]
    if unknown := bits & ~sum(HARDWARE_ERRORS):
        texts.append(f"unknown bits {unknown:#04x}")
    return ", ".join(texts)
