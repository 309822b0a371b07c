"""Pre-trained encoders, read back from their folders; an unsuitable one is refused.

Not here: training (``tacgrasp.pretraining.methods``) and measuring
(``tacgrasp.pretraining.evaluate``).
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path

from cltp.checkpoints.frozen import FrozenEncoder, load_frozen
from cltp.checkpoints.tac3d_llm import load_clip
from cltp.checkpoints.vision import load_vision_checkpoint
from cltp.encoder.clip_towers import Towers
from cltp.encoder.encoder import PRESETS
from cltp.errors import TouchError
from cltp.train.methods import IMAGE_METHODS
from cltp.train.recipes import CltpRecipe
from tacgrasp.base.errors import UsageError
from tacgrasp.pretraining.methods import ABOUT
from tacgrasp.pretraining.report.store import Budget

UNKNOWN = "shipped"
"""Variant of weights without a record of their training, as those of the language model."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TrainedMethod:
    """A method's folder, and how it was trained.

    Attributes:
        folder: Folder with ``encoder`` in it.
        variant: Preset, and what differs from the usual recipe.
        budget: Budget of the pre-training; None where there was none, or it is unknown.
        data: Checksum of the training data; None when unknown.
        device: Device of the training; None when unknown.
        seed: Seed of the pre-training; None when unknown.
        points: Points of the encoder's input; None for images, or when unknown.
        is_external: Whether the folder is a checkpoint in transformers' format instead.
    """

    folder: Path
    variant: str
    budget: Budget | None
    data: str | None = None
    device: str | None = None
    seed: int | None = None
    points: int | None = None
    is_external: bool = False

    def encoder(self) -> FrozenEncoder:
        """The encoder, frozen.

        Raises:
            WeightsError: It is missing, damaged, or its configuration does not match.
        """
        if self.is_external:
            return load_vision_checkpoint(self.folder)
        return load_frozen(self.folder / "encoder")

    def towers(self, weights: Path) -> Towers:
        """The towers that it was aligned with: those of all methods, or beside the encoder.

        Raises:
            TouchError: They can't be read.
        """
        shared = weights / "clip"
        return load_clip(shared if shared.exists() else self.folder / "clip")


def find_method(method: str, out: Path, name: str | None = None) -> TrainedMethod:
    """A trained method, on whatever data.

    Args:
        method: Out of ``cltp.train.methods.METHODS``.
        out: Folder of all methods; for ``cltp`` also a folder of shipped weights.
        name: Name of its folder in ``out``; the method's when not given.

    Raises:
        UsageError: It was not trained yet.
        TouchError: The record of its training can't be read.
    """
    folder = out / (name or method)
    if method == "cltp" and not (folder / "encoder").exists() and (out / "encoder").exists():
        folder = out
    path = folder / ABOUT
    try:
        about = json.loads(path.read_text(encoding="utf-8"))
        budget = Budget(steps=int(about["steps"]), batch_size=int(about["batch_size"]))
        usual = asdict(CltpRecipe())  # older trainings stored entries that a recipe has no more
        recipe = (about["recipe"] or {}).items()
        changed = [f"{k}={v}" for k, v in recipe if k in usual and v != usual[k]]
        variant = PRESETS[about["preset"]].variant
        return TrainedMethod(
            folder=folder,
            points=None if variant.takes_images else variant.layout.num_points,
            variant="+".join([about["preset"], *changed, *(["also"] if "also" in about else [])]),
            budget=budget if budget.steps else None,
            data=about["data"],
            device=about.get("device"),
            seed=about.get("seed"),
        )
    except FileNotFoundError:
        if folder == out and (folder / "clip").exists():
            return TrainedMethod(folder=folder, variant=UNKNOWN, budget=None)
        raise _untrained(method, out, f"no {path}") from None
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise TouchError(f"{path} can't be read; train again: {error}") from error


def _untrained(method: str, out: Path, reason: str) -> UsageError:
    command = f"tacgrasp train {method.replace('_', '-')} --out {out}"
    return UsageError(f"{method} was not trained in {out}: {reason}; do `{command}` first")


def external_checkpoint(method: str, folder: Path) -> TrainedMethod:
    """An image encoder that others trained, in the place of a vision-based method.

    Raises:
        UsageError: The method is another one, or the folder is not there.
    """
    if method not in IMAGE_METHODS:
        names = " or ".join(sorted(IMAGE_METHODS))
        raise UsageError(f"--checkpoint is for {names}, got {method!r}")
    if not folder.is_dir():
        raise UsageError(f"--checkpoint {folder} is no directory")
    variant = f"checkpoint {folder.resolve().name}"
    return TrainedMethod(folder=folder, variant=variant, budget=None, is_external=True)


def find_method_of_data(
    method: str, out: Path, data: str, name: str | None = None
) -> TrainedMethod:
    """A method that was trained on the data that it must have been.

    Args:
        method: Out of ``cltp.train.methods.METHODS``.
        out: Folder of all methods; for ``cltp`` also a folder of shipped weights.
        data: Checksum of the data.
        name: Name of its folder in ``out``; the method's when not given.

    Raises:
        UsageError: It was not trained yet.
        TouchError: It was trained on other data, so that test contacts may be among them.
    """
    trained = find_method(method, out, name)
    if trained.data is None:
        raise _untrained(method, out, f"its data are unknown without {trained.folder / ABOUT}")
    if trained.data != data:
        raise TouchError(
            f"{method} in {trained.folder} was trained on data {trained.data[:12]}, these are "
            f"{data[:12]}: test contacts could have been learned from; name the same data"
        )
    return trained
