"""``tacgrasp calibrate force`` on the simulated rig, and what it refuses and keeps."""

import pytest
import yaml

from cltp.sensing.force_calibration import load_force_calibration
from sim.emulators.dynamixel.bus_process import DynamixelEmulator
from sim.emulators.dynamixel.fingers import SpringLoad
from sim.grasp.devices import SimGripper
from sim.grasp.rig import build
from tacgrasp.__main__ import main
from tacgrasp.drivers.dynamixel.gripper import connect_gripper
from tests.fakes.emulated_servos import emulated_gripper
from tests.paths import ROOT

QUICK = ["--loads", "0.5", "1", "2"]


@pytest.fixture
def out(tmp_path):
    return tmp_path / "force.json"


def calibrate(out, *flags):
    return main(["calibrate", "force", "--out", str(out), *flags])


@pytest.mark.parametrize("by", ["weights", "gripper"])
def test_the_simulated_rig_is_calibrated_without_a_person(out, capsys, by):
    assert calibrate(out, *QUICK, "--by", by) == 0
    printed = capsys.readouterr().out
    for part in ("fitted [N]", "N per nominal N", f"written   {out}, for simulated", "next  "):
        assert part in printed
    made = load_force_calibration(out)
    assert [load.load_n for load in made.loads] == pytest.approx([0.5, 1, 2])
    assert made.factor == pytest.approx(1.0, abs=0.25)
    assert [path.name for path in out.parent.iterdir()] == [out.name]


def test_the_world_that_puts_the_loads_says_so_where_a_gripper_is_asked_for(out, capsys):
    assert calibrate(out, *QUICK, "--by", "gripper") == 0
    line = "put by the sim world, which knows their true force; --by gripper is for real devices"
    assert f"loads     {line}" in capsys.readouterr().out


def limited_rig(folder, **gripper):
    rig = yaml.safe_load((ROOT / "tacgrasp" / "rigs" / "sim.yaml").read_text())
    rig["gripper"] |= gripper
    path = folder / "limited.yaml"
    path.write_text(yaml.safe_dump(rig))
    return path


def test_the_default_loads_end_at_the_rigs_limit(out, tmp_path, capsys):
    rig = limited_rig(tmp_path, max_force_n=1.5)
    assert calibrate(out, "--rig", str(rig)) == 0
    printed = capsys.readouterr().out
    assert "loads     0.5 1 1.5 N, up to gripper.max_force_n 1.5 N" in printed
    made = load_force_calibration(out)
    assert [load.load_n for load in made.loads] == pytest.approx([0.5, 1, 1.5])


def test_loads_beyond_the_rigs_limits_are_refused_before_anything_moves(
    out, tmp_path, capsys, monkeypatch
):
    grips = []
    monkeypatch.setattr(SimGripper, "grip", lambda self, force_n: grips.append(force_n))
    rig = limited_rig(tmp_path, max_force_n=1.5)
    assert calibrate(out, "--rig", str(rig), "--loads", "1", "2", "4") == 2
    error = capsys.readouterr().err
    for part in ("max_force_n of", "to 1.5 N (at 2 4)", "like --loads 0.5 1 1.5; nothing moved"):
        assert part in error
    assert not grips
    assert not out.exists()


def test_a_gripper_that_still_grips_is_not_opened(out, tmp_path, capsys, monkeypatch):
    pytest.importorskip("dynamixel_sdk")
    emulator = DynamixelEmulator(SpringLoad(width_m=0.06))
    try:
        settings = emulated_gripper(emulator.serial_port, tmp_path)
        own = tmp_path / settings.calibration
        first = connect_gripper(settings.model_copy(update={"calibration": own}))
        first.grip(1.0)
        first.disconnect()
        box = {"workspace_low_m": [0.3, -0.2, 0.1], "workspace_high_m": [0.5, 0.0, 0.4]}
        rig = yaml.safe_load((ROOT / "tacgrasp" / "rigs" / "sim.yaml").read_text())
        rig["devices"], rig["gripper"]["first_force_n"] = "hardware", 0.5
        rig["hardware"] = {
            "arm": {"kind": "ur", "host": "127.0.0.2", "payload_kg": 1.0, **box},
            "gripper": settings.model_dump(mode="json"),
            "sensor": {"kind": "taxels", "port": "/dev/null"},
        }
        path = tmp_path / "real.yaml"
        path.write_text(yaml.safe_dump(rig))
        sensor = build("egg", 5).sensor
        sensor.disconnect = lambda: None
        monkeypatch.setattr("tacgrasp.rig.hardware.connect_sensor", lambda settings: sensor)
        before = emulator.facts()
        code = calibrate(out, *QUICK, "--rig", str(path), "--by", "gripper")
        assert code == 3
        assert "the gripper is not open: it still grips" in capsys.readouterr().err
        after = emulator.facts()
        assert (after["squeezes"], after["width_m"]) == (before["squeezes"], before["width_m"])
        assert after["force_n"] == pytest.approx(1.0, abs=0.02)
    finally:
        emulator.close()


def test_an_existing_file_is_kept_unless_it_may_be_replaced(out, capsys):
    out.write_text("mine")
    assert calibrate(out, *QUICK) == 2
    assert "exists and is kept; give --overwrite" in capsys.readouterr().err
    assert out.read_text() == "mine"
    assert calibrate(out, *QUICK, "--overwrite") == 0
    assert len(load_force_calibration(out).loads) == 3


@pytest.mark.parametrize(
    ("flags", "message"),
    [
        (["--loads", "1", "2"], "needs 3 to 50 loads, got 2"),
        (["--loads", "2", "1", "5"], "loads must rise, got 2 1 5"),
        (["--loads", "-1", "2", "5"], "loads are 0.01 to 100 N"),
        (["--loads", "0", "2", "5"], "loads are 0.01 to 100 N"),
        (["--loads", "1", "2", "2.5"], "3 times the smallest"),
        (["--loads", "1", "2", "nan"], "loads are 0.01 to 100 N"),
        (["--loads", "1", "2", "many"], "--loads"),
        (["--by", "hand"], "--by must be one of weights, gripper"),
        (["--rig", "none.yaml"], "none.yaml"),
        (["--object", "cup"], "no object 'cup'"),
    ],
)
def test_what_makes_no_calibration_is_one_line_and_writes_nothing(out, capsys, flags, message):
    assert calibrate(out, *flags) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
    assert not list(out.parent.iterdir())


def test_a_folder_that_is_missing_is_named_before_anything_is_measured(tmp_path, capsys):
    assert calibrate(tmp_path / "none" / "force.json") == 2
    assert "is no folder" in capsys.readouterr().err


def test_an_interrupted_measurement_keeps_the_old_file_and_its_readings(out, capsys, monkeypatch):
    out.write_text("mine")
    grip, grips = SimGripper.grip, []

    def interrupted(self, force_n):
        grips.append(force_n)
        if len(grips) == 3:
            raise KeyboardInterrupt
        return grip(self, force_n)

    monkeypatch.setattr(SimGripper, "grip", interrupted)
    try:
        code = calibrate(out, *QUICK, "--overwrite")
    except KeyboardInterrupt:
        code = 130
    assert code == 130
    assert out.read_text() == "mine"
    assert "force.json.unfinished; continue with --resume" in capsys.readouterr().out
    out.unlink()
    assert calibrate(out, *QUICK) == 2
    assert "holds the readings of an interrupted measurement" in capsys.readouterr().err
    assert calibrate(out, *QUICK, "--resume") == 0
    assert len(grips) == 4  # the last load alone is put on again
    assert len(load_force_calibration(out).loads) == 3
    assert [path.name for path in out.parent.iterdir()] == [out.name]
