"""Plot of measured noise: spectrum and correlation."""

from __future__ import annotations

import io
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from cltp.atomic_write import replacing
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.sensing.noise_spectrum import NoiseCurves

_WORDS = {
    "background": "less the background",
    "between": "less the frame before",
    "first": "less the first frame",
}


def write_plot(path: Path, curves: Mapping[str, NoiseCurves]) -> None:
    """Draw the spectra and correlations of all kinds into a PNG.

    Raises:
        UsageError: The file can't be written.
    """
    figure = Figure(figsize=(11, 4.2), layout="constrained")
    left, right = figure.subplots(1, 2)
    for kind, one in curves.items():
        per_mm = one.spectrum.per_mm
        density = 1e6 * 2 * np.pi * per_mm**2 * one.spectrum.power  # µm² per unit of ln k
        left.loglog(1 / per_mm, np.sqrt(density), label=_WORDS[kind])
        right.plot(one.distance_mm, one.correlation, label=_WORDS[kind])
    left.invert_xaxis()
    left.set_xlabel("wavelength, mm")
    left.set_ylabel("µm per √(unit of ln wavelength)")
    left.set_title("Spectrum, with tilt")
    right.axhline(np.exp(-1), color="grey", lw=0.8)
    right.set_xlabel("distance, mm")
    right.set_title("Correlation, without tilt; grey: 1/e")
    for axes in (left, right):
        axes.grid(visible=True, alpha=0.3)
        axes.legend(fontsize=8)
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png", dpi=110)
    try:
        with replacing(path) as part:
            part.write_bytes(drawn.getvalue())
    except OSError as error:
        raise UsageError(f"--plot {path} can't be written: {error.strerror or error}") from None
