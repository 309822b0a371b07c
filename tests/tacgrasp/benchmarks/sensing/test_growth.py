"""``tacgrasp bench growth``: what a reflex feels of a force that has changed."""

import json

import pytest

from cltp.tactile.sensors import SENSORS
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.sensing.growth import GrowthSample, figures_of, fitted_power, run
from tacgrasp.benchmarks.settings import GrowthSettings


def sample(growth, true_growth):
    return GrowthSample(
        body="egg",
        rest_n=0.5,
        now_n=0.5 * true_growth,
        felt_n=0.5,
        growth=growth,
        is_cut=False,
        read_ms=0.1,
    )


def test_the_fitted_power_is_that_of_grown_contacts_alone():
    grown = [sample(true**0.5, true) for true in (1.5, 2.0, 3.0)]
    assert fitted_power([*grown, sample(0.9, 0.5)], in_use=1.0) == pytest.approx(2.0)
    assert fitted_power([sample(0.9, 0.5)], in_use=1.0) is None


def test_errors_are_logarithms_by_group():
    figures = figures_of([sample(2.0, 2.0), sample(1.2, 1.0)], SENSORS["taxels"])
    assert figures["groups"]["2 to 3 times"]["ln_growth"]["p50"] == pytest.approx(0.0)
    assert figures["groups"]["the same"]["ln_felt"]["p50"] == pytest.approx(0.182, abs=0.001)
    assert "weaker, below 0.8" not in figures["groups"]


def test_a_run_of_a_few_contacts(tmp_path, capsys):
    path = tmp_path / "growth.json"
    run(GrowthSettings(contacts=8, json=path))
    figures = json.loads(path.read_text())
    assert figures["groups"]["all"]["contacts"] >= 4
    assert abs(figures["groups"]["all"]["ln_growth"]["p50"]) < 0.2
    assert "in use 1" in capsys.readouterr().out


def test_a_sensor_without_shear_is_refused():
    with pytest.raises(UsageError, match="measures no shear"):
        run(GrowthSettings(contacts=1, sensor="gelsight_mini"))
