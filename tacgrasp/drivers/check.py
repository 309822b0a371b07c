"""What a check of a device found, for ``tacgrasp doctor``."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """One thing that was looked at.

    Attributes:
        device: Of which device: arm, gripper, sensor, or a part of the rig's file.
        name: What was looked at.
        ok: Whether it is as it must be.
        found: What was found, with units.
        advice: What to do; given when it is not ok.

    Raises:
        ValueError: It is not ok and no advice is given.
    """

    device: str
    name: str
    ok: bool
    found: str
    advice: str = ""

    def __post_init__(self) -> None:
        if not self.ok and not self.advice:
            raise ValueError(f"{self.device} {self.name}: say what to do about {self.found!r}")
