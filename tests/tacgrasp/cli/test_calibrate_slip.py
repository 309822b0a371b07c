"""``tacgrasp calibrate slip`` on the simulated rig."""

from dataclasses import replace

import pytest

from cltp.errors import TouchError
from cltp.tactile.shear.slip_calibration import load_slip_calibration
from sim.grasp.devices import SimGripper
from tacgrasp.base.errors import UsageError
from tacgrasp.cli.calibrate_slip import CalibrateSlipFlags, run
from tacgrasp.rig import factory
from tacgrasp.rig.gel_sense import GelSense


@pytest.mark.parametrize("sensor", ["taxels", "gelsight_mini_markers"])
def test_a_simulated_unit_is_calibrated(tmp_path, capsys, sensor):
    out = tmp_path / "slip.json"
    run(CalibrateSlipFlags(sensor=sensor, hold_s=2.0, out=out))
    found = load_slip_calibration(out, sensor)
    assert found.threshold > found.largest_score
    assert 0.001 < found.along_mm < 0.03
    assert f"written    {out}" in capsys.readouterr().out


def test_an_existing_file_stays(tmp_path):
    out = tmp_path / "slip.json"
    out.write_text("mine")
    with pytest.raises(UsageError, match="is kept"):
        run(CalibrateSlipFlags(out=out))
    assert out.read_text() == "mine"


def test_a_sensor_without_shear_is_refused_with_the_flag_that_names_another(tmp_path):
    with pytest.raises(UsageError, match=r"known: .*taxels; name one of them with --sensor"):
        run(CalibrateSlipFlags(out=tmp_path / "slip.json"))


@pytest.mark.parametrize("num_grips", [1, 3])
def test_ctrl_c_in_a_hold_leaves_the_gripper_open(num_grips, tmp_path, monkeypatch):
    grip, opens, grips = SimGripper.grip, [], []

    def interrupted(self, force_n):
        grips.append(grip(self, force_n))
        if len(grips) == num_grips:
            raise KeyboardInterrupt

    open_by = SimGripper.open_by
    monkeypatch.setattr(SimGripper, "grip", interrupted)
    monkeypatch.setattr(SimGripper, "open_by", lambda *a: opens.append(open_by(*a)))
    with pytest.raises(KeyboardInterrupt):
        run(CalibrateSlipFlags(sensor="taxels", hold_s=1.0, out=tmp_path / "slip.json"))
    assert [state.closed for state in opens] == [False]


def test_until_something_is_felt_the_fingers_close_with_the_rigs_first_force(tmp_path, monkeypatch):
    grip, asked = SimGripper.grip, []

    def recorded(self, force_n):
        asked.append(force_n)
        return grip(self, force_n)

    make = factory.make_centred_rig
    monkeypatch.setattr(SimGripper, "grip", recorded)
    monkeypatch.setattr(
        factory, "make_centred_rig", lambda config: replace(make(config), first_force_n=0.4)
    )
    run(CalibrateSlipFlags(sensor="taxels", hold_s=1.0, force_n=1.2, out=tmp_path / "slip.json"))
    assert asked[:2] == [0.4, 1.2]
    assert max(asked) == 1.2


def test_fingers_that_hold_nothing_calibrate_nothing(tmp_path, monkeypatch):
    monkeypatch.setattr(GelSense, "read_contact", lambda self: False)
    with pytest.raises(TouchError, match="nothing is felt at 1 N"):
        run(CalibrateSlipFlags(sensor="taxels", hold_s=1.0, out=tmp_path / "slip.json"))
    assert not (tmp_path / "slip.json").exists()


@pytest.mark.parametrize(
    ("flags", "message"),
    [
        ({"hold_s": 0.1}, "--hold-s"),
        ({"force_n": 500.0}, "beyond the gripper"),
    ],
)
def test_what_cannot_be_held_is_refused(tmp_path, flags, message):
    with pytest.raises(UsageError, match=message):
        run(CalibrateSlipFlags(out=tmp_path / "slip.json", **flags))
