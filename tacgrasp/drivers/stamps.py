"""Stamps of captured data: both clocks of this computer."""

from __future__ import annotations

import time

from cltp.tactile.cloud import Stamp


def real_stamp() -> Stamp:
    """Present time on both clocks."""
    return Stamp(monotonic_s=time.monotonic(), wall_s=time.time())
