"""Settings of the emulated UR arm: its tool and the simulated workspace."""

from __future__ import annotations

from tacgrasp.drivers.ur.settings import UrSettings

TOOL_M = (0.0, 0.0, 0.15)
"""Tool offset at the start of the emulator [m]."""


def emulated_arm(host: str) -> UrSettings:
    """Settings for an emulator at a loopback address.

    The margin of a move is long: a move ends when the emulated world has followed, which takes
    longer on a busy machine.
    """
    return UrSettings(
        host=host,
        payload_kg=0.9,
        payload_cog_m=(0.0, 0.0, 0.05),
        tcp_offset_m=TOOL_M,
        workspace_low_m=(0.35, -0.20, 0.12),
        workspace_high_m=(0.55, 0.00, 0.40),
        move_margin_s=20.0,
    )
