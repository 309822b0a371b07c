"""The emulated UR controller: motions in closed form, kinematics, registers, and the library."""

import json
import math
import os
import struct
import subprocess
import sys

import numpy as np
import pytest

from sim.emulators.process.spawn import EmulatorProcess
from sim.emulators.ur import packets as ur_packets
from sim.emulators.ur.controller import NORMAL, PROTECTIVE, SAFETY_BITS, Controller
from sim.emulators.ur.controller_process import UrEmulator
from sim.emulators.ur.kinematics import (
    READY_Q,
    as_frame,
    base_from_flange,
    jacobian,
    joints_of,
    matrix,
    rotvec,
)
from sim.emulators.ur.motion import AT_REST, Line, ToolState, run_at, stop_at
from sim.emulators.ur.options import START_TCP, TCP_OFFSET, UrOptions
from sim.emulators.ur.robot import Robot

START = np.array(START_TCP)


def loopback(row):
    """An address that no other run of these tests uses now."""
    high, low = divmod(os.getpid() % (254 * 254), 254)
    return f"127.{row}.{high + 1}.{low + 1}"


class Clock:
    def __init__(self):
        self.now_s = 100.0

    def __call__(self):
        return self.now_s


def controller(clock, listener=None):
    return Controller(START, np.array(TCP_OFFSET), listener, clock)


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def machine(clock):
    """A controller whose program runs."""
    machine = controller(clock)
    machine.start_program()
    return machine


def wait(machine, clock, seconds):
    clock.now_s += seconds
    machine.advance()


def send(machine, command, doubles=(), ints=()):
    """Write registers as one data packet of ur_rtde does."""
    machine.inputs |= {f"input_double_register_{i}": v for i, v in enumerate(doubles)}
    machine.inputs |= {f"input_int_register_{i + 1}": v for i, v in enumerate(ints)}
    machine.inputs["input_int_register_0"] = command
    machine.on_inputs(kicked=True)


def done(machine):
    """The acknowledged end of a command, as the library does it."""
    assert machine.outputs["output_int_register_0"] == 2
    send(machine, 0)
    assert machine.outputs["output_int_register_0"] == 1


def moved_line(machine, clock, *, asynchronous=True, up_m=0.1, speed=0.4, acceleration=10.0):
    target = START + np.array([0, 0, up_m, 0, 0, 0])
    send(machine, 3, [*target, speed, acceleration], [1 if asynchronous else 0])
    wait(machine, clock, 0.1)
    return target


# -- motions and kinematics ----------------------------------------------------------------------


def place(position=(0.0, 0.0, 0.0), twist=AT_REST):
    return ToolState(position_m=np.array(position), rotation=np.eye(3), twist=np.array(twist))


def test_a_line_takes_the_time_of_its_trapezoid_and_ends_at_its_target():
    line = Line(place(), np.array([0.1, 0.0, 0.0]), np.eye(3), 0.4, 10.0)
    assert line.duration_s == pytest.approx(0.1 / 0.4 + 0.4 / 10)
    assert line.at(0.04).twist[0] == pytest.approx(0.4)
    assert line.at(0.04).position_m[0] == pytest.approx(0.4 * 0.04 / 2)
    assert line.at(line.duration_s / 2).position_m[0] == pytest.approx(0.05)
    assert line.at(9).position_m[0] == 0.1
    assert not line.at(9).twist.any()


def test_a_line_of_a_micrometre_takes_the_time_of_its_turn():
    turned = matrix(np.array([0.0, 0.0, 0.4]))
    line = Line(place(), np.array([1e-6, 0.0, 0.0]), turned, 0.1, 1.0)
    assert line.duration_s == pytest.approx(4.1)
    assert line.at(2.0).twist[5] == pytest.approx(0.1)


def test_a_short_line_never_reaches_its_speed():
    line = Line(place(), np.array([0.001, 0.0, 0.0]), np.eye(3), 0.4, 2.5)
    assert line.duration_s == pytest.approx(2 * math.sqrt(0.001 / 2.5))
    assert line.at(line.duration_s / 2).twist[0] == pytest.approx(math.sqrt(0.001 * 2.5))


def test_a_stop_covers_v_squared_over_two_a_on_the_present_course():
    stop = stop_at(place(twist=(0.3, 0, -0.4, 0, 0, 0)), 10.0)
    assert stop.duration_s == pytest.approx(0.05)
    end = stop.at(stop.duration_s)
    assert end.position_m == pytest.approx([0.3 * 0.025, 0, -0.4 * 0.025])
    assert not end.twist.any()


def test_a_speed_is_reached_at_the_acceleration_and_kept():
    ramp = run_at(place(), np.array([0.1, 0, 0, 0, 0, 0]), 0.5, math.inf)
    assert ramp.at(0.1).twist[0] == pytest.approx(0.05)
    assert ramp.at(1.2).twist[0] == pytest.approx(0.1)
    assert ramp.at(1.2).position_m[0] == pytest.approx(0.01 + 0.1)


@pytest.mark.parametrize(
    "vector", [(0, 0, 0), (1e-9, 0, 0), (0.3, -0.2, 1.0), (math.pi, 0, 0), (0, 2.2, -2.2)]
)
def test_a_rotation_vector_survives_the_matrix(vector):
    turn = matrix(np.array(vector, dtype=float))
    assert matrix(rotvec(turn)) == pytest.approx(turn, abs=1e-9)


def test_joints_bring_the_tool_where_it_is_asked():
    tool = as_frame(np.array(TCP_OFFSET))
    for corner in ((0.35, -0.2, 0.12), (0.55, 0.0, 0.4), (0.35, 0.0, 0.4)):
        pose = np.array([*corner, math.pi, 0.0, 0.0])
        q = joints_of(as_frame(pose) @ np.linalg.inv(tool), READY_Q)
        assert base_from_flange(q) @ tool == pytest.approx(as_frame(pose), abs=1e-8)
        assert (base_from_flange(q) @ tool)[:3, 3] == pytest.approx(corner, abs=1e-8)


def test_what_is_out_of_reach_has_no_joints():
    with pytest.raises(ValueError, match="no posture"):
        joints_of(as_frame(np.array([2.0, 0, 0.2, math.pi, 0, 0])), READY_Q)


def test_the_jacobian_is_the_derivative_of_the_pose():
    q, step = np.array(READY_Q), 1e-6
    before = base_from_flange(q)
    for joint in range(6):
        after = base_from_flange(q + step * np.eye(6)[joint])
        moved = (after[:3, 3] - before[:3, 3]) / step
        turned = rotvec(after[:3, :3] @ before[:3, :3].T) / step
        assert jacobian(q)[:, joint] == pytest.approx([*moved, *turned], abs=1e-4)


def test_joint_speeds_move_the_tool_at_its_speed():
    robot = Robot(START, np.array(TCP_OFFSET), None, 0.0)
    robot.begin(run_at(robot.tool, np.array([0.1, 0, 0.05, 0, 0, 0.2]), 10.0, math.inf))
    robot.advance(0.5)
    q, qd = robot.joints().copy(), robot.joint_speeds()
    tool = as_frame(np.array(TCP_OFFSET))
    nudged = base_from_flange(q + 1e-6 * qd) @ tool
    speed = (nudged[:3, 3] - (base_from_flange(q) @ tool)[:3, 3]) / 1e-6
    assert speed == pytest.approx([0.1, 0, 0.05], abs=1e-4)


# -- the control script's registers --------------------------------------------------------------


def test_an_asynchronous_line_is_acknowledged_at_once_and_reports_its_progress(machine, clock):
    before = machine.outputs["output_int_register_2"] >> 24
    target = moved_line(machine, clock)
    done(machine)
    assert machine.outputs["output_int_register_2"] & 0x8000
    assert machine.outputs["output_int_register_2"] >> 24 == before + 1
    wait(machine, clock, 1)
    assert not machine.outputs["output_int_register_2"] & 0x8000
    assert machine.robot.tcp_pose() == pytest.approx(target)


def test_a_synchronous_line_trips_the_watchdog_since_nobody_can_kick(machine, clock):
    send(machine, 35, [10.0])
    done(machine)
    moved_line(machine, clock, asynchronous=False)
    assert machine.outputs["output_int_register_0"] == 1
    wait(machine, clock, 0.01)
    assert machine.program is None
    assert "watchdog" in machine.end_reason
    wait(machine, clock, 0.1)
    assert machine.robot.speed_m_s == 0
    assert machine.robot.tool.position_m[2] < START[2] + 0.099


def test_a_speed_goes_on_after_its_time_until_the_watchdog_stops_it(machine, clock):
    send(machine, 35, [10.0])
    done(machine)
    send(machine, 10, [0, 0, 0.05, 0, 0, 0, 0.5, 0.1])  # time = 0.1 s
    for _ in range(50):
        clock.now_s += 0.01
        send(machine, 10, [0, 0, 0.05, 0, 0, 0, 0.5, 0.1])
    assert machine.robot.speed_m_s == pytest.approx(0.05)
    for _ in range(12):
        wait(machine, clock, 0.01)
    assert machine.program is None
    assert machine.robot.speed_m_s == 0


def test_a_line_stop_does_not_end_a_speed_but_a_speed_stop_does(machine, clock):
    send(machine, 10, [0, 0, 0.05, 0, 0, 0, 0.5, 0.0])
    wait(machine, clock, 0.5)
    send(machine, 33, [10.0], [0])
    for _ in range(3):
        wait(machine, clock, 0.5)
    done(machine)
    assert machine.robot.speed_m_s == pytest.approx(0.05)
    send(machine, 15, [10.0])
    for _ in range(3):
        wait(machine, clock, 0.5)
    assert machine.robot.speed_m_s == 0


def stop_time_s(machine, clock, deceleration):
    moved_line(machine, clock, speed=0.2)
    done(machine)
    send(machine, 33, [deceleration], [0])
    started_s = clock.now_s
    while machine.robot.speed_m_s > 1e-3:
        wait(machine, clock, 0.001)
    return clock.now_s - started_s


def test_a_line_stop_brakes_in_joint_space_until_the_first_asynchronous_one(machine, clock):
    by_joints_s = stop_time_s(machine, clock, 2.0)
    clock = Clock()
    machine = controller(clock)
    machine.start_program()
    send(machine, 33, [2.0], [1])
    machine.advance()
    done(machine)
    straight_s = stop_time_s(machine, clock, 2.0)
    assert straight_s == pytest.approx(0.1, abs=0.003)
    assert abs(by_joints_s - straight_s) > 0.02


def test_a_moved_stretch_is_reported_as_covered_and_the_move_ends_when_the_world_followed():
    clock, segments, followed = Clock(), [], [False]

    def report(segment):
        segments.append(segment)
        return lambda: followed[0]

    machine = controller(clock, report)
    machine.start_program()
    moved_line(machine, clock, speed=0.3, acceleration=2.5)
    done(machine)
    wait(machine, clock, 2)
    assert [s.by_base_m.round(9).tolist() for s in segments] == [[0, 0, 0.1]]
    assert (segments[0].speed_m_s, segments[0].acceleration_m_s2) == (0.3, 2.5)
    assert machine.outputs["output_int_register_2"] & 0x8000
    followed[0] = True
    machine.advance()
    assert not machine.outputs["output_int_register_2"] & 0x8000


def test_a_segment_without_a_commanded_speed_is_reported_with_the_one_it_reached():
    clock, segments = Clock(), []
    machine = controller(clock, lambda segment: segments.append(segment) or (lambda: True))
    machine.start_program()
    send(machine, 24, [*(START + np.array([0, 0, 0.01, 0, 0, 0])), 0, 0, 0.002, 0.1, 300])
    for _ in range(20):
        wait(machine, clock, 0.02)
    send(machine, 16, [10.0])  # servoStop
    wait(machine, clock, 1)
    assert segments[0].by_base_m[2] == pytest.approx(0.01, abs=1e-3)
    assert 0.01 < segments[0].speed_m_s < 0.101  # 10 mm within a look-ahead of 0.1 s
    assert segments[0].acceleration_m_s2 > 0


def test_a_line_cut_short_is_reported_with_what_was_really_covered():
    clock, segments = Clock(), []
    machine = controller(clock, lambda segment: segments.append(segment) or (lambda: True))
    machine.start_program()
    moved_line(machine, clock)
    machine.protective_stop()
    wait(machine, clock, 1)
    assert segments[0].by_base_m[2] == pytest.approx(machine.robot.tool.position_m[2] - START[2])
    assert 0.03 < segments[0].by_base_m[2] < 0.09


def test_a_stop_is_measured_from_injection_until_below_a_millimetre_per_second(machine, clock):
    moved_line(machine, clock)
    assert machine.robot.speed_m_s == pytest.approx(0.4)
    machine.robot.watch_stop(clock.now_s)
    machine.protective_stop()
    wait(machine, clock, 0.3)  # however late it is looked at
    assert machine.robot.stopped_after_s == pytest.approx((0.4 - 1e-3) / 10, abs=1e-5)
    machine.robot.watch_stop(clock.now_s)
    assert machine.robot.stopped_after_s is None


def test_a_slider_at_half_makes_a_move_take_twice_as_long_and_at_zero_holds_it(machine, clock):
    machine.robot.speed_fraction = 0.5
    moved_line(machine, clock, speed=0.1)
    assert machine.robot.speed_m_s == pytest.approx(0.05)
    machine.robot.speed_fraction = 0.0
    here = machine.robot.tool.position_m.copy()
    wait(machine, clock, 1)
    assert machine.robot.tool.position_m == pytest.approx(here)


def test_another_tool_moves_the_tool_centre_point_and_not_the_joints(machine, clock):
    q = machine.values("actual_q")
    send(machine, 29, [0, 0, 0.25, 0, 0, 0])
    done(machine)
    assert machine.values("actual_TCP_pose")[2] == pytest.approx(0.10)
    assert machine.values("actual_q") == pytest.approx(q)


def test_an_unknown_command_and_a_pose_that_is_not_finite_end_the_program():
    for command, doubles in ((99, ()), (3, [math.nan, 0, 0.2, 0, 0, 0, 0.1, 0.5])):
        clock = Clock()
        machine = controller(clock)
        machine.start_program()
        send(machine, command, doubles)
        machine.advance()
        assert machine.program is None
        assert machine.robot.speed_m_s == 0


def test_force_mode_gives_way_along_the_chosen_axis_until_it_is_stopped(machine, clock):
    doubles = [0, 0, 0, 0, 0, 0, 0, 0, -5, 0, 0, 0, 0.02, 0.02, 0.02, 1, 1, 1]
    send(machine, 6, doubles, [2, 0, 0, 1, 0, 0, 0])
    wait(machine, clock, 1)
    assert machine.robot.tool.twist == pytest.approx([0, 0, -0.02, 0, 0, 0])
    send(machine, 7)
    wait(machine, clock, 1)
    assert machine.robot.speed_m_s == 0


def test_servoing_follows_its_goal(machine, clock):
    goal = START + np.array([0, 0, 0.01, 0, 0, 0])
    send(machine, 24, [*goal, 0, 0, 0.002, 0.1, 300])
    wait(machine, clock, 1.5)
    assert machine.robot.tcp_pose() == pytest.approx(goal, abs=1e-6)


def test_safety_bits_tell_the_stops_apart():
    clock = Clock()
    machine = controller(clock)
    assert machine.values("safety_status_bits") == [1]
    machine.safety_stop(PROTECTIVE)
    assert machine.values("safety_status_bits") == [(1 << 2) | (1 << 10)]
    assert len(set(SAFETY_BITS.values())) == len(SAFETY_BITS)
    machine.unlock()
    assert machine.safety_mode == NORMAL


# -- packets and faults --------------------------------------------------------------------------


def test_packets_are_taken_whole_out_of_a_stream():
    stream = bytearray(ur_packets.packet(86, b"\x00\x02") + ur_packets.packet(118)[:2])
    assert ur_packets.split(stream) == [(86, b"\x00\x02")]
    stream += ur_packets.packet(118)[2:]
    assert ur_packets.split(stream) == [(118, b"")]
    assert not stream


@pytest.mark.parametrize("size", [0, 2, 60_000])
def test_a_size_that_no_packet_has_loses_the_stream(size):
    with pytest.raises(ValueError, match="RTDE packet"):
        ur_packets.split(bytearray(struct.pack(">HB", size, 85)))


def test_names_with_a_trailing_comma_add_none_and_unknown_ones_are_told():
    names = ur_packets.names_in(b"timestamp,no_such,")
    assert ur_packets.types_of(names, ur_packets.OUTPUT_TYPES) == ["DOUBLE", "NOT_FOUND"]


def test_an_unknown_fault_names_those_that_are_known():
    emulator = UrEmulator(UrOptions(host=loopback(41)))
    try:
        with pytest.raises(ValueError, match="mute, garbage"):
            emulator.inject("gremlins")
        with pytest.raises(ValueError, match="does not take"):
            emulator.inject("mute", colour="red")
    finally:
        emulator.close()


# -- the library ---------------------------------------------------------------------------------

CLIENT = """
import json, os, sys, time, rtde_control, rtde_receive
host, tool, target = sys.argv[1], json.loads(sys.argv[2]), json.loads(sys.argv[3])
names = ["timestamp", "actual_TCP_pose", "actual_q", "runtime_state"]
receive = rtde_receive.RTDEReceiveInterface(host, 125.0, names)
control = rtde_control.RTDEControlInterface(host, 125.0)
taken = [control.setPayload(0.7, [0, 0, 0.04]), control.setTcp(tool), control.zeroFtSensor()]
offset = control.getTCPOffset()
taken.append(control.moveL(target, 0.2, 2.0, True))
until = time.monotonic() + 20
while time.monotonic() < until and abs(receive.getActualTCPPose()[2] - target[2]) > 1e-9:
    time.sleep(0.01)
reached = receive.getActualTCPPose(), receive.getActualQ()
control.stopScript()
print(json.dumps([taken, offset, *reached]))
sys.stdout.flush()
os._exit(0)
"""
"""In a process of its own: the library's destructors reconnect, and may end in a SIGSEGV."""


@pytest.mark.parametrize("version", ["5.12", "5.23", "10.11"])
def test_the_unmodified_library_connects_sets_up_and_moves(version):
    pytest.importorskip("rtde_control")
    target = [*START[:2], START[2] + 0.02, *START[3:]]
    with EmulatorProcess("ur", "--host", loopback(42), "--version", version) as emulator:
        command = [sys.executable, "-c", CLIENT, loopback(42)]
        command += [json.dumps(list(numbers)) for numbers in (TCP_OFFSET, target)]
        output = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True)
        taken, offset, pose, joints = json.loads(output.stdout.splitlines()[-1])
        facts = emulator.control.facts("ur")
    assert taken == [True] * 4
    assert offset == pytest.approx(TCP_OFFSET)
    assert pose == pytest.approx(target, abs=1e-9)
    flange = base_from_flange(np.array(joints))
    assert (flange @ as_frame(np.array(TCP_OFFSET)))[:3, 3] == pytest.approx(target[:3], abs=1e-6)
    assert facts["payload_kg"] == 0.7
    assert facts["num_programs"] == 1


def test_a_line_is_reported_with_its_plan_when_it_begins_and_a_stop_is_not():
    clock, plans = Clock(), []
    machine = controller(clock, lambda segment: lambda: True)
    machine.robot.on_begin = plans.append
    machine.start_program()
    moved_line(machine, clock, speed=0.3, acceleration=2.5)
    assert [plan.by_base_m.round(9).tolist() for plan in plans] == [[0, 0, 0.1]]
    assert (plans[0].speed_m_s, plans[0].acceleration_m_s2) == (0.3, 2.5)
    machine.protective_stop()
    wait(machine, clock, 1)
    assert len(plans) == 1
