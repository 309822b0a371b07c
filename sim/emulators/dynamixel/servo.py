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

NO_LOAD_TICKS_S = 4800.0
"""Largest speed [ticks/s]. Source: XC330-T288 at 11.1 V, 65 rev/min."""

_ACCELERATION = 60_000.0  # ticks/s²
_APPROACH_PER_S = 80.0  # speed towards a goal per remaining tick
_CURRENT_RISE_S = 0.010
_ARRIVED_TICKS = 0.3
_MOST_UNITS = 2047  # largest current of any model; a mode without a goal current presses with it


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

    @property
    def id(self) -> int:
        return self.table[at.ID]

    @property
    def torque(self) -> bool:
        return bool(self.table[at.TORQUE])

    @property
    def goal_current_ma(self) -> float:
        if self.table[at.MODE] != at.CURRENT_BASED_POSITION or at.GOAL_CURRENT not in self.table:
            return _MOST_UNITS * self.model.unit_ma
        return abs(self.table[at.GOAL_CURRENT]) * self.model.unit_ma

    @property
    def moving(self) -> bool:
        return self.waiting or abs(self._velocity) > self.table[at.MOVING_THRESHOLD]

    def execute(self, code: int, parameters: bytes) -> tuple[int, bytes, frozenset[int]]:
        """Carry out an instruction; returns error number, data and written addresses."""
        nothing: frozenset[int] = frozenset()
        if code == protocol.PING:
            model = bytes(self.table.read(at.MODEL, 2)[1])
            return protocol.OK, model + bytes([self.table[at.FIRMWARE]]), nothing
        if code == protocol.REBOOT:
            self.restart()
            return protocol.OK, b"", frozenset({at.TORQUE})
        if code == protocol.READ and len(parameters) == 4:
            address, length = protocol.u16(parameters), protocol.u16(parameters[2:])
            return *self.table.read(address, length), nothing
        if code == protocol.WRITE and len(parameters) > 2:
            return self.write(protocol.u16(parameters), parameters[2:])
        return protocol.NO_INSTRUCTION, b"", nothing

    def write(self, address: int, data: bytes) -> tuple[int, bytes, frozenset[int]]:
        """Write registers; torque can't be switched on during a hardware error."""
        turns_on = address == at.TORQUE and data[:1] == b"\x01"
        if turns_on and self.table[at.HARDWARE_ERROR] & self.table[at.SHUTDOWN]:
            return protocol.NO_ACCESS, b"", frozenset()
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

    def feed_watchdog(self, now_s: float) -> None:
        self._fed_s = now_s

    def check_watchdog(self, now_s: float) -> None:
        """Trip the bus watchdog when no instruction came in time while torque is on."""
        limit = self.table[at.WATCHDOG]
        if self._fed_s is None or not self.torque or not 1 <= limit <= 127:
            return
        if now_s - self._fed_s > 0.020 * limit:
            self.table[at.WATCHDOG] = 0xFF

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
        watchdog_tripped = self.table[at.WATCHDOG] == 0xFF
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
