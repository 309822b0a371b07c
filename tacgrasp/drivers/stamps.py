"""Both clocks of this computer, for whatever is captured."""

from __future__ import annotations

import time

from cltp.tactile.cloud import Stamp


def real_stamp() -> Stamp:
    """Both clocks, now."""
    return Stamp(monotonic_s=time.monotonic(), wall_s=time.time())
