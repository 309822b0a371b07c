"""``tacgrasp bench noise``: errors of real heights where nothing touches the gel.

The frames are presses of a ball; their heights outside the contacts should be flat. Amplitude,
correlation and spectrum of what they are instead are measured, against the background and from
frame to frame, and what an ideal detector of contacts could do with that noise.

Not here: errors under the ball (``tacgrasp.benchmarks.balls.heights``), the noise that the
simulator draws (``cltp.tactile.sensor_noise``), which is set from these figures.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from itertools import pairwise
from statistics import median
from typing import Any

import numpy as np
from rich.console import Console

from cltp.sensing.calibration import default_calibration, load_calibration
from cltp.sensing.photometric import Photometer
from cltp.tactile.cloud import cloud_from_heights
from cltp.tactile.contact.contact_test import touches_alone
from cltp.tactile.measure import contact_state
from cltp.tactile.sensors import SensorSpec, sensor_named
from tacgrasp.benchmarks.figures import number_table, write_figures
from tacgrasp.benchmarks.sensing.ideal_detector import DetectorFigures, detect
from tacgrasp.benchmarks.sensing.noise_spectrum import (
    BAND_EDGES_MM,
    BoolArray,
    FloatArray,
    NoiseCurves,
    autocorrelation,
    length_mm,
    radial_spectrum,
    white_mm,
)
from tacgrasp.benchmarks.sensing.untouched_parts import (
    UntouchedPart,
    untouched_parts,
    without_plane,
)
from tacgrasp.benchmarks.settings import NoiseSettings
from tacgrasp.bringup.ball_frames import read_ball_frames

Field = tuple[FloatArray, BoolArray]


@dataclass(frozen=True, slots=True, kw_only=True)
class NoiseFigures:
    """Errors of one kind, of single frames or of differences between frames.

    Attributes:
        total_mm: Standard deviation with tilt, median over the fields [mm].
        flat_mm: The same without the plane that fits best [mm].
        flat_range_mm: Its 10 and 90 % quantiles over the fields [mm].
        length_mm: Distance at which the correlation has fallen to 1/e, without planes [mm].
        tilted_length_mm: The same with them.
        tilt_x, tilt_y: Standard deviation of the planes' slopes about 0 [mm per mm].
        white_mm: Part that is new in each pixel, median [mm].
        bands_mm: Standard deviation by band of wavelengths [mm].
    """

    total_mm: float
    flat_mm: float
    flat_range_mm: tuple[float, float]
    length_mm: float
    tilted_length_mm: float
    tilt_x: float
    tilt_y: float
    white_mm: float
    bands_mm: dict[str, float]


def run(settings: NoiseSettings) -> None:
    """Measure, print, plot, and write the figures.

    Raises:
        TouchError: The folder can't be used, or shows no presses.
        UsageError: A file can't be written.
    """
    sensor = sensor_named("gelsight_mini")
    balls = read_ball_frames(settings.data, sensor, settings.background)
    calibration = settings.calibration or default_calibration(sensor)
    photometer = Photometer(load_calibration(calibration, sensor).net, balls.background, sensor)
    parts = untouched_parts(balls, photometer, settings.diameter_mm)
    kinds = {
        "background": [(part.height_mm, part.outside) for part in parts],
        "between": [_difference(one, other) for one, other in pairwise(parts)],
        "first": [_difference(parts[0], part) for part in parts[1:]],
    }
    measured = {kind: measure(fields, sensor) for kind, fields in kinds.items()}
    rng = np.random.default_rng(settings.seed)
    detectors = {kind: detect(measured[kind][1].spectrum, sensor, rng) for kind in
                 ("between", "background")}  # fmt: skip
    figures = {"felt_outside": felt_outside(parts, sensor)} | _figures(
        parts, {kind: one for kind, (one, _) in measured.items()}, detectors
    )
    _print(Console(), figures)
    if settings.plot is not None:
        from tacgrasp.benchmarks.sensing.noise_plot import write_plot  # loads matplotlib

        write_plot(settings.plot, {kind: curves for kind, (_, curves) in measured.items()})
    write_figures(settings.json, figures)


def felt_outside(parts: Sequence[UntouchedPart], sensor: SensorSpec) -> dict[str, Any]:
    """What is felt on frames whose contact is replaced by the median of what is outside it.

    ``if_contact`` takes each frame for a contact; ``in_contact`` is the fraction that the test of
    a single frame does take for one, and ``by_depth`` what ``contact_state`` says by itself.
    """
    rng = np.random.default_rng(0)
    clouds = []
    for part in parts:
        middle = np.median(part.height_mm[part.outside])
        heights = np.where(part.outside, part.height_mm, middle)
        clouds.append(cloud_from_heights(heights, sensor, rng=rng))
    taken = [contact_state(cloud, in_contact=True).force_n for cloud in clouds]
    by_depth = [contact_state(cloud).force_n for cloud in clouds]
    return {
        "in_contact": float(np.mean([touches_alone(cloud).in_contact for cloud in clouds])),
        "by_depth_p95_n": float(np.percentile(by_depth, 95)),
        "if_contact_p50_n": float(np.median(taken)),
        "if_contact_p95_n": float(np.percentile(taken, 95)),
    }


def _difference(one: UntouchedPart, other: UntouchedPart) -> Field:
    """Change of the heights from one frame to another, where neither is touched."""
    return other.height_mm - one.height_mm, one.outside & other.outside


def measure(fields: Sequence[Field], sensor: SensorSpec) -> tuple[NoiseFigures, NoiseCurves]:
    """Figures and curves of some fields of errors."""
    planes = [without_plane(field, known) for field, known in fields]
    flat = [(field, known) for (field, _), (_, known) in zip(planes, fields, strict=True)]
    slopes = np.array([slope for _, slope in planes]) / sensor.mm_per_px
    spectrum = radial_spectrum(fields, sensor.mm_per_px)
    distance, correlation = autocorrelation(flat, sensor.mm_per_px)
    flat_mm = [float(field[known].std()) for field, known in flat]
    low, high = np.percentile(flat_mm, [10, 90])
    figures = NoiseFigures(
        total_mm=median(float(field[known].std()) for field, known in fields),
        flat_mm=median(flat_mm),
        flat_range_mm=(float(low), float(high)),
        length_mm=length_mm(distance, correlation),
        tilted_length_mm=length_mm(*autocorrelation(fields, sensor.mm_per_px)),
        tilt_x=float(np.sqrt((slopes[:, 0] ** 2).mean())),
        tilt_y=float(np.sqrt((slopes[:, 1] ** 2).mean())),
        white_mm=median(white_mm(field, known) for field, known in fields),
        bands_mm={
            f"{long:g}-{short:g}": spectrum.band_mm(long, short)
            for long, short in pairwise(BAND_EDGES_MM)
        },
    )
    return figures, NoiseCurves(spectrum=spectrum, distance_mm=distance, correlation=correlation)


def _figures(
    parts: Sequence[UntouchedPart],
    measured: dict[str, NoiseFigures],
    detectors: dict[str, DetectorFigures],
) -> dict[str, Any]:
    """Figures of the report.

    Frames share the error of their background; it is gone in the difference of two frames.
    """
    single, between = measured["background"], measured["between"]
    gains = np.array([(part.gain_x, part.gain_y) for part in parts])
    return {
        "frames": len(parts),
        "drift_mm": single.flat_mm,
        "drift_length_mm": single.length_mm,
        "drift_length_with_tilt_mm": single.tilted_length_mm,
        "drift_between_mm": between.flat_mm,
        "drift_from_first_mm": measured["first"].flat_mm,
        "drift_with_tilt_mm": single.total_mm,
        "tilt": [single.tilt_x, single.tilt_y],
        "fine_mm": single.white_mm,
        "fine_between_mm": between.white_mm / np.sqrt(2),
        "gain_x": float(np.median(gains[:, 0])),
        "gain_y": float(np.median(gains[:, 1])),
        "gain_log_ratio_p10_p90": np.percentile(
            np.log(gains[:, 0] / gains[:, 1]), [10, 90]
        ).tolist(),
        "contact": asdict(detectors["between"]),
        "contact_without_reference": asdict(detectors["background"]),
        "by_kind": {kind: asdict(one) for kind, one in measured.items()},
    }


_KINDS = {
    "background": "frame less background",
    "between": "frame less the one before",
    "first": "frame less the first",
}


def _print(console: Console, figures: dict[str, Any]) -> None:
    table = number_table(
        f"Heights outside the contacts of {figures['frames']} frames, µm; medians over the frames",
        (
            "",
            "with tilt",
            "without",
            "10-90 %",
            "length mm",
            "with tilt mm",
            "tilt x, y µm/mm",
            "white",
        ),
    )
    for kind, words in _KINDS.items():
        row = figures["by_kind"][kind]
        low, high = row["flat_range_mm"]
        table.add_row(
            words,
            f"{1e3 * row['total_mm']:.1f}",
            f"{1e3 * row['flat_mm']:.1f}",
            f"{1e3 * low:.1f}-{1e3 * high:.1f}",
            f"{row['length_mm']:.1f}",
            f"{row['tilted_length_mm']:.1f}",
            f"{1e3 * row['tilt_x']:.1f}, {1e3 * row['tilt_y']:.1f}",
            f"{1e3 * row['white_mm']:.2f}",
        )
    console.print(table)
    bands = figures["by_kind"]["background"]["bands_mm"]
    table = number_table("Spectrum: µm by band of wavelengths in mm, with tilt", ("", *bands))
    for kind, words in _KINDS.items():
        values = figures["by_kind"][kind]["bands_mm"].values()
        table.add_row(words, *(f"{1e3 * value:.2f}" for value in values))
    console.print(table)
    low, high = figures["gain_log_ratio_p10_p90"]
    console.print(
        f"slopes under the balls over the balls' own: x {figures['gain_x']:.3f}, "
        f"y {figures['gain_y']:.3f}; ln of their ratio {low:+.3f} to {high:+.3f} (10-90 %)"
    )
    felt = figures["felt_outside"]
    console.print(
        f"felt with the contacts cut out: taken for a contact {felt['in_contact']:.0%}; by depth "
        f"{felt['by_depth_p95_n']:.2f} N (95 %); if each were a contact "
        f"{felt['if_contact_p50_n']:.2f} N in the median, {felt['if_contact_p95_n']:.2f} N (95 %)"
    )
    for key, words in (
        ("contact", "the noise between frames"),
        ("contact_without_reference", "the noise against the background"),
    ):
        detector = figures[key]
        missed = ", ".join(f"{f} N {rate:.1%}" for f, rate in detector["missed_by_force"].items())
        console.print(
            f"ideal detector of a berry with {words}: false alarm in "
            f"{detector['false_per_closing']:.1%} of simulated closings; missed (closed form): "
            f"{missed}"
        )
