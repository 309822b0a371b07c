"""Force calibration: the fit, its file, and every refusal with what to do next."""

import datetime
import json
import math
import re

import pytest

from cltp import TouchError
from cltp.sensing.force_calibration import (
    MAX_LOAD_N,
    ForceLoad,
    check_load_values,
    fit_force,
    force_refusal,
    load_force_calibration,
    save_force_calibration,
)

DAY = datetime.date(2026, 3, 1)


def loads(*pairs):
    return [ForceLoad(load_n=load, read_n=read) for load, read in pairs]


def fitted(*pairs, unit="mini-1", date=DAY):
    return fit_force(loads(*pairs), sensor="gelsight_mini", unit=unit, date=date, source="weights")


GOOD = ((0.5, 0.4), (1.0, 0.8), (2.0, 1.6), (5.0, 4.0))


def test_loads_on_a_line_give_its_slope_and_no_spread():
    calibration = fitted(*GOOD)
    assert calibration.factor == pytest.approx(1.25)
    assert calibration.spread == pytest.approx(0.0, abs=1e-9)
    assert calibration.residuals == pytest.approx((0, 0, 0, 0))


def test_the_spread_is_the_standard_deviation_of_the_relative_residuals():
    calibration = fitted((1, math.exp(0.1)), (2, 2.0), (4, 4 * math.exp(-0.1)))
    assert calibration.factor == pytest.approx(1.0)
    assert calibration.spread == pytest.approx(0.1)  # sqrt(2 · 0.01 / (3 - 1))
    assert calibration.residuals[0] == pytest.approx(math.exp(0.1) - 1)


def test_the_scale_names_unit_and_day():
    scale = fitted(*GOOD).scale
    assert (scale.factor, scale.source) == (pytest.approx(1.25), "mini-1, 2026-03-01")
    assert scale.is_calibrated


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ([], r"3 to 50 loads, got 0 \(none\); give more"),
        ([1, 5], r"3 to 50 loads, got 2 \(1 5\); give more"),
        ([1, 5, 2], "loads must rise, got 1 5 2; give each once"),
        ([1, 1, 5], "loads must rise, got 1 1 5"),
        ([0, 1, 5], r"0\.01 to 100 N, got 0 1 5; give newtons"),
        ([-1, 1, 5], "got -1 1 5; give newtons"),
        ([1, 2, math.nan], "got 1 2 nan; give newtons"),
        ([1, 2, 2 * MAX_LOAD_N], "to 100 N, got 1 2 200"),
        ([1, 2, 2.5], "3 times the smallest .* got 1 2 2.5; spread them"),
    ],
)
def test_loads_are_refused_in_one_line_that_says_what_to_do(values, message):
    with pytest.raises(TouchError, match=message) as caught:
        check_load_values(values)
    assert "\n" not in str(caught.value)
    with pytest.raises(TouchError, match=message):
        fitted(*((value, 1.0 + n) for n, value in enumerate(values)))


@pytest.mark.parametrize(
    ("pairs", "message"),
    [
        (((1, 1), (2, 0.9), (5, 4)), "must rise with the load.*at 1 N and 0.9 N at 2 N; seat"),
        (((1, 0), (2, 2), (5, 5)), "at 1 N the sensor reads 0 N.*middle of the pad"),
        (((1, math.nan), (2, 2), (5, 5)), "at 1 N the sensor reads nan N"),
        (((1, 2), (2, 2.1), (5, 2.2)), r"residual of 76%.*worst at 5 N.*clean the pad"),
        (((1, 30), (2, 60), (5, 150)), "0.0333 times what is read.*check that loads are in newt"),
    ],
)
def test_readings_that_make_no_calibration_are_refused(pairs, message):
    with pytest.raises(TouchError, match=message) as caught:
        fitted(*pairs)
    assert "\n" not in str(caught.value)


def test_a_file_gives_back_what_was_written(tmp_path):
    path, calibration = tmp_path / "force.json", fitted((0.5, 0.41), (1, 0.78), (5, 4.1))
    save_force_calibration(path, calibration)
    assert load_force_calibration(path) == calibration
    assert json.loads(path.read_text())["version"] == 1


def changed(**values):
    def change(record):
        return record | values

    return change


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (changed(factor=1.3), "factor is 1.3, its loads give 1.25: it was changed by hand"),
        (changed(spread=0.2), "spread is 0.2"),
        (changed(version=2), "version 2, expected 1"),
        (changed(kind="other"), "expected JSON of kind tacgrasp-force-calibration"),
        (changed(date="01.03.2026"), "date must be like 2026-01-31"),
        (changed(unit=7), "unit must be str, got '7'"),
        (changed(factor="1.25"), "factor must be float"),
        (changed(factor=10**400), "factor must be float"),
        (changed(unit="a\nb"), "unit must be one line"),
        (changed(source=201 * "x"), "source must be one line of at most 200"),
        (changed(extra=1), "expected the fields sensor, unit"),
        (changed(loads=[]), "needs 3 to 50 loads"),
        (changed(loads=[1, 2, 3]), "expected the fields load_n, read_n"),
        (changed(loads="many"), "loads must be a list"),
        (lambda record: [], "expected JSON of kind"),
        (lambda record: {k: v for k, v in record.items() if k != "unit"}, "expected the fields"),
    ],
)
def test_a_changed_file_is_refused_with_the_command_that_makes_a_new_one(tmp_path, change, message):
    path = tmp_path / "force.json"
    save_force_calibration(path, fitted(*GOOD))
    path.write_text(json.dumps(change(json.loads(path.read_text()))))
    with pytest.raises(TouchError, match=message) as caught:
        load_force_calibration(path)
    assert str(path) in str(caught.value)
    assert "tacgrasp calibrate force" in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"{",
        b"\xff\xfe",
        b'{"a": 1, "a": 2}',
        b'{"factor": NaN}',
        b"[" * 100_000,
        b" " * 200_000,
    ],
)
def test_a_damaged_file_is_refused(tmp_path, data):
    path = tmp_path / "force.json"
    path.write_bytes(data)
    with pytest.raises(TouchError, match="force calibration") as caught:
        load_force_calibration(path)
    assert "\n" not in str(caught.value)


def test_a_cut_file_is_refused_at_every_length(tmp_path):
    path = tmp_path / "force.json"
    save_force_calibration(path, fitted(*GOOD))
    data = path.read_bytes()
    for length in range(0, len(data) - 2, 7):
        path.write_bytes(data[:length])
        with pytest.raises(TouchError, match="is no force calibration"):
            load_force_calibration(path)


def test_a_missing_file_is_named_with_the_command(tmp_path):
    with pytest.raises(TouchError, match=r"no force calibration at .*tacgrasp calibrate force"):
        load_force_calibration(tmp_path / "none.json")


@pytest.mark.parametrize(
    ("sensor", "unit", "today", "message"),
    [
        ("gelsight_mini", "mini-1", DAY, ""),
        ("gelsight_mini", "mini-1", DAY + datetime.timedelta(180), ""),
        ("gelsight_mini", "mini-2", DAY, "another unit: of mini-1, this one is mini-2"),
        ("digit", "mini-1", DAY, "another sensor: of gelsight_mini, this one is digit"),
        ("gelsight_mini", "mini-1", DAY + datetime.timedelta(181), "181 days old, at most 180"),
        ("gelsight_mini", "mini-1", DAY - datetime.timedelta(1), "after today .*clock"),
    ],
)
def test_another_unit_sensor_or_day_is_refused(sensor, unit, today, message):
    refusal = force_refusal(fitted(*GOOD), sensor=sensor, unit=unit, today=today)
    assert bool(refusal) == bool(message)
    assert re.search(message, refusal)
