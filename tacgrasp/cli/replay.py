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


@dataclass(frozen=True)
class Replay:
    """Go through a recorded episode again, turn by turn.

    Attributes:
        episode: The .mcap file.
        decide: Run a policy on the recorded touches and report every decision that differs.
        policy: Which policy decides; without it the one that was recorded.
        weights: Folder of the language model's weights; without it those that were recorded.
        execute: Repeat the motion on the simulated arm, with a soft start and the same limits.
    """

    episode: tyro.conf.Positional[Path]
    decide: bool = False
    policy: str | None = None
    weights: Path | None = None
    execute: bool = False


def main(argv: Sequence[str]) -> int:
    """Show, decide or move an episode again; 1 when a decision differs or a pose is not reached."""
    flags = parse(Replay, argv, prog="tacgrasp replay")
    if flags.decide and flags.execute:
        raise UsageError("give --decide or --execute, one after the other")
    for flag, given in (("--policy", flags.policy), ("--weights", flags.weights)):
        if given is not None and not flags.decide:
            raise UsageError(f"{flag} needs --decide")
    from tacgrasp.console import console
    from tacgrasp.episodes import read_episode

    episode = read_episode(flags.episode)
    to = console()
    if episode.problem:
        to.print(f"incomplete: {episode.problem}")
    if flags.decide:
        return _decide(episode, flags, to)
    if flags.execute:
        return _execute(episode, flags.episode, to)
    return _show(episode, to)


def _show(episode: Episode, to: Console) -> int:
    from tacgrasp.console import LineView, truth_words

    header, end = episode.header, episode.end
    to.print(f"{header.task} with {header.policy}, seed {header.seed}: {header.instruction}")
    began_s = episode.ticks[0].stamp.monotonic_s if episode.ticks else 0.0
    view = LineView(to, began_s)
    for tick in episode.ticks:
        view(tick)
    if end is None:
        to.print("end: not recorded; the run was killed or crashed")
        return 0
    to.print(f"end: {end.reason} - {end.message}")
    if end.truth is not None:
        to.print(f"truth: {truth_words(end.truth)}")
    return 0


def _decide(episode: Episode, flags: Replay, to: Console) -> int:
    from tacgrasp.playback.replay import config_of, differences
    from tacgrasp.policy_factory import make_policy

    name = flags.policy or episode.header.policy
    config = config_of(episode, flags.episode)
    if flags.weights is not None:
        config = config.model_copy(update={"weights": flags.weights})
    policy = make_policy(name, config)
    asked = sum(tick.decision is not None for tick in episode.ticks)
    count = 0
    for difference in differences(episode, policy):
        count += 1
        to.print(f"{difference.index:3d}  {difference.why}")
    to.print(f"{name}: {asked} decisions, {count} differ{'' if count else ': reproduced exactly'}")
    return 1 if count else 0


def _execute(episode: Episode, path: Path, to: Console) -> int:
    from tacgrasp.playback.replay import config_of, repeat
    from tacgrasp.rig.factory import make_rig

    config = config_of(episode, path)
    if config.devices == "hardware":
        raise UsageError(
            f"{path} was recorded on real devices (rig {episode.header.rig}), which --execute does "
            "not move; replay it without, or with --decide"
        )
    rig = make_rig(config)
    worst_mm, count = 0.0, 0
    try:
        with closing(repeat(episode, rig, config)) as repeated:
            for turn in repeated:
                count, worst_mm = count + 1, max(worst_mm, turn.off_mm)
                done = turn.executed
                to.print(
                    f"{turn.index:3d}  {done.primitive}: {done.sent} | grip {done.force_n:.2f} N "
                    f"| {turn.off_mm:.2f} mm from the recorded pose"
                )
    finally:
        rig.disconnect()
    to.print(f"{count} actions repeated; at most {worst_mm:.2f} mm from the recorded poses")
    return 1 if worst_mm > REACHED_MM else 0


REACHED_MM = 1.0
"""A repeated pose further than this from the recorded one is reported by the exit code."""
