"""Points that stand alone are no touch; what a gel can show stays as it is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cltp.tactile.cloud import TactileCloud, cloud_from_heights, cloud_of_pixels, grid_axes_mm
from cltp.tactile.markers import marker_cloud
from cltp.tactile.noise_levels import WIDE
from cltp.tactile.sensor_noise import NoiseUnit, spread_of
from cltp.tactile.sensors import SENSORS, sensor_named
from tacgrasp.datasets.press import press
from tacgrasp.datasets.requests import PressRequest

MINI = sensor_named("gelsight_mini")
X, Y = np.meshgrid(*grid_axes_mm(MINI, 60, 80))
HEIGHTS = 0.5 * np.exp(-((X - 4.0) ** 2 + (Y + 2.0) ** 2) / 5.0)
HEIGHTS += np.random.default_rng(0).normal(0, 0.01, (60, 80))


def clouds() -> dict[str, TactileCloud]:
    rng = np.random.default_rng(1)
    pixels = cloud_of_pixels(HEIGHTS, MINI)
    missing = pixels.points_mm[rng.random(HEIGHTS.size) > 0.3]
    return {
        "pixels": pixels,
        "even": cloud_from_heights(HEIGHTS, MINI, rng=rng),
        "lattice": cloud_from_heights(HEIGHTS, MINI),
        "missing": replace(pixels, points_mm=rng.permutation(missing)),
    }


@pytest.mark.parametrize("kind", ["pixels", "even", "lattice", "missing"])
@pytest.mark.parametrize("height_mm", [1.0, 3.0, -3.0])
def test_a_spike_becomes_the_median_of_its_neighbours(kind: str, height_mm: float) -> None:
    clean = clouds()[kind]
    z = clean.points_mm[:, 2]
    corner = int(clean.points_mm[:, :2].sum(axis=1).argmax())
    rng = np.random.default_rng(2)
    for index in (corner, *rng.integers(len(z), size=10).tolist()):
        points = clean.points_mm.copy()
        points[index, 2] = height_mm
        mended = TactileCloud(points_mm=points, sensor=MINI)
        assert np.abs(mended.points_mm[:, 2] - z).max() < 0.1
        assert np.count_nonzero(mended.points_mm != clean.points_mm) <= 1
        assert mended.num_isolated == 0


def test_many_spikes_are_left_and_counted_in_every_copy() -> None:
    points = clouds()["lattice"].points_mm.copy()
    points[::40, 2] = 1.0
    spiked = TactileCloud(points_mm=points, sensor=MINI)
    assert np.array_equal(spiked.points_mm, points)
    assert replace(spiked, stamp=None).num_isolated == spiked.num_isolated >= 20


OBJECTS = ("centre_punch", "file", "cone_30", "pyramid_4_40", "dots_7", "flat:0.5", "cylinder:0.5")


@pytest.mark.parametrize("name", ["gelsight_mini", "digit", "gelstereo"])
@pytest.mark.parametrize("seen", OBJECTS)
def test_no_point_of_a_contact_is_replaced(
    name: str, seen: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    grid = "80x80" if name == "gelstereo" else "80x60"
    request = PressRequest(object=seen, depth_mm=1.2, sensor=name, grid=grid)
    heights = press(request).height_mm
    rng = np.random.default_rng(3)
    taxels = (SENSORS["taxels"],) if name == "gelsight_mini" else ()
    for sensor in (SENSORS[name], *taxels):
        unit = NoiseUnit.draw(rng, WIDE.draw(rng), spread=spread_of(sensor))
        noisy = unit.apply(heights, sensor, rng)
        makes = (
            lambda: cloud_of_pixels(noisy, sensor),  # noqa: B023
            lambda: cloud_from_heights(noisy, sensor, rng=np.random.default_rng(4)),  # noqa: B023
            lambda: marker_cloud(heights, sensor, unit=unit, rng=np.random.default_rng(5)),  # noqa: B023
        )
        for make in makes[2:] if sensor.markers else makes[:2]:
            made = make().points_mm
            with monkeypatch.context() as patched:
                patched.setattr(
                    "cltp.tactile.cloud.without_isolated", lambda points, *_: (points, 0)
                )
                assert np.array_equal(make().points_mm, made)
