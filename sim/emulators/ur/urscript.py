"""Register behaviour of the control script that ur_rtde uploads; the script itself is not run.

Commands arrive in ``input_int_register_0``; ``output_int_register_0`` is 1 (ready) or 2 (done,
until the client sends 0). A command other than those below ends the program, as an error in a
script would. Simplifications: commands are taken when they arrive, not at the next 2 ms cycle; a
new line begins from rest; force mode moves at its speed limits.

Source: wire behaviour of ur_rtde 1.6.5.
"""

from __future__ import annotations

import math
from collections.abc import Callable, MutableMapping

import numpy as np

from sim.emulators.ur.kinematics import (
    Floats,
    as_frame,
    base_from_flange,
    checked_pose,
    jacobian,
    matrix,
)
from sim.emulators.ur.motion import Line, ServoMotion, checked_rate, run_at
from sim.emulators.ur.robot import Robot

READY, DONE = 1, 2
MOVE_L, FORCE, FORCE_STOP, ZERO_FT, SPEED_J, SPEED_L, SERVO_J = 3, 6, 7, 8, 9, 10, 11
SPEED_STOP, SERVO_STOP, PAYLOAD, SERVO_L, GET_WAYPOINT, TCP = 15, 16, 17, 24, 28, 29
PROTECTIVE_STOP, STOP_L, STOP_J, WATCHDOG, GET_TCP, STEADY, TARGET_PAYLOAD, END = (
    31, 33, 34, 35, 40, 47, 65, 255
)  # fmt: skip
REALTIME = (FORCE, SPEED_J, SPEED_L, SERVO_J, SERVO_L)
FORCE_ACCELERATION = 0.5
LARGEST_KG = 100.0
"""Largest accepted payload [kg]; our choice, above that of any UR."""


class Program:
    """One run of the control script on a robot.

    Attributes:
        running: False once it has ended.
        watchdog_hz: Requested lowest rate of ``input_int_register_0``; 0 without a watchdog.
        stops_straight: ``stopL`` brakes along the line; until the first asynchronous stop it brakes
            as ``stopJ`` does.
        payload_kg, payload_cog_m: Payload as last set.
        protective_stop: Function that performs a protective stop requested by the client.
    """

    def __init__(
        self,
        robot: Robot,
        inputs: MutableMapping[str, float],
        outputs: MutableMapping[str, float],
        protective_stop: Callable[[], None],
    ) -> None:
        self.running = True
        self.watchdog_hz = 0.0
        self.payload_kg: float | None = None
        self.payload_cog_m = [0.0, 0.0, 0.0]
        self.protective_stop = protective_stop
        self._robot, self._in, self._out = robot, inputs, outputs
        self._executing = False
        self._awaits_rest = False
        self.stops_straight = False
        self._realtime_mode: str | None = None
        self._repeated_motion: Callable[[], None] | None = None
        self._asynchronous = False
        self._writes, self._operation = 0, 0
        self._progress(running=False)
        self._out["output_int_register_0"] = READY

    def _doubles(self, first: int, count: int = 6) -> Floats:
        return np.array([self._in[f"input_double_register_{first + i}"] for i in range(count)])

    def _progress(self, *, running: bool) -> None:
        """Report progress: bit 15 running, bits 16-22 writes, bits 24-30 operation."""
        self._writes = (self._writes + 1) % 128
        if running:
            self._operation = (self._operation + 1) % 128
        bits = (self._operation << 24) | (self._writes << 16) | (0x8000 if running else 0)
        self._out["output_int_register_2"] = bits

    def read_inputs(self) -> None:
        """Carry out the command in the registers; arguments that it can't take end the script.

        A real script ends so too: by a runtime error of the function that it called.
        """
        if not self.running or self._awaits_rest:
            return
        try:
            self._read_command(int(self._in["input_int_register_0"]))
        except ValueError:
            self.running = False
            self._repeated_motion = None

    def _read_command(self, command: int) -> None:
        if command in REALTIME:
            self._execute_realtime(command)
            self._out["output_int_register_0"] = READY
        elif command == 0:
            self._executing = False
            self._out["output_int_register_0"] = READY
        elif not self._executing:
            self._executing = True
            self._execute(command)
            if self.running and not self._awaits_rest:
                self._out["output_int_register_0"] = DONE

    def advance(self) -> None:
        """Finish a command that waits for the robot; continue a motion that a stop does not end."""
        if not self.running or self._robot.moving:
            return
        if self._asynchronous:
            self._asynchronous = False
            self._progress(running=False)
        if self._awaits_rest:
            self._awaits_rest = False
            self._out["output_int_register_0"] = DONE
            self.read_inputs()
        if self._repeated_motion is not None and not self._robot.moving:
            self._repeated_motion()

    def _execute_realtime(self, command: int) -> None:
        first = self._doubles(0)
        if command in (SPEED_L, SPEED_J):
            acceleration = checked_rate(self._in["input_double_register_6"])
            if not np.isfinite(first).all():
                raise ValueError(f"a speed must be finite, got {first.tolist()}")
            # The script repeats speedl: its time argument does not end the motion.
            self._repeat(
                "speed", lambda: self._speed(first, acceleration, joints=command == SPEED_J)
            )
        elif command in (SERVO_L, SERVO_J):
            first = checked_pose(first)
            if command == SERVO_J:
                goal = base_from_flange(first) @ as_frame(self._robot.tcp_offset)
                position, rotation = goal[:3, 3], goal[:3, :3]
            else:
                position, rotation = first[:3], matrix(first[3:])
            lookahead_s = self._in["input_double_register_9"]
            self._repeat(
                "servo",
                lambda: self._robot.begin(
                    ServoMotion(self._robot.tool, position, rotation, lookahead_s)
                ),
            )
        else:
            selected = [int(self._in[f"input_int_register_{i}"]) for i in range(2, 8)]
            wrench, limits = self._doubles(6), self._doubles(12)
            frame = matrix(checked_pose(first)[3:])
            self._repeat("force", lambda: self._force(np.array(selected), wrench, limits, frame))

    def _repeat(self, name: str, motion: Callable[[], None]) -> None:
        self._realtime_mode, self._repeated_motion = name, motion
        motion()

    def _speed(self, target: Floats, acceleration: float, *, joints: bool) -> None:
        twist = jacobian(self._robot.joints()) @ target if joints else target
        speed = float(np.linalg.norm(twist[:3]))
        motion = run_at(self._robot.tool, twist, acceleration, math.inf)
        self._robot.begin(motion, speed, acceleration)

    def _force(self, selected: Floats, wrench: Floats, limits: Floats, frame: Floats) -> None:
        """Yield along the selected axes, at their speed limits, until the forces balance."""
        surplus = wrench + (self._robot.contact.reshape(2, 3) @ frame).ravel()
        local = np.where((selected != 0) & (np.abs(surplus) > 0.5), np.sign(surplus) * limits, 0.0)
        twist = (local.reshape(2, 3) @ frame.T).ravel()
        motion = run_at(self._robot.tool, twist, FORCE_ACCELERATION, math.inf)
        self._robot.begin(motion, float(np.linalg.norm(twist[:3])), FORCE_ACCELERATION)

    def _execute(self, command: int) -> None:
        if command in (MOVE_L, STOP_L, STOP_J, SPEED_STOP, SERVO_STOP, FORCE_STOP):
            self._move_or_stop(command)
        elif command == ZERO_FT:
            self._robot.zero_force()
        elif command in (PAYLOAD, TARGET_PAYLOAD):
            payload_kg = self._in["input_double_register_0"]
            if not 0 <= payload_kg <= LARGEST_KG:
                raise ValueError(f"a payload is 0 to {LARGEST_KG} kg, got {payload_kg}")
            self.payload_kg = payload_kg
            self.payload_cog_m = self._doubles(1, 3).tolist()
        elif command == TCP:
            self._robot.set_tcp(self._doubles(0))
        elif command in (GET_TCP, GET_WAYPOINT):
            pose = self._robot.tcp_offset.tolist() if command == GET_TCP else self._robot.tcp_pose()
            for i, value in enumerate(pose):
                self._out[f"output_double_register_{i}"] = value
        elif command == PROTECTIVE_STOP:
            self.protective_stop()
        elif command == WATCHDOG:
            self.watchdog_hz = self._in["input_double_register_0"]
        elif command == STEADY:
            self._out["output_int_register_1"] = 0 if self._robot.moving else 1
        else:
            self.running = False

    def _move_or_stop(self, command: int) -> None:
        asynchronous = int(self._in["input_int_register_1"]) == 1
        if command == MOVE_L:
            pose = checked_pose(self._doubles(0))
            speed, acceleration = self._doubles(6, 2).tolist()
            line = Line(self._robot.tool, pose[:3], matrix(pose[3:]), speed, acceleration)
            self._robot.begin(line, speed, acceleration)
        else:
            deceleration = checked_rate(self._in["input_double_register_0"])
            mode = {SPEED_STOP: "speed", SERVO_STOP: "servo", FORCE_STOP: "force"}.get(command)
            if mode is not None and mode == self._realtime_mode:
                self._realtime_mode = self._repeated_motion = None
            asynchronous = asynchronous and mode is None
            if command in (STOP_L, STOP_J) and asynchronous:
                self.stops_straight = command == STOP_L
            if command == FORCE_STOP:
                self._robot.halt(10.0)
            elif command == SPEED_STOP or (command in (STOP_L, STOP_J) and self.stops_straight):
                self._robot.halt(deceleration)
            else:  # also a stopL before the first asynchronous stop
                self._robot.halt_joints(deceleration)
        if asynchronous:
            self._asynchronous = True
            self._progress(running=True)
        else:
            self._awaits_rest = True
