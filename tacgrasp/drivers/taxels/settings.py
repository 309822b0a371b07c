"""Settings of a serial taxel array, as a rig's file gives them."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from tacgrasp.base.settings import Number, Section


class TaxelSettings(Section):
    """A taxel array on a serial port that speaks the packets of docs/taxels.md.

    Attributes:
        kind: Which driver.
        port: Its path, its name under /dev/serial/by-id or a part of it, or the serial number of
            its adapter.
        baud: Speed of the line; USB arrays ignore it [bit/s].
        sensor: Which sensor's field the grid of taxels covers.
        read_timeout_s: Longest wait for a frame captured after the call [s].
        stale_s: Without a frame for so long, the array is not alive [s].
        connect_timeout_s: Longest wait for the first frame [s].
    """

    kind: Literal["taxels"] = "taxels"
    port: str = Field(min_length=1)
    baud: int = Field(default=921_600, ge=9600, le=12_000_000, strict=True)
    sensor: str = "gelsight_mini"
    read_timeout_s: Number = Field(default=0.5, ge=0.05, le=5)
    stale_s: Number = Field(default=0.15, ge=0.02, le=5)
    connect_timeout_s: Number = Field(default=1.5, ge=0.1, le=10)
