"""A unit's slip calibration: its noise, its threshold, and its file."""

import datetime
import json
from dataclasses import replace

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.tactile.sensors import sensor_named
from cltp.tactile.shear.slip import slip_model
from cltp.tactile.shear.slip_calibration import (
    MARGIN,
    calibrate_slip,
    load_slip_calibration,
    load_unit_slip,
    save_slip_calibration,
)
from tests.cltp.tactile.shear.test_slip import field_of

TAXELS = sensor_named("taxels")
NAMED = {"sensor": "taxels", "unit": "u", "date": "2026-11-23"}


def frames(count, noise_mm=0.004, along_mm=(0.01, 0.0)):
    rng = np.random.default_rng(1)
    return [
        field_of(TAXELS, along_mm=along_mm, noise=noise_mm * rng.standard_normal((144, 3)))
        for _ in range(count)
    ]


@pytest.fixture(scope="module")
def found():
    return calibrate_slip(frames(100), frames(10), **NAMED)


def test_it_measures_the_noise_and_stands_above_every_score_of_the_hold(found):
    assert found.along_mm == pytest.approx(0.004, rel=0.05)
    assert found.depth_mm == pytest.approx(0.004, rel=0.05)
    assert found.num_frames == 110
    largest = max(slip_model("taxels").threshold, found.largest_score + MARGIN)
    assert found.threshold == largest


def test_it_reads_back_as_written(found, tmp_path):
    save_slip_calibration(tmp_path / "c.json", found)
    assert load_slip_calibration(tmp_path / "c.json", "taxels") == found


def test_a_hold_of_nothing_is_refused():
    nothing = [replace(each, displacement_mm=-0.01 * np.ones((144, 3))) for each in frames(10)]
    with pytest.raises(TouchError, match="nothing was touched"):
        calibrate_slip(nothing, [], **NAMED)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"kind": "another"}, "expected JSON of kind"),
        ({"version": 9}, "another version"),
        ({"more": 1}, "changed"),
        ({"sensor": "gelsight_mini_markers"}, "this sensor is taxels"),
        ({"threshold": "high"}, "threshold is 'high'"),
        ({"threshold": -99.0}, "above the largest score"),
        ({"along_mm": -1.0}, "noise of 0 or more"),
        ({"date": "long ago"}, "date is 'long ago'"),
        ({"threshold": 1e6}, "threshold is 1e"),
    ],
)
def test_a_file_that_is_not_one_of_this_sensor_is_refused(found, tmp_path, change, message):
    path = tmp_path / "c.json"
    save_slip_calibration(path, found)
    path.write_text(json.dumps(json.loads(path.read_text()) | change))
    with pytest.raises(TouchError, match=message):
        load_slip_calibration(path, "taxels")


@pytest.mark.parametrize(
    ("unit", "days", "message"),
    [("another", 0, "of unit 'u', this one is 'another'"), ("u", 181, "181 days"), ("u", -1, "-1")],
)
def test_another_unit_s_an_old_and_a_future_one_are_refused(found, tmp_path, unit, days, message):
    path, day = tmp_path / "c.json", datetime.date.fromisoformat(NAMED["date"])
    save_slip_calibration(path, found)
    assert load_unit_slip(path, sensor="taxels", unit="u", today=day) == found
    today = day + datetime.timedelta(days=days)
    with pytest.raises(TouchError, match=message):
        load_unit_slip(path, sensor="taxels", unit=unit, today=today)


@pytest.mark.parametrize("content", [None, b"", b"{", b"\xff"])
def test_a_missing_or_damaged_file_names_the_remedy(tmp_path, content):
    path = tmp_path / "c.json"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(TouchError, match="tacgrasp calibrate slip"):
        load_slip_calibration(path, "taxels")
