"""Injection of one fault into the emulated rig, and measurement of the reaction.

Times to rest are measured by the emulator, from the injection until its tool is below 1 mm/s. Not
here: the faults (``tacgrasp.benchmarks.faults.cases``), the table
(``tacgrasp.benchmarks.faults.table``).
"""

from __future__ import annotations

import datetime
import logging
import tempfile
import time
from contextlib import ExitStack, closing
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from cltp.errors import TouchError
from cltp.tactile.sensors import sensor_named
from primitives.devices import Pose
from primitives.errors import RobotError
from sim.emulators.process.spawn import EmulatorProcess
from tacgrasp.benchmarks.faults.cases import FaultCase, InjectionPhase
from tacgrasp.benchmarks.faults.reaction import (
    LOADED_MS,
    RECOVERED_MS,
    REFUSED_S,
    InjectionResult,
    is_expected,
    noticed_s,
    read_device,
)
from tacgrasp.benchmarks.faults.threads import BackgroundCall, Episode, check_episode
from tacgrasp.config.hardware import HardwareConfig, StartConfig
from tacgrasp.config.schema import RunConfig
from tacgrasp.config.terms import contract_of
from tacgrasp.policy_factory import make_policy
from tacgrasp.rig.emulated import settings_for
from tacgrasp.rig.hardware import HardwareRig, connect, connect_sensor
from tacgrasp.run import run_recorded
from tacgrasp.runtime.outcome import EndReason

log = logging.getLogger(__name__)

FloatArray = NDArray[np.float64]

HUNG_S, CONNECT_S, EPISODE_S = 6.0, 10.0, 60.0
"""Times after which a move, connecting and an episode count as hung [s]."""

GRIP_N = 1.0
"""Force of a grip during which a fault is injected [N]."""

SPEED_M_S, ACCELERATION_M_S2 = 0.4, 2.5

_MAX_ATTEMPTS = 6
_LOW_X_M, _HIGH_X_M = 0.37, 0.53
_DELAY_S = (0.0, 0.06)
"""Range of times from full speed to the injection [s]: a quarter of the way at full speed."""


class FaultBench:
    """Injects faults into one emulated rig, one after the other."""

    def __init__(
        self,
        config: RunConfig,
        hardware: HardwareConfig,
        emulators: EmulatorProcess,
        *,
        is_loaded: bool = False,
    ) -> None:
        """Use running emulators; calibration and episodes are kept until ``close``."""
        self._config, self._rig_file, self._emulators = config, hardware, emulators
        self._recovered_ms = LOADED_MS if is_loaded else RECOVERED_MS
        self._folder = tempfile.TemporaryDirectory(prefix="tacgrasp-faults-")
        self._background = Path(self._folder.name) / "background.png"
        settings = settings_for(config, hardware, emulators, Path(self._folder.name))
        self._hardware = settings.model_copy(update={"start": StartConfig(at="here")})
        self._rng = np.random.default_rng([config.seed, 11])  # apart from those of its world

    def close(self) -> None:
        self._folder.cleanup()

    def inject(self, case: FaultCase, *, in_episode: bool) -> InjectionResult:
        """Inject one fault and measure the reaction; every fault is cleared afterwards."""
        if in_episode:
            return self._in_episode(case)
        try:
            if case.phase is InjectionPhase.START:
                return self._at_start(case)
            if case.phase is InjectionPhase.MOTION:
                for _ in range(_MAX_ATTEMPTS):
                    result = self._in_motion(case)
                    if result.stop_ms is not None or not self._is_at_rest():
                        break
                    self._clear()  # the move had ended before the fault came: no trial
                return result
            return self._transient(case)
        finally:
            self._clear()

    def _clear(self) -> None:
        for device in ("ur", "dynamixel", "taxels"):
            self._emulators.control.clear(device)

    def _is_at_rest(self) -> bool:
        return self._emulators.control.facts("ur")["tcp_speed_m_s"] == 0.0

    def _at_start(self, case: FaultCase) -> InjectionResult:
        before = self._truth()
        self._inject(case)
        began_s = time.monotonic()
        call = BackgroundCall(lambda: self._connect_device(case.device))
        hung = not call.wait(CONNECT_S)
        refused_s, message = time.monotonic() - began_s, self._anonymised(call.error)
        return InjectionResult(
            detected=is_expected(case, message) and refused_s < REFUSED_S,
            message=message,
            noticed_ms=1e3 * refused_s,
            moved=bool(np.abs(np.subtract(self._truth(), before)).max() > 1e-6),
            hung=hung,
        )

    def _connect_device(self, device: str) -> None:
        if device == "ur":
            from tacgrasp.drivers.ur.arm import connect_arm

            connect_arm(self._hardware.ur_arm).disconnect()
        elif device == "dynamixel":
            from tacgrasp.drivers.dynamixel.gripper import connect_gripper

            connect_gripper(self._hardware.dynamixel_gripper).disconnect()
        elif device == "taxels":
            connect_sensor(self._hardware.sensor).disconnect()
        else:
            from tacgrasp.drivers.gelsight.connect import connect_gelsight
            from tacgrasp.drivers.gelsight.settings import GelSightSettings

            settings = GelSightSettings(
                device="/dev/no-camera", unit="mine", background=self._background
            )
            connect_gelsight(settings).disconnect()

    def _save_stale_background(self) -> None:
        """Save a background of a GelSight Mini, taken three days ago."""
        from tacgrasp.drivers.gelsight.background import Background, save_background

        sensor = sensor_named("gelsight_mini")
        taken = datetime.datetime.now().astimezone() - datetime.timedelta(days=3)
        frame = np.full((sensor.rows, sensor.columns, 3), 128, dtype=np.uint8)
        background = Background(frame=frame, unit="mine", taken=taken, num_frames=20)
        save_background(self._background, background)

    def _in_motion(self, case: FaultCase) -> InjectionResult:
        with ExitStack() as stack:
            rig = self._connect(stack)
            if case.holding:
                rig.gripper.grip(GRIP_N)
            move = _start_move(rig, self._far_side(rig))
            self._wait_at_speed(move)
            early = move.error if move.wait(0) else ""
            injected_s = self._inject(case)
            hung = not move.wait(HUNG_S)
            stop_ms = self._stop_ms()
            invented = False if hung else self._has_invented(rig, case)
            noticed_ms = 1e3 * (noticed_s(rig, injected_s, move.ended_s) - injected_s)
        return InjectionResult(
            detected=is_expected(case, move.error),
            message=self._anonymised(move.error),
            noticed_ms=noticed_ms,
            stop_ms=stop_ms,
            moved=stop_ms is None,
            hung=hung,
            invented=invented,
            spurious=bool(early) or bool(move.error and not is_expected(case, move.error)),
        )

    def _transient(self, case: FaultCase) -> InjectionResult:
        with ExitStack() as stack:
            rig = self._connect(stack)
            target = self._far_side(rig)
            move = _start_move(rig, target)
            self._wait_at_speed(move)
            before = rig.fault_counts()
            injected_s = self._inject(case)
            error, invented = "", False
            try:
                value, good_s = read_device(rig, case.device), time.monotonic()
                invented = self._is_wrong(case.device, value)
            except (RobotError, TouchError) as failure:
                error, good_s = str(failure), time.monotonic()
            hung = not move.wait(HUNG_S)
            after = rig.fault_counts()
        recovered_ms = 1e3 * (good_s - injected_s)
        arrived = move.result is not None and bool(
            np.allclose(move.result.position_m, target.position_m, atol=1e-3)
        )
        return InjectionResult(
            detected=not error
            and after != before
            and is_expected(case, after)
            and recovered_ms < self._recovered_ms,
            message=self._anonymised(error or move.error or f"nothing, it is counted: {after}"),
            noticed_ms=recovered_ms,
            moved=not arrived,
            hung=hung,
            invented=invented,
        )

    def _in_episode(self, case: FaultCase) -> InjectionResult:
        """Inject at the first motion of a recorded episode, in a world of its own."""
        with (
            EmulatorProcess("rig", "--seed", str(self._config.seed)) as emulators,
            closing(FaultBench(self._config, self._rig_file, emulators)) as bench,
        ):
            return bench._episode(case)

    def _episode(self, case: FaultCase) -> InjectionResult:
        with ExitStack() as stack:
            rig = self._connect(stack)
            record = {"record": Path(self._folder.name), "policy": "rules"}
            config = self._config.model_copy(update=record)
            episode = BackgroundCall(
                lambda: run_recorded(rig, make_policy("rules", config), config, contract_of(config))
            )
            moving = self._wait_for_motion(episode)
            injected_s = self._inject(case)
            hung = not episode.wait(EPISODE_S)
            stop_ms = self._stop_ms() if case.phase is InjectionPhase.MOTION and moving else None
            counts = rig.fault_counts()
        is_transient = case.phase is InjectionPhase.TRANSIENT
        outcome = episode.result[0].message if episode.result is not None else ""
        is_fault = episode.result is not None and episode.result[0].reason is EndReason.FAULT
        message = self._anonymised(counts if is_transient else outcome)
        if is_transient and is_fault:
            message = f"{self._anonymised(outcome)}; {message}"
        return InjectionResult(
            detected=is_expected(case, message),
            message=message,
            noticed_ms=1e3 * (episode.ended_s - injected_s),
            stop_ms=stop_ms,
            moved=not moving,
            hung=hung,
            episode=check_episode(episode, expect_fault=not is_transient),
            spurious=is_fault and (is_transient or not is_expected(case, message)),
        )

    def _wait_for_motion(self, episode: BackgroundCall[Episode]) -> bool:
        """Wait until the arm moves; False when it does not within 20 s."""
        until_s = time.monotonic() + 20.0
        while time.monotonic() < until_s and not episode.wait(0):
            speed = self._emulators.control.facts("ur")["tcp_speed_m_s"]
            if isinstance(speed, float) and speed > 0.01:
                return True
            time.sleep(0.005)  # without a pause the questions would keep the emulators busy
        return False

    def _wait_at_speed(self, move: BackgroundCall[Pose]) -> None:
        """Wait until the tool is at full speed, or its move has ended, and some time more."""
        until_s = time.monotonic() + CONNECT_S
        while time.monotonic() < until_s and not move.wait(0.01):
            speed = self._emulators.control.facts("ur")["tcp_speed_m_s"]
            if isinstance(speed, float) and speed > 0.95 * SPEED_M_S:
                break
        time.sleep(float(self._rng.uniform(*_DELAY_S)))

    def _connect(self, stack: ExitStack) -> HardwareRig:
        """Connect the rig, in several attempts: a controller that restarts needs some seconds."""
        for attempt in range(_MAX_ATTEMPTS):
            try:
                rig = connect(self._config, self._hardware, 1.0)
                break
            except (RobotError, TouchError) as error:
                if attempt == _MAX_ATTEMPTS - 1:
                    raise
                log.info("not connected yet: %s", error)
                time.sleep(1.0)
        stack.callback(rig.disconnect)
        return rig

    def _far_side(self, rig: HardwareRig) -> Pose:
        pose = rig.arm.pose()
        x_m, y_m, z_m = pose.position_m
        far_x_m = _HIGH_X_M if x_m - _LOW_X_M < _HIGH_X_M - x_m else _LOW_X_M
        return Pose(position_m=np.array([far_x_m, y_m, z_m]), rotvec_rad=pose.rotvec_rad)

    def _inject(self, case: FaultCase) -> float:
        """Start the fault; returns the time [s]."""
        control = self._emulators.control
        if case.device != "ur":  # the arm's emulator measures from its own injections on
            control.inject("ur", "contact_force", force_n=0.0)
        began_s = time.monotonic()
        if case.device == "gelsight":
            self._save_stale_background()
        else:
            control.inject(case.device, case.fault, **case.details)
        return began_s

    def _anonymised(self, message: str) -> str:
        """A message with names in place of addresses, which differ from run to run."""
        names = {"host": "HOST", "gripper_port": "PORT", "sensor_port": "PORT"}
        for key, name in names.items():
            message = message.replace(str(self._emulators.ready[key]), name)
        return message.replace(f"{self._folder.name}/", "")

    def _stop_ms(self) -> float | None:
        """Time to rest, measured by the emulator [ms]; None when the tool does not come to rest."""
        until_s = time.monotonic() + 3.0
        while time.monotonic() < until_s:
            stop_ms = self._emulators.control.facts("ur")["stopped_after_ms"]
            if isinstance(stop_ms, float):
                return stop_ms
            time.sleep(0.01)
        return None

    def _truth(self) -> tuple[float, ...]:
        """Position of the tool and opening of the fingers, by the emulators [m]."""
        arm, gripper = (self._emulators.control.facts(name) for name in ("ur", "dynamixel"))
        names = ("tcp_x_m", "tcp_y_m", "tcp_z_m")
        return (*(float(str(arm[name])) for name in names), float(str(gripper["width_m"])))

    def _has_invented(self, rig: HardwareRig, case: FaultCase) -> bool:
        """The failed device still returns values, and they are not the true ones."""
        try:
            value = read_device(rig, case.device)
        except (RobotError, TouchError):
            return False
        return self._is_wrong(case.device, value)

    def _is_wrong(self, device: str, value: FloatArray) -> bool:
        """A value differs from the truth; heights of a sensor are wrong when all are equal."""
        if device == "taxels":
            return float(np.ptp(value)) == 0
        truth = self._truth()[:3] if device == "ur" else self._truth()[3:]
        return bool(np.abs(value - truth).max() > 1e-3)


def _start_move(rig: HardwareRig, target: Pose) -> BackgroundCall[Pose]:
    speeds = {"speed_m_s": SPEED_M_S, "acceleration_m_s2": ACCELERATION_M_S2}
    return BackgroundCall(lambda: rig.arm.move_to(target, **speeds))
