"""The driver of a GelSight Mini: fresh frames from a camera, recordings, and clear errors."""

import datetime
import math
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PIL import Image

from cltp.errors import TouchError
from cltp.sensing.calibration import Calibration, save_calibration
from cltp.sensing.photometric import COLOUR_SCALE, GradientNet
from cltp.tactile.measure import contact_state
from cltp.tactile.sensors import SENSORS
from tacgrasp.bringup.ball_frames import frames_heights, read_ball_frames
from tacgrasp.drivers.gelsight.background import Background, save_background
from tacgrasp.drivers.gelsight.connect import check, connect_gelsight, take_background
from tacgrasp.drivers.gelsight.settings import GelSightSettings
from tacgrasp.rig.protocols import CameraSensor
from tacgrasp.testing import SensorContract
from tests.fakes.camera import GREY, Camera
from tests.fakes.waiting import is_alive, poll
from tests.paths import SHARED_DATA

SENSOR = SENSORS["gelsight_mini"]
BALLS = SHARED_DATA / "gelsight_mini_balls"
LAMPS = np.array([[80.0, 0.0], [-35.0, 60.0], [-45.0, -70.0]])
NOW = datetime.datetime(2026, 2, 1, 12, tzinfo=datetime.UTC)
ROW, COLUMN = np.mgrid[0:240, 0:320]


def pressed(depth_mm, x_mm=0.0, y_mm=0.0):
    """A ball of 3 mm radius under three lamps; none at depth 0."""
    x = (COLUMN - 159.5) * SENSOR.mm_per_px - x_mm
    down = (ROW - 119.5) * SENSOR.mm_per_px + y_mm
    root = np.sqrt(np.clip(9.0 - x**2 - down**2, 1e-3, None))
    slopes = -np.stack([x, down], axis=-1) / root[..., None] * (root > 3.0 - depth_mm)[..., None]
    return (GREY + np.rint(slopes @ LAMPS.T)).clip(0, 255).astype(np.uint8)


@pytest.fixture
def files(tmp_path):
    """Calibration and background of the unit 'mine'."""
    back = COLOUR_SCALE * np.linalg.pinv(LAMPS)
    net = GradientNet(
        w1=np.zeros((5, 1)), b1=np.zeros(1), w2=np.zeros((1, 1)), b2=np.zeros(1),
        w3=np.zeros((1, 6)), b3=back.ravel(),
    )  # fmt: skip
    save_calibration(
        tmp_path / "mine.safetensors",
        Calibration(
            net=net, sensor=SENSOR.name, unit="mine", date="2026-01-31", ball_diameter_mm=6.0,
            num_frames=1, residual=0.0, seed=0, source="test",
        ),
    )  # fmt: skip
    taken = NOW - datetime.timedelta(hours=2)
    save_background(
        tmp_path / "background.png",
        Background(frame=GREY, unit="mine", taken=taken, num_frames=20),
    )
    return tmp_path


def settings_of(files, **changed):
    known = {
        "device": "/dev/v4l/by-id/mine", "unit": "mine", "frame_age_s": 0.02,
        "calibration": files / "mine.safetensors", "background": files / "background.png",
        "read_timeout_s": 1.0, "connect_timeout_s": 2.0,
    }  # fmt: skip
    return GelSightSettings(**(known | changed))


def connect(files, camera, **changed):
    return connect_gelsight(settings_of(files, **changed), now=lambda: NOW, opener=camera)


@pytest.fixture
def camera():
    one = Camera()
    yield one
    one.failure = "the test is over"


@pytest.fixture
def sensor(files, camera):
    gelsight = connect(files, camera)
    yield gelsight
    gelsight.disconnect()


def test_a_pressed_ball_is_felt_where_and_as_deep_as_it_is(sensor, camera):
    camera.picture = pressed(0.8, x_mm=4.0, y_mm=-3.0)
    state = contact_state(sensor.read())
    assert state.depth_mm == pytest.approx(0.8, abs=0.1)
    assert (state.x_mm, state.y_mm) == pytest.approx((4.0, -3.0), abs=0.3)


@given(
    st.integers(0, SENSOR.rows - 1),
    st.integers(0, SENSOR.columns - 1),
    st.sampled_from([math.nan, math.inf, -math.inf]),
)
@settings(
    max_examples=20, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
def test_one_height_that_is_not_finite_is_no_touch(sensor, row, column, value):
    class Photometer:
        sensor = SENSOR

        def heights(self, frame):
            heights = np.zeros((SENSOR.rows, SENSOR.columns))
            heights[row, column] = value
            return heights

    sensor._photometer = Photometer()
    with pytest.raises(TouchError, match="NaN or infinite"):
        sensor.read()


def test_a_frame_exposed_before_the_call_is_not_returned(sensor, camera):
    for depth_mm in (0.6, 0.0, 0.9):
        time.sleep(0.05)
        camera.picture = pressed(depth_mm)
        called = time.monotonic()
        cloud = sensor.read()
        assert cloud.stamp.monotonic_s - 0.02 >= called
        assert contact_state(cloud).in_contact == (depth_mm > 0)


def test_unplugging_ends_a_read_at_once_and_for_good(sensor, camera):
    threading.Timer(0.1, lambda: setattr(camera, "failure", "camera was unplugged")).start()
    began = time.monotonic()
    with pytest.raises(TouchError, match="unplugged"):
        while time.monotonic() - began < 5:
            sensor.read()
    poll(lambda: camera.closed)
    with pytest.raises(TouchError, match="unplugged"):
        sensor.check_alive()


def test_a_stall_is_an_error_in_bounded_time(sensor, camera):
    sensor.read()
    camera.stalled = True
    began = time.monotonic()
    with pytest.raises(TouchError, match=r"no fresh frame within 1 s; the last one is \d\.\d+ s"):
        sensor.read()
    assert time.monotonic() - began < 3
    assert "gave no fresh frame within 0." in sensor.check_alive()
    camera.stalled = False
    sensor.read()
    assert sensor.check_alive() == ""


def test_a_frozen_picture_is_no_touch(sensor, camera):
    sensor.read()
    camera.frozen = True
    with pytest.raises(TouchError, match="its picture is frozen"):
        for _ in range(3):  # the first may still be served by a new one
            sensor.read()


@pytest.mark.parametrize(
    ("level", "message"), [(1, "black"), (255, "over-exposed"), (170, "background is another")]
)
def test_a_dark_a_blinding_and_a_changed_light_are_named(sensor, camera, level, message):
    sensor.read()
    camera.picture = np.full_like(GREY, level)
    with pytest.raises(TouchError, match=message):
        sensor.read()
    if level != 170:
        poll(lambda: not is_alive(sensor))
    camera.picture = GREY
    sensor.read()


def test_a_stale_background_is_told_from_something_that_touches(sensor, camera):
    sensor.expect_untouched()
    camera.picture = pressed(0.5)
    with pytest.raises(TouchError, match="nothing should touch: free the gel"):
        sensor.expect_untouched()
    camera.picture = (GREY - 10).astype(np.uint8)  # far too little for a read to notice
    sensor.read()
    with pytest.raises(TouchError, match=r"stale background: 100%.*tacgrasp calibrate background"):
        sensor.expect_untouched()


DRIFTED = (GREY + np.rint(0.05 * LAMPS[:, 0])).astype(np.uint8)
"""An untouched picture whose light has changed by 2 to 4 levels, as by a tilt of 0.05 mm per mm."""


class TestTheContractOnACamera(SensorContract):
    @pytest.fixture(autouse=True)
    def drift(self, camera):
        camera.picture = DRIFTED


def test_heights_are_relative_to_the_last_reference(sensor, camera):
    camera.picture = DRIFTED
    assert np.abs(sensor.read().points_mm[:, 2]).max() > 0.1
    sensor.take_reference()
    assert np.abs(sensor.read().points_mm[:, 2]).max() < 0.03
    camera.picture = (pressed(0.8, x_mm=4.0).astype(int) + DRIFTED - 120).astype(np.uint8)
    state = contact_state(sensor.read())
    assert state.depth_mm == pytest.approx(0.8, abs=0.1)
    assert state.x_mm == pytest.approx(4.0, abs=0.3)


def test_a_reference_is_of_frames_exposed_after_the_call(sensor, camera):
    for picture in (DRIFTED, GREY, DRIFTED):  # one old frame of five would tilt by 0.09 mm
        time.sleep(0.05)
        camera.picture = picture
        sensor.take_reference()
        assert np.abs(sensor.read().points_mm[:, 2]).max() < 0.03


def test_the_untouched_gel_is_compared_with_the_stored_background_after_a_reference(sensor, camera):
    camera.picture = (GREY - 10).astype(np.uint8)
    sensor.take_reference()
    with pytest.raises(TouchError, match="stale background: 100%"):
        sensor.expect_untouched()
    camera.picture = GREY
    sensor.expect_untouched()


def test_a_reference_of_another_light_or_a_moving_picture_is_refused_and_the_old_one_stays(
    sensor, camera, monkeypatch
):
    camera.picture = DRIFTED
    sensor.take_reference()
    camera.picture = np.full_like(GREY, 80)
    with pytest.raises(TouchError, match="half of the frame differs from the background"):
        sensor.take_reference()
    still = camera.next_frame

    def moving():
        still()
        return pressed(0.5, x_mm=(camera.frames % 6) - 3.0)

    monkeypatch.setattr(camera, "next_frame", moving)
    with pytest.raises(TouchError, match="of the picture changed"):
        sensor.take_reference()
    monkeypatch.setattr(camera, "next_frame", still)
    camera.picture = DRIFTED
    begun = camera.frames
    poll(lambda: camera.frames > begun + 3)
    assert np.abs(sensor.read().points_mm[:, 2]).max() < 0.03


def test_a_camera_whose_first_frames_are_dark_is_waited_for(files, camera):
    camera.picture = np.zeros_like(GREY)
    threading.Timer(0.3, lambda: setattr(camera, "picture", GREY)).start()
    gelsight = connect(files, camera)
    gelsight.read()
    gelsight.disconnect()


def test_a_camera_that_gives_nothing_or_black_is_refused_in_time(files, camera):
    camera.picture = np.zeros_like(GREY)
    began = time.monotonic()
    with pytest.raises(TouchError, match="black"):
        connect(files, camera, connect_timeout_s=0.3)
    camera.stalled = True
    with pytest.raises(TouchError, match=r"gave no frame within 0\.3 s"):
        connect(files, camera, connect_timeout_s=0.3)
    assert time.monotonic() - began < 5


def test_gaps_between_frames_are_counted_as_dropped(sensor, camera):
    poll(lambda: sensor.counts().frames > 10)
    before = sensor.counts().dropped
    camera.stalled = True
    time.sleep(0.4)
    camera.stalled = False
    poll(lambda: sensor.counts().dropped > before)
    assert 5 < sensor.counts().interval_ms < 200


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"unit": "other"}, "of unit 'mine', expected 'other'"),
        ({"calibration": Path("missing.safetensors")}, "does not exist"),
        ({"max_calibration_age_days": 0.5}, r"1 days old, expected 0 to 0\.5"),
        ({"background": Path("missing.png")}, "free the gel and take one"),
        ({"max_background_age_h": 1.0}, "was taken 2 h ago, expected 0 to 1 h"),
    ],
)
def test_nothing_is_opened_with_a_wrong_calibration_or_background(files, camera, changed, message):
    with pytest.raises(TouchError, match=message):
        connect(files, camera, **changed)
    assert camera.opened == 0


def test_a_background_of_another_unit_is_refused_beside_the_shipped_calibration(files, camera):
    with pytest.raises(TouchError, match="is of unit 'mine', expected 'other'"):
        connect(files, camera, unit="other", calibration="shipped")


def test_a_background_is_averaged_kept_and_used_again(files, camera):
    background = take_background(settings_of(files), now=lambda: NOW, opener=camera)
    assert background.num_frames == 20
    assert np.abs(background.frame.astype(int) - 120).max() <= 1
    save_background(files / "new.png", background)
    gelsight = connect(files, camera, background=files / "new.png")
    gelsight.expect_untouched()
    gelsight.disconnect()
    (files / "new.png").write_bytes((files / "new.png").read_bytes()[:900])
    with pytest.raises(TouchError, match=r"new\.png"):
        connect(files, camera, background=files / "new.png")


def test_a_background_is_not_taken_of_a_dark_or_missing_picture(files, camera):
    camera.picture = np.zeros_like(GREY)
    with pytest.raises(TouchError, match=r"black.*no background was taken"):
        take_background(settings_of(files), opener=camera)
    camera.failure = "camera was unplugged"
    with pytest.raises(TouchError, match="unplugged"):
        take_background(settings_of(files), opener=camera)


def test_a_check_names_ages_rate_and_what_is_wrong(files, camera):
    findings = {one.name: one for one in check(settings_of(files), now=lambda: NOW, opener=camera)}
    assert all(one.ok for one in findings.values() if one.name != "fresh cloud")  # a busy machine
    assert "1 days old, unit mine" in findings["calibration"].detail
    assert "2.0 h old, 20 frames" in findings["background"].detail
    assert "0 repeated" in findings["fresh cloud"].detail
    camera.picture = pressed(0.6)
    *_, reads = check(settings_of(files), now=lambda: NOW, opener=camera)
    assert not reads.ok and "free the gel" in reads.detail
    (wrong,) = check(settings_of(files, unit="other"), opener=camera)
    assert not wrong.ok
    *_, missing = check(settings_of(files), now=lambda: NOW)
    assert not missing.ok and "no camera /dev/v4l/by-id/mine" in missing.detail


@pytest.fixture
def folder(files):
    images = files / "images"
    images.mkdir()
    for number, depth_mm in enumerate((0.0, 0.3, 0.7)):
        Image.fromarray(pressed(depth_mm)).save(images / f"touch_{number}.png")
    return images


def test_no_image_of_a_recording_is_used_up_to_look_at_the_untouched_gel(files, folder):
    gelsight = connect_gelsight(settings_of(files, device=None, images=folder))
    length = len(list(folder.iterdir()))
    gelsight.expect_untouched()
    for _ in range(length):
        gelsight.read()
    with pytest.raises(TouchError):
        gelsight.read()


def test_the_frame_behind_the_last_cloud_is_kept_for_records_and_viewers(files, folder):
    gelsight = connect_gelsight(settings_of(files, device=None, images=folder))
    assert isinstance(gelsight, CameraSensor)
    assert gelsight.last_frame() is None
    frames = []
    for _ in range(2):
        gelsight.read()
        frames.append(gelsight.last_frame())
    gelsight.disconnect()
    assert frames[0].shape == (240, 320, 3)
    assert not np.array_equal(*frames)


def test_no_image_of_a_recording_is_used_up_for_a_reference(files, folder):
    gelsight = connect_gelsight(settings_of(files, device=None, images=folder))
    gelsight.take_reference()
    states = [contact_state(gelsight.read()) for _ in range(3)]
    assert [state.depth_mm for state in states] == pytest.approx([0.0, 0.3, 0.7], abs=0.1)


def test_a_folder_of_images_is_played_one_a_read_and_ends(files, folder):
    gelsight = connect_gelsight(settings_of(files, device=None, images=folder))
    states = [contact_state(gelsight.read()) for _ in range(3)]
    assert [state.depth_mm for state in states] == pytest.approx([0.0, 0.3, 0.7], abs=0.1)
    with pytest.raises(TouchError, match="ended after 3 reads"):
        gelsight.read()
    gelsight.disconnect()


def test_a_folder_can_be_repeated_and_played_like_a_camera(files, folder):
    settings = settings_of(files, device=None, images=folder, repeat=True, play_hz=30)
    gelsight = connect_gelsight(settings)
    depths = {contact_state(gelsight.read()).depth_mm for _ in range(8)}
    assert len(depths) > 1 and gelsight.counts().frames > 3
    assert gelsight.check_alive() == ""
    gelsight.disconnect()


def test_a_recording_takes_any_background_of_the_same_size(files, folder):
    plain = files / "plain.png"
    Image.fromarray(GREY).save(plain)
    connect_gelsight(settings_of(files, device=None, images=folder, background=plain)).disconnect()
    with pytest.raises(TouchError, match="does not say when"):
        connect_gelsight(settings_of(files, background=plain), now=lambda: NOW)
    Image.fromarray(GREY[:200]).save(plain)
    with pytest.raises(TouchError, match="320 × 200 px, expected 320 × 240"):
        connect_gelsight(settings_of(files, device=None, images=folder, background=plain))


def test_a_video_is_played_and_ends(files):
    cv2 = pytest.importorskip("cv2")
    path = files / "touch.avi"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"MJPG"), 25, (320, 240))
    for depth_mm in (0.0, 0.0, 0.7):
        writer.write(pressed(depth_mm)[..., ::-1])
    writer.release()
    video = settings_of(files, device=None, video=path)
    # compressed colours are off by a level or two: the background has to come from the same video
    save_background(video.background, take_background(video, num_frames=2))
    gelsight = connect_gelsight(video)
    depths = [contact_state(gelsight.read()).depth_mm for _ in range(3)]
    assert depths == pytest.approx([0.0, 0.0, 0.7], abs=0.1)
    with pytest.raises(TouchError, match="ended after 3"):
        gelsight.read()
    gelsight.disconnect()
    again = connect_gelsight(video.model_copy(update={"repeat": True}))
    assert [again.read().grid for _ in range(5)] == [(240, 320)] * 5
    path.write_bytes(b"no video")
    with pytest.raises(TouchError, match="not a video"):
        connect_gelsight(settings_of(files, device=None, video=path))


@pytest.mark.parametrize(
    "changed",
    [
        {"device": None},
        {"images": Path("also")},
        {"play_hz": 10.0},
        {"crop_share": 0.6},
        {"unit": ""},
        {"exposure": 3},
    ],
)
def test_settings_that_do_not_fit_are_refused(tmp_path, changed):
    with pytest.raises(ValueError):
        settings_of(tmp_path, **changed)


@pytest.mark.skipif(not BALLS.is_dir(), reason="no ../shared/data/gelsight_mini_balls")
def test_real_frames_through_the_driver_are_contacts_where_the_balls_are():
    settings = GelSightSettings(images=BALLS, background=BALLS / "background.png", unit="gelslam's")
    gelsight = connect_gelsight(settings)
    names = read_ball_frames(BALLS, SENSOR).names
    heights = dict(frames_heights(BALLS))
    for name in names[:8]:
        state = contact_state(gelsight.read())
        deepest = np.unravel_index(heights[name].argmax(), heights[name].shape)
        x_mm = (deepest[1] - 159.5) * SENSOR.mm_per_px
        y_mm = (119.5 - deepest[0]) * SENSOR.mm_per_px
        assert 0.3 < state.depth_mm < 1.3
        assert (state.x_mm, state.y_mm) == pytest.approx((x_mm, y_mm), abs=0.6)
    gelsight.disconnect()
