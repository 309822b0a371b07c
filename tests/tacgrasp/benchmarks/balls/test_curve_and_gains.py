"""How many presses a calibration needs, and the gains of another unit's, from the command line."""

import json
from functools import partial

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.sensing.ball_gains import Gains, corrected
from cltp.sensing.calibration import load_calibration, save_calibration
from cltp.tactile.sensors import SENSORS
from cltp.train.photometric.calibrate import train_gradients
from tacgrasp.__main__ import main
from tacgrasp.benchmarks.balls import curve, gains
from tacgrasp.benchmarks.balls.curve import NO_BALL_PERCENT, Subset, curve_point, draw
from tacgrasp.benchmarks.settings import BallCurveSettings, BallGainsSettings
from tacgrasp.bringup.ball_frames import read_ball_frames
from tacgrasp.bringup.ball_spread import spread_presses

SENSOR = SENSORS["gelsight_mini"]
BRIEF = partial(train_gradients, steps=60)


def test_the_figures_of_a_point_are_those_of_all_its_subsets_together():
    subsets = [
        Subset(presses=8, errors_percent=(1.0, -2.0, 9.0), inside=(True, True, False)),
        Subset(presses=8, errors_percent=(-4.0, NO_BALL_PERCENT), inside=(True, False)),
    ]
    point = curve_point(subsets)
    assert (point.presses, point.subsets, point.held_out) == (8, 2, 5)
    assert point.median_error_percent == 4.0
    assert point.by_subset_percent == (2.0, 52.0)
    assert point.inside_error_percent == 2.0
    assert point.diameter_error_percent == 1.0
    figure = draw([point], 6.31)
    assert [line.get_ydata()[0] for line in figure.axes[0].lines[:2]] == [2.0, 4.0]


def test_a_job_calibrates_on_its_subset_and_measures_the_others(folder, monkeypatch):
    monkeypatch.setattr(curve, "train_gradients", BRIEF)
    settings = BallCurveSettings(data=folder, diameter_mm=6.0)
    subset = curve._measure(settings, [(9, 0), (9, 1)], 1)
    assert subset.presses == 9
    assert len(subset.errors_percent) == len(subset.inside) == 3
    assert subset.median_error_percent < 20
    assert all(subset.inside)  # all of them lie 60 px from the border


@pytest.mark.parametrize("count", ["4", "12"])
def test_a_number_of_presses_that_leaves_none_is_refused(count, folder, capsys):
    assert main(["bench", "ball-curve", "--data", str(folder), "--presses", "8", count]) == 2
    assert f"got {count}" in capsys.readouterr().err


def test_artificial_gains_are_found_in_held_out_presses(folder, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(curve, "train_gradients", partial(train_gradients, steps=200))
    report = tmp_path / "gains.json"
    settings = BallGainsSettings(
        data=folder, diameter_mm=6.0, presses=(3, 5), subsets=8, json=report
    )
    assert gains.run(settings)
    rows = json.loads(report.read_text())["rows"]
    assert len(rows) == 2 * len(gains.GAINS)
    for row in rows:
        assert row["ratio"] == pytest.approx(row["x"] / row["y"], rel=0.05)
        if row["x"] / row["y"] in (1.25, 0.8):
            assert row["flagged"] == 1
            before, after = (row[f"diameter_error_{when}_percent"] for when in ("before", "after"))
            assert after < before
    assert "said to be off" in capsys.readouterr().out


def test_presses_are_spread_and_the_others_kept_apart(folder):
    balls = read_ball_frames(folder, SENSOR)
    chosen, others = spread_presses(balls, SENSOR, 6.0, 5)
    assert len(chosen.frames) == 5
    assert sorted(chosen.names + others.names) == sorted(balls.names)
    with pytest.raises(TouchError, match="must be 1 to 11"):
        spread_presses(balls, SENSOR, 6.0, 12)


@pytest.mark.parametrize("choice", [[], ["--presses", "0"], ["--presses", "3"]])
def test_frames_without_a_ball_are_told_alike_with_and_without_a_choice(
    choice, folder, tmp_path, capsys
):
    empty = tmp_path / "empty"
    empty.mkdir()
    for name in ("background", *(f"{number:02d}" for number in range(6))):
        (empty / f"{name}.png").write_bytes((folder / "background.png").read_bytes())
    argv = ["calibrate", "gelsight-mini", "--balls", str(empty), "--diameter-mm", "6", *choice]
    assert main([*argv, "--out", str(tmp_path / "c.safetensors")]) == 2
    assert "a ball was found in 0 of 6 frames, expected at least 5" in capsys.readouterr().err


@pytest.fixture(scope="module")
def other_units(folder, tmp_path_factory):
    """A calibration of these presses that reads x a quarter too steep."""
    file = tmp_path_factory.mktemp("other") / "other.safetensors"
    argv = ["--balls", folder, "--diameter-mm", 6, "--unit", "other", "--out", file]
    assert main(["calibrate", "gelsight-mini", *map(str, argv), "--presses", "9"]) == 0
    made = load_calibration(file, SENSOR)
    off = Gains(x=0.8, y=1.0, error_x=0, error_y=0, misfit=0, presses=(), rejected={})
    changed = {name: getattr(made, name) for name in made.__slots__} | {
        "net": corrected(made.net, off)
    }
    save_calibration(file, type(made)(**changed))
    return file


@pytest.mark.slow
def test_some_presses_calibrate_and_the_others_are_measured(folder, tmp_path, capsys):
    argv = ["calibrate", "gelsight-mini", "--balls", str(folder), "--diameter-mm", "6"]
    argv += ["--out", str(tmp_path / "c.safetensors"), "--presses"]
    assert main([*argv, "8"]) == 0
    assert main([*argv, "8"]) == 2  # what took 20 presses is not written over
    out, err = capsys.readouterr()
    assert "frames    8 of 8" in out
    assert "held out  4 presses: diameter" in out
    assert "give --overwrite" in err
    assert main([*argv, "12", "--overwrite"]) != 0
    assert "--presses must be 1 to 11" in capsys.readouterr().err


@pytest.mark.slow
def test_another_units_gains_are_found_printed_and_taken_out(folder, other_units, tmp_path, capsys):
    out = tmp_path / "mine.safetensors"
    argv = ["calibrate", "gains", "--balls", str(folder), "--diameter-mm", "6"]
    argv += ["--out", str(out), "--unit", "mine", "--calibration"]
    assert main([*argv, str(other_units)]) == 0
    assert "differ from 1" in capsys.readouterr().out
    mine, before = (load_calibration(path, SENSOR) for path in (out, other_units))
    assert (mine.unit, before.unit) == ("mine", "other")
    factor = np.median(mine.net.b3[:3] / before.net.b3[:3])
    assert 1 / factor == pytest.approx(1.25, rel=0.05)
    assert main([*argv[:-1], "--calibration", str(out), "--overwrite"]) == 0
    printed = capsys.readouterr().out
    assert "no different from 1" in printed
    assert "mine, as it was" in printed
    np.testing.assert_array_equal(load_calibration(out, SENSOR).net.b3, mine.net.b3)
