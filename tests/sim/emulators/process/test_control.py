"""The control channel of an emulator, and the process around it."""

import json
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest

from primitives import RobotError
from sim.emulators.process.control import ControlClient, ControlServer
from sim.emulators.process.spawn import EmulatorProcess, without_class

ENDS_WITH_STDIN = """
from sim.emulators.process.lifetime import announce_and_wait
announce_and_wait({"control_port": 1})
"""


class Lamp:
    """An emulated device with one fault."""

    def __init__(self):
        self.fault, self.details = None, {}

    def inject(self, fault, **details):
        if fault != "dark":
            raise ValueError(f"no fault {fault!r}; known: dark")
        self.fault, self.details = fault, details

    def clear(self):
        self.fault, self.details = None, {}

    def facts(self):
        return {"lit": self.fault is None, "level": self.details.get("level")}


@pytest.fixture
def lamp():
    return Lamp()


@pytest.fixture
def client(lamp):
    server = ControlServer({"lamp": lamp})
    client = ControlClient(server.port)
    yield client
    client.close()
    server.close()


def gone(pid):
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except FileNotFoundError:
        return True
    return state == "Z"  # ended, and not yet waited for by whoever inherited it


def test_a_fault_is_injected_seen_in_the_facts_and_taken_back(client):
    assert client.facts("lamp") == {"lit": True, "level": None}
    client.inject("lamp", "dark", level=0.5)
    assert client.facts("lamp") == {"lit": False, "level": 0.5}
    client.clear("lamp")
    assert client.facts("lamp")["lit"]


def test_an_unknown_fault_or_device_is_refused_with_the_known_names(client):
    with pytest.raises(ValueError, match="known: dark"):
        client.inject("lamp", "loud")
    with pytest.raises(ValueError, match="no emulated device 'horn' here; known: lamp"):
        client.facts("horn")


@pytest.mark.parametrize(
    "line",
    [b"", b"[]", b"7", b"\xff\xfe", b"{", b'{"device": []}', b"[" * 100_000, b'{"do": 1e999}'],
    ids=["empty", "list", "number", "no text", "broken", "list as name", "deep", "infinite"],
)
def test_a_line_that_is_no_request_is_answered_and_the_next_one_understood(lamp, line):
    server = ControlServer({"lamp": lamp})
    with socket.create_connection(("127.0.0.1", server.port), timeout=5) as raw:
        raw.sendall(line + b"\n" + b'{"do": "facts", "device": "lamp"}\n')
        with raw.makefile("rb") as answers:
            assert "error" in json.loads(answers.readline())
            assert json.loads(answers.readline())["facts"]["lit"] is True
    server.close()


def test_two_clients_ask_at_the_same_time(lamp):
    server = ControlServer({"lamp": lamp})
    first, second = ControlClient(server.port), ControlClient(server.port)
    first.inject("lamp", "dark")
    assert not second.facts("lamp")["lit"]
    for client in (first, second):
        client.close()
    server.close()


def test_a_channel_that_is_not_there_is_an_error_and_not_a_wait(lamp):
    server = ControlServer({"lamp": lamp})
    server.close()
    with pytest.raises(RobotError, match="no emulator's control channel"):
        ControlClient(server.port)


def test_an_unknown_kind_of_emulator_is_refused_with_what_it_said():
    with pytest.raises(RobotError, match=r"ended at once.*out of ur, dynamixel, taxels, rig"):
        EmulatorProcess("toaster")


def test_an_emulator_that_has_no_time_to_start_is_told_from_one_that_fails():
    with pytest.raises(RobotError, match="no time for it; end other work and start again"):
        EmulatorProcess("ur", ready_s=0.01)


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("primitives.errors.RobotError: unknown object 'foo'", "unknown object 'foo'"),
        ("expected an emulator: none", "expected an emulator: none"),
    ],
)
def test_what_an_emulator_said_is_told_without_the_class_of_its_error(line, told):
    assert without_class(line) == told


@pytest.mark.parametrize("how", ["stdin closes", "terminated"])
def test_an_emulator_ends_when_its_stdin_closes_or_it_is_terminated(how):
    child = subprocess.Popen(
        [sys.executable, "-c", ENDS_WITH_STDIN], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    )
    assert child.stdout.readline() == b'{"control_port": 1}\n'
    if how == "terminated":
        child.send_signal(signal.SIGTERM)
    else:
        child.stdin.close()
    assert child.wait(10) == 0
    child.stdout.close()


def test_an_emulator_that_was_started_is_gone_after_the_parent_was_killed():
    parent = subprocess.Popen(
        [
            sys.executable,
            "-c",
            "import subprocess, sys, time\n"
            f"child = subprocess.Popen([sys.executable, '-c', {ENDS_WITH_STDIN!r}],\n"
            "    stdin=subprocess.PIPE, stdout=subprocess.PIPE)\n"
            "child.stdout.readline(); print(child.pid, flush=True); time.sleep(60)",
        ],
        stdout=subprocess.PIPE,
    )
    pid = int(parent.stdout.readline())
    assert not gone(pid)
    parent.kill()
    parent.wait(10)
    parent.stdout.close()
    deadline = time.monotonic() + 10
    while not gone(pid) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert gone(pid)
