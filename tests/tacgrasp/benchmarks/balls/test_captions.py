"""What a model says of ball presses, from frames to figures."""

import json

import numpy as np
import pytest
from PIL import Image

from cltp.sensing.calibration import Calibration, save_calibration
from cltp.sensing.photometric import COLOUR_SCALE, GradientNet
from cltp.tactile.sensors import SENSORS
from cltp.tactile.states import Depth, Shape
from tacgrasp.__main__ import main
from tacgrasp.benchmarks.balls.answers import BallReading
from tacgrasp.benchmarks.balls.captions import depth_order, figures_of
from tests.fakes.tiny_weights import make_weights

SENSOR = SENSORS["gelsight_mini"]
BALL_MM = 6.31 / 2
LAMPS = np.array([[80.0, 0.0], [-35.0, 60.0], [-45.0, -70.0]])


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Four presses of the bare sphere, seen under three lamps, and a frame without any."""
    path = tmp_path_factory.mktemp("balls")
    background = np.full((240, 320, 3), 120, dtype=np.uint8)
    row, column = np.mgrid[0:240, 0:320]
    for index, depth_mm in enumerate((0.4, 0.6, 0.8, 1.0)):
        x, down = (column - 110 - 30 * index) * SENSOR.mm_per_px, (row - 110) * SENSOR.mm_per_px
        root = np.sqrt(np.clip(BALL_MM**2 - x**2 - down**2, 1e-3, None))
        touched = root > BALL_MM - depth_mm
        slopes = -np.stack([x, down], axis=-1) / root[..., None] * touched[..., None]
        frame = (background + np.rint(slopes @ LAMPS.T)).clip(0, 255).astype(np.uint8)
        Image.fromarray(frame).save(path / f"ball_{index}.png")
    Image.fromarray(background).save(path / "background.png")
    Image.fromarray(background).save(path / "untouched.png")
    return path


@pytest.fixture(scope="module")
def calibration(tmp_path_factory):
    """Of these lamps, exactly: what turns a change of colour back into slopes, everywhere."""
    back = COLOUR_SCALE * np.linalg.pinv(LAMPS)
    net = GradientNet(
        w1=np.zeros((5, 1)), b1=np.zeros(1), w2=np.zeros((1, 1)), b2=np.zeros(1),
        w3=np.zeros((1, 6)), b3=back.ravel(),
    )  # fmt: skip
    path = tmp_path_factory.mktemp("calibration") / "lamps.safetensors"
    known = {"unit": "lamps", "date": "2026-01-31", "source": "test", "sensor": SENSOR.name}
    save_calibration(
        path,
        Calibration(net=net, ball_diameter_mm=6.31, num_frames=1, residual=0.0, seed=0, **known),
    )
    return path


def reading(depth_mm, **changed):
    known = {
        "name": "ball", "depth_mm": depth_mm, "fitted_mm": depth_mm, "x_mm": 0.0, "y_mm": 0.0,
        "measured_mm": depth_mm, "position_error_mm": 0.1, "text": "", "shape": Shape.SPHERE,
        "depth": Depth.DEEP, "caption_mm": None, "heads_shape": Shape.ELLIPSOID,
        "heads_mm": -depth_mm,
    }  # fmt: skip
    return BallReading(**(known | changed))


def test_every_press_is_measured_named_and_counted(folder, calibration, tmp_path, capsys):
    report = tmp_path / "captions.json"
    weights = make_weights(tmp_path / "weights")
    assert main(
        ["bench", "ball-captions", "--data", str(folder), "--weights", str(weights),
         "--calibration", str(calibration), "--json", str(report)]
    ) == 0  # fmt: skip
    figures = json.loads(report.read_text())
    assert figures["presses"] == 4 == len(figures["per_press"])
    assert list(figures["left_out"]) == ["untouched"]
    assert sum(figures["shapes"]["heads"].values()) == 4
    # geometry and heights have nothing in common but the frame, and agree on the order
    assert figures["depth_order"]["measured, mm"]["spearman"] == pytest.approx(1)
    assert figures["depth_order"]["slopes, mm"]["spearman"] == pytest.approx(1)
    depths = [press["depth_mm"] for press in figures["per_press"]]
    np.testing.assert_allclose(depths, [0.4, 0.6, 0.8, 1.0], atol=0.1)
    assert figures["position_off_mm_p50"] < 0.5
    assert "Shape of the ball" in capsys.readouterr().out


def test_folds_and_a_calibration_exclude_each_other(capsys):
    assert (
        main(["bench", "ball-captions", "--data", "x", "--folds", "3", "--calibration", "x"]) == 2
    )
    assert "give either" in capsys.readouterr().err
    assert main(["bench", "ball-captions", "--data", "x", "--folds", "1"]) == 2


def test_shares_and_orders_are_those_of_the_presses():
    figures = figures_of(
        [
            reading(0.5, depth=Depth.MODERATE, caption_mm=0.4),
            reading(0.7, shape=None, depth=None),
            reading(0.9, shape=Shape.PEAK, depth=Depth.VERY_DEEP, caption_mm=0.3),
            reading(1.0, shape=Shape.ELLIPSOID, depth=Depth.VERY_DEEP, position_error_mm=None),
        ]
    )
    assert figures["sphere"] == {"caption": 0.25, "heads": 0.0}
    assert figures["sphere_or_ellipsoid"] == {"caption": 0.5, "heads": 1.0}
    assert figures["shapes"]["caption"] == {"sphere": 1, "no caption": 1, "peak": 1, "ellipsoid": 1}
    orders = figures["depth_order"]
    assert orders["measured, mm"]["spearman"] == pytest.approx(1)
    assert orders["heads, mm"] == {
        "spearman": pytest.approx(-1), "kendall": pytest.approx(-1), "concordant": 0.0,
        "tied": 0.0, "presses": 4,
    }  # fmt: skip
    classes = orders["caption, class"]
    assert (classes["presses"], classes["tied"]) == (3, pytest.approx(1 / 3))
    assert classes["concordant"] == pytest.approx(2 / 3)
    assert orders["caption, mm"]["concordant"] == 0.0 and figures["seen_as_contact"] == 3


def test_an_order_of_equals_or_of_one_is_none():
    equal = depth_order([0.1, 0.2, 0.3], [1.0, 1.0, 1.0])
    assert np.isnan(equal.spearman) and equal.tied == 1.0
    assert depth_order([0.1, 0.2], [1.0, None]).presses == 1
