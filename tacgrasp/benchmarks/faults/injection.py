"""``tacgrasp bench faults``: inject every fault into the emulated rig and see what comes of it.

Times to rest are measured by the emulator, from the injection until its tool is below 1 mm/s. One
repeat of every fault in motion happens inside a recorded episode, whose file is then read. Not
here: the faults (``tacgrasp.benchmarks.faults.cases``), the table
    (``tacgrasp.benchmarks.faults.table``).
"""

from __future__ import annotations

import datetime
import logging
import tempfile
import time
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from cltp.errors import TouchError
from cltp.tactile.sensors import sensor_named
from primitives.devices import Pose
from primitives.errors import RobotError
from sim.emulators.process.spawn import EmulatorProcess
from tacgrasp.benchmarks.faults.cases import STALE_BACKGROUND, FaultCase, InjectionPhase
from tacgrasp.benchmarks.faults.threads import Move, RecordedEpisode, bounded
from tacgrasp.config.hardware import HardwareConfig, StartConfig
from tacgrasp.config.schema import RunConfig
from tacgrasp.rig.emulated import settings_for
from tacgrasp.rig.hardware import HardwareRig, connect

log = logging.getLogger(__name__)

FloatArray = NDArray[np.float64]

REFUSED_S = 2.0
STOPPED_MS = 150.0
RECOVERED_MS = 100.0
"""What must hold, by phase."""

HUNG_S = 6.0
"""A call that has not come back after so long hangs."""

_ATTEMPTS = 6
_LOW_X_M, _HIGH_X_M = 0.37, 0.53
_INTO_S = (0.17, 0.30)
"""When faults are injected, after the beginning of the move [s]: at full speed."""


@dataclass(frozen=True, slots=True, kw_only=True)
class InjectionResult:
    """What one injected fault came to.

    Attributes:
        detected: The driver said what it must, in time.
        told: What the operator was told.
        noticed_ms: From the injection until the program knew [ms]; of a refusal, how long it took;
            of a transient fault, until the next good value.
        stop_ms: From the injection until the arm was at rest [ms], by the emulator; None when it
            was not moving.
        moved: The arm or the fingers moved that must not, or did not stop.
        hung: A call did not come back.
        invented: A value was given that was not measured.
        episode: What became of the recorded episode; '' without one.
    """

    detected: bool
    told: str
    noticed_ms: float
    stop_ms: float | None = None
    moved: bool = False
    hung: bool = False
    invented: bool = False
    episode: str = ""


class FaultBench:
    """Injects faults into one emulated rig, again and again."""

    def __init__(self, config: RunConfig, hardware: HardwareConfig, emulators: EmulatorProcess):
        """Take running emulators; calibration and episodes are kept until ``close``."""
        self._config, self._named, self._emulators = config, hardware, emulators
        self._folder = tempfile.TemporaryDirectory(prefix="tacgrasp-faults-")
        here = StartConfig(at="here")
        found = settings_for(hardware, emulators, Path(self._folder.name))
        self._hardware = found.model_copy(update={"start": here})
        self._rng = np.random.default_rng(config.seed)

    def close(self) -> None:
        """Remove what was recorded."""
        self._folder.cleanup()

    def trial(self, case: FaultCase, *, in_episode: bool) -> InjectionResult:
        """Inject one fault; every fault is gone afterwards."""
        if case.name == STALE_BACKGROUND:
            return self._stale_background(case)
        if in_episode:
            return self._in_episode(case)
        try:
            if case.phase is InjectionPhase.START:
                return self._at_start(case)
            if case.phase is InjectionPhase.MOTION:
                return self._in_motion(case)
            return self._passing(case)
        finally:
            for device in ("ur", "dynamixel", "taxels"):
                self._emulators.control.clear(device)

    # -- start -----------------------------------------------------------------------------------

    def _at_start(self, case: FaultCase) -> InjectionResult:
        before = self._where()
        self._inject(case)
        began_s = time.monotonic()
        told, hung = bounded(lambda: self._connect_one(case.device))
        took_s, told = time.monotonic() - began_s, self._plain(told)
        moved = bool(np.abs(np.subtract(self._where(), before)).max() > 1e-6)
        return InjectionResult(
            detected=_says(case, told) and took_s < REFUSED_S,
            told=told,
            noticed_ms=1e3 * took_s,
            moved=moved,
            hung=hung,
        )

    def _connect_one(self, device: str) -> None:
        """Connect the one device that has the fault, and let it go again."""
        if device == "ur":
            from tacgrasp.drivers.ur.arm import connect_arm

            connect_arm(self._hardware.arm).disconnect()
        elif device == "dynamixel":
            from tacgrasp.drivers.dynamixel.gripper import connect_gripper

            connect_gripper(self._hardware.gripper).disconnect()
        else:
            from tacgrasp.rig.hardware import connect_sensor

            connect_sensor(self._hardware.sensor, self._config).disconnect()

    def _stale_background(self, case: FaultCase) -> InjectionResult:
        from tacgrasp.drivers.gelsight.background import Background, save_background
        from tacgrasp.drivers.gelsight.connect import connect_gelsight
        from tacgrasp.drivers.gelsight.settings import GelSightSettings

        sensor, path = sensor_named("gelsight_mini"), Path(self._folder.name) / "background.png"
        taken = datetime.datetime.now().astimezone() - datetime.timedelta(days=3)
        frame = np.full((sensor.rows, sensor.columns, 3), 128, dtype=np.uint8)
        save_background(path, Background(frame=frame, unit="mine", taken=taken, num_frames=20))
        settings = GelSightSettings(device="/dev/no-camera", unit="mine", background=path)
        began_s = time.monotonic()
        told, hung = bounded(lambda: connect_gelsight(settings).disconnect())
        took_s, told = time.monotonic() - began_s, self._plain(told)
        detected = _says(case, told) and took_s < REFUSED_S
        return InjectionResult(detected=detected, told=told, noticed_ms=1e3 * took_s, hung=hung)

    # -- motion ----------------------------------------------------------------------------------

    def _in_motion(self, case: FaultCase) -> InjectionResult:
        with ExitStack() as stack:
            rig = self._connected(stack)
            move = Move(rig, self._across(rig))
            time.sleep(float(self._rng.uniform(*_INTO_S)))
            injected_s = self._inject(case)
            hung = not move.wait(HUNG_S)
            stop_ms = self._stop_ms()
            invented = False if hung else self._invents(rig, case)
        return InjectionResult(
            detected=_says(case, move.told),
            told=self._plain(move.told),
            noticed_ms=1e3 * (move.ended_s - injected_s),
            stop_ms=stop_ms,
            moved=stop_ms is None,
            hung=hung,
            invented=invented,
        )

    def _passing(self, case: FaultCase) -> InjectionResult:
        with ExitStack() as stack:
            rig = self._connected(stack)
            target = self._across(rig)
            move = Move(rig, target)
            time.sleep(float(self._rng.uniform(*_INTO_S)))
            before = rig.survived()
            injected_s = self._inject(case)
            error, invented = "", False
            try:
                value, good_s = _read(rig, case.device), time.monotonic()
                invented = self._is_wrong(case.device, value)
            except (RobotError, TouchError) as failure:  # it was not survived
                error, good_s = str(failure), time.monotonic()
            hung = not move.wait(HUNG_S)
            after = rig.survived()
        recovered_ms = 1e3 * (good_s - injected_s)
        arrived = move.reached is not None and bool(
            np.allclose(move.reached.position_m, target.position_m, atol=1e-3)
        )
        return InjectionResult(
            detected=not error
            and after != before
            and _says(case, after)
            and recovered_ms < RECOVERED_MS,
            told=self._plain(error or move.told or f"nothing, it is counted: {after}"),
            noticed_ms=recovered_ms,
            moved=not arrived,
            hung=hung,
            invented=invented,
        )

    def _in_episode(self, case: FaultCase) -> InjectionResult:
        """The fault happens at the first motion of a recorded episode, in a world of its own."""
        with EmulatorProcess("rig", "--seed", str(self._config.seed)) as emulators:
            own = FaultBench(self._config, self._named, emulators)
            try:
                return own._episode(case)
            finally:
                own.close()

    def _episode(self, case: FaultCase) -> InjectionResult:
        with ExitStack() as stack:
            rig = self._connected(stack)
            record = {"record": Path(self._folder.name), "policy": "rules"}
            episode = RecordedEpisode(rig, self._config.model_copy(update=record))
            moving = self._wait_for_motion(episode)
            injected_s = self._inject(case)
            hung = not episode.wait(60.0)
            stop_ms = self._stop_ms() if case.phase is InjectionPhase.MOTION and moving else None
            counted = rig.survived()
        passing = case.phase is InjectionPhase.TRANSIENT
        told = self._plain(counted if passing else episode.message)
        return InjectionResult(
            detected=_says(case, told),
            told=told,
            noticed_ms=1e3 * (episode.ended_s - injected_s),
            stop_ms=stop_ms,
            moved=not moving,
            hung=hung,
            episode=episode.intact(want_fault=not passing),
        )

    def _wait_for_motion(self, episode: RecordedEpisode) -> bool:
        until_s = time.monotonic() + 20.0
        while time.monotonic() < until_s and not episode.ended:
            speed = self._emulators.control.facts("ur")["tcp_speed_m_s"]
            if isinstance(speed, float) and speed > 0.01:
                return True
        return False

    # -- the rig ---------------------------------------------------------------------------------

    def _connected(self, stack: ExitStack) -> HardwareRig:
        """A connected rig; a controller that has just been restarted takes its time."""
        for attempt in range(_ATTEMPTS):
            try:
                rig = connect(self._config, self._hardware, 1.0)
                break
            except (RobotError, TouchError) as error:
                if attempt == _ATTEMPTS - 1:
                    raise
                log.info("not connected yet: %s", error)
                time.sleep(1.0)
        stack.callback(rig.disconnect)
        return rig

    def _across(self, rig: HardwareRig) -> Pose:
        """The far side of the workspace."""
        here = rig.arm.pose()
        near_low = here.position_m[0] - _LOW_X_M < _HIGH_X_M - here.position_m[0]
        x_m = _HIGH_X_M if near_low else _LOW_X_M
        position_m = np.array([x_m, here.position_m[1], here.position_m[2]])
        return Pose(position_m=position_m, rotvec_rad=here.rotvec_rad)

    def _inject(self, case: FaultCase) -> float:
        control = self._emulators.control
        if case.device != "ur":  # the arm's emulator measures from its own injections on
            control.inject("ur", "contact_force", force_n=0.0)
        control.inject(case.device, case.fault, **case.details)
        return time.monotonic()

    def _plain(self, told: str) -> str:
        """What was told, with names in place of addresses that differ from run to run."""
        names = {"host": "HOST", "gripper_port": "PORT", "sensor_port": "PORT"}
        for key, name in names.items():
            told = told.replace(str(self._emulators.ready[key]), name)
        return told.replace(f"{self._folder.name}/", "")

    def _stop_ms(self) -> float | None:
        """Time to rest as the emulator measured it; None when the tool does not come to rest."""
        until_s = time.monotonic() + 3.0
        while time.monotonic() < until_s:
            stopped = self._emulators.control.facts("ur")["stopped_after_ms"]
            if isinstance(stopped, float):
                return stopped
            time.sleep(0.01)
        return None

    def _where(self) -> tuple[float, ...]:
        arm, hand = (self._emulators.control.facts(name) for name in ("ur", "dynamixel"))
        names = ("tcp_x_m", "tcp_y_m", "tcp_z_m")
        return (*(float(str(arm[name])) for name in names), float(str(hand["width_m"])))

    def _invents(self, rig: HardwareRig, case: FaultCase) -> bool:
        """Whether the device that failed still gives values, and they are not the true ones."""
        try:
            value = _read(rig, case.device)
        except (RobotError, TouchError):
            return False
        return self._is_wrong(case.device, value)

    def _is_wrong(self, device: str, value: FloatArray) -> bool:
        """Compare what was read with the truth; of a touch, whether it is one at all."""
        if device == "taxels":
            return float(np.ptp(value)) == 0
        truth = self._where()[:3] if device == "ur" else self._where()[3:]
        return bool(np.abs(value - truth).max() > 1e-3)


def _read(rig: HardwareRig, device: str) -> FloatArray:
    """What a device measures: position of the tool [m], opening [m], or depths [mm]."""
    if device == "ur":
        return rig.arm.pose().position_m
    if device == "dynamixel":
        return np.array([rig.gripper.state().width_m])
    return np.array(rig.sensor.read().points_mm[:, 2], dtype=np.float64)


def _says(case: FaultCase, told: str) -> bool:
    return any(word.lower() in told.lower() for word in case.told)
