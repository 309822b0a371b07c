"""The benchmark of the data set's cost measures what it says."""

import json
import sys

import pytest

from sim.tcl3d import series as tcl3d
from tacgrasp.__main__ import main
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.learning import tcl3d as bench_tcl3d


def test_every_stage_is_timed_and_every_convolution_counted():
    made = bench_tcl3d.make([0, 1], grid=(60, 80))
    assert made.contacts == 2 * tcl3d.LOADS
    assert all(made.stage_s[stage] > 0 for stage in bench_tcl3d.STAGES[:3])
    # At least one there and back for each contact, and one for its surface.
    assert sum(made.transforms.values()) >= 3 * made.contacts
    assert max(rows for _, rows, _ in made.transforms) >= 2 * 60 - 1
    assert (tcl3d.ROWS, tcl3d.COLUMNS) == (75, 100)


def test_a_floor_lies_below_what_was_measured():
    made = bench_tcl3d.make([0], grid=(120, 160))
    floors = bench_tcl3d.floors_ms(made, repeats=2)
    assert floors["solve"] > 0
    assert floors["caption"] == 0


def test_a_power_is_found_again():
    assert bench_tcl3d._slope([1.0, 2.0, 4.0], [3.0, 12.0, 48.0]) == pytest.approx(2)


def test_tacto_that_is_not_there_is_said_so():
    with pytest.raises(UsageError, match="TACTO does not run"):
        bench_tcl3d.tacto_frame(sys.executable)


def test_the_report_holds_the_figures_and_the_limit_decides(tmp_path, monkeypatch, capsys):
    made = bench_tcl3d.make([0], grid=(60, 80))
    monkeypatch.setattr(bench_tcl3d, "throughput", lambda *args: (39.0, [made]))
    powers = dict.fromkeys(("contacts_exponent", "pixels_exponent_of_n_log_n"), 1.0)
    names = ("rms_um_p50", "rms_um_max", "worst_um_p50", "worst_um_max", "area_points_max")
    monkeypatch.setattr(bench_tcl3d, "exponents", lambda series: powers)
    monkeypatch.setattr(bench_tcl3d, "shortcut_error_um", lambda series: dict.fromkeys(names, 0.1))
    report = tmp_path / "tcl3d.json"
    flags = ["bench", "tcl3d", "--series", "4", "--json", str(report)]
    assert main(flags) == 1
    figures = json.loads(report.read_text())
    assert figures["contacts_per_s"] == 39.0
    assert figures["solve_ms"] > 0
    assert "contacts a second" in capsys.readouterr().out
    monkeypatch.setattr(bench_tcl3d, "throughput", lambda *args: (41.0, [made]))
    assert main(flags) == 0


def test_the_shortcut_is_compared_with_the_whole_grid(monkeypatch):
    monkeypatch.setattr(bench_tcl3d, "ROWS", 120)
    monkeypatch.setattr(bench_tcl3d, "COLUMNS", 160)
    error = bench_tcl3d.shortcut_error_um(1)
    assert 0 < error["rms_um_max"] < 0.5
    assert error["worst_um_max"] < 5


def test_too_few_series_are_refused(capsys):
    assert main(["bench", "tcl3d", "--series", "1"]) == 2
    assert "twice as many" in capsys.readouterr().err


@pytest.mark.gpu
def test_an_accelerator_makes_contacts_too():
    assert bench_tcl3d.make([0, 1], "cuda").contacts == 2 * tcl3d.LOADS
