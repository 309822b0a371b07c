"""``tacgrasp replay EPISODE``: show it, decide it again, or move it again."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

import tyro
from rich.console import Console

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.flags import parse
from tacgrasp.episodes import Episode

MAX_DEVIATION_MM = 1.0
"""A repeated pose further than this from the recorded one changes the exit code [mm]."""

SAME_FORCE_N = 0.005
"""A force that differs by less is printed alike [N]."""


@dataclass(frozen=True)
class ReplayFlags:
    """Replay a recorded episode step by step.

    Attributes:
        episode: The .mcap file.
        decide: Run a policy on the recorded clouds and report every decision that differs.
        policy: Policy that decides; by default the recorded one.
        weights: Folder of the language model's weights; by default the recorded one.
        policy_url: Address of the server that --policy remote asks; by default the recorded one.
        policy_key_file: File with the key that the server asks for; by default the recorded one.
        execute: Repeat the motion on the simulated arm, with a soft start and the same limits.
        verbose: Print each step whole: all of D_t, the commands as sent, the durations.
    """

    episode: tyro.conf.Positional[Path]
    decide: bool = False
    policy: str | None = None
    weights: Path | None = None
    policy_url: str | None = None
    policy_key_file: Path | None = None
    execute: bool = False
    verbose: bool = False


def main(argv: Sequence[str]) -> int:
    """Show, decide or move an episode again; 1 when a decision differs or a pose is not reached."""
    flags = parse(ReplayFlags, argv, prog="tacgrasp replay")
    if flags.decide and flags.execute:
        raise UsageError("give --decide or --execute, one after the other")
    for name in ("policy", "weights", "policy_url", "policy_key_file"):
        if getattr(flags, name) is not None and not flags.decide:
            raise UsageError(f"--{name.replace('_', '-')} needs --decide")
    from tacgrasp.console import StepPrinter, make_console, truth_text
    from tacgrasp.episodes import read_episode
    from tacgrasp.episodes.record import NO_END, end_label
    from tacgrasp.playback.replay import lacks_first_step, times_from_s

    episode = read_episode(flags.episode)
    console = make_console()
    if episode.problem:
        console.print(f"incomplete: {episode.problem}")
    if flags.decide:
        return _decide(episode, flags, console)
    if flags.execute:
        return _execute(episode, flags.episode, console)
    header, end = episode.header, episode.end
    console.print(f"{header.task} with {header.policy}, seed {header.seed}: {header.instruction}")
    if lacks_first_step(episode):
        console.print("times: since the start of the episode, as its first step is missing")
    print_step = StepPrinter(console, verbose=flags.verbose, started_s=times_from_s(episode))
    for step in episode.steps:
        print_step(step)
    if end is None:
        console.print(f"end: not recorded; {NO_END}")
        return 0
    console.print(f"end: {end_label(end.reason, end.truth)} - {end.message}")
    if end.truth is not None:
        console.print(f"truth: {truth_text(end.truth)}")
    return 0


def _decide(episode: Episode, flags: ReplayFlags, console: Console) -> int:
    from tacgrasp.console import working
    from tacgrasp.playback.replay import asked_policy, config_of, contract_in, differences
    from tacgrasp.policy_factory import check_remote_options, make_policy

    name = flags.policy or episode.header.policy
    config = config_of(episode, flags.episode)
    check_remote_options(name, url=flags.policy_url, key_file=flags.policy_key_file)
    given = {name: getattr(flags, name) for name in ("weights", "policy_url", "policy_key_file")}
    config = config.model_copy(update={n: each for n, each in given.items() if each is not None})
    with working(f"loading the policy {name}"):
        policy = make_policy(name, config)
    num_decisions = sum(map(asked_policy, episode.steps))
    num_different = 0
    for difference in differences(episode, policy, contract_in(episode, config)):
        num_different += 1
        console.print(f"{difference.index:3d}  {difference.text}")
    verdict = "" if num_different else ": reproduced exactly"
    if not episode.complete:
        verdict = "; only those that could be read were decided again"
    console.print(f"{name}: {num_decisions} decisions, {num_different} differ{verdict}")
    return 1 if num_different else 0


def _execute(episode: Episode, path: Path, console: Console) -> int:
    from tacgrasp.console import working
    from tacgrasp.playback.replay import config_of, repeat
    from tacgrasp.rig.factory import make_rig

    config = config_of(episode, path)
    if config.devices == "hardware":
        raise UsageError(
            f"{path} was recorded on real devices (rig {episode.header.rig}), which --execute does "
            "not move; replay it without, or with --decide"
        )
    with working("connecting the rig"):
        rig = make_rig(config)
    largest_mm, num_actions, forces_n = 0.0, 0, []
    try:
        with closing(repeat(episode, rig, config)) as actions:
            for action in actions:
                num_actions, largest_mm = num_actions + 1, max(largest_mm, action.deviation_mm)
                if abs(action.deviation_n) > SAME_FORCE_N:
                    forces_n.append(abs(action.deviation_n))
                executed = action.executed
                console.print(
                    f"{action.index:3d}  {executed.primitive}: {executed.sent} | "
                    f"grip {executed.force_n:.2f} N | "
                    f"{''.join(f'{note} | ' for note in executed.clamped)}"
                    f"{action.deviation_mm:.2f} mm from the recorded pose"
                )
    finally:
        rig.disconnect()
    text = f"{num_actions} actions repeated; at most {largest_mm:.2f} mm from the recorded poses"
    if forces_n:
        text += f", {len(forces_n)} with another force (by {max(forces_n):.2f} N at most)"
    console.print(text)
    return 1 if largest_mm > MAX_DEVIATION_MM else 0
