"""Figures of bench gain from samples made by hand, and one rig."""

import math

import pytest

from tacgrasp.__main__ import main
from tacgrasp.benchmarks.loop.gain import GainSample, measure, summary


def sample(errors, held=True):
    logs = tuple(math.log1p(each) for each in errors)
    return GainSample(
        gain=1.3, of_sensor=logs, of_truth=logs, held=(held,) * len(logs), residual=0.04
    )


def test_nine_in_ten_errors_are_held_against_the_limits():
    good = [sample((0.2, 0.09, 0.04))] * 9
    figures = summary([*good, sample((0.5, 0.5, 0.5), held=False)])
    assert figures["keeps_limits"]
    assert figures["after_grips"]["2"]["of_sensor"]["p90"] == pytest.approx(0.09)
    assert figures["after_grips"]["5"]["interval_holds"] == pytest.approx(0.9)
    assert figures["calibration_residual"] == pytest.approx(0.04)
    assert not summary([*good[:8], *[sample((0.2, 0.09, 0.06))] * 2])["keeps_limits"]
    assert not summary([*good[:8], *[sample((0.2, -0.11, 0.04))] * 2])["keeps_limits"]


def test_a_rig_is_measured_with_its_hidden_gain():
    found = measure("strawberry", "gelsight_mini", 3)
    assert found.gain == pytest.approx(1.66, abs=0.01)
    assert all(abs(each) < 0.3 for each in found.of_sensor)
    assert found.of_truth != found.of_sensor


def test_rigs_of_one_task_are_not_gone_on_with_as_those_of_another(tmp_path, capsys):
    path = tmp_path / "gain.json"
    argv = ["bench", "gain", "--episodes", "2", "--json", str(path)]
    main([*argv, "--task", "strawberry"])
    assert main([*argv, "--task", "egg", "--resume"]) == 2
    assert "task" in capsys.readouterr().err
