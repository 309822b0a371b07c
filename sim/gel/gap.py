"""The gap between a gel at rest and a body: from which distance on there is no body."""

from __future__ import annotations

NO_BODY_MM = 50.0
"""A gap of this or more is no body [mm]. No finger closes so far, and infinities stay out."""
