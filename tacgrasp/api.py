"""tacgrasp from Python: configure a run, connect its rig, make its policy, run an episode.

    from tacgrasp import api

    run = api.configure("strawberry", policy="rules", seed=6)
    policy = api.make_policy(run)
    with api.connect(run) as rig:
        episode = api.run_episode(run, rig, policy)
    print(run.contract.summary, episode.outcome.label, episode.path)

Importing it loads neither torch nor open3d. Not here: reading recorded episodes
(``tacgrasp.episodes.read_episode``), the command line (``tacgrasp.cli``).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from policies import Policy
from primitives.contract import Contract
from tacgrasp import policy_factory
from tacgrasp.base.errors import UsageError
from tacgrasp.config.layers import load_with_limits, with_values
from tacgrasp.config.schema import RunConfig
from tacgrasp.config.terms import contract_of
from tacgrasp.rig.factory import check_devices, make_rig
from tacgrasp.rig.protocols import Rig
from tacgrasp.runtime.outcome import Observer, Outcome

__all__ = [
    "Outcome",
    "RecordedRun",
    "Rig",
    "Run",
    "RunConfig",
    "configure",
    "connect",
    "make_policy",
    "run_episode",
]


@dataclass(frozen=True, slots=True, kw_only=True)
class Run:
    """What is to be run.

    Attributes:
        config: Every value of it.
        contract: What instruction, task and values come to: force band, hard limit, place.
    """

    config: RunConfig
    contract: Contract


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordedRun:
    """An episode that was run.

    Attributes:
        outcome: Why it ended, and what became of the object.
        path: Its record, an MCAP file (``tacgrasp.episodes.read_episode``).
    """

    outcome: Outcome
    path: Path


def configure(task: str = "strawberry", rig: str = "sim", **values: Any) -> Run:
    """Configure a run: defaults < task's file < rig's file < ``values``.

    Args:
        task: Name of a task, or path of its YAML file.
        rig: Name of a rig, or path of its YAML file.
        values: Fields of ``RunConfig``; a section is a mapping (``arm={"max_step_mm": 4}``).

    Raises:
        UsageError: An unknown name, a value that doesn't fit, or one that widens the rig's limits.
    """
    for kind, name in (("task", task), ("rig", rig)):
        if not isinstance(name, str):
            raise UsageError(f"configure(): {kind} is a name or a path as text, got {name!r}")
    below, sources, hard = load_with_limits(task, rig)
    config = with_values(below, sources, hard, values, "configure()")
    return Run(config=config, contract=contract_of(config, sources))


def make_policy(run: Run) -> Policy:
    """Make the policy that the run names.

    Raises:
        UsageError: It is unknown, or this run can't use it.
        TouchError: The language model's weights can't be used.
    """
    return policy_factory.make_policy(run.config.policy, run.config)


@contextmanager
def connect(run: Run, *, allow_uncalibrated_force: bool = False) -> Iterator[Rig]:
    """Connect the rig that the run names, and free it at the end of the block.

    Args:
        run: The run.
        allow_uncalibrated_force: Grasp on real devices without a force calibration of the sensor.

    Raises:
        UsageError: Nothing may be grasped with this sensor, or the object is unknown.
        RobotError: A device can't be reached, or is in a wrong state.
    """
    check_devices(run.config, allow_uncalibrated_force=allow_uncalibrated_force)
    rig = make_rig(run.config)
    try:
        yield rig
    finally:
        rig.disconnect()


def run_episode(
    run: Run, rig: Rig, policy: Policy, observers: Sequence[Observer] = ()
) -> RecordedRun:
    """Close the loop until one of its named ends, and record it in ``run.config.record``.

    Args:
        run: The run.
        rig: Its connected rig, which serves one episode.
        policy: Decides.
        observers: Called with the record of each step.

    Raises:
        LimitError: The contract is refused; nothing has moved.
        EpisodeError: The record can't be created; nothing has moved.
        RobotError: The gel does not match the sensor's background; nothing has moved.
    """
    from tacgrasp.run import run_recorded

    outcome, path = run_recorded(rig, policy, run.config, run.contract, observers)
    return RecordedRun(outcome=outcome, path=path)
