"""Sources and backgrounds of a GelSight Mini, without a camera."""

import datetime

import numpy as np
import pytest
from PIL import Image

from cltp.errors import TouchError
from cltp.tactile.sensors import SENSORS
from tacgrasp.drivers.gelsight.background import (
    Background,
    average_frames,
    load_background,
    mismatch,
    save_background,
)
from tacgrasp.drivers.gelsight.cameras import CameraSource, fit_to_sensor, frame_problem

SENSOR = SENSORS["gelsight_mini"]
NOW = datetime.datetime(2026, 2, 1, 12, tzinfo=datetime.UTC)


class Capture:
    """Stands for ``cv2.VideoCapture``: gives what a test lists, None for a failed read."""

    def __init__(self, images, opened=True):
        self.images, self.opened, self.released = list(images), opened, False

    def isOpened(self):  # noqa: N802
        return self.opened

    def read(self):
        image = self.images.pop(0) if self.images else None
        return image is not None, image

    def release(self):
        self.released = True


def image(height=480, width=640):
    picture = np.zeros((height, width, 3), dtype=np.uint8)
    picture[:] = (10, 20, 200)  # blue, green, red
    return picture


def camera(images, device=0, crop_share=1 / 7, **changed):
    capture = Capture(images, **changed)
    return CameraSource(device, SENSOR, crop_share, opener=lambda _: capture)


def test_frames_come_in_red_green_blue_and_fill_the_map():
    frame = camera([image()]).next_frame()
    assert frame.shape == (240, 320, 3) and frame.dtype == np.uint8
    assert frame[0, 0].tolist() == [200, 20, 10]


def test_a_frame_is_cropped_alike_on_all_sides():
    picture = np.zeros((480, 640, 3), dtype=np.uint8)
    picture[69:411, 91:549] = 100  # what a seventh off each side leaves
    assert fit_to_sensor(picture, SENSOR, 1 / 7).min() == 100
    assert fit_to_sensor(picture, SENSOR, 1 / 8).min() == 0


def test_a_frame_of_the_maps_size_is_left_as_it_is():
    picture = np.random.default_rng(0).integers(0, 255, (240, 320, 3), dtype=np.uint8)
    np.testing.assert_array_equal(fit_to_sensor(picture, SENSOR, 1 / 7), picture)


@pytest.mark.parametrize("shape", [(480, 480, 3), (200, 300, 3), (240, 320)])
def test_a_frame_that_can_not_fill_the_map_is_refused(shape):
    with pytest.raises(TouchError, match="frame"):
        fit_to_sensor(np.zeros(shape, dtype=np.uint8), SENSOR, 1 / 7)


def test_single_failed_reads_are_survived_and_several_are_the_end():
    source = camera([None, image(), None, None, image(), None, None, None])
    source.next_frame(), source.next_frame()
    with pytest.raises(TouchError, match="gives no frames any more"):
        source.next_frame()


def test_a_camera_whose_name_goes_is_unplugged(tmp_path):
    device = tmp_path / "usb-GelSight_Mini"
    device.touch()
    source = camera([image(), None], device=str(device))
    source.next_frame()
    device.unlink()
    with pytest.raises(TouchError, match="was unplugged"):
        source.next_frame()


def test_a_missing_and_a_busy_camera_are_refused(tmp_path):
    with pytest.raises(TouchError, match=r"no camera .*is it plugged in"):
        camera([], device=str(tmp_path / "none"))
    with pytest.raises(TouchError, match="can't be opened: another program"):
        camera([], opened=False)


def test_the_real_opener_says_that_there_is_no_such_camera():
    pytest.importorskip("cv2")
    with pytest.raises(TouchError, match="can't be opened"):
        CameraSource(97, SENSOR, 1 / 7)


def test_dark_and_over_exposed_frames_are_told_from_good_ones():
    good = np.full((240, 320, 3), 90, dtype=np.uint8)
    assert frame_problem(good) == ""
    assert "black" in frame_problem(good // 20)
    bright = good.copy()
    bright[:120, :, 0] = 255
    assert "50% of the frame is over-exposed" in frame_problem(bright)


def test_a_background_is_the_mean_of_still_frames():
    rng = np.random.default_rng(0)
    frames = [rng.integers(95, 106, (240, 320, 3), dtype=np.uint8) for _ in range(16)]
    background = average_frames(frames, SENSOR, "mine", NOW)
    assert abs(background.frame.mean() - 100) < 0.5 and background.frame.std() < 1.2
    moved = [frame.copy() for frame in frames]
    for frame in moved[8:]:
        frame[:60, :80] += 20
    with pytest.raises(TouchError, match="changed while the background was taken"):
        average_frames(moved, SENSOR, "mine", NOW)
    with pytest.raises(TouchError, match="2 frames or more"):
        average_frames(frames[:1], SENSOR, "mine", NOW)


def test_a_background_keeps_unit_and_date_and_stays_an_image(tmp_path):
    path = tmp_path / "background.png"
    frame = np.full((240, 320, 3), 80, dtype=np.uint8)
    save_background(path, Background(frame=frame, unit="mine", taken=NOW, num_frames=7))
    assert Image.open(path).size == (320, 240)
    later = NOW + datetime.timedelta(hours=5)
    read = load_background(path, SENSOR, unit="mine", max_age_h=6, now=later, dated=True)
    assert (read.unit, read.taken, read.num_frames, read.age_h(later)) == ("mine", NOW, 7, 5.0)
    np.testing.assert_array_equal(read.frame, frame)
    assert [p.name for p in tmp_path.iterdir()] == ["background.png"]
    for hours in (7, -2):  # too old; from the future
        with pytest.raises(TouchError, match=f"taken {hours} h ago"):
            now = NOW + datetime.timedelta(hours=hours)
            load_background(path, SENSOR, unit="mine", max_age_h=6, now=now, dated=True)


def test_a_background_that_would_lose_its_date_is_not_written(tmp_path):
    frame = np.full((240, 320, 3), 80, dtype=np.uint8)
    for name, taken in (("background.jpg", NOW), ("background.png", None)):
        with pytest.raises(TouchError, match="with its date"):
            save_background(
                tmp_path / name, Background(frame=frame, unit="mine", taken=taken, num_frames=7)
            )


def test_a_damaged_record_is_refused(tmp_path):
    from PIL.PngImagePlugin import PngInfo

    path = tmp_path / "background.png"
    for text in ("no json", '{"version": 1}', '{"version": 2, "taken": "2026-02-01T00:00:00Z"}'):
        info = PngInfo()
        info.add_text("tacgrasp_background", text)
        picture = Image.fromarray(np.full((240, 320, 3), 80, dtype=np.uint8))
        picture.save(path, pnginfo=info)
        with pytest.raises(TouchError, match="can't be understood"):
            load_background(path, SENSOR, unit="mine", max_age_h=6, now=NOW, dated=True)


def test_dust_is_forgiven():
    frame = np.full((240, 320, 3), 80, dtype=np.uint8)
    dusty = frame.copy()
    dusty[100:110, 100:110] = 20
    assert mismatch(dusty, frame) == ""
