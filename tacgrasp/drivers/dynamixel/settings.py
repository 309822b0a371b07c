"""Settings of a Dynamixel gripper: the section ``hardware.gripper`` of a rig's file.

Not here: force over current, which is measured (``calibration``), and the limits of force of a task
(``tacgrasp.config.schema.GripperConfig``).
"""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from pydantic import Field, model_validator

from tacgrasp.base.settings import Number, SettingsBase
from tacgrasp.drivers.dynamixel.registers import MODELS, WATCHDOG_UNIT_S
from tacgrasp.drivers.dynamixel.servo_state import STATE_BYTES
from tacgrasp.drivers.latest import STALE_MARGIN_S

BAUDS = (9600, 57600, 115200, 1_000_000, 2_000_000, 3_000_000, 4_000_000)
_BITS_PER_BYTE = 10  # start and stop bit


class ServoSettings(SettingsBase):
    """One servo of the gripper.

    Attributes:
        id: Id on the bus.
        open_ticks: Position with the fingers open, at ``open_width_mm``.
        closed_ticks: Position with the fingers closed, at ``closed_width_mm``; below ``open_ticks``
            or above it, according to the servo's mounting.
    """

    id: int = Field(ge=0, le=252, strict=True)
    open_ticks: int = Field(ge=-1_048_575, le=1_048_575, strict=True)
    closed_ticks: int = Field(ge=-1_048_575, le=1_048_575, strict=True)

    @model_validator(mode="after")
    def _it_moves(self) -> ServoSettings:
        if abs(self.open_ticks - self.closed_ticks) < 10:
            raise ValueError(
                f"open_ticks {self.open_ticks} and closed_ticks {self.closed_ticks} of servo "
                f"{self.id} must differ by 10 or more"
            )
        return self


class DynamixelSettings(SettingsBase):
    """A gripper of one or two Dynamixel servos under current-based position control.

    Opening and ticks are linear to each other. With two servos, each moves its own finger by half
    of the opening, and both get the same current.

    Attributes:
        kind: Name of the driver.
        port: Serial port: a path, a name under /dev/serial/by-id, or the adapter's serial number.
        baud: Baud rate [bit/s].
        unit: Name of this gripper; a calibration of another unit is refused.
        model: Model of the servos.
        servos: One or two servos.
        open_width_mm: Opening between the fingers at ``open_ticks`` [mm].
        closed_width_mm: Opening between the fingers at ``closed_ticks`` [mm].
        speed_mm_s: Speed of opening and closing [mm/s].
        open_current_ma: Current for opening [mA].
        max_current_ma: Hard limit of every commanded current [mA].
        max_temperature_c: Temperature above which a run ends; below the servo's own limit [°C].
        calibration: File with force over current; relative to the rig's file.
        max_calibration_age_days: Largest age of the calibration [days].
        bus_watchdog_ms: Silence after which the servo refuses goals [ms]; 0 turns it off.
        poll_ms: Period of polling [ms].
        reply_timeout_ms: Longest wait for a reply [ms].
        patience_ms: Longest silence of a servo, or series of corrupt replies, that is waited out
            [ms]; a moving arm is held meanwhile, from ``stale_s`` on.
        drain_ms: Time for which stray bytes are discarded after a missing reply [ms].
        settle_polls: Number of polls in a row in which resting fingers must be at rest.
        settle_timeout_s: Longest closing or opening [s].
        max_skew_mm: Largest difference between two fingers at rest [mm].
    """

    kind: Literal["dynamixel"] = "dynamixel"
    port: str = Field(min_length=1)
    baud: int = Field(default=1_000_000, strict=True)
    unit: str = Field(min_length=1)
    model: str
    servos: tuple[ServoSettings, ...] = Field(min_length=1, max_length=2)
    open_width_mm: Number = Field(gt=0, le=500)
    closed_width_mm: Number = Field(default=0.0, ge=0, le=500)
    speed_mm_s: Number = Field(default=100.0, ge=1, le=500)
    open_current_ma: Number = Field(default=300.0, gt=0, le=5000)
    max_current_ma: Number = Field(gt=0, le=5000)
    max_temperature_c: Number = Field(default=65.0, ge=30, le=80)
    calibration: Path = Path("gripper_calibration.yaml")
    max_calibration_age_days: int = Field(default=90, ge=1, le=3650, strict=True)
    bus_watchdog_ms: int = Field(default=500, ge=0, le=2540, strict=True)
    poll_ms: Number = Field(default=15.0, ge=2, le=100)
    reply_timeout_ms: Number = Field(default=25.0, ge=5, le=100)
    patience_ms: Number = Field(default=1000.0, ge=0, le=1000)
    drain_ms: Number = Field(default=60.0, ge=60, le=500)
    settle_polls: int = Field(default=4, ge=2, le=50, strict=True)
    settle_timeout_s: Number = Field(default=4.0, ge=0.5, le=30)
    max_skew_mm: Number = Field(default=5.0, gt=0, le=100)

    @model_validator(mode="after")
    def _parts_fit(self) -> DynamixelSettings:
        unit_ms, watchdog_ms = round(1000 * WATCHDOG_UNIT_S), self.bus_watchdog_ms
        closed_mm, open_mm = self.closed_width_mm, self.open_width_mm
        open_ma, max_ma = self.open_current_ma, self.max_current_ma
        for is_wrong, message in (
            (self.baud not in BAUDS,
             f"baud must be one of {', '.join(map(str, BAUDS))}, got {self.baud}"),
            (self.model not in MODELS,
             f"model must be one with current control ({', '.join(sorted(MODELS))}), "
             f"got {self.model!r}"),
            (len(set(self.ids)) < len(self.ids), "two servos need two ids"),
            (closed_mm >= open_mm,
             f"closed_width_mm {closed_mm} must be below open_width_mm {open_mm}"),
            (open_ma > max_ma, f"open_current_ma {open_ma} is above max_current_ma {max_ma}"),
            (watchdog_ms % unit_ms or 0 < watchdog_ms < 200,
             f"bus_watchdog_ms must be 0 or a multiple of {unit_ms} from 200 on, got "
             f"{watchdog_ms}"),
        ):  # fmt: skip
            if is_wrong:
                raise ValueError(message)
        return self

    @property
    def stale_s(self) -> float:
        """Age of the last sample from which on the arm is held [s]: two polls, and 20 ms."""
        wire_s = len(self.servos) * STATE_BYTES * _BITS_PER_BYTE / self.baud
        return 2 * max(self.poll_ms / 1000, wire_s) + STALE_MARGIN_S

    @property
    def ids(self) -> tuple[int, ...]:
        return tuple(servo.id for servo in self.servos)
