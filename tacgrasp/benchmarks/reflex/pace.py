"""How fast the reflex is in real time, with a language model that decides beside it.

Part of ``tacgrasp bench reflex``. Recorded frames of one load are handed over at the sensor's
period of wall time; measured is from a frame handed over to its correction, and from one correction
to the next.
"""

from __future__ import annotations

import multiprocessing
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing.synchronize import Event

import numpy as np

from cltp.tactile.shear.field import ShearField
from policies import Observation
from sim.grasp.drawn.loads import DrawnLoad, draw_load
from sim.grasp.rig import build
from tacgrasp.benchmarks.reflex.loads import Keeper, noisy_frames
from tacgrasp.config.layers import load
from tacgrasp.config.terms import contract_of
from tacgrasp.drivers.scheduling import request_priority
from tacgrasp.policy_factory import make_policy

START_S = 120.0
"""Longest wait for the language model's first decision [s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Pace:
    """Durations in wall time.

    Attributes:
        command_ms: From a frame handed over to its correction [ms].
        late_ms: From when a frame was due to when it was taken up: the scheduler's part [ms].
        interval_ms: From one correction to the next [ms].
        decisions: Decisions of the language model meanwhile; 0 without one.
    """

    command_ms: list[float]
    late_ms: list[float]
    interval_ms: list[float]
    decisions: int


def measure_pace(sensor_name: str, seed: int, seconds: float) -> Pace:
    """Run the reflex at the sensor's rate for some seconds.

    Raises:
        RuntimeError: The language model did not begin to decide.
    """
    drawn = draw_load(seed, sensor_name)
    frames = list(noisy_frames(drawn, seed))
    with model_beside() as decisions:
        before = decisions.value
        pace = _paced(drawn, frames, seconds)
        return Pace(
            command_ms=pace.command_ms,
            late_ms=pace.late_ms,
            interval_ms=pace.interval_ms,
            decisions=decisions.value - before,
        )


def _paced(drawn: DrawnLoad, frames: list[ShearField], seconds: float) -> Pace:
    request_priority()
    period_s = 1.0 / drawn.fingers.sensor.frame_hz
    keeper = Keeper(drawn.fingers.sensor, drawn.force_n)
    command_ms, late_ms, ends = [], [], []
    due_s = time.perf_counter()
    for k in range(round(seconds / period_s)):
        due_s += period_s
        time.sleep(max(0.0, due_s - time.perf_counter()))
        late_ms.append(1e3 * (time.perf_counter() - due_s))
        began_s = time.perf_counter()
        answered = keeper.see(frames[k % len(frames)], k * period_s)
        ended_s = time.perf_counter()
        if answered is not None:
            command_ms.append(1e3 * (ended_s - began_s))
            ends.append(ended_s)
    intervals = (1e3 * np.diff(ends)).tolist()
    return Pace(command_ms=command_ms, late_ms=late_ms, interval_ms=intervals, decisions=0)


@contextmanager
def model_beside() -> Iterator[multiprocessing.sharedctypes.Synchronized[int]]:
    """A process in which the shipped language model decides again and again; its count."""
    context = multiprocessing.get_context("spawn")
    ending, decisions = context.Event(), context.Value("i", 0)
    process = context.Process(target=_decide, args=(ending, decisions), daemon=True)
    process.start()
    try:
        until_s = time.monotonic() + START_S
        while decisions.value == 0:
            if time.monotonic() > until_s or not process.is_alive():
                raise RuntimeError("the language model beside the reflex made no decision")
            time.sleep(0.05)
        yield decisions
    finally:
        ending.set()
        process.join(10)
        if process.is_alive():
            process.kill()


def _decide(ending: Event, decisions: multiprocessing.sharedctypes.Synchronized[int]) -> None:
    config, _ = load("strawberry")
    policy, rig = make_policy("llm", config), build("strawberry", 0)
    contract = contract_of(config)
    rig.gripper.grip(1.0)
    observation = Observation(cloud=rig.sensor.read(), in_contact=True)
    while not ending.is_set():
        policy.decide(observation, contract)
        decisions.value += 1
