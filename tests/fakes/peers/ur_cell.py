"""State and control script of the second UR controller: motions in steps, registers, a table.

Not here: the ports, and what the peer leaves out (``ur_peer``).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

STOP_M_S2 = 10.0
PLAYING, STOPPED, PAUSED = 2, 1, 4


class Cell:
    """State of the controller: variables by name, the arm's motion, and the program."""

    def __init__(self) -> None:
        self.pose = [0.45, -0.10, 0.20, math.pi, 0.0, 0.0]
        self.velocity = [0.0] * 3
        self.force = [1.0, 0.0, 1.5, 0.0, 0.0, 0.0]
        self.tcp = [0.0, 0.0, 0.15, 0.0, 0.0, 0.0]
        self.payload, self.cog = 0.0, [0.0, 0.0, 0.0]
        self.now_s, self.kicked_s, self.watchdog_hz = 0.0, 0.0, 0.0
        self.safety, self.playing, self.paused = "NORMAL", False, False
        self.frozen = False
        self.ints, self.doubles = [0] * 48, [0.0] * 48  # inputs of the script
        self.out_ints, self.out_doubles = [0] * 48, [0.0] * 48
        self.path: tuple[list[float], float, float] | None = None  # target, speed, acceleration
        self.braking: float | None = None
        self.owner: dict[str, object] = {}
        self.taken_command, self.answers_at_rest, self.operation = 0, False, 0
        self.num_scripts = 0

    # what clients may read: name -> (type, value)
    def variables(self) -> dict[str, tuple[str, Callable[[], Any]]]:
        bits = {"NORMAL": 1, "PROTECTIVE_STOP": 1 << 2 | 1 << 10}
        fixed: dict[str, tuple[str, Callable[[], Any]]] = {
            "timestamp": ("DOUBLE", lambda: self.now_s),
            "actual_TCP_pose": ("VECTOR6D", lambda: self.pose),
            "actual_TCP_speed": ("VECTOR6D", lambda: [*self.velocity, 0.0, 0.0, 0.0]),
            "actual_TCP_force": ("VECTOR6D", lambda: self.force),
            "robot_mode": ("INT32", lambda: 7),
            "safety_mode": ("INT32", lambda: 1 if self.safety == "NORMAL" else 3),
            "safety_status_bits": ("UINT32", lambda: bits[self.safety]),
            "robot_status_bits": ("UINT32", lambda: 1 | (2 if self.runtime() == PLAYING else 0)),
            "runtime_state": ("UINT32", self.runtime),
            "target_speed_fraction": ("DOUBLE", lambda: 1.0),
            "payload": ("DOUBLE", lambda: self.payload),
            "payload_cog": ("VECTOR3D", lambda: self.cog),
            "tcp_offset": ("VECTOR6D", lambda: self.tcp),
        }
        for i in range(48):
            fixed[f"output_int_register_{i}"] = ("INT32", lambda i=i: self.out_ints[i])
            fixed[f"output_double_register_{i}"] = ("DOUBLE", lambda i=i: self.out_doubles[i])
        return fixed

    def runtime(self) -> int:
        return PAUSED if self.paused else (PLAYING if self.playing else STOPPED)

    def speed(self) -> float:
        return math.hypot(*self.velocity)

    def tick(self, dt_s: float) -> None:
        self.now_s += dt_s
        late = self.watchdog_hz > 0 and self.now_s - self.kicked_s > 1 / self.watchdog_hz
        if self.playing and late:
            self.end_program()
        speed = self.speed()
        if self.braking is not None:
            left = max(0.0, speed - self.braking * dt_s)
            self._go([v / speed * left if speed else 0.0 for v in self.velocity], dt_s)
            if left == 0.0:
                self.braking = None
                self._rest()
        elif self.path is not None:
            target, top, acceleration = self.path
            way = [t - p for t, p in zip(target, self.pose, strict=True)][:3]
            left_m = math.hypot(*way)
            allowed = math.sqrt(2 * acceleration * left_m)
            speed = min(speed + acceleration * dt_s, top, allowed)
            if left_m <= max(speed * dt_s, 1e-7):
                self.pose, self.velocity, self.path = list(target), [0.0] * 3, None
                self._rest()
            else:
                self._go([w / left_m * speed for w in way], dt_s)

    def _go(self, velocity: list[float], dt_s: float) -> None:
        self.velocity = velocity
        for axis in range(3):
            self.pose[axis] += velocity[axis] * dt_s

    def _rest(self) -> None:
        """A motion has ended: tell a waiting client, and close the asynchronous operation."""
        if self.answers_at_rest:
            self.answers_at_rest = False
            self.out_ints[0] = 2
        if self.out_ints[2] & 0x8000:
            self.out_ints[2] &= ~0x8000

    def halt(self, deceleration: float) -> None:
        self.path, self.braking = None, deceleration

    def start_program(self) -> None:
        self.num_scripts += 1
        self.playing, self.paused, self.watchdog_hz = self.safety == "NORMAL", False, 0.0
        self.kicked_s, self.taken_command, self.answers_at_rest = self.now_s, 0, False
        self.ints[0], self.out_ints[0], self.out_ints[2] = 0, 1, 0

    def end_program(self) -> None:
        self.playing = self.paused = False
        self.out_ints[0] = 0
        self.halt(STOP_M_S2)

    def protective_stop(self) -> None:
        self.safety, self.paused = "PROTECTIVE_STOP", self.playing
        self.halt(STOP_M_S2)

    # the script: a command number in input_int_register_0, answered in output_int_register_0
    def inputs_written(self, names: list[str]) -> None:
        if "input_int_register_0" in names:
            self.kicked_s = self.now_s
        command = self.ints[0]
        if not self.playing or self.paused or self.answers_at_rest:
            return
        if command == 0:
            self.taken_command, self.out_ints[0] = 0, 1
        elif self.taken_command == 0:
            self.taken_command = command
            answer = _COMMANDS.get(command)
            if answer is None:
                self.end_program()  # 255, and what the script does not know
            elif answer(self):
                self.out_ints[0] = 2
            else:
                self.answers_at_rest = True

    def begin_operation(self) -> None:
        self.operation = (self.operation + 1) % 128
        self.out_ints[2] = self.operation << 24 | 0x8000


def _move_line(cell: Cell) -> bool:
    cell.path = (cell.doubles[0:6], cell.doubles[6], cell.doubles[7])
    cell.braking = None
    if cell.ints[1] == 1:
        cell.begin_operation()
    return cell.ints[1] == 1


def _stop_line(cell: Cell) -> bool:
    cell.begin_operation()
    cell.halt(cell.doubles[0])
    return cell.ints[1] == 1


def _set_payload(cell: Cell) -> bool:
    cell.payload, cell.cog = cell.doubles[0], cell.doubles[1:4]
    return True


def _set_tcp(cell: Cell) -> bool:
    change = [new - old for new, old in zip(cell.doubles[0:6], cell.tcp, strict=True)]
    cell.tcp = cell.doubles[0:6]
    cell.pose[2] -= change[2]  # the tool points down: the flange stays
    return True


def _get_tcp(cell: Cell) -> bool:
    cell.out_doubles[0:6] = cell.tcp
    return True


def _zero_force(cell: Cell) -> bool:
    cell.force = [0.0] * 6
    return True


def _set_watchdog(cell: Cell) -> bool:
    cell.watchdog_hz = cell.doubles[0]
    return True


_COMMANDS: dict[int, Callable[[Cell], bool]] = {
    3: _move_line, 8: _zero_force, 17: _set_payload, 29: _set_tcp, 33: _stop_line,
    35: _set_watchdog, 40: _get_tcp,
}  # fmt: skip
"""Commands of the script; each returns whether it is done at once (else: when the arm rests)."""
