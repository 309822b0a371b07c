"""A policy behind a server decides as here, and one that fails stops the arm."""

import re
import socket
import threading
import time

import numpy as np
import pytest
from websockets.server import ServerProtocol

from cltp.tactile.cloud import cloud_from_heights
from policies import Observation, PolicyError
from policies.rules import RulesPolicy
from tacgrasp.__main__ import main
from tacgrasp.runtime.outcome import EndReason
from tacgrasp.serving.answers import answer_message
from tacgrasp.serving.remote import RemotePolicy
from tacgrasp.serving.wire import pack
from tacgrasp.testing import CLOUDS, CONTRACT, PolicyContract
from tests.fakes.contracts import wide_contract
from tests.fakes.loop_fakes import DOWN, GOOD, FakeRig, ListRecorder, Scripted, config, play
from tests.fakes.policy_servers import METADATA, misbehaving, served

TIMEOUT_S = 0.3


def rules():
    return RulesPolicy(move_step_mm=3.0)


class TestRemoteRules(PolicyContract):
    @pytest.fixture(autouse=True, scope="class")
    def server(self):
        with served(rules) as url:
            type(self).url = url
            yield

    def make(self):
        return RemotePolicy(self.url, timeout_s=10)

    def test_it_decides_as_the_policy_itself_does(self, policy):
        here = rules()
        for cloud in CLOUDS:
            observation = Observation(cloud=cloud, in_contact=True)
            there = policy.decide(observation, CONTRACT)
            local = here.decide(observation, CONTRACT)
            assert (there.text, there.action) == (local.text, local.action)
            assert there.stage_ms["remote"] >= there.stage_ms["server"]


def test_an_episode_with_a_server_is_the_episode_without_one(tmp_path, capsys):
    run = ["run", "--seed", "6", "--record", str(tmp_path)]
    with served(rules) as url:
        code = main([*run, "--policy", "remote", "--policy-url", url, "--policy-timeout-s", "20"])
    there = capsys.readouterr().out
    assert main([*run, "--policy", "rules"]) == code == 0
    here = capsys.readouterr().out

    def said(printed):
        return [part for part in printed.split() if part in {"move_down", "increase_force:"}]

    assert said(there) == said(here)


def good(connection, data, number):
    """An answer that asks for a move, kept to the contract that was asked for."""
    decision = Scripted(DOWN).decide(None, wide_contract())
    connection.send(pack(answer_message(decision, wide_contract())))


def sends(message):
    return lambda connection, *_: connection.send(message)


def lie(**changes):
    decision = Scripted(DOWN).decide(None, wide_contract())
    return sends(pack(answer_message(decision, wide_contract()) | changes))


FAULTS = {
    "it hangs": (lambda *_: time.sleep(1), "gave no answer within 0.3 s"),
    "it dies": (lambda connection, *_: connection.socket.close(), "is gone|gave no answer"),
    "it closes": (lambda connection, *_: connection.close(), "is gone"),
    "it refuses": (sends("no weights here"), "says: no weights here"),
    "it answers garbage": (sends(b"\xc1\xc1"), "answered what can't be used"),
    "it answers nothing": (sends(pack({})), "answered what can't be used: text"),
    "its action is not what its text asks": (lie(primitive="increase_force"), "but its text"),
    "its success is not what its text says": (lie(success=True, primitive=None), "but its text"),
    "its action is unknown": (lie(primitive="explode"), "primitive must be one of"),
    "its confidence is none": (lie(confidence=float("nan")), "confidence must be"),
    "its text is endless": (lie(text="x" * 3000), "text must have"),
    "it keeps another contract": (lie(contract={}), "for another contract"),
    "its answer is too long": (sends(bytes(5 * 1024 * 1024)), "is gone"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_server_that_fails_in_mid_episode_is_a_named_fault_and_the_arm_stops(fault):
    answer, expected = FAULTS[fault]

    def behave(connection, data, number):
        (good if number == 0 else answer)(connection, data, number)

    rig, recorder = FakeRig(), ListRecorder()
    with misbehaving(behave) as url:
        policy = RemotePolicy(url, timeout_s=TIMEOUT_S)
        began_s = time.monotonic()
        outcome, _, _ = play(policy, rig=rig, recorder=recorder, settings=config(wait_s=0.0))
        assert time.monotonic() - began_s < 15
    assert outcome.reason is EndReason.FAULT
    assert any(part in outcome.message for part in expected.split("|")), outcome.message
    assert "3 times in a row" in outcome.message
    assert rig.moves == 1  # the first, good answer
    after = rig.calls[rig.calls.index("arm.move_to") + 1 :]
    assert "arm.stop" in after
    assert recorder.ends[0].reason == "fault"


def test_a_server_that_recovers_goes_on_with_the_episode():
    texts = {1: "hang", 2: DOWN, 3: GOOD}

    def behave(connection, data, number):
        if texts.get(number) == "hang":
            time.sleep(2 * TIMEOUT_S)
            return
        decision = Scripted(texts.get(number, DOWN)).decide(None, wide_contract())
        connection.send(pack(answer_message(decision, wide_contract())))

    with misbehaving(behave) as url:
        outcome, rig, recorder = play(
            RemotePolicy(url, timeout_s=TIMEOUT_S), settings=config(wait_s=0.0)
        )
    assert outcome.reason is EndReason.SUCCESS, outcome.message
    assert rig.moves == 2
    assert "gave no answer" in recorder.steps[1].note


@pytest.fixture
def deaf_server():
    """A server that shakes hands, says what it serves, and reads nothing ever after."""
    listener = socket.socket()
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    listener.bind(("127.0.0.1", 0))
    listener.listen()
    accepted = []

    def serve():
        connection, _ = listener.accept()
        accepted.append(connection)
        protocol = ServerProtocol()
        while not (requests := protocol.events_received()):
            protocol.receive_data(connection.recv(4096))
        protocol.send_response(protocol.accept(requests[0]))
        protocol.send_binary(pack(METADATA))
        for data in protocol.data_to_send():
            connection.sendall(data)

    thread = threading.Thread(target=serve, daemon=True)
    thread.start()
    yield f"ws://127.0.0.1:{listener.getsockname()[1]}"
    thread.join()
    for each in (*accepted, listener):
        each.close()


def test_a_server_that_reads_nothing_does_not_hold_the_sender(deaf_server):
    policy = RemotePolicy(deaf_server, timeout_s=TIMEOUT_S)
    policy.connect()
    policy._connection.socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 4096)
    heights = np.zeros((240, 320))
    cloud = cloud_from_heights(heights, CLOUDS[0].sensor, num_points=heights.size)  # 0.9 MB
    began_s = time.monotonic()
    with pytest.raises(PolicyError, match=r"is gone|gave no answer"):
        policy.decide(Observation(cloud=cloud), CONTRACT)
    assert time.monotonic() - began_s < 5


@pytest.mark.parametrize(
    ("flags", "code", "expected"),
    [
        ([], 2, "needs --policy-url"),
        (["--policy-url", "http://127.0.0.1:1"], 2, "must be like ws://"),
        (["--policy-url", "127.0.0.1:8000"], 2, "must be like ws://"),
        (["--policy-url", "ws://127.0.0.1:99999"], 2, "must be like ws://"),
        (["--policy-url", "ws://host:abc"], 2, "must be like ws://"),
        (["--policy-url", "ws://[::1"], 2, "must be like ws://"),
        (["--policy-url", "ws://127.0.0.1:1"], 3, "is gone: .*; start it with tacgrasp serve"),
        (["--policy-timeout-s", "0"], 2, "--policy-timeout-s must be"),
    ],
)
def test_a_server_that_is_not_there_is_named_before_anything_moves(
    flags, code, expected, monkeypatch, capsys
):
    monkeypatch.setattr("tacgrasp.rig.factory.make_rig", lambda *_: pytest.fail("a rig was made"))
    assert main(["run", "--policy", "remote", *flags]) == code
    message = capsys.readouterr().err
    assert re.search(expected, message), message
    assert message.count("\n") == 1


def test_a_server_that_asks_for_a_key_is_given_it():
    with served(rules, key="0123456789abcdef") as url:
        with pytest.raises(PolicyError, match=r"refuses \(401\): name its key"):
            RemotePolicy(url, timeout_s=10).connect()
        right = RemotePolicy(url, timeout_s=10, key="0123456789abcdef")
        right.connect()
        right.drop()


def test_a_server_of_something_else_is_not_asked(monkeypatch):
    monkeypatch.setitem(METADATA, "server", "openpi")
    with misbehaving(good) as url, pytest.raises(PolicyError, match="of another server"):
        RemotePolicy(url, timeout_s=10).connect()
