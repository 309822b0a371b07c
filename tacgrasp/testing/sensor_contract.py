"""What every TactileSensor must do; subclass ``SensorContract`` with a fixture ``sensor``."""

from __future__ import annotations

import time

import numpy as np
import pytest

from cltp import TouchError
from cltp.tactile.cloud import NUM_POINTS
from tacgrasp.rig.protocols import TactileSensor


class SensorContract:
    """Subclass as Test... and give a fixture ``sensor`` that yields a connected sensor.

    Where something touches that sensor, ``untouched_sensor`` yields another one that nothing does.
    """

    flat_mm = 0.02
    """Largest root mean square of the heights of an untouched gel after a reference [mm]."""

    @pytest.fixture
    def untouched_sensor(self, sensor: TactileSensor) -> TactileSensor:
        return sensor

    def test_a_cloud_has_1024_points_of_this_sensor_in_its_field(
        self, sensor: TactileSensor
    ) -> None:
        cloud = sensor.read()
        assert cloud.points_mm.shape == (NUM_POINTS, 3)
        assert cloud.sensor == sensor.spec

    def test_the_points_lie_one_in_each_cell_of_a_grid(self, sensor: TactileSensor) -> None:
        points, spec = sensor.read().points_mm, sensor.spec
        column = np.floor((points[:, 0] / spec.width_mm + 0.5) * 32).clip(0, 31)
        row = np.floor((0.5 - points[:, 1] / spec.height_mm) * 32).clip(0, 31)
        assert len(np.unique(row * 32 + column)) == NUM_POINTS

    def test_a_cloud_carries_both_clocks_and_later_ones_are_later(
        self, sensor: TactileSensor
    ) -> None:
        first, second = sensor.read().stamp, sensor.read().stamp
        assert first is not None and second is not None
        assert second.monotonic_s >= first.monotonic_s
        assert abs(first.wall_s - time.time()) < 3600

    def test_a_cloud_can_not_be_changed(self, sensor: TactileSensor) -> None:
        with pytest.raises(ValueError):
            sensor.read().points_mm[0, 0] = 1.0

    def test_after_a_reference_and_after_another_an_untouched_gel_is_flat(
        self, untouched_sensor: TactileSensor
    ) -> None:
        for _ in range(2):
            untouched_sensor.take_reference()
            heights_mm = untouched_sensor.read().points_mm[:, 2]
            assert np.sqrt(np.mean(heights_mm**2)) < self.flat_mm

    def test_a_disconnected_sensor_takes_no_reference(self, sensor: TactileSensor) -> None:
        sensor.disconnect()
        with pytest.raises(TouchError):
            sensor.take_reference()

    def test_a_disconnected_sensor_refuses_instead_of_answering_with_an_old_cloud(
        self, sensor: TactileSensor
    ) -> None:
        sensor.read()
        sensor.disconnect()
        sensor.disconnect()
        with pytest.raises(TouchError):
            sensor.read()
