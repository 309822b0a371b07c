"""The gel's benchmark reports what it measured, and says what it could not."""

import json

import pytest
import torch

from tacgrasp.benchmarks.sensing import gel as bench_gel
from tacgrasp.benchmarks.settings import GelSettings


def test_the_figures_are_written_under_their_keys(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(bench_gel, "measure", lambda _data: bench_gel.hertz())
    bench_gel.run(GelSettings(json=tmp_path / "gel.json"))
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


def test_the_volume_lost_is_what_the_layer_s_bulk_compliance_gives():
    (figure,) = bench_gel.volume()
    h_mm, young_mpa, nu, force_n = 2.0, 0.145, 0.4999, 1.0
    lost_mm3 = h_mm * (1 - 2 * nu) * (1 + nu) / (young_mpa * (1 - nu)) * force_n
    material = bench_gel.GelMaterial(thickness_mm=h_mm, young_mpa=young_mpa, poisson=nu)
    gap = bench_gel._ball(4.0, 241, 241, 0.4)
    press = bench_gel._square(material, 241, 0.4).press_to_force(gap, torch.tensor(force_n))
    sunk_mm3 = press.height_mm.clamp(min=0).sum().item() * 0.4**2
    assert figure.value == pytest.approx(100 * lost_mm3 / sunk_mm3, rel=0.1)
