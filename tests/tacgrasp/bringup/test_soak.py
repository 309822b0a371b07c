"""The communication test: success rate and jitter of each device, and one that loses readings."""

import pytest

from sim.emulators.process.spawn import EmulatorProcess
from tacgrasp.__main__ import main
from tacgrasp.bringup.soak import SoakCount, soak_findings
from tacgrasp.rig.emulated import settings_for
from tests.fakes.patient_rig import patient_config

pytest.importorskip("dynamixel_sdk")


@pytest.mark.parametrize(
    ("received", "gap_ms", "ok"),
    [(1000, 8.0, True), (991, 8.0, True), (989, 8.0, False), (1000, 61.0, False)],
)
def test_a_device_has_to_keep_success_rate_and_jitter(received, gap_ms, ok):
    count = SoakCount(expected=1000, received=received, gaps_ms=[gap_ms] * received)
    finding = count.finding("arm", "a packet every", 60.0)
    assert finding.ok is ok
    assert (
        f"success {received / 10:.2f} % of 1000; a packet every {gap_ms:.1f} ms" in finding.detail
    )
    assert ok or "a p99 below 60 ms" in finding.advice


def test_a_device_without_a_single_reading_has_not_passed():
    assert not SoakCount(expected=5, received=0, gaps_ms=[]).finding("sensor", "x", 60.0).ok


@pytest.fixture(scope="module")
def emulators():
    with EmulatorProcess("rig") as running:
        yield running


def test_all_devices_are_read_side_by_side_and_the_one_that_loses_readings_is_named(
    emulators, tmp_path
):
    config = patient_config(tmp_path)
    hardware = settings_for(config, config.hardware, emulators, tmp_path)
    good = soak_findings(hardware, config, 1.0)
    assert [finding.device for finding in good] == ["arm", "gripper", "sensor"]
    assert all("success" in finding.detail for finding in good)
    emulators.control.inject("dynamixel", "bad_crc", count=20)
    emulators.control.inject("ur", "freeze")
    arm, gripper, sensor = soak_findings(hardware, config, 1.0)
    emulators.control.clear("ur")
    emulators.control.clear("dynamixel")
    assert not arm.ok and "it ended early" in arm.detail
    assert not gripper.ok and "corrupt" in gripper.detail
    assert "success" in sensor.detail


@pytest.mark.parametrize("seconds", ["-1", "1e9", "nan"])
def test_a_soak_of_no_sensible_length_is_refused(seconds, capsys):
    assert main(["doctor", "--soak", seconds]) == 2
    assert "--soak must be 0 to 3600 seconds" in capsys.readouterr().err
