"""Taking a background from the command line."""

import datetime

import numpy as np
import pytest
from PIL import Image

from cltp.tactile.sensors import SENSORS
from tacgrasp.__main__ import main
from tacgrasp.drivers.gelsight.background import load_background


@pytest.fixture
def images(tmp_path):
    folder = tmp_path / "images"
    folder.mkdir()
    for number, level in enumerate((99, 101, 99, 101)):
        Image.new("RGB", (320, 240), (level, level, level)).save(folder / f"{number}.png")
    return folder


def calibrate(*flags):
    return main(["calibrate", "background", *map(str, flags)])


def test_frames_are_averaged_into_a_dated_background(images, tmp_path, capsys):
    out = tmp_path / "background.png"
    assert calibrate("--images", images, "--unit", "mine", "--frames", 4, "--out", out) == 0
    assert "4 frames of unit mine" in capsys.readouterr().out
    now = datetime.datetime.now(datetime.UTC)
    read = load_background(
        out, SENSORS["gelsight_mini"], unit="mine", max_age_h=1, now=now, dated=True
    )
    assert np.unique(read.frame).tolist() == [100]


def test_what_can_not_be_taken_is_one_line(images, tmp_path, capsys):
    out = tmp_path / "background.png"
    for flags, message in [
        (("--images", images, "--frames", 5), "has ended after 4"),
        (("--images", images, "--frames", 1), "--frames must be 2"),
        (("--device", tmp_path / "camera"), "no camera"),
        ((), "give one of --device and --images"),
        (("--images", images, "--device", "0"), "give one of --device and --images"),
        (("--images", images, "--crop-share", "0.7"), "crop_share"),
    ]:
        assert calibrate("--unit", "mine", "--out", out, *flags) != 0
        error = capsys.readouterr().err
        assert message in error and len(error.splitlines()) == 1
    assert not out.exists()
    assert calibrate("--unit", "mine", "--images", images, "--out", tmp_path / "x.jpg") == 2


def test_an_earlier_background_is_replaced_and_another_picture_kept(images, tmp_path, capsys):
    out = tmp_path / "background.png"
    flags = ("--images", images, "--unit", "mine", "--frames", 4, "--out", out)
    assert calibrate(*flags) == 0
    assert calibrate(*flags) == 0
    Image.new("RGB", (9, 9)).save(out)
    mine = out.read_bytes()
    assert calibrate(*flags) == 2
    assert "exists and is kept; give --overwrite" in capsys.readouterr().err
    assert out.read_bytes() == mine
    assert calibrate(*flags, "--overwrite") == 0


def test_over_exposed_images_make_no_background(tmp_path, capsys):
    for number in range(2):
        Image.new("RGB", (320, 240), (255, 255, 255)).save(tmp_path / f"{number}.png")
    out = tmp_path / "made" / "background.png"
    out.parent.mkdir()
    flags = ("--images", tmp_path, "--unit", "mine", "--frames", 2, "--out", out)
    assert calibrate(*flags) != 0
    assert "over-exposed" in capsys.readouterr().err
    assert not out.exists()
