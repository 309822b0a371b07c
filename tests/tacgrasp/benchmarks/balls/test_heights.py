"""Ball presses from a folder to a calibration, from the command line."""

import json
import re
from functools import partial

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.sensing.calibration import load_calibration
from cltp.sensing.touch_files import read_cloud
from cltp.tactile.sensors import SENSORS
from cltp.train.photometric import calibrate
from cltp.train.photometric.calibrate import train_gradients
from tacgrasp.__main__ import main
from tacgrasp.benchmarks.balls import heights as bench_balls
from tacgrasp.benchmarks.settings import BallsSettings
from tacgrasp.bringup.ball_frames import frames_heights, read_ball_frames
from tacgrasp.playback.describe import describe
from tests.paths import SHARED_DATA

SENSOR = SENSORS["gelsight_mini"]
BALLS = SHARED_DATA / "gelsight_mini_balls"


@pytest.fixture(scope="module")
def calibrated(folder, tmp_path_factory):
    out = tmp_path_factory.mktemp("out") / "mine.safetensors"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(calibrate, "train_gradients", partial(train_gradients, steps=80))
        assert main(
            ["calibrate", "gelsight-mini", "--balls", str(folder), "--diameter-mm", "6",
             "--out", str(out), "--unit", "mine", "--date", "2026-01-31"]
        ) == 0  # fmt: skip
    return out


def test_the_gel_follows_the_ball_and_rises_around_it(profiles):
    deep = profiles.height_mm[-1]
    depth = profiles.depths_mm[-1]
    r = profiles.r_mm
    # a bonded layer pressed by a ball: under the ball the sphere, to the grid's accuracy
    sphere = depth - 3.0 + np.sqrt(9.0 - r[:13] ** 2)
    np.testing.assert_allclose(deep[:13], sphere, atol=5e-3)
    assert -0.1 < deep.min() < -0.01


def test_the_calibration_records_what_it_was_made_from(calibrated):
    read = load_calibration(calibrated, SENSOR, unit="mine")
    assert (read.num_frames, read.ball_diameter_mm, read.date) == (12, 6.0, "2026-01-31")


def test_heights_of_a_folder_come_in_counting_order(folder, calibrated):
    heights = frames_heights(folder, calibration=calibrated)
    assert [name for name, _ in heights] == [f"ball_{i}" for i in range(12)]
    assert all(height.shape == (240, 320) and 0.4 < height.max() < 1.1 for _, height in heights)


def test_a_frame_is_described_as_deep_as_its_heights(folder, calibrated):
    name, height = frames_heights(folder, calibration=calibrated)[3]
    touch = read_cloud(
        folder / f"{name}.png",
        SENSOR,
        background=folder / "background.png",
        calibration=calibrated,
    )
    (line,) = (line for line in describe(touch) if line.startswith("depth"))
    depth_mm = float(re.search(r"\((\d\.\d+) mm\)", line)[1])
    assert depth_mm == pytest.approx(float(height.max()), abs=0.06)


def test_describe_asks_for_the_background_of_a_frame(folder, capsys):
    assert main(["describe", str(folder / "ball_3.png")]) == 2
    assert "--background" in capsys.readouterr().err


def test_the_benchmark_measures_presses_that_it_left_out(folder, tmp_path, capsys, monkeypatch):
    brief = partial(train_gradients, steps=100)
    monkeypatch.setattr(bench_balls, "train_gradients", brief)
    report = tmp_path / "balls.json"
    came_out = bench_balls.run(BallsSettings(data=folder, diameter_mm=6.0, folds=2, json=report))
    figures = json.loads(report.read_text())
    assert figures["diameter_error_percent"] == pytest.approx(0, abs=4)
    assert figures["profile_rmse_mm"] is None
    assert 0 < figures["drift_mm_p50"] < 0.05
    assert len(figures["per_press"]) == figures["fitted"] == 12
    assert came_out == (figures["reconstruction_ms_p50"] <= bench_balls.TIME_LIMIT_MS)
    assert "not measured" in capsys.readouterr().out


def test_a_profile_is_compared_as_it_is_and_scaled(tmp_path):
    row, column = np.mgrid[0:240, 0:320]
    r = np.hypot(column - 160, row - 120) * SENSOR.mm_per_px
    cap = np.maximum(np.sqrt(np.clip(9.0 - r**2, 0, None)) - 2.2, 0)
    held = [
        bench_balls.HeldOutPress(
            name="a", ball=bench_balls.fit_ball(cap, SENSOR.mm_per_px), height_mm=cap
        )
    ]
    file = tmp_path / "profile.csv"
    at = np.array([0.3, 0.7, 1.1, 1.5])
    known = np.sqrt(9.0 - at**2) - 2.2
    file.write_text(
        "# made\nr_mm,height_mm\n"
        + "".join(f"{a},{2 * k}\n" for a, k in zip(at, known, strict=True))
    )
    plain, scaled = bench_balls.profile_rmse(held, SENSOR, file)
    assert plain == pytest.approx(np.sqrt(np.mean(known**2)), rel=0.02)
    assert scaled < 0.01
    assert bench_balls.profile_rmse(held, SENSOR, tmp_path / "none.csv") is None


def test_folders_that_hold_no_presses_are_refused(folder, tmp_path):
    with pytest.raises(TouchError, match="is no folder"):
        read_ball_frames(tmp_path / "none", SENSOR)
    with pytest.raises(TouchError, match="no background"):
        read_ball_frames(tmp_path, SENSOR)
    with pytest.raises(TouchError, match="holds no frames"):
        read_ball_frames(tmp_path, SENSOR, background=folder / "background.png")


@pytest.mark.parametrize(
    ("argv", "message"),
    [
        (["calibrate"], "expects one of gelsight-mini"),
        (["calibrate", "gelsight-mini", "--balls", "x", "--diameter-mm", "0"], "1 to 100"),
        (["calibrate", "gelsight-mini", "--balls", "none", "--diameter-mm", "6"], "is no folder"),
        (
            ["calibrate", "gelsight-mini", "--balls", "x", "--diameter-mm", "6", "--out", "no/a"],
            "no is no folder",
        ),
        (
            ["calibrate", "gelsight-mini", "--balls", "x", "--diameter-mm", "6", "--date", "now"],
            "--date must be like",
        ),
        (["bench", "balls", "--data", "x", "--folds", "1"], "at least 2"),
        (["bench", "balls"], "--data"),
        (["bench", "balls", "--data", "none"], "is no folder"),
    ],
)
def test_wrong_use_is_one_clear_line(argv, message, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(argv) == 2
    assert message in capsys.readouterr().err


@pytest.mark.slow
@pytest.mark.skipif(not BALLS.is_dir(), reason=f"no real frames in {BALLS}")
def test_real_presses_left_out_are_measured_within_four_percent():
    balls = read_ball_frames(BALLS, SENSOR)
    held = bench_balls.measure_held_out(balls, SENSOR, 6.31, folds=4)
    diameters = [one.ball.diameter_mm for one in held if one.ball is not None]
    assert len(diameters) == 44
    assert np.median(diameters) == pytest.approx(6.31, rel=0.04)
