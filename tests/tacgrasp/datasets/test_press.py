"""One press from the command line to a file."""

import numpy as np
import pytest

from cltp.sensing.touch_files import read_cloud
from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.sensors import SENSORS, sensor_named
from tacgrasp.__main__ import main
from tacgrasp.datasets.requests import PressRequest

MINI = SENSORS["gelsight_mini"]
BALL = ["simulate", "press", "--object", "ball:9.5", "--depth-mm", "0.8"]


@pytest.fixture(scope="module")
def pressed(tmp_path_factory):
    file = tmp_path_factory.mktemp("press") / "ball.npz"
    assert main([*BALL, "--sensor", "gelsight_mini", "--noise", "none", "--out", str(file)]) == 0
    with np.load(file, allow_pickle=False) as data:
        return dict(data)


def test_the_file_holds_the_whole_field_at_the_sensor_s_resolution(pressed):
    assert pressed["height_mm"].shape == pressed["pressure_kpa"].shape == (240, 320)
    assert pressed["mm_per_px"] == pytest.approx(0.0634)
    assert pressed["force_n"].shape == ()
    assert pressed["cloud_mm"].shape == (1024, 3)
    assert "seen_mm" not in pressed


def test_under_the_ball_the_surface_is_the_ball_s_and_beside_it_the_gel_rises(pressed):
    x, y = np.meshgrid(*grid_axes_mm(MINI, 240, 320))
    r = np.hypot(x, y)
    ball = 0.8 - 4.75 + np.sqrt(np.clip(4.75**2 - r**2, 0, None))
    near = r < 1.5
    np.testing.assert_allclose(pressed["height_mm"][near], ball[near], atol=1e-5)
    assert pressed["height_mm"].min() < -0.02


def test_force_is_the_integral_of_pressure(pressed):
    force = pressed["pressure_kpa"].sum(dtype=np.float64) * 1e-3 * 0.0634**2
    assert pressed["force_n"] == pytest.approx(force, rel=1e-5)
    assert 2.2 < pressed["force_n"] < 2.8


def test_what_is_felt_is_printed(capsys):
    assert main([*BALL, "--grid", "160x120"]) == 0
    said = capsys.readouterr().out
    assert "160x120" in said
    assert "a smooth sphere object, pressed deep in centered" in said
    assert " N\n" in said
    assert "kPa" in said


def test_the_top_is_row_zero_and_x_grows_with_the_columns(tmp_path):
    file = tmp_path / "a.npz"
    assert main([*BALL, "--x-mm", "5", "--y-mm", "3", "--grid", "80x60", "--out", str(file)]) == 0
    with np.load(file) as data:
        row, column = np.unravel_index(data["height_mm"].argmax(), (60, 80))
    x, y = grid_axes_mm(MINI, 60, 80)
    assert (x[column], y[row]) == (pytest.approx(5, abs=0.2), pytest.approx(3, abs=0.2))


def test_a_turned_rod_lies_across(tmp_path):
    files = [tmp_path / f"{turn}.npz" for turn in (0, 90)]
    for turn, file in zip((0, 90), files, strict=True):
        assert main(
            ["simulate", "press", "--object", "cylinder:6", "--depth-mm", "0.3",
             "--turn-deg", str(turn), "--grid", "80x60", "--out", str(file)]
        ) == 0  # fmt: skip
    touching = [np.load(file)["pressure_kpa"] > 0 for file in files]
    assert touching[0].any(axis=0).all()
    assert touching[1].any(axis=1).all()
    assert not touching[1].any(axis=0).all()


def test_noise_is_seen_beside_the_truth_and_follows_the_seed(tmp_path):
    seen = []
    for seed in (1, 1, 2):
        file = tmp_path / "noisy.npz"
        flags = ["--noise", "uncalibrated", "--seed", str(seed), "--grid", "80x60"]
        assert main([*BALL, *flags, "--out", str(file)]) == 0
        with np.load(file) as data:
            assert data["height_mm"].max() == pytest.approx(0.8, abs=0.01)
            seen.append(data["seen_mm"])
    np.testing.assert_array_equal(seen[0], seen[1])
    assert np.abs(seen[0] - seen[2]).max() > 0.01


def test_a_gelstereo_reports_its_markers(tmp_path):
    file = tmp_path / "stereo.npz"
    flags = ["--sensor", "gelstereo", "--noise", "unit", "--grid", "80x80"]
    assert main([*BALL, *flags, "--out", str(file)]) == 0
    with np.load(file) as data:
        assert data["height_mm"].shape == (80, 80)
        assert 480 < len(data["cloud_mm"]) < 529
        assert "seen_mm" not in data
        reported = data["points_mm"]
    read = read_cloud(file, sensor_named("gelstereo"))  # what it reports, not the true heights
    np.testing.assert_array_equal(read.points_mm, reported)


def test_an_object_of_the_catalogue_is_laid_as_the_seed_draws(tmp_path, capsys):
    heights = []
    for seed in (3, 3, 4):
        file = tmp_path / "mug.npz"
        flags = ["--object", "golf_ball", "--depth-mm", "0.5", "--seed", str(seed)]
        assert main(
            ["simulate", "press", *flags, "--grid", "80x60", "--out", str(file)]
        ) == 0  # fmt: skip
        with np.load(file) as data:
            heights.append(data["height_mm"])
    np.testing.assert_array_equal(heights[0], heights[1])
    assert np.abs(heights[0] - heights[2]).max() > 0.05
    assert heights[0].max() == pytest.approx(0.5, abs=0.02)
    assert "object, pressed moderate" in capsys.readouterr().out


@pytest.mark.filterwarnings("error")
def test_beside_a_peg_there_is_nothing_to_stumble_over(tmp_path):
    flags = ["--object", "peg_round_4", "--depth-mm", "0.5", "--seed", "2", "--grid", "160x120"]
    assert main(["simulate", "press", *flags]) == 0


def test_a_press_that_few_pixels_feel_is_called_rough(capsys):
    for size, rough in (("0.4", True), ("9.5", False)):
        flags = ["--object", f"ball:{size}", "--depth-mm", "0.1", "--grid", "160x120"]
        assert main(["simulate", "press", *flags]) == 0
        assert ("force and area are rough" in capsys.readouterr().out) == rough


@pytest.mark.parametrize(
    ("flags", "message"),
    [
        (["--depth-mm", "3.7"], "3.4 mm gel"),
        (["--depth-mm", "0"], "above 0"),
        (["--depth-mm", "nan"], "above 0"),
        (["--turn-deg", "inf"], "finite"),
        (["--x-mm", "40"], "no part of it is over the sensing area"),
        (["--x-mm", "13", "--depth-mm", "0.5"], "behind the tip"),
        (["--object", "spaceship"], "mug"),
        (["--object", "ball:"], "ball:DIAMETER"),
        (["--object", "cone:3"], "unknown probe 'cone'"),
        (["--sensor", "gelsite"], "gelsight_mini"),
        (["--noise", "much"], "uncalibrated"),
        (["--grid", "wide"], "320x240"),
        (["--grid", "8x6"], "24 to 1280"),
        (["--grid", "240x240"], "proportions"),
        (["--device", "abacus"], "cpu always can"),
        (["--out", "no/such/folder/a.npz"], "is not a folder"),
        (["--seed", "-1"], "negative"),
    ],
)
def test_wrong_use_is_one_clear_line(flags, message, capsys):
    assert main([*BALL, *flags]) == 2
    said = capsys.readouterr().err
    assert message in said
    assert said.count("\n") == 1


def test_a_file_that_can_t_be_written_leaves_nothing_behind(tmp_path, capsys):
    folder = tmp_path / "a.npz"
    folder.mkdir()
    assert main([*BALL, "--grid", "80x60", "--out", str(folder)]) == 2
    printed = capsys.readouterr()
    assert "can't be written" in printed.err
    assert printed.out == ""  # it is told before the press is computed
    assert [path.name for path in tmp_path.iterdir()] == ["a.npz"]


def test_an_earlier_press_is_replaced_and_a_measured_map_kept(tmp_path, capsys):
    made, measured = tmp_path / "a.npz", tmp_path / "mine.npz"
    for _ in range(2):
        assert main([*BALL, "--grid", "80x60", "--out", str(made)]) == 0
    np.savez(measured, height_mm=np.zeros((60, 80)))
    before = measured.read_bytes()
    assert main([*BALL, "--grid", "80x60", "--out", str(measured)]) == 2
    assert "is no earlier press, so it is not replaced" in capsys.readouterr().err
    assert measured.read_bytes() == before


def test_the_help_names_every_sensor():
    assert all(name in PressRequest.__doc__ for name in SENSORS)
