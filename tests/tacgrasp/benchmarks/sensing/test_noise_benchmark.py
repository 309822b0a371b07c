"""Noise of known spectrum is measured as it is, and real frames are measured where untouched."""

import json

import numpy as np
import pytest

from cltp.tactile.sensor_noise import smooth_field
from cltp.tactile.sensors import SENSORS
from tacgrasp.__main__ import main
from tacgrasp.benchmarks.sensing import ideal_detector
from tacgrasp.benchmarks.sensing.ideal_detector import FORCES_N, berry_heights_mm, detect
from tacgrasp.benchmarks.sensing.noise_spectrum import (
    RadialSpectrum,
    autocorrelation,
    length_mm,
    radial_spectrum,
    white_mm,
)
from tacgrasp.benchmarks.sensing.untouched_parts import without_plane
from tests.paths import SHARED_DATA

MINI = SENSORS["gelsight_mini"]
SHAPE = (240, 320)
ROW, COLUMN = np.mgrid[0:240, 0:320]
BALLS = SHARED_DATA / "gelsight_mini_balls"


def outside_a_ball(column=150, row=110, radius_px=70):
    return np.hypot(COLUMN - column, ROW - row) > radius_px


@pytest.fixture(scope="module")
def fields():
    """Errors of 0.01 mm over 2 mm on 60 frames, with a ball of 5 mm where nothing is known."""
    rng = np.random.default_rng(0)
    known = outside_a_ball()
    drawn = [0.01 * smooth_field(SHAPE, MINI, 2.0, rng).astype(np.float64) for _ in range(60)]
    return [(np.where(known, field, 5.0), known) for field in drawn]


def test_the_length_of_a_drift_is_measured_around_a_contact(fields):
    distance, correlation = autocorrelation(fields, MINI.mm_per_px)
    assert length_mm(distance, correlation) == pytest.approx(2.0, abs=0.15)
    assert correlation[0] == pytest.approx(1.0, abs=0.02)


def test_the_spectrum_holds_the_variance_and_the_length_of_a_drift(fields):
    spectrum = radial_spectrum(fields, MINI.mm_per_px)
    assert spectrum.band_mm(20.0, 0.127) == pytest.approx(0.01, rel=0.08)
    # a correlation exp(-r²/L²) leaves exp(-(pi L / a)²) - exp(-(pi L / b)²) between a and b
    part = np.exp(-((np.pi * 2.0 / 8) ** 2)) - np.exp(-((np.pi * 2.0 / 4) ** 2))
    assert spectrum.band_mm(8.0, 4.0) == pytest.approx(0.01 * np.sqrt(part), rel=0.1)


def test_the_white_part_is_found_beside_what_is_smooth(fields):
    rng = np.random.default_rng(1)
    field, known = fields[0]
    assert white_mm(field + 0.001 * rng.standard_normal(SHAPE), known) == pytest.approx(
        0.001, rel=0.03
    )


def test_a_plane_is_taken_from_the_known_part_alone():
    known = outside_a_ball()
    tilted = np.where(known, 0.002 * COLUMN - 0.001 * ROW + 0.3, 7.0)
    flat, slopes = without_plane(tilted, known)
    np.testing.assert_allclose(flat[known], 0, atol=1e-9)
    np.testing.assert_allclose(slopes, [0.002, -0.001], atol=1e-12)


def test_an_ideal_detector_in_white_noise_reaches_the_norm_of_the_heights(monkeypatch):
    monkeypatch.setattr(ideal_detector, "CLOSINGS", 40)
    monkeypatch.setattr(ideal_detector, "TAIL", 8)
    pitch = MINI.width_mm / ideal_detector.COLUMNS
    sigma_mm = 0.05
    white = RadialSpectrum(per_mm=np.array([1e-3, 10.0]), power=np.full(2, sigma_mm**2 * pitch**2))
    figures = detect(white, MINI, np.random.default_rng(0))
    heights = berry_heights_mm(MINI)
    heights -= heights.mean(axis=(1, 2), keepdims=True)
    for force, one in zip(FORCES_N, heights, strict=True):
        expected = np.linalg.norm(one) / sigma_mm
        assert figures.d_prime_by_force[f"{force:g}"] == pytest.approx(expected, rel=1e-3)
    missed = list(figures.missed_by_force.values())
    assert missed == sorted(missed, reverse=True)
    assert missed[0] > 0.9


@pytest.mark.parametrize(
    ("argv", "message"),
    [
        (["bench", "noise"], "--data"),
        (["bench", "noise", "--data", "none"], "is no folder"),
        (["bench", "noise", "--data", "none", "--diameter-mm", "0"], "1 to 100"),
        (["bench", "noise", "--data", "none", "--plot", "no/a.png"], "no/a.png"),
    ],
)
def test_wrong_use_is_one_clear_line(argv, message, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(argv) == 2
    assert message in capsys.readouterr().err


@pytest.mark.slow
@pytest.mark.skipif(not BALLS.is_dir(), reason=f"no real frames in {BALLS}")
def test_real_frames_are_flat_outside_their_contacts(tmp_path):
    report, plot = tmp_path / "noise.json", tmp_path / "noise.png"
    assert main(
        ["bench", "noise", "--data", str(BALLS), "--json", str(report), "--plot", str(plot)]
    ) == 0  # fmt: skip
    figures = json.loads(report.read_text())
    assert 0.003 < figures["drift_mm"] < 0.012
    assert figures["drift_between_mm"] < figures["drift_from_first_mm"] < figures["drift_mm"]
    assert figures["fine_mm"] < 0.001
    assert 0.9 < figures["gain_x"] < 1.1
    assert 0.9 < figures["gain_y"] < 1.1
    assert set(figures["contact"]) >= {"false_per_closing", "missed_by_force"}
    assert plot.read_bytes().startswith(b"\x89PNG")
