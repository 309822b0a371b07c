"""Force over current: the line, its file, and for which gripper and how long it is good."""

import datetime

import pytest

from primitives import RobotError
from tacgrasp.drivers.dynamixel.calibration import (
    ForceReading,
    fit_calibration,
    load_calibration,
    read_readings,
    refusal,
    save_calibration,
)
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings, ServoSettings

DATE = datetime.date(2026, 11, 21)
SETTINGS = DynamixelSettings(
    port="/dev/null",
    unit="left bench",
    model="XM430-W350",
    servos=(ServoSettings(id=1, open_ticks=2000, closed_ticks=1000),),
    open_width_mm=80.0,
    max_current_ma=800.0,
)


def readings(*pairs: tuple[float, float]) -> list[ForceReading]:
    return [ForceReading(current_ma=current, force_n=force) for current, force in pairs]


LINE = readings((20, 0.0), (60, 0.4), (110, 1.4), (160, 2.4), (260, 4.4))  # 0.02 N/mA from 40 mA on


def fitted(**changes):
    calibration = fit_calibration(LINE, SETTINGS, date=DATE, adapter="FT3F", source="a scale")
    return calibration.model_copy(update=changes)


def test_the_line_of_exact_readings_is_found():
    calibration = fitted()
    assert calibration.newtons_per_ma == pytest.approx(0.02)
    assert calibration.friction_ma == pytest.approx(40)
    assert calibration.residual_n == pytest.approx(0, abs=1e-9)
    assert (calibration.num_readings, calibration.max_force_n) == (4, 4.4)  # none pressed at 20 mA


def test_current_and_force_are_each_other_s_inverse():
    calibration = fitted()
    assert calibration.current_ma(2.0) == pytest.approx(140)
    assert calibration.force_n(calibration.current_ma(3.3)) == pytest.approx(3.3)
    assert calibration.force_n(30) == 0


def test_the_residual_is_the_root_mean_square_of_what_is_left():
    off = readings((100, 1.1), (200, 2.9), (300, 5.1), (400, 6.9))  # ±0.1 about 0.02 N/mA
    slope = 0.0196  # by hand: cov 98 / var 5000 per 100 mA
    calibration = fit_calibration(off, SETTINGS, date=DATE)
    assert calibration.newtons_per_ma == pytest.approx(slope)
    assert calibration.residual_n == pytest.approx(0.08944, abs=1e-4)


@pytest.mark.parametrize(
    ("pairs", "match"),
    [
        ([(100, 1.0), (200, 2.0)], "needs 3 or more readings above 0 N"),
        ([(100, 1.0), (100, 1.1), (100, 0.9)], "at different currents"),
        ([(100, 3.0), (200, 2.0), (300, 1.0)], "force falls with current"),
        ([(100, 1.0), (200, 9.0), (300, 2.0), (400, 9.5)], "the readings are on no line"),
    ],
)
def test_readings_that_make_no_line_are_refused(pairs, match):
    with pytest.raises(RobotError, match=match):
        fit_calibration(readings(*pairs), SETTINGS, date=DATE)


@pytest.mark.parametrize(
    ("current", "force"), [(float("nan"), 1.0), (10.0, float("inf")), (-1.0, 1.0), (10.0, -0.1)]
)
def test_a_reading_that_is_none_is_refused(current, force):
    with pytest.raises(RobotError, match="reading"):
        ForceReading(current_ma=current, force_n=force)


def test_what_is_saved_is_loaded_again_and_nothing_else_is_left(tmp_path):
    save_calibration(tmp_path / "gripper.yaml", fitted())
    assert load_calibration(tmp_path / "gripper.yaml") == fitted()
    assert [path.name for path in tmp_path.iterdir()] == ["gripper.yaml"]


def test_a_place_that_can_not_be_written_is_refused(tmp_path):
    with pytest.raises(RobotError, match="can't be written to"):
        save_calibration(tmp_path / "none" / "gripper.yaml", fitted())


@pytest.mark.parametrize(
    ("text", "match"),
    [
        ("[1, 2]", "expected fields"),
        ("date: 2026-02-30\n", "line 1: '2026-02-30' is no possible date"),
        ("unit: a\nunit: b\n", "line 2: unit stands in line 1 already"),
        ("{", "is no calibration"),
        ("unit: a", "model: Field required"),
        ("\x00", "is no calibration"),
    ],
)
def test_a_damaged_file_is_refused_and_says_how_to_mend_it(tmp_path, text, match):
    (tmp_path / "gripper.yaml").write_text(text)
    with pytest.raises(RobotError, match=rf"{match}.*tacgrasp calibrate gripper"):
        load_calibration(tmp_path / "gripper.yaml")


def test_a_missing_file_is_refused(tmp_path):
    with pytest.raises(RobotError, match=r"no calibration of the gripper at .*; make one with"):
        load_calibration(tmp_path / "gripper.yaml")


def test_it_is_good_for_its_own_gripper_until_it_is_too_old():
    last = DATE + datetime.timedelta(days=SETTINGS.max_calibration_age_days)
    assert refusal(fitted(), SETTINGS, adapter="FT3F", today=DATE) == ""
    assert refusal(fitted(), SETTINGS, adapter="FT3F", today=last) == ""
    late = last + datetime.timedelta(days=1)
    assert "91 days old" in refusal(fitted(), SETTINGS, adapter="FT3F", today=late)


def test_an_adapter_that_tells_no_number_is_not_held_against_it():
    assert refusal(fitted(), SETTINGS, adapter="", today=DATE) == ""
    assert refusal(fitted(adapter=""), SETTINGS, adapter="FT3F", today=DATE) == ""


@pytest.mark.parametrize(
    ("changes", "adapter", "name"),
    [
        ({"unit": "right bench"}, "FT3F", "unit is right bench"),
        ({"model": "XC330-T288"}, "FT3F", "model is XC330-T288"),
        ({"ids": (1, 2)}, "FT3F", "ids is"),
        ({}, "FT9Z", "adapter is FT3F"),
    ],
)
def test_a_calibration_of_another_gripper_is_refused(changes, adapter, name):
    why = refusal(fitted(**changes), SETTINGS, adapter=adapter, today=DATE)
    assert f"of another gripper: its {name}" in why


def test_a_calibration_from_the_future_is_refused():
    yesterday = DATE - datetime.timedelta(days=1)
    assert "check this computer's clock" in refusal(
        fitted(), SETTINGS, adapter="FT3F", today=yesterday
    )


def test_readings_are_read_from_csv(tmp_path):
    path = tmp_path / "readings.csv"
    path.write_text("force_n,current_ma,note\n0.4,60,\n1.4,110,steady\n")
    assert read_readings(path) == readings((60, 0.4), (110, 1.4))
    path.write_text("current_ma,force_n\n60,0.4\n", encoding="utf-8-sig")  # as from Excel
    assert read_readings(path) == readings((60, 0.4))


@pytest.mark.parametrize(
    ("text", "match"),
    [
        ("current,force\n1,2\n", "columns current_ma and force_n, got"),
        ("current_ma,force_n\n1,2\nx,3\n", "line 3: expected"),
        ("current_ma,force_n\n1\n", "line 2: expected"),
        ("", "columns current_ma and force_n, got None"),
    ],
)
def test_a_csv_file_that_is_none_is_refused(tmp_path, text, match):
    path = tmp_path / "readings.csv"
    path.write_text(text)
    with pytest.raises(RobotError, match=match):
        read_readings(path)


def test_a_missing_csv_file_is_refused(tmp_path):
    with pytest.raises(RobotError, match="No such file"):
        read_readings(tmp_path / "none.csv")
