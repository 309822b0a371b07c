"""What one servo reports in a poll, compared with what this program last commanded.

A servo that restarts, or that another program writes to, goes on answering. Only its registers show
that torque, operating mode, bus watchdog or goals are no longer those that were set: any difference
is a fault. Not here: reading and latching (``poller``).
"""

from __future__ import annotations

import struct
from dataclasses import dataclass

from tacgrasp.drivers.dynamixel import registers as reg

_STATE = struct.Struct("<B5xB27xB3xh12xi2xB3xhii10xB")
"""Registers 64, 70, 98, 102, 116, 122, 126, 128, 132 and 146 from ``reg.TORQUE`` on."""

STATE_LENGTH = _STATE.size
STATE_BYTES = 14 + 11 + STATE_LENGTH + 14 + 11 + 1
"""Bytes on the line for one poll of one servo: two instructions and their replies."""

LET_GO = "what was held has been let go"


@dataclass(frozen=True, slots=True, kw_only=True)
class ServoCommand:
    """Registers of one servo as this program has set them."""

    torque: int
    mode: int
    watchdog: int
    goal_current: int
    goal_position: int


@dataclass(frozen=True, slots=True)
class ServoSample:
    """State of one servo at one poll; current in the model's units, signed like the position."""

    mode: int
    torque: int
    hardware_error: int
    watchdog: int
    goal_current: int
    goal_position: int
    moving: bool
    current: int
    velocity: int
    position: int
    temperature_c: int

    @classmethod
    def unpacked(cls, mode: int, data: bytes) -> ServoSample:
        """The sample in ``STATE_LENGTH`` bytes from ``reg.TORQUE`` on, and the operating mode."""
        torque, error, watchdog, goal_current, goal_position, moving, *rest = _STATE.unpack(data)
        return cls(mode, torque, error, watchdog, goal_current, goal_position, bool(moving), *rest)

    def problem(self, servo: int, commanded: ServoCommand, *, alert: bool, unit_ma: float) -> str:
        """Difference from what was commanded, with its meaning for a held object; empty for none.

        Args:
            servo: Id of the servo, for the message.
            commanded: What was set last.
            alert: Whether a reply had the alert bit.
            unit_ma: Current of one register unit [mA].
        """
        name = f"servo {servo} of the gripper"
        if self.hardware_error or alert:
            return self._hardware_error(name)
        if self.watchdog == reg.WATCHDOG_TRIPPED:
            grip = "it takes no goal until the next start" if self.torque else LET_GO
            return (
                f"the bus watchdog of servo {servo} has tripped: this program was stalled for more "
                f"than {1e3 * reg.WATCHDOG_UNIT_S * commanded.watchdog:.0f} ms; {grip}; start the "
                "run again"
            )
        reset = self.watchdog != commanded.watchdog and self.watchdog == 0
        if self.torque != commanded.torque and (
            reset or self.goal_current != commanded.goal_current
        ):
            return (
                f"{name} has restarted: its torque is off and its settings are gone; {LET_GO}. "
                "Check its supply and its cable, then start the run again"
            )
        return self._differences(name, commanded, unit_ma)

    def _hardware_error(self, name: str) -> str:
        error = self.hardware_error
        text = reg.hardware_error_text(error) or "a hardware error that was gone when it was read"
        grip = "it still holds" if self.torque else f"its torque is off: {LET_GO}"
        return (
            f"{name} reports: {text} (hardware error {error:#04x}); {grip}. Remove the cause, then "
            "reboot the servo or switch its power off and on"
        )

    def _differences(self, name: str, commanded: ServoCommand, unit_ma: float) -> str:
        pressed = f"what it holds is pressed with up to {abs(self.goal_current) * unit_ma:.0f} mA"
        for register, read, expected, meaning in (
            ("torque", self.torque, commanded.torque, LET_GO),
            ("operating mode", self.mode, commanded.mode, "its goals mean something else"),
            ("bus watchdog", self.watchdog, commanded.watchdog, "it would not notice a dead host"),
            ("goal current", self.goal_current, commanded.goal_current, pressed),
            ("goal position", self.goal_position, commanded.goal_position, "its fingers move"),
        ):
            if read != expected:
                return (
                    f"the {register} of {name} reads {read}, set was "
                    f"{expected}: {meaning}. Another program writes to it, or it lost power for "
                    "a moment: end that program, check its supply, then start the run again"
                )
        return ""
