"""``tacgrasp bench drivers``: period of supervision, and delay of commands and readings.

The emulated rig is driven through the real libraries with all devices at work: the arm moves to and
fro under supervision at 125 Hz, the gripper grips and opens, the sensor is read.
"""

from __future__ import annotations

import tempfile
import time
from collections import defaultdict
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from rich.progress import Progress

from primitives.devices import Pose
from sim.emulators.process.spawn import EmulatorProcess
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.figures import number_table, write_figures
from tacgrasp.benchmarks.settings import DriversSettings
from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tacgrasp.console import make_console
from tacgrasp.drivers.dynamixel.gripper import DynamixelGripper, connect_gripper
from tacgrasp.drivers.ur.arm import UrArm, connect_arm
from tacgrasp.drivers.ur.shared_state import Distribution
from tacgrasp.rig.emulated import settings_for
from tacgrasp.rig.hardware import connect_sensor
from tacgrasp.rig.protocols import WatchedSensor

STEP_M = 0.003
STATE_READS = 20
_DESCRIPTIONS = {
    "supervision": "period of the arm's supervision, nominally 8 ms",
    "command to motion": "arm: from a command to a speed above 1 mm/s",
    "gripper state": "gripper: opening read on the wire",
    "grip": "gripper: from the command until the fingers rest",
    "open": "gripper: 5 mm, from the command until the fingers rest",
    "touch": "sensor: a cloud captured after the call, 20 ms a frame",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class _Devices:
    arm: UrArm
    gripper: DynamixelGripper
    sensor: WatchedSensor


def run(settings: DriversSettings) -> None:
    """Drive the rig for some minutes, print the distributions and write them.

    Raises:
        RobotError: The emulators did not start, or a device failed on the way.
    """
    minutes = settings.minutes
    config, _ = load("strawberry", "emulated")
    console = make_console()
    with ExitStack() as stack:
        devices = _connect(config, stack)
        progress = stack.enter_context(Progress(console=console, transient=True))
        task = progress.add_task("drivers", total=60 * minutes)
        times_ms = _drive(devices, 60 * minutes, lambda s: progress.update(task, completed=s))
        timing = devices.arm.timing()
        transients = devices.gripper.transients
    figures = {
        "supervision": timing.period,
        "command to motion": timing.command_to_motion,
        **{name: _distribution(values) for name, values in times_ms.items()},
    }
    title = f"{minutes:g} minutes on the emulated rig, ms"
    table = number_table(title, ("", "count", "p50", "p99", "max"))
    for name, times in figures.items():
        cells = (f"{value:.1f}" for value in (times.p50_ms, times.p99_ms, times.max_ms))
        table.add_row(_DESCRIPTIONS[name], str(times.count), *cells)
    console.print(table)
    console.print(f"errors survived on the gripper's bus: {transients}")
    report = {"minutes": minutes} | {name: asdict(times) for name, times in figures.items()}
    write_figures(settings.json, report)


def _connect(config: RunConfig, stack: ExitStack) -> _Devices:
    if config.hardware is None:
        raise UsageError("rigs/emulated.yaml names no hardware")
    emulators = stack.enter_context(EmulatorProcess("rig"))
    folder = stack.enter_context(tempfile.TemporaryDirectory(prefix="tacgrasp-"))
    settings = settings_for(config, config.hardware, emulators, Path(folder))
    sensor = connect_sensor(settings.sensor)
    stack.callback(sensor.disconnect)
    gripper = connect_gripper(settings.dynamixel_gripper)
    stack.callback(gripper.disconnect)
    arm = connect_arm(settings.ur_arm)
    stack.callback(arm.disconnect)
    return _Devices(arm=arm, gripper=gripper, sensor=sensor)


def _drive(
    devices: _Devices, seconds: float, report: Callable[[float], None]
) -> Mapping[str, list[float]]:
    """Move, grip, open and read in turn; returns durations by name [ms]."""
    times: dict[str, list[float]] = defaultdict(list)

    def timed(name: str, call: Callable[[], object]) -> None:
        began_s = time.perf_counter()
        call()
        times[name].append(1e3 * (time.perf_counter() - began_s))

    start, began_s, sign = devices.arm.pose(), time.monotonic(), 1.0
    while (elapsed_s := time.monotonic() - began_s) < seconds:
        report(elapsed_s)
        target = Pose(
            position_m=start.position_m + np.array([sign * STEP_M, 0.0, 0.0]),
            rotvec_rad=start.rotvec_rad,
        )
        devices.arm.move_to(target, speed_m_s=0.1)
        sign = -sign
        timed("grip", lambda: devices.gripper.grip(1.0))
        for _ in range(STATE_READS):
            timed("gripper state", devices.gripper.state)
        timed("touch", devices.sensor.read)
        timed("open", lambda: devices.gripper.open_by(0.005))
    return times


def _distribution(values_ms: list[float]) -> Distribution:
    p50, p99, most = (float(value) for value in np.percentile(values_ms, [50, 99, 100]))
    return Distribution(count=len(values_ms), p50_ms=p50, p99_ms=p99, max_ms=most)
