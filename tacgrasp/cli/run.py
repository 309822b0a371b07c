"""``tacgrasp run``: close the loop on a task, once."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Annotated, Any

import tyro

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import flag_value, parse
from tacgrasp.config.hardware import HardwareConfig
from tacgrasp.config.layers import Sources, leaves, load_with_limits
from tacgrasp.config.schema import RunConfig
from tacgrasp.runtime.outcome import EndReason, Outcome

EXIT_CODES = {
    EndReason.SUCCESS: 0,
    EndReason.FAULT: 3,
    EndReason.OPERATOR: 130,
}
"""Every other end is 1: the run was sound, the grasp was not good."""


class RunFlags(RunConfig):
    """Close the loop on a task. Values: defaults < task < rig < environment < flags.

    Attributes:
        print_config: Print every value and where it came from, and do nothing else.
    """

    hardware: Annotated[HardwareConfig | None, tyro.conf.Suppress] = None
    print_config: bool = False


def main(argv: Sequence[str]) -> int:
    """Run one episode and return its exit code."""
    config, sources, print_config = configure(argv)
    if print_config:
        _print_config(config, sources)
        return 0
    return _exit_code(_run(config), dry_run=config.dry_run)


def configure(argv: Sequence[str]) -> tuple[RunConfig, Sources, bool]:
    """The configuration after flags, where each value came from, and whether to print just that.

    Raises:
        UsageError: Something in file, environment or flags doesn't fit.
    """
    task, rig = flag_value(argv, "--task"), flag_value(argv, "--rig")
    below, sources, hard = load_with_limits(task, rig, os.environ)
    values = {name: getattr(below, name) for name in type(below).model_fields}
    default = RunFlags.model_construct(**values, print_config=False)
    flags = parse(RunFlags, argv, prog="tacgrasp run", default=default)
    given = {token.split("=")[0] for token in argv if token.startswith("--")}
    config = RunConfig(**{name: getattr(flags, name) for name in RunConfig.model_fields})
    for path in leaves(config):
        flag = f"--{path.replace('_', '-')}"
        if flag in given or flag.replace("--", "--no-", 1) in given:
            sources[path] = f"flag {flag}"
    hard.check(config, lambda path: sources[path])
    return config, sources, flags.print_config


def _run(config: RunConfig) -> Outcome:
    from tacgrasp.console import LineView, console, end_lines
    from tacgrasp.policy_factory import make_policy
    from tacgrasp.rig.factory import make_rig
    from tacgrasp.run import run_recorded

    if config.hardware is not None and not config.hardware.feels and not config.dry_run:
        raise UsageError(
            f"the sensor of the rig's file ({config.rig}) plays a recording: nothing is felt, so "
            "nothing may be grasped; give --dry-run to see what would be decided"
        )
    policy = make_policy(config.policy, config)
    rig = make_rig(config)
    out = console()
    try:
        out.print(f"{config.task} with {policy.name}, seed {config.seed}: {config.instruction}")
        outcome, path = run_recorded(rig, policy, config, observers=[LineView(out)])
    finally:
        rig.disconnect()
    out.print(f"episode: {path}")
    for line in end_lines(outcome):
        out.print(line)
    return outcome


def _exit_code(outcome: Outcome, *, dry_run: bool) -> int:
    if dry_run and outcome.reason in (EndReason.UNVERIFIED, EndReason.MAX_STEPS):
        return 0  # a decision was made, which is all that a dry run is for
    return EXIT_CODES.get(outcome.reason, 1)


def _print_config(config: RunConfig, sources: Sources) -> None:
    out: dict[str, Any] = leaves(config)
    width = max(map(len, out))
    from tacgrasp.console import console

    to = console()
    for path, value in out.items():
        to.print(f"{path:{width}}  {_shown(value)}  [{sources.get(path, 'default')}]")


def _shown(value: object) -> str:
    if isinstance(value, tuple):
        return f"[{', '.join(f'{v:g}' for v in value)}]"
    return "none" if value is None else str(value)
