"""How long a slip takes through the emulated wire: from its begin to the gripper's registers.

Part of ``tacgrasp bench reflex``. A process of its own holds the body of a drawn load between an
emulated taxel array and an emulated gripper, both on serial lines (ptys). Here the real drivers
and the runtime's own reflex follow it in real time.

A pty carries bytes at once: the 9.7 ms that a frame takes at 921,600 baud are not in these times.

Not here: the reflex without a wire (``loads``).
"""

from __future__ import annotations

import multiprocessing
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, closing, contextmanager
from dataclasses import dataclass, replace
from multiprocessing.connection import Connection
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from cltp.processor import torch_threads
from primitives.contract import Band, Contract
from primitives.devices import Pose
from primitives.errors import RobotError
from primitives.sense import Interval
from sim.emulators.dynamixel.bus_process import DynamixelEmulator
from sim.emulators.load_world import LoadWorld
from sim.emulators.process.lifetime import WORLD_PRIORITY, request_real_time
from sim.emulators.rig import FINGERS, GRIPPER
from sim.emulators.taxels.array import TaxelEmulator
from sim.grasp.devices import START_POSE
from sim.grasp.drawn.loads import draw_load
from tacgrasp.benchmarks.reflex.loads import LIMIT_FACTOR, SLIP_MM, onset_s, unit_of
from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tacgrasp.config.terms import contract_of
from tacgrasp.drivers.dynamixel.calibration import save_calibration
from tacgrasp.drivers.dynamixel.gripper import connect_gripper
from tacgrasp.drivers.taxels.connect import connect_taxels
from tacgrasp.episodes.command_log import CommandLog, LoggedGripper
from tacgrasp.rig.emulated import emulated_calibration
from tacgrasp.rig.factory import make_executor
from tacgrasp.rig.hardware import HardwareRig, RealClock
from tacgrasp.runtime.reflex_loop import ReflexLoop

SENSOR = "taxels"

START_S = 60.0
"""Longest wait for the emulators and for a load [s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class WireResult:
    """One load through the wire.

    Attributes:
        seed: Its random seed.
        slid: Whether it slid by ``loads.SLIP_MM`` or more, corrected as it was.
        called: Whether a raised force came to the gripper's registers.
        delay_ms: From the begin of the slide to that [ms]; None without both.
        largest_step_ms: Longest step of the emulated body: its time is real on the whole [ms].
        num_blind: Moments without a reading.
        command_ms: From each frame that led to a correction, as the driver had it, to the gripper's
            confirmation of the registers [ms].
    """

    seed: int
    slid: bool
    called: bool
    delay_ms: float | None
    largest_step_ms: float
    num_blind: int = 0
    command_ms: tuple[float, ...] = ()


def run_wire(seeds: Sequence[int], track: Callable[[int], None]) -> list[WireResult]:
    """Follow the loads of some seeds; those that can't be gripped are left out.

    Args:
        seeds: Random seeds of the loads.
        track: Called with each seed once it is done.

    Raises:
        RobotError: The emulators did not start, or a driver failed.
    """
    config, _ = load("strawberry", "emulated")
    results = []
    with _emulators(seeds[0]) as (connection, ports), _rig(config, *ports) as rig:
        for seed in seeds:
            result = _follow(seed, config, rig, connection)
            results += [] if result is None else [result]
            track(seed)
    return results


def _follow(
    seed: int, config: RunConfig, rig: HardwareRig, connection: Connection
) -> WireResult | None:
    connection.send(seed)
    force_n = _answer(connection)
    if force_n is None or LIMIT_FACTOR * force_n > config.gripper.max_force_n:
        return None
    felt = Interval(value=force_n, low=0.9 * force_n, high=1.1 * force_n)
    contract = _contract(config, force_n)
    executor = make_executor(rig, config, contract)
    executor.grasp(force_n)
    executor.feel(felt)
    reflex = ReflexLoop(rig, executor)
    with reflex.keeping(contract, felt):
        connection.send("load")
        result = _answer(connection)
    assert isinstance(result, WireResult)
    trace = reflex.take_trace()
    rig.commands()
    if trace is None:
        return result
    taken_s = [trace.t_s[trace.t_s <= each.t_s].max() for each in trace.corrections]
    command_ms = tuple(
        1e3 * float(each.t_s - at_s) for each, at_s in zip(trace.corrections, taken_s, strict=True)
    )
    return replace(result, num_blind=trace.num_blind, command_ms=command_ms)


def _contract(config: RunConfig, force_n: float) -> Contract:
    """A contract about a grip, as the benchmark without a wire has it."""
    band = Band(low=force_n / 2, high=2 * force_n)
    limit_n = LIMIT_FACTOR * force_n
    return replace(contract_of(config), force_n=band, limit_n=limit_n, soft=None, needs="")


class _StandingArm:
    """An arm that stands still; a ``primitives.devices.Arm``."""

    def pose(self) -> Pose:
        return START_POSE

    def move_to(
        self, pose: Pose, *, speed_m_s: float = 0.05, acceleration_m_s2: float = 0.5
    ) -> Pose:
        raise RobotError("this arm stands still")

    def stop(self) -> None: ...

    def disconnect(self) -> None: ...


@contextmanager
def _rig(config: RunConfig, gripper_port: str, sensor_port: str) -> Iterator[HardwareRig]:
    """The real drivers on the emulators' ports."""
    hardware = config.hardware
    assert hardware is not None  # the emulated rig has drivers
    with tempfile.TemporaryDirectory(prefix="tacgrasp-") as folder, ExitStack() as stack:
        calibration = Path(folder) / "gripper_calibration.yaml"
        save_calibration(calibration, emulated_calibration(hardware.dynamixel_gripper))
        settings = hardware.dynamixel_gripper.for_emulator(
            port=gripper_port, calibration=calibration
        )
        gripper = connect_gripper(settings)
        stack.callback(gripper.disconnect)
        sensor = connect_taxels(hardware.sensor.for_emulator(port=sensor_port, sensor=SENSOR))  # type: ignore[arg-type]
        stack.callback(sensor.disconnect)
        log = CommandLog(time.monotonic)
        yield HardwareRig(
            arm=_StandingArm(),
            gripper=LoggedGripper(gripper, log, lambda: gripper.sent),
            sensor=sensor,
            clock=RealClock(),
            command_log=log,
            start_pose=START_POSE,
            first_force_n=config.gripper.max_force_n,
            fault_counts=lambda: "",
        )


@contextmanager
def _emulators(seed: int) -> Iterator[tuple[Connection, tuple[str, str]]]:
    """The emulators' process; its connection, and the ports of gripper and sensor.

    Raises:
        RobotError: It did not start.
    """
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe()
    process = context.Process(target=_emulate, args=(theirs, seed), daemon=True)
    process.start()
    theirs.close()
    try:
        yield ours, _answer(ours)
    finally:
        ours.close()
        process.join(10)
        if process.is_alive():
            process.kill()


def _answer(connection: Connection):  # type: ignore[no-untyped-def]
    try:
        if connection.poll(START_S):
            return connection.recv()
    except EOFError:
        raise RobotError("the emulators of the reflex's wire have ended") from None
    raise RobotError(f"the emulators of the reflex's wire were silent for {START_S:g} s")


class _AnyLoad:
    """The world of the present load, for devices that stay the same from load to load."""

    def __init__(self, world: LoadWorld) -> None:
        self.world = self._seen = world

    def height_mm(self) -> NDArray[np.float32]:
        self._seen = self.world
        return self._seen.height_mm()

    def along_mm(self) -> NDArray[np.float32]:
        return self._seen.along_mm()  # of the same frame, also where the world has just changed

    def width_under(self, force_n: float) -> float:
        return self.world.width_under(force_n)

    def release(self) -> None:
        self.world.release()


def _world(seed: int) -> LoadWorld:
    drawn = draw_load(seed, SENSOR)
    return LoadWorld(drawn, unit_of(drawn, seed), np.random.default_rng([seed, 28]))


def _emulate(connection: Connection, seed: int) -> None:
    """The emulators' process: a seed asks for the force of its grip, ``load`` for the load."""
    request_real_time(priority=WORLD_PRIORITY)
    with torch_threads(), tempfile.TemporaryDirectory(prefix="tacgrasp-wire-") as folder:
        anything = next(world for world in map(_tried, range(seed, seed + 100)) if world)
        load_now = _AnyLoad(anything)
        gripper = DynamixelEmulator(load_now, GRIPPER, FINGERS)
        taxels = TaxelEmulator(
            load_now,
            link=Path(folder) / "taxel-array",
            along_mm=load_now.along_mm,
            rate_hz=anything.drawn.fingers.sensor.frame_hz,
            seed=seed,
        )
        with closing(gripper), closing(taxels):
            connection.send((gripper.serial_port, taxels.port))
            while True:
                try:
                    request = connection.recv()
                except EOFError:
                    return
                if request != "load":
                    seed, world = request, _tried(request)
                    load_now.world = world or load_now.world
                    connection.send(None if world is None else world.drawn.force_n)
                else:
                    connection.send(_result(seed, load_now.world))


def _tried(seed: int) -> LoadWorld | None:
    try:
        return _world(seed)
    except ValueError:
        return None


def _result(seed: int, world: LoadWorld) -> WireResult:
    frames = world.run()
    grip_n, begun_s = world.drawn.force_n, onset_s(frames)
    raised_s = next((at_s for at_s, force_n in world.commands if force_n > 1.01 * grip_n), None)
    has_delay = begun_s is not None and raised_s is not None
    return WireResult(
        seed=seed,
        slid=frames[-1].slipped_mm >= SLIP_MM,
        called=raised_s is not None,
        delay_ms=1e3 * (raised_s - begun_s) if has_delay else None,  # type: ignore[operator]
        largest_step_ms=1e3 * float(np.diff([each.t_s for each in frames]).max()),
    )
