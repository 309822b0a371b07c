"""The gel's benchmark reports what it measured, and says what it could not."""

import json

import pytest

from tacgrasp.benchmarks.sensing import gel as bench_gel


def test_the_figures_are_written_under_their_keys(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(bench_gel, "measure", bench_gel.hertz)
    bench_gel.run(tmp_path / "gel.json")
    report = json.loads((tmp_path / "gel.json").read_text())
    assert abs(report["hertz_force_error_percent"]) < 2
    assert abs(report["hertz_radius_error_percent"]) < 2
    assert [figure["key"] for figure in report["figures"]] == [
        "hertz_force_error_percent",
        "hertz_radius_error_percent",
    ]
    assert "Hertz" in capsys.readouterr().out


def test_an_absent_profile_is_not_measured_and_says_where_it_was_sought(tmp_path):
    (figure,) = bench_gel.profiles(tmp_path)
    assert figure.value is None
    assert str(tmp_path) in figure.note


def test_the_volume_lost_is_a_share_of_the_volume_sunk():
    (figure,) = bench_gel.volume()
    assert figure.value == pytest.approx(0.2, abs=0.3)
