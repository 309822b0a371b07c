"""An emulator of a UR e-Series controller: dashboard, script and RTDE ports on a loopback address.

It speaks to the unmodified ur_rtde, moves a tool in real time and injects faults on command:
``python -m sim.emulators ur --host 127.0.3.7``. Not emulated: dynamics, contact, and the URScript
language (``sim.emulators.ur.urscript`` behaves as ur_rtde's own script does).
"""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Callable
from contextlib import closing

import numpy as np

from sim.emulators.process.control import Facts
from sim.emulators.process.lifetime import request_real_time, serve
from sim.emulators.ur.child import Begin, Follow, RemoteWorld
from sim.emulators.ur.controller import ROBOT_STOP, SAFEGUARD, Controller
from sim.emulators.ur.motion import MotionSegment
from sim.emulators.ur.options import UrOptions
from sim.emulators.ur.server import Server
from sim.emulators.ur.sessions import DASHBOARD_PORT, PORTS, RTDE_PORT, SCRIPT_PORT

_REGISTERS = [f"input_int_register_{i}" for i in range(24)]


class UrEmulator:
    """One emulated controller; an ``Emulated`` device of the control channel."""

    def __init__(
        self, options: UrOptions, follow: Follow | None = None, begin: Begin | None = None
    ) -> None:
        """Listen on the host of the options and serve.

        Args:
            options: Address, version and start pose.
            follow: Function of a world that follows a segment of the tool that has ended (arrived,
                or was cut short by a stop). It may take its time: the controller goes on, and
                reports the end of the move when the world has followed.
            begin: Function of that world that is told of a line that begins; returns at once.

        Raises:
            OSError: The ports are taken on this address.
            ValueError: The start pose is out of reach.
        """
        major, minor = (int(part) for part in options.version.split("."))
        self._version = (major, minor)
        self._injected_s: float | None = None
        self._reports: queue.SimpleQueue[Callable[[], None] | None] = queue.SimpleQueue()
        self._follow = follow
        if follow is not None:
            threading.Thread(target=self._run_world, daemon=True).start()
        self.controller = Controller(
            np.array(options.start_tcp),
            np.array(options.tcp_offset),
            None if follow is None else self._queue_segment,
            time.monotonic,
        )
        self.controller.unlock_after_s = options.unlock_after_s
        if begin is not None:
            self.controller.robot.on_begin = lambda plan: self._reports.put(lambda: begin(plan))
        self.server = Server(options.host, self.controller, self._version, options.stream_hz)
        self._faults: dict[str, Callable[..., None]] = {
            "mute": lambda: self._link(mute=True),
            "garbage": lambda: self._link(garbage=True),
            "wrong_version": self._wrong_version,
            "local_control": lambda: setattr(self.controller, "remote", False),
            "speed_slider": self._speed_slider,
            "register_in_use": lambda: self.server.reserve(_REGISTERS, taken=True),
            "link_drop": self._link_drop,
            "freeze": self._freeze,
            "protective_stop": self.controller.protective_stop,
            "safeguard_stop": lambda: self.controller.safety_stop(SAFEGUARD),
            "emergency_stop": lambda: self.controller.safety_stop(ROBOT_STOP),
            "program_stopped": lambda: self.controller.stop_program("stopped at the pendant"),
            "controller_restart": self._restart,
            "contact_force": self._contact_force,
            "not_finite": self._not_finite,
        }

    def close(self) -> None:
        self.server.close()
        self._reports.put(None)

    def inject(self, fault: str, **details: float | str) -> None:
        """Start a fault now.

        Raises:
            ValueError: No such fault, or details that it does not take.
        """
        if fault not in self._faults:
            raise ValueError(f"no fault {fault!r} of a UR; known: {', '.join(self._faults)}")
        with self.server.lock:
            self._injected_s = time.monotonic()
            self.controller.robot.watch_stop(self._injected_s)
            try:
                self._faults[fault](**details)
            except TypeError:
                raise ValueError(f"the fault {fault} does not take {sorted(details)}") from None

    def clear(self) -> None:
        """End all faults; the program stays ended, as on a real controller."""
        with self.server.lock:
            controller = self.controller
            if controller.robot_mode != 7 or controller.safety_mode != 1:
                controller.unlock()
            controller.remote, controller.scripts_start = True, True
            controller.robot.speed_fraction = 1.0
            controller.robot.contact = np.zeros(6)
            controller.not_finite.clear()
            self.server.version = self._version
            self.server.reserve(_REGISTERS, taken=False)
            self.server.restore()

    def facts(self) -> Facts:
        """True state now; times [ms] are measured from the last injection on."""
        with self.server.lock:
            self.controller.advance()
            controller, robot = self.controller, self.controller.robot
            ago_s = None if self._injected_s is None else time.monotonic() - self._injected_s
            after_s = robot.stopped_after_s
            x, y, z, *rotvec = robot.tcp_pose()
            return {
                "injected_ago_ms": None if ago_s is None else 1e3 * ago_s,
                "stopped_after_ms": None if after_s is None else 1e3 * after_s,
                "tcp_speed_m_s": robot.speed_m_s,
                "moving": robot.in_motion,
                "tcp_x_m": x, "tcp_y_m": y, "tcp_z_m": z,
                "tcp_rx_rad": rotvec[0], "tcp_ry_rad": rotvec[1], "tcp_rz_rad": rotvec[2],
                "program_running": controller.program is not None,
                "program_ended": controller.end_reason,
                "num_programs": controller.num_programs,
                "watchdog_hz": controller.program.watchdog_hz if controller.program else 0.0,
                "stops_straight": bool(controller.program and controller.program.stops_straight),
                "payload_kg": controller.payload_kg,
                "tcp_offset_z_m": float(robot.tcp_offset[2]),
                "force_n": float(np.linalg.norm(robot.force()[:3])),
                "num_clients": self.server.num_clients,
            }  # fmt: skip

    def _link(self, *, mute: bool = False, garbage: bool = False) -> None:
        self.server.link.mute, self.server.link.garbage = mute, garbage

    def _not_finite(self, variable: str = "actual_TCP_force") -> None:
        self.controller.not_finite.add(variable)

    def _wrong_version(self, version: str = "10.8") -> None:
        major, minor = (int(part) for part in version.split("."))
        self.server.version = (major, minor)
        self.controller.scripts_start = False

    def _speed_slider(self, fraction: float = 0.0) -> None:
        self.controller.robot.speed_fraction = min(1.0, max(0.0, float(fraction)))

    def _link_drop(self, ports: str = "rtde") -> None:
        groups = {"rtde": (RTDE_PORT,), "all": PORTS, "control": (RTDE_PORT, SCRIPT_PORT),
                 "dashboard": (DASHBOARD_PORT,)}  # fmt: skip
        if ports not in groups:
            raise ValueError(f"ports must be one of {', '.join(groups)}, got {ports!r}")
        self.server.drop(groups[ports])

    def _freeze(self, deaf: float = 1.0) -> None:
        self.server.link.frozen, self.server.link.deaf = True, bool(deaf)

    def _restart(self, down_s: float = 1.0) -> None:
        self.controller.restart()
        self.server.drop(PORTS, reopen_after_s=float(down_s))

    def _contact_force(self, force_n: float = 40.0) -> None:
        self.controller.robot.contact = np.array([0.0, 0.0, float(force_n), 0.0, 0.0, 0.0])

    def _queue_segment(self, segment: MotionSegment) -> Callable[[], bool]:
        followed, follow = threading.Event(), self._follow
        assert follow is not None  # else nobody listens

        def report() -> None:
            try:
                follow(segment)
            finally:
                followed.set()

        self._reports.put(report)
        return followed.is_set

    def _run_world(self) -> None:
        while (report := self._reports.get()) is not None:
            report()


def run(options: UrOptions) -> None:
    """Run one emulated controller, until the process is to end."""
    request_real_time()  # control channel too: a thread that waits for it must not wait long
    world = None if options.world_port is None else RemoteWorld(options.world_port)
    follow, begin = (None, None) if world is None else (world.follow, world.begin)
    with closing(UrEmulator(options, follow, begin)) as emulator:
        serve({"ur": emulator}, {"host": options.host})
