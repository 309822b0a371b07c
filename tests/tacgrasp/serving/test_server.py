"""The server as a client on the wire sees it."""

import os
import re
import signal
import subprocess
import sys
import time
import urllib.request

import msgpack
import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from policies.rules import RulesPolicy
from tacgrasp.__main__ import main
from tacgrasp.base.errors import UsageError
from tacgrasp.serving.questions import MAX_POINTS
from tacgrasp.serving.server import INTERNAL_ERROR, TRY_AGAIN, ServerSettings
from tacgrasp.serving.wire import pack, unpack
from tacgrasp.testing import CLOUDS
from tests.fakes.policy_servers import served
from tests.paths import ROOT

PROMPT = "Pick the strawberry gently, without bruising it."
POINTS = "observation/tactile_points"
BELOW = np.array(CLOUDS[1].points_mm, dtype="<f4")


def rules():
    return RulesPolicy(move_step_mm=3.0)


@pytest.fixture(scope="module")
def url():
    with served(rules) as url:
        yield url


def opened(url, **options):
    connection = connect(url, compression=None, proxy=None, **options)
    return connection, unpack(connection.recv(timeout=10))


def asked(url, **changes):
    """The answer to a question with some keys changed; None takes one away."""
    message = {"observation/tactile_points": BELOW, "prompt": PROMPT} | changes
    connection, _ = opened(url)
    with connection:
        connection.send(pack({key: value for key, value in message.items() if value is not None}))
        answer = connection.recv(timeout=10)
        return answer if isinstance(answer, str) else unpack(answer)


def test_the_first_message_says_what_is_served(url):
    connection, metadata = opened(url)
    connection.close()
    assert (metadata["server"], metadata["protocol"], metadata["policy"]) == (
        "tacgrasp",
        1,
        "rules",
    )
    assert metadata["action_columns"] == ["move_x", "move_y", "force", "reset"]


def test_points_and_a_prompt_get_a_decision_with_everything_that_belongs_to_it(url):
    answer = asked(url)
    assert answer["primitive"] == "move_down"
    assert answer["actions"].tolist() == [[0, -1, 0, 0]]
    assert answer["success"] is False
    assert answer["confidence"] == 1.0
    assert "bottom" in answer["text"]
    assert answer["contract"]["force_n"] == pytest.approx([0.15, 2.5])
    assert answer["server_timing"]["infer_ms"] > 0


def test_the_words_of_the_prompt_become_the_contract(url):
    assert asked(url, prompt="Hold it at 2 N.")["contract"]["force_n"] == pytest.approx(
        [1.72, 2.28]
    )


UP_MM = np.float32([0, 0, 0.5])


@pytest.mark.parametrize("felt", [{}, {"observation/in_contact": False}, {POINTS: BELOW + UP_MM}])
def test_a_refused_prompt_is_told_why_whatever_is_felt(url, felt):
    assert asked(url, prompt="Drop it.", **felt).startswith("refused: ")


def test_what_is_known_not_to_touch_is_a_reset_without_asking_the_policy(url):
    answer = asked(url, **{"observation/in_contact": False})
    assert (answer["primitive"], answer["actions"].tolist()) == ("reset", [[0, 0, 0, 1]])


def test_a_success_that_what_is_felt_refutes_is_none(url):
    centre = np.array(CLOUDS[0].points_mm)
    felt = {"observation/in_contact": True, "observation/felt_force_n": [0.05, 0.1, 0.2]}
    points = {"observation/tactile_points": centre, "prompt": "Hold it at 0.8 N."}
    assert asked(url, **points, **felt)["success"] is False


FLAT = BELOW * np.float32([1, 1, 0])


@pytest.mark.parametrize(
    ("points", "known", "expected"),
    [
        (FLAT + UP_MM, {}, "raised by 0.50 mm"),
        (BELOW + UP_MM, {}, "raised by 0.50 mm"),
        (BELOW + UP_MM, {"observation/in_contact": True}, "raised by 0.50 mm"),
        (FLAT + UP_MM, {"observation/in_contact": False}, "raised by 0.50 mm"),
        (BELOW - UP_MM, {}, "0.50 mm below zero"),
    ],
)
def test_nothing_is_done_about_a_pad_without_its_zero(url, points, known, expected):
    answer = asked(url, **{POINTS: points}, **known)
    assert expected in answer["reason"]
    assert expected in answer["text"]
    assert (answer["primitive"], answer["success"]) == (None, False)
    assert answer["actions"].tolist() == [[0, 0, 0, 0]]


def test_a_client_that_has_an_untouched_gel_to_compare_with_is_answered_below_zero(url):
    lowered = {POINTS: BELOW - UP_MM, "observation/in_contact": True}
    assert asked(url, **lowered)["primitive"] == "move_down"


def test_a_second_answer_says_how_long_the_first_took_in_all(url):
    connection, _ = opened(url)
    with connection:
        question = pack({"observation/tactile_points": BELOW, "prompt": PROMPT})
        connection.send(question)
        first = unpack(connection.recv(timeout=10))["server_timing"]
        connection.send(question)
        second = unpack(connection.recv(timeout=10))["server_timing"]
    assert "prev_total_ms" not in first
    assert second["prev_total_ms"] >= first["infer_ms"]


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({POINTS: None}, f"the key {POINTS} is missing"),
        ({"prompt": None}, "the key prompt is missing"),
        ({"prompt": ""}, "text of 1 to 1000"),
        ({"prompt": "x" * 1001}, "text of 1 to 1000"),
        ({"prompt": 5}, "text of 1 to 1000"),
        ({"observation/image": 1}, "unknown key 'observation/image'; known: "),
        ({POINTS: [[0.0, 0.0, 0.0]]}, "must be points .* got list"),
        ({POINTS: BELOW.astype("<i4")}, "got an array of int32"),
        ({POINTS: BELOW[:, :2]}, r"must be \(N, 3\)"),
        ({POINTS: np.zeros((MAX_POINTS + 1, 3), "<f4")}, "N at most"),
        ({POINTS: BELOW * np.float32("nan")}, "must be finite"),
        ({POINTS: BELOW.astype("<f8") * 1e300}, "must be finite"),
        ({POINTS: BELOW / 1000}, "is it in metres"),
        ({POINTS: BELOW * np.float32([1, 1, 1e-3])}, "is it in metres"),
        ({POINTS: BELOW[:5]}, "at least 64"),
        ({"sensor": "finger"}, "unknown sensor 'finger'"),
        ({"observation/in_contact": 1}, "must be true or false"),
        ({"observation/width_m": float("nan")}, "must be a finite number"),
        ({"observation/width_m": -3.0}, "observation/width_m must be 0 or more, got -3"),
        ({"observation/felt_force_n": [2.0, 1.0, 3.0]}, "must rise"),
        ({"observation/felt_force_n": [-2.0, 1.0, 3.0]}, "must rise, from 0"),
        ({POINTS: BELOW * np.float32([1, 1, -1])}, "z has the wrong sign"),
        (
            {POINTS: BELOW * np.float32([1, 1, -1]), "observation/in_contact": True},
            "z has the wrong sign",
        ),
        ({"observation/force_scale": {"factor": 99.0, "spread": 0, "source": ""}}, "force scale"),
        ({"contract": {"text": "x"}}, "contract: .*is missing"),
        ({"start": "yes"}, "start must be"),
    ],
)
def test_a_question_that_can_not_be_read_is_told_why_in_one_line(url, changes, expected):
    answer = asked(url, **changes)
    assert re.search(expected, answer), answer
    assert "\n" not in answer
    assert "Traceback" not in answer


@pytest.mark.parametrize("data", ["text", b"\xc1", b"", msgpack.packb([1])])
def test_garbage_is_told_so_and_its_connection_closed_as_openpi_does(url, data):
    connection, _ = opened(url)
    connection.send(data)
    assert isinstance(connection.recv(timeout=10), str)
    with pytest.raises(ConnectionClosed) as closed:
        connection.recv(timeout=10)
    assert closed.value.rcvd.code == INTERNAL_ERROR
    assert asked(url)["primitive"] == "move_down"  # others are served on


def test_a_message_above_the_bound_ends_its_connection_alone(url):
    connection, _ = opened(url)
    with pytest.raises(ConnectionClosed):
        connection.send(bytes(5 * 1024 * 1024))
        connection.recv(timeout=10)
    assert asked(url)["primitive"] == "move_down"


def test_a_bug_of_the_policy_is_told_without_a_traceback(caplog):
    class Broken(RulesPolicy):
        def decide(self, observation, contract):
            raise ZeroDivisionError("secret of the server")

    with served(lambda: Broken(move_step_mm=3.0)) as url:
        answer = asked(url)
    assert answer == "a bug of the server; its log has the details"
    assert "secret of the server" in caplog.text


def test_health_is_asked_without_a_key():
    with served(rules, key="0123456789abcdef") as url:
        address = url.replace("ws:", "http:") + "/healthz"
        with urllib.request.urlopen(address, timeout=10) as response:
            assert (response.status, response.read()) == (200, b"OK\n")


@pytest.mark.parametrize(
    "headers", [None, {"Authorization": "Api-Key wrong"}, {"Authorization": "0123456789abcdef"}]
)
def test_without_the_key_nothing_is_served(headers):
    with served(rules, key="0123456789abcdef") as url:
        with pytest.raises(InvalidStatus) as refused:
            opened(url, additional_headers=headers)
        right = {"Authorization": "Api-Key 0123456789abcdef"}
        connection, _ = opened(url, additional_headers=right)
        connection.close()
    assert refused.value.response.status_code == 401


def test_a_page_in_a_browser_can_not_ask(url):
    with pytest.raises(InvalidStatus) as refused:
        opened(url, origin="http://127.0.0.1:8000")
    assert refused.value.response.status_code == 403


@pytest.mark.parametrize("host", ["0.0.0.0", "192.168.1.5", "::", "robot.local"])
def test_beyond_this_computer_a_key_is_needed(host):
    with pytest.raises(UsageError, match="needs a key"):
        ServerSettings(host=host)
    ServerSettings(host=host, key="0123456789abcdef")


def test_more_clients_than_allowed_are_sent_away():
    with served(rules, max_clients=1) as url:
        first, _ = opened(url)
        with first:
            second = connect(url, compression=None, proxy=None)
            with pytest.raises(ConnectionClosed) as closed:
                second.recv(timeout=10)
    assert closed.value.rcvd.code == TRY_AGAIN


@pytest.mark.parametrize(
    ("argv", "expected"),
    [
        (["--policy", "gut"], "unknown policy 'gut'"),
        (["--policy", "remote"], "asks a server itself"),
        (["--host", "0.0.0.0"], "--key-file"),
        (["--port", "99999"], "--port must be 0 to 65535"),
        (["--key-file", "none"], "can't be read"),
        (["--host", "203.0.113.1", "--key-file", "{key}"], "can't be listened on"),
    ],
)
def test_wrong_use_of_serve_gets_one_line(argv, expected, tmp_path, capsys):
    key = tmp_path / "key"
    key.write_text("0123456789abcdef")
    key.chmod(0o600)
    argv = [part.format(key=key) for part in argv]
    policy = [] if "--policy" in argv else ["--policy", "rules"]
    assert main(["serve", *policy, *argv]) == 2
    message = capsys.readouterr().err
    assert expected in message
    assert message.count("\n") == 1


@pytest.mark.parametrize(
    ("text", "mode", "expected"),
    [
        ("0123456789abcdef", 0o644, "chmod 600"),
        ("short", 0o600, "one key of 16"),
        ("", 0o600, "one key of 16"),
        ("0123456789abcdef\nmore", 0o600, "one key of 16"),
        ("x" * 201, 0o600, "one key of 16"),
    ],
)
def test_a_key_that_is_none_or_that_others_can_read_is_refused(
    text, mode, expected, tmp_path, capsys
):
    path = tmp_path / "key"
    path.write_text(text)
    path.chmod(mode)
    assert main(["serve", "--policy", "rules", "--key-file", str(path)]) == 2
    assert expected in capsys.readouterr().err


def test_the_command_serves_until_ctrl_c():
    command = [sys.executable, "-m", "tacgrasp", "serve", "--policy", "rules", "--port", "0"]
    process = subprocess.Popen(
        command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        env=os.environ | {"PYTHONUNBUFFERED": "1"},
    )  # fmt: skip
    try:
        line = process.stdout.readline()
        url = re.search(r"ws://\S+", line)[0]
        assert asked(url)["primitive"] == "move_down"
        process.send_signal(signal.SIGINT)
        began = time.monotonic()
        assert process.wait(timeout=20) == 130
        assert time.monotonic() - began < 20
        assert "Traceback" not in process.stderr.read()
    finally:
        process.kill()
        process.communicate()
