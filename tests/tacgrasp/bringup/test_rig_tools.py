"""The operator's tools: doctor, emulate, calibrate pad-axes; and the benches of the drivers."""

import io
import json
import os
import signal
import subprocess
import sys
from dataclasses import replace

import pytest
import yaml

from sim.emulators.__main__ import MODULES
from sim.emulators.options import OPTIONS
from sim.emulators.process.control import ControlClient
from tacgrasp.__main__ import main
from tacgrasp.benchmarks.faults import fault_free
from tacgrasp.benchmarks.faults.cases import CASES, InjectionPhase
from tacgrasp.benchmarks.faults.load import busy_cores
from tacgrasp.benchmarks.faults.reaction import InjectionResult
from tacgrasp.benchmarks.faults.table import markdown_of, row_of
from tacgrasp.benchmarks.loop.rigs import RigEnd, RigPair
from tests.fakes.patient_rig import fields, patient_rig
from tests.paths import ROOT

# -- doctor ------------------------------------------------------------------------------------


def test_the_simulated_rig_is_well_and_there_is_nothing_to_connect(capsys):
    assert main(["doctor"]) == 0
    printed = capsys.readouterr().out
    assert "there is nothing to connect" in printed
    assert "200 × 200 × 280 mm" in printed


def test_every_device_of_a_rig_is_looked_at_and_the_verdict_is_the_exit_code(tmp_path, capsys):
    code = main(["doctor", "--rig", str(patient_rig(tmp_path))])
    lines = capsys.readouterr().out.splitlines()
    for device in ("rig", "arm", "gripper", "sensor"):
        assert any(line.startswith(f"{device} ") for line in lines)
    wrong = [line for line in lines if " NOT OK " in line]
    assert code == (1 if wrong else 0)
    assert all("latency" in line or "fresh" in line or "data" in line for line in wrong), wrong
    assert any("ur-rtde" in line for line in lines)
    assert any("calibration" in line and "days old" in line for line in lines)
    (first,) = [line for line in lines if "first force" in line]
    assert "1 N until something is felt" in first
    assert "the least command is 0.007 N" in first


def test_what_is_wrong_is_told_with_what_to_do(tmp_path, capsys):
    rig = fields() | {"devices": "hardware"}
    rig["gripper"]["first_force_n"] = 1.0
    rig["hardware"]["arm"]["host"] = "127.77.254.253"
    rig["hardware"]["gripper"]["port"] = rig["hardware"]["sensor"]["port"] = "/dev/none"
    path = tmp_path / "mine.yaml"
    path.write_text(yaml.safe_dump(rig))
    assert main(["doctor", "--rig", str(path)]) == 1
    lines = capsys.readouterr().out.splitlines()
    wrong = [line for line in lines if " NOT OK " in line]
    assert {line.split()[0] for line in wrong} == {"arm", "gripper", "sensor"}
    assert all(" | " in line for line in wrong)
    (calibration,) = (line for line in wrong if line.startswith("gripper  calibration"))
    assert calibration.count("tacgrasp calibrate gripper") == 1
    assert lines[-1].endswith("the rig is not fit to run")


def test_a_slip_calibration_that_a_run_refuses_is_told(tmp_path, capsys):
    rig = yaml.safe_load((ROOT / "tacgrasp" / "rigs" / "sim.yaml").read_text())
    path = tmp_path / "mine.yaml"
    path.write_text(yaml.safe_dump(rig | {"slip_calibration": "none.json"}))
    assert main(["doctor", "--rig", str(path)]) == 1
    (line,) = (x for x in capsys.readouterr().out.splitlines() if "slip calibration" in x)
    assert " NOT OK " in line
    assert "tacgrasp calibrate slip" in line


# -- emulate -----------------------------------------------------------------------------------


def test_every_kind_of_emulator_is_explained(capsys):
    assert OPTIONS.keys() == MODULES.keys()
    assert main(["emulate", "--help"]) == 0
    printed = capsys.readouterr().out
    assert all(options.__doc__.splitlines()[0] in printed for options in OPTIONS.values())


@pytest.mark.parametrize(
    ("argv", "expected"),
    [
        ([], "expects one of ur, dynamixel, taxels, rig"),
        (["toaster"], "got 'toaster'"),
        (["taxels", "--rate-hz", "9000"], "1 to 200 frames a second"),
        (["ur", "--host", "0.0.0.0"], "loopback address"),
        (["rig", "--host", "8.8.8.8"], "loopback address"),
        (["rig", "--first-force-n", "-1"], "must be above 0 N, got -1"),
        (["dynamixel", "--servos", "3"], "1 or 2 servos, got 3"),
        (["rig", "--colour", "red"], "--colour"),
    ],
)
def test_an_emulator_that_can_not_start_says_why_in_one_line(argv, expected, capsys):
    assert main(["emulate", *argv]) == 2
    message = capsys.readouterr().err
    assert expected in message
    assert message.count("\n") == 1


def test_an_emulator_runs_until_ctrl_c_at_the_addresses_that_it_prints():
    command = [sys.executable, "-m", "tacgrasp", "emulate", "taxels", "--rate-hz", "20"]
    child = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, text=True)
    lines = [child.stdout.readline() for _ in range(3)]
    found = dict(line.split(maxsplit=1) for line in lines[:2])
    control = ControlClient(int(found["control_port"]))
    assert control.facts("taxels")["plugged"]
    assert control.facts("taxels")["rate_hz"] == 20  # flags become the emulator's own options
    control.close()
    assert os.path.lexists(found["serial_port"].strip())
    child.send_signal(signal.SIGINT)
    assert child.wait(20) == 0
    child.stdout.close()
    assert not os.path.lexists(found["serial_port"].strip())


# -- calibrate ---------------------------------------------------------------------------------


def test_the_longest_name_of_what_can_be_calibrated_is_apart_from_what_it_is(capsys):
    assert main(["calibrate", "--help"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert (
        "  gelsight-mini  Learn heights from colours, from presses of a ball of known diameter."
        in lines
    )
    assert any(line.startswith("  gripper        Measure force over current") for line in lines)


# -- calibrate pad-axes ------------------------------------------------------------------------


def test_axes_that_somebody_has_looked_at_are_printed_for_the_rigs_file(capsys):
    assert main(["calibrate", "pad-axes", "--right", "+y", "--palm=-z"]) == 0
    printed = capsys.readouterr().out
    assert yaml.safe_load(printed.split("\n", 1)[1]) == {
        "pad": {"x_axis": [0, 1, 0], "y_axis": [0, 0, -1]}
    }


@pytest.mark.parametrize(
    ("argv", "expected"),
    [
        (["--right", "+y", "--palm", "up"], "one of +x"),
        (["--right", "+y", "--palm", "y"], "perpendicular"),
        (["--rig", "sim", "--right", "+x"], "not both"),
        (["--right", "+y"], "without a terminal"),
    ],
)
def test_wrong_axes_are_refused(argv, expected, capsys, monkeypatch):
    monkeypatch.setattr("sys.stdin", io.StringIO())
    assert main(["calibrate", "pad-axes", *argv]) == 2
    assert expected in capsys.readouterr().err


@pytest.mark.parametrize("flags", [[], ["--seed", "193", "--force-n", "1"]])
def test_axes_are_measured_on_a_rig(flags, capsys):
    argv = ["calibrate", "pad-axes", "--rig", "sim", "--object", "cherry_tomato"]
    assert main([*argv, *flags]) == 0
    assert "x_axis: [1, 0, 0]" in capsys.readouterr().out


@pytest.mark.slow
def test_axes_are_measured_with_real_drivers(tmp_path, capsys):
    argv = ["calibrate", "pad-axes", "--rig", str(patient_rig(tmp_path)), "--seed", "193"]
    assert main([*argv, "--force-n", "1"]) == 0
    printed = capsys.readouterr().out
    assert "x_axis: [1, 0, 0]" in printed
    assert "y_axis: [0, 0, -1]" in printed


# -- benches -----------------------------------------------------------------------------------


def test_there_are_faults_of_every_device_in_every_phase():
    assert len(CASES) >= 28
    assert len({case.name for case in CASES}) == len(CASES)
    phases = {
        device: {case.phase for case in CASES if case.name.startswith(device)}
        for device in ("UR", "gripper", "sensor")
    }
    assert phases["UR"] == {InjectionPhase.START, InjectionPhase.MOTION}
    assert phases["gripper"] == phases["sensor"] == set(InjectionPhase)


def a_trial(**changes):
    values = {"detected": True, "message": "gone", "noticed_ms": 20.0, "stop_ms": 60.0} | changes
    return InjectionResult(**values)


STALL = next(case for case in CASES if case.name == "sensor: stall")


def test_a_row_counts_what_its_repeats_came_to():
    row = row_of(STALL, [a_trial(), a_trial(stop_ms=90.0, noticed_ms=40.0), a_trial(stop_ms=70.0)])
    assert (row.injected, row.detected, row.hung, row.invented_value) == (3, 3, 0, 0)
    assert (row.stop_ms_p50, row.stop_ms_max) == (70.0, 90.0)
    assert (row.noticed_ms_p50, row.noticed_ms_max) == (20.0, 40.0)
    assert row.passed


@pytest.mark.parametrize(
    "wrong",
    [
        {"detected": False},
        {"stop_ms": 151.0},
        {"hung": True},
        {"invented": True},
        {"moved": True},
        {"episode": "it has no end"},
        {"spurious": True},
    ],
)
def test_one_bad_repeat_spoils_its_row(wrong):
    assert not row_of(STALL, [a_trial(), a_trial(**wrong)]).passed


def test_with_all_cores_busy_the_arm_has_250_ms_and_the_row_says_how_late_the_latest_was():
    results = [a_trial(stop_ms=float(ms)) for ms in range(100, 201)]
    row = row_of(STALL, results, load=True)
    assert row.passed and not row_of(STALL, results).passed
    assert (row.stop_ms_p95, row.noticed_ms_max, row.spurious) == (195.0, 20.0, 0)
    assert not row_of(STALL, [a_trial(stop_ms=251.0)], load=True).passed


def test_fault_free_episodes_are_gone_on_with_and_every_fault_among_them_is_told(
    tmp_path, capsys, monkeypatch
):
    ends = iter([("success", "", 2), ("fault", "seed 5000001: no frame", 0), ("success", "", 0)])
    monkeypatch.setattr(fault_free, "_episode", lambda config, seed: next(ends))
    path = tmp_path / "counts.json"
    argv = ["bench", "faults", "--json", str(path), "--fault-free"]
    assert main([*argv, "1"]) == 0
    assert main([*argv, "3"]) == 1
    printed = capsys.readouterr().out
    assert "0 spurious faults in 1 fault-free episodes" in printed
    assert "1 spurious faults in 3 fault-free episodes" in printed
    assert "seed 5000001: no frame" in printed
    counts = json.loads(path.read_text())["fault_free"]
    assert (counts["episodes"], counts["spurious"], counts["holds"]) == (3, 1, 2)
    assert main([*argv, "4", "--load"]) == 2
    assert "counted without --load" in capsys.readouterr().err


def test_a_load_ends_with_the_benchmark():
    with busy_cores(True) as spinners:
        assert len(spinners) >= 2
        assert all(spinner.poll() is None for spinner in spinners)
    assert all(spinner.poll() is not None for spinner in spinners)
    with busy_cores(False) as spinners:
        assert not spinners


def test_the_page_names_every_fault_with_what_was_told_and_no_row_is_broken():
    rows = [row_of(case, [a_trial(stop_ms=None)]) for case in CASES]
    page = markdown_of(rows, "tacgrasp bench faults")
    table = [line for line in page.splitlines() if line.startswith("| ")]
    assert len(table) == len(CASES) + 1
    assert {line.count("|") for line in table} == {10}
    assert page.count("“gone”") == len(CASES)


def test_seeds_agree_when_end_and_truth_do():
    one = RigEnd(reason="success", facts=("held",), steps=3, message="a")
    for changes, agree in (
        ({"steps": 4, "message": "b"}, True),
        ({"facts": ("held", "bruised")}, False),
        ({"reason": "fault"}, False),
    ):
        assert RigPair(seed=0, simulated=one, emulated=replace(one, **changes)).agree is agree


@pytest.mark.parametrize(
    ("argv", "expected"),
    [
        (["faults", "--repeats", "0"], "--repeats must be at least 1"),
        (["faults", "--only", "toaster"], "UR: mute at connect"),
        (["drivers", "--minutes", "0"], "--minutes must be 0.01 to 600"),
        (["rigs", "--seeds", "0"], "--seeds and --parallel must be at least 1"),
        (["rigs", "--policy", "gut"], "unknown policy 'gut'"),
    ],
)
def test_a_bench_that_makes_no_sense_is_refused(argv, expected, capsys):
    assert main(["bench", *argv]) == 2
    assert expected in capsys.readouterr().err


def test_a_fault_is_injected_and_written_as_figures_and_as_a_page(tmp_path):
    figures, page = tmp_path / "f.json", tmp_path / "faults.md"
    argv = ["bench", "faults", "--repeats", "1", "--only", "stale background"]
    assert main([*argv, "--json", str(figures), "--markdown", str(page)]) == 0
    (row,) = json.loads(figures.read_text())["faults"]
    named = ("name", "phase", "injected", "detected", "hung", "invented_value")
    assert [row[name] for name in named] == ["sensor: stale background", "start", 1, 1, 0, 0]
    assert row["stop_ms_p50"] is None
    assert "tacgrasp bench faults --repeats 1" in page.read_text()


@pytest.mark.slow
def test_the_drivers_are_timed(tmp_path):
    figures = tmp_path / "d.json"
    assert main(["bench", "drivers", "--minutes", "0.1", "--json", str(figures)]) == 0
    report = json.loads(figures.read_text())
    assert report["supervision"]["count"] > 300
    assert 7 < report["supervision"]["p50_ms"] < 9
