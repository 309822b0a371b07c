"""A client's connection to the dashboard server of an emulated controller.

Source: Universal Robots, 'Dashboard Server e-Series, port 29999'. Not emulated: files (every one is
missing, so that nothing can be played), pausing, users' roles, a pendant's popups, and reports.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from sim.emulators.ur.controller import (
    NORMAL,
    POWER_OFF,
    PROGRAM_STATES,
    PROTECTIVE,
    ROBOT_MODES,
    RUNNING,
    SAFETY_MODES,
    Controller,
)
from sim.emulators.ur.packets import StreamLostError
from sim.emulators.ur.sessions import Session

LONGEST_LINE = 4096
"""Longest accepted line [bytes]. Our choice."""


class DashboardSession(Session):
    """Port 29999: one answer per line; an unknown line is answered, and the connection stays."""

    GREETING = b"Connected: Universal Robots Dashboard Server\n"

    def __init__(self, controller: Controller, version: tuple[int, int]) -> None:
        self._controller, self._version = controller, version
        self._text = b""
        self._answers = {**self._questions(), **self._commands()}

    def receive(self, data: bytes) -> bytes:
        self._text += data
        *lines, self._text = self._text.split(b"\n")
        if max(map(len, [*lines, self._text])) > LONGEST_LINE:
            raise StreamLostError("a line without an end")
        answers = []
        for line in lines:
            if not self.ended:
                answers.append(self._answer(line.decode("utf-8", "replace").strip()))
        return b"".join(answers)

    def _answer(self, line: str) -> bytes:
        command = line.lower()
        answer = self._answers.get(command)
        if answer is None:
            with_text = next((a for word, a in _WITH_TEXT.items() if command.startswith(word)), "")
            text = line.partition(" ")[2].removeprefix("installation ")
            known = with_text.format(text) if with_text else f'could not understand: "{line}"'
            return known.encode("utf-8", "replace") + b"\n"
        return answer().encode() + b"\n"

    def _questions(self) -> Mapping[str, Callable[[], str]]:
        controller = self._controller
        return {
            "polyscopeversion": lambda: "URSoftware {}.{}.0.1100000 (Jan 01 2024)".format(
                *self._version
            ),
            "version": lambda: "{}.{}.0.1100000".format(*self._version),
            "get serial number": lambda: "20210000001",
            "get robot model": lambda: "UR5",
            "get operational mode": lambda: "NONE",
            "get loaded program": lambda: "No program loaded",
            "is in remote control": lambda: str(controller.remote).lower(),
            "robotmode": lambda: f"Robotmode: {ROBOT_MODES[controller.robot_mode]}",
            "safetystatus": lambda: f"Safetystatus: {SAFETY_MODES[controller.safety_mode]}",
            "safetymode": lambda: f"Safetymode: {SAFETY_MODES[controller.safety_mode]}",
            "running": lambda: f"Program running: {str(controller.program is not None).lower()}",
            "programstate": self._program_state,
        }

    def _commands(self) -> Mapping[str, Callable[[], str]]:
        return {
            "stop": self._stop,
            "play": lambda: "Failed to execute: play",  # no program is ever loaded
            "pause": lambda: "Failed to execute: pause",
            "power on": lambda: "Powering on",
            "power off": self._power_off,
            "brake release": self._release_brakes,
            "unlock protective stop": self._unlock,
            "close safety popup": lambda: "closing safety popup",
            "close popup": lambda: "closing popup",
            "quit": self._quit,
        }

    def _program_state(self) -> str:
        state = PROGRAM_STATES[self._controller.runtime_state]
        return f"{state} {'<none>' if self._controller.program is None else 'rtde_control'}"

    def _quit(self) -> str:
        self.ended = True
        return "Disconnected"

    def _stop(self) -> str:
        if not self._controller.remote:
            return "Failed to execute: stop"
        self._controller.stop_program("dashboard: stop")
        return "Stopped"

    def _power_off(self) -> str:
        if not self._controller.remote:
            return "Failed to execute: power off"
        self._controller.power_off()
        return "Powering off"

    def _release_brakes(self) -> str:
        controller = self._controller
        powered = controller.robot_mode in (POWER_OFF, RUNNING) and controller.remote
        if not (powered and controller.safety_mode == NORMAL):
            return "Failed to execute: brake release"
        controller.robot_mode = RUNNING
        return "Brake releasing"

    def _unlock(self) -> str:
        if self._controller.safety_mode not in (NORMAL, PROTECTIVE):
            return "Cannot unlock: this is no protective stop"
        if self._controller.safety_mode == PROTECTIVE and not self._controller.may_unlock:
            return "Cannot unlock protective stop until 5s after occurrence."
        if self._controller.safety_mode == PROTECTIVE:
            self._controller.unlock()
        return "Protective stop releasing"


_WITH_TEXT = {
    "load ": "File not found: {}",
    "popup ": "showing popup",
    "addtolog ": "Added log message",
}
"""First word of a line with a text of its own, in lower case, and the answer."""
