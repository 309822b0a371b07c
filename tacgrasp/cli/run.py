"""``tacgrasp run``: close the loop on a task, once."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping, Sequence
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import tyro

from primitives.contract import Contract
from tacgrasp.base.errors import UsageError
from tacgrasp.base.settings import SettingsBase
from tacgrasp.cli.flags import parse, parse_some, writable
from tacgrasp.config.errors import denied_flag_of, flag_of
from tacgrasp.config.hardware import HardwareConfig
from tacgrasp.config.layers import Sources, leaves, load_with_limits
from tacgrasp.config.schema import RunConfig
from tacgrasp.runtime.outcome import EndReason, Observer, Outcome

if TYPE_CHECKING:
    from rich.console import Console

    from policies import Policy
    from tacgrasp.rig.protocols import Rig
    from tacgrasp.runtime.events import EventFile

EXIT_CODES = {
    EndReason.FAULT: 3,
    EndReason.OPERATOR: 130,
    EndReason.DRY_RUN: 0,
}
"""Exit codes of some ends; a completed grasp is 0, any other end 1: a sound run, no good grasp."""

CUT_SHORT = 3
"""Exit code of a run that would be 0, where the file of ``--json`` lacks steps or the end."""


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
        events: File for the contract, every step and the end: F.json, an array of them, or F.jsonl,
            one JSON object a line.
        verbose: Print each step whole: all of D_t, the commands as sent, the durations.
        view: Show the run live in rerun's viewer: gel, forces, arm (needs the extra 'view').
    """

    hardware: Annotated[HardwareConfig | None, tyro.conf.Suppress] = None
    print_config: bool = False
    allow_uncalibrated_force: bool = False
    events: Annotated[Path | None, tyro.conf.arg(name="json")] = None
    verbose: bool = False
    view: bool = False


def main(argv: Sequence[str]) -> int:
    """Run one episode and return its exit code."""
    config, sources, flags = configure(argv)
    from tacgrasp.config.terms import contract_of
    from tacgrasp.episodes.paths import check_record_directory
    from tacgrasp.policy_factory import check_run_policy
    from tacgrasp.rig.factory import check_devices, check_names
    from tacgrasp.runtime.events import EventFile
    from tacgrasp.viewer.server import require_rerun

    contract = contract_of(config, sources)
    if flags.print_config:
        _print_config(config, sources, contract)
        return 2 if contract.refused else 0
    check_devices(config, allow_uncalibrated_force=flags.allow_uncalibrated_force)
    check_run_policy(config)
    check_names(config)
    if flags.view:
        require_rerun()
    check_record_directory(config.record)
    writable(flags.events, ".json", ".jsonl")
    with EventFile(flags.events) as events:
        try:
            outcome = _run(config, contract, events, flags)
        except SystemExit as error:  # of a plugin's device: no end of ours, and no success
            raise RuntimeError("a device or policy asked Python to exit") from error
    code = 0 if outcome.completed else EXIT_CODES.get(outcome.reason, 1)
    return CUT_SHORT if code == 0 and events.problem else code


def configure(argv: Sequence[str]) -> tuple[RunConfig, Sources, RunFlags]:
    """Configuration after flags, source of each value, and the flags themselves.

    Raises:
        UsageError: Something in file, environment or flags doesn't fit.
    """
    layers = parse_some(LayerFlags, argv)
    below, sources, hard = load_with_limits(layers.task, layers.rig, os.environ)
    values = {name: getattr(below, name) for name in type(below).model_fields}
    default = RunFlags.model_construct(**values)
    flags = parse(RunFlags, argv, prog="tacgrasp run", default=default)
    named = {token.split("=")[0].replace("_", "-") for token in argv if token.startswith("--")}
    config = RunConfig(**{name: getattr(flags, name) for name in RunConfig.model_fields})
    for path in leaves(config):
        flag = flag_of(path)
        if not named.isdisjoint((flag, denied_flag_of(path))):
            sources[path] = f"flag {flag}"
    hard.check(config, lambda path: sources[path])
    return config, sources, flags


def _run(config: RunConfig, contract: Contract, events: EventFile, flags: RunFlags) -> Outcome:
    from tacgrasp.config.terms import contract_lines
    from tacgrasp.console import end_lines, make_console, width_of, working, wrapped
    from tacgrasp.episodes.interrupts import delayed_interrupts
    from tacgrasp.run import run_recorded
    from tacgrasp.runtime.reflex_loop import unfelt_slips

    events.contract(contract)
    if events.problem:
        raise UsageError(f"{events.problem}; free space, or name another file; nothing moved")
    if contract.refused:
        events.refused(contract)
        raise UsageError(
            f"refused: {contract.refused}. Understood: {contract.summary}; nothing moved"
        )
    console = make_console()
    with ExitStack() as stack:
        with working("loading the policy and connecting the rig"):
            policy, rig = _connect(config, stack)
        seed = "" if config.devices == "hardware" else f", seed {config.seed}"
        start = f"{config.task} with {policy.name}{seed}: {config.instruction}"
        warning = unfelt_slips(rig, config)
        warnings = [f"warning: {warning}"] if warning else []
        for text in (start, *contract_lines(contract), *warnings):
            indent = 2 if text.startswith("  ") else 0
            for line in wrapped(text.strip(), indent, indent + 2, width_of(console)):
                console.print(line)
        watch = [_printer(contract, console, stack, verbose=flags.verbose), events.step]
        if flags.view:
            watch.append(_viewer(config, contract, console, stack))
        outcome, path = run_recorded(rig, policy, config, contract, observers=watch)
        connected = stack.pop_all()
    with suppress(KeyboardInterrupt), delayed_interrupts():  # the robot's state is always told
        connected.close()
        events.end(outcome)
        console.print(f"episode: {path}")
        for end_line in end_lines(outcome, config, width_of(console)):
            console.print(end_line)
        if events.problem:
            sys.stderr.write(f"tacgrasp: {events.problem}; what came later is not in it\n")
    return outcome


def _connect(config: RunConfig, stack: ExitStack) -> tuple[Policy, Rig]:
    """Policy and rig; ``stack`` disconnects the rig."""
    from tacgrasp.policy_factory import make_policy
    from tacgrasp.rig.factory import make_rig

    policy = make_policy(config.policy, config)
    rig = make_rig(config)
    stack.callback(rig.disconnect)
    return policy, rig


def _viewer(config: RunConfig, contract: Contract, console: Console, stack: ExitStack) -> Observer:
    """A viewer that shows every step; a window stays open, a page ends with the run."""
    from tacgrasp.viewer.feed import Feed
    from tacgrasp.viewer.scene import RerunScene
    from tacgrasp.viewer.server import Viewer, has_display
    from tacgrasp.viewer.show import pad_of

    viewer = Viewer(web=not has_display())
    if viewer.page:
        console.print(f"open {viewer.page} in a browser on this computer")
        stack.callback(viewer.close)
    scene = RerunScene(viewer.stream("run"), contract, pad_of(config))
    feed = Feed(scene.step)
    stack.callback(feed.close)
    return feed


def _printer(contract: Contract, console: Console, stack: ExitStack, *, verbose: bool) -> Observer:
    """What shows the steps: a live table on a terminal, plain lines elsewhere."""
    from tacgrasp.console import StepPrinter
    from tacgrasp.viewer.live_table import LiveTable

    if console.is_terminal and not verbose:
        return stack.enter_context(LiveTable(contract))
    return StepPrinter(console, verbose=verbose)


def _print_config(config: RunConfig, sources: Sources, contract: Contract) -> None:
    from tacgrasp.config.terms import band_lines, contract_lines
    from tacgrasp.console import make_console

    values: dict[str, Any] = leaves(config)
    width = max(map(len, values))
    console = make_console()
    for path, value in values.items():
        console.print(f"{path:{width}}  {_text(value)}  [{sources.get(path, 'default')}]")
    for line in [*contract_lines(contract), *band_lines(contract)]:
        console.print(line)


def _text(value: object) -> str:
    """A value as a rig's file writes it; sections that stand in a list within braces."""
    if value is None:
        return "none"
    if isinstance(value, SettingsBase):
        return _text(dict(value))
    if isinstance(value, Mapping):
        return f"{{{', '.join(f'{name}: {_text(part)}' for name, part in value.items())}}}"
    if isinstance(value, (list, tuple)):
        parts = (f"{v:g}" if isinstance(v, float) else _text(v) for v in value)
        return f"[{', '.join(parts)}]"
    return str(value)
