"""The emulated dashboard and script ports against Universal Robots' documents, line by line."""

import numpy as np
import pytest

from sim.emulators.ur.controller import PROTECTIVE, ROBOT_STOP, SAFEGUARD, Controller
from sim.emulators.ur.dashboard_session import LONGEST_LINE, DashboardSession
from sim.emulators.ur.options import START_TCP, TCP_OFFSET
from sim.emulators.ur.packets import StreamLostError
from sim.emulators.ur.sessions import LONGEST_SCRIPT, ScriptSession


@pytest.fixture
def clock():
    return [0.0]


@pytest.fixture
def controller(clock):
    return Controller(np.array(START_TCP), np.array(TCP_OFFSET), None, lambda: clock[0])


@pytest.fixture
def session(controller):
    return DashboardSession(controller, (5, 12))


def ask(session, line):
    answer = session.receive(line.encode() + b"\n").decode()
    assert answer.endswith("\n") and answer.count("\n") == 1
    return answer[:-1]


ANSWERS = {
    "PolyscopeVersion": "URSoftware 5.12.0.1100000 (Jan 01 2024)",
    "version": "5.12.0.1100000",
    "get serial number": "20210000001",
    "get robot model": "UR5",
    "get operational mode": "NONE",
    "get loaded program": "No program loaded",
    "is in remote control": "true",
    "robotmode": "Robotmode: RUNNING",
    "safetystatus": "Safetystatus: NORMAL",
    "safetymode": "Safetymode: NORMAL",
    "running": "Program running: false",
    "programState": "STOPPED <none>",
    "stop": "Stopped",
    "play": "Failed to execute: play",
    "pause": "Failed to execute: pause",
    "load grasp.urp": "File not found: grasp.urp",
    "load installation cell.installation": "File not found: cell.installation",
    "popup look here": "showing popup",
    "close popup": "closing popup",
    "close safety popup": "closing safety popup",
    "addToLog started": "Added log message",
    "power on": "Powering on",
    "brake release": "Brake releasing",
    "make coffee": 'could not understand: "make coffee"',
    "": 'could not understand: ""',
}


def test_the_greeting_is_the_manual_s():
    assert DashboardSession.GREETING == b"Connected: Universal Robots Dashboard Server\n"


@pytest.mark.parametrize(("line", "answer"), ANSWERS.items())
def test_an_idle_controller_answers(session, line, answer):
    assert ask(session, line) == answer


@pytest.mark.parametrize(("line", "answer"), ANSWERS.items())
def test_a_line_is_understood_with_a_carriage_return_and_in_pieces(session, line, answer):
    stream = line.encode() + b"\r\n"
    assert b"".join(session.receive(bytes([b])) for b in stream) == answer.encode() + b"\n"


def test_several_lines_have_several_answers_in_order(session):
    answers = session.receive(b"running\nrobotmode\nstop\n").splitlines()
    assert answers == [b"Program running: false", b"Robotmode: RUNNING", b"Stopped"]


def test_a_running_program_shows_and_stop_ends_it(controller, session):
    controller.start_program()
    assert ask(session, "running") == "Program running: true"
    assert ask(session, "programState") == "PLAYING rtde_control"
    assert ask(session, "stop") == "Stopped"
    assert ask(session, "programState") == "STOPPED <none>"
    assert controller.program is None


@pytest.mark.parametrize("line", ["stop", "power off", "brake release"])
def test_in_local_control_commands_fail_and_questions_are_answered(controller, session, line):
    controller.start_program()
    controller.remote = False
    assert ask(session, line) == f"Failed to execute: {line}"
    assert controller.program is not None
    assert ask(session, "is in remote control") == "false"
    assert ask(session, "robotmode") == "Robotmode: RUNNING"


@pytest.mark.parametrize(
    ("mode", "name"),
    [
        (PROTECTIVE, "PROTECTIVE_STOP"),
        (SAFEGUARD, "SAFEGUARD_STOP"),
        (ROBOT_STOP, "ROBOT_EMERGENCY_STOP"),
    ],
)
def test_a_safety_stop_has_its_name(controller, session, mode, name):
    controller.safety_stop(mode)
    assert ask(session, "safetystatus") == f"Safetystatus: {name}"
    assert ask(session, "safetymode") == f"Safetymode: {name}"


def test_a_paused_program_is_neither_stopped_nor_playing(controller, session, clock):
    controller.start_program()
    controller.safety_stop(PROTECTIVE)
    assert ask(session, "programState") == "PAUSED rtde_control"
    clock[0] += 4.9
    assert ask(session, "unlock protective stop").startswith("Cannot unlock protective stop until")
    assert ask(session, "safetystatus") == "Safetystatus: PROTECTIVE_STOP"
    clock[0] += 0.2
    assert ask(session, "unlock protective stop") == "Protective stop releasing"
    assert ask(session, "safetystatus") == "Safetystatus: NORMAL"
    assert ask(session, "programState") == "STOPPED <none>"


def test_only_a_protective_stop_is_unlocked_and_brakes_stay_on_in_a_stop(controller, session):
    controller.safety_stop(ROBOT_STOP)
    assert ask(session, "unlock protective stop").startswith("Cannot unlock")
    assert ask(session, "brake release") == "Failed to execute: brake release"
    assert ask(session, "robotmode") == "Robotmode: POWER_OFF"


def test_power_goes_off_and_comes_back(controller, session):
    controller.start_program()
    assert ask(session, "power off") == "Powering off"
    assert ask(session, "robotmode") == "Robotmode: POWER_OFF"
    assert ask(session, "running") == "Program running: false"
    assert ask(session, "brake release") == "Brake releasing"
    assert ask(session, "robotmode") == "Robotmode: RUNNING"


def test_quit_is_answered_and_ends_the_connection(session):
    assert session.receive(b"running\nquit\nrunning\n").splitlines()[1:] == [b"Disconnected"]
    assert session.ended


def test_a_line_without_an_end_closes_the_connection(session):
    with pytest.raises(StreamLostError, match="without an end"):
        session.receive(b"x" * (LONGEST_LINE + 1))


# port 30003


def test_a_program_starts_at_its_end_in_any_pieces(controller):
    script = ScriptSession(controller)
    text = b"\n def rtde_control():\n  if True:\n    x = 1\n  end\nend\n"
    for byte in text[:-1]:
        assert script.receive(bytes([byte])) == b""
    assert controller.num_programs == 0
    script.receive(text[-1:])
    assert controller.num_programs == 1 and controller.program is not None


def test_another_script_replaces_the_program_and_a_secondary_one_does_not(controller):
    script = ScriptSession(controller)
    controller.start_program()
    script.receive(b"sec note():\n  textmsg(1)\nend\n")
    assert controller.program is not None
    script.receive(b"stopl(2.0)\n")
    assert controller.program is None
    controller.start_program()
    script.receive(b"stopl(1.2.3)\n")  # does not compile: it replaces the program all the same
    assert controller.program is None
    script.receive(b"def f():\nend\n")
    assert controller.program is not None


@pytest.mark.parametrize("number", ["0", "5e-324", "1e999", "-2", "nan", "9" * 400])
def test_a_stop_with_an_impossible_deceleration_is_no_stop_line(controller, number):
    controller.start_program()
    ScriptSession(controller).receive(f"stopl({number})\n".encode())
    assert controller.program is None
    assert controller.robot.speed_m_s == 0


def test_scripts_are_ignored_in_local_control(controller):
    controller.remote = False
    ScriptSession(controller).receive(b"def f():\nend\nstopl(2)\n")
    assert controller.program is None and controller.num_programs == 0


def test_a_script_without_an_end_closes_the_connection(controller):
    script = ScriptSession(controller)
    with pytest.raises(StreamLostError, match="without an end"):
        for _ in range(LONGEST_SCRIPT // 4096 + 2):
            script.receive(b"def f():\n" if _ == 0 else b"  x = 1\n" * 512)


def test_without_a_protective_stop_there_is_nothing_to_unlock(controller, session):
    controller.power_off()
    mode = controller.robot_mode
    ask(session, "unlock protective stop")
    assert controller.robot_mode == mode
