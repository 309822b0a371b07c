"""``tacgrasp train force`` and ``train intervals``: what is fitted after an encoder, fitted anew.

The training of an encoder ends with the same fits; these are for weights that have none, for
another data set, and for weights of a version that fitted them otherwise.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from cltp.checkpoints.card import CARD, renew_card
from cltp.checkpoints.tac3d_llm import load_encoder, save_encoder
from cltp.data.contact import Split
from cltp.data.dataset import ContactDataset
from cltp.data.sampler import Augmentation
from cltp.encoder.encoder import TactileEncoder
from cltp.encoder.heads import LEAST_CONTACTS, StateHeads
from cltp.evaluation.splits import LEARNING_NOISE
from cltp.train.calibration import LEAST_FORCE_CONTACTS, calibrate_heads, fit_force
from cltp.train.stage import ProgressReport, TrainingRun, silent
from tacgrasp.base.errors import UsageError
from tacgrasp.training.requests import RefitRequest
from tacgrasp.training.upkeep import check_parts, write_manifests


def train_force(request: RefitRequest, command: str, report: ProgressReport = silent) -> None:
    """Fit a force head and write the encoder with it, the manifests and the model card.

    Args:
        request: The weights, with an encoder on the grid of all points, and the contacts.
        command: The command line, for the model card.
        report: Receives the progress.

    Raises:
        UsageError: The encoder takes other points, or the data set is too small.
        TouchError: Weights, another part beside the encoder too, or data can't be used.
    """
    check_parts(request.weights)
    folder = request.weights / "encoder"
    encoder, heads = load_encoder(folder)
    heads.force = None
    contacts, run, noise = _begun(request, report)
    fit_force(run, encoder.eval(), heads.eval(), noise)
    if heads.force is None:
        raise UsageError(
            f"a force head needs an encoder on the grid of all points, with intervals, and "
            f"{LEAST_FORCE_CONTACTS} contacts to learn from; {folder} has the tokenizer "
            f"{encoder.config.tokenizer!r}, {request.data} {len(contacts)} contacts: tacgrasp data "
            "generate --set full"
        )
    _write(request.weights, encoder, heads, {"force head": f"`{command}`, {_origin(contacts)}"})


def train_intervals(request: RefitRequest, command: str, report: ProgressReport = silent) -> None:
    """Set the intervals of an encoder's numbers anew, and write it; what else it reads stays.

    A force head reads the intervals too, and is fitted to them where the data has as many contacts
    as it was fitted by (``fit_force``).

    Args:
        request: The weights, with an encoder that reads intervals, and the contacts.
        command: The command line, for the model card.
        report: Receives the progress.

    Raises:
        UsageError: The encoder has no intervals, or the data set too few contacts that nothing was
            learned from.
        TouchError: Weights, another part beside the encoder too, or data can't be used.
    """
    check_parts(request.weights)
    encoder, heads = load_encoder(request.weights / "encoder")
    contacts, run, noise = _begun(request, report)
    held_out = int((contacts.column("split") == Split.VALIDATION.value).sum())
    if not heads.has_intervals or held_out < LEAST_CONTACTS:
        raise UsageError(
            f"intervals are set for heads that have them, by {LEAST_CONTACTS} contacts of a split "
            f"'validation'; {request.data} has {held_out} of them: tacgrasp data generate --set "
            "full"
        )
    force, heads.force = heads.force, None
    calibrate_heads(run, encoder.eval(), heads.eval(), noise)
    if force is not None:
        fit_force(run, encoder, heads, noise, force)
    _write(request.weights, encoder, heads, {"intervals": f"`{command}`, {_origin(contacts)}"})


def _begun(
    request: RefitRequest, report: ProgressReport
) -> tuple[ContactDataset, TrainingRun, Augmentation]:
    """The contacts, what a fit by them shares, and their noise."""
    run = TrainingRun(data=request.data, out=request.weights, seed=request.seed, report=report)
    noise = replace(LEARNING_NOISE, coarse=request.coarse)
    return ContactDataset(request.data), run, noise


def _origin(contacts: ContactDataset) -> str:
    return f"data checksum {contacts.checksum()}"


def _write(
    weights: Path, encoder: TactileEncoder, heads: StateHeads, card: Mapping[str, str]
) -> None:
    save_encoder(weights / "encoder", encoder, heads)
    write_manifests(weights)
    if (weights / CARD).exists():
        renew_card(weights, card)
