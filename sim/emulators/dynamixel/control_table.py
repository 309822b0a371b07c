"""Control tables of the emulated X-series servos: registers, limits and models.

Source: ROBOTIS e-Manual, 'Control Table' of XC330-T288, XM430-W350 and XL430-W250.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

from sim.emulators.dynamixel.packets import BAD_LENGTH, BEYOND_LIMIT, NO_ACCESS, OK, OUT_OF_RANGE

MODEL, FIRMWARE, ID, BAUD, MODE = 0, 6, 7, 8, 11
MOVING_THRESHOLD, MAX_TEMPERATURE, MAX_VOLTAGE, MIN_VOLTAGE = 24, 31, 32, 34
CURRENT_LIMIT, VELOCITY_LIMIT, MAX_POSITION, MIN_POSITION, SHUTDOWN = 38, 44, 48, 52, 63
TORQUE, STATUS_RETURN, REGISTERED, HARDWARE_ERROR, WATCHDOG = 64, 68, 69, 70, 98
GOAL_PWM, GOAL_CURRENT, GOAL_VELOCITY, PROFILE_VELOCITY, GOAL_POSITION = 100, 102, 104, 112, 116
MOVING, PRESENT_CURRENT, PRESENT_VELOCITY, PRESENT_POSITION = 122, 126, 128, 132
VOLTAGE, TEMPERATURE = 144, 146

POSITION, CURRENT_BASED_POSITION = 3, 5
MODES = (0, 1, POSITION, 4, CURRENT_BASED_POSITION, 16)
"""Operating modes; only the emulated fingers' one, 5, limits the current to the goal current."""

GOALS = (GOAL_PWM, GOAL_CURRENT, GOAL_VELOCITY, GOAL_POSITION)
FACTORY_ID, FACTORY_BAUD = 1, 57600
WATCHDOG_TRIPPED = 0xFF

BAUDS = (9600, 57600, 115200, 1000000, 2000000, 3000000, 4000000)
"""Baud rates [bit/s], by the value of the baud rate register."""

VELOCITY_TICKS_S = 0.229 / 60 * 4096
"""One unit of velocity, 0.229 rev/min [ticks/s]."""

_SIZE = 147


class RegisterAccess(Enum):
    """When a register may be written."""

    READ_ONLY = "read only"
    EEPROM = "written with torque off"
    RAM = "written at any time"


@dataclass(frozen=True, slots=True)
class Register:
    """Size [bytes], access, smallest and largest value to be written (signed when below 0)."""

    size: int
    access: RegisterAccess
    low: int = 0
    high: int = 2**32 - 1


_R, _E, _W = RegisterAccess.READ_ONLY, RegisterAccess.EEPROM, RegisterAccess.RAM
_REGISTERS: dict[int, Register] = {
    **dict.fromkeys(
        (FIRMWARE, REGISTERED, HARDWARE_ERROR, MOVING, 123, TEMPERATURE), Register(1, _R)
    ),
    **dict.fromkeys((MODEL, 120, VOLTAGE), Register(2, _R)),
    **dict.fromkeys((2, 136, 140), Register(4, _R)),
    ID: Register(1, _E, 0, 252),
    BAUD: Register(1, _E, 0, 6),
    9: Register(1, _E, 0, 254),
    10: Register(1, _E, 0, 13),
    MODE: Register(1, _E, 0, 16),
    **dict.fromkeys((12, SHUTDOWN), Register(1, _E, 0, 255)),
    13: Register(1, _E, 1, 22),
    20: Register(4, _E, -1044479, 1044479),
    MOVING_THRESHOLD: Register(4, _E, 0, 1023),
    MAX_TEMPERATURE: Register(1, _E, 0, 100),
    **dict.fromkeys((MAX_VOLTAGE, MIN_VOLTAGE), Register(2, _E, 31, 160)),
    36: Register(2, _E, 0, 885),
    CURRENT_LIMIT: Register(2, _E),
    VELOCITY_LIMIT: Register(4, _E, 0, 2047),
    **dict.fromkeys((MAX_POSITION, MIN_POSITION), Register(4, _E, 0, 4095)),
    **dict.fromkeys((TORQUE, 65), Register(1, _W, 0, 1)),
    STATUS_RETURN: Register(1, _W, 0, 2),
    **dict.fromkeys((76, 78, 80, 82, 84, 88, 90), Register(2, _W, 0, 16383)),
    WATCHDOG: Register(1, _W, 0, 127),
    GOAL_PWM: Register(2, _W, -885, 885),
    GOAL_CURRENT: Register(2, _W, -32768, 32767),
    GOAL_VELOCITY: Register(4, _W, -2047, 2047),
    **dict.fromkeys((108, PROFILE_VELOCITY), Register(4, _W, 0, 32767)),
    GOAL_POSITION: Register(4, _W, -1048575, 1048575),
    124: Register(2, _R, -885, 885),
    PRESENT_CURRENT: Register(2, _R, -32768, 32767),
    **dict.fromkeys((PRESENT_VELOCITY, PRESENT_POSITION), Register(4, _R, -(2**31), 2**31 - 1)),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class EmulatedServoModel:
    """A servo model, with factory settings.

    Attributes:
        number: Model number.
        firmware: Firmware version of a new servo.
        current_limit: Factory setting and maximum [units]; None without current control.
        unit_ma: One unit of current [mA].
        volts: Supply voltage here [V].
        volt_limits: Lowest and highest supply voltage [V].
        hottest_c: Temperature limit [°C].
        shutdown: Mask of the errors that switch torque off.
        watchdog_stops: It stops when the bus watchdog trips. Source: our own trial; servos of size
            330 did not stop.
    """

    number: int
    firmware: int
    current_limit: int | None
    unit_ma: float
    volts: float
    volt_limits: tuple[float, float]
    hottest_c: int
    shutdown: int
    watchdog_stops: bool


_XM430 = EmulatedServoModel(
    number=1020,
    firmware=45,
    current_limit=1193,
    unit_ma=2.69,
    volts=12.0,
    volt_limits=(9.5, 16.0),
    hottest_c=80,
    shutdown=0x34,
    watchdog_stops=True,
)
MODELS = {
    "XC330-T288": EmulatedServoModel(
        number=1220,
        firmware=46,
        current_limit=910,
        unit_ma=1.0,
        volts=11.1,
        volt_limits=(5.5, 14.0),
        hottest_c=70,
        shutdown=0x35,
        watchdog_stops=False,
    ),
    "XM430-W350": _XM430,
    "XM540-W270": replace(_XM430, number=1120, current_limit=2047),
    "XL430-W250": replace(
        _XM430, number=1060, current_limit=None, unit_ma=1.0, volt_limits=(6.5, 12.0), hottest_c=72
    ),
}


class ControlTable:
    """The registers of one servo, by address."""

    def __init__(self, model: EmulatedServoModel, servo_id: int, baud: int, mode: int) -> None:
        self._registers = dict(_REGISTERS)
        self._memory = bytearray(_SIZE)
        low_v, high_v = model.volt_limits
        factory = {
            MODEL: model.number,
            FIRMWARE: model.firmware,
            ID: servo_id,
            BAUD: BAUDS.index(baud),
            MODE: mode,
            12: 255,
            13: 2,
            MOVING_THRESHOLD: 10,
            MAX_TEMPERATURE: model.hottest_c,
            MAX_VOLTAGE: round(10 * high_v),
            MIN_VOLTAGE: round(10 * low_v),
            36: 885,
            VELOCITY_LIMIT: 400,
            MAX_POSITION: 4095,
            SHUTDOWN: model.shutdown,
            VOLTAGE: round(10 * model.volts),
            TEMPERATURE: 34,
        }
        if model.current_limit is None:
            del self._registers[CURRENT_LIMIT], self._registers[GOAL_CURRENT]
        else:
            self._registers[CURRENT_LIMIT] = Register(2, _E, 0, model.current_limit)
            factory[CURRENT_LIMIT] = model.current_limit
        for address, value in factory.items():
            self[address] = value
        self.start_up()

    def start_up(self) -> None:
        """Reset the volatile registers, as after switching on."""
        self[STATUS_RETURN], self[GOAL_PWM] = 2, 885
        for address in (
            TORQUE,
            REGISTERED,
            HARDWARE_ERROR,
            WATCHDOG,
            GOAL_VELOCITY,
            PROFILE_VELOCITY,
            108,
        ):
            self[address] = 0
        if GOAL_CURRENT in self._registers:
            self[GOAL_CURRENT] = self[CURRENT_LIMIT]

    def __contains__(self, address: int) -> bool:
        return address in self._registers

    def __getitem__(self, address: int) -> int:
        register = self._registers[address]
        raw = self._memory[address : address + register.size]
        return int.from_bytes(raw, "little", signed=register.low < 0)

    def __setitem__(self, address: int, value: int) -> None:
        register = self._registers[address]
        raw = value.to_bytes(register.size, "little", signed=register.low < 0)
        self._memory[address : address + register.size] = raw

    def read(self, address: int, length: int) -> tuple[int, bytes]:
        """Error number and bytes.

        A read may cover addresses without a register, as a whole control table is read. Our choice:
        the manual gives an access error to an undefined address, and does not speak of gaps.
        """
        if length == 0:
            return BAD_LENGTH, b""
        if address + length > _SIZE:
            return NO_ACCESS, b""
        return OK, bytes(self._memory[address : address + length])

    def write(self, address: int, data: bytes) -> tuple[int, frozenset[int]]:
        """Write all of the data or nothing; returns error number and written addresses."""
        values: dict[int, int] = {}
        current = address
        while current < address + len(data):
            register = self._registers.get(current)
            if register is None:
                return NO_ACCESS, frozenset()
            raw = data[current - address : current - address + register.size]
            if len(raw) < register.size:
                return BAD_LENGTH, frozenset()
            values[current] = int.from_bytes(raw, "little", signed=register.low < 0)
            current += register.size
        error = next((e for a, v in values.items() if (e := self._refusal(a, v))), OK)
        if error or not values:
            return error or BAD_LENGTH, frozenset()
        for written, value in values.items():
            self[written] = value
        return OK, frozenset(values)

    def _refusal(self, address: int, value: int) -> int:
        register = self._registers[address]
        locked = register.access is _R or (register.access is _E and self[TORQUE])
        if locked:
            return NO_ACCESS
        if not register.low <= value <= register.high or (address == MODE and value not in MODES):
            return OUT_OF_RANGE
        if self[WATCHDOG] == WATCHDOG_TRIPPED and (address in GOALS or address == WATCHDOG):
            # Range error: the manual's word for goals. Only 0 clears it, as the manual says.
            return OK if address == WATCHDOG and value == 0 else OUT_OF_RANGE
        if address == GOAL_CURRENT and abs(value) > self[CURRENT_LIMIT]:
            return BEYOND_LIMIT
        return OK
