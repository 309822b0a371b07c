"""``tacgrasp run``: close the loop on a task, once."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import tyro

from primitives.contract import Contract
from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse, parse_some, writable
from tacgrasp.config.errors import flag_of
from tacgrasp.config.hardware import HardwareConfig
from tacgrasp.config.layers import Sources, leaves, load_with_limits
from tacgrasp.config.schema import RunConfig
from tacgrasp.runtime.outcome import EndReason, Observer, Outcome

if TYPE_CHECKING:
    from tacgrasp.runtime.events import EventFile

EXIT_CODES = {
    EndReason.FAULT: 3,
    EndReason.OPERATOR: 130,
}
"""Exit codes of some ends; a completed grasp is 0, any other end 1: a sound run, no good grasp."""


@dataclass(frozen=True)
class LayerFlags:
    """The flags that name files with defaults of all others."""

    task: str | None = None
    rig: str | None = None


class RunFlags(RunConfig):
    """Close the loop on a task. Values: defaults < task < rig < environment < flags.

    Attributes:
        print_config: Print every value and its source, then the contract, and do nothing else.
        allow_uncalibrated_force: Grasp on real devices without a force calibration of the sensor.
        events: File for the contract, every step and the end, one JSON object a line.
    """

    hardware: Annotated[HardwareConfig | None, tyro.conf.Suppress] = None
    print_config: bool = False
    allow_uncalibrated_force: bool = False
    events: Annotated[Path | None, tyro.conf.arg(name="json")] = None


def main(argv: Sequence[str]) -> int:
    """Run one episode and return its exit code."""
    config, sources, flags = configure(argv)
    from tacgrasp.config.terms import contract_of
    from tacgrasp.rig.factory import check_devices
    from tacgrasp.runtime.events import EventFile

    contract = contract_of(config, sources)
    if flags.print_config:
        _print_config(config, sources, contract)
        return 0
    check_devices(config, allow_uncalibrated_force=flags.allow_uncalibrated_force)
    writable(flags.events)
    with EventFile(flags.events) as events:
        outcome = _run(config, contract, events)
    if config.dry_run and outcome.reason in (EndReason.UNVERIFIED, EndReason.MAX_STEPS):
        return 0  # the one decision of a dry run was made
    return 0 if outcome.completed else EXIT_CODES.get(outcome.reason, 1)


def configure(argv: Sequence[str]) -> tuple[RunConfig, Sources, RunFlags]:
    """Configuration after flags, source of each value, and the flags themselves.

    Raises:
        UsageError: Something in file, environment or flags doesn't fit.
    """
    layers = parse_some(LayerFlags, argv)
    below, sources, hard = load_with_limits(layers.task, layers.rig, os.environ)
    values = {name: getattr(below, name) for name in type(below).model_fields}
    default = RunFlags.model_construct(**values, print_config=False, allow_uncalibrated_force=False)
    flags = parse(RunFlags, argv, prog="tacgrasp run", default=default)
    tokens = {token.split("=")[0] for token in argv if token.startswith("--")}
    config = RunConfig(**{name: getattr(flags, name) for name in RunConfig.model_fields})
    for path in leaves(config):
        flag = flag_of(path)
        if flag in tokens or flag.replace("--", "--no-", 1) in tokens:
            sources[path] = f"flag {flag}"
    hard.check(config, lambda path: sources[path])
    return config, sources, flags


def _run(config: RunConfig, contract: Contract, events: EventFile) -> Outcome:
    from tacgrasp.config.terms import contract_lines
    from tacgrasp.console import StepPrinter, end_lines, make_console
    from tacgrasp.policy_factory import make_policy
    from tacgrasp.rig.factory import make_rig
    from tacgrasp.run import run_recorded

    events.contract(contract)
    if contract.refused:
        events.refused(contract)
        raise UsageError(
            f"refused: {contract.refused}. Understood: {contract.summary}; nothing moved"
        )
    policy = make_policy(config.policy, config)
    rig = make_rig(config)
    console = make_console()
    try:
        console.print(f"{config.task} with {policy.name}, seed {config.seed}: {config.instruction}")
        for line in contract_lines(contract):
            console.print(line)
        watch: list[Observer] = [StepPrinter(console), events.step]
        outcome, path = run_recorded(rig, policy, config, contract, observers=watch)
        events.end(outcome)
    finally:
        rig.disconnect()
    console.print(f"episode: {path}")
    for text in end_lines(outcome, config):
        console.print(text)
    return outcome


def _print_config(config: RunConfig, sources: Sources, contract: Contract) -> None:
    from tacgrasp.config.terms import band_lines, contract_lines
    from tacgrasp.console import make_console

    values: dict[str, Any] = leaves(config)
    width = max(map(len, values))
    console = make_console()
    for path, value in values.items():
        text = "none" if value is None else str(value)
        if isinstance(value, tuple):
            text = f"[{', '.join(f'{v:g}' for v in value)}]"
        console.print(f"{path:{width}}  {text}  [{sources.get(path, 'default')}]")
    for line in [*contract_lines(contract), *band_lines(contract)]:
        console.print(line)
