"""``tacgrasp run``: close the loop on a task, once."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Any

import tyro

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse, parse_some
from tacgrasp.config.errors import flag_of
from tacgrasp.config.hardware import HardwareConfig
from tacgrasp.config.layers import Sources, leaves, load_with_limits
from tacgrasp.config.schema import RunConfig
from tacgrasp.runtime.outcome import EndReason, Outcome

EXIT_CODES = {
    EndReason.SUCCESS: 0,
    EndReason.FAULT: 3,
    EndReason.OPERATOR: 130,
}
"""Exit codes of some ends; every other end is 1: the run was sound, the grasp was not good."""


@dataclass(frozen=True)
class LayerFlags:
    """The flags that name files with defaults of all others."""

    task: str | None = None
    rig: str | None = None


class RunFlags(RunConfig):
    """Close the loop on a task. Values: defaults < task < rig < environment < flags.

    Attributes:
        print_config: Print every value and its source, and do nothing else.
    """

    hardware: Annotated[HardwareConfig | None, tyro.conf.Suppress] = None
    print_config: bool = False


def main(argv: Sequence[str]) -> int:
    """Run one episode and return its exit code."""
    config, sources, print_config = configure(argv)
    if print_config:
        _print_config(config, sources)
        return 0
    outcome = _run(config)
    if config.dry_run and outcome.reason in (EndReason.UNVERIFIED, EndReason.MAX_STEPS):
        return 0  # the one decision of a dry run was made
    return EXIT_CODES.get(outcome.reason, 1)


def configure(argv: Sequence[str]) -> tuple[RunConfig, Sources, bool]:
    """Configuration after flags, source of each value, and whether to do no more than print them.

    Raises:
        UsageError: Something in file, environment or flags doesn't fit.
    """
    layers = parse_some(LayerFlags, argv)
    below, sources, hard = load_with_limits(layers.task, layers.rig, os.environ)
    values = {name: getattr(below, name) for name in type(below).model_fields}
    default = RunFlags.model_construct(**values, print_config=False)
    flags = parse(RunFlags, argv, prog="tacgrasp run", default=default)
    tokens = {token.split("=")[0] for token in argv if token.startswith("--")}
    config = RunConfig(**{name: getattr(flags, name) for name in RunConfig.model_fields})
    for path in leaves(config):
        flag = flag_of(path)
        if flag in tokens or flag.replace("--", "--no-", 1) in tokens:
            sources[path] = f"flag {flag}"
    hard.check(config, lambda path: sources[path])
    return config, sources, flags.print_config


def _run(config: RunConfig) -> Outcome:
    from tacgrasp.console import StepPrinter, end_lines, make_console
    from tacgrasp.policy_factory import make_policy
    from tacgrasp.rig.factory import make_rig
    from tacgrasp.run import run_recorded

    if config.hardware is not None and not config.hardware.sensor.is_live and not config.dry_run:
        raise UsageError(
            f"the sensor of the rig's file ({config.rig}) plays a recording: nothing is felt, so "
            "nothing may be grasped; give --dry-run to see what would be decided"
        )
    policy = make_policy(config.policy, config)
    rig = make_rig(config)
    console = make_console()
    try:
        console.print(f"{config.task} with {policy.name}, seed {config.seed}: {config.instruction}")
        outcome, path = run_recorded(rig, policy, config, observers=[StepPrinter(console)])
    finally:
        rig.disconnect()
    console.print(f"episode: {path}")
    for line in end_lines(outcome):
        console.print(line)
    return outcome


def _print_config(config: RunConfig, sources: Sources) -> None:
    from tacgrasp.console import make_console

    values: dict[str, Any] = leaves(config)
    width = max(map(len, values))
    console = make_console()
    for path, value in values.items():
        text = "none" if value is None else str(value)
        if isinstance(value, tuple):
            text = f"[{', '.join(f'{v:g}' for v in value)}]"
        console.print(f"{path:{width}}  {text}  [{sources.get(path, 'default')}]")
