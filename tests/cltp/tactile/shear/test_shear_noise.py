"""Errors of a shear reading: drawn per unit within the stated range, and never of a force."""

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.sensors import SENSORS
from cltp.tactile.shear.field import ShearField
from cltp.tactile.shear.noise import SPREADS, ShearUnit

MARKERS, TAXELS = SENSORS["gelsight_mini_markers"], SENSORS["taxels"]


def field(sensor, moved_mm=0.1):
    x, y = (axis.ravel() for axis in np.meshgrid(*grid_axes_mm(sensor, *sensor.shear_grid)))
    moved = np.full((len(x), 3), moved_mm)
    return ShearField(
        positions_mm=np.stack([x, y], 1), displacement_mm=moved, sensor=sensor, force_n=moved
    )


def test_every_sensor_of_shear_has_noise_and_no_other():
    assert set(SPREADS) == {name for name, each in SENSORS.items() if each.shear_grid}


@pytest.mark.parametrize("sensor", [MARKERS, TAXELS], ids=lambda each: each.name)
def test_units_differ_within_the_stated_range(sensor):
    spread = SPREADS[sensor.name]
    units = [ShearUnit.draw(np.random.default_rng(seed), sensor) for seed in range(200)]
    along = np.array([unit.along_mm for unit in units])
    low, high = spread.along_mm
    assert low <= along.min() < 1.2 * low
    assert high / 1.2 < along.max() <= high
    scales = np.array([unit.scale for unit in units])
    assert 0.5 * spread.scale < np.abs(scales - 1).max() <= spread.scale


def test_a_frame_is_off_by_the_unit_s_noise_and_the_mean_of_frames_by_less():
    unit = ShearUnit(along_mm=0.005, depth_mm=0.002, scale=1.1)
    rng = np.random.default_rng(0)
    for frames, factor in ((1, 1.0), (4, 0.5)):
        readings = [unit.apply(field(TAXELS), rng, frames=frames) for _ in range(60)]
        errors = np.concatenate([each.displacement_mm for each in readings]) - 0.11
        np.testing.assert_allclose(
            errors.std(axis=0), factor * np.array([5e-3, 5e-3, 2e-3]), rtol=0.05
        )
        np.testing.assert_allclose(errors.mean(axis=0), 0, atol=2e-4)


def test_lost_markers_are_left_out_and_the_rest_stay_where_they_are():
    unit, whole = ShearUnit(loss=0.3), field(MARKERS)
    found = unit.apply(whole, np.random.default_rng(1))
    assert 30 < len(found.positions_mm) < 60
    assert {tuple(each) for each in found.positions_mm} < {
        tuple(each) for each in whole.positions_mm
    }


def test_a_reading_has_no_forces_and_a_perfect_one_is_the_field_itself():
    read = ShearUnit().apply(field(MARKERS), np.random.default_rng(0))
    assert read.force_n is None
    np.testing.assert_array_equal(read.displacement_mm, field(MARKERS).displacement_mm)


def test_taxels_give_whole_micrometres():
    unit = ShearUnit.draw(np.random.default_rng(0), TAXELS)
    moved_um = 1e3 * unit.apply(field(TAXELS), np.random.default_rng(0)).displacement_mm
    np.testing.assert_allclose(moved_um, np.rint(moved_um), atol=1e-3)


def test_too_few_markers_are_no_reading():
    with pytest.raises(TouchError, match="read again"):
        ShearUnit(loss=0.99).apply(field(MARKERS), np.random.default_rng(0))


def test_a_sensor_without_shear_has_no_unit_of_it():
    with pytest.raises(TouchError, match="no noise of shear"):
        ShearUnit.draw(np.random.default_rng(0), SENSORS["digit"])
    with pytest.raises(TouchError, match="level"):
        ShearUnit.draw(np.random.default_rng(0), TAXELS, -1.0)
