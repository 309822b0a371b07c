"""What every TactileSensor must do; subclass ``SensorContract`` with a fixture ``sensor``."""

from __future__ import annotations

import time

import numpy as np
import pytest

from cltp import TouchError
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

    num_points = 1024
    """Least number of points of a cloud."""

    def test_a_cloud_keeps_the_points_of_this_sensor_in_its_field(
        self, sensor: TactileSensor
    ) -> None:
        cloud = sensor.read()
        assert len(cloud.points_mm) >= self.num_points
        assert cloud.sensor == sensor.spec

    def test_the_mean_of_several_frames_has_the_points_of_one_and_is_not_older(
        self, sensor: TactileSensor
    ) -> None:
        one, several = sensor.read(), sensor.read(frames=3)
        np.testing.assert_array_equal(one.points_mm[:, :2], several.points_mm[:, :2])
        assert one.stamp is not None and several.stamp is not None
        assert several.stamp.monotonic_s >= one.stamp.monotonic_s

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
