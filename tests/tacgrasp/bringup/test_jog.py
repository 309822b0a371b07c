"""Jogging: what each key means, and that every step is held to the limits."""

import io
import os
import pty
import select
import subprocess
import sys
import termios
import time

import pytest
from rich.console import Console

from cltp.errors import TouchError
from primitives import LimitError
from primitives.execution import PadAxes
from primitives.limits import Limits
from sim.grasp.rig import build
from tacgrasp.__main__ import main
from tacgrasp.bringup.jog import (
    STEPS_MM,
    Grip,
    JogAction,
    Jogger,
    JogSettings,
    JogStep,
    Unknown,
    key_command,
)
from tacgrasp.cli.jog import _show
from tests.fakes.patient_rig import patient_rig

SETTINGS = JogSettings(force_n=1.0)
LIMITS = Limits(
    max_step_mm=2,
    workspace_low_m=(0.44, -0.2, 0.19),
    workspace_high_m=(0.46, 0.0, 0.21),
    max_travel_mm=6,
    min_force_n=0.1,
    max_force_n=2,
    max_speed_m_s=0.4,
)


@pytest.fixture
def rig():
    return build("strawberry", 1, start_offset_mm=(0.0, 0.0))


@pytest.fixture
def jogger(rig):
    axes = PadAxes(x_tcp=rig.pad_x_in_tcp, y_tcp=rig.pad_y_in_tcp)
    return Jogger(rig, LIMITS, axes, clear_mm=2.0, limit_n=100.0, max_gain=1.0)


@pytest.mark.parametrize(
    ("key", "frame", "direction"),
    [("w", "pad", (0, 1, 0)), ("a", "pad", (-1, 0, 0)), ("f", "base", (0, 0, -1))],
)
def test_a_letter_is_one_step_of_the_chosen_length(key, frame, direction):
    command, after = key_command(key, SETTINGS)
    assert command == JogStep(frame=frame, direction=direction, length_mm=1.0)
    assert after == SETTINGS


def test_brackets_choose_the_step_within_its_range_and_move_nothing():
    settings = SETTINGS
    for _ in range(10):
        command, settings = key_command("]", settings)
        assert command is None
    assert settings.step_mm == STEPS_MM[-1]
    for _ in range(10):
        _, settings = key_command("[", settings)
    assert settings.step_mm == STEPS_MM[0]


def test_plus_and_minus_change_the_force_of_the_next_grip_and_send_nothing():
    command, more = key_command("+", SETTINGS)
    assert command is None
    assert key_command("g", more)[0] == Grip(force_n=1.25)
    assert key_command("-", more)[1].force_n == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("key", "action"),
    [
        ("o", JogAction.OPEN),
        (" ", JogAction.STOP),
        ("?", JogAction.HELP),
        ("q", JogAction.QUIT),
        ("\x03", JogAction.QUIT),
    ],
)
def test_the_other_keys(key, action):
    assert key_command(key, SETTINGS)[0] is action


@pytest.mark.parametrize("key", ["", "x", "\x00", "7", "\n"])
def test_any_other_key_sends_nothing(jogger, rig, key):
    command, _ = key_command(key, SETTINGS)
    assert command == Unknown(key=key)
    before = rig.arm.pose()
    assert "no command" in jogger.carry_out(command)
    assert rig.arm.pose() is before


def test_a_step_along_the_pad_goes_along_its_axes_in_the_base(jogger, rig):
    jogger.carry_out(key_command("s", SETTINGS)[0])  # fingertip: down, as the fingers point
    assert rig.arm.pose().position_m == pytest.approx([0.45, -0.10, 0.199])
    jogger.carry_out(key_command("d", SETTINGS)[0])
    assert rig.arm.pose().position_m == pytest.approx([0.451, -0.10, 0.199])


def test_a_step_is_shortened_and_a_force_lowered_to_the_limits_and_it_is_said(jogger):
    long = JogStep(frame="base", direction=(0, 0, 1), length_mm=5)
    assert "shortened to max_step_mm 2" in jogger.carry_out(long)
    assert "lowered to max_force_n 2" in jogger.carry_out(Grip(force_n=9))


def test_no_grip_by_hand_presses_beyond_the_limit_whatever_was_felt_before(rig):
    axes = PadAxes(x_tcp=rig.pad_x_in_tcp, y_tcp=rig.pad_y_in_tcp)
    jogger = Jogger(rig, LIMITS, axes, clear_mm=2.0, limit_n=1.2, max_gain=2.0)
    said = jogger.carry_out(Grip(force_n=2.0))
    assert "lowered to 0.6 N" in said
    assert "contract's limit of 1.2 N" in said
    for _ in range(3):
        jogger.contact()
        jogger.carry_out(Grip(force_n=2.0))
    assert 0.5 < rig.gripper.state().force_n < 1.2
    assert 0.3 < rig.truth().peak_force_n <= 1.2


def test_opening_takes_a_reference_so_that_a_gel_that_has_drifted_shows_no_contact():
    rig = build("strawberry", 2, start_offset_mm=(0.0, 0.0))
    axes = PadAxes(x_tcp=rig.pad_x_in_tcp, y_tcp=rig.pad_y_in_tcp)
    jogger = Jogger(rig, LIMITS, axes, clear_mm=2.0, limit_n=100.0, max_gain=1.0)
    rig.gripper.grip(1.0)  # of an earlier run
    assert "mm deep" in jogger.contact()
    assert "no reference yet, o takes one" in jogger.contact()
    assert jogger.carry_out(JogAction.OPEN).startswith("open at ")
    assert jogger.contact() == "no contact"


def test_opening_is_no_matter_of_the_sensor_and_a_missing_reference_is_told(
    jogger, rig, monkeypatch
):
    def silent(*_):
        raise TouchError("no fresh frame")

    rig.gripper.grip(1.0)
    monkeypatch.setattr(type(rig.sensor), "take_reference", silent)
    told = jogger.carry_out(JogAction.OPEN)
    assert told.startswith("open at ")
    assert "no new reference" in told and told.endswith("no fresh frame")
    assert not rig.gripper.state().closed


def test_a_step_out_of_the_box_is_refused_and_nothing_moves(jogger, rig):
    aside = JogStep(frame="base", direction=(1, 0, 0), length_mm=2)
    for _ in range(4):
        jogger.carry_out(aside)
    here = rig.arm.pose()
    with pytest.raises(LimitError, match=r"x = 0.4600 m would leave|x = 0.4620 m would leave"):
        for _ in range(2):
            jogger.carry_out(aside)
            here = rig.arm.pose()
    assert rig.arm.pose() is here


def test_without_a_terminal_characters_are_keys_and_a_line_each_is_printed(monkeypatch, capsys):
    monkeypatch.setattr("sys.stdin", io.StringIO("gd\n?zq"))
    assert main(["jog", "--seed", "3"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert sum(line.startswith("closed with ") for line in lines) == 1
    assert any(line.startswith("at (451.0, -100.0, 200.0) mm | step 1 mm") for line in lines)
    assert any("'z' is no command" in line for line in lines)


def test_a_refused_step_is_said_and_jogging_goes_on(monkeypatch, capsys):
    monkeypatch.setattr("sys.stdin", io.StringIO("]]" + 40 * "r" + "o"))
    assert main(["jog"]) == 0
    printed = capsys.readouterr().out
    assert "refused: " in printed
    assert printed.splitlines()[-1].startswith("open at")


def test_on_a_narrow_terminal_the_contact_is_one_line_that_is_written_over():
    printed = io.StringIO()
    out = Console(file=printed, force_terminal=True, width=40, highlight=False)
    for _ in range(2):
        _show(out, "step 1 mm, force 1.00 N | " + 20 * "felt ", "")
    _show(out, "step 2 mm", "at (451.0, -100.0, 200.0) mm, and more than the width")
    start, *lines = printed.getvalue().split("\r\x1b[2K")
    assert start == ""
    assert lines[0] == lines[1] == "step 1 mm, force 1.00 N | felt felt fel"
    assert lines[2:] == ["at (451.0, -100.0, 200.0) mm, and more than the width\n", "step 2 mm"]


@pytest.mark.slow
@pytest.mark.parametrize("devices", ["simulated", "emulated"])
def test_on_a_terminal_single_keys_move_and_the_terminal_is_set_back(devices, tmp_path):
    rig = "sim" if devices == "simulated" else str(patient_rig(tmp_path))
    ours, theirs = pty.openpty()
    before = termios.tcgetattr(theirs)
    command = [sys.executable, "-m", "tacgrasp", "jog", "--seed", "3", "--rig", rig]
    child = subprocess.Popen(command, stdin=theirs, stdout=theirs, stderr=theirs)
    printed = b""

    def until(words: bytes) -> None:
        nonlocal printed
        deadline = time.monotonic() + 60
        while words not in printed and time.monotonic() < deadline:
            if select.select([ours], [], [], 0.1)[0]:
                printed += os.read(ours, 65536)
        assert words in printed, printed

    until(b"step 1 mm")
    os.write(ours, b"d")
    until(b"at (451.0, -100.0, 200.0) mm")
    os.write(ours, b"q")
    assert child.wait(30) == 0
    assert termios.tcgetattr(theirs) == before
    os.close(ours)
    os.close(theirs)
