"""Run one episode and record it: rig, policy, executor, verification and recorder together.

Not here: the loop itself (``tacgrasp.loop``), flags and printing (``tacgrasp.cli.run``).
"""

from __future__ import annotations

import platform
from collections.abc import Sequence
from dataclasses import replace
from importlib import metadata
from pathlib import Path

import yaml

from policies import Policy
from primitives.contract import Contract
from primitives.execution import PadAxes
from tacgrasp import __version__
from tacgrasp.config.schema import RunConfig
from tacgrasp.episodes import (
    EpisodeError,
    EpisodeHeader,
    EpisodeWriter,
    episode_path,
    make_record_directory,
)
from tacgrasp.loop import run_episode
from tacgrasp.rig.factory import make_executor
from tacgrasp.rig.gel_sense import GelSense
from tacgrasp.rig.protocols import Rig
from tacgrasp.runtime.outcome import EndReason, Observer, Outcome
from tacgrasp.runtime.reflex_loop import slip_threshold
from tacgrasp.runtime.steps import NoRecorder
from tacgrasp.runtime.verify import accelerations, not_lifted, verify_by_lifting


def run_recorded(
    rig: Rig,
    policy: Policy,
    config: RunConfig,
    contract: Contract,
    observers: Sequence[Observer] = (),
    *,
    feel: bool = True,
) -> tuple[Outcome, Path]:
    """Run an episode and record it in ``config.record``; the file is closed on every path.

    Args:
        rig: The connected rig.
        policy: Decides.
        config: The run.
        contract: Contract of the episode.
        observers: Called after each step.
        feel: Whether closings approach and contact is tested; False closes with the first force.

    Raises:
        EpisodeError: The record can't be created; nothing has moved.
        LimitError: The contract is refused, or the rig starts outside its workspace; nothing has
            moved.
        RobotError: The gripper is not open, or the gel does not match the sensor's background;
            nothing has moved.
        TouchError: The slip calibration can't be used; nothing has moved.
    """
    if not config.dry_run:
        rig.expect_untouched()
    header = _header(rig, policy, config, contract)
    sense = GelSense(rig.sensor) if feel else None
    executor = make_executor(rig, config, contract, sense)
    slip_threshold(rig, config)  # a wrong calibration ends here, before there is a record
    directory = make_record_directory(config.record)
    path = episode_path(directory, Path(config.task).stem, header.stamp, header.seed)
    outcome: Outcome | None = None
    try:
        with EpisodeWriter(path, header) as recorder:
            outcome = run_episode(
                rig,
                executor,
                policy,
                config,
                contract,
                verify=not_lifted if config.dry_run else verify_by_lifting,
                recorder=recorder,
                observers=observers,
                sense=sense,
            )
    except EpisodeError as error:
        if outcome is None:
            raise
        message = f"{outcome.message}; {error}"
        outcome = replace(outcome, reason=EndReason.FAULT, message=message)
    if outcome.truth is None:
        return outcome, path
    return replace(outcome, slip_minimum_n=slip_minimum_of(rig, config)), path


def run_unrecorded(
    rig: Rig,
    policy: Policy,
    config: RunConfig,
    contract: Contract,
    observers: Sequence[Observer] = (),
    *,
    sense: GelSense | None,
    bounded: bool = True,
    feels: bool = True,
) -> Outcome:
    """Run an episode without a record, for benchmarks that keep only their figures.

    Args:
        rig: The connected rig.
        policy: Decides.
        config: The run.
        contract: Contract of the episode.
        observers: Called after each step.
        sense: Touch; None closes with the first force and tests no contact.
        bounded: Whether the contract bounds the commands; not those of a baseline without touch.
        feels: Whether the fingers feel while they close; without, ``sense`` has taken its reference
            before.
    """
    return run_episode(
        rig,
        make_executor(rig, config, contract if bounded else None, sense if feels else None),
        policy,
        config,
        contract,
        verify=verify_by_lifting,
        recorder=NoRecorder(),
        observers=observers,
        sense=sense,
    )


def slip_minimum_of(rig: Rig, config: RunConfig) -> float | None:
    """Least true force that would have held the simulated body, centred [N]; None on other rigs."""
    from sim.grasp.rig import SimRig  # loads torch, which the rig has loaded too

    if not isinstance(rig, SimRig):
        return None
    return rig.grasp.fingers.slip_minimum_n(accelerations(config.verify))


def _header(rig: Rig, policy: Policy, config: RunConfig, contract: Contract) -> EpisodeHeader:
    values = config.model_dump(mode="json")
    return EpisodeHeader(
        task=Path(config.task).stem,
        instruction=config.instruction,
        policy=policy.name,
        seed=None if config.devices == "hardware" else config.seed,
        sensor=rig.sensor.spec,
        config_yaml=yaml.safe_dump(values, sort_keys=False, allow_unicode=True),
        versions=_versions(),
        rig=Path(config.rig).stem,
        dry_run=config.dry_run,
        contract=contract,
        stamp=rig.clock.stamp(),
        pad=PadAxes(x_tcp=config.pad.x_axis, y_tcp=config.pad.y_axis),
    )


def _versions() -> dict[str, str]:
    libraries = {name: metadata.version(name) for name in ("numpy", "scipy", "torch", "mcap")}
    return {"tacgrasp": __version__, "python": platform.python_version(), **libraries}
