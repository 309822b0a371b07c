"""Settings of a UR arm: the section ``hardware.arm`` of a rig's file.

The bounds are hard: the worker refuses a motion beyond them, whatever a task or a flag allows.
"""

from __future__ import annotations

from typing import Literal

from pydantic import Field, model_validator

from tacgrasp.base.settings import FlangeOffset, Number, RotationVector, SettingsBase, Vector


class UrSettings(SettingsBase):
    """A UR e-Series arm (or PolyScope X), driven by ur_rtde. Ports are fixed by the controller.

    Attributes:
        kind: Name of the driver.
        host: Address of the controller.
        payload_kg: Mass of gripper, sensor and held object [kg].
        payload_cog_m: Centre of gravity of the payload in the flange frame [m], within 1 m.
        tcp_offset_m: Position of the tool centre point (TCP) in the flange frame [m], within 1 m.
        tcp_offset_rad: Rotation vector of the TCP in the flange frame [rad].
        workspace_low_m: Lower corner of the box that the TCP must stay in [m, base frame].
        workspace_high_m: Upper corner of the box [m, base frame].
        max_speed_m_s: Largest speed of a move [m/s].
        max_acceleration_m_s2: Largest acceleration of a move [m/s²].
        max_turn_rad: Largest change of the tool's orientation in one move [rad].
        stop_deceleration_m_s2: Deceleration of a stop [m/s²]; 10 brings 0.4 m/s to rest in 40 ms.
        max_contact_force_n: Largest force on the tool in motion; a larger one is a fault [N]. The
            force sensor is zeroed at rest when the arm is connected.
        watchdog_hz: The controller ends the program after 1 / watchdog_hz without a signal [Hz].
            25, not the library's usual 10: with a dead link, 40 ms of waiting and 40 ms of braking
            from 0.4 m/s stay within 100 ms.
        supervision_hz: Rate of data and of supervision [Hz].
        stale_ms: Largest age of data; older data are a fault [ms].
        min_speed_fraction: Lowest position of the speed slider, 0 to 1.
        reach_tolerance_mm: Largest distance from the target at the end of a move; more is a fault
            [mm].
        move_margin_s: Time that a move may take beyond its trapezoid before it is a fault [s].
        start_timeout_s: Longest start of the worker [s].
    """

    kind: Literal["ur"] = "ur"
    host: str = Field(min_length=1)
    payload_kg: Number = Field(ge=0, le=20)
    payload_cog_m: FlangeOffset = (0.0, 0.0, 0.0)
    tcp_offset_m: FlangeOffset = (0.0, 0.0, 0.0)
    tcp_offset_rad: RotationVector = (0.0, 0.0, 0.0)
    workspace_low_m: Vector
    workspace_high_m: Vector
    max_speed_m_s: Number = Field(default=0.4, gt=0, le=1)
    max_acceleration_m_s2: Number = Field(default=10.0, gt=0, le=15)
    max_turn_rad: Number = Field(default=0.5, ge=0, le=3.1)
    stop_deceleration_m_s2: Number = Field(default=10.0, ge=2, le=30)
    max_contact_force_n: Number = Field(default=30.0, gt=0, le=150)
    watchdog_hz: Number = Field(default=25.0, ge=10, le=100)
    supervision_hz: Number = Field(default=125.0, ge=50, le=500)
    stale_ms: Number = Field(default=60.0, ge=20, le=500)
    min_speed_fraction: Number = Field(default=0.05, gt=0, le=1)
    reach_tolerance_mm: Number = Field(default=0.5, gt=0, le=5)
    move_margin_s: Number = Field(default=1.0, ge=0.2, le=60)
    start_timeout_s: Number = Field(default=8.0, ge=1, le=60)

    @model_validator(mode="after")
    def _box_is_not_empty(self) -> UrSettings:
        check_box(self.workspace_low_m, self.workspace_high_m)
        return self


def check_box(low_m: Vector, high_m: Vector) -> None:
    """Check the corners of a workspace box.

    Raises:
        ValueError: The box is empty.
    """
    if any(low >= high for low, high in zip(low_m, high_m, strict=True)):
        raise ValueError(
            f"workspace_low_m {list(low_m)} must be below workspace_high_m {list(high_m)} "
            "in x, y and z"
        )
