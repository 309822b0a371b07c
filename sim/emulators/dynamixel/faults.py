"""Faults of the emulated bus: their names, and their effect on answers and servos."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence

from sim.emulators.dynamixel import control_table as at
from sim.emulators.dynamixel.servo import EmulatedServo
from sim.emulators.dynamixel.wire import Wire

VOLTAGE_BIT, HEAT_BIT, ENCODER_BIT, OVERLOAD_BIT = 0x01, 0x04, 0x08, 0x20
"""Bits of the hardware error status (70)."""

FAULTS = {
    "silence": "no more answers; id: of one servo only",
    "bad_crc": "the next answers have a wrong CRC; count: 1",
    "late_reply": "the next answers come late; delay_ms: 50, count: 1",
    "partial_reply": "the next answers break off half-way; count: 1",
    "wrong_baud": "the servos listen at another baud rate; garbage: 1 for noise as an answer",
    "wrong_model": "the servo reports another model; model: 1060, an XL430 without current control",
    "port_taken": "another program has locked the port",
    "unplug": "the port disappears; clear plugs it in again",
    "alert": "a hardware error that leaves torque on; bit: 8, the encoder",
    "overload": "overload: torque goes off",
    "over_temperature": "too hot: torque goes off; celsius: 85",
    "reboot": "the servo restarts and lets go, as after a dip of its supply; silent_ms: 0, id: all",
    "register": "a register is changed; address, value, id: all",
}
"""Names and effects of the faults, with the defaults of their details."""


class BusFaults:
    """The faults of one bus. Not thread-safe: the caller holds a lock.

    Attributes:
        active: Names of the faults injected since the last ``clear``.
    """

    def __init__(self, servos: Sequence[EmulatedServo], wire: Wire) -> None:
        self._servos, self._wire = servos, wire
        self._injected_s: float | None = None
        self.active: set[str] = set()
        self._silent_ids: set[int] = set()
        self._restarting_until_s: dict[int, float] = {}
        self._next_replies: list[tuple[str, float]] = []
        self._garbage = False
        self._original_values: list[tuple[EmulatedServo, int, int]] = []

    def inject(self, fault: str, details: Mapping[str, float | str]) -> None:
        """Start a fault.

        Raises:
            ValueError: The fault is not known, or impossible now.
        """
        if fault not in FAULTS:
            known = "; ".join(f"{name} ({effect})" for name, effect in FAULTS.items())
            raise ValueError(f"no fault {fault!r}; known: {known}")
        values = {name: float(value) for name, value in details.items()}
        servo_id = int(values.get("id", 0))
        servos = [servo for servo in self._servos if servo_id in (0, servo.id)]
        if fault in ("bad_crc", "late_reply", "partial_reply"):
            delay_s = values.get("delay_ms", 50.0) / 1000
            self._next_replies += [(fault, delay_s)] * int(values.get("count", 1))
        elif fault == "silence":
            self._silent_ids |= {servo.id for servo in servos}
        elif fault == "port_taken":
            self._wire.lock()
        elif fault == "unplug":
            self._wire.unplug()
        else:
            self._change(fault, values, servos)
        self.active.add(fault)
        self._injected_s = time.monotonic()

    def clear(self) -> None:
        self.active.clear()
        self._silent_ids.clear()
        self._restarting_until_s.clear()
        self._next_replies.clear()
        self._garbage = False
        for servo, address, value in reversed(self._original_values):
            servo.table[address] = value
        self._original_values.clear()
        for servo in self._servos:
            servo.table[at.HARDWARE_ERROR] = 0
        self._wire.unlock()
        self._wire.plug_in()

    def injected_ago_ms(self) -> float | None:
        """Time since the last injection [ms]; None without one."""
        return None if self._injected_s is None else 1000 * (time.monotonic() - self._injected_s)

    def is_silent(self, servo_id: int) -> bool:
        restarted_s = self._restarting_until_s.get(servo_id, 0.0)
        return servo_id in self._silent_ids or time.monotonic() < restarted_s

    def noise(self, data: bytes) -> bytes:
        """Answer at a wrong baud rate: nothing, or as much garbage as was received."""
        return bytes((byte * 37 + 11) % 256 for byte in data) if self._garbage else b""

    def apply(self, reply: bytes) -> tuple[float, bytes]:
        """Delay [s] and bytes of an answer, after the next fault of answers."""
        if not reply or not self._next_replies:
            return 0.0, reply
        fault, delay_s = self._next_replies.pop(0)
        if fault == "late_reply":
            return delay_s, reply
        if fault == "bad_crc":
            return 0.0, reply[:-1] + bytes([reply[-1] ^ 0x5A])
        return 0.0, reply[: len(reply) // 2]

    def _change(
        self, fault: str, values: Mapping[str, float], servos: Sequence[EmulatedServo]
    ) -> None:
        self._garbage = self._garbage or bool(values.get("garbage", 0))
        for servo in servos:
            if fault == "wrong_baud":
                self._set(servo, at.BAUD, 1 if servo.table[at.BAUD] != 1 else 3)
            elif fault == "wrong_model":
                self._set(servo, at.MODEL, int(values.get("model", 1060)))
            elif fault == "alert":
                servo.fail(int(values.get("bit", ENCODER_BIT)))
            elif fault == "reboot":
                servo.restart()
                silent_s = values.get("silent_ms", 0.0) / 1000
                self._restarting_until_s[servo.id] = time.monotonic() + silent_s
            elif fault == "overload":
                servo.fail(OVERLOAD_BIT)
            elif fault == "over_temperature":
                self._set(servo, at.TEMPERATURE, int(values.get("celsius", 85)))
                servo.fail(HEAT_BIT)
            else:
                if "address" not in values or "value" not in values:
                    raise ValueError("register needs an address and a value")
                self._set(servo, int(values["address"]), int(values["value"]))

    def _set(self, servo: EmulatedServo, address: int, value: int) -> None:
        if address not in servo.table:
            raise ValueError(f"no register at address {address}")
        self._original_values.append((servo, address, servo.table[address]))
        servo.table[address] = value
