"""Settings of a serial taxel array: the section ``hardware.sensor`` of a rig's file."""

from __future__ import annotations

from typing import ClassVar, Literal

from pydantic import Field

from tacgrasp.base.settings import Number
from tacgrasp.drivers.force_scale import SensorUnitSettings


class TaxelSettings(SensorUnitSettings):
    """A taxel array on a serial port that speaks the packets of docs/taxels.md.

    Attributes:
        kind: Name of the driver.
        port: Serial port: a path, a name under /dev/serial/by-id or a part of it, or the serial
            number of the adapter.
        baud: Baud rate; USB arrays ignore it [bit/s].
        sensor: Sensor whose sensing area the grid of taxels covers.
        read_timeout_s: Longest wait for a frame captured after the call [s].
        connect_timeout_s: Longest wait for the first frame [s].
    """

    is_live: ClassVar[bool] = True
    kind: Literal["taxels"] = "taxels"
    port: str = Field(min_length=1)
    baud: int = Field(default=921_600, ge=9600, le=12_000_000, strict=True)
    sensor: str = "gelsight_mini"
    read_timeout_s: Number = Field(default=0.5, ge=0.05, le=5)
    connect_timeout_s: Number = Field(default=1.5, ge=0.1, le=10)

    @property
    def sensor_name(self) -> str:
        return self.sensor
