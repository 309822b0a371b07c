"""The gap between a gel at rest and a body, and the gap that stands for no body."""

from __future__ import annotations

NO_BODY_MM = 50.0
"""Gap from which there is no body [mm]; it replaces infinity. Our choice: more than a body is
curved over a pad."""
