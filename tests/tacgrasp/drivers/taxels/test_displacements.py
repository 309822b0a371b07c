"""Shear of a taxel array: from the gel, over the line, to the field that a policy is given."""

import time

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.sensing.taxel_packets import TaxelFrame
from cltp.tactile.cloud import Stamp
from cltp.tactile.sensors import SENSORS
from sim.emulators.taxels.array import TaxelEmulator
from tacgrasp.drivers.taxels.connect import check, connect_taxels
from tacgrasp.drivers.taxels.displacements import displacement_mm, shear_of
from tacgrasp.drivers.taxels.settings import TaxelSettings
from tests.fakes.waiting import poll

TAXELS = SENSORS["taxels"]
NOW = Stamp(monotonic_s=1.0, wall_s=2.0)


class DraggedGel:
    """A gel that is drawn by some tenths of a millimetre to the right and up; rows of noise."""

    def __init__(self, shape=(12, 12)):
        self.shape, self.along = shape, (0.2, -0.1)
        self._rng = np.random.default_rng(0)

    def height_mm(self):
        return self._rng.normal(0.1, 0.005, self.shape).astype(np.float32)

    def along_mm(self):
        along = np.broadcast_to(np.array(self.along), (*self.shape, 2))
        return along.astype(np.float32)


@pytest.fixture
def gel():
    return DraggedGel()


@pytest.fixture
def array(gel, tmp_path):
    emulator = TaxelEmulator(gel, link=tmp_path / "array", along_mm=gel.along_mm, rate_hz=50)
    yield emulator
    emulator.close()


def settings(emulator, **changes):
    given = {"sensor": "taxels", "read_timeout_s": 5.0, "connect_timeout_s": 5.0} | changes
    return TaxelSettings(port=emulator.port, **given)


def test_each_taxel_keeps_its_place_and_its_three_displacements():
    counts = np.arange(144, dtype=np.int16).reshape(12, 12)
    along = np.stack([counts + 1000, -counts], axis=2).astype(np.int16)
    frame = TaxelFrame(sequence=1, mark=0, clock_us=0, counts_um=counts, along_um=along)
    field = shear_of(displacement_mm(frame), TAXELS, NOW)
    np.testing.assert_allclose(field.displacement_mm[13], [1.013, -0.013, 0.013], atol=1e-6)
    x, y = field.positions_mm[12 + 1]
    assert x == pytest.approx((1.5 / 12 - 0.5) * TAXELS.width_mm, abs=1e-4)
    assert y == pytest.approx((0.5 - 1.5 / 12) * TAXELS.height_mm, abs=1e-4)
    assert field.stamp == NOW and field.force_n is None


def test_heights_alone_have_no_field():
    frame = TaxelFrame(sequence=1, mark=0, clock_us=0, counts_um=np.zeros((12, 12), np.int16))
    assert shear_of(displacement_mm(frame), TAXELS, NOW) is None


def test_a_taxel_beyond_the_gel_is_no_field():
    with pytest.raises(TouchError, match="more than the"):
        shear_of(np.full((12, 12, 3), 5.0), TAXELS, NOW)


def test_a_read_gives_cloud_and_field_of_the_same_frames_relative_to_the_reference(array, gel):
    with_shear = connect_taxels(settings(array))
    try:
        assert with_shear.last_shear() is None
        cloud = with_shear.read(2)
        field = with_shear.last_shear()
        assert field.stamp == cloud.stamp
        np.testing.assert_allclose(field.displacement_mm[:, :2], [[0.2, -0.1]] * 144, atol=1e-6)
        np.testing.assert_allclose(field.displacement_mm[:, 2].mean(), 0.1, atol=0.005)
        with_shear.take_reference()
        gel.along = (0.3, -0.1)
        with_shear.read()
        moved_mm = with_shear.last_shear().displacement_mm
        np.testing.assert_allclose(moved_mm[:, :2], [[0.1, 0.0]] * 144, atol=1e-6)
    finally:
        with_shear.disconnect()


def test_doctor_says_what_the_array_measures_along_its_gel(array):
    found = {each.name: each for each in check(settings(array))}
    assert found["shear"].ok
    assert "144 points, displaced by 200 µm" in found["shear"].detail


def test_doctor_says_that_an_array_of_version_1_measures_none(tmp_path):
    gel = DraggedGel()
    emulator = TaxelEmulator(gel, link=tmp_path / "heights", rate_hz=50)
    try:
        found = {each.name: each for each in check(settings(emulator))}
        assert not found["shear"].ok
        assert "version 1" in found["shear"].detail
        gel.shape = (12, 16)
        found = {each.name: each for each in check(settings(emulator, sensor="gelsight_mini"))}
        assert found["shear"].ok
    finally:
        emulator.close()


def test_another_grid_than_that_of_the_sensor_is_refused(tmp_path):
    emulator = TaxelEmulator(DraggedGel((9, 12)), link=tmp_path / "small", rate_hz=50)
    try:
        with pytest.raises(TouchError, match="9 × 12 taxels, which doesn't fit the taxels of"):
            connect_taxels(settings(emulator))
    finally:
        emulator.close()


def is_plugged(sensor):
    try:
        return "unplugged" not in str(sensor.check_alive())
    except TouchError as error:
        return "unplugged" not in str(error)


def test_the_newest_field_is_there_at_once_the_same_until_another_frame_comes(array, gel):
    sensor = connect_taxels(settings(array))
    try:
        sensor.take_reference()
        gel.along = (0.3, -0.1)
        first = sensor.newest_shear()
        poll(lambda: np.allclose(sensor.newest_shear().displacement_mm[:, 0], 0.1, atol=1e-6))
        assert sensor.newest_shear().stamp.monotonic_s > first.stamp.monotonic_s
        array.inject("stall")
        time.sleep(0.1)
        held = sensor.newest_shear()
        assert sensor.newest_shear() is held
        array.clear()
        array.inject("black")
        with pytest.raises(TouchError, match="dead or dark"):
            poll(lambda: sensor.newest_shear() is None)
        array.inject("unplugged")
        with pytest.raises(TouchError, match="unplugged"):
            poll(lambda: not is_plugged(sensor) and sensor.newest_shear() is None)
    finally:
        sensor.disconnect()
