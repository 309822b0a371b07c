"""Move a rig by hand: each key is one small step within the limits of a run.

``key_command`` maps a key to a command and uses no device; ``Jogger`` carries the command out. Not
here: the keyboard and the screen (``tacgrasp.cli.jog``).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from cltp.errors import TouchError
from cltp.tactile.measure import contact_state
from primitives.devices import Pose
from primitives.execution import PadAxes, rotate
from primitives.force_guard import GuardedGripper
from primitives.limits import Limits, check_workspace, clamp_force, clamp_step
from tacgrasp.console import contact_text
from tacgrasp.rig.gel_sense import GelSense
from tacgrasp.rig.protocols import Rig

SPEED_M_S = 0.02
"""Speed of every step. Our choice: slow enough to be stopped by hand."""

STEPS_MM = (0.2, 0.5, 1.0, 2.0, 5.0)
FORCE_FACTOR = 1.25
_FIRST_STEP = 2  # 1 mm

_DIRECTIONS: Mapping[str, tuple[str, tuple[float, float, float]]] = {
    "w": ("pad", (0.0, 1.0, 0.0)),
    "s": ("pad", (0.0, -1.0, 0.0)),
    "a": ("pad", (-1.0, 0.0, 0.0)),
    "d": ("pad", (1.0, 0.0, 0.0)),
    "r": ("base", (0.0, 0.0, 1.0)),
    "f": ("base", (0.0, 0.0, -1.0)),
    "i": ("base", (1.0, 0.0, 0.0)),
    "k": ("base", (-1.0, 0.0, 0.0)),
    "j": ("base", (0.0, 1.0, 0.0)),
    "l": ("base", (0.0, -1.0, 0.0)),
}
"""Frame and direction of each moving key: pad x to the right, y to the palm; base of the arm."""

HELP = (
    "w s a d  towards palm, fingertip, left, right of the pad      r f  up, down      "
    "i k j l  +x -x +y -y of the base",
    "g  close (or adjust) with the force      o  open      + -  force      [ ]  step      "
    "space  stop      ?  this      q  quit",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class JogSettings:
    """Length of the next step and force of the next grip.

    Attributes:
        step: Index into ``STEPS_MM``.
        force_n: Force of the next grip [N].
    """

    step: int = _FIRST_STEP
    force_n: float

    @property
    def step_mm(self) -> float:
        return STEPS_MM[self.step]


@dataclass(frozen=True, slots=True, kw_only=True)
class JogStep:
    """Move by ``length_mm`` along ``direction``, a unit vector in the ``frame`` pad or base."""

    frame: str
    direction: tuple[float, float, float]
    length_mm: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Grip:
    """Close, or adjust the grip, to a force [N]."""

    force_n: float


class JogAction(Enum):
    """A command without parameters: open a little, stop the arm, list the keys, end."""

    OPEN = "open"
    STOP = "stop"
    HELP = "help"
    QUIT = "quit"


@dataclass(frozen=True, slots=True, kw_only=True)
class Unknown:
    """A key without a command."""

    key: str


Command = JogStep | Grip | JogAction | Unknown | None
"""None changes the settings only."""


def key_command(key: str, settings: JogSettings) -> tuple[Command, JogSettings]:
    """The command of a key, and the settings after it."""
    if key in _DIRECTIONS:
        frame, direction = _DIRECTIONS[key]
        return JogStep(frame=frame, direction=direction, length_mm=settings.step_mm), settings
    if key in "[]" and key:
        step = settings.step + (1 if key == "]" else -1)
        return None, replace(settings, step=min(max(step, 0), len(STEPS_MM) - 1))
    if key in ("+", "=", "-"):
        factor = 1 / FORCE_FACTOR if key == "-" else FORCE_FACTOR
        return None, replace(settings, force_n=settings.force_n * factor)
    commands: Mapping[str, Command] = {
        "g": Grip(force_n=settings.force_n),
        "o": JogAction.OPEN,
        " ": JogAction.STOP,
        "?": JogAction.HELP,
        "h": JogAction.HELP,
        "q": JogAction.QUIT,
        "\x1b": JogAction.QUIT,
        "\x03": JogAction.QUIT,
    }
    return commands.get(key, Unknown(key=key)), settings


class Jogger:
    """Carries commands out on a rig, within all limits but that of an episode's travel."""

    def __init__(
        self,
        rig: Rig,
        limits: Limits,
        axes: PadAxes,
        *,
        clear_mm: float,
        limit_n: float,
        max_gain: float,
    ) -> None:
        """Take a connected rig.

        Args:
            rig: The rig.
            limits: Bounds of all commands.
            axes: The pad's axes in the TCP frame.
            clear_mm: Opening of one step [mm].
            limit_n: Felt force that is never exceeded [N]: the task's.
            max_gain: Largest ratio of true to commanded force, until something is felt.
        """
        self._gripper = GuardedGripper(rig.gripper, limit_n=limit_n, max_gain=max_gain)
        self._rig, self._limits = rig, limits
        self._pad = np.array([axes.x_tcp, axes.y_tcp])
        self._clear_m = clear_mm / 1000
        self._sense = GelSense(rig.sensor)

    def carry_out(self, command: Command) -> str:
        """Carry out a command and return its result as text.

        Raises:
            LimitError: The command is beyond the limits; nothing was sent.
            RobotError: A device failed.
            TouchError: The sensor gave no reference before a grip; nothing was sent.
        """
        if isinstance(command, JogStep):
            return self._step(command)
        if isinstance(command, Grip):
            force = clamp_force(command.force_n, self._limits)
            if not self._rig.gripper.state().closed:
                self._sense.take_reference()
            state = self._gripper.grip(force.value)
            notes = "".join(f" ({note})" for note in (force.note, state.clamped) if note)
            return f"closed with {state.force_n:.2f} N at {1000 * state.width_m:.1f} mm{notes}"
        if command is JogAction.OPEN:
            return self._open()
        if command is JogAction.STOP:
            self._rig.arm.stop()
            return "stopped"
        if isinstance(command, Unknown):
            return f"{command.key!r} is no command; ? lists them"
        return "\n".join(HELP) if command is JogAction.HELP else ""

    def _open(self) -> str:
        """Open, and take the gel as untouched; a sensor that gives no reference hinders nothing."""
        state = self._rig.gripper.open_by(self._clear_m)
        note = ""
        try:
            self._sense.take_reference()
        except TouchError as error:
            note = f"; no new reference, so a contact that is shown may be none: {error}"
        return f"open at {1000 * state.width_m:.1f} mm{note}"

    def contact(self) -> str:
        """Description of the present contact; it says so where there is no reference yet.

        Raises:
            TouchError: The sensor failed.
        """
        cloud = self._sense.read()
        in_contact = self._sense.in_contact(cloud)
        if in_contact:
            self._gripper.feel(self._sense.felt_force(cloud))
        text = contact_text(contact_state(cloud, in_contact=in_contact), cloud.force_scale)
        return f"{text}; no reference yet, o takes one" if in_contact is None else text

    def _step(self, step: JogStep) -> str:
        start = self._rig.arm.pose()
        length = clamp_step(step.length_mm, self._limits)
        direction = self._base_direction(step, start)
        target = replace(start, position_m=start.position_m + 1e-3 * length.value * direction)
        check_workspace(target, self._limits)
        speed_m_s = min(SPEED_M_S, self._limits.max_speed_m_s)
        reached = self._rig.arm.move_to(target, speed_m_s=speed_m_s)
        x, y, z = 1000 * reached.position_m
        note = f" ({length.note})" if length.note else ""
        return f"at ({x:.1f}, {y:.1f}, {z:.1f}) mm{note}"

    def _base_direction(self, step: JogStep, pose: Pose) -> NDArray[np.float64]:
        if step.frame == "base":
            return np.array(step.direction)
        x, y, _ = step.direction
        return rotate(pose.rotvec_rad, x * self._pad[0] + y * self._pad[1])
