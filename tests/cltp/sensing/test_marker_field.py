"""Frames of a gel with dots: heights as without them, and displacements at the sensor's grid."""

import dataclasses

import numpy as np
import pytest
from PIL import Image

from cltp.errors import TouchError
from cltp.sensing.calibration import default_calibration, load_calibration
from cltp.sensing.frames import read_frame
from cltp.sensing.marker_field import COARSE, MarkerReader, coarse_frame, heights_of_frame
from cltp.sensing.photometric import Photometer
from cltp.sensing.touch_files import read_heights
from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.sensors import SENSORS
from cltp.tactile.shear.contact_shape import grid_of
from sim.gel.marked_frames import ALBEDO, MarkedGel
from tacgrasp.bringup.ball_frames import frames_heights
from tests.paths import SHARED_DATA

SENSOR, PLAIN = SENSORS["gelsight_mini_markers"], SENSORS["gelsight_mini"]
BALLS = SHARED_DATA / "gelsight_mini_balls"
X, Y = np.meshgrid(*grid_axes_mm(SENSOR, SENSOR.rows, SENSOR.columns))
FLAT, STILL = np.zeros(X.shape), np.zeros((2, *X.shape))
NET = load_calibration(default_calibration(SENSOR), SENSOR).net


def drawn(seed):
    rng = np.random.default_rng(seed)
    return MarkedGel.draw(SENSOR, rng), rng


def reader_of(background):
    return MarkerReader(Photometer(NET, background, SENSOR), background, SENSOR)


def test_a_linear_field_is_read_exactly_at_the_grid_wherever_the_dots_are():
    gel, rng = drawn(0)
    reader = reader_of(gel.frame(FLAT, STILL, rng))
    along = np.stack([0.2 + 0.01 * X + 0.02 * Y, -0.1 - 0.02 * X + 0.01 * Y])
    dots = reader.follow(gel.frame(FLAT, along, rng))
    field = reader.field(dots, FLAT)
    x, y = field.positions_mm.T
    true_mm = np.stack([0.2 + 0.01 * x + 0.02 * y, -0.1 - 0.02 * x + 0.01 * y], axis=1)
    inside = (np.abs(x) < 0.7 * SENSOR.width_mm / 2) & (np.abs(y) < 0.7 * SENSOR.height_mm / 2)
    assert np.abs(field.displacement_mm[inside, :2] - true_mm[inside]).max() < 0.012
    assert np.abs(field.displacement_mm[:, :2] - true_mm).max() < 0.04  # beyond the outer dots
    assert np.array_equal(grid_of(SENSOR).cells_of(field.positions_mm), np.arange(63))


def test_points_whose_dots_are_lost_are_left_out():
    gel, rng = drawn(1)
    reader = reader_of(gel.frame(FLAT, STILL, rng))
    frame = gel.frame(FLAT, STILL, rng)
    frame[:, :50] = 100
    field = reader.field(reader.follow(frame), FLAT)
    assert 45 < len(field.positions_mm) < 63
    assert field.positions_mm[:, 0].min() > -8.0
    with pytest.raises(TouchError, match="0 of the 63 dots"):
        reader.field(reader.follow(np.full_like(frame, 100)), FLAT)


def test_the_height_of_a_point_is_that_where_its_dot_has_gone():
    gel, rng = drawn(2)
    reader = reader_of(gel.frame(FLAT, STILL, rng))
    along = STILL + np.array([0.5, -0.3])[:, None, None]
    dots = reader.follow(gel.frame(FLAT, along, rng))
    field = reader.field(dots, 0.1 * X + 0.05 * Y)
    x, y = field.positions_mm.T
    inside = (np.abs(x) < 7) & (np.abs(y) < 5)
    expected = 0.1 * (x + 0.5) + 0.05 * (y - 0.3)
    assert field.displacement_mm[inside, 2] == pytest.approx(expected[inside], abs=0.01)


def test_moved_dots_add_nothing_to_the_noise_of_heights():
    gel, rng = drawn(3)
    plain = dataclasses.replace(gel, dots_mm=np.empty((0, 2)))
    without = [plain.frame(FLAT, STILL, rng) for _ in range(2)]
    noise_mm = heights_of_frame(*without, NET, PLAIN).std()
    background = gel.frame(FLAT, STILL, rng)
    along = STILL + np.array([0.2, 0.1])[:, None, None]
    moved = gel.frame(FLAT, along, rng)
    assert heights_of_frame(moved, background, NET, SENSOR).std() < 1.2 * noise_mm
    assert heights_of_frame(moved, background, NET, PLAIN).std() > 3 * noise_mm
    assert np.abs(heights_of_frame(background, background, NET, SENSOR)).max() == 0


def test_a_frame_of_a_gel_without_dots_is_refused_by_its_dots():
    gel, rng = drawn(5)
    background = gel.frame(FLAT, STILL, rng)
    plain = dataclasses.replace(gel, dots_mm=np.empty((0, 2))).frame(FLAT, STILL, rng)
    with pytest.raises(TouchError, match=r"0 of the 63 dots.*of the background's gel"):
        heights_of_frame(plain, background, NET, SENSOR)


def test_a_coarse_frame_is_the_mean_of_its_pixels():
    frame = np.arange(2 * 4 * 6 * 3, dtype=np.uint8)[: 4 * 6 * 3].reshape(4, 6, 3)
    blocks = frame.reshape(2, COARSE, 3, COARSE, 3).mean(axis=(1, 3))
    assert np.abs(coarse_frame(frame) - blocks).max() <= 0.5


@pytest.fixture(scope="module")
def dotted_balls(tmp_path_factory):
    """Real presses of a ball onto which dots are painted that move with the gel about them."""
    if not BALLS.is_dir():
        pytest.skip("needs the real frames of ../shared/data")
    folder = tmp_path_factory.mktemp("dotted")
    gel, rng = drawn(4)
    plain = dict(frames_heights(BALLS))

    def dotted(path, along):
        dark = gel.dots_over(along)[..., None] * (1 - ALBEDO)
        frame = np.rint(read_frame(path, PLAIN) * (1 - dark)).astype(np.uint8)
        Image.fromarray(frame).save(folder / path.name)

    dotted(BALLS / "background.png", STILL)
    moved = {}
    for name in list(plain)[::6]:
        height = plain[name]
        row, column = np.unravel_index(height.argmax(), height.shape)
        far = (X - X[row, column]) ** 2 + (Y - Y[row, column]) ** 2
        along = np.multiply.outer(rng.uniform(-0.3, 0.3, 2), 1 / (1 + far / 4.0))
        dotted(BALLS / f"{name}.png", along)
        moved[name] = height, along
    return folder, gel, moved


def test_real_presses_have_the_same_heights_with_dots_as_without(dotted_balls):
    folder, _, moved = dotted_balls
    for name, heights in frames_heights(folder, sensor=SENSOR):
        before, _ = moved[name]
        assert np.abs(heights - before).max() < 0.1 * before.max()
        on_ball = before > 0.1 * before.max()
        assert np.sqrt(np.mean((heights - before)[on_ball] ** 2)) < 0.04 * before.max()


def test_dots_on_real_presses_are_followed_to_a_tenth_of_a_pixel(dotted_balls):
    folder, gel, moved = dotted_balls
    reader = reader_of(read_frame(folder / "background.png", SENSOR))
    untouched = reader.follow(read_frame(folder / "background.png", SENSOR)).places_px
    for name, (_, along) in moved.items():
        dots = reader.follow(read_frame(folder / f"{name}.png", SENSOR))
        assert dots.found.all()
        true_px = gel.moved_mm(along) / SENSOR.mm_per_px * (1.0, -1.0)
        assert np.sqrt(np.mean((dots.places_px - untouched - true_px) ** 2)) < 0.1


def test_a_file_of_a_gel_with_dots_is_read_by_its_sensor(dotted_balls):
    folder, _, moved = dotted_balls
    name = next(iter(moved))
    heights = read_heights(folder / f"{name}.png", SENSOR, background=folder / "background.png")
    assert heights.max() == pytest.approx(moved[name][0].max(), rel=0.06)
