"""Trains a tiny encoder in a process of its own, with a checkpoint after every step.

With a last step it kills itself there with SIGKILL; without one it is to be killed from outside.
"""

import os
import signal
import sys
from collections.abc import Mapping
from pathlib import Path

import torch

from cltp.encoder.encoder import PRESETS
from cltp.train.alignment import train_cltp
from cltp.train.recipes import CltpRecipe, Schedule
from cltp.train.stage import ProgressReport, TrainingRun, silent


def train_a_little(
    data: Path,
    weights: Path,
    report: ProgressReport = silent,
    checkpoint_s: float = 60.0,
    steps: int = 16,
) -> None:
    """The training that is killed, or not."""
    train_cltp(
        TrainingRun(data=data, out=weights, report=report, checkpoint_s=checkpoint_s),
        PRESETS["tiny_grid"],
        Schedule(steps=steps, batch_size=6, learning_rate=1e-3),
        CltpRecipe(prompt_weight=0.5),
    )


def main(data: Path, weights: Path, last_step: int, steps: int) -> None:
    """Train with a checkpoint after every step; stop hard at ``last_step`` if it is reached."""
    torch.set_num_threads(1)

    def report(stage: str, step: int, steps: int, scores: Mapping[str, float]) -> None:
        if step == last_step:
            os.kill(os.getpid(), signal.SIGKILL)

    train_a_little(data, weights, report, checkpoint_s=0.0, steps=steps)


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4]))
