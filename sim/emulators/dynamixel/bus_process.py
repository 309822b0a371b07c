"""An emulated Dynamixel bus: one or two X-series servos that close fingers, on a pty.

The bus speaks Protocol 2.0, so a driver with the unmodified ``dynamixel_sdk`` can't tell it from
servos. A ``GripLoad`` stands for the gripped object; the default is a block on a spring.
``python -m sim.emulators dynamixel`` runs it alone.
"""

from __future__ import annotations

import logging
import threading
import time
from contextlib import closing

from sim.emulators.dynamixel import control_table as at
from sim.emulators.dynamixel.bus import ServoBus
from sim.emulators.dynamixel.control_table import MODELS
from sim.emulators.dynamixel.faults import BusFaults
from sim.emulators.dynamixel.fingers import Fingers, GripLoad, Linkage, SpringLoad
from sim.emulators.dynamixel.options import DynamixelOptions, ServoOptions
from sim.emulators.dynamixel.packets import PacketReader
from sim.emulators.dynamixel.servo import EmulatedServo, Written
from sim.emulators.dynamixel.wire import Wire
from sim.emulators.process.control import Facts
from sim.emulators.process.lifetime import request_real_time, serve

_BUSY_S, _IDLE_S = 0.002, 0.010

BROKEN_OFF_S = 0.05
"""Silence after which a packet that is not complete is dropped [s]. Our choice: a host that has
waited for its answer in vain must be understood again."""

_log = logging.getLogger(__name__)


class DynamixelEmulator:
    """The bus, its servos and their fingers, in a thread of its own; an ``Emulated`` device."""

    def __init__(
        self,
        load: GripLoad | None = None,
        options: ServoOptions | None = None,
        linkage: Linkage | None = None,
    ) -> None:
        """Start with open fingers and torque off."""
        options, linkage = options or ServoOptions(), linkage or Linkage()
        self._lock = threading.RLock()
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
        self._fingers = Fingers(self._servos, linkage, load or SpringLoad(), self._lock)
        self._fingers.step(time.monotonic())
        self._wire, self._reader = Wire(), PacketReader()
        self._faults = BusFaults(self._servos, self._wire)
        self._bus = ServoBus(self._servos, self._faults.is_silent, self._on_written)
        self._received_s = 0.0
        self._late: list[tuple[float, bytes]] = []
        self._instructions = 0
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run, name="dynamixel", daemon=True)
        self._thread.start()

    @property
    def serial_port(self) -> str:
        """Path of the serial port; it stays the same when the port is unplugged and plugged in."""
        return str(self._wire.link)

    def inject(self, fault: str, **details: float | str) -> None:
        """Start one of ``sim.emulators.dynamixel.faults.FAULTS`` now."""
        with self._lock:
            self._faults.inject(fault, details)
            if not all(servo.torque for servo in self._servos):
                self._fingers.drop()

    def clear(self) -> None:
        """End all faults; torque that went off stays off."""
        with self._lock:
            self._faults.clear()

    def facts(self) -> Facts:
        with self._lock:
            self._fingers.step(time.monotonic())
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
        request_real_time(inherited=False)
        while not self._ended.is_set():
            longest_s = _BUSY_S if self._fingers.busy else _IDLE_S
            now_s = time.monotonic()
            wait_s = min([longest_s, *(due_s - now_s for due_s, _ in self._late)])
            data = self._wire.read(max(0.0, wait_s))
            if not self._wire.plugged:
                self._ended.wait(_IDLE_S)
            with self._lock:
                try:
                    self._pass_time()
                    if data:
                        self._receive(data)
                except Exception:
                    _log.exception("the Dynamixel emulator failed: a bug of it; it goes on")
                    self._reader.forget()

    def _pass_time(self) -> None:
        now_s = time.monotonic()
        self._fingers.step(now_s)
        for servo in self._servos:
            servo.check_watchdog(now_s)
        due = [reply for due_s, reply in self._late if due_s <= now_s]
        self._late = [(due_s, reply) for due_s, reply in self._late if due_s > now_s]
        for reply in due:
            self._wire.write(reply)

    def _receive(self, data: bytes) -> None:
        baud, now_s = self._wire.baud(), time.monotonic()
        if not self._bus.hearing(baud):
            self._wire.write(self._faults.noise(data))
            return
        if now_s - self._received_s > BROKEN_OFF_S:
            self._reader.forget()
        self._received_s = now_s
        for instruction in self._reader.feed(data):
            self._instructions += 1
            for reply in self._bus.execute(instruction, baud):
                delay_s, output = self._faults.apply(reply)
                if delay_s > 0:
                    self._late.append((time.monotonic() + delay_s, output))
                else:
                    self._wire.write(output)

    def _on_written(self, written: Written) -> None:
        self._fingers.on_written(written)
        self._fingers.step(time.monotonic())


def run(options: DynamixelOptions) -> None:
    """Run a gripper with a block on a spring, until the process is to end."""
    with closing(DynamixelEmulator(options.load(), options, options.linkage())) as emulator:
        serve({"dynamixel": emulator}, {"serial_port": emulator.serial_port})
