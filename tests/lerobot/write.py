"""Write a data set of LeRobot from a simulated episode, and the episode's own values beside it.

Runs in the environment of tacgrasp: ``python -m tests.lerobot.write FOLDER``.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from tacgrasp.__main__ import main
from tacgrasp.episodes import StepPhase, read_episode
from tacgrasp.episodes.export.lerobot import write_lerobot


def write(folder: Path) -> None:
    """Play a demo, export it twice as one set, with and without the language column."""
    assert main(["demo", "paper", "--record", str(folder)]) == 0
    episode_path = str(next(folder.glob("*.mcap")))
    episode = read_episode(Path(episode_path))
    twice = [episode, episode]  # which the command refuses, since a data set holds a run once
    write_lerobot(twice, folder / "set", language=False)
    write_lerobot(twice, folder / "set-language")
    steps = [step for step in episode.steps if step.phase is StepPhase.LOOP]
    np.savez(
        folder / "expected.npz",
        points_mm=np.stack([step.cloud.points_mm for step in steps]),
        position_m=np.stack([step.tcp_pose.position_m for step in steps]),
        commanded_n=[step.gripper.force_n for step in steps],
        monotonic_s=[step.stamp.monotonic_s for step in steps],
        wall_s=[step.stamp.wall_s for step in steps],
        start_s=episode.header.stamp.monotonic_s,
        text=[step.decision.text if step.decision else "" for step in steps],
        instruction=episode.header.instruction,
    )


if __name__ == "__main__":
    write(Path(sys.argv[1]))
