"""Pre-train by every method on one data set with one budget, each into a folder of its own.

    OUT/clip/              the towers that all share
    OUT/METHOD/encoder/    what a method learned; OUT/METHOD/about.json says how
    OUT/encoder/           where ``tacgrasp train cltp`` puts the encoder that is shipped

Every step is resumable, and what is done is not repeated. Measuring is in
``tacgrasp.pretraining.evaluate``.
"""

from __future__ import annotations

import dataclasses
import json
from dataclasses import asdict, dataclass
from pathlib import Path

import torch

from cltp.atomic_write import write_atomically
from cltp.data.dataset import ContactDataset
from cltp.encoder.encoder import DEFAULT_PRESETS, PRESETS, EncoderConfig
from cltp.evaluation.splits import LEARNING
from cltp.train.alignment import SCHEDULE as CLTP_SCHEDULE
from cltp.train.alignment import Recipe, train_cltp
from cltp.train.baselines import train_baseline
from cltp.train.clip import SCHEDULE as CLIP_SCHEDULE
from cltp.train.clip import train_clip
from cltp.train.distributed import Workers
from cltp.train.llm import train_words
from cltp.train.stage import ProgressReport, Schedule, silent
from tacgrasp.base.errors import UsageError
from tacgrasp.lessons.exchanges import TouchLessons

ABOUT = "about.json"
METHODS = ("cltp", "cltp_no_image", "random", "point_mae", "point_bert", "tvl", "unitouch")
"""In the order in which ``all-methods`` trains them: what the paper is about first."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Wish:
    """What a pre-training is to be, on the command line; None is the method's usual.

    Attributes:
        preset: Out of ``cltp.encoder.encoder.PRESETS``.
        steps: Optimiser steps.
        batch_size: Contacts in a step.
        texts: What is said of contacts.
        prompt_weight: Of the contrast with one prompt a class.
        head_weight: Of the state heads.
        read_weight: Of letting CLIP's texts be read back.
        moved: Share of contacts that are shifted and turned on the pad.
        with_images: Whether L_T2I is minimised.
        also: A further data set that CLTP learns from.
    """

    preset: str | None = None
    steps: int | None = None
    batch_size: int | None = None
    texts: str = "mixed"
    prompt_weight: float = 1.0
    head_weight: float = 1.0
    read_weight: float = 1.0
    moved: float = 0.0
    with_images: bool = True
    also: Path | None = None

    def config(self, method: str) -> EncoderConfig:
        """The encoder.

        Raises:
            UsageError: There is no such preset.
        """
        name = self.preset_of(method)
        if name not in PRESETS:
            raise UsageError(f"unknown preset {name!r}; known: {', '.join(PRESETS)}")
        return PRESETS[name]

    def preset_of(self, method: str) -> str:
        """Name of the encoder's preset."""
        return self.preset or DEFAULT_PRESETS[method]

    def schedule(self, usual: Schedule) -> Schedule:
        """The usual schedule of a stage with as many steps and contacts as wished.

        Raises:
            TouchError: A number is not positive.
        """
        return dataclasses.replace(
            usual,
            steps=usual.steps if self.steps is None else self.steps,
            batch_size=usual.batch_size if self.batch_size is None else self.batch_size,
        )

    def recipe(self) -> Recipe:
        """What CLTP minimises."""
        return Recipe(
            with_images=self.with_images,
            texts=self.texts,
            several=self.texts != "caption",
            prompt_weight=self.prompt_weight,
            head_weight=self.head_weight,
            moved=self.moved,
        )


def pretrain_clip(
    out: Path,
    data: Path,
    wish: Wish,
    *,
    seed: int = 0,
    report: ProgressReport = silent,
    workers: Workers | None = None,
) -> Path:
    """Align the small CLIP that every method shares; ``wish.steps`` is its own budget here.

    Raises:
        TouchError: Data or a checkpoint can't be used.
    """
    words = train_words(data, TouchLessons(), seed=seed)
    return train_clip(
        data,
        out,
        words,
        schedule=wish.schedule(CLIP_SCHEDULE),
        texts=wish.texts,
        several=wish.texts != "caption",
        prompt_weight=wish.prompt_weight,
        read_weight=wish.read_weight,
        seed=seed,
        report=report,
        workers=workers,
    )


def pretrain(
    method: str,
    out: Path,
    data: Path,
    wish: Wish,
    *,
    folder: Path | None = None,
    seed: int = 0,
    command: str,
    report: ProgressReport = silent,
    workers: Workers | None = None,
) -> Path:
    """Train one method behind the towers in ``out/clip``.

    Args:
        method: Out of ``METHODS``.
        out: Folder of all methods.
        data: A data set of contacts.
        wish: What the training is to be.
        folder: Of this method; ``method_folder`` when not given.
        seed: Of weights, order and noise.
        command: For ``about.json``.
        report: Told about progress.
        workers: The processes that train together.

    Returns:
        The method's folder.

    Raises:
        UsageError: An unknown method or preset.
        TouchError: Data, towers or a checkpoint can't be used.
    """
    if method not in METHODS:
        raise UsageError(f"unknown method {method!r}; known: {', '.join(METHODS)}")
    folder = folder or out / method
    schedule = wish.schedule(CLTP_SCHEDULE)
    clip = out / "clip"
    config = wish.config(method)
    if method in ("cltp", "cltp_no_image"):
        wish = dataclasses.replace(wish, with_images=wish.with_images and method == "cltp")
        train_cltp(
            data,
            folder,
            also=() if wish.also is None else (wish.also,),
            config=config,
            schedule=schedule,
            augmentation=LEARNING,
            recipe=wish.recipe(),
            clip_dir=clip,
            seed=seed,
            report=report,
            workers=workers,
        )
    else:
        train_baseline(
            method,
            data,
            folder,
            config=config,
            schedule=schedule,
            augmentation=LEARNING,
            clip_dir=clip,
            seed=seed,
            report=report,
            workers=workers,
        )
    if workers is None or workers.is_first:
        on = device_name((workers or Workers()).device)
        _write_about(folder, method, wish, schedule, data, seed, command, on)
    return folder


def device_name(device: torch.device) -> str:
    """What a device is called: ``cpu``, or the accelerator's name."""
    return torch.cuda.get_device_name(device) if device.type == "cuda" else device.type


def _write_about(
    folder: Path,
    method: str,
    wish: Wish,
    schedule: Schedule,
    data: Path,
    seed: int,
    command: str,
    device: str,
) -> None:
    """Say how an encoder came about; a training that was done before keeps its device."""
    aligned = method in ("cltp", "cltp_no_image")
    content = {
        "method": method,
        "preset": wish.preset_of(method),
        "steps": 0 if method == "random" else schedule.steps,
        "batch_size": schedule.batch_size,
        "recipe": asdict(wish.recipe()) if aligned else None,
        "data": ContactDataset(data).checksum(),
        "seed": seed,
        "device": device,
        "command": command,
    }
    if aligned and wish.also is not None:
        content["also"] = ContactDataset(wish.also).checksum()
    try:
        before = json.loads((folder / ABOUT).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        before = {}
    if {**before, "device": device, "command": command} == content and "device" in before:
        content["device"] = before["device"]
    write_atomically(folder / ABOUT, json.dumps(content, indent=2) + "\n")
