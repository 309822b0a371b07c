"""Options of the emulated UR controller."""

from __future__ import annotations

import ipaddress
import math
from dataclasses import dataclass

Pose6 = tuple[float, float, float, float, float, float]

START_TCP: Pose6 = (0.45, -0.10, 0.20, math.pi, 0.0, 0.0)
"""Pose of the tool centre point at the start [m, rad]: the simulated rig's start pose."""

TCP_OFFSET: Pose6 = (0.0, 0.0, 0.15, 0.0, 0.0, 0.0)
"""Flange to tool centre point at the start [m, rad]."""

UNLOCK_AFTER_S = 5.0
"""Least time from a protective stop to its release [s]. Source: the dashboard's documentation."""


def check_loopback(host: str) -> None:
    """Check the address of an emulator, which has no authentication.

    Raises:
        ValueError: It is no loopback address.
    """
    try:
        is_loopback = ipaddress.ip_address(host).is_loopback
    except ValueError:
        is_loopback = False
    if not is_loopback:
        raise ValueError(
            f"--host must be a loopback address such as 127.0.0.2, got {host!r}: an emulator has "
            "no authentication"
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class UrOptions:
    """A UR controller: dashboard, script and RTDE ports on a loopback address.

    Raises:
        ValueError: The host is no loopback address.

    Attributes:
        host: loopback address, 127.x.y.z
        version: PolyScope version, major.minor
        stream_hz: fastest rate of the data stream [Hz]
        start_tcp: pose of the tool centre point at the start [m, rad]
        tcp_offset: flange to tool centre point at the start [m, rad]
        unlock_after_s: least time from a protective stop to its release [s]
        world_port: local TCP port of a world that follows the arm; without one, no world follows
    """

    host: str = "127.0.0.2"
    version: str = "5.12"
    stream_hz: float = 125.0
    start_tcp: Pose6 = START_TCP
    tcp_offset: Pose6 = TCP_OFFSET
    unlock_after_s: float = UNLOCK_AFTER_S
    world_port: int | None = None

    def __post_init__(self) -> None:
        check_loopback(self.host)
