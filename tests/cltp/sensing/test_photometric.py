"""Colours to heights: exact integrals, a known law of colour, and frames that must be refused."""

import dataclasses

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.sensing.ball_fit import fit_ball
from cltp.sensing.frames import check_frame, read_frame
from cltp.sensing.photometric import (
    COLOUR_SCALE,
    GradientNet,
    Photometer,
    integrate,
    integrate_differences,
)
from cltp.sensing.touch_files import read_cloud
from cltp.tactile.cloud import cloud_from_heights
from cltp.tactile.sensors import SENSORS

SENSOR = SENSORS["gelsight_mini"]
PX = SENSOR.mm_per_px
ROW, COLUMN = np.mgrid[0 : SENSOR.rows, 0 : SENSOR.columns].astype(float)

# A known law: red shows the slope to the right, blue the slope downwards, 100 levels for 45°.
LEVELS = 100.0
LINEAR = GradientNet(
    w1=np.zeros((5, 1)),
    b1=np.zeros(1),
    w2=np.zeros((1, 1)),
    b2=np.zeros(1),
    w3=np.zeros((1, 6)),
    b3=np.array([1, 0, 0, 0, 0, 1]) * COLOUR_SCALE / LEVELS,
)
BACKGROUND = np.full((SENSOR.rows, SENSOR.columns, 3), 120, dtype=np.uint8)


def random_net(seed):
    rng = np.random.default_rng(seed)
    shapes = ((5, 3), (3,), (3, 3), (3,), (3, 6), (6,))
    names = (field.name for field in dataclasses.fields(GradientNet) if field.name != "brightening")
    return GradientNet(**{name: rng.normal(size=s) for name, s in zip(names, shapes, strict=True)})


def photographed(height_mm):
    """The frame that a surface gives under the known law."""
    down, right = np.gradient(height_mm, PX)
    change = np.stack([right, np.zeros_like(right), down], axis=-1) * LEVELS
    return (BACKGROUND + np.rint(change)).clip(0, 255).astype(np.uint8)


def bump(column, row, depth_mm=0.6, width_mm=1.5):
    r = np.hypot(COLUMN - column, ROW - row) * PX
    return depth_mm * np.exp(-((r / width_mm) ** 2))


def test_a_surface_is_recovered_exactly_from_its_differences():
    surface = np.random.default_rng(0).normal(size=(24, 31))
    integral = integrate_differences(np.diff(surface, axis=1), np.diff(surface, axis=0))
    np.testing.assert_allclose(integral, surface - surface.mean(), atol=1e-12)


def test_a_tilted_plane_is_not_bent_flat_at_the_edges():
    height = integrate(np.full((10, 14), 0.2), np.full((10, 14), -0.1), mm_per_px=0.5)
    row, column = np.mgrid[0:10, 0:14]
    plane = 0.5 * (0.2 * column - 0.1 * row)
    np.testing.assert_allclose(height, plane - plane.mean(), atol=1e-12)


def test_a_paraboloid_is_integrated_exactly():
    # its slopes are linear, so the mean of two neighbours' slopes is the slope between them
    row, column = np.mgrid[0:20, 0:30] * 0.1
    surface = 0.3 * column**2 - 0.2 * row**2 + 0.1 * row * column
    height = integrate(0.6 * column + 0.1 * row, 0.1 * column - 0.4 * row, mm_per_px=0.1)
    np.testing.assert_allclose(height, surface - surface.mean(), atol=1e-12)


def test_slopes_that_no_surface_has_give_the_nearest_surface():
    # a whirl has no potential; added to a plane's slopes it must change nothing
    row, column = np.mgrid[0:8, 0:8]
    loop_x, loop_down = np.zeros((8, 7)), np.zeros((7, 8))
    loop_x[3, 3], loop_x[4, 3], loop_down[3, 4], loop_down[3, 3] = 1, -1, 1, -1
    plane = 0.3 * column + 0.1 * row
    integral = integrate_differences(
        np.diff(plane, axis=1) + loop_x, np.diff(plane, axis=0) + loop_down
    )
    np.testing.assert_allclose(integral, plane - plane.mean(), atol=1e-12)


@pytest.mark.parametrize(("column", "row"), [(160, 120), (40, 30), (310, 235)])
def test_a_known_law_of_colour_gives_the_surface_back(column, row):
    surface = bump(column, row)
    integral = Photometer(LINEAR, BACKGROUND, SENSOR).heights(photographed(surface))
    np.testing.assert_allclose(integral, surface - np.median(surface), atol=0.02)
    assert integral.dtype == np.float32


@pytest.mark.parametrize("brightening", [-0.1, 1.5, float("nan")])
def test_light_that_no_gel_has_is_refused(brightening):
    with pytest.raises(TouchError, match="brightening must be"):
        dataclasses.replace(LINEAR, brightening=np.array([brightening]))


@pytest.mark.parametrize("depth_mm", [0.5, 1.0])
def test_light_that_grows_with_depth_makes_nothing_steeper(depth_mm):
    surface = bump(160, 120, depth_mm)
    change = photographed(surface).astype(float) - BACKGROUND
    brighter = (BACKGROUND + np.rint(change * (1 + 0.2 * surface[..., None]))).astype(np.uint8)
    net = dataclasses.replace(LINEAR, brightening=np.array([0.2], dtype=np.float32))
    corrected, plain = (
        Photometer(each, BACKGROUND, SENSOR).heights(brighter) for each in (net, LINEAR)
    )
    wanted = surface - np.median(surface)
    assert abs(corrected - wanted).max() < 0.01 + 0.02 * depth_mm
    assert abs(corrected - wanted).max() < 0.7 * abs(plain - wanted).max()


def test_indentation_is_positive_and_row_zero_is_the_top():
    heights = Photometer(LINEAR, BACKGROUND, SENSOR).heights(photographed(bump(80, 40)))
    cloud = cloud_from_heights(heights, SENSOR)
    x, y, z = cloud.points_mm[cloud.points_mm[:, 2].argmax()]
    assert z == pytest.approx(0.6, abs=0.05)
    assert x == pytest.approx((80 - 159.5) * PX, abs=0.5)
    assert y == pytest.approx((119.5 - 40) * PX, abs=0.5)


def test_an_untouched_gel_is_exactly_flat_whatever_the_network_is():
    assert not Photometer(random_net(1), BACKGROUND, SENSOR).heights(BACKGROUND).any()


def test_the_network_computes_what_its_formula_says():
    net, rng = random_net(2), np.random.default_rng(2)
    frame = (BACKGROUND + rng.integers(-15, 16, BACKGROUND.shape)).astype(np.uint8)
    right, down = Photometer(net, BACKGROUND, SENSOR).gradients(frame)
    row, column = 201, 17
    colour = (frame[row, column].astype(float) - 120) / COLOUR_SCALE
    position = [(column + 0.5) / 160 - 1, (row + 0.5) / 120 - 1]
    hidden = np.maximum(np.array([*colour, *position]) @ net.w1 + net.b1, 0)
    matrix = (np.maximum(hidden @ net.w2 + net.b2, 0) @ net.w3 + net.b3).reshape(2, 3)
    np.testing.assert_allclose([right[row, column], down[row, column]], matrix @ colour, rtol=1e-4)


def test_a_sphere_is_measured_without_being_told_its_size():
    r = np.hypot(COLUMN - 100, ROW - 90) * PX
    cap = np.sqrt(np.clip(4.0**2 - r**2, 0, None)) - 4.0 + 0.8
    ball = fit_ball(np.maximum(cap, 0), PX)
    assert ball.diameter_mm == pytest.approx(8.0, rel=0.01)
    assert ball.depth_mm == pytest.approx(0.8, abs=0.005)
    assert (ball.column, ball.row) == pytest.approx((100, 90), abs=0.1)


def test_a_flat_map_has_no_ball():
    with pytest.raises(TouchError, match="no ball"):
        fit_ball(bump(100, 100, width_mm=0.1), PX)


@pytest.mark.parametrize(
    ("frame", "message"),
    [
        (np.zeros((240, 320, 3), np.uint8), "black"),
        (np.full((480, 640, 3), 120, np.uint8), "640 × 480 px, expected 320 × 240"),
        (np.full((240, 320), 120, np.uint8), r"expected \(H, W, 3\) of uint8"),
        (np.full((240, 320, 3), 0.5), r"expected \(H, W, 3\) of uint8"),
    ],
)
def test_what_is_no_frame_is_refused(frame, message):
    with pytest.raises(TouchError, match=message):
        check_frame(frame, SENSOR)
    with pytest.raises(TouchError, match=message):
        Photometer(LINEAR, BACKGROUND, SENSOR).heights(frame)
    with pytest.raises(TouchError, match=message):
        Photometer(LINEAR, frame, SENSOR)


def test_a_background_that_is_not_this_units_is_refused():
    with pytest.raises(TouchError, match="the background is another unit's"):
        Photometer(LINEAR, BACKGROUND, SENSOR).heights(BACKGROUND + np.uint8(40))


def test_a_network_with_holes_is_refused():
    with pytest.raises(TouchError, match="w2 must be finite"):
        dataclasses.replace(LINEAR, w2=np.full((1, 1), np.nan))


@pytest.fixture
def saved(tmp_path):
    from PIL import Image

    def save(name, frame):
        Image.fromarray(frame).save(tmp_path / name)
        return tmp_path / name

    return save


def test_a_frame_is_read_as_it_was_written(saved):
    frame = np.random.default_rng(0).integers(0, 256, (240, 320, 3)).astype(np.uint8)
    np.testing.assert_array_equal(read_frame(saved("a.png", frame), SENSOR), frame)


def test_a_frame_file_needs_its_background(saved):
    file = saved("frame.png", photographed(bump(160, 120)))
    with pytest.raises(TouchError, match="--background"):
        read_cloud(file, SENSOR)


def test_a_frame_file_with_its_background_becomes_a_cloud(saved):
    cloud = read_cloud(
        saved("frame.png", photographed(bump(160, 120, depth_mm=0.2))),
        SENSOR,
        background=saved("background.png", BACKGROUND),
    )
    assert cloud.points_mm.shape == (1024, 3)


def test_images_that_are_no_frames_are_refused_by_name(saved, tmp_path):
    grey = saved("grey.png", BACKGROUND[..., 0])
    small = saved("small.png", BACKGROUND[::2, ::2])
    whole = saved("whole.png", np.random.default_rng(0).integers(0, 255, (240, 320, 3), np.uint8))
    half = tmp_path / "half.png"
    half.write_bytes(whole.read_bytes()[:50_000])
    junk = tmp_path / "junk.png"
    junk.write_bytes(b"not an image")
    for path, message in (
        (grey, "colour"),
        (small, "160 × 120"),
        (half, "can't be read whole"),
        (junk, "not an image"),
        (tmp_path / "none.png", "does not exist"),
        (tmp_path / "cloud.ply", "expected an image"),
    ):
        with pytest.raises(TouchError, match=message) as caught:
            read_frame(path, SENSOR)
        assert str(path) in str(caught.value)
