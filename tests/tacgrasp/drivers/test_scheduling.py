"""Priority of the drivers' threads: what is asked for, what is granted, and what is said of it."""

import os
import threading

import pytest

from tacgrasp.drivers import scheduling
from tacgrasp.drivers.scheduling import Granted, granted, request_priority


def in_a_thread(call):
    results = []
    thread = threading.Thread(target=lambda: results.append(call()))
    thread.start()
    thread.join()
    return results[0]


def refuse(*_):
    raise PermissionError("not allowed")


def test_the_thread_has_what_is_said_to_be_granted():
    def ask():
        rights, thread = request_priority(), threading.get_native_id()
        return rights, os.sched_getscheduler(thread), os.getpriority(os.PRIO_PROCESS, thread)

    rights, policy, nice = in_a_thread(ask)
    assert rights.real_time == (policy & ~os.SCHED_RESET_ON_FORK == os.SCHED_FIFO)
    assert rights.real_time or rights.nice == nice
    assert rights.cores == len(os.sched_getaffinity(0))


def test_asking_what_would_be_granted_changes_nothing_for_this_thread():
    before = os.sched_getscheduler(0), os.getpriority(os.PRIO_PROCESS, 0)
    granted()
    assert (os.sched_getscheduler(0), os.getpriority(os.PRIO_PROCESS, 0)) == before


def test_a_system_that_refuses_every_priority_is_a_problem_and_no_error(monkeypatch):
    monkeypatch.setattr(os, "sched_setscheduler", refuse)
    monkeypatch.setattr(os, "setpriority", refuse)
    rights = in_a_thread(request_priority)
    assert not rights.real_time
    assert "no priority over other work" in rights.problem
    in_a_thread(scheduling.request_nice)


@pytest.mark.parametrize(
    ("rights", "problem"),
    [
        (Granted(real_time=True, nice=0, cores=2), ""),
        (Granted(real_time=False, nice=-15, cores=2), ""),
        (Granted(real_time=False, nice=0, cores=8), "no priority"),
        (Granted(real_time=True, nice=0, cores=1), "1 core: needed are 2"),
    ],
)
def test_one_core_or_no_priority_is_a_problem(rights, problem):
    assert problem in rights.problem and bool(problem) == bool(rights.problem)
