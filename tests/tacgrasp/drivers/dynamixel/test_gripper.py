"""The gripper's driver in use: forces, limits, faults while nobody asks, and every kind of end."""

import datetime
import math
import threading
import time

import pytest

from primitives import LimitError, RobotError
from primitives.errors import TorqueOffError
from sim.emulators.dynamixel.fingers import SpringLoad
from tacgrasp.drivers.dynamixel import registers as reg
from tacgrasp.drivers.dynamixel.calibration import load_calibration
from tacgrasp.drivers.dynamixel.fingers import connect_fingers
from tacgrasp.drivers.dynamixel.measure_calibration import calibrate_gripper, steps_ma
from tacgrasp.drivers.opening import check_open
from tests.fakes.emulated_servos import EmulatedServos, eventually

pytest.importorskip("dynamixel_sdk")


class Load:
    """Something 60 mm wide that notes what it was asked."""

    def __init__(self, width_m: float = 0.060) -> None:
        self.width_m = width_m
        self.forces: list[float] = []
        self.releases = 0

    def width_under(self, force_n: float) -> float:
        self.forces.append(force_n)
        return self.width_m

    def release(self) -> None:
        self.releases += 1


@pytest.fixture
def load():
    return Load()


@pytest.fixture
def servos(tmp_path, load):
    servos = EmulatedServos(tmp_path, load)
    yield servos
    servos.close()


@pytest.fixture
def gripper(servos):
    return servos.gripper()


# forces and widths


@pytest.mark.parametrize("force", [0.1, 0.5, 2.0, 12.0])
def test_a_force_arrives_as_it_was_asked_but_for_one_step_of_current(gripper, load, force):
    state = gripper.grip(force)
    assert load.forces == [pytest.approx(force, abs=0.0144 / 2 + 1e-6)]
    assert state.width_m == pytest.approx(0.060, abs=1.5e-4)


def test_every_grip_is_one_squeeze_also_the_same_again(gripper, load):
    for force in (1.0, 1.0, 1.5, 0.6):
        gripper.grip(force)
    assert len(load.forces) == 4


def test_opening_lets_go_once_and_stays_within_the_travel(gripper, load):
    gripper.grip(1.0)
    assert gripper.open_by(0.002).width_m == pytest.approx(0.062, abs=3e-4)
    assert gripper.open_by(1.0).width_m == pytest.approx(0.11, abs=7e-4)
    assert eventually(lambda: load.releases == 1)


def test_closing_on_nothing_ends_at_the_minimum(servos, load):
    load.width_m = 0.0
    state = servos.gripper().grip(1.0)
    assert (state.closed, state.width_m) == (True, pytest.approx(0, abs=7e-4))


def test_the_largest_force_is_what_was_calibrated(gripper, load):
    assert gripper.max_force_n == pytest.approx((900 - 12) * 0.0144)
    with pytest.raises(LimitError, match=r"force must lie in \(0, 12\.79\] N"):
        gripper.grip(12.8)
    assert load.forces == []


@pytest.mark.parametrize("clear", [0.0, -0.001, math.nan, math.inf])
def test_opening_by_nothing_is_refused(gripper, clear):
    with pytest.raises(LimitError, match="positive number of metres"):
        gripper.open_by(clear)


def test_what_was_sent_is_told_in_the_servos_words(gripper):
    gripper.grip(1.008)
    assert gripper.sent == "goal current 82 (82 mA), goal position 1600 ticks"
    with pytest.raises(LimitError):
        gripper.grip(99)
    assert gripper.sent == ""


def test_a_hand_takes_no_current_beyond_its_hard_limit(servos, load):
    fingers = connect_fingers(servos.settings)
    try:
        with pytest.raises(RobotError, match=r"current must lie in \(0, 900\] mA, got 901"):
            fingers.squeeze(901)
        assert load.forces == []
    finally:
        fingers.disconnect()


def test_fingers_that_do_not_get_there_are_an_error_in_bounded_time(servos):
    servos.setting(settle_timeout_s=0.5, speed_mm_s=10.0)
    gripper = servos.gripper()
    with pytest.raises(RobotError, match=r"did not come to rest .* within 0\.5 s; is the linkage"):
        gripper.grip(1.0)
    assert gripper.state().closed  # something may be held: the task has to open


def test_two_fingers_that_stand_apart_are_an_error(tmp_path):
    servos = EmulatedServos(tmp_path, Load(), num_servos=2)
    try:
        first, second = (servo.model_dump() for servo in servos.settings.servos)
        servos.setting(servos=[first, second | {"closed_ticks": 2296}])  # not where it is closed
        with pytest.raises(RobotError, match=r"two fingers stand at 60\.\d and 45\.\d mm"):
            servos.gripper().grip(1.0)
    finally:
        servos.close()


# start


def test_connecting_moves_nothing_and_sets_the_watchdog(servos, gripper, load):
    facts = servos.emulator.facts()
    assert (facts["torque"], facts["bus_watchdog"]) == (True, 25)
    assert (facts["position_ticks"], facts["squeezes"], load.forces) == (2496, 0, [])


def test_a_grip_that_an_earlier_run_has_kept_is_not_touched(servos, load):
    first = servos.gripper()
    first.grip(1.0)
    first.disconnect()
    second = servos.gripper()
    assert servos.emulator.facts()["force_n"] == pytest.approx(1.0, abs=0.02)
    assert (len(load.forces), load.releases) == (1, 0)
    assert second.open_by(0.005).width_m == pytest.approx(0.065, abs=5e-4)


@pytest.mark.parametrize("num_servos", [1, 2])
def test_a_grip_that_an_earlier_run_has_kept_is_the_state_of_the_next_one(
    tmp_path, load, num_servos
):
    servos = EmulatedServos(tmp_path, load, num_servos=num_servos)
    try:
        first = servos.gripper()
        assert not first.state().closed
        held = first.grip(1.0)
        first.disconnect()
        second = servos.gripper()
        kept = second.state()
        assert kept.closed
        assert kept.force_n == pytest.approx(held.force_n, abs=0.0144)  # one unit of current
        assert kept.width_m == pytest.approx(held.width_m, abs=5e-4)
        with pytest.raises(RobotError, match=r"not open: it still grips, with (0.99|1.00) N"):
            check_open(second)
        second.open_by(0.002)
        second.disconnect()
        third = servos.gripper()
        assert (third.state().closed, third.state().force_n) == (False, 0.0)
        check_open(third)
    finally:
        servos.close()


def test_a_grip_on_nothing_is_kept_too_and_fingers_that_open_by_little_are_not_open(servos, load):
    load.width_m = 0.0
    first = servos.gripper()
    first.grip(0.5)
    first.disconnect()
    second = servos.gripper()
    assert second.state().closed
    second.open_by(0.002)
    with pytest.raises(RobotError, match=r"2\.\d mm between the fingers, at least 5 mm.*\(key o;"):
        check_open(second)
    second.open_by(0.004)
    check_open(second)


def test_closed_servos_without_torque_grip_nothing_and_are_not_open(servos, load):
    load.width_m = 0.0
    first = servos.gripper()
    first.grip(0.5)
    first.disconnect()
    servos.poke(reg.TORQUE, 0)
    second = servos.gripper()
    assert (second.state().closed, second.state().force_n) == (False, 0.0)
    with pytest.raises(RobotError, match="between the fingers, at least 5 mm"):
        check_open(second)


def test_a_watchdog_that_an_earlier_run_let_trip_is_cleared(servos, load):
    servos.poke(reg.WATCHDOG, reg.WATCHDOG_TRIPPED)
    servos.gripper().grip(1.0)
    assert len(load.forces) == 1


# faults in motion: noticed while nobody asks


@pytest.mark.parametrize(
    ("fault", "match"),
    [
        ("silence", "does not answer"),
        ("alert", r"motor encoder failed \(hardware error 0x08\); it still holds"),
        ("overload", r"overloaded \(hardware error 0x20\); its torque is off: what was held"),
        ("over_temperature", r"overheated \(hardware error 0x04\)"),
        ("unplug", "is gone .* what it grips is still held"),
    ],
)
def test_a_fault_is_detected_and_latched(servos, fault, match):
    gripper = servos.gripper()
    gripper.grip(1.0)
    assert gripper.fault == ""
    servos.emulator.inject(fault)
    assert eventually(lambda: gripper.fault, 2.0)
    first_fault = gripper.fault
    with pytest.raises(RobotError, match=match):
        gripper.state()
    with pytest.raises(RobotError, match=match):
        gripper.grip(1.0)
    with pytest.raises(RobotError, match=match):
        gripper.open_by(0.002)
    servos.emulator.clear()
    time.sleep(0.1)
    assert gripper.fault == first_fault
    gripper.stop()
    gripper.disconnect()


@pytest.mark.parametrize(
    ("fault", "is_limp"),
    [("overload", True), ("over_temperature", True), ("reboot", True), ("alert", False)],
)
def test_a_servo_without_torque_is_known_to_hold_nothing(servos, fault, is_limp):
    gripper = servos.gripper()
    gripper.grip(1.0)
    servos.emulator.inject(fault)
    assert eventually(lambda: gripper.fault)
    for call in (gripper.state, gripper.check_alive, lambda: gripper.open_by(0.002)):
        with pytest.raises(RobotError) as raised:
            call()
        assert isinstance(raised.value, TorqueOffError) is is_limp


def test_heat_is_noticed_before_the_servo_lets_go(servos):
    gripper = servos.gripper()
    servos.poke(reg.TEMPERATURE, 66)
    assert eventually(lambda: gripper.fault)
    assert "66 °C hot, beyond 65 °C" in gripper.fault
    assert servos.emulator.facts()["torque"]


@pytest.mark.parametrize("is_gripping", [True, False])
@pytest.mark.parametrize(
    ("address", "value", "text"),
    [
        (
            reg.TORQUE,
            0,
            "torque of servo 1 of the gripper reads 0, set was 1: what was held has been let go",
        ),
        (reg.OPERATING_MODE, 3, "operating mode of servo 1 of the gripper reads 3, set was 5"),
        (reg.WATCHDOG, 0, "bus watchdog of servo 1 of the gripper reads 0, set was 25"),
        (reg.WATCHDOG, reg.WATCHDOG_TRIPPED, "bus watchdog of servo 1 has tripped"),
        (reg.GOAL_CURRENT, 909, "what it holds is pressed with up to 909 mA"),
        (reg.GOAL_POSITION, 2000, "goal position of servo 1 of the gripper reads 2000"),
        (reg.HARDWARE_ERROR, 0x01, "input voltage out of its limits"),
    ],
)
def test_a_register_other_than_commanded_is_a_fault_within_two_polls(
    servos, gripper, address, value, text, is_gripping
):
    if is_gripping:
        gripper.grip(1.0)
    before = gripper._fingers.poller.num_polls
    servos.poke(address, value)
    assert eventually(lambda: gripper.fault)
    assert text in gripper.fault
    assert gripper._fingers.poller.num_polls - before <= 2
    for call in (gripper.state, gripper.check_alive, lambda: gripper.grip(1.0)):
        with pytest.raises(RobotError, match="servo 1"):
            call()


@pytest.mark.parametrize("silent_ms", [0, 300])
def test_a_servo_that_restarts_while_it_holds_is_a_fault_and_says_what_became_of_the_grip(
    servos, gripper, load, silent_ms
):
    gripper.grip(1.0)
    servos.emulator.inject("reboot", silent_ms=silent_ms)
    assert eventually(lambda: gripper.fault)
    assert "has restarted: its torque is off" in gripper.fault
    assert "what was held has been let go" in gripper.fault
    assert load.releases == 1
    with pytest.raises(RobotError, match="has restarted"):
        gripper.state()


def test_a_state_asked_for_right_after_a_restart_is_never_made_up(servos, gripper):
    gripper.grip(1.0)
    servos.emulator.inject("reboot")
    with pytest.raises(RobotError, match="has restarted"):
        gripper.state()


@pytest.mark.parametrize("ticks", [6, 15])
def test_fingers_that_rest_wider_than_asked_are_open(servos, gripper, monkeypatch, ticks):
    gripper.grip(1.0)
    servo, asked_m = servos.emulator._servos[0], gripper.state().width_m + 0.005
    publish = servo.publish

    def publish_wider():
        publish()
        servo.table[reg.PRESENT_POSITION] -= servo.closing * ticks

    monkeypatch.setattr(servo, "publish", publish_wider)
    assert gripper.open_by(0.005).width_m > asked_m


def test_a_tripped_watchdog_is_noticed(servos):
    gripper = servos.gripper()
    servos.poke(reg.WATCHDOG, reg.WATCHDOG_TRIPPED)
    assert eventually(lambda: "bus watchdog of servo 1 has tripped" in gripper.fault)


def test_a_computer_that_asks_too_late_is_not_taken_for_a_silent_gripper(gripper):
    gripper._fingers.poller.close()  # as if its thread had no time
    assert eventually(lambda: "last whole reply is" in gripper.check_alive())
    assert "this computer was late to ask for one" in gripper.check_alive()


def test_silence_is_told_at_once_and_is_a_fault_only_when_patience_ends(servos, gripper):
    assert eventually(lambda: gripper.check_alive() == "")
    servos.emulator.inject("silence")
    assert eventually(lambda: "last whole reply is" in gripper.check_alive(), 0.9)
    assert "this computer" not in gripper.check_alive()
    assert gripper.fault == ""
    assert eventually(lambda: "does not answer" in gripper.fault)
    with pytest.raises(RobotError, match="does not answer"):
        gripper.check_alive()


def test_a_bus_that_stalls_for_60_ms_is_no_fault(servos, gripper):
    for fault in ("silence", "partial_reply"):
        servos.emulator.inject(fault, count=3)
        threading.Timer(0.06, servos.emulator.clear).start()
        time.sleep(0.3)
        assert eventually(lambda: gripper.check_alive() == "")
    assert gripper.fault == ""
    assert gripper.grip(1.0).force_n == 1.0


def test_a_pause_of_the_bus_is_waited_out(servos, gripper):
    servos.emulator.inject("silence")
    threading.Timer(0.15, servos.emulator.clear).start()
    assert eventually(lambda: gripper.transients.silent == 1)
    assert gripper.grip(1.0).force_n == 1.0
    assert gripper.fault == ""


@pytest.mark.parametrize("fault", ["silence", "overload", "unplug"])
def test_a_fault_ends_a_grip_that_is_under_way(servos, fault):
    servos.setting(speed_mm_s=20.0)
    gripper = servos.gripper()
    timer = threading.Timer(0.15, lambda: servos.emulator.inject(fault))
    timer.start()
    began = time.monotonic()
    with pytest.raises(RobotError):
        gripper.grip(1.0)
    assert time.monotonic() - began < 2.0  # the way alone takes 2.5 s
    timer.join()


@pytest.mark.parametrize(
    ("fault", "counted"),
    [("bad_crc", "corrupt"), ("partial_reply", "corrupt"), ("late_reply", "silent")],
)
def test_a_transient_is_survived_and_counted(servos, gripper, fault, counted):
    gripper.grip(1.0)
    servos.emulator.inject(fault, delay_ms=70)
    assert eventually(lambda: getattr(gripper.transients, counted) == 1)
    assert gripper.grip(1.2).force_n == 1.2
    assert gripper.fault == ""


def test_polling_feeds_the_watchdog_while_nobody_asks(servos):
    servos.setting(bus_watchdog_ms=600)
    servos.gripper()
    time.sleep(1.0)
    assert servos.emulator.facts()["bus_watchdog"] == 30


# ends


def test_disconnect_keeps_the_grip_and_frees_the_port(servos, gripper, load):
    gripper.grip(1.0)
    gripper.disconnect()
    with pytest.raises(RobotError, match="disconnected"):
        gripper.state()
    facts = servos.emulator.facts()
    assert (facts["torque"], facts["bus_watchdog"], load.releases) == (True, 0, 0)
    assert facts["force_n"] == pytest.approx(1.0, abs=0.02)
    servos.gripper()  # the port is free


def test_a_program_that_dies_leaves_the_grip_and_the_next_one_goes_on(servos, load):
    servos.setting(bus_watchdog_ms=200)
    dead = servos.gripper()
    dead.grip(1.0)
    dead._fingers.poller.close()  # as after kill -9: nothing is said any more, the port is freed
    dead._fingers.bus.close()
    assert eventually(lambda: servos.emulator.facts()["bus_watchdog"] == reg.WATCHDOG_TRIPPED)
    assert servos.emulator.facts()["force_n"] == pytest.approx(1.0, abs=0.02)
    following = servos.gripper()
    assert following.state().closed
    assert following.open_by(0.005).width_m == pytest.approx(0.065, abs=5e-4)
    assert eventually(lambda: load.releases == 1)


def test_stop_halts_fingers_on_their_way(servos):
    servos.setting(speed_mm_s=20.0)
    gripper = servos.gripper()
    failed = []

    def grip():
        try:
            gripper.grip(1.0)
        except RobotError as error:
            failed.append(error)

    thread = threading.Thread(target=grip)
    thread.start()
    assert eventually(lambda: servos.emulator.facts()["position_ticks"] < 2480)
    gripper.stop()
    where = gripper.state().width_m
    assert where > 0.07
    thread.join(timeout=3)
    assert not thread.is_alive()
    assert [str(error) for error in failed] == ["the fingers were stopped on their way"]
    assert eventually(lambda: not servos.emulator.facts()["moving"])
    assert gripper.state().width_m == pytest.approx(where, abs=3e-3)


def test_disconnecting_ends_a_grip_that_another_thread_waits_for(servos):
    servos.setting(speed_mm_s=10.0)
    gripper, failed = servos.gripper(), []

    def grip():
        try:
            gripper.grip(1.0)
        except RobotError as error:
            failed.append(str(error))

    thread = threading.Thread(target=grip)
    thread.start()
    assert eventually(lambda: servos.emulator.facts()["position_ticks"] < 2490)
    gripper.disconnect()
    thread.join(timeout=3)
    assert not thread.is_alive()
    assert failed == ["the gripper is disconnected"]


def test_stop_leaves_a_resting_grip_alone(servos, gripper, load):
    gripper.grip(1.0)
    gripper.stop()
    assert servos.emulator.facts()["force_n"] == pytest.approx(1.0, abs=0.02)
    assert (len(load.forces), load.releases) == (1, 0)


# calibration on the device


def test_calibrating_finds_the_line_of_the_fingers(tmp_path):
    servos = EmulatedServos(tmp_path, SpringLoad(width_m=0.10))
    fingers = connect_fingers(servos.settings)
    try:
        made = calibrate_gripper(
            fingers,
            lambda current_ma: float(servos.emulator.facts()["force_n"]),
            steps_ma(400, 5),
            date=datetime.date(2026, 11, 21),
        )
        known = load_calibration(tmp_path / servos.settings.calibration)
        assert made.newtons_per_ma == pytest.approx(known.newtons_per_ma, rel=0.01)
        assert made.friction_ma == pytest.approx(known.friction_ma, abs=1)
        assert made.residual_n < 0.02
        assert fingers.width_m() == pytest.approx(0.11, abs=1e-3)  # open again
    finally:
        fingers.disconnect()
        servos.close()


def test_a_reading_that_fails_opens_the_fingers(servos, load):
    fingers = connect_fingers(servos.settings)
    try:
        with pytest.raises(RobotError, match="a reading is"):
            calibrate_gripper(
                fingers, lambda _: math.nan, [50.0, 60.0], date=datetime.date(2026, 11, 21)
            )
        assert fingers.width_m() == pytest.approx(0.11, abs=1e-3)
        with pytest.raises(LimitError, match=r"currents must lie in \(0, 900\] mA"):
            calibrate_gripper(fingers, lambda _: 1.0, [950.0], date=datetime.date(2026, 11, 21))
    finally:
        fingers.disconnect()
