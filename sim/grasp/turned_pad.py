"""A sensor that is mounted a quarter turn about the gel's normal: its pad, and what it touches.

Its gel frame is turned counter-clockwise: gel +x points up in the world, +y to the left. Everything
else of the simulation stays in the gel frame (``sim.grasp.fingers``), so the body is turned the
other way, and gravity acts along -x.
"""

from __future__ import annotations

import dataclasses

import numpy as np

from sim.grasp.bodies import Body

UPRIGHT_UP, TURNED_UP = (0.0, 1.0), (1.0, 0.0)
"""Direction against gravity in the gel frame."""

TURNED_PAD_X_IN_TCP = (0.0, 0.0, -1.0)
TURNED_PAD_Y_IN_TCP = (-1.0, 0.0, 0.0)
"""Axes of the turned pad where those of an upright one are (1, 0, 0) and (0, 0, -1)."""


def turned(body: Body) -> Body:
    """A body as a turned pad meets it: what was up is now along the pad's +x."""
    x_mm, y_mm = body.com_mm
    return dataclasses.replace(body, gap_mm=np.rot90(body.gap_mm, -1), com_mm=(y_mm, -x_mm))
