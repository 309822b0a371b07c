"""Communication test of a rig: all devices are read at their rates for some seconds, side by side.

Source: libfranka's ``communication_test``, which prints the success rate of a command every
millisecond. Nothing moves, and nothing is written but the taxels' marks.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from cltp.errors import TouchError
from primitives.errors import RobotError
from tacgrasp.base.errors import UsageError
from tacgrasp.config.hardware import HardwareConfig
from tacgrasp.config.schema import RunConfig
from tacgrasp.drivers.check import Finding, finding
from tacgrasp.drivers.recorded.settings import RecordedSettings
from tacgrasp.drivers.scheduling import request_priority
from tacgrasp.rig.hardware import connect_sensor

if TYPE_CHECKING:
    from tacgrasp.drivers.dynamixel.bus import Bus

LEAST_SUCCESS = 0.99
"""Least fraction of readings that must arrive. Our choice; libfranka's users live with 0.95."""

Soak = Callable[[], Finding]


@dataclass(slots=True, kw_only=True)
class SoakCount:
    """Readings of one device.

    Attributes:
        expected: Number of readings that should have come.
        received: Number that came whole and in time.
        gaps_ms: What jitters [ms]: intervals between readings, or the time that each took.
    """

    expected: int
    received: int
    gaps_ms: Sequence[float]

    def finding(self, device: str, reading: str, longest_ms: float, note: str = "") -> Finding:
        """The result as a finding.

        Args:
            device: Name of the device.
            reading: What ``gaps_ms`` are, for people.
            longest_ms: Longest gap that the driver takes without a fault or a hold.
            note: More about it.
        """
        success = min(1.0, self.received / max(1, self.expected))
        p50, p99, worst = np.percentile(list(self.gaps_ms) or [np.nan], [50, 99, 100])
        ok = success >= LEAST_SUCCESS and bool(p99 <= longest_ms)
        detail = (
            f"success {100 * success:.2f} % of {self.expected}; {reading} {p50:.1f} ms (p50), "
            f"{p99:.1f} ms (p99), {worst:.1f} ms (max); limit {longest_ms:.0f} ms{note}"
        )
        advice = (
            f"expected are {100 * LEAST_SUCCESS:.0f} % and a p99 below {longest_ms:.0f} ms: use a "
            "direct cable, a USB port of its own, and a computer that does nothing else"
        )
        return finding(device, "soak", ok, detail, advice)


def soak_findings(hardware: HardwareConfig, config: RunConfig, seconds: float) -> list[Finding]:
    """Read all devices side by side for ``seconds`` [s]; one finding a device."""
    soaks: dict[str, Soak] = {
        "arm": lambda: _arm(hardware, seconds),
        "gripper": lambda: _gripper(hardware, seconds),
        "sensor": lambda: _sensor(hardware, config, seconds),
    }
    with ThreadPoolExecutor(len(soaks), initializer=request_priority) as pool:
        futures = {device: pool.submit(soak) for device, soak in soaks.items()}
        return [_result(device, future.result) for device, future in futures.items()]


def _result(device: str, soak: Soak) -> Finding:
    try:
        return soak()
    except UsageError as error:  # a plugin's device has a line of its own
        return finding(device, "soak", True, f"not tested: {error}")
    except (RobotError, TouchError) as error:
        advice = "see the device's other findings; then let it soak again"
        return finding(device, "soak", False, f"it ended early: {error}", advice)


def _arm(hardware: HardwareConfig, seconds: float) -> Finding:
    """Packets of the controller's stream; their number and own gaps by the controller's clock."""
    from tacgrasp.drivers.ur.dashboard import Rtde

    rate_hz = hardware.ur_arm.supervision_hz
    with closing(Rtde(hardware.ur_arm.host)) as rtde:
        rtde.subscribe(["timestamp"], rate_hz)
        rtde.start()
        stamps_s, arrivals_s = [rtde.sample()["timestamp"][0]], [time.monotonic()]
        while arrivals_s[-1] - arrivals_s[0] < seconds:
            stamps_s.append(rtde.sample()["timestamp"][0])
            arrivals_s.append(time.monotonic())
    expected = 1 + round((stamps_s[-1] - stamps_s[0]) * rate_hz)
    own_ms = 1e3 * float(np.max(np.diff(stamps_s)))
    count = SoakCount(
        expected=expected, received=len(stamps_s), gaps_ms=(1e3 * np.diff(arrivals_s)).tolist()
    )
    note = f"; by the controller's own clock {own_ms:.1f} ms (max)"
    return count.finding("arm", "a packet every", hardware.ur_arm.stale_ms, note)


def _gripper(hardware: HardwareConfig, seconds: float) -> Finding:
    """Reads of every servo's state, as often as the driver polls."""
    from tacgrasp.drivers.dynamixel import registers as reg
    from tacgrasp.drivers.dynamixel.bus import Bus
    from tacgrasp.drivers.dynamixel.errors import BusError
    from tacgrasp.drivers.dynamixel.servo_state import STATE_LENGTH

    settings = hardware.dynamixel_gripper
    bus = Bus(settings)
    durations_ms: list[float] = []
    bus.patience_s, num_reads = 0.0, 0
    try:
        bus.open()
        due_s = began_s = time.monotonic()
        while due_s - began_s < seconds:
            for servo in settings.ids:
                num_reads, start_s, bad = num_reads + 1, time.monotonic(), _num_bad(bus)
                try:
                    bus.read(servo, reg.TORQUE, STATE_LENGTH)
                except BusError:
                    continue
                if _num_bad(bus) == bad:
                    durations_ms.append(1e3 * (time.monotonic() - start_s))
            due_s = max(due_s + settings.poll_ms / 1e3, time.monotonic())
            time.sleep(max(0.0, due_s - time.monotonic()))
    finally:
        bus.close()
    count = SoakCount(expected=num_reads, received=len(durations_ms), gaps_ms=durations_ms)
    return count.finding("gripper", "a reply within", 1e3 * settings.stale_s, f"; {bus.counts}")


def _num_bad(bus: Bus) -> int:
    return bus.counts.silent + bus.counts.corrupt


def _sensor(hardware: HardwareConfig, config: RunConfig, seconds: float) -> Finding:
    """Reads of fresh frames, one after the other."""
    settings = hardware.sensor
    if isinstance(settings, RecordedSettings) or not settings.is_live:
        return finding("sensor", "soak", True, "a recording: it has no line to test")
    sensor, durations_ms, num_reads = connect_sensor(settings.without_force()), [], 0
    try:
        began_s = time.monotonic()
        while time.monotonic() - began_s < seconds:
            num_reads, start_s = num_reads + 1, time.monotonic()
            try:
                sensor.read()
            except TouchError:
                continue
            durations_ms.append(1e3 * (time.monotonic() - start_s))
        counts = sensor.counts()
    finally:
        sensor.disconnect()
    count = SoakCount(expected=num_reads, received=len(durations_ms), gaps_ms=durations_ms)
    longest_ms = 1e3 * settings.read_timeout_s / 2
    return count.finding("sensor", "a fresh cloud within", longest_ms, f"; {counts}")
