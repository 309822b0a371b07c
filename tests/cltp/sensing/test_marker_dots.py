"""Dots on a gel: found in any lattice that is nearly the nominal, and followed through presses."""

import dataclasses

import numpy as np
import pytest
from scipy import ndimage

from cltp.errors import TouchError
from cltp.sensing.marker_dots import DotTracker, mean_dots
from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.sensors import SENSORS
from sim.gel.marked_frames import MarkedGel

SENSOR = SENSORS["gelsight_mini_markers"]
X, Y = np.meshgrid(*grid_axes_mm(SENSOR, SENSOR.rows, SENSOR.columns))
FLAT = np.zeros(X.shape)
STILL = np.zeros((2, *X.shape))


def drawn(seed, **changed):
    rng = np.random.default_rng(seed)
    return dataclasses.replace(MarkedGel.draw(SENSOR, rng), **changed), rng


def press(rng, *, depth_mm, shift_mm):
    """A bump somewhere on the gel, and the gel dragged along and spread by it."""
    at_x, at_y, radius = rng.uniform(-6, 6), rng.uniform(-4, 4), rng.uniform(1.5, 4)
    far = ((X - at_x) ** 2 + (Y - at_y) ** 2) / radius**2
    angle, bump = rng.uniform(0, 2 * np.pi), np.exp(-far)
    along = shift_mm / (1 + far / 2) * np.array([np.cos(angle), np.sin(angle)])[:, None, None]
    spread = 0.05 * depth_mm / radius * bump * np.stack([X - at_x, Y - at_y])
    return depth_mm * bump, along + spread


def errors_px(gel, tracker, dots, along_mm):
    true_px = gel.moved_mm(along_mm) / SENSOR.mm_per_px * (1.0, -1.0)
    return dots.places_px - tracker.untouched.places_px - true_px


@pytest.mark.parametrize("seed", range(8))
def test_dots_are_followed_to_a_tenth_of_a_pixel(seed):
    gel, rng = drawn(seed)
    tracker = DotTracker(gel.frame(FLAT, STILL, rng), SENSOR)
    assert tracker.radius_px == pytest.approx(gel.radius_mm / SENSOR.mm_per_px, abs=0.8)
    for shift_mm in (0.02, 0.2, 0.6):
        height, along = press(rng, depth_mm=rng.uniform(0.05, 0.8), shift_mm=shift_mm)
        dots = tracker.follow(gel.frame(height, along, rng))
        assert dots.found.all()
        error = errors_px(gel, tracker, dots, along)
        assert np.sqrt((error**2).mean()) < 0.1
        assert np.abs(error).max() < 0.6  # at the steepest side of the deepest press


@pytest.mark.parametrize("noise_levels", [0.5, 4.0, 8.0])
@pytest.mark.parametrize("brightness", [0.6, 1.3])
def test_noise_and_brightness_cost_accuracy_not_dots(noise_levels, brightness):
    gel, rng = drawn(1, noise_levels=noise_levels)
    tracker = DotTracker(gel.frame(FLAT, STILL, rng), SENSOR)
    height, along = press(rng, depth_mm=0.3, shift_mm=0.3)
    bright = np.clip(brightness * gel.frame(height, along, rng).astype(float), 0, 255)
    dots = tracker.follow(bright.astype(np.uint8))
    assert dots.found.mean() > 0.95
    error = errors_px(gel, tracker, dots, along)[dots.found]
    assert np.sqrt((error**2).mean()) < 0.3


def test_the_first_frame_shifted_by_whole_pixels_is_exact():
    gel, rng = drawn(2, noise_levels=0.0)
    background = gel.frame(FLAT, STILL, rng)
    tracker = DotTracker(background, SENSOR)
    dots = tracker.follow(np.roll(background, (3, -5), axis=(0, 1)))
    moved = dots.places_px - tracker.untouched.places_px
    inner = dots.found & (np.abs(tracker.untouched.places_px - (160, 120)) < (120, 80)).all(axis=1)
    assert inner.sum() > 30
    assert np.abs(moved[inner] - (-5, 3)).max() < 0.02


@pytest.mark.parametrize("shape", ["punch", "bumps", "wire"])
def test_steep_walls_cost_dots_and_make_none_wrong(shape):
    gel, rng = drawn(8)
    tracker = DotTracker(gel.frame(FLAT, STILL, rng), SENSOR)
    if shape == "punch":
        height = 0.9 * ((np.abs(X) < 2.5) & (np.abs(Y) < 2.5))
    elif shape == "wire":
        height = 0.5 * (np.abs(Y - 0.2 * X) < 0.15)
    else:
        far = (np.mod(X, 2.0) - 1) ** 2 + (np.mod(Y, 2.0) - 1) ** 2
        height = np.clip(0.6 - 2.5 * far, 0.0, None)
    _, along = press(rng, depth_mm=0.0, shift_mm=0.4)
    dots = tracker.follow(gel.frame(ndimage.gaussian_filter(height, 1.5), along, rng))
    assert dots.found.mean() > 0.6
    assert np.abs(errors_px(gel, tracker, dots, along)[dots.found]).max() < 1.0


def test_a_lattice_that_fills_less_of_the_picture_is_found():
    gel, rng = drawn(9)
    small = dataclasses.replace(gel, dots_mm=0.75 * gel.dots_mm + (0.8, -0.5))
    tracker = DotTracker(small.frame(FLAT, STILL, rng), SENSOR)
    height, along = press(rng, depth_mm=0.3, shift_mm=0.4)
    dots = tracker.follow(small.frame(height, along, rng))
    assert dots.found.all()
    assert np.abs(errors_px(small, tracker, dots, along)).max() < 0.6


def test_dirt_and_worn_off_dots_are_none_of_the_lattice():
    gel, rng = drawn(3)
    worn = np.delete(gel.dots_mm, [10, 40], axis=0)
    background = dataclasses.replace(gel, dots_mm=worn).frame(FLAT, STILL, rng)
    background[100:120, 60:100] //= 6  # a dark stain over two dots' places, larger than a dot
    tracker = DotTracker(background, SENSOR)
    dots = tracker.follow(background)
    assert 57 <= dots.found.sum() <= 61
    assert not dots.found[[10, 40]].any()


def test_a_hidden_dot_is_lost_and_expected_where_its_neighbours_went():
    gel, rng = drawn(4)
    tracker = DotTracker(gel.frame(FLAT, STILL, rng), SENSOR)
    along = STILL + np.array([0.3, 0.1])[:, None, None]
    frame = gel.frame(FLAT, along, rng)
    column, row = np.rint(tracker.untouched.places_px[31] + (0.3 / 0.0634, -0.1 / 0.0634)).astype(
        int
    )
    frame[row - 12 : row + 13, column - 12 : column + 13] = 100
    dots = tracker.follow(frame)
    assert not dots.found[31] and dots.found.sum() == 62
    assert np.abs(errors_px(gel, tracker, dots, along)[31]).max() < 0.3


def test_dots_are_looked_for_where_they_were_before():
    gel, rng = drawn(5)
    tracker = DotTracker(gel.frame(FLAT, STILL, rng), SENSOR)
    before = None
    for shift_mm in np.linspace(0, 1.4, 8):
        along = (
            STILL + shift_mm * np.exp(-(X**2 + Y**2) / 40.0) * np.array([1.0, 0.0])[:, None, None]
        )
        before = tracker.follow(gel.frame(FLAT, along, rng), before)
    error = errors_px(gel, tracker, before, along)[before.found]
    assert before.found.mean() > 0.9
    assert np.sqrt((error**2).mean()) < 0.2


def test_a_mean_of_frames_has_the_dots_that_all_of_them_have():
    gel, rng = drawn(6)
    tracker = DotTracker(gel.frame(FLAT, STILL, rng), SENSOR)
    all_of_them = tracker.follow(gel.frame(FLAT, STILL, rng))
    frame = gel.frame(FLAT, STILL, rng)
    frame[:40] = 100
    some = tracker.follow(frame)
    assert not some.found[:9].any()
    assert np.array_equal(mean_dots([all_of_them, some]).found, some.found)


@pytest.mark.parametrize("level", [90, 255])
def test_a_gel_without_dots_is_refused(level):
    with pytest.raises(TouchError, match=r"dark dots .* expected 7 × 9"):
        DotTracker(np.full((240, 320, 3), level, dtype=np.uint8), SENSOR)


def test_a_lattice_of_other_numbers_is_refused():
    other = dataclasses.replace(SENSOR, shear_grid=(9, 12))
    rng = np.random.default_rng(7)
    frame = MarkedGel.draw(other, rng).frame(FLAT, STILL, rng)
    with pytest.raises(TouchError, match=r"expected 7 × 9"):
        DotTracker(frame, SENSOR)


def test_a_sensor_without_dots_has_none_to_follow():
    with pytest.raises(TouchError, match="digit has no dots"):
        DotTracker(np.full((240, 320, 3), 90, dtype=np.uint8), SENSORS["digit"])
