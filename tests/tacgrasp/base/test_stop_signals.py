"""SIGTERM and SIGHUP as Ctrl-C: what they raise, how often, and what is left alone."""

import os
import pty
import signal
import subprocess
import sys
import threading
import time

import pytest

from tacgrasp.__main__ import main
from tacgrasp.base.stop_signals import STOP_SIGNALS, stop_signals_as_ctrl_c
from tests.paths import ROOT


@pytest.fixture(autouse=True)
def signals_as_a_terminal_leaves_them():
    """A suite that nohup started has SIGHUP ignored."""
    before = {number: signal.signal(number, signal.SIG_DFL) for number in STOP_SIGNALS}
    yield
    for number, handler in before.items():
        signal.signal(number, handler)


@pytest.mark.parametrize("number", STOP_SIGNALS)
def test_a_signal_interrupts_once_and_is_what_it_was_afterwards(number):
    with stop_signals_as_ctrl_c() as received:
        with pytest.raises(KeyboardInterrupt, match=f"stopped by {number.name}"):
            os.kill(os.getpid(), number)
        os.kill(os.getpid(), number)  # must not cut short how the first one ends
    assert received == [number, number]
    assert signal.getsignal(number) == signal.SIG_DFL


def test_a_signal_that_is_ignored_stays_ignored():
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)  # as by nohup
    try:
        with stop_signals_as_ctrl_c() as received:
            os.kill(os.getpid(), signal.SIGHUP)
        assert not received
        assert signal.getsignal(signal.SIGHUP) == signal.SIG_IGN
    finally:
        signal.signal(signal.SIGHUP, before)


def test_another_thread_takes_no_signals():
    handlers = []

    def take():
        with stop_signals_as_ctrl_c():
            handlers.append(signal.getsignal(signal.SIGTERM))

    thread = threading.Thread(target=take)
    thread.start()
    thread.join()
    assert handlers == [signal.SIG_DFL]


@pytest.mark.parametrize(("number", "code"), [(signal.SIGTERM, 143), (signal.SIGHUP, 129)])
def test_a_run_ends_as_by_ctrl_c_with_a_code_of_its_own(
    number, code, tmp_path, capsys, monkeypatch
):
    from sim.grasp.rig import SimSensor

    def stopped(_: SimSensor, frames: int = 1) -> None:
        os.kill(os.getpid(), number)

    monkeypatch.setattr(SimSensor, "read", stopped)
    assert main(["run", "--policy", "rules", "--record", str(tmp_path)]) == code
    assert f"end: operator - stopped by {number.name}" in capsys.readouterr().out
    assert main(["episodes", "info", str(next(tmp_path.glob("*.mcap")))]) == 0


def test_a_command_that_a_closed_terminal_ends_says_nothing_there_and_has_its_code():
    program = (
        "import os, time\n"
        "from tacgrasp.base.stop_signals import stop_signals_as_ctrl_c\n"
        "with stop_signals_as_ctrl_c() as received:\n"
        "    try:\n"
        "        print('ready', flush=True)\n"
        "        time.sleep(60)\n"
        "    except KeyboardInterrupt:\n"
        "        print('the end', flush=True)\n"
        "os._exit(128 + received[0])\n"
    )
    ours, theirs = pty.openpty()
    child = subprocess.Popen(
        [sys.executable, "-c", program],
        cwd=ROOT,
        stdout=theirs,
        stderr=theirs,
        stdin=theirs,
        start_new_session=True,
    )
    os.close(theirs)
    assert os.read(ours, 5) == b"ready"
    time.sleep(0.1)
    os.close(ours)  # a terminal that is gone: writing to it fails
    child.send_signal(signal.SIGHUP)
    assert child.wait(20) == 129
