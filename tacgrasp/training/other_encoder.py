"""Begin a folder of weights with the encoder of other weights, or of any pre-training method.

An encoder that was pre-trained without state heads, as Point-MAE's, is frozen, and heads are fitted
on it: the language model is given their readings. So Tac3D-LLM, PointBERT-LLM and PointMAE-LLM
differ in the encoder alone.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

from cltp.atomic_write import copy_files, copy_folder, new_folder, write_atomically
from cltp.checkpoints.frozen import FORMAT, load_frozen
from cltp.checkpoints.manifest import manifest_digest, write_manifest
from cltp.checkpoints.tac3d_llm import load_encoder, save_encoder
from cltp.checkpoints.weight_files import CONFIG, read_config
from cltp.evaluation.splits import LEARNING_NOISE
from cltp.train.alignment import train_heads
from cltp.train.methods import METHODS
from cltp.train.recipes import HEADS_SCHEDULE
from cltp.train.stage import TrainingRun
from tacgrasp.base.errors import UsageError
from tacgrasp.pretraining.methods import ABOUT

SOURCE = "source.json"
"""File beside an encoder that was taken from elsewhere: its method, and its manifest's SHA-256."""


def take_other_encoder(source: Path, run: TrainingRun, heads_steps: int) -> None:
    """Copy an encoder into ``run.out``, with heads; a second time changes nothing.

    Args:
        source: Folder with ``encoder`` in it, of weights or of one method.
        run: Folder of weights, data for the heads, seed, progress and processes.
        heads_steps: Optimiser steps of heads that have to be fitted.

    Raises:
        UsageError: The folder holds another encoder already, or the encoder sees images.
        TouchError: The encoder can't be read.
        OSError: A file can't be written.
    """
    out = run.out
    origin = manifest_digest(source / "encoder")
    if (out / "encoder").exists():
        if taken_from(out).get("manifest") != origin:
            raise UsageError(f"{out} holds another encoder; choose another folder with --out")
        return
    config = read_config(source / "encoder" / CONFIG)
    trained = read_config(source / ABOUT) if (source / ABOUT).is_file() else {}
    method = str(trained.get("method", config.get("method", "cltp")))
    about: dict[str, object] = {"manifest": origin, "method": method}
    write: Callable[[Path], None]
    if config.get("format") != FORMAT:
        load_encoder(source / "encoder")
        write = partial(copy_files, source / "encoder")
    else:
        frozen = load_frozen(source / "encoder")
        if frozen.sees_images:
            raise UsageError(
                f"{source} has an encoder of pictures; a language model is trained behind one of "
                f"points, as {METHODS['point_mae'].title}"
            )
        schedule = replace(HEADS_SCHEDULE, steps=heads_steps)
        heads = train_heads(run, frozen.encoder, schedule, LEARNING_NOISE)
        about["heads"] = f"fitted in {schedule.steps} steps of {schedule.batch_size}"
        write = partial(save_encoder, encoder=frozen.encoder, heads=heads)
    if run.workers.is_first:
        if (source / "clip").is_dir() and not (out / "clip").exists():
            copy_folder(source / "clip", out / "clip")
        with new_folder(out / "encoder") as part:
            write(part)
            write_atomically(part / SOURCE, json.dumps(about, indent=2) + "\n")
            write_manifest(part)
    run.workers.wait()


def taken_from(weights: Path) -> dict[str, object]:
    """Where the encoder of some weights was taken from; empty where it was trained with them."""
    path = weights / "encoder" / SOURCE
    return read_config(path) if path.is_file() else {}


def method_of(weights: Path) -> str:
    """The method that pre-trained the encoder of some weights; CLTP where nothing else is said."""
    return str(taken_from(weights).get("method", "cltp"))
