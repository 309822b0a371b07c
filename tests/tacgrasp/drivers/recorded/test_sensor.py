"""A sensor that plays an episode or a folder: in order, stamped now, and with an end."""

import time

import numpy as np
import pytest
from PIL import Image

from cltp.errors import TouchError
from cltp.tactile.cloud import TactileCloud, cloud_from_heights
from cltp.tactile.sensors import SENSORS
from primitives.devices import GripperState, Pose
from tacgrasp.drivers.recorded.sensor import check, connect_recorded
from tacgrasp.drivers.recorded.settings import RecordedSettings
from tacgrasp.drivers.stamps import real_stamp
from tacgrasp.episodes import EpisodeHeader, EpisodeWriter, StepPhase, StepRecord

SENSOR = SENSORS["gelsight_mini"]


def heights(level_mm):
    bump = np.zeros((60, 80))
    bump[20:40, 30:50] = level_mm
    return bump


def depth(cloud):
    return round(float(cloud.points_mm[:, 2].max()), 3)


@pytest.fixture
def folder(tmp_path):
    for number in (10, 2, 1):  # played as a person counts
        np.save(tmp_path / f"touch_{number}.npy", heights(0.1 * number))
    (tmp_path / "notes.txt").write_text("not a touch")
    return tmp_path


@pytest.fixture
def episode(tmp_path):
    path = tmp_path / "episode.mcap"
    stamp = real_stamp()
    header = EpisodeHeader(
        task="strawberry", instruction="hold it", policy="rules", seed=0, sensor=SENSOR,
        config_yaml="task: strawberry\n", versions={"tacgrasp": "0.1.0"}, stamp=stamp,
    )  # fmt: skip
    with EpisodeWriter(path, header) as writer:
        for index in range(3):
            rng = np.random.default_rng(index)
            writer.write_step(
                StepRecord(
                    index=index, phase=StepPhase.LOOP, decision=None, executed=None, stamp=stamp,
                    cloud=cloud_from_heights(heights(0.2 * index), SENSOR, rng=rng, stamp=stamp),
                    tcp_pose=Pose(position_m=np.zeros(3), rotvec_rad=np.zeros(3)),
                    gripper=GripperState(width_m=0.03, force_n=1.0, closed=True), step_ms=1.0,
                )
            )  # fmt: skip
    return path


def test_a_folder_is_played_as_a_person_counts_and_ends(folder):
    sensor = connect_recorded(RecordedSettings(path=folder))
    assert [depth(sensor.read()) for _ in range(3)] == [0.1, 0.2, 1.0]
    assert sensor._num_played == sensor.length == 3
    for _ in range(2):
        with pytest.raises(TouchError, match="has ended after 3 reads"):
            sensor.read()


def test_a_recording_can_be_repeated(folder):
    sensor = connect_recorded(RecordedSettings(path=folder, repeat=True))
    assert [depth(sensor.read()) for _ in range(4)] == [0.1, 0.2, 1.0, 0.1]


def test_an_episode_is_played_bit_for_bit_with_the_time_of_playing(episode):
    sensor = connect_recorded(RecordedSettings(path=episode))
    for index in range(3):
        before = time.monotonic()
        cloud = sensor.read()
        rng = np.random.default_rng(index)
        recorded = cloud_from_heights(heights(0.2 * index), SENSOR, rng=rng)
        np.testing.assert_array_equal(cloud.points_mm, recorded.points_mm)
        assert cloud.stamp.monotonic_s >= before
    with pytest.raises(TouchError, match="has ended"):
        sensor.read()


def test_clouds_keep_all_their_points(tmp_path):
    dense = cloud_from_heights(heights(0.5), SENSOR, num_points=4096)
    np.save(tmp_path / "dense.npy", dense.points_mm)
    cloud = connect_recorded(RecordedSettings(path=tmp_path)).read()
    assert cloud.points_mm.shape == (4096, 3) and depth(cloud) == 0.5


def test_frames_are_read_with_the_background_beside_them(tmp_path):
    grey = np.full((240, 320, 3), 120, dtype=np.uint8)
    for name in ("background", "touch_1"):
        Image.fromarray(grey).save(tmp_path / f"{name}.png")
    sensor = connect_recorded(RecordedSettings(path=tmp_path))
    assert sensor.length == 1 and isinstance(sensor.read(), TactileCloud)
    (tmp_path / "background.png").unlink()
    with pytest.raises(TouchError, match="--background"):
        connect_recorded(RecordedSettings(path=tmp_path)).read()


def test_a_disconnected_recording_plays_no_more(folder):
    sensor = connect_recorded(RecordedSettings(path=folder))
    assert sensor.check_alive() == ""
    sensor.disconnect(), sensor.disconnect()
    for call in (sensor.read, sensor.check_alive):
        with pytest.raises(TouchError, match="disconnected"):
            call()


def test_what_is_no_recording_is_refused(tmp_path, episode, folder):
    other = tmp_path / "other.mcap"
    other.write_bytes(b"not an episode")
    empty = tmp_path / "empty"
    empty.mkdir()
    for path, message in [
        (tmp_path / "none", "no recording"),
        (folder / "notes.txt", "no recording"),
        (other, r"other\.mcap"),
        (empty, "holds no clouds"),
    ]:
        with pytest.raises(TouchError, match=message):
            connect_recorded(RecordedSettings(path=path))
    with pytest.raises(TouchError, match="recorded with gelsight_mini, expected digit"):
        connect_recorded(RecordedSettings(path=episode, sensor="digit"))
    with pytest.raises(TouchError, match="unknown sensor"):
        connect_recorded(RecordedSettings(path=episode, sensor="nose"))


def test_a_check_reads_every_touch_once(folder):
    (finding,) = check(RecordedSettings(path=folder, repeat=True))
    assert (
        finding.ok and "3 recorded clouds" in finding.detail and "nothing is felt" in finding.detail
    )
    (folder / "touch_3.npy").write_bytes(b"damaged")
    (finding,) = check(RecordedSettings(path=folder))
    assert not finding.ok and "touch_3.npy" in finding.detail
