"""The force calibration that a rig's file names: loaded, refused, checked, carried by clouds."""

import datetime
import re
from dataclasses import replace

import numpy as np
import pytest

from cltp import TouchError
from cltp.sensing.force_calibration import ForceLoad, fit_force, save_force_calibration
from cltp.tactile.force_scale import UNCALIBRATED
from tacgrasp.drivers.force_scale import (
    force_finding,
    force_scale_of,
    uncalibrated_refusal,
)
from tacgrasp.drivers.recorded.sensor import connect_recorded
from tacgrasp.drivers.recorded.settings import RecordedSettings
from tacgrasp.drivers.taxels.settings import TaxelSettings
from tests.fakes.episode_samples import record, step_record

DAY = datetime.date(2026, 3, 1)


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "force.json"
    loads = [ForceLoad(load_n=x, read_n=0.8 * x) for x in (0.5, 1.0, 2.0)]
    save_force_calibration(
        path, fit_force(loads, sensor="gelsight_mini", unit="mini-1", date=DAY, source="weights")
    )
    return path


def taxels(**changes):
    return TaxelSettings(port="/dev/null", **({"unit": "mini-1"} | changes))


def test_the_file_s_factor_is_the_scale_and_no_file_is_uncalibrated(path):
    assert force_scale_of(taxels(force_calibration=path), lambda: DAY).factor == pytest.approx(1.25)
    assert force_scale_of(taxels()) is UNCALIBRATED


BAD = {
    "another unit": ({"unit": "mini-2"}, 0, "of another unit: of mini-1, this one is mini-2"),
    "another sensor": ({"sensor": "digit"}, 0, "of another sensor: of gelsight_mini"),
    "old": ({}, 181, "181 days old, at most 180"),
    "older than the rig allows": ({"max_force_calibration_age_days": 30.0}, 31, "at most 30"),
    "of the future": ({}, -1, "after today"),
}


@pytest.mark.parametrize("name", BAD)
def test_a_calibration_that_does_not_fit_is_refused_and_doctor_names_the_command(path, name):
    changes, days, message = BAD[name]
    settings = taxels(force_calibration=path, **changes)
    day = DAY + datetime.timedelta(days)
    with pytest.raises(TouchError, match=re.escape(message)) as caught:
        force_scale_of(settings, lambda: day)
    assert str(path) in str(caught.value)
    found = force_finding(settings, lambda: day)
    assert not found.ok
    assert message in found.detail
    assert "tacgrasp calibrate force" in found.advice


def test_doctor_warns_of_a_missing_calibration_and_shows_a_good_one(path):
    missing = force_finding(taxels())
    assert (missing.ok, missing.detail) == (False, "none: forces are uncalibrated, -26 to +35 %")
    assert "tacgrasp calibrate force" in missing.advice
    good = force_finding(taxels(force_calibration=path), lambda: DAY + datetime.timedelta(3))
    assert good.ok
    assert good.detail == "mini-1, 3 days old, factor 1.250 ± 0.0% from 3 loads"


def test_only_a_sensor_without_a_calibration_may_not_grasp(path):
    assert uncalibrated_refusal(taxels(force_calibration=path)) == ""
    assert "tacgrasp calibrate force" in uncalibrated_refusal(taxels())


def test_a_played_episode_keeps_its_scale_unless_the_rig_s_file_names_another(tmp_path, path):
    step = step_record(0)
    scale = replace(UNCALIBRATED, factor=1.4, source="then")
    record(tmp_path / "e.mcap", [replace(step, cloud=replace(step.cloud, force_scale=scale))])
    settings = RecordedSettings(path=tmp_path / "e.mcap", unit="mini-1")
    assert connect_recorded(settings).read().force_scale == scale
    named = settings.model_copy(
        update={"force_calibration": path, "max_force_calibration_age_days": 9999.0}
    )
    assert connect_recorded(named).read().force_scale.factor == pytest.approx(1.25)


def test_a_played_folder_is_uncalibrated(tmp_path):
    folder = tmp_path / "touches"
    folder.mkdir()
    np.save(folder / "touch_1.npy", np.zeros((60, 80)))
    assert connect_recorded(RecordedSettings(path=folder)).read().force_scale == UNCALIBRATED
