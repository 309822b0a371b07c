"""An emulated UR controller: modes, safety, registers, watchdog and output variables.

Not here: sockets (``sim.emulators.ur.server``). Our choices, marked so below, are the decelerations
of program and safety stops and the state of the program after them: Universal Robots states none.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from sim.emulators.ur.kinematics import Floats
from sim.emulators.ur.options import UNLOCK_AFTER_S
from sim.emulators.ur.robot import Robot, SegmentListener
from sim.emulators.ur.urscript import Program

PROGRAM_STOP_M_S2 = 10.0
"""Deceleration when a program ends during a motion. Our choice: Universal Robots states none."""

SAFETY_STOP_M_S2 = 10.0
"""Deceleration of protective, safeguard and emergency stops. Our choice, as above."""

RUNNING, POWER_OFF, BOOTING = 7, 3, 2
ROBOT_MODES = {RUNNING: "RUNNING", POWER_OFF: "POWER_OFF", BOOTING: "BOOTING"}

NORMAL, PROTECTIVE, SAFEGUARD, SYSTEM_STOP, ROBOT_STOP = 1, 3, 5, 6, 7
SAFETY_MODES = {
    NORMAL: "NORMAL",
    PROTECTIVE: "PROTECTIVE_STOP",
    SAFEGUARD: "SAFEGUARD_STOP",
    SYSTEM_STOP: "SYSTEM_EMERGENCY_STOP",
    ROBOT_STOP: "ROBOT_EMERGENCY_STOP",
}
SAFETY_BITS = {
    NORMAL: 1 << 0,
    PROTECTIVE: 1 << 2 | 1 << 10,
    SAFEGUARD: 1 << 4 | 1 << 10,
    SYSTEM_STOP: 1 << 5 | 1 << 7 | 1 << 10,
    ROBOT_STOP: 1 << 6 | 1 << 7 | 1 << 10,
}
STOPPED, PLAYING, PAUSED = 1, 2, 4
PROGRAM_STATES = {STOPPED: "STOPPED", PLAYING: "PLAYING", PAUSED: "PAUSED"}


def _registers(side: str) -> dict[str, float]:
    doubles = {f"{side}_double_register_{i}": 0.0 for i in range(48)}
    return {f"{side}_int_register_{i}": 0 for i in range(48)} | doubles


class Controller:
    """The state of an emulated controller.

    Attributes:
        robot: The arm.
        program: The running control script; None without one.
        robot_mode, safety_mode: As RTDE numbers them.
        remote: The pendant is in remote control.
        unlock_after_s: Least time from a protective stop to its release [s].
        not_finite: Output variables that read NaN, as from a damaged sensor.
        scripts_start: False for a version that accepts a script and never runs it.
        end_reason: Reason for which the last program ended; '' before the first end.
    """

    def __init__(
        self,
        tcp: Floats,
        tcp_offset: Floats,
        listener: SegmentListener | None,
        clock: Callable[[], float],
    ) -> None:
        self._clock = clock
        self._began_s = clock()
        self.robot = Robot(tcp, tcp_offset, listener, self._began_s)
        self.program: Program | None = None
        self.robot_mode, self.safety_mode, self.remote = RUNNING, NORMAL, True
        self.scripts_start = True
        self.unlock_after_s = UNLOCK_AFTER_S
        self._stopped_s = self._began_s
        self.not_finite: set[str] = set()
        self.end_reason = ""
        self.num_programs = 0
        self.payload_kg, self.payload_cog_m = 0.0, [0.0, 0.0, 0.0]
        self.inputs, self.outputs = _registers("input"), _registers("output")
        self._readers = self._variables()
        self._paused = False
        self._kicked_s = self._began_s

    def advance(self) -> None:
        now_s = self._clock()
        self.robot.advance(now_s)
        if self.robot.out_of_reach:
            self.robot.out_of_reach = False
            if self.safety_mode == NORMAL:
                self.protective_stop()
        if self.program is None:
            return
        if not self._paused:
            self.program.advance()
            if self.program.payload_kg is not None:
                self.payload_kg = self.program.payload_kg
                self.payload_cog_m = self.program.payload_cog_m
        least_hz = self.program.watchdog_hz
        if least_hz > 0 and now_s - self._kicked_s > 1.0 / least_hz:
            self.stop_program(f"watchdog: no input within {1000 / least_hz:.0f} ms")
        elif not self.program.running:
            self.stop_program("the script ended")

    @property
    def next_deadline_s(self) -> float | None:
        """Time on the clock at which the watchdog will trip [s]; None without a watchdog."""
        if self.program is None or self.program.watchdog_hz <= 0:
            return None
        return self._kicked_s + 1.0 / self.program.watchdog_hz

    def on_inputs(self, kicked: bool) -> None:
        """React to written input registers; ``kicked``: the command register is among them."""
        self.advance()
        if kicked:
            self._kicked_s = self._clock()
        if self.program is not None and not self._paused:
            self.program.read_inputs()
            self.advance()

    @property
    def runtime_state(self) -> int:
        """Runtime state of RTDE: 1 stopped, 2 playing, 4 paused."""
        if self.program is None:
            return STOPPED
        return PAUSED if self._paused else PLAYING

    def start_program(self) -> None:
        """Start the uploaded control script; it replaces the running program."""
        self.stop_program("another script was uploaded")
        ready = self.robot_mode == RUNNING and self.safety_mode == NORMAL and self.remote
        if not (self.scripts_start and ready):
            return
        for i in range(48):
            self.inputs[f"input_int_register_{i}"] = 0
        self.num_programs += 1
        self._kicked_s = self._clock()
        self.program = Program(self.robot, self.inputs, self.outputs, self.protective_stop)

    def stop_program(self, reason: str) -> None:
        """End the program, if one runs, and bring the arm to rest."""
        self.robot.advance(self._clock())
        if self.program is not None:
            self.program, self.end_reason, self._paused = None, reason, False
            self.outputs["output_int_register_0"] = 0
            self.robot.halt(PROGRAM_STOP_M_S2)

    def safety_stop(self, mode: int) -> None:
        """Stop the arm.

        Protective and safeguard stop pause the program, emergency stops end it. Our choice.
        """
        self.robot.advance(self._clock())
        self.safety_mode, self._stopped_s = mode, self._clock()
        self.robot.halt(SAFETY_STOP_M_S2)
        if mode in (PROTECTIVE, SAFEGUARD):
            self._paused = self.program is not None
        else:
            self.stop_program(SAFETY_MODES[mode].lower())
            self.robot_mode = POWER_OFF

    def protective_stop(self) -> None:
        self.safety_stop(PROTECTIVE)

    @property
    def may_unlock(self) -> bool:
        """Whether a protective stop, if there is one, is old enough to be released."""
        return self._clock() - self._stopped_s >= self.unlock_after_s

    def unlock(self) -> None:
        """Reset safety to normal, end the program, switch power on."""
        self.stop_program("unlocked after a safety stop")
        self.safety_mode, self.robot_mode = NORMAL, RUNNING

    def power_off(self) -> None:
        """End the program and switch power off; the brakes hold the arm."""
        self.stop_program("power off")
        self.robot.halt(SAFETY_STOP_M_S2)
        self.robot_mode = POWER_OFF

    def restart(self) -> None:
        """Restart: power goes off, brakes hold the arm, settings are lost."""
        self.stop_program("controller restart")
        self.robot.halt(SAFETY_STOP_M_S2)
        self.robot_mode, self._began_s = BOOTING, self._clock()
        self.payload_kg, self.payload_cog_m = 0.0, [0.0, 0.0, 0.0]

    def values(self, name: str) -> list[float]:
        """Numbers of an output variable; empty for one that is not emulated (currents and such)."""
        if name in self.outputs:
            return [self.outputs[name]]
        numbers = self._readers[name]() if name in self._readers else []
        return [math.nan] * len(numbers) if name in self.not_finite else numbers

    def _variables(self) -> Mapping[str, Callable[[], list[float]]]:
        robot = self.robot
        motion: dict[str, Callable[[], list[float]]] = {
            "TCP_pose": robot.tcp_pose,
            "TCP_speed": lambda: robot.tool.twist.tolist(),
            "q": lambda: robot.joints().tolist(),
            "qd": lambda: robot.joint_speeds().tolist(),
        }
        return {
            **{f"actual_{name}": read for name, read in motion.items()},
            **{f"target_{name}": read for name, read in motion.items()},
            **dict.fromkeys(("actual_TCP_force", "ft_raw_wrench"), robot.force),
            **dict.fromkeys(("safety_mode", "safety_status"), lambda: [self.safety_mode]),
            "tcp_offset": lambda: robot.tcp_offset.tolist(),
            "payload_cog": lambda: list(self.payload_cog_m),
            "timestamp": lambda: [self._clock() - self._began_s],
            "robot_mode": lambda: [self.robot_mode],
            "runtime_state": lambda: [self.runtime_state],
            "robot_status_bits": lambda: [
                (self.robot_mode == RUNNING) | (self.runtime_state == PLAYING) << 1
            ],
            "safety_status_bits": lambda: [SAFETY_BITS[self.safety_mode]],
            "speed_scaling": lambda: [robot.speed_fraction if robot.in_motion else 1.0],
            "target_speed_fraction": lambda: [robot.speed_fraction],
            "payload": lambda: [self.payload_kg],
        }
