"""What refuses a start of the gripper: each check, what it says, and that nothing was written."""

import datetime
import time

import pytest
from pydantic import ValidationError

from primitives import LimitError, RobotError
from tacgrasp.drivers.dynamixel import registers as reg
from tacgrasp.drivers.dynamixel.calibration import load_calibration, save_calibration
from tacgrasp.drivers.dynamixel.gripper import check, connect_gripper
from tacgrasp.drivers.dynamixel.settings import DynamixelSettings
from tests.fakes.emulated_servos import EmulatedServos

pytest.importorskip("dynamixel_sdk")


@pytest.fixture
def servos(tmp_path):
    servos = EmulatedServos(tmp_path, num_servos=2)
    yield servos
    servos.close()


def refused(servos: EmulatedServos, match: str) -> None:
    """The start is refused in time with these words, and the servos are as they were."""
    before = servos.emulator.facts()
    began = time.monotonic()
    with pytest.raises(RobotError, match=match):
        servos.gripper()
    assert time.monotonic() - began < 2
    after = servos.emulator.facts()
    assert not after["torque"]
    assert after["position_ticks"] == before["position_ticks"]
    assert after["bus_watchdog"] == before["bus_watchdog"]


@pytest.mark.parametrize(
    ("address", "value", "match"),
    [
        (
            reg.MODEL,
            1060,
            r"model: XL430-W250, expected XC330-T288; this model has no current ",
        ),
        (reg.MODEL, 1020, r"model: XM430-W350, expected XC330-T288; give the rig's file the right"),
        (reg.MODEL, 4321, r"model: model number 4321, expected XC330-T288"),
        (reg.FIRMWARE, 37, r"firmware: version 37, 38 or later is needed .* update it"),
        (reg.OPERATING_MODE, 3, r"operating mode: 3, expected 5 .* set register 11 to 5"),
        (reg.DRIVE_MODE, 4, r"drive mode: 0x04, expected .* set register 10 to 0"),
        (reg.STATUS_RETURN, 1, r"(status return level: 1, expected 2|does not answer)"),
        (reg.SHUTDOWN, 0x14, r"shutdown mask: 0x14, it would not let go when overloaded; .* to 52"),
        (reg.CURRENT_LIMIT, 500, r"current limit: 500 mA, max_current_ma is 900; lower"),
        (reg.VOLTAGE, 45, r"voltage: 4\.5 V, allowed 5\.5 to 14\.0 V; check the power"),
        (reg.TEMPERATURE, 66, r"temperature: 66 °C, at most 65 °C; let it cool"),
        (reg.HARDWARE_ERROR, 0x20, r"hardware error: overloaded; .* reboot"),
    ],
)
@pytest.mark.parametrize("servo", [1, 2])
def test_a_servo_that_is_not_as_it_must_be_is_refused(servos, servo, address, value, match):
    servos.poke(address, value, id=servo)
    refused(servos, rf"servo {servo} {match}")


def test_a_lost_turn_count_is_refused(servos):
    servo = servos.settings.servos[0].model_dump()
    other = servos.settings.servos[1].model_dump()
    turned = servo | {name: servo[name] + 4096 for name in ("open_ticks", "closed_ticks")}
    servos.setting(servos=[turned, other])
    refused(servos, r"servo 1 position: 2496 ticks, its travel is 5696 to 6592; the turn count")


@pytest.mark.parametrize("garbage", [0, 1])
def test_at_a_wrong_baud_rate_the_right_one_is_told(servos, garbage):
    servos.emulator.inject("wrong_baud", garbage=garbage)
    refused(servos, r"expected XC330-T288 at id 1, 1000000 baud.* it answers at 57600 baud: give")


def test_no_answer_at_all_says_what_to_check(servos):
    servos.emulator.inject("silence")
    refused(servos, r"it answers at no other baud rate either; check that the power is on")


def test_a_port_that_another_program_has_is_refused(servos):
    servos.emulator.inject("port_taken")
    refused(servos, r"in use by another program")


def test_a_missing_port_is_refused(servos):
    servos.setting(port="/dev/ttyUSB99")
    refused(servos, r"no serial port /dev/ttyUSB99 for the gripper")


def test_a_port_that_is_no_terminal_is_refused(servos, tmp_path):
    (tmp_path / "file").write_text("no port")
    servos.setting(port=str(tmp_path / "file"))
    refused(servos, r"can't be opened")


@pytest.mark.parametrize(
    ("values", "match"),
    [
        ({"unit": "another"}, r"of another gripper: its unit is emulated, this one's another"),
        ({"max_calibration_age_days": 30}, r"31 days old \(max_calibration_age_days is 30\)"),
        ({"calibration": "none.yaml"}, r"no calibration of the gripper at .*none\.yaml; make one"),
    ],
)
def test_a_calibration_that_does_not_fit_is_refused(servos, values, match):
    servos.setting(**values)
    later = datetime.date.today() + datetime.timedelta(days=31)
    with pytest.raises(RobotError, match=match):
        connect_gripper(servos.settings, folder=servos.folder, today=lambda: later)


@pytest.mark.parametrize("calibration", ["missing", "old", "of the future", "of another gripper"])
def test_a_gripper_opens_and_does_not_grip_whatever_its_calibration_is(servos, calibration, caplog):
    caplog.set_level("WARNING", "tacgrasp.drivers.dynamixel.gripper")
    first, days = servos.gripper(), {"old": 91, "of the future": -1}.get(calibration, 0)
    first.grip(1.0)
    first.disconnect()
    if calibration == "missing":
        (servos.folder / servos.settings.calibration).unlink()
    elif calibration == "of another gripper":
        servos.setting(unit="another")
    date = datetime.date.today() + datetime.timedelta(days=days)
    gripper = servos.gripper(today=lambda: date, must_grip=False)
    assert caplog.text.count("the gripper only opens: ") == 1
    assert (gripper.state().closed, gripper.max_force_n) == (True, 0.0)
    with pytest.raises(LimitError, match="calibration"):
        gripper.grip(0.5)
    width_m = gripper.state().width_m
    assert gripper.open_by(0.01).width_m == pytest.approx(width_m + 0.01, abs=5e-4)
    assert not gripper.state().closed


def test_after_a_refusal_the_port_is_free(servos):
    servos.poke(reg.OPERATING_MODE, 3)
    refused(servos, "operating mode")
    servos.emulator.clear()
    servos.gripper()
    assert servos.emulator.facts()["torque"]


def test_doctor_finds_all_well_without_writing_or_moving(servos):
    findings = check(servos.settings, folder=servos.folder)
    assert [f.name for f in findings if not f.ok and f.name != "latency"] == []
    names = [finding.name for finding in findings]
    assert names[0] == "port" and names[-1] == "calibration" and "latency" in names
    assert "over 200 reads" in next(f.detail for f in findings if f.name == "latency")
    facts = servos.emulator.facts()
    assert (facts["torque"], facts["bus_watchdog"], facts["moving"]) == (False, 0, False)


def test_doctor_says_all_that_is_wrong_at_once(servos):
    servos.poke(reg.OPERATING_MODE, 3, id=1)
    servos.poke(reg.TEMPERATURE, 80, id=2)
    servos.setting(unit="another")
    wrong = [f.name for f in check(servos.settings, folder=servos.folder) if not f.ok]
    assert [name for name in wrong if name != "latency"] == [
        "servo 1 operating mode",
        "servo 2 temperature",
        "calibration",
    ]


def test_doctor_finds_a_gripper_that_still_grips_and_leaves_it_so(servos):
    gripper = servos.gripper()
    gripper.grip(1.0)
    gripper.disconnect()
    (opening,) = [f for f in check(servos.settings, folder=servos.folder) if f.name == "opening"]
    assert not opening.ok
    assert "79.6 mm of 110 mm, gripping with 81 mA" in opening.detail
    assert (
        "a run is refused: the gripper is not open: it still grips, with 0.99 N" in opening.advice
    )
    assert "tacgrasp jog (key o; --open needs the gripper alone)" in opening.advice
    assert servos.emulator.facts()["force_n"] == pytest.approx(1.0, abs=0.02)


@pytest.mark.parametrize(("first_force_n", "ok"), [(0.02, True), (0.014, False)])
def test_doctor_says_where_the_least_command_is_above_the_first_force(servos, first_force_n, ok):
    *_, last = check(servos.settings, folder=servos.folder, first_force_n=first_force_n)
    assert (last.name, last.ok) == ("first force", ok)
    assert "steps of 0.014 N or more; the least command is 0.014 N" in last.detail
    assert ok or "press harder than gripper.first_force_n" in last.advice


def test_a_gripper_that_presses_with_its_least_current_has_that_as_its_least_command(servos):
    path = servos.folder / servos.settings.calibration
    line = load_calibration(path).model_copy(update={"friction_ma": -20.0})
    save_calibration(path, line)
    *_, last = check(servos.settings, folder=servos.folder, first_force_n=0.3)
    assert not last.ok  # (1 mA + 20 mA) × 0.0144 N/mA
    assert "the least command is 0.302 N" in last.detail


def test_doctor_goes_on_without_a_port(servos):
    servos.setting(port="/dev/ttyUSB99")
    findings = check(servos.settings, folder=servos.folder)
    assert [(f.name, f.ok) for f in findings] == [("port", False), ("calibration", True)]


@pytest.mark.parametrize(
    ("values", "match"),
    [
        ({"baud": 12345}, "baud must be one of"),
        ({"model": "XL430-W250"}, "with current control"),
        ({"bus_watchdog_ms": 510}, "multiple of 20"),
        ({"bus_watchdog_ms": 100}, "multiple of 20 from 200 on"),
        ({"closed_width_mm": 200.0}, "below open_width_mm"),
        ({"open_current_ma": 901.0}, "above max_current_ma"),
        ({"drain_ms": 30.0}, "greater than or equal to 60"),
        ({"ports": "/dev/null"}, "Extra inputs"),
    ],
)
def test_settings_that_can_not_be_are_refused(servos, values, match):
    with pytest.raises(ValidationError, match=match):
        servos.setting(**values)


def test_two_servos_need_two_ids(servos):
    one = servos.settings.servos[0]
    with pytest.raises(ValidationError, match="two ids"):
        DynamixelSettings(**(servos.settings.model_dump() | {"servos": [one, one]}))


def test_a_servo_without_travel_is_refused(servos):
    with pytest.raises(ValidationError, match="must differ"):
        servos.setting(servos=[{"id": 1, "open_ticks": 5, "closed_ticks": 5}])
