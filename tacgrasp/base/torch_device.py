"""Torch devices by the name given to ``--device``."""

from __future__ import annotations

import torch

from tacgrasp.base.errors import UsageError


def usable_device(name: str) -> torch.device:
    """Device of that name.

    Raises:
        UsageError: There is none, or torch can't use it on this computer.
    """
    try:
        device = torch.device(name)
        torch.zeros(1, device=device).cpu()  # a meta device has no numbers
    except (RuntimeError, AssertionError) as error:
        reason = str(error).splitlines()[0]
        raise UsageError(f"--device {name} can't be used: {reason}; cpu always can") from None
    return device
