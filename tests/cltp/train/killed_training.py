"""Trains a tiny encoder in a process of its own; kills itself with SIGKILL after some steps."""

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
    data: Path, weights: Path, report: ProgressReport = silent, checkpoint_s: float = 60.0
) -> None:
    """The training that is killed, or not."""
    train_cltp(
        TrainingRun(data=data, out=weights, report=report, checkpoint_s=checkpoint_s),
        PRESETS["tiny"],
        Schedule(steps=16, batch_size=6, learning_rate=1e-3),
        CltpRecipe(prompt_weight=0.5),
    )


def main(data: Path, weights: Path, last_step: int) -> None:
    """Train with a checkpoint after every step, and stop hard at ``last_step``."""
    torch.set_num_threads(1)

    def report(stage: str, step: int, steps: int, scores: Mapping[str, float]) -> None:
        if step == last_step:
            os.kill(os.getpid(), signal.SIGKILL)

    train_a_little(data, weights, report, checkpoint_s=0.0)


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3]))
