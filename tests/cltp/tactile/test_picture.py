"""Pictures for people: lit from where they say, the same scale for every contact."""

import numpy as np
import pytest

from cltp import TouchError
from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.picture import DEPTH_STOPS_MM, depth_picture, depth_scale, picture
from cltp.tactile.sensors import SENSORS

MINI = SENSORS["gelsight_mini"]
X, Y = np.meshgrid(*grid_axes_mm(MINI, 60, 80))


def bump(depth_mm=0.6, x_mm=0.0, y_mm=0.0):
    return depth_mm * np.exp(-((X - x_mm) ** 2 + (Y - y_mm) ** 2) / 8)


def at(image, x_mm, y_mm):
    row = int((0.5 - y_mm / MINI.height_mm) * image.shape[0])
    column = int((0.5 + x_mm / MINI.width_mm) * image.shape[1])
    return image[row, column].astype(int)


def test_an_untouched_gel_is_an_even_grey():
    image = picture(np.zeros((60, 80)), MINI)
    assert image.shape == (240, 320, 3)
    assert image.dtype == np.uint8
    assert np.ptp(image.reshape(-1, 3), axis=0).max() == 0
    assert np.ptp(image[0, 0].astype(int)) < 40
    assert 80 < image[0, 0].mean() < 180


def test_a_bump_is_red_on_the_left_green_at_the_top_and_blue_at_the_lower_right():
    image = picture(bump(), MINI)
    assert at(image, -2, 0)[0] > at(image, 2, 0)[0] + 30
    assert at(image, 0, 2)[1] > at(image, 0, -2)[1] + 30
    assert at(image, 1.4, -1.4)[2] > at(image, -1.4, 1.4)[2] + 30


def test_what_is_deeper_looks_deeper_whatever_else_is_there():
    shallow, deep = depth_picture(bump(0.2), MINI), depth_picture(bump(0.8), MINI)
    assert at(deep, 0, 0).sum() > at(shallow, 0, 0).sum() + 100
    np.testing.assert_array_equal(at(shallow, 9.5, 7), at(deep, 9.5, 7))
    raised = depth_picture(np.full((60, 80), -0.08), MINI)[0, 0].astype(int)
    assert raised[2] > raised[0] + 50


@pytest.mark.parametrize("width_px", [64, 200, 320])
def test_a_picture_has_the_proportions_of_the_sensing_area(width_px):
    assert picture(bump(), MINI, width_px).shape[:2] == (round(width_px * 0.75), width_px)


@pytest.mark.parametrize("heights", [np.zeros(9), np.zeros((4, 4)), np.full((9, 9), np.nan)])
def test_what_is_no_height_map_is_refused(heights):
    for draw in (picture, depth_picture):
        with pytest.raises(TouchError, match="height map"):
            draw(heights, MINI)


def test_the_scale_has_the_colours_of_the_depths_at_its_marks():
    scale = depth_scale(701, 3)
    assert scale.shape == (3, 701, 3)
    for number, stop_mm in enumerate(DEPTH_STOPS_MM):
        flat = depth_picture(np.full((60, 80), stop_mm), MINI)[30, 40].astype(int)
        assert np.abs(scale[1, 100 * number].astype(int) - flat).max() <= 1
