"""What pre-training left in folders: read back, and refused where it can't be what is tried.

Not here: training (``tacgrasp.pretraining.methods``) and trying
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
from cltp.errors import TouchError
from tacgrasp.base.errors import UsageError
from tacgrasp.pretraining.methods import ABOUT, Wish
from tacgrasp.pretraining.report.store import Budget

VISION = ("tvl", "unitouch")
"""Methods whose encoders take frames, so that others' image encoders can stand for them."""

UNKNOWN = "shipped"
"""Variant of weights that don't say how they came about, as those of the language model."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TrainedMethod:
    """A method's folder, and how it came about.

    Attributes:
        folder: With ``encoder`` in it.
        variant: Preset, and what differs from the usual recipe.
        budget: Of the pre-training; None where there was none, or nobody knows.
        data: Checksum of the data that it learned from; None when nobody knows.
        device: What it was trained on; None when nobody knows.
        seed: Of its pre-training; None when nobody knows.
        by_others: Whether the folder is a checkpoint in transformers' format instead.
    """

    folder: Path
    variant: str
    budget: Budget | None
    data: str | None = None
    device: str | None = None
    seed: int | None = None
    by_others: bool = False

    def encoder(self) -> FrozenEncoder:
        """The encoder, frozen.

        Raises:
            WeightsError: It is missing, damaged, or its configuration does not match.
        """
        if self.by_others:
            return load_vision_checkpoint(self.folder)
        return load_frozen(self.folder / "encoder")

    def towers(self, weights: Path) -> Towers:
        """The towers that it was aligned with: those of all methods, or beside the encoder.

        Raises:
            TouchError: They can't be read.
        """
        shared = weights / "clip"
        return load_clip(shared if shared.exists() else self.folder / "clip")


def stored(method: str, out: Path) -> TrainedMethod:
    """What a method learned, on whatever data.

    Args:
        method: Out of ``METHODS``.
        out: Folder of all methods; for ``cltp`` also a folder of shipped weights.

    Raises:
        UsageError: It was not trained yet.
        TouchError: What says how it was trained can't be read.
    """
    folder = out / method
    if method == "cltp" and not (folder / "encoder").exists() and (out / "encoder").exists():
        folder = out
    path = folder / ABOUT
    try:
        about = json.loads(path.read_text(encoding="utf-8"))
        budget = Budget(steps=int(about["steps"]), batch_size=int(about["batch_size"]))
        return TrainedMethod(
            folder=folder,
            variant=_variant(about["preset"], about["recipe"], also="also" in about),
            budget=budget if budget.steps else None,
            data=about["data"],
            device=about.get("device"),
            seed=about.get("seed"),
        )
    except FileNotFoundError:
        if folder == out and (folder / "clip").exists():
            return TrainedMethod(folder=folder, variant=UNKNOWN, budget=None)
        raise UsageError(
            f"{method} was not trained in {out}: no {path}; "
            f"do `tacgrasp train {method.replace('_', '-')} --out {out}` first"
        ) from None
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise TouchError(f"{path} can't be read; train again: {error}") from error


def checkpoint_of_others(method: str, folder: Path) -> TrainedMethod:
    """An image encoder that others trained, tried as a vision-based method.

    Raises:
        UsageError: The method is another one, or the folder is not there.
    """
    if method not in VISION:
        raise UsageError(f"--checkpoint is for {' or '.join(VISION)}, got {method!r}")
    if not folder.is_dir():
        raise UsageError(f"--checkpoint {folder} is no directory")
    variant = f"checkpoint {folder.resolve().name}"
    return TrainedMethod(folder=folder, variant=variant, budget=None, by_others=True)


def trained(method: str, out: Path, data: str) -> TrainedMethod:
    """What a method learned on the data that it will be tried on.

    Args:
        method: Out of ``METHODS``.
        out: Folder of all methods; for ``cltp`` also a folder of shipped weights.
        data: Checksum of the data that it will be tried on.

    Raises:
        UsageError: It was not trained yet.
        TouchError: It was trained on other data, so that test contacts may be among them.
    """
    found = stored(method, out)
    if found.data is None:
        raise UsageError(
            f"{method} was not trained in {out} on data that are known: no {found.folder / ABOUT}; "
            f"do `tacgrasp train {method.replace('_', '-')} --out {out}` first"
        )
    if found.data != data:
        raise TouchError(
            f"{method} in {found.folder} was trained on data {found.data[:12]}, these are "
            f"{data[:12]}: test contacts could have been learned from; name the same data"
        )
    return found


def _variant(preset: str, recipe: dict[str, object] | None, *, also: bool) -> str:
    usual = asdict(Wish().recipe())
    other = [
        f"{name}={value}"
        for name, value in (recipe or usual).items()
        if name not in ("with_images", "several") and value != usual[name]
    ]
    return "+".join([preset, *other, *(["also"] if also else [])])
