"""Writes a figure of a benchmark."""

from __future__ import annotations

import io
from pathlib import Path

from matplotlib.figure import Figure

from cltp.atomic_write import replacing
from tacgrasp.base.errors import UsageError


def write_png(path: Path, figure: Figure) -> None:
    """Write a figure as PNG, whole or not at all.

    Raises:
        UsageError: The file can't be written.
    """
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png", dpi=80)
    try:
        with replacing(path) as part:
            part.write_bytes(drawn.getvalue())
    except OSError as error:
        raise UsageError(f"--plot {path} can't be written: {error.strerror or error}") from None
