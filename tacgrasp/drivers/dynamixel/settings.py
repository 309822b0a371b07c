"""What a rig's file says about a Dynamixel gripper.

Not here: force over current, which is measured (``gripper_calibration``), and the limits of force
that a task is held to (``tacgrasp.config.schema.GripperConfig``).
"""

from __future__ import annotations

from pathlib import Path

from pydantic import Field, model_validator

from tacgrasp.base.settings import Number, Section
from tacgrasp.drivers.dynamixel.registers import MODELS, WATCHDOG_UNIT_S

BAUDS = (9600, 57600, 115200, 1_000_000, 2_000_000, 3_000_000, 4_000_000)


class ServoSettings(Section):
    """One servo of the gripper.

    Attributes:
        id: On the bus.
        open_ticks: Its position with the fingers open, at ``open_width_mm``.
        closed_ticks: Its position with the fingers closed, at ``closed_width_mm``; a servo that is
            mounted the other way round has them the other way round.
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


class DynamixelSettings(Section):
    """A gripper of one or two Dynamixel servos under current-based position control.

    Ticks and width go together linearly. Of two servos each moves its own finger by half of the
    width; they get the same current.

    Attributes:
        port: Serial port: a path, a name under /dev/serial/by-id, or the adapter's serial number.
        baud: [bit/s].
        unit: What you call this gripper; a calibration of another one is refused.
        model: Of the servos.
        servos: One or two.
        open_width_mm: Opening between the fingers at ``open_ticks`` [mm].
        closed_width_mm: At ``closed_ticks`` [mm].
        speed_mm_s: Of the fingers, opening and closing [mm/s].
        open_current_ma: Current with which they open [mA].
        max_current_ma: Hard limit of every current that is sent [mA].
        max_temperature_c: At which a run ends, below the servo's own limit [°C].
        calibration: File with force over current; relative to the rig's file.
        max_calibration_age_days: Older ones are refused.
        bus_watchdog_ms: Silence after which the servo stops taking goals [ms]; 0 turns it off.
        poll_ms: How often the servos are looked at [ms].
        reply_timeout_ms: Longest wait for an answer [ms].
        patience_ms: Silence of a servo that is put up with while the arm stands [ms]; while it
            moves, two answers that do not come are a fault.
        drain_ms: How long stray answers are thrown away after one did not come [ms].
        settle_polls: So many times in a row the fingers must be at rest.
        settle_timeout_s: Longest closing or opening [s].
        max_skew_mm: How far two fingers may differ when they have come to rest [mm].
    """

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
    patience_ms: Number = Field(default=400.0, ge=0, le=1000)
    drain_ms: Number = Field(default=60.0, ge=60, le=500)
    settle_polls: int = Field(default=4, ge=2, le=50, strict=True)
    settle_timeout_s: Number = Field(default=4.0, ge=0.5, le=30)
    max_skew_mm: Number = Field(default=5.0, gt=0, le=100)

    @model_validator(mode="after")
    def _parts_fit(self) -> DynamixelSettings:
        if self.baud not in BAUDS:
            raise ValueError(f"baud must be one of {', '.join(map(str, BAUDS))}, got {self.baud}")
        if self.model not in MODELS:
            raise ValueError(
                f"model must be one with current control ({', '.join(sorted(MODELS))}), "
                f"got {self.model!r}"
            )
        if len({servo.id for servo in self.servos}) < len(self.servos):
            raise ValueError("two servos need two ids")
        if self.closed_width_mm >= self.open_width_mm:
            raise ValueError(
                f"closed_width_mm {self.closed_width_mm} must be below open_width_mm "
                f"{self.open_width_mm}"
            )
        if self.open_current_ma > self.max_current_ma:
            raise ValueError(
                f"open_current_ma {self.open_current_ma} is above max_current_ma "
                f"{self.max_current_ma}"
            )
        unit_ms = round(1000 * WATCHDOG_UNIT_S)
        if self.bus_watchdog_ms % unit_ms or 0 < self.bus_watchdog_ms < 200:
            raise ValueError(
                f"bus_watchdog_ms must be 0 or a multiple of {unit_ms} from 200 on, got "
                f"{self.bus_watchdog_ms}"
            )
        return self
