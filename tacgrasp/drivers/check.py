"""Result of one check of a device, for ``tacgrasp doctor``."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """Result of one check.

    Attributes:
        device: Device: arm, gripper, sensor, or a part of the rig's file.
        name: Name of the check.
        ok: Whether the check has passed.
        detail: Measured or read values, with units.
        advice: What to do; required when ``ok`` is False.

    Raises:
        ValueError: A failed check without advice.
    """

    device: str
    name: str
    ok: bool
    detail: str
    advice: str = ""

    def __post_init__(self) -> None:
        if not self.ok and not self.advice:
            raise ValueError(f"{self.device} {self.name}: no advice for {self.detail!r}")


def finding(device: str, name: str, ok: bool, detail: str, advice: str = "") -> Finding:
    """A finding; its advice is dropped when the check has passed."""
    return Finding(device=device, name=name, ok=ok, detail=detail, advice="" if ok else advice)
