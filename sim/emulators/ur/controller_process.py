"""An emulator of a UR e-Series controller: dashboard, script and RTDE ports on a loopback address.

It speaks to the unmodified ur_rtde, moves a tool in real time, and lets faults happen on command.
``python -m sim.emulators ur --host 127.0.3.7``. What it is not: a simulation of dynamics, of
contact, or of the URScript language (``ur_program`` behaves as ur_rtde's own script does).
"""

from __future__ import annotations

import argparse
import math
import queue
import threading
import time
from collections.abc import Callable, Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from sim.emulators.process.control import ControlServer, Facts
from sim.emulators.process.lifetime import announce_and_wait
from sim.emulators.process.real_time import ask_for_real_time
from sim.emulators.ur.child import RemoteWorld
from sim.emulators.ur.controller import ROBOT_STOP, SAFEGUARD, Controller
from sim.emulators.ur.robot import MotionSegment
from sim.emulators.ur.server import PORTS, Server
from sim.emulators.ur.sessions import DASHBOARD_PORT, RTDE_PORT, SCRIPT_PORT

START_TCP = (0.45, -0.10, 0.20, math.pi, 0.0, 0.0)
"""Where the tool centre point begins [m, rad]: the simulated rig's start pose."""

TCP_OFFSET = (0.0, 0.0, 0.15, 0.0, 0.0, 0.0)
"""Flange to tool centre point at the start [m, rad]."""

VERSION = (5, 12)

_REGISTERS = [f"input_int_register_{i}" for i in range(24)]


class TcpListener(Protocol):
    """A world that follows the tool centre point."""

    def moved(
        self,
        by_base_m: NDArray[np.float64],
        rotvec_rad: NDArray[np.float64],
        speed_m_s: float,
        acceleration_m_s2: float,
    ) -> None:
        """A straight segment of the TCP has ended (arrived, or was cut short by a stop).

        ``by_base_m`` and ``rotvec_rad`` are what was really covered; speed and acceleration are
        those commanded. May take its time: the controller goes on, and says that the move has
        finished when the world has followed.
        """
        ...


class UrEmulator:
    """One emulated controller; an ``Emulated`` device of the control channel."""

    def __init__(
        self,
        host: str,
        *,
        version: tuple[int, int] = VERSION,
        stream_hz: float = 125.0,
        start_tcp: Sequence[float] = START_TCP,
        tcp_offset: Sequence[float] = TCP_OFFSET,
        listener: TcpListener | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Listen on ``host`` and serve; streams run at ``stream_hz`` [Hz] at most.

        Raises:
            OSError: The ports are taken on this address.
            ValueError: The start pose is out of reach.
        """
        self.host = host
        self._clock, self._listener, self._version = clock, listener, version
        self._injected_s: float | None = None
        self._ended: queue.SimpleQueue[tuple[MotionSegment, threading.Event] | None] = (
            queue.SimpleQueue()
        )
        self._world: threading.Thread | None = None
        if listener is not None:
            self._world = threading.Thread(target=self._tell_world, daemon=True)
            self._world.start()
        self.controller = Controller(
            np.array(start_tcp, dtype=np.float64),
            np.array(tcp_offset, dtype=np.float64),
            None if listener is None else self._report,
            clock,
        )
        self.server = Server(host, self.controller, version, stream_hz, clock)
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
        }

    def close(self) -> None:
        """Hang up. Idempotent."""
        self.server.close()
        self._ended.put(None)

    # -- Emulated --------------------------------------------------------------------------------

    def inject(self, fault: str, **details: float | str) -> None:
        """Let a fault happen now.

        Raises:
            ValueError: No such fault, or details that it does not take.
        """
        if fault not in self._faults:
            raise ValueError(f"no fault {fault!r} of a UR; known: {', '.join(self._faults)}")
        with self.server.lock:
            self._injected_s = self._clock()
            self.controller.robot.watch_stop(self._injected_s)
            try:
                self._faults[fault](**details)
            except TypeError:
                raise ValueError(f"the fault {fault} does not take {sorted(details)}") from None

    def clear(self) -> None:
        """All faults away; the program stays ended, as on a real controller."""
        with self.server.lock:
            controller = self.controller
            if controller.robot_mode != 7 or controller.safety_mode != 1:
                controller.unlock()
            controller.remote, controller.scripts_start = True, True
            controller.robot.speed_fraction = 1.0
            controller.robot.contact = np.zeros(6)
            self.server.version = self._version
            self.server.reserve(_REGISTERS, taken=False)
            self.server.restore()

    def facts(self) -> Facts:
        """What is true now; times [ms] are measured here, from the last injection on."""
        with self.server.lock:
            self.controller.advance()
            controller, robot = self.controller, self.controller.robot
            ago_s = None if self._injected_s is None else self._clock() - self._injected_s
            after_s = robot.stopped_after_s
            x, y, z, *turn = robot.tcp_pose()
            return {
                "injected_ago_ms": None if ago_s is None else 1e3 * ago_s,
                "stopped_after_ms": None if after_s is None else 1e3 * after_s,
                "tcp_speed_m_s": robot.speed_m_s,
                "moving": robot.in_motion,
                "tcp_x_m": x, "tcp_y_m": y, "tcp_z_m": z,
                "tcp_rx_rad": turn[0], "tcp_ry_rad": turn[1], "tcp_rz_rad": turn[2],
                "program_running": controller.program is not None,
                "program_ended": controller.ended,
                "num_programs": controller.num_programs,
                "watchdog_hz": controller.program.watchdog_hz if controller.program else 0.0,
                "stops_straight": bool(controller.program and controller.program.stops_straight),
                "payload_kg": controller.payload_kg,
                "tcp_offset_z_m": float(robot.tcp_offset[2]),
                "force_n": float(np.linalg.norm(robot.force()[:3])),
                "num_clients": self.server.num_clients,
            }  # fmt: skip

    # -- faults ----------------------------------------------------------------------------------

    def _link(self, *, mute: bool = False, garbage: bool = False) -> None:
        self.server.link.mute, self.server.link.garbage = mute, garbage

    def _wrong_version(self, version: str = "10.8") -> None:
        major, minor = (int(part) for part in version.split("."))
        self.server.version = (major, minor)
        self.controller.scripts_start = False

    def _speed_slider(self, fraction: float = 0.0) -> None:
        self.controller.robot.speed_fraction = min(1.0, max(0.0, float(fraction)))

    def _link_drop(self, ports: str = "rtde") -> None:
        known = {"rtde": (RTDE_PORT,), "all": PORTS, "control": (RTDE_PORT, SCRIPT_PORT),
                 "dashboard": (DASHBOARD_PORT,)}  # fmt: skip
        if ports not in known:
            raise ValueError(f"ports must be one of {', '.join(known)}, got {ports!r}")
        self.server.drop(known[ports])

    def _freeze(self, deaf: float = 1.0) -> None:
        self.server.link.frozen, self.server.link.deaf = True, bool(deaf)

    def _restart(self, down_s: float = 1.0) -> None:
        self.controller.restart()
        self.server.drop(PORTS, reopen_after_s=float(down_s))

    def _contact_force(self, force_n: float = 40.0) -> None:
        self.controller.robot.contact = np.array([0.0, 0.0, float(force_n), 0.0, 0.0, 0.0])

    # -- world -----------------------------------------------------------------------------------

    def _report(self, stretch: MotionSegment) -> Callable[[], bool]:
        followed = threading.Event()
        self._ended.put((stretch, followed))
        return followed.is_set

    def _tell_world(self) -> None:
        while (told := self._ended.get()) is not None:
            stretch, followed = told
            try:
                if self._listener is not None:
                    self._listener.moved(
                        stretch.by_base_m,
                        stretch.rotvec_rad,
                        stretch.speed_m_s,
                        stretch.acceleration_m_s2,
                    )
            finally:
                followed.set()


def main(argv: Sequence[str]) -> int:
    """Run one emulated controller until told to end."""
    parser = argparse.ArgumentParser(prog="python -m sim.emulators ur", description=__doc__)
    parser.add_argument("--host", required=True, help="loopback address, 127.x.y.z")
    parser.add_argument("--version", default="5.12", help="PolyScope version, major.minor")
    parser.add_argument("--stream-hz", type=float, default=125.0, help="fastest data stream")
    parser.add_argument(
        "--start-tcp", type=float, nargs=6, default=START_TCP, help="pose at the start [m, rad]"
    )
    parser.add_argument(
        "--tcp-offset", type=float, nargs=6, default=TCP_OFFSET, help="flange to TCP [m, rad]"
    )
    parser.add_argument(
        "--world-port", type=int, default=None, help="local port of a world that follows (ur_child)"
    )
    chosen = parser.parse_args(argv)
    major, minor = (int(part) for part in chosen.version.split("."))
    ask_for_real_time()  # control channel too: a thread that waits for it must not wait long
    emulator = UrEmulator(
        chosen.host,
        version=(major, minor),
        stream_hz=chosen.stream_hz,
        start_tcp=chosen.start_tcp,
        tcp_offset=chosen.tcp_offset,
        listener=None if chosen.world_port is None else RemoteWorld(chosen.world_port),
    )
    control = ControlServer({"ur": emulator})
    announce_and_wait({"host": chosen.host, "control_port": control.port})
    control.close()
    emulator.close()
    return 0
