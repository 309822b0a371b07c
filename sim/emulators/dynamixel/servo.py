"""One emulated servo: its control table and its motion.

The dynamics are simple, but contain what a driver has to cope with: limited speed and acceleration,
friction that the current must overcome before the servo moves, goals that are reached after time, a
stop where the fingers meet an object, and torque that goes off. Not emulated: gains, voltage sag,
heating, multi-turn wrap.
"""

from __future__ import annotations

import math

from sim.emulators.dynamixel import control_table as at
from sim.emulators.dynamixel import packets as protocol
from sim.emulators.dynamixel.control_table import ControlTable, EmulatedServoModel

Written = frozenset[int]
"""Addresses of written registers."""

NO_LOAD_TICKS_S = 4800.0
"""Largest speed [ticks/s]. Source: XC330-T288 at 11.1 V, 65 rev/min."""

UNLIMITED_MA = 1400.0
"""Largest current of a servo without current control [mA]: stall of an XL430 at 12 V."""

_CLEAR_TURNS = b'\x01DXL"'
_NOTHING: Written = frozenset()
_ACCELERATION = 60_000.0  # ticks/s²
_APPROACH_PER_S = 80.0  # speed towards a goal per remaining tick
_CURRENT_RISE_S = 0.010
_ARRIVED_TICKS = 0.3


class EmulatedServo:
    """A servo on the bus.

    Attributes:
        model: Data of its model.
        table: Its registers.
        position: Position of the horn [ticks].
        current_ma: Current, with the sign of the position [mA].
        waiting: It is about to press, and the position at which the fingers stop is being solved.
        stop: Position at which the fingers meet an object on closing; None without an object.
        closing: Sign of the direction in which the fingers close.
    """

    def __init__(
        self, model: EmulatedServoModel, servo_id: int, *, baud: int, mode: int, friction_ma: float
    ) -> None:
        self.model, self.closing = model, 1
        self.table = ControlTable(model, servo_id, baud, mode)
        self.position, self.current_ma = 0.0, 0.0
        self.waiting = False
        self.stop: float | None = None
        self._friction_ma = friction_ma
        self._velocity = 0.0
        self._fed_s: float | None = None
        self._registered = b""

    @property
    def id(self) -> int:
        return self.table[at.ID]

    @property
    def torque(self) -> bool:
        return bool(self.table[at.TORQUE])

    @property
    def goal_current_ma(self) -> float:
        if self.table[at.MODE] != at.CURRENT_BASED_POSITION or at.GOAL_CURRENT not in self.table:
            limited = at.CURRENT_LIMIT in self.table
            return self.table[at.CURRENT_LIMIT] * self.model.unit_ma if limited else UNLIMITED_MA
        return abs(self.table[at.GOAL_CURRENT]) * self.model.unit_ma

    @property
    def moving(self) -> bool:
        threshold = self.table[at.MOVING_THRESHOLD] * at.VELOCITY_TICKS_S
        return self.waiting or abs(self._velocity) > threshold

    def execute(self, code: int, parameters: bytes) -> tuple[int, bytes, Written]:
        """Carry out an instruction for this servo alone.

        Returns:
            Error number, data of the answer, and written addresses. A wrong number of parameters
            is a length error (our choice: the manual speaks of written data only).
        """
        if code == protocol.PING:
            model = bytes(self.table.read(at.MODEL, 2)[1])
            return protocol.OK, model + bytes([self.table[at.FIRMWARE]]), _NOTHING
        if code == protocol.REBOOT:
            self.restart()
            return protocol.OK, b"", frozenset({at.TORQUE})
        if code == protocol.READ:
            if len(parameters) != 4:
                return protocol.BAD_LENGTH, b"", _NOTHING
            address, length = protocol.u16(parameters), protocol.u16(parameters[2:])
            return *self.table.read(address, length), _NOTHING
        if code == protocol.WRITE:
            return self.write(protocol.u16(parameters), parameters[2:])
        if code == protocol.REG_WRITE:
            return self._register(parameters)
        if code == protocol.ACTION:
            return self._act()
        if code == protocol.FACTORY_RESET:
            return self._reset(parameters)
        if code == protocol.CLEAR:
            return self._clear_turns(parameters)
        return protocol.NO_INSTRUCTION, b"", _NOTHING

    def write(self, address: int, data: bytes) -> tuple[int, bytes, Written]:
        """Write registers; torque can't be switched on during a hardware error."""
        at_torque = at.TORQUE - address
        turns_on = at_torque >= 0 and data[at_torque : at_torque + 1] == b"\x01"
        if turns_on and self.table[at.HARDWARE_ERROR] & self.table[at.SHUTDOWN]:
            return protocol.NO_ACCESS, b"", _NOTHING
        was_on = self.torque
        error, written = self.table.write(address, data)
        if at.TORQUE in written and self.torque and not was_on:
            self.table[at.GOAL_POSITION] = round(self.position)
        return error, b"", written

    def fail(self, bits: int) -> None:
        """Set a hardware error; torque goes off where the shutdown mask has one of the bits."""
        self.table[at.HARDWARE_ERROR] = self.table[at.HARDWARE_ERROR] | bits
        if self.table[at.SHUTDOWN] & bits:
            self.table[at.TORQUE] = 0

    def restart(self) -> None:
        """Start up anew: torque off, volatile registers reset, the turn count lost."""
        self.table.start_up()
        self.position %= 4096
        self.table[at.GOAL_POSITION] = round(self.position)

    def _register(self, parameters: bytes) -> tuple[int, bytes, Written]:
        """Keep a write for the next action; it is checked when it is carried out."""
        if len(parameters) < 3:
            return protocol.BAD_LENGTH, b"", _NOTHING
        self._registered = parameters
        self.table[at.REGISTERED] = 1
        return protocol.OK, b"", _NOTHING

    def _act(self) -> tuple[int, bytes, Written]:
        if not self.table[at.REGISTERED]:
            return protocol.NO_INSTRUCTION, b"", _NOTHING
        self.table[at.REGISTERED] = 0
        return self.write(protocol.u16(self._registered), self._registered[2:])

    def _reset(self, parameters: bytes) -> tuple[int, bytes, Written]:
        """Restore factory settings, all or all except id (and baud rate)."""
        keeps: dict[bytes, tuple[int, ...]] = {
            b"\xff": (), b"\x01": (at.ID,), b"\x02": (at.ID, at.BAUD)
        }  # fmt: skip
        if parameters not in keeps:
            return protocol.OUT_OF_RANGE, b"", _NOTHING
        kept = {address: self.table[address] for address in keeps[parameters]}
        self.table = ControlTable(self.model, at.FACTORY_ID, at.FACTORY_BAUD, at.POSITION)
        for address, value in kept.items():
            self.table[address] = value
        self.restart()
        return protocol.OK, b"", frozenset({at.TORQUE})

    def _clear_turns(self, parameters: bytes) -> tuple[int, bytes, Written]:
        if parameters != _CLEAR_TURNS:
            return protocol.OUT_OF_RANGE, b"", _NOTHING
        if self.moving:
            return protocol.FAILED, b"", _NOTHING
        self.position %= 4096
        return protocol.OK, b"", _NOTHING

    def feed_watchdog(self, now_s: float) -> None:
        self._fed_s = now_s

    def check_watchdog(self, now_s: float) -> None:
        """Trip the bus watchdog when no instruction came in time while torque is on."""
        limit = self.table[at.WATCHDOG]
        if self._fed_s is None or not self.torque or not 1 <= limit <= 127:
            return
        if now_s - self._fed_s > 0.020 * limit:
            self.table[at.WATCHDOG] = at.WATCHDOG_TRIPPED

    def step(self, dt_s: float) -> None:
        """Advance by a time of at most a few milliseconds."""
        if not self.torque or self.waiting:
            self._velocity = 0.0
            if not self.torque:
                self.current_ma = 0.0
        else:
            self._move(dt_s)
        self.publish()

    def _move(self, dt_s: float) -> None:
        goal, blocked = float(self.table[at.GOAL_POSITION]), False
        watchdog_tripped = self.table[at.WATCHDOG] == at.WATCHDOG_TRIPPED
        if watchdog_tripped and self.model.watchdog_stops and self.stop is None:
            goal = self.position
        if self.stop is not None and self.closing * (goal - self.stop) > 0:
            goal, blocked = self.stop, True
        distance = goal - self.position
        arrived = abs(distance) < _ARRIVED_TICKS
        if arrived or self.goal_current_ma <= self._friction_ma:
            self._velocity = 0.0
            if arrived:
                self.position = goal
            pressing = blocked and arrived
            target_ma = self.closing * self.goal_current_ma if pressing else 0.0
        else:
            self._velocity = self._speed_towards(distance, dt_s)
            step = self._velocity * dt_s
            self.position += math.copysign(min(abs(step), abs(distance)), step)
            target_ma = math.copysign(min(self._friction_ma, self.goal_current_ma), distance)
        fraction = min(1.0, dt_s / _CURRENT_RISE_S)
        self.current_ma += fraction * (target_ma - self.current_ma)

    def _speed_towards(self, distance: float, dt_s: float) -> float:
        profile = self.table[at.PROFILE_VELOCITY] * at.VELOCITY_TICKS_S
        fastest = min(profile or NO_LOAD_TICKS_S, NO_LOAD_TICKS_S)
        target = max(-fastest, min(fastest, _APPROACH_PER_S * distance))
        change = _ACCELERATION * dt_s
        return self._velocity + max(-change, min(change, target - self._velocity))

    def publish(self) -> None:
        table = self.table
        table[at.PRESENT_POSITION] = round(self.position)
        table[at.PRESENT_VELOCITY] = round(self._velocity / at.VELOCITY_TICKS_S)
        table[at.PRESENT_CURRENT] = round(self.current_ma / self.model.unit_ma)
        table[at.MOVING] = int(self.moving)
