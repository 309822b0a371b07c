"""A rig file of one's own, as on a bench: what it must hold, and one line when it does not fit.

The devices are emulated, but the rig's file says ``hardware`` and names their addresses.
"""

import copy
import io
import json
import os
import re
import signal
import threading

import numpy as np
import pytest
import yaml

from cltp.sensing.force_calibration import load_force_calibration, save_force_calibration
from primitives import RobotError
from sim.emulators.process.spawn import EmulatorProcess
from sim.grasp.force_calibration import drawn_force_calibration
from tacgrasp.__main__ import main
from tacgrasp.drivers.dynamixel.calibration import save_calibration
from tacgrasp.drivers.dynamixel.gripper import connect_gripper
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings
from tacgrasp.episodes import read_episode
from tacgrasp.rig.emulated import emulated_calibration
from tests.fakes.patient_rig import fields

pytest.importorskip("rtde_control")
pytest.importorskip("dynamixel_sdk")


@pytest.fixture(scope="module")
def emulators():
    with EmulatorProcess("rig", "--seed", "2") as running:
        yield running


@pytest.fixture(scope="module")
def egg():
    """Devices around an egg in the middle, which stay where they are; a test leaves them open."""
    with EmulatorProcess("rig", "--seed", "2", "--object", "egg", "--centred") as running:
        yield running


def rig_of(emulators, tmp_path):
    """The fields of a rig file that fits these devices; its calibrations lie beside it."""
    rig, ready = fields(), emulators.ready
    rig["devices"] = "hardware"
    rig["gripper"]["first_force_n"] = float(ready["first_force_n"])
    rig["hardware"]["arm"]["host"] = ready["host"]
    rig["hardware"]["gripper"]["port"] = ready["gripper_port"]
    rig["hardware"]["sensor"]["port"] = ready["sensor_port"]
    settings = DynamixelSettings.model_validate(rig["hardware"]["gripper"])
    force = drawn_force_calibration("gelsight_mini", 2, unit="emulated")
    save_force_calibration(tmp_path / "force.json", force)
    rig["hardware"]["sensor"]["force_calibration"] = "force.json"
    save_calibration(tmp_path / settings.calibration, emulated_calibration(settings))
    return rig


@pytest.fixture
def rig(emulators, tmp_path):
    yield rig_of(emulators, tmp_path)
    for device in ("ur", "dynamixel", "taxels"):
        emulators.control.clear(device)


def positions(emulators):
    arm, hand = (emulators.control.facts(name) for name in ("ur", "dynamixel"))
    return [arm["tcp_x_m"], arm["tcp_y_m"], arm["tcp_z_m"], hand["width_m"]]


def complaint(rig, folder, capsys):
    """The one line that a run says, and its exit code."""
    path = folder / "mine.yaml"
    path.write_text(yaml.safe_dump(rig))
    code = main(["run", "--rig", str(path), "--policy", "rules", "--record", str(folder)])
    printed = capsys.readouterr()
    assert printed.err.count("\n") == 1, printed.err
    assert printed.err.startswith("tacgrasp: ")
    assert not list(folder.glob("*.mcap"))
    return code, printed.err


def changed(rig, path, value):
    rig = copy.deepcopy(rig)
    *sections, field = path.split(".")
    section_fields = rig
    for section in sections:
        section_fields = section_fields[section]
    if value is None:
        del section_fields[field]
    else:
        section_fields[field] = value
    return rig


BAD_FIELDS = {
    "misspelt": ("hardware.arm.hosst", "x", "unknown field hardware.arm.hosst; did you mean host"),
    "misspelt in the sensor": (
        "hardware.sensor.prt",
        "x",
        "hardware.sensor.prt; did you mean port",
    ),
    "another kind": (
        "hardware.sensor.kind",
        "digit",
        "hardware.sensor.kind must be one of gelsight",
    ),
    "no address": ("hardware.arm.host", None, "must set hardware.arm.host"),
    "no gripper": ("hardware.gripper", None, "must set hardware.gripper"),
    "no hardware": ("hardware", None, "devices: hardware needs a section hardware"),
    "simulated with hardware": ("devices", "sim", "devices: sim takes no section hardware"),
    "no first force": ("gripper.first_force_n", None, "needs gripper.first_force_n"),
    "first force above the largest": (
        "gripper.first_force_n",
        40.0,
        "first_force_n 40 must lie in min_force_n 0.1 to max_force_n 12",
    ),
    "another sensor's field": (
        "hardware.sensor.sensor",
        "digit",
        "sensor gelsight_mini is not what hardware.sensor is: digit",
    ),
    "half a servo": (
        "hardware.gripper.servos",
        [{"id": 1, "open_ticks": 2496}],
        "servos.closed_ticks is missing",
    ),
    "no servo": ("hardware.gripper.servos", [], r"servos must have at least 1 item, got \[\]"),
    "empty address": ("hardware.arm.host", "", "host must have at least 1 character"),
    "no path": ("hardware.gripper.calibration", 5, "must be the path of a file, got 5"),
    "not finite": ("hardware.start.position_m", [float("nan"), 0, 0], "finite"),
    "millimetres": ("hardware.arm.tcp_offset_m", [0, 0, 150], "longer than 1 m; is it in metres"),
    "centre in millimetres": ("hardware.arm.payload_cog_m", [0, 0, 60], "is it in metres"),
    "degrees": ("hardware.start.rotvec_rad", [180, 0, 0], "whole turn; is it in radians"),
    "half a pose": ("hardware.start.rotvec_rad", None, "needs position_m and rotvec_rad"),
    "slow driver": ("hardware.arm.max_speed_m_s", 0.3, "arm.max_speed_m_s 0.4 is above hardware"),
    "gentle driver": (
        "hardware.arm.max_acceleration_m_s2",
        5,
        "shake_acceleration_m_s2 10 is above",
    ),
}


@pytest.mark.parametrize("name", BAD_FIELDS)
def test_a_wrong_field_is_named_before_any_device_is_touched(name, rig, tmp_path, capsys):
    path, value, expected = BAD_FIELDS[name]
    rig["hardware"]["arm"]["host"] = "127.77.254.254"  # no device answers there: none may be needed
    code, message = complaint(changed(rig, path, value), tmp_path, capsys)
    assert code == 2
    assert re.search(expected, message), message


BAD_DEVICES = {
    "nobody at the address": ("hardware.arm.host", "127.77.254.254", "127.77.254.254"),
    "no name of a host": ("hardware.arm.host", 80 * "x" + ".y", "no UR dashboard at xxxx"),
    "port missing": ("hardware.gripper.port", "/dev/serial/by-id/none", "no serial port"),
    "calibration of another unit": ("hardware.gripper.unit", "mine", "of another gripper"),
    "no calibration": (
        "hardware.gripper.calibration",
        "none.yaml",
        "no calibration of the gripper",
    ),
    "force beyond the gripper's": ("gripper.max_force_n", 40.0, "is beyond this gripper"),
    "start out of the workspace": (
        "hardware.start.position_m",
        [0.45, -0.10, 0.41],
        "z = 0.4100 m would leave the workspace",
    ),
    "start too far": ("hardware.start.max_way_mm", 1.0, "more than the 1 mm that it may go"),
    "start turned": (
        "hardware.start.rotvec_rad",
        [0, 0, 0],
        "more than the 0.5 rad that it may turn",
    ),
}


@pytest.mark.parametrize("name", BAD_DEVICES)
def test_a_device_that_does_not_fit_is_refused_in_one_line_and_nothing_moves(
    name, rig, emulators, tmp_path, capsys
):
    path, value, expected = BAD_DEVICES[name]
    if name == "start too far":
        rig["hardware"]["start"]["position_m"] = [0.45, -0.10, 0.205]
    before = positions(emulators)
    code, message = complaint(changed(rig, path, value), tmp_path, capsys)
    assert code == 3
    assert expected in message
    assert positions(emulators) == pytest.approx(before, abs=1e-9)


BAD_ANSWERS = {
    "an address that answers with garbage": ("ur", "garbage", "no UR dashboard"),
    "an address that does not answer": ("ur", "mute", "said nothing"),
    "a port that another program has": ("dynamixel", "port_taken", "another program"),
    "servos that do not answer": ("dynamixel", "silence", "answer"),
    "an array that is unplugged": ("taxels", "unplugged", "no serial port"),
}


@pytest.mark.parametrize("name", BAD_ANSWERS)
def test_a_device_that_answers_wrongly_is_refused_in_one_line_and_nothing_moves(
    name, rig, emulators, tmp_path, capsys
):
    device, fault, expected = BAD_ANSWERS[name]
    before = positions(emulators)
    emulators.control.inject(device, fault)
    code, message = complaint(rig, tmp_path, capsys)
    assert code == 3
    assert expected in message
    assert positions(emulators) == pytest.approx(before, abs=1e-9)


@pytest.fixture
def recording(tmp_path):
    """Settings of a recording of one touch."""
    heights = np.zeros((60, 80))
    heights[20:40, 30:50] = 0.5
    (tmp_path / "touches").mkdir()
    np.save(tmp_path / "touches" / "touch_1.npy", heights)
    return {"kind": "recorded", "path": "touches"}


def test_a_recorded_sensor_grasps_nothing(rig, emulators, recording, tmp_path, capsys):
    before = positions(emulators)
    rig["hardware"]["sensor"] = recording
    code, message = complaint(rig, tmp_path, capsys)
    assert code == 2
    assert "nothing is felt" in message
    assert positions(emulators) == pytest.approx(before, abs=1e-9)


def test_a_recording_is_decided_on_in_a_dry_run(rig, emulators, recording, tmp_path, capsys):
    before = positions(emulators)
    rig["hardware"]["sensor"] = recording
    path = tmp_path / "mine.yaml"
    path.write_text(yaml.safe_dump(rig))
    argv = ["run", "--rig", str(path), "--policy", "rules", "--record", str(tmp_path), "--dry-run"]
    assert main(argv) == 0, capsys.readouterr().err
    (episode,) = tmp_path.glob("*.mcap")
    assert float(read_episode(episode).steps[0].cloud.points_mm[:, 2].max()) > 0.4
    assert positions(emulators) == pytest.approx(before, abs=1e-9)


def test_jogging_begins_where_the_arm_stands_however_far_its_start_is(
    rig, emulators, tmp_path, capsys, monkeypatch
):
    rig["hardware"]["start"] |= {"position_m": [0.45, -0.10, 0.30], "max_way_mm": 10}
    path = tmp_path / "mine.yaml"
    path.write_text(yaml.safe_dump(rig))
    before = positions(emulators)
    monkeypatch.setattr("sys.stdin", io.StringIO("r"))
    assert main(["jog", "--rig", str(path)]) == 0, capsys.readouterr().err
    assert "at (450.0, -100.0, 201.0) mm" in capsys.readouterr().out
    after = positions(emulators)
    assert after[2] - before[2] == pytest.approx(0.001, abs=2e-5)
    monkeypatch.setattr("sys.stdin", io.StringIO("f"))
    assert main(["jog", "--rig", str(path)]) == 0


@pytest.mark.parametrize("start", ["pose", "here"])
def test_a_run_is_refused_while_the_gripper_still_grips_and_jog_opens_it(
    start, rig, emulators, tmp_path, capsys, monkeypatch
):
    if start == "here":
        rig["hardware"]["start"] = {"at": "here"}
    else:  # from where the arm stands it would have to move
        rig["hardware"]["start"]["position_m"] = [0.45, -0.10, 0.205]
    settings = DynamixelSettings.model_validate(rig["hardware"]["gripper"])
    before_run = connect_gripper(settings, folder=tmp_path)
    before_run.grip(0.3)
    before_run.disconnect()
    before = positions(emulators)
    try:
        code, message = complaint(rig, tmp_path, capsys)
        assert code == 3
        assert "the gripper is not open: it still grips, with 0.30 N commanded" in message
        assert "tacgrasp jog (key o; --open needs the gripper alone); nothing moved" in message
        assert positions(emulators) == pytest.approx(before, abs=1e-9)
        path = str(tmp_path / "mine.yaml")
        assert main(["doctor", "--rig", path]) == 1
        (line,) = [x for x in capsys.readouterr().out.splitlines() if "  opening " in x]
        assert "NOT OK" in line and "a run is refused" in line
        monkeypatch.setattr("sys.stdin", io.StringIO("o"))
        assert main(["jog", "--rig", path]) == 0
        assert "open at " in capsys.readouterr().out
        assert main(["doctor", "--rig", path]) in (0, 1)  # a busy machine may be late
        (line,) = [x for x in capsys.readouterr().out.splitlines() if "  opening " in x]
        assert "NOT OK" not in line
    finally:
        after_run = connect_gripper(settings, folder=tmp_path)
        after_run.open_by(1.0)
        after_run.disconnect()


def test_a_gripper_opens_alone_while_the_arm_is_stopped_and_the_sensor_silent(
    rig, emulators, tmp_path, capsys
):
    settings = DynamixelSettings.model_validate(rig["hardware"]["gripper"])
    before = connect_gripper(settings, folder=tmp_path)
    before.grip(0.3)
    before.disconnect()
    emulators.control.inject("ur", "protective_stop")
    emulators.control.inject("taxels", "stall")
    path = tmp_path / "mine.yaml"
    path.write_text(yaml.safe_dump(rig))
    assert main(["jog", "--rig", str(path), "--open"]) == 0
    assert "the gripper is open: " in capsys.readouterr().out
    assert emulators.control.facts("dynamixel")["width_m"] > 0.03


CALIBRATIONS = {
    "missing": (None, "make one with: tacgrasp calibrate gripper"),
    "old": ("2020-01-31", "days old"),
    "of the future": ("2120-01-31", "check this computer's clock"),
}


@pytest.mark.parametrize("words", [["--open"], []])
@pytest.mark.parametrize("calibration", CALIBRATIONS)
def test_jogging_opens_a_gripper_whatever_its_calibration_is(
    calibration, words, rig, emulators, tmp_path, capsys, caplog, monkeypatch
):
    settings = DynamixelSettings.model_validate(rig["hardware"]["gripper"])
    caplog.set_level("WARNING", "tacgrasp.drivers.dynamixel.gripper")
    before = connect_gripper(settings, folder=tmp_path)
    before.grip(0.3)
    before.disconnect()
    date, expected = CALIBRATIONS[calibration]
    path, made = tmp_path / "mine.yaml", tmp_path / settings.calibration
    path.write_text(yaml.safe_dump(rig))
    if date is None:
        made.unlink()
    else:
        made.write_text(re.sub(r"date: \S+", f"date: '{date}'", made.read_text()))
    width_m = emulators.control.facts("dynamixel")["width_m"]
    monkeypatch.setattr("sys.stdin", io.StringIO("go"))
    assert main(["jog", "--rig", str(path), *words]) == 0
    (warning,) = [x for x in caplog.messages if "the gripper only opens: " in x]
    assert expected in warning
    assert words or "refused: " in capsys.readouterr().out  # to grip
    assert emulators.control.facts("dynamixel")["width_m"] > width_m + 0.001
    after = connect_gripper(settings, folder=tmp_path, must_grip=False)
    after.open_by(1.0)
    after.disconnect()


def test_a_grip_that_jogging_leaves_is_told(rig, tmp_path, capsys, monkeypatch):
    path = tmp_path / "mine.yaml"
    path.write_text(yaml.safe_dump(rig))
    monkeypatch.setattr("sys.stdin", io.StringIO("g"))
    assert main(["jog", "--rig", str(path)]) == 0
    assert "the gripper keeps its grip: " in capsys.readouterr().out
    assert main(["jog", "--rig", str(path), "--open"]) == 0


def test_doctor_names_a_start_that_a_run_would_refuse(rig, tmp_path, capsys):
    path = tmp_path / "mine.yaml"
    for position_m, is_ok in (([0.45, -0.10, 0.20], True), ([450, -100, 200], False)):
        rig["hardware"]["start"]["position_m"] = position_m
        path.write_text(yaml.safe_dump(rig))
        main(["doctor", "--rig", str(path)])
        (line,) = [x for x in capsys.readouterr().out.splitlines() if " start pose " in x]
        assert ("NOT OK" not in line) is is_ok
        assert is_ok or "in metres" in line


@pytest.mark.parametrize(
    ("section", "changed", "check", "expected"),
    [
        (
            "start",
            {"max_way_mm": 5, "position_m": [0.45, -0.1, 0.21]},
            "way to start",
            "10 mm from",
        ),
        ("start", {"rotvec_rad": [0, 0, 0]}, "way to start", "turned by 3.14 rad (180°)"),
        ("gripper", {"max_force_n": 80}, "largest force", "80 N is beyond this gripper"),
    ],
)
def test_doctor_refuses_what_a_run_would(section, changed, check, expected, rig, tmp_path, capsys):
    path = tmp_path / "mine.yaml"
    found = []
    for values in ({}, changed):
        (rig["hardware"][section] if section == "start" else rig[section]).update(values)
        path.write_text(yaml.safe_dump(rig))
        main(["doctor", "--rig", str(path)])
        lines = capsys.readouterr().out.splitlines()
        found += [line for line in lines if f" {check} " in line]
    assert " NOT OK " not in found[0]
    assert " NOT OK " in found[1]
    assert expected in found[1]
    code, message = complaint(rig, tmp_path, capsys)
    assert code == 3
    assert expected in message


def test_doctor_says_that_a_recording_feels_nothing(rig, emulators, recording, tmp_path, capsys):
    rig["hardware"]["sensor"] = recording
    path = tmp_path / "mine.yaml"
    path.write_text(yaml.safe_dump(rig))
    assert main(["doctor", "--rig", str(path)]) == 1
    (line,) = [x for x in capsys.readouterr().out.splitlines() if x.startswith("sensor   touch")]
    assert " NOT OK " in line
    assert "--dry-run" in line


def test_a_port_that_is_another_devices_is_refused(rig, emulators, tmp_path, capsys):
    rig["hardware"]["gripper"]["port"] = emulators.ready["sensor_port"]
    rig["hardware"]["sensor"] |= {"port": emulators.ready["gripper_port"], "connect_timeout_s": 1}
    code, message = complaint(rig, tmp_path, capsys)
    assert code == 3
    assert "taxel array" in message


def test_a_calibration_out_of_date_is_refused(rig, emulators, tmp_path, capsys):
    path = tmp_path / "gripper_calibration.yaml"
    path.write_text(re.sub(r"date: \S+", "date: '2020-01-31'", path.read_text()))
    code, message = complaint(rig, tmp_path, capsys)
    assert code == 3
    assert "days old" in message


def test_the_environment_can_not_change_what_is_bolted_to_the_bench(
    rig, tmp_path, capsys, monkeypatch
):
    monkeypatch.setenv("TACGRASP_HARDWARE__ARM__HOST", "127.0.0.9")
    code, message = complaint(rig, tmp_path, capsys)
    assert code == 2
    assert "hardware is set in the rig's file alone" in message


def force_file(folder, **changes):
    path = folder / "force.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | changes))


BAD_FORCE_FILES = {
    "of another unit": ({"unit": "mini-2"}, "of another unit: of mini-2, this one is emulated"),
    "of another sensor": ({"sensor": "digit"}, "of another sensor: of digit"),
    "too old": ({"date": "2020-01-31"}, "days old, at most 180"),
    "of the future": ({"date": "2120-01-31"}, "after today"),
    "changed": ({"factor": 2.0}, "it was changed by hand"),
}


@pytest.mark.parametrize("name", BAD_FORCE_FILES)
def test_a_force_calibration_that_does_not_fit_is_refused(name, rig, emulators, tmp_path, capsys):
    changes, expected = BAD_FORCE_FILES[name]
    force_file(tmp_path, **changes)
    before = positions(emulators)
    code, message = complaint(rig, tmp_path, capsys)
    assert code == 3
    assert expected in message
    assert positions(emulators) == pytest.approx(before, abs=1e-9)


def test_without_a_force_calibration_real_devices_do_not_grasp(rig, emulators, tmp_path, capsys):
    del rig["hardware"]["sensor"]["force_calibration"]
    before = positions(emulators)
    code, message = complaint(rig, tmp_path, capsys)
    assert code == 2
    for part in ("uncalibrated, -26 to +35 %", "tacgrasp calibrate force", "--allow-uncalibrated"):
        assert part in message
    assert positions(emulators) == pytest.approx(before, abs=1e-9)


def test_with_the_flag_an_uncalibrated_run_goes_on_to_its_devices(rig, tmp_path, capsys):
    del rig["hardware"]["sensor"]["force_calibration"]
    rig["hardware"]["arm"]["host"] = "127.77.254.254"
    path = tmp_path / "mine.yaml"
    path.write_text(yaml.safe_dump(rig))
    argv = ["run", "--rig", str(path), "--policy", "rules", "--record", str(tmp_path)]
    assert main([*argv, "--allow-uncalibrated-force"]) == 3
    assert "127.77.254.254" in capsys.readouterr().err


@pytest.mark.parametrize("is_calibrated", [True, False])
def test_doctor_looks_at_the_force_calibration(is_calibrated, rig, tmp_path, capsys):
    if not is_calibrated:
        del rig["hardware"]["sensor"]["force_calibration"]
    path = tmp_path / "mine.yaml"
    path.write_text(yaml.safe_dump(rig))
    main(["doctor", "--rig", str(path)])
    (line,) = [x for x in capsys.readouterr().out.splitlines() if "force calibration" in x]
    assert ("NOT OK" in line, "tacgrasp calibrate force" in line) == (not is_calibrated,) * 2
    assert ("emulated, 0 days old, factor" in line) == is_calibrated


def test_doctor_tests_a_sensor_whose_force_calibration_is_missing(rig, tmp_path, capsys):
    (tmp_path / "force.json").unlink()
    path = tmp_path / "mine.yaml"
    path.write_text(yaml.safe_dump(rig))
    assert main(["doctor", "--rig", str(path)]) == 1
    lines = [x for x in capsys.readouterr().out.splitlines() if x.startswith("sensor ")]
    (wrong,) = [x for x in lines if "force.json" in x]
    assert "force calibration" in wrong and "NOT OK" in wrong
    for name in ("connection", "fresh frame", "line"):
        assert any(name in x for x in lines), name
    (connection,) = [x for x in lines if "connection" in x]
    assert "NOT OK" not in connection


def test_weights_on_real_devices_need_a_person(rig, tmp_path, capsys, monkeypatch):
    path = tmp_path / "mine.yaml"
    path.write_text(yaml.safe_dump(rig))
    monkeypatch.setattr("sys.stdin", io.StringIO("\n" * 20))
    out = tmp_path / "new.json"
    assert main(["calibrate", "force", "--rig", str(path), "--out", str(out)]) == 2
    printed = capsys.readouterr()
    assert "weights need a person at a terminal" in printed.err
    assert printed.err.count("\n") == 1
    assert not out.exists()


def test_the_calibrated_gripper_calibrates_the_sensor_of_a_new_unit(egg, tmp_path, capsys):
    path = tmp_path / "mine.yaml"
    path.write_text(yaml.safe_dump(rig_of(egg, tmp_path)))
    (tmp_path / "force.json").unlink()  # as of a new unit
    argv = ["calibrate", "force", "--rig", str(path), "--by", "gripper"]
    assert main([*argv, "--loads", "0.5", "1", "2"]) == 0, capsys.readouterr().err
    assert f"next      tacgrasp doctor --rig {path}" in capsys.readouterr().out
    made = load_force_calibration(tmp_path / "force.json")
    assert (made.sensor, made.unit, made.source) == (
        "gelsight_mini",
        "emulated",
        "the calibrated gripper",
    )
    assert [load.load_n for load in made.loads] == pytest.approx([0.5, 1, 2], abs=0.02)


FORCE = ["calibrate", "force", "--by", "gripper", "--overwrite"]


@pytest.mark.parametrize(
    ("most_n", "loads", "message"),
    [
        (1.5, ["1", "2", "4"], "max_force_n of mine.yaml, 0.1 to 1.5 N (at 2 4)"),
        (40, ["1", "2", "30"], "calibration and max_current_ma allow, 0 to 12.86 N (at 30)"),
    ],
)
def test_no_load_beyond_a_limit_is_pressed(
    most_n, loads, message, rig, emulators, tmp_path, capsys, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    before = positions(emulators)
    rig["gripper"]["max_force_n"] = most_n
    (tmp_path / "mine.yaml").write_text(yaml.safe_dump(rig))
    assert main([*FORCE, "--rig", "mine.yaml", "--loads", *loads]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert "like --loads 0.5 1" in error
    assert positions(emulators) == pytest.approx(before, abs=1e-9)


@pytest.mark.parametrize("argv", [FORCE, ["calibrate", "pad-axes"]])
def test_the_contact_test_is_prepared_before_the_gripper_and_its_watchdog(
    argv, rig, tmp_path, monkeypatch
):
    order = []

    def connect(*_, **__):
        order.append("gripper")
        raise RobotError("not today")

    path = tmp_path / "mine.yaml"
    path.write_text(yaml.safe_dump(rig))
    for module in ("gel_sense", "hardware"):
        monkeypatch.setattr(f"tacgrasp.rig.{module}.prepare", lambda _: order.append("prepare"))
    monkeypatch.setattr("tacgrasp.drivers.dynamixel.gripper.connect_gripper", connect)
    assert main([*argv, "--rig", str(path)]) == 3
    assert order == ["prepare", "gripper"]


STOPPED = {
    "force, Ctrl-C": (FORCE, signal.SIGINT, 130),
    "force, SIGTERM": (FORCE, signal.SIGTERM, 143),
    "pad-axes, SIGTERM": (["calibrate", "pad-axes"], signal.SIGTERM, 143),
}


@pytest.mark.parametrize("name", STOPPED)
def test_a_calibration_that_is_stopped_under_force_leaves_nothing_pressed(
    name, egg, tmp_path, capsys
):
    argv, number, code = STOPPED[name]
    path, ended = tmp_path / "mine.yaml", threading.Event()
    path.write_text(yaml.safe_dump(rig_of(egg, tmp_path)))
    assert egg.control.facts("world")["force_n"] == 0.0

    def stop_when_it_presses():
        while not ended.wait(0.02):
            if egg.control.facts("world")["force_n"] > 0.1:
                os.kill(os.getpid(), number)
                return

    watcher = threading.Thread(target=stop_when_it_presses)
    watcher.start()
    try:
        assert main([*argv, "--rig", str(path)]) == code, capsys.readouterr().err
    finally:
        ended.set()
        watcher.join()
    assert egg.control.facts("world")["force_n"] == 0.0


@pytest.mark.slow
def test_a_run_on_a_rig_file_of_ones_own_ends_with_a_verified_grasp(rig, tmp_path, capsys):
    path = tmp_path / "mine.yaml"
    path.write_text(yaml.safe_dump(rig))
    code = main(["run", "--rig", str(path), "--policy", "rules", "--record", str(tmp_path)])
    printed = capsys.readouterr().out
    assert code == 0, printed
    assert "truth:" not in printed  # nobody knows it on a bench
    (episode,) = tmp_path.glob("strawberry-*.mcap")
    assert main(["replay", str(episode), "--execute"]) == 2
    assert "was recorded on real devices" in capsys.readouterr().err
