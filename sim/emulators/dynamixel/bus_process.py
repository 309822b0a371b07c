"""An emulated Dynamixel bus: one or two X-series servos that close fingers, on a pty.

Speaks Protocol 2.0, so that a driver with the unmodified ``dynamixel_sdk`` can't tell it from
servos. Knows nothing of what is gripped: a ``GripLoad`` answers for it, a spring when none is
given. ``python -m sim.emulators dynamixel`` runs it alone.
"""

from __future__ import annotations

import argparse
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from sim.emulators.dynamixel import control_table as at
from sim.emulators.dynamixel.control_table import BAUDS, MODELS
from sim.emulators.dynamixel.faults import BusFaults
from sim.emulators.dynamixel.fingers import Fingers, GripLoad, Linkage, SpringLoad
from sim.emulators.dynamixel.packets import (
    ALERT,
    BAD_CRC,
    BROADCAST,
    FAST_SYNC_READ,
    PING,
    SYNC_READ,
    SYNC_WRITE,
    PacketInstruction,
    PacketReader,
    fast_sync_status,
    status,
)
from sim.emulators.dynamixel.servo import EmulatedServo
from sim.emulators.dynamixel.wire import Wire
from sim.emulators.process.control import ControlServer, Facts
from sim.emulators.process.lifetime import announce_and_wait
from sim.emulators.process.real_time import ask_for_real_time

_BUSY_S, _IDLE_S = 0.002, 0.010


@dataclass(frozen=True, slots=True, kw_only=True)
class ServoOptions:
    """What the servos are.

    Attributes:
        model: Of all of them, a name in ``MODELS``.
        num_servos: 1 or 2; their ids are 1 and 2.
        baud: [bit/s].
        mode: Operating mode; 5 is current-based position control.
    """

    model: str = "XC330-T288"
    num_servos: int = 1
    baud: int = 1_000_000
    mode: int = at.CURRENT_BASED_POSITION

    def __post_init__(self) -> None:
        if self.model not in MODELS:
            raise ValueError(f"model must be one of {', '.join(MODELS)}, got {self.model!r}")
        if self.num_servos not in (1, 2):
            raise ValueError(f"a gripper has 1 or 2 servos, got {self.num_servos}")
        if self.baud not in BAUDS:
            raise ValueError(f"baud must be one of {', '.join(map(str, BAUDS))}, got {self.baud}")


class DynamixelEmulator:
    """The bus, its servos and their fingers, in a thread of its own; ``control.Emulated``."""

    def __init__(
        self,
        load: GripLoad | None = None,
        options: ServoOptions | None = None,
        linkage: Linkage | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Start with open fingers and torque off."""
        options, linkage = options or ServoOptions(), linkage or Linkage()
        self._clock, self._lock = clock, threading.RLock()
        self._servos = [
            EmulatedServo(
                MODELS[options.model],
                servo_id,
                baud=options.baud,
                mode=options.mode,
                friction_ma=linkage.friction_ma,
            )
            for servo_id in range(1, options.num_servos + 1)
        ]
        self._fingers = Fingers(self._servos, linkage, load or SpringLoad(), self._lock, clock())
        self._fingers.step(clock())
        self._wire, self._reader = Wire(), PacketReader()
        self._faults = BusFaults(self._servos, self._wire, clock)
        self._late: list[tuple[float, bytes]] = []
        self._instructions = 0
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run, name="dynamixel", daemon=True)
        self._thread.start()

    @property
    def serial_port(self) -> str:
        """Path that a driver opens; it stays the same when the plug is pulled and put back."""
        return str(self._wire.link)

    def inject(self, fault: str, **details: float | str) -> None:
        """Let a fault happen now; ``dynamixel_faults`` has the list."""
        with self._lock:
            self._faults.inject(fault, details)
            if not all(servo.torque for servo in self._servos):
                self._fingers.dropped()

    def clear(self) -> None:
        """Take all faults away; torque that went off stays off."""
        with self._lock:
            self._faults.clear()

    def facts(self) -> Facts:
        """What is true of bus and fingers now."""
        with self._lock:
            self._fingers.step(self._clock())
            first = self._servos[0]
            return {
                "injected_ago_ms": self._faults.injected_ago_ms(),
                "faults": ", ".join(sorted(self._faults.active)),
                "width_m": self._fingers.width_m,
                "force_n": self._fingers.force_n,
                "current_ma": first.current_ma,
                "position_ticks": first.position,
                "moving": self._fingers.busy,
                "torque": all(servo.torque for servo in self._servos),
                "hardware_error": first.table[at.HARDWARE_ERROR],
                "bus_watchdog": first.table[at.WATCHDOG],
                "squeezes": self._fingers.squeezes,
                "releases": self._fingers.releases,
                "load_error": self._fingers.load_error,
                "instructions": self._instructions,
            }

    def close(self) -> None:
        """End the thread and remove the port. Idempotent."""
        self._ended.set()
        self._thread.join(timeout=2)
        self._fingers.close()
        self._wire.close()

    def _run(self) -> None:
        ask_for_real_time(with_threads=False)
        while not self._ended.is_set():
            data = self._wire.read(self._wait_s())
            if not self._wire.plugged:
                self._ended.wait(_IDLE_S)
            with self._lock:
                self._pass_time()
                if data:
                    self._hear(data)

    def _wait_s(self) -> float:
        now_s = self._clock()
        wait_s = _BUSY_S if self._fingers.busy else _IDLE_S
        return max(0.0, min([wait_s, *(due_s - now_s for due_s, _ in self._late)]))

    def _pass_time(self) -> None:
        now_s = self._clock()
        self._fingers.step(now_s)
        for servo in self._servos:
            servo.watch(now_s)
        due = [reply for due_s, reply in self._late if due_s <= now_s]
        self._late = [(due_s, reply) for due_s, reply in self._late if due_s > now_s]
        for reply in due:
            self._wire.write(reply)

    def _hear(self, data: bytes) -> None:
        if self._wire.baud() != BAUDS[self._servos[0].table[at.BAUD]]:
            self._wire.write(self._faults.noise(data))
            return
        for instruction in self._reader.feed(data):
            self._instructions += 1
            for servo in self._servos:
                servo.hear(self._clock())
            for reply in self._answers(instruction):
                delay_s, sent = self._faults.spoiled(reply)
                if delay_s > 0:
                    self._late.append((self._clock() + delay_s, sent))
                else:
                    self._wire.write(sent)

    def _answers(self, instruction: PacketInstruction) -> list[bytes]:
        code, parameters = instruction.code, instruction.parameters
        addressed = [servo for servo in self._servos if servo.id == instruction.servo_id]
        if instruction.servo_id != BROADCAST:
            if not instruction.intact:
                return [self._status(servo, BAD_CRC) for servo in addressed]
            return [self._carried_out(servo, code, parameters) for servo in addressed]
        if not instruction.intact:
            return []
        if code == PING:
            return [self._carried_out(servo, code, parameters) for servo in self._servos]
        if code in (SYNC_READ, FAST_SYNC_READ) and len(parameters) > 4:
            return self._sync_read(code, parameters)
        if code == SYNC_WRITE and len(parameters) > 4:
            self._sync_write(parameters)
        return []

    def _carried_out(self, servo: EmulatedServo, code: int, parameters: bytes) -> bytes:
        error, data, written = servo.execute(code, parameters)
        if written:
            self._fingers.written(written)
            self._fingers.step(self._clock())
        return self._status(servo, error, data)

    def _status(self, servo: EmulatedServo, error: int, data: bytes = b"") -> bytes:
        if self._faults.silenced(servo.id):
            return b""
        return status(servo.id, self._with_alert(servo, error), data)

    def _with_alert(self, servo: EmulatedServo, error: int) -> int:
        return error | (ALERT if servo.table[at.HARDWARE_ERROR] else 0)

    def _sync_read(self, code: int, parameters: bytes) -> list[bytes]:
        """Answers in the order of the ids; after one that is missing the others stay silent."""
        address, length = _u16(parameters), _u16(parameters[2:])
        parts = []
        for servo_id in parameters[4:]:
            servo = next((each for each in self._servos if each.id == servo_id), None)
            if servo is None or self._faults.silenced(servo_id):
                break
            error, data = servo.table.read(address, length)
            parts.append((servo_id, self._with_alert(servo, error), data))
        if code == FAST_SYNC_READ:
            whole = len(parts) == len(parameters[4:])
            return [fast_sync_status(parts)] if whole else []
        return [status(servo_id, error, data) for servo_id, error, data in parts]

    def _sync_write(self, parameters: bytes) -> None:
        """Write to several at once; nobody answers, a refusal stays unsaid."""
        address, length = _u16(parameters), _u16(parameters[2:])
        written: frozenset[int] = frozenset()
        for start in range(4, len(parameters), 1 + length):
            data = parameters[start + 1 : start + 1 + length]
            for servo in self._servos:
                if servo.id == parameters[start] and len(data) == length:
                    written |= servo.write(address, data)[2]
        if written:
            self._fingers.written(written)


def _u16(data: bytes) -> int:
    return int.from_bytes(data[:2], "little")


def main(argv: Sequence[str]) -> int:
    """``python -m sim.emulators dynamixel``: a gripper on a spring until it is told to end."""
    parser = argparse.ArgumentParser(prog="python -m sim.emulators dynamixel")
    parser.add_argument("--model", default="XC330-T288", choices=sorted(MODELS))
    parser.add_argument("--servos", type=int, default=1, choices=(1, 2))
    parser.add_argument("--baud", type=int, default=1_000_000, choices=BAUDS)
    parser.add_argument("--mode", type=int, default=at.CURRENT_BASED_POSITION)
    parser.add_argument("--spring-width-m", type=float, default=0.03)
    parser.add_argument("--spring-n-m", type=float, default=2000.0)
    parser.add_argument("--newtons-per-ma", type=float, default=Linkage().newtons_per_ma)
    parser.add_argument("--friction-ma", type=float, default=Linkage().friction_ma)
    flags = parser.parse_args(argv)
    emulator = DynamixelEmulator(
        SpringLoad(width_m=flags.spring_width_m, stiffness_n_m=flags.spring_n_m),
        ServoOptions(model=flags.model, num_servos=flags.servos, baud=flags.baud, mode=flags.mode),
        Linkage(newtons_per_ma=flags.newtons_per_ma, friction_ma=flags.friction_ma),
    )
    server = ControlServer({"dynamixel": emulator})
    try:
        announce_and_wait({"control_port": server.port, "serial_port": emulator.serial_port})
    finally:
        server.close()
        emulator.close()
    return 0
