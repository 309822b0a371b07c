"""``tacgrasp bench serve``: decisions of one server for 1, 4 and 16 robots, and how fair it is.

The server is a process of its own, as in use. The robots are threads of this process that ask
without a pause; each has a connection and a contract of its own.
"""

from __future__ import annotations

import contextlib
import os
import re
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np

from policies import Observation
from primitives.contract import Contract
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.figures import number_table, write_figures
from tacgrasp.benchmarks.settings import ServeSettings
from tacgrasp.config.layers import load
from tacgrasp.config.terms import contract_of
from tacgrasp.console import make_table_console
from tacgrasp.rig.factory import make_rig
from tacgrasp.rig.gel_sense import GelSense
from tacgrasp.serving.remote import RemotePolicy

FORCES_N = (0.6, 1.0, 1.6, 2.4)
CLIENTS = (1, 4, 16)
WARM_UP = 2
"""Decisions of each robot that don't count."""

TIMEOUT_S = 60.0


def run(settings: ServeSettings) -> None:
    """Measure, print a table and write ``clients.<n>.{decisions_per_s, p50_ms, p99_ms, fairness}``.

    Fairness is the fewest decisions of a robot over the most, 0 to 1.

    Raises:
        UsageError: The server does not start.
        PolicyError: It does not answer.
    """
    config = load("strawberry")[0]
    contract, observations = contract_of(config), _observations()
    console, figures = make_table_console(), dict[str, Any]()
    table = number_table(
        f"{settings.policy} on one server, {settings.seconds:g} s each",
        ("robots", "decisions/s", "p50 [ms]", "p99 [ms]", "fairness"),
    )
    with started_server(settings.policy) as url:
        for num in CLIENTS:
            times_ms = _measure(url, num, settings.seconds, observations, contract)
            row = _figures(times_ms, settings.seconds)
            figures[str(num)] = row
            table.add_row(
                str(num),
                f"{row['decisions_per_s']:.1f}",
                f"{row['p50_ms']:.1f}",
                f"{row['p99_ms']:.1f}",
                f"{row['fairness']:.2f}",
            )
    console.print(table)
    report = {"policy": settings.policy, "cores": os.cpu_count(), "clients": figures}
    write_figures(settings.json, report)


@contextmanager
def started_server(policy: str) -> Iterator[str]:
    """``tacgrasp serve`` in a process of its own, on a free port; gives the address.

    Raises:
        UsageError: It does not start.
    """
    command = [sys.executable, "-m", "tacgrasp", "serve", "--policy", policy, "--port", "0"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        assert process.stdout is not None and process.stderr is not None
        line = process.stdout.readline()  # ends with the process at the latest
        address = re.search(r"ws://\S+", line)
        if address is None:
            raise UsageError(f"the server did not start: {process.stderr.read()[-400:]}")
        yield address[0]
    finally:
        process.terminate()
        process.communicate()


def _observations() -> list[Observation]:
    """Contacts of a simulated berry at rising forces, as a run's loop reads them."""
    observations = []
    for seed, force_n in enumerate(FORCES_N):
        config = load("strawberry")[0].model_copy(update={"seed": seed})
        rig = make_rig(config)
        sense = GelSense(rig.sensor)
        sense.take_reference()
        state = rig.gripper.grip(force_n)
        cloud = rig.sensor.read()
        observations.append(
            Observation(
                cloud=cloud,
                in_contact=sense.in_contact(cloud),
                width_m=state.width_m,
                commanded_force_n=force_n,
                felt_force_n=sense.felt_force(cloud),
            )
        )
        rig.disconnect()
    touched = [each for each in observations if each.in_contact]
    return touched or observations


def _measure(
    url: str,
    num: int,
    seconds: float,
    observations: Sequence[Observation],
    contract: Contract,
) -> list[list[float]]:
    """Durations of the decisions of each robot [ms]."""
    times_ms: list[list[float]] = [[] for _ in range(num)]
    errors: list[Exception] = []
    gate, ends_s = threading.Barrier(num + 1), [0.0]

    def robot(index: int) -> None:
        policy = RemotePolicy(url, timeout_s=TIMEOUT_S)
        try:
            for warm in range(WARM_UP):
                policy.decide(observations[warm % len(observations)], contract)
            gate.wait()
            gate.wait()  # the time has begun
            count = index
            while (began_s := time.perf_counter()) < ends_s[0]:
                policy.decide(observations[count % len(observations)], contract)
                times_ms[index].append(1e3 * (time.perf_counter() - began_s))
                count += 1
        except Exception as error:  # given to the caller below
            errors.append(error)
            gate.abort()
        finally:
            policy.drop()

    robots = [threading.Thread(target=robot, args=(index,)) for index in range(num)]
    for each in robots:
        each.start()
    with contextlib.suppress(threading.BrokenBarrierError):
        gate.wait()
        ends_s[0] = time.perf_counter() + seconds
        gate.wait()
    for each in robots:
        each.join()
    if errors:
        causes = [each for each in errors if not isinstance(each, threading.BrokenBarrierError)]
        raise [*causes, *errors][0]
    return times_ms


def _figures(times_ms: Sequence[Sequence[float]], seconds: float) -> dict[str, float]:
    counts = [len(each) for each in times_ms]
    p50, p99 = np.percentile(np.concatenate(times_ms), [50, 99])
    return {
        "decisions_per_s": sum(counts) / seconds,
        "p50_ms": float(p50),
        "p99_ms": float(p99),
        "fairness": min(counts) / max(counts),
    }
