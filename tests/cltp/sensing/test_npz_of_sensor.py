"""A .npz file that says which sensor it is of, and what that sensor saw."""

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.sensing.numpy_files import sensor_in_npz
from cltp.sensing.touch_files import read_cloud, read_heights
from cltp.tactile.sensors import SENSORS

MINI, DIGIT = SENSORS["gelsight_mini"], SENSORS["digit"]


def written(path, **arrays):
    np.savez_compressed(path, **arrays)
    return path


def test_a_file_of_another_sensor_is_refused_with_its_name(tmp_path):
    heights = np.zeros((60, 80))
    heights[25:35, 35:45] = 0.4
    path = written(tmp_path / "a.npz", height_mm=heights, sensor=np.str_("digit"))
    with pytest.raises(TouchError, match=r"it is of digit.*--sensor digit"):
        read_cloud(path, MINI)
    assert read_cloud(path, DIGIT).sensor is DIGIT


@pytest.mark.parametrize(
    "sensor", [np.str_("a camera of my own"), np.zeros(3), np.array(["digit"])]
)
def test_a_sensor_that_is_none_of_ours_is_left_to_who_reads(tmp_path, sensor):
    path = written(tmp_path / "a.npz", height_mm=np.full((60, 80), 0.1), sensor=sensor)
    assert read_cloud(path, MINI).sensor is MINI


def test_what_was_seen_counts_before_what_is_true(tmp_path):
    seen = np.zeros((60, 80), dtype=np.float32)
    seen[20:40, 30:50] = 0.3
    path = written(tmp_path / "a.npz", height_mm=np.zeros((60, 80)), seen_mm=seen)
    assert np.array_equal(read_heights(path, MINI), seen)


@pytest.mark.parametrize("data", [b"", b"PK", b"no archive at all"])
def test_what_is_no_archive_names_no_sensor(data):
    assert sensor_in_npz(data) == ""
