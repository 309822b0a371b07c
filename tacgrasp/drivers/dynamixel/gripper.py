"""A gripper of Dynamixel servos that holds a force in newtons; a ``primitives.devices.Gripper``.

Force comes from a calibration of this very gripper; without one that fits and is young enough
nothing starts. The driver never lets go by itself: torque stays on at every end, and opening is for
the task to decide.
"""

from __future__ import annotations

import datetime
import logging
import math
import time
from collections.abc import Callable, Sequence
from pathlib import Path

from primitives.devices import GripperState
from primitives.errors import LimitError, RobotError
from tacgrasp.drivers.check import Finding
from tacgrasp.drivers.dynamixel import registers as at
from tacgrasp.drivers.dynamixel.bus import Bus
from tacgrasp.drivers.dynamixel.calibration import GripperCalibration, load_calibration, refusal
from tacgrasp.drivers.dynamixel.errors import Counts
from tacgrasp.drivers.dynamixel.fingers import Hand, connect_hand
from tacgrasp.drivers.dynamixel.poller import OnFault
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings
from tacgrasp.drivers.dynamixel.startup_checks import start_findings
from tacgrasp.drivers.serial_ports import adapter_serial

LATENCY_READS = 200
SLOW_MS = 8.0
"""A 99th percentile above this tells that the adapter collects bytes: its timer is at 16 ms."""

_log = logging.getLogger(__name__)


class DynamixelGripper:
    """One or two servos under force control; made by ``connect_gripper``."""

    def __init__(self, hand: Hand, calibration: GripperCalibration) -> None:
        self._hand, self._calibration = hand, calibration
        self._force_n, self._closed = 0.0, False

    @property
    def max_force_n(self) -> float:
        """Largest force that it takes [N]: what was calibrated, and what its current allows."""
        most = self._calibration.force_n(self._hand.settings.max_current_ma)
        return min(self._calibration.max_force_n, most)

    @property
    def fault(self) -> str:
        """Why it can't be used any more; empty while it can."""
        return self._hand.watch.fault

    @property
    def transients(self) -> Counts:
        """Faults of the bus that were survived so far."""
        return self._hand.transients

    @property
    def sent(self) -> str:
        """What the last command put on the wire, in the servos' words; empty when nothing."""
        return self._hand.sent

    def healthy(self) -> bool:
        """Whether the last poll, some milliseconds ago, was good; costs nothing."""
        return self._hand.watch.healthy()

    def tell_faults_to(self, on_fault: OnFault) -> None:
        """Call this, once and from the I/O thread, when the gripper fails, whatever else goes on.

        When it has failed already it is called at once. It must be quick: stop the arm.
        """
        self._hand.watch.tell(on_fault)

    def hurry_while(self, arm_moves: Callable[[], bool]) -> None:
        """Take silence for a fault at once only while the arm moves.

        Until this is called it always is: two answers missed, about 60 ms. While the arm stands
        there is no hurry (``patience_ms``), and a busy computer ends no episode.

        Args:
            arm_moves: Asked from the I/O thread when an answer is missing; quick.
        """
        self._hand.hurry_while(arm_moves)

    def state(self) -> GripperState:
        """Opening, read now, and the force last commanded.

        Raises:
            RobotError: It can't be read, or the gripper has a fault.
        """
        return self._state(self._hand.width_m())

    def grip(self, force_n: float) -> GripperState:
        """Close, or adjust a grip, to a force [N]; returns when the fingers rest.

        Raises:
            LimitError: The force is none or beyond the device; nothing is sent.
            RobotError: The fingers do not come to rest, or the gripper has a fault.
        """
        self._hand.sent = ""
        if not (math.isfinite(force_n) and 0 < force_n <= self.max_force_n * (1 + 1e-9)):
            raise LimitError(
                f"force must lie in (0, {self.max_force_n:.2f}] N (what is calibrated, and "
                f"max_current_ma {self._hand.settings.max_current_ma:g}), got {force_n}"
            )
        current_ma = self._calibration.current_ma(force_n)
        self._check()
        # from here on something may be held, also when what follows fails
        self._force_n, self._closed = force_n, True
        return self._state(self._hand.squeeze(max(self._hand.unit_ma, current_ma)))

    def open_by(self, clear_m: float) -> GripperState:
        """Open by ``clear_m`` [m] from the present width, up to the end of the travel.

        Raises:
            LimitError: ``clear_m`` is not positive; nothing is sent.
            RobotError: The fingers do not get there, or the gripper has a fault.
        """
        self._hand.sent = ""
        if not (math.isfinite(clear_m) and clear_m > 0):
            raise LimitError(f"the gripper opens by a positive number of metres, got {clear_m}")
        width_m = self._hand.open_to(self._hand.width_m() + clear_m)
        self._force_n, self._closed = 0.0, False
        return self._state(width_m)

    def stop(self) -> None:
        """Stop fingers that are on their way; a grip is kept. Idempotent, never raises."""
        self._hand.sent = ""
        try:
            self._hand.freeze()
        except RobotError as error:
            _log.debug("nothing to stop: %s", error)

    def disconnect(self) -> None:
        """Free the port, keeping the present grip. Idempotent, never raises."""
        self._hand.disconnect()

    def _check(self) -> None:
        if self.fault:
            raise RobotError(self.fault)

    def _state(self, width_m: float) -> GripperState:
        return GripperState(width_m=width_m, force_n=self._force_n, closed=self._closed)


def connect_gripper(
    settings: DynamixelSettings,
    *,
    folder: Path = Path(),
    on_fault: OnFault | None = None,
    clock: Callable[[], float] = time.monotonic,
    today: Callable[[], datetime.date] = datetime.date.today,
) -> DynamixelGripper:
    """Check calibration and servos, and let them hold where they are; nothing moves.

    Args:
        settings: What the rig's file says.
        folder: Of the rig's file; the calibration's path is relative to it.
        on_fault: See ``DynamixelGripper.tell_faults_to``.
        clock: Monotonic [s].
        today: For the calibration's age.

    Raises:
        RobotError: The calibration does not fit, the port can't be had, or a check refuses.
    """
    calibration = load_calibration(folder / settings.calibration)
    hand = connect_hand(settings, on_fault=on_fault, clock=clock)
    why = refusal(calibration, settings, adapter=hand.adapter, today=today())
    if why:
        hand.disconnect()
        raise RobotError(f"{folder / settings.calibration}: {why}")
    return DynamixelGripper(hand, calibration)


def check(
    settings: DynamixelSettings,
    *,
    folder: Path = Path(),
    clock: Callable[[], float] = time.perf_counter,
    today: Callable[[], datetime.date] = datetime.date.today,
) -> Sequence[Finding]:
    """Look at the gripper for ``tacgrasp doctor``; nothing is written to it, nothing moves."""
    bus = Bus(settings)
    findings = []
    try:
        bus.open()
        findings.append(Finding(device="gripper", name="port", ok=True, found=bus.path))
        adapter = adapter_serial(bus.path)
        found = start_findings(bus, settings)
        findings += found
        if found[0].ok:
            findings.append(_latency(bus, settings, clock))
    except RobotError as error:
        findings.append(
            Finding(
                device="gripper",
                name="port",
                ok=False,
                found=settings.port,
                advice=f"{error}",
            )
        )
        adapter = ""
    finally:
        bus.close()
    findings.append(_calibration(settings, folder, adapter, today()))
    return findings


def _latency(bus: Bus, settings: DynamixelSettings, clock: Callable[[], float]) -> Finding:
    took_ms = []
    for _ in range(LATENCY_READS):
        began_s = clock()
        bus.read(settings.servos[0].id, at.PRESENT, at.PRESENT_LENGTH)
        took_ms.append(1000 * (clock() - began_s))
    took_ms.sort()
    middle, high = took_ms[len(took_ms) // 2], took_ms[(99 * len(took_ms)) // 100]
    return Finding(
        device="gripper",
        name="latency",
        ok=high <= SLOW_MS,
        found=f"p50 {middle:.2f} ms, p99 {high:.2f} ms, max {took_ms[-1]:.2f} ms over "
        f"{len(took_ms)} reads; {bus.counts}",
        advice=""
        if high <= SLOW_MS
        else "set the USB adapter's latency timer to 1 ms (for ttyUSB0: echo 1 | sudo tee "
        "/sys/bus/usb-serial/devices/ttyUSB0/latency_timer), and end what else keeps this "
        "computer busy",
    )


def _calibration(
    settings: DynamixelSettings, folder: Path, adapter: str, today: datetime.date
) -> Finding:
    path = folder / settings.calibration
    mend = "make one with: tacgrasp calibrate gripper"
    try:
        calibration = load_calibration(path)
    except RobotError as error:
        return Finding(
            device="gripper", name="calibration", ok=False, found=f"{error}", advice=mend
        )
    why = refusal(calibration, settings, adapter=adapter, today=today)
    found = (
        f"of {calibration.date}, {(today - calibration.date).days} days old, "
        f"{calibration.newtons_per_ma:.4f} N/mA from {calibration.friction_ma:.0f} mA on, "
        f"residual {calibration.residual_n:.3f} N, up to {calibration.max_force_n:.1f} N"
    )
    return Finding(
        device="gripper",
        name="calibration",
        ok=not why,
        found=found,
        advice=why,
    )
