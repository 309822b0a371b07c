"""``tacgrasp calibrate gripper``: on an emulated gripper, from a file, and what it refuses."""

import io
import json

import pytest
import yaml

from sim.emulators.dynamixel.bus_process import DynamixelEmulator
from sim.emulators.dynamixel.fingers import SpringLoad
from tacgrasp.__main__ import main
from tacgrasp.drivers.dynamixel.calibration import load_calibration
from tacgrasp.drivers.dynamixel.fingers import connect_fingers
from tests.fakes.emulated_servos import emulated_gripper

RIG = {
    "devices": "hardware",
    "arm": {"workspace_low_m": [0.3, -0.2, 0.1], "workspace_high_m": [0.5, 0.0, 0.4]},
    "gripper": {"min_force_n": 0.1, "max_force_n": 10, "first_force_n": 0.5},
    "pad": {"x_axis": [1, 0, 0], "y_axis": [0, 0, -1]},
}


@pytest.fixture
def rig(tmp_path):
    """Path of a rig's file whose port is ``/dev/null`` unless another is given."""

    def write(port: str = "/dev/null"):
        gripper = emulated_gripper(port, tmp_path).model_dump(mode="json")
        (tmp_path / "gripper_calibration.yaml").unlink()
        box = dict(json.loads(json.dumps(RIG["arm"])))  # YAML with aliases is refused
        hardware = {
            "arm": {"kind": "ur", "host": "127.0.0.2", "payload_kg": 1.0} | box,
            "gripper": gripper,
            "sensor": {"kind": "taxels", "port": "/dev/null"},
        }
        (tmp_path / "rig.yaml").write_text(yaml.safe_dump(RIG | {"hardware": hardware}))
        return tmp_path / "rig.yaml"

    return write


@pytest.fixture
def csv(tmp_path):
    path = tmp_path / "readings.csv"
    path.write_text("current_ma,force_n\n20,0\n60,0.4\n110,1.4\n160,2.4\n")
    return path


def test_a_file_of_readings_is_fitted_and_kept_beside_the_rig_s_file(rig, csv, capsys):
    path = rig()
    assert main(["calibrate", "gripper", "--rig", str(path), "--readings", str(csv)]) == 0
    assert "0.02000 N/mA from 40.0 mA on" in capsys.readouterr().out
    made = load_calibration(path.parent / "gripper_calibration.yaml")
    assert (made.unit, made.model, made.ids, made.source) == (
        "emulated",
        "XC330-T288",
        (1,),
        "readings.csv",
    )


def test_a_person_types_what_the_scale_shows(rig, monkeypatch, capsys):
    pytest.importorskip("dynamixel_sdk")
    emulator = DynamixelEmulator(SpringLoad(width_m=0.10))
    try:
        path = rig(emulator.serial_port)
        # Enter, then one force for each current; what is no number is asked for again
        typed = "\n0,5\nabout one\n1.0\n1.5\n"
        monkeypatch.setattr("sys.stdin", io.StringIO(typed))
        words = ["calibrate", "gripper", "--rig", str(path), "--steps", "3", "--max-ma", "200"]
        assert main(words) == 0
        made = load_calibration(path.parent / "gripper_calibration.yaml")
        assert (made.num_readings, made.max_force_n) == (3, 1.5)
        assert made.newtons_per_ma == pytest.approx(1.0 / 180)
        assert emulator.facts()["squeezes"] == 3
        assert emulator.facts()["width_m"] == pytest.approx(0.11, abs=1e-3)
    finally:
        emulator.close()


def test_a_gripper_that_still_grips_is_refused_and_squeezes_nothing(rig, tmp_path, capsys):
    pytest.importorskip("dynamixel_sdk")
    emulator = DynamixelEmulator(SpringLoad(width_m=0.08))
    try:
        path = rig(emulator.serial_port)
        fingers = connect_fingers(emulated_gripper(emulator.serial_port, tmp_path))
        (tmp_path / "gripper_calibration.yaml").unlink()
        fingers.squeeze(100)
        fingers.disconnect()
        before = emulator.facts()
        assert main(["calibrate", "gripper", "--rig", str(path)]) == 3
        error = capsys.readouterr().err
        assert "the gripper is not open: it still grips, with 100 mA" in error
        assert "tacgrasp jog (key o; --open needs the gripper alone); nothing moved" in error
        after = emulator.facts()
        assert (after["squeezes"], after["width_m"]) == (before["squeezes"], before["width_m"])
    finally:
        emulator.close()


def test_input_that_ends_too_early_leaves_the_fingers_open_and_writes_nothing(
    rig, monkeypatch, capsys
):
    pytest.importorskip("dynamixel_sdk")
    emulator = DynamixelEmulator(SpringLoad(width_m=0.10))
    try:
        path = rig(emulator.serial_port)
        monkeypatch.setattr("sys.stdin", io.StringIO("\n0.5\n"))
        assert main(["calibrate", "gripper", "--rig", str(path), "--steps", "3"]) == 2
        assert "give --readings FILE" in capsys.readouterr().err
        assert emulator.facts()["width_m"] == pytest.approx(0.11, abs=1e-3)
        assert not (path.parent / "gripper_calibration.yaml").exists()
    finally:
        emulator.close()


def test_the_rigs_own_file_and_files_of_another_kind_are_kept(rig, capsys, tmp_path):
    path, other = rig(), tmp_path / "notes.txt"
    other.write_text("mine")
    before = path.read_text()
    for out, message in ((path, "is the rig's own file"), (other, "ending in .yaml or .yml")):
        argv = ["calibrate", "gripper", "--rig", str(path), "--out", str(out)]
        assert main(argv) == 2
        assert message in capsys.readouterr().err
    assert (path.read_text(), other.read_text()) == (before, "mine")


def test_an_existing_calibration_is_kept_unless_it_may_be_replaced(rig, csv, capsys):
    path = rig()
    made = path.parent / "gripper_calibration.yaml"
    made.write_text("mine")
    argv = ["calibrate", "gripper", "--rig", str(path), "--readings", str(csv)]
    assert main(argv) == 2
    assert "exists and is kept; give --overwrite" in capsys.readouterr().err
    assert made.read_text() == "mine"
    assert main([*argv, "--overwrite"]) == 0
    assert load_calibration(made).source == "readings.csv"


@pytest.mark.parametrize("is_mute", [False, True])
def test_ctrl_c_under_a_current_opens_the_fingers_or_says_that_they_may_hold(
    is_mute, rig, monkeypatch, capsys
):
    pytest.importorskip("dynamixel_sdk")
    emulator = DynamixelEmulator(SpringLoad(width_m=0.10))
    asked = []

    def stop(prompt):
        asked.append(prompt)
        if len(asked) == 2:
            if is_mute:
                emulator.inject("silence")
            raise KeyboardInterrupt
        return ""

    try:
        path = rig(emulator.serial_port)
        monkeypatch.setattr("builtins.input", stop)
        code = main(["calibrate", "gripper", "--rig", str(path), "--steps", "3"])
        error = capsys.readouterr().err
        if is_mute:
            assert code == 3
            assert "the gripper could not be opened" in error
            assert "open with tacgrasp jog (key o; --open needs the gripper alone)" in error
        else:
            assert (code, error) == (130, "tacgrasp: stopped by the operator\n")
            assert emulator.facts()["width_m"] == pytest.approx(0.11, abs=1e-3)
    finally:
        emulator.close()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--steps", "2"], "--steps must be 3 to 50, got 2"),
        (["--date", "today"], "--date must be like 2026-01-31, got today"),
        (["--date", "2999-01-01"], "--date 2999-01-01 is after today"),
        (["--out", "/none/gripper.yaml"], "/none is no folder"),
        (["--readings", "/none.csv"], "--readings /none.csv: expected a CSV file"),
    ],
)
def test_a_wrong_flag_is_one_clear_line(rig, capsys, words, message):
    assert main(["calibrate", "gripper", "--rig", str(rig()), *words]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1


def test_a_rig_without_hardware_has_no_gripper_to_calibrate(capsys):
    assert main(["calibrate", "gripper", "--rig", "sim"]) == 2
    assert "no section hardware" in capsys.readouterr().err


def test_a_gripper_that_is_not_there_is_one_clear_line(rig, capsys):
    assert main(["calibrate", "gripper", "--rig", str(rig("/dev/ttyUSB99"))]) == 3
    error = capsys.readouterr().err
    assert "no serial port /dev/ttyUSB99 for the gripper" in error
    assert error.count("\n") == 1
