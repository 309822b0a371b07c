"""A cloud that is none says what seems to be wrong with it."""

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.tactile.cloud import TactileCloud, check_relief, cloud_from_heights
from cltp.tactile.sensors import sensor_named

SENSOR = sensor_named("gelsight_mini")
X, Y = np.meshgrid(np.linspace(-10, 10, 80), np.linspace(-7.5, 7.5, 60))
BALL = cloud_from_heights(np.clip(0.45 - (X**2 + Y**2) / 30, 0, None), SENSOR).points_mm


@pytest.mark.parametrize(
    ("points", "expected"),
    [
        (BALL * 1000, "is it in µm"),
        (BALL * np.float32([1, 1, 1000]), r"exceeds the 3.4 mm gel .* is it in µm"),
        (BALL * np.float32([2, 2, 1]), "wrong sensor or frame"),
        (BALL + np.float32([0, 0, 5]), "gel of gelsight_mini$"),
        (BALL / 1000, "is it in metres"),
        (BALL / 10, "is it in centimetres"),
        (BALL * np.float32([1, 0, 1]), "on a line: the cloud spans 19.* mm in x and 0 mm in y"),
        (np.repeat(BALL[:1], 100, axis=0), "all 100 points of the cloud lie at one place"),
        (BALL[:1], "has 1 point; at least 64"),
        (BALL[:3], "has 3 points; at least 64"),
    ],
)
def test_what_is_no_cloud_says_why(points: np.ndarray, expected: str) -> None:
    with pytest.raises(TouchError, match=expected):
        TactileCloud(points_mm=points, sensor=SENSOR)


@pytest.mark.parametrize("deepest_mm", [0.02, 0.45, 1.9])
def test_depths_in_metres_beside_places_in_mm_are_refused(deepest_mm: float) -> None:
    heights_mm = BALL[:, 2] * deepest_mm / BALL[:, 2].max()
    check_relief(heights_mm)
    with pytest.raises(TouchError, match=r"the cloud's whole relief is .* is it in metres"):
        check_relief(heights_mm / 1000)


@pytest.mark.parametrize("noise_mm", [0.0, 1e-7, 0.001, 0.01, 0.03])
@pytest.mark.parametrize("num_points", [64, 1024])
def test_an_untouched_gel_is_never_taken_for_metres(noise_mm: float, num_points: int) -> None:
    for seed in range(20):
        noise = np.random.default_rng(seed).standard_normal(num_points)
        check_relief((0.05 + noise_mm * noise).astype(np.float32))
