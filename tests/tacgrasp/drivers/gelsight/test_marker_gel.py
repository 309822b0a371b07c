"""A GelSight Mini whose gel has dots: clouds without them, and shear fields, fresh and newest."""

import datetime
import threading
import time

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.sensing.calibration import Calibration, save_calibration
from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.measure import contact_state
from cltp.tactile.sensors import SENSORS
from sim.gel.marked_frames import MarkedGel, lamps_net
from tacgrasp.drivers.gelsight import sensor as gelsight
from tacgrasp.drivers.gelsight.background import Background, save_background
from tacgrasp.drivers.gelsight.connect import check, connect_gelsight
from tacgrasp.drivers.gelsight.settings import GelSightSettings
from tacgrasp.rig.protocols import ShearSensor, StreamingShearSensor
from tacgrasp.testing import SensorContract
from tests.fakes.camera import GREY, Camera

SENSOR = SENSORS["gelsight_mini_markers"]
NOW = datetime.datetime(2026, 2, 1, 12, tzinfo=datetime.UTC)
X, Y = np.meshgrid(*grid_axes_mm(SENSOR, SENSOR.rows, SENSOR.columns))
RNG = np.random.default_rng(3)
GEL = MarkedGel.draw(SENSOR, RNG)


def picture(depth_mm=0.0, along_mm=(0.0, 0.0), at=(0.0, 0.0)):
    """A ball of 3 mm radius that drags the gel about it along."""
    x, y = X - at[0], Y - at[1]
    height = np.clip(depth_mm - 3.0 + np.sqrt(np.clip(9.0 - x**2 - y**2, 0.0, None)), 0.0, None)
    reach = 1 / (1 + (x**2 + y**2) / 20.0)
    return GEL.frame(height, np.multiply.outer(along_mm, reach), RNG)


UNTOUCHED = picture()


@pytest.fixture
def files(tmp_path):
    """Calibration and background of the unit 'mine'."""
    save_calibration(
        tmp_path / "mine.safetensors",
        Calibration(
            net=lamps_net(), sensor="gelsight_mini", unit="mine", date="2026-01-31",
            ball_diameter_mm=6.0, num_frames=1, residual=0.0, seed=0, source="test",
        ),
    )  # fmt: skip
    save_background(
        tmp_path / "background.png",
        Background(frame=UNTOUCHED, unit="mine", taken=NOW, num_frames=20),
    )
    return tmp_path


def settings_of(files, **changed):
    known = {
        "device": "/dev/v4l/by-id/mine", "unit": "mine", "frame_age_s": 0.02,
        "sensor": "gelsight_mini_markers", "calibration": files / "mine.safetensors",
        "background": files / "background.png", "read_timeout_s": 1.0, "connect_timeout_s": 2.0,
    }  # fmt: skip
    return GelSightSettings(**(known | changed))


@pytest.fixture
def camera():
    one = Camera(UNTOUCHED)
    yield one
    one.failure = "the test is over"


@pytest.fixture
def sensor(files, camera):
    connected = connect_gelsight(settings_of(files), now=lambda: NOW, opener=camera)
    yield connected
    connected.disconnect()


class TestTheContractOnAGelWithDots(SensorContract):
    pass


def test_a_ball_is_felt_as_deep_as_it_is_between_the_dots(sensor, camera):
    camera.picture = picture(0.8, along_mm=(0.3, -0.2), at=(3.0, -2.0))
    state = contact_state(sensor.read())
    assert state.depth_mm == pytest.approx(0.8, abs=0.1)
    assert (state.x_mm, state.y_mm) == pytest.approx((3.0, -2.0), abs=0.3)


def test_shear_is_that_of_the_dots_in_the_gel_frame(sensor, camera):
    assert isinstance(sensor, ShearSensor)
    assert sensor.last_shear() is None
    camera.picture = picture(0.5, along_mm=(0.4, -0.25))
    sensor.read(frames=3)
    field = sensor.last_shear()
    assert len(field.positions_mm) == 63
    middle = np.hypot(*field.positions_mm.T) < 0.1
    assert field.displacement_mm[middle][0] == pytest.approx((0.4, -0.25, 0.5), abs=0.05)
    reach = 1 / (1 + (field.positions_mm**2).sum(axis=1) / 20.0)
    error_mm = field.displacement_mm[:, :2] - np.outer(reach, (0.4, -0.25))
    assert np.abs(error_mm).max() < 0.05  # linear between the dots
    assert field.sensor.name == "gelsight_mini_markers"


def test_the_newest_field_comes_at_once_and_is_one_object_a_frame(sensor, camera):
    assert isinstance(sensor, StreamingShearSensor)
    camera.show(picture(0.5, along_mm=(0.0, 0.3)))
    camera.stalled = True
    time.sleep(0.1)
    field = sensor.newest_shear()
    assert field is sensor.newest_shear()
    middle = np.hypot(*field.positions_mm.T) < 0.1
    assert field.displacement_mm[middle][0] == pytest.approx((0.0, 0.3, 0.5), abs=0.05)
    camera.stalled = False


def test_dots_that_move_by_more_than_half_their_pitch_are_followed_step_by_step(
    sensor, camera, monkeypatch
):
    monkeypatch.setattr(gelsight, "FOLLOWED_S", 10.0)  # however busy this computer is
    pictures = [picture(0.5, along_mm=(0.2 * part, 0.0)) for part in range(1, 8)]  # takes a while
    for each in pictures:
        camera.show(each)
        field = sensor.newest_shear()
    middle = np.hypot(*field.positions_mm.T) < 0.1
    assert field.displacement_mm[middle][0, 0] == pytest.approx(1.4, abs=0.05)


def test_shear_is_relative_to_the_last_reference(sensor, camera):
    camera.picture = picture(along_mm=(0.1, 0.0))
    sensor.read()
    assert np.abs(sensor.last_shear().displacement_mm[:, 0]).max() > 0.09
    sensor.take_reference()
    sensor.read()
    assert np.abs(sensor.last_shear().displacement_mm).max() < 0.02


def test_a_reflex_reads_the_newest_field_while_others_read_and_take_references(sensor, camera):
    camera.picture = picture(along_mm=(0.1, 0.0))
    ending, problems = threading.Event(), []

    def reflex():
        while not ending.is_set():
            try:
                sensor.newest_shear()
            except Exception as error:  # whatever it is, the test fails with it
                problems.append(error)
                return

    thread = threading.Thread(target=reflex)
    thread.start()
    for _ in range(3):
        sensor.take_reference()
        sensor.read(frames=2)
    ending.set()
    thread.join()
    assert not problems
    assert np.abs(sensor.newest_shear().displacement_mm).max() < 0.03


def test_dots_that_have_moved_a_little_are_no_touch(sensor, camera):
    camera.picture = picture(along_mm=(0.06, 0.06))
    sensor.expect_untouched()
    camera.picture = picture(0.5)
    with pytest.raises(TouchError, match="nothing should touch: free the gel"):
        sensor.expect_untouched()


def test_a_gel_whose_dots_are_covered_gives_no_shear(sensor, camera):
    camera.picture = np.where(UNTOUCHED.max(axis=2, keepdims=True) < 60, 90, UNTOUCHED)
    camera.picture = camera.picture.astype(np.uint8)
    with pytest.raises(TouchError, match=r" \d of the 63 dots"):
        sensor.read()


def test_a_gel_without_dots_is_refused_by_name(files, camera):
    save_background(
        files / "plain.png", Background(frame=GREY, unit="mine", taken=NOW, num_frames=20)
    )
    with pytest.raises(TouchError, match=r"0 dark dots .* expected 7 × 9"):
        connect_gelsight(
            settings_of(files, background=files / "plain.png"), now=lambda: NOW, opener=camera
        )
    assert camera.opened == 0


def test_a_gel_with_dots_read_as_one_without_gives_no_shear(files, camera):
    plain = connect_gelsight(
        settings_of(files, sensor="gelsight_mini"), now=lambda: NOW, opener=camera
    )
    plain.read()
    assert plain.spec.name == "gelsight_mini"
    assert plain.last_shear() is None and plain.newest_shear() is None
    plain.disconnect()


def test_a_check_says_at_how_many_points_shear_is_measured(files, camera):
    *_, fresh = check(settings_of(files), now=lambda: NOW, opener=camera)
    assert "shear at 63 points" in fresh.detail
