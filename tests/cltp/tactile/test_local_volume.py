"""The volume of a contact: its own, whatever is tilted, broad or elsewhere."""

import numpy as np
import pytest

from cltp.tactile.cells import filled
from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.local_volume import local_contact, white_noise_mm
from cltp.tactile.sensor_noise import smooth_field
from cltp.tactile.sensors import sensor_named

SENSOR = sensor_named("gelsight_mini")
X, Y = np.meshgrid(*grid_axes_mm(SENSOR, 32, 32))


def volume_mm3(cells, sensor):
    return local_contact(cells, sensor).volume_mm3


def bump(x_mm=0.0, y_mm=0.0, depth_mm=0.3, radius_mm=3.0):
    """A paraboloid of the given depth and foot radius."""
    square = (X - x_mm) ** 2 + (Y - y_mm) ** 2
    return depth_mm * np.clip(1 - square / radius_mm**2, 0, None)


VOLUME = np.pi * 3.0**2 / 2 * 0.3 * 0.8**2
"""Of a paraboloid's top four fifths."""


@pytest.mark.parametrize(
    "background",
    [
        0.0 * X,
        0.02 * X - 0.01 * Y,
        0.003 * X * X - 0.002 * X * Y + 0.001 * Y * Y - 0.2,
        np.full_like(X, 0.4),
    ],
    ids=["flat", "tilted", "broad", "lost zero"],
)
@pytest.mark.parametrize("place", [(0, 0), (4, -3)])
def test_what_is_tilted_or_broad_is_no_volume(background, place):
    volume = volume_mm3(bump(*place) + background, SENSOR)
    assert volume == pytest.approx(VOLUME, rel=0.06)


def test_what_is_elsewhere_is_no_volume():
    both = bump(-4, 0) + bump(6, 5, depth_mm=0.15, radius_mm=1.5)
    assert volume_mm3(both, SENSOR) == pytest.approx(VOLUME, rel=0.06)


def test_a_tilted_gel_of_a_real_size_displaces_next_to_nothing():
    rng = np.random.default_rng(0)
    volumes = [
        volume_mm3(
            0.3 * smooth_field((32, 32), SENSOR, 40.0, rng)
            + 0.01 * (rng.normal() * X + rng.normal() * Y)
            + rng.normal(0, 0.005, (32, 32)),
            SENSOR,
        )
        for _ in range(200)
    ]
    plain = 0.05 * SENSOR.area_mm2  # what a mean of 0.05 mm would count as
    assert np.percentile(volumes, 95) < 0.05 * plain


def test_cells_without_points_take_the_value_beside_them():
    cells = bump()
    cells[np.random.default_rng(0).random(cells.shape) < 0.1] = np.nan
    assert volume_mm3(filled(cells), SENSOR) == pytest.approx(VOLUME, rel=0.15)


def test_noise_is_measured_beside_a_contact():
    noise = np.random.default_rng(0).normal(0, 0.004, X.shape)
    assert white_noise_mm(bump() + noise) == pytest.approx(0.004, rel=0.2)


def test_a_flat_gel_displaces_nothing():
    assert volume_mm3(np.zeros((32, 32)), SENSOR) == 0.0


def cap(radius_mm, depth_mm, x_mm=0.0, y_mm=0.0):
    """A noise-free press of a ball, with the untouched gel at exactly 0."""
    square = (X - x_mm) ** 2 + (Y - y_mm) ** 2
    return np.clip(depth_mm - square / (2 * radius_mm), 0, None)


@pytest.mark.parametrize("place", [(0, 0), (5, 3), (9, 0)])
@pytest.mark.parametrize("radius_mm", [15.0, 30.0, 60.0])
def test_a_deeper_press_of_a_large_ball_never_measures_less(radius_mm, place):
    depths = np.arange(0.2, 2.0, 0.1)
    clouds = [cap(radius_mm, depth, *place) for depth in depths]
    clouds = [cells for cells in clouds if np.quantile(cells, 0.02) < 0.08]  # else: raised all over
    assert len(clouds) >= 9
    contacts = [local_contact(cells, SENSOR) for cells in clouds]
    volumes = [contact.volume_mm3 for contact in contacts]
    assert (np.diff(volumes) > 0).all()
    measured = np.array([contact.heights_mm.max() for contact in contacts])
    assert measured == pytest.approx(depths[: len(measured)], rel=0.1, abs=0.01)


def test_a_flat_face_that_covers_the_most_of_the_pad_is_measured_from_the_clouds_zero():
    face = np.where(np.hypot(X, Y) < 9, 0.5, 0.0)
    volume = volume_mm3(face, SENSOR)
    assert volume == pytest.approx(0.8 * 0.5 * (face > 0).mean() * SENSOR.area_mm2, rel=0.01)


@pytest.mark.parametrize("width_mm", [14.5, 16, 17.5])
def test_the_gel_that_bulges_around_a_wide_punch_hides_none_of_it(width_mm):
    beside = np.hypot(X, Y) > width_mm / 2  # what is left of the pad is lower by a third of it
    cells = np.where(beside, -0.1, 0.3)
    volume = 0.3 * 0.8 * np.mean(~beside) * SENSOR.area_mm2
    assert volume_mm3(cells, SENSOR) == pytest.approx(volume, rel=0.02)


def test_broad_drift_above_zero_is_no_contact_that_covers_the_pad():
    drift = 0.1 + 0.012 * X  # most of the pad lies above 0.08 mm, and one side at 0
    assert volume_mm3(bump() + drift, SENSOR) == pytest.approx(VOLUME, rel=0.06)
