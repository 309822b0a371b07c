"""A gripper of Dynamixel servos that holds a force in newtons; a ``primitives.devices.Gripper``.

The force comes from a calibration of this gripper; a missing, foreign or old calibration refuses
the start, or leaves a gripper that only opens. The driver never lets go by itself: torque stays on
at every end of a run, and the task decides when to open.
"""

from __future__ import annotations

import datetime
import logging
import math
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path

from primitives.devices import GripperState
from primitives.errors import LimitError, RobotError
from tacgrasp.drivers.check import (
    Finding,
    finding,
    force_limit_finding,
    read_durations_ms,
)
from tacgrasp.drivers.dynamixel import registers as reg
from tacgrasp.drivers.dynamixel.bus import Bus
from tacgrasp.drivers.dynamixel.calibration import (
    ADVICE,
    GripperCalibration,
    load_calibration,
    refusal,
)
from tacgrasp.drivers.dynamixel.errors import BusFaultCounts
from tacgrasp.drivers.dynamixel.fingers import ServoFingers, connect_fingers
from tacgrasp.drivers.dynamixel.kept_grip import read_kept_ma, read_width_m
from tacgrasp.drivers.dynamixel.servo_state import STATE_LENGTH
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings
from tacgrasp.drivers.dynamixel.startup_checks import startup_findings
from tacgrasp.drivers.opening import opening_problem
from tacgrasp.drivers.serial_ports import adapter_serial

LATENCY_READS = 200
SLOW_MS = 8.0
"""Limit of the 99th percentile [ms]; above it the adapter collects bytes (latency timer 16 ms)."""

_log = logging.getLogger(__name__)


class DynamixelGripper:
    """One or two servos under force control; made by ``connect_gripper``.

    A grip that an earlier run left is its state at first: closed, with the force of that grip.
    Without a calibration it only opens: forces are 0, and ``grip`` and ``adjust`` are refused.

    See ``primitives.devices.Gripper`` for the contract of each method. Every command raises
    ``RobotError`` after a fault, ``LimitError`` beyond ``max_force_n`` (nothing is sent then).
    """

    def __init__(
        self, fingers: ServoFingers, calibration: GripperCalibration | None, refusal: str = ""
    ) -> None:
        """Take connected fingers.

        Args:
            fingers: The fingers.
            calibration: Their force over current; None for a gripper that only opens.
            refusal: Why there is none; '' where there is one.
        """
        self._fingers, self._calibration, self._refusal = fingers, calibration, refusal
        kept_ma = fingers.kept_ma
        self._force_n, self._closed = 0.0, kept_ma is not None
        if kept_ma is not None and calibration is not None:
            self._force_n = calibration.force_n(kept_ma)

    @property
    def max_force_n(self) -> float:
        """Largest force [N], limited by the calibrated range and by ``max_current_ma``."""
        if self._calibration is None:
            return 0.0
        return _largest_n(self._calibration, self._fingers.settings)

    @property
    def force_step_n(self) -> float:
        """Least change of the force [N]: that of one unit of current."""
        calibration = self._calibration
        return 0.0 if calibration is None else calibration.step_n(self._fingers.unit_ma)

    @property
    def fault(self) -> str:
        return self._fingers.poller.fault

    @property
    def transients(self) -> BusFaultCounts:
        return replace(self._fingers.bus.counts)

    @property
    def sent(self) -> str:
        """The last command on the wire, in the servos' words; empty for none."""
        return self._fingers.sent

    def check_alive(self) -> str:
        """Return at once: why the arm must hold still; empty while the servos reply.

        Raises:
            RobotError: The gripper has a fault.
        """
        return self._fingers.poller.check_alive()

    def state(self) -> GripperState:
        return self._state(self._fingers.width_m())

    def grip(self, force_n: float) -> GripperState:
        current_ma = self._current_ma(force_n)
        # from here on an object may be held, also after an error
        self._force_n, self._closed = force_n, True
        return self._state(self._fingers.squeeze(current_ma))

    def adjust(self, force_n: float) -> GripperState:
        """As ``primitives.devices.AdjustableGripper``: returns once the registers are written."""
        current_ma = self._current_ma(force_n)
        if not self._closed:
            raise LimitError("only a closed grip is adjusted; close it with grip first")
        self._force_n = force_n
        return self._state(self._fingers.press(current_ma))

    def _current_ma(self, force_n: float) -> float:
        """Current of a force [N].

        Raises:
            LimitError: The force is out of range, or there is no calibration.
            RobotError: The gripper has a fault.
        """
        self._fingers.sent = ""
        if self._calibration is None:
            raise LimitError(self._refusal)
        if not (math.isfinite(force_n) and 0 < force_n <= self.max_force_n * (1 + 1e-9)):
            raise LimitError(
                f"force must lie in (0, {self.max_force_n:.2f}] N (calibrated range, and "
                f"max_current_ma {self._fingers.settings.max_current_ma:g}), got {force_n}"
            )
        if self.fault:
            raise self._fingers.poller.error()
        return max(self._fingers.unit_ma, self._calibration.current_ma(force_n))

    def open_by(self, clear_m: float) -> GripperState:
        self._fingers.sent = ""
        if not (math.isfinite(clear_m) and clear_m > 0):
            raise LimitError(f"the gripper opens by a positive number of metres, got {clear_m}")
        width_m = self._fingers.open_to(self._fingers.width_m() + clear_m)
        self._force_n, self._closed = 0.0, False
        return self._state(width_m)

    def stop(self) -> None:
        self._fingers.sent = ""
        try:
            self._fingers.freeze()
        except RobotError as error:
            _log.debug("nothing to stop: %s", error)

    def disconnect(self) -> None:
        self._fingers.disconnect()

    def _state(self, width_m: float) -> GripperState:
        return GripperState(width_m=width_m, force_n=self._force_n, closed=self._closed)


def connect_gripper(
    settings: DynamixelSettings,
    *,
    folder: Path = Path(),
    today: Callable[[], datetime.date] = datetime.date.today,
    must_grip: bool = True,
) -> DynamixelGripper:
    """Check calibration and servos, and let the servos hold their positions; nothing moves.

    Args:
        settings: The gripper's section of the rig's file.
        folder: Folder of the rig's file; the calibration's path is relative to it.
        today: Gives the date for the calibration's age.
        must_grip: Whether a calibration that does not fit is an error; otherwise it is a warning,
            and the gripper only opens.

    Raises:
        RobotError: The calibration does not fit, the port can't be opened, or a check fails.
    """
    path, calibration, reason = folder / settings.calibration, None, ""
    try:
        calibration = load_calibration(path)
    except RobotError as error:
        if must_grip:
            raise
        reason = str(error)
    fingers = connect_fingers(settings)
    if calibration is not None:
        reason = refusal(calibration, settings, adapter=fingers.adapter, today=today())
        reason = reason and f"{path}: {reason}"
    if not reason:
        return DynamixelGripper(fingers, calibration)
    if must_grip:
        fingers.disconnect()
        raise RobotError(reason)
    _log.warning("the gripper only opens: %s", reason)
    return DynamixelGripper(fingers, None, reason)


def _largest_n(calibration: GripperCalibration, settings: DynamixelSettings) -> float:
    return min(calibration.max_force_n, calibration.force_n(settings.max_current_ma))


def check(
    settings: DynamixelSettings,
    *,
    folder: Path = Path(),
    first_force_n: float | None = None,
    max_force_n: float | None = None,
) -> Sequence[Finding]:
    """Check the gripper for ``tacgrasp doctor``; nothing is written to it, nothing moves.

    Args:
        settings: The gripper's section of the rig's file.
        folder: Folder of the rig's file; the calibration's path is relative to it.
        first_force_n: The rig's ``gripper.first_force_n`` [N]; None is not checked.
        max_force_n: The rig's ``gripper.max_force_n`` [N]; None is not checked.
    """
    bus, adapter = Bus(settings), ""
    findings = []
    try:
        bus.open()
        findings.append(_finding("port", True, bus.path))
        adapter = adapter_serial(bus.path)
        servo_findings = startup_findings(bus, settings)
        findings += servo_findings
        if all(finding.ok for finding in servo_findings if finding.name.endswith(" model")):
            findings.append(_opening(bus, settings, folder))
        if servo_findings[0].ok:
            findings.append(_latency(bus, settings))
    except RobotError as error:
        adapter = ""
        findings.append(_finding("port", False, settings.port, f"{error}"))
    finally:
        bus.close()
    return [
        *findings,
        _calibration(settings, folder, adapter),
        *_forces(settings, folder, first_force_n, max_force_n),
    ]


_finding = partial(finding, "gripper")


def _opening(bus: Bus, settings: DynamixelSettings, folder: Path) -> Finding:
    """Whether the fingers are open, as a run needs them."""
    width_m, kept_ma, grip = read_width_m(bus, settings), read_kept_ma(bus, settings), ""
    detail = f"{1000 * width_m:.1f} mm of {settings.open_width_mm:g} mm"
    if kept_ma is not None:
        grip = f"{kept_ma:.0f} mA"
        detail += f", gripping with {grip}"
        with suppress(RobotError):  # a finding of its own
            force_n = load_calibration(folder / settings.calibration).force_n(kept_ma)
            grip = f"{force_n:.2f} N commanded"
    problem = opening_problem(width_m, grip)
    return _finding("opening", not problem, detail, f"a run is refused: {problem}")


def _latency(bus: Bus, settings: DynamixelSettings) -> Finding:
    servo = settings.servos[0].id
    p50, p99, longest = read_durations_ms(
        lambda: bus.read(servo, reg.TORQUE, STATE_LENGTH), LATENCY_READS
    )
    return _finding(
        "latency",
        p99 <= SLOW_MS,
        f"p50 {p50:.2f} ms, p99 {p99:.2f} ms, max {longest:.2f} ms over {LATENCY_READS} reads; "
        f"{bus.counts}",
        "set the USB adapter's latency timer to 1 ms (for ttyUSB0: echo 1 | sudo tee "
        "/sys/bus/usb-serial/devices/ttyUSB0/latency_timer), and end what else keeps this "
        "computer busy",
    )


def _calibration(settings: DynamixelSettings, folder: Path, adapter: str) -> Finding:
    today = datetime.date.today()
    try:
        calibration = load_calibration(folder / settings.calibration)
    except RobotError as error:
        return _finding("calibration", False, str(error).removesuffix(f"; {ADVICE}"), ADVICE)
    reason = refusal(calibration, settings, adapter=adapter, today=today)
    detail = (
        f"of {calibration.date}, {(today - calibration.date).days} days old, "
        f"{calibration.newtons_per_ma:.4f} N/mA from {calibration.friction_ma:.0f} mA on, "
        f"residual {calibration.residual_n:.3f} N, up to {calibration.max_force_n:.1f} N"
    )
    return _finding("calibration", not reason, detail, reason)


def _forces(
    settings: DynamixelSettings,
    folder: Path,
    first_force_n: float | None,
    max_force_n: float | None,
) -> list[Finding]:
    """Whether the gripper can make the rig's forces; nothing without a calibration."""
    try:
        calibration = load_calibration(folder / settings.calibration)
    except RobotError:  # a finding of its own
        return []
    found = []
    if first_force_n is not None:
        found.append(_first_force(settings, calibration, first_force_n))
    if max_force_n is not None:
        found.append(force_limit_finding(max_force_n, _largest_n(calibration, settings)))
    return found


def _first_force(
    settings: DynamixelSettings, calibration: GripperCalibration, first_force_n: float
) -> Finding:
    """Whether an approach can begin below its limit."""
    unit_ma = reg.MODELS[settings.model].unit_ma
    least_n = calibration.least_n(unit_ma)
    detail = (
        f"{first_force_n:g} N until something is felt, in steps of "
        f"{calibration.step_n(unit_ma):.3f} N or more; the least command is {least_n:.3f} N"
    )
    advice = (
        "an approach would press harder than gripper.first_force_n: set it to the least command or "
        "more, and grasp nothing that so much force bruises; or take a gripper with finer steps"
    )
    return _finding("first force", least_n <= first_force_n, detail, advice)
