"""``tacgrasp train force``: fit the force head of weights anew, and leave the rest as it is.

The training of an encoder ends with the same fit; this is for weights that have none, and for
another data set.
"""

from __future__ import annotations

from pathlib import Path

from cltp.checkpoints.card import CARD, renew_card
from cltp.checkpoints.tac3d_llm import load_encoder, save_encoder
from cltp.data.dataset import ContactDataset
from cltp.evaluation.splits import LEARNING_NOISE
from cltp.train.calibration import LEAST_FORCE_CONTACTS, fit_force
from cltp.train.stage import ProgressReport, TrainingRun, silent
from tacgrasp.base.errors import UsageError
from tacgrasp.training.upkeep import write_manifests


def train_force(
    weights: Path, data: Path, command: str, *, seed: int = 0, report: ProgressReport = silent
) -> None:
    """Fit a force head and write the encoder with it, the manifests and the model card.

    Args:
        weights: Folder of weights, or of one method, with an encoder on the grid of all points.
        data: Data set of contacts.
        command: The command line, for the model card.
        seed: Random seed of the choice of contacts, of the noise and of the fit.
        report: Receives the progress.

    Raises:
        UsageError: The encoder takes other points, or the data set is too small.
        TouchError: Weights or data can't be used.
    """
    folder = weights / "encoder"
    encoder, heads = load_encoder(folder)
    heads.force = None
    contacts = ContactDataset(data)
    run = TrainingRun(data=data, out=weights, seed=seed, report=report)
    fit_force(run, encoder.eval(), heads.eval(), LEARNING_NOISE)
    if heads.force is None:
        raise UsageError(
            f"a force head needs an encoder on the grid of all points, with intervals, and "
            f"{LEAST_FORCE_CONTACTS} contacts to learn from; {folder} has the tokenizer "
            f"{encoder.config.tokenizer!r}, {data} {len(contacts)} contacts: tacgrasp data "
            "generate --set full"
        )
    save_encoder(folder, encoder, heads)
    write_manifests(weights)
    if (weights / CARD).exists():
        renew_card(weights, {"force head": f"`{command}`, data checksum {contacts.checksum()}"})
