"""The gap between a gel at rest and a body, and the gap that stands for no body."""

from __future__ import annotations

NO_BODY_MM = 50.0
"""Gap from which there is no body [mm]. No finger opens so far, and it replaces infinity."""
