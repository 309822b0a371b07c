"""A calibration is learnt from ball presses, kept in a file, and read strictly."""

import dataclasses
import datetime
import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from safetensors.numpy import save_file

import cltp.sensing.calibration as calibration_module
from cltp.errors import TouchError
from cltp.sensing.ball_fit import fit_ball
from cltp.sensing.ball_presses import (
    BallPress,
    ProfileTable,
    SphericalCap,
    find_press,
    fit_press,
    slopes_of,
)
from cltp.sensing.calibration import (
    Calibration,
    default_calibration,
    load_calibration,
    save_calibration,
)
from cltp.sensing.frames import read_frame
from cltp.sensing.photometric import GradientNet, Photometer
from cltp.tactile.sensors import SENSORS
from cltp.train.photometric.calibrate import train_gradients
from tests.cltp.sensing.test_photometric import BACKGROUND, LINEAR
from tests.paths import SHARED_DATA

SENSOR = SENSORS["gelsight_mini"]
PX = SENSOR.mm_per_px
BALLS = SHARED_DATA / "gelsight_mini_balls"
ROW, COLUMN = np.mgrid[0 : SENSOR.rows, 0 : SENSOR.columns].astype(float)

# A law with three lamps 120° apart, of unequal strength: colours mix both slopes.
LAMPS = np.array([[80.0, 0.0], [-35.0, 60.0], [-45.0, -70.0]])


def skirted(r_mm, depth_mm, radius_mm=3.0):
    """A gel that follows the ball to 3/4 of its circle and leaves it with the same slope."""
    leaves = 0.75 * np.sqrt(depth_mm * (2 * radius_mm - depth_mm))
    root = np.sqrt(radius_mm**2 - np.minimum(r_mm, leaves) ** 2)
    ball = depth_mm - radius_mm + root
    edge = depth_mm - radius_mm + np.sqrt(radius_mm**2 - leaves**2)
    slope = leaves / np.sqrt(radius_mm**2 - leaves**2)
    return np.where(r_mm < leaves, ball, edge * np.exp(-(r_mm - leaves).clip(0) * slope / edge))


R_MM = np.linspace(0, 8, 161)
DEPTHS = np.linspace(0.2, 1.2, 11)
SKIRTS = ProfileTable(
    depths_mm=DEPTHS, r_mm=R_MM, height_mm=np.array([skirted(R_MM, d) for d in DEPTHS])
)


def photographed(press, shape=SKIRTS):
    slopes = slopes_of(press, shape, COLUMN.ravel(), ROW.ravel(), PX)
    change = (slopes @ LAMPS.T).reshape(*COLUMN.shape, 3)
    return (BACKGROUND + np.rint(change)).clip(0, 255).astype(np.uint8)


def presses(count=12, seed=0):
    rng = np.random.default_rng(seed)
    return [
        BallPress(
            column=rng.uniform(40, 280), row=rng.uniform(40, 200), depth_mm=rng.uniform(0.5, 1)
        )
        for _ in range(count)
    ]


def calibration(**changed):
    values = {
        "net": LINEAR, "sensor": "gelsight_mini", "unit": "a", "date": "2026-01-31",
        "ball_diameter_mm": 6.31, "num_frames": 44, "residual": 0.05, "seed": 0, "source": "test",
    }  # fmt: skip
    return Calibration(**{**values, **changed})


def test_the_slope_of_a_sphere_is_that_of_a_circle():
    # 3-4-5: on a sphere of radius 5, at r = 3, the slope is 3/4
    slope = SphericalCap(diameter_mm=10).inward_slope(np.array([0.0, 3.0]), depth_mm=4.0)
    np.testing.assert_allclose(slope, [0, 0.75])


def test_a_bare_sphere_knows_nothing_of_the_ring_around_the_contact():
    # circle of radius 4.9: the gel follows to 3.5, is flat from 8.3
    slope = SphericalCap(diameter_mm=10).inward_slope(np.array([3.4, 4.5, 8.0, 8.5]), depth_mm=4.0)
    np.testing.assert_array_equal(np.isnan(slope), [False, True, True, False])
    assert slope[3] == 0


def test_slopes_point_at_the_ball():
    press = BallPress(column=100, row=50, depth_mm=0.8)
    right_of, below = slopes_of(
        press, SphericalCap(diameter_mm=6), np.array([110.0, 100]), np.array([50.0, 60]), PX
    )
    assert right_of[0] < 0 == right_of[1]  # the surface falls away from the ball's centre
    assert below[1] < 0 == below[0]


def test_a_profile_table_interpolates_between_depths_and_is_flat_beyond():
    table = ProfileTable(
        depths_mm=np.array([0.0, 1.0]),
        r_mm=np.arange(5.0),
        height_mm=np.array([[0.0] * 5, [4.0, 3, 2, 1, 0]]),
    )
    np.testing.assert_allclose(table.inward_slope(np.array([2.0, 3.0, 9.0]), 0.5), [0.5, 0.5, 0])
    np.testing.assert_allclose(table.inward_slope(np.array([2.0]), 7.0), [1.0])
    np.testing.assert_allclose(table.height(np.array([1.5, 3.0, 9.0]), 0.5), [1.25, 0.5, 0])


@pytest.mark.parametrize(
    "press",
    [
        BallPress(column=150, row=120, depth_mm=0.8),
        BallPress(column=60, row=200, depth_mm=0.6),
        BallPress(column=8, row=100, depth_mm=0.9),  # cut by the edge
    ],
)
def test_a_press_is_found_and_then_fitted(press):
    frame = photographed(press)
    found = find_press(frame, BACKGROUND, SENSOR, 6.0)
    assert np.hypot(found.column - press.column, found.row - press.row) < 8

    slopes = slopes_of(press, SKIRTS, COLUMN.ravel(), ROW.ravel(), PX)
    right, down = slopes[:, 0].reshape(ROW.shape), slopes[:, 1].reshape(ROW.shape)
    fitted = fit_press(found, right, down, SKIRTS, mm_per_px=PX, max_depth_mm=1.2)
    assert (fitted.column, fitted.row) == pytest.approx((press.column, press.row), abs=0.2)
    assert fitted.depth_mm == pytest.approx(press.depth_mm, abs=0.02)


def test_nothing_and_what_is_not_round_are_no_ball():
    with pytest.raises(TouchError, match="no ball"):
        find_press(BACKGROUND, BACKGROUND, SENSOR, 6.0)
    bar = BACKGROUND.copy()
    bar[100:110, 40:280, 0] += 60
    with pytest.raises(TouchError, match=r"isn't round|no ball"):
        find_press(bar, BACKGROUND, SENSOR, 6.0)


def test_presses_calibrate_and_a_new_press_is_measured():
    trained = train_gradients(
        [photographed(press) for press in presses()],
        BACKGROUND, SENSOR, 6.0, profiles=SKIRTS, steps=200,
    )  # fmt: skip
    new = BallPress(column=170, row=110, depth_mm=0.7)
    height = Photometer(trained.net, BACKGROUND, SENSOR).heights(photographed(new))
    r = np.hypot(COLUMN - new.column, ROW - new.row) * PX
    truth = skirted(r, 0.7)
    assert np.sqrt(np.mean((height - truth + np.median(truth)) ** 2)) < 0.01
    assert height[110, 170] == pytest.approx(0.7, abs=0.02)
    assert not trained.rejected


def test_the_same_seed_calibrates_alike_and_another_does_not():
    frames = [photographed(press) for press in presses(5)]

    def net(seed):
        return train_gradients(
            frames, BACKGROUND, SENSOR, 6.0, seed=seed, steps=3
        ).net.w2  # fmt: skip

    np.testing.assert_array_equal(net(0), net(0))
    assert (net(0) != net(1)).any()


def test_frames_without_a_ball_are_left_out_and_named():
    frames = [photographed(press) for press in presses(5)]
    trained = train_gradients([*frames, BACKGROUND], BACKGROUND, SENSOR, 6.0, steps=2)
    assert list(trained.rejected) == [5]
    with pytest.raises(TouchError, match="a ball was found in 4 of 5 frames"):
        train_gradients([*frames[:4], BACKGROUND], BACKGROUND, SENSOR, 6.0)


def test_a_ball_of_no_size_is_refused():
    with pytest.raises(TouchError, match="1 to 100 mm"):
        train_gradients([BACKGROUND], BACKGROUND, SENSOR, float("nan"))


def test_a_calibration_is_read_as_it_was_written(tmp_path):
    file = tmp_path / "a.safetensors"
    save_calibration(file, calibration())
    read = load_calibration(file, SENSOR, unit="a")
    for field in dataclasses.fields(read):
        if field.name != "net":
            assert getattr(read, field.name) == getattr(calibration(), field.name)
    np.testing.assert_array_equal(read.net.b3, LINEAR.b3)
    assert read.age_days(datetime.date(2026, 2, 2)) == 2
    assert [path.name for path in tmp_path.iterdir()] == ["a.safetensors"]


def test_transposed_weights_are_kept_as_they_were_meant(tmp_path):
    # (regression) safetensors writes memory as it lies
    w1 = np.arange(10, dtype=np.float32).reshape(2, 5).T
    net = GradientNet(
        w1=w1, b1=np.zeros(2), w2=np.ones((2, 2)), b2=np.zeros(2), w3=np.ones((2, 6)), b3=np.ones(6)
    )
    save_calibration(tmp_path / "a.safetensors", calibration(net=net))
    read = load_calibration(tmp_path / "a.safetensors", SENSOR)
    np.testing.assert_array_equal(read.net.w1, w1)


def test_another_sensors_or_units_calibration_is_refused(tmp_path):
    file = tmp_path / "a.safetensors"
    save_calibration(file, calibration())
    with pytest.raises(TouchError, match="calibration of a gelsight_mini, expected digit"):
        load_calibration(file, SENSORS["digit"])
    with pytest.raises(TouchError, match="of unit 'a', expected 'b'"):
        load_calibration(file, SENSOR, unit="b")


def rewritten(tmp_path, change, drop=None):
    """A calibration whose record was changed by hand."""
    record = {"version": 2, **dataclasses.asdict(calibration())}
    arrays = {k: np.array(v) for k, v in record.pop("net").items() if k != drop}
    file = tmp_path / "b.safetensors"
    save_file(arrays, file, metadata={"tacgrasp_calibration": json.dumps(change(record))})
    return file


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda record: {**record, "version": 3}, "version 3, expected 2 or 1"),
        (lambda record: {**record, "extra": 1}, "expected fields"),
        (lambda record: {**record, "num_frames": "44"}, "num_frames must be int"),
        (lambda record: {**record, "num_frames": 0}, "num_frames must be >= 1"),
        (lambda record: {**record, "ball_diameter_mm": float("nan")}, "finite"),
        (lambda record: {**record, "date": "yesterday"}, "date must be like"),
        (lambda record: [record], "not a calibration"),
    ],
)
def test_a_record_that_was_changed_is_refused(tmp_path, change, message):
    file = rewritten(tmp_path, change)
    with pytest.raises(TouchError, match=message) as caught:
        load_calibration(file, SENSOR)
    assert str(file) in str(caught.value)


def test_a_file_from_before_the_light_grew_with_depth_is_read_without_that(tmp_path):
    older = rewritten(tmp_path, lambda record: {**record, "version": 1}, drop="brightening")
    assert load_calibration(older, SENSOR).net.brightening.tolist() == [0.0]
    with pytest.raises(TouchError, match="expected arrays"):
        load_calibration(rewritten(tmp_path, lambda record: {**record, "version": 1}), SENSOR)


def test_a_missing_array_or_a_damaged_file_is_refused(tmp_path):
    with pytest.raises(TouchError, match="expected arrays"):
        load_calibration(rewritten(tmp_path, lambda record: record, drop="w2"), SENSOR)
    file = tmp_path / "a.safetensors"
    save_calibration(file, calibration())
    file.write_bytes(file.read_bytes()[:-5])
    with pytest.raises(TouchError, match="damaged"):
        load_calibration(file, SENSOR)
    with pytest.raises(TouchError, match="does not exist"):
        load_calibration(tmp_path / "none.safetensors", SENSOR)


def test_the_calibration_that_ships_names_its_source_and_is_small():
    path = default_calibration(SENSOR)
    assert path.stat().st_size < 100_000
    shipped = load_calibration(path, SENSOR)
    assert "gelslam" in shipped.source
    assert shipped.num_frames == 44
    with pytest.raises(TouchError, match="no calibration ships for digit"):
        default_calibration(SENSORS["digit"])


@pytest.mark.skipif(not BALLS.is_dir(), reason=f"no real frames in {BALLS}")
def test_real_presses_come_out_positive_and_as_large_as_the_ball():
    # trained on these frames; how good it is on others is measured by the benchmark
    net = load_calibration(default_calibration(SENSOR), SENSOR).net
    photometer = Photometer(net, read_frame(BALLS / "background.png", SENSOR), SENSOR)
    balls = [
        fit_ball(photometer.heights(read_frame(BALLS / f"ball_6.31mm_{i}.png", SENSOR)), PX)
        for i in range(8, 32, 2)
    ]
    assert np.median([ball.diameter_mm for ball in balls]) == pytest.approx(6.31, rel=0.04)
    assert all(0.4 < ball.depth_mm < 1.3 for ball in balls)


def test_a_damaged_shipped_calibration_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shipped = default_calibration(SENSORS["gelsight_mini"])
    shutil.copytree(shipped.parent, tmp_path / "calibrations")
    monkeypatch.setattr(calibration_module, "__file__", str(tmp_path / "calibration.py"))
    copy = default_calibration(SENSORS["gelsight_mini"])
    assert copy.parent == tmp_path / "calibrations"
    data = bytearray(copy.read_bytes())
    data[len(data) // 2] ^= 1
    copy.write_bytes(data)
    with pytest.raises(TouchError, match="is not the file that shipped"):
        default_calibration(SENSORS["gelsight_mini"])
