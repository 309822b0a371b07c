"""From nothing to weights: contacts, tokenizer, CLIP, CLTP and Tac3D-LLM, each stage resumable.

Composes what ``sim`` makes and ``cltp`` learns. Every stage goes on where it was stopped and is
skipped when it is done, so that the same command can be given again after anything.
"""

from __future__ import annotations

import hashlib
import json
import os
import platform
import shutil
import time
from collections.abc import Sequence
from pathlib import Path

import torch
from transformers.utils.logging import disable_progress_bar

from cltp.atomic_write import write_atomically
from cltp.checkpoints.tac3d_llm import (
    load_clip,
    load_encoder,
    load_touching_encoder,
    size_bytes,
    write_card,
)
from cltp.data.dataset import ContactDataset
from cltp.texts.tokenizer import Words
from cltp.train.alignment import train_cltp
from cltp.train.clip import train_clip
from cltp.train.llm import train_llm, train_words
from cltp.train.progress import Bar
from tacgrasp.base.errors import UsageError
from tacgrasp.datasets.generate import generate
from tacgrasp.lessons.exchanges import TouchLessons
from tacgrasp.pretraining.checkpoints import stored
from tacgrasp.pretraining.methods import ABOUT

STAGES = ("clip", "cltp", "llm")
CONTACTS = 24_000
PARTS = ("clip", "encoder", "projector", "lm")
PRETRAINED = "pretraining.json"
"""Beside the encoder: how it came about, where ``take_pretrained`` took it."""

BLIND_MARK = Path(".training") / "blind"
"""Lies in the folder of an instruction-blind copy, so that nobody trains on in it by mistake."""


def train(
    stages: Sequence[str],
    *,
    out: Path,
    data: Path,
    contacts: int = CONTACTS,
    seed: int = 0,
    blind: bool = False,
    threads: int | None = None,
    command: str = "tacgrasp train all",
) -> None:
    """Carry out stages in their order; what is missing of the data is made first.

    Args:
        stages: Out of ``STAGES``.
        out: Folder of weights; checkpoints lie in its ``.training``.
        data: Folder of contacts.
        contacts: How many of them.
        seed: Of data, weights, order, noise and wordings.
        blind: Hides every instruction from the language model (the control of ``tacgrasp eval``).
        threads: Of torch; by default one for each core.
        command: For the model card.

    Raises:
        UsageError: An unknown stage, or a folder that holds a blind copy where none is asked for.
        TouchError: Data, weights or a checkpoint can't be used; the message says what to do.
    """
    unknown = [stage for stage in stages if stage not in STAGES]
    if unknown or not stages:
        raise UsageError(f"unknown stage {', '.join(unknown)!r}; known: {', '.join(STAGES)}, all")
    if (out / BLIND_MARK).exists() != blind:
        raise UsageError(
            f"{out} holds {'no ' if blind else 'an '}instruction-blind copy; "
            "choose another folder with --out"
        )
    disable_progress_bar()  # of reading and writing weights, over in milliseconds
    began = time.monotonic()
    before = _digest(out)
    generate(data, contacts=contacts, seed=seed)
    torch.set_num_threads(threads or os.cpu_count() or 1)
    lessons = TouchLessons(blind=blind)
    words = _words(data, seed)
    with Bar() as report:
        if "clip" in stages:
            train_clip(data, out, words, seed=seed, report=report)
        if "cltp" in stages:
            train_cltp(data, out, seed=seed, report=report)
        if "llm" in stages:
            train_llm(data, out, words, lessons, seed=seed, report=report)
    if _digest(out) == before:
        return  # all was done: the card with its scores still holds
    facts = {
        "command": f"`{command} --contacts {contacts} --seed {seed}`",
        "seed": str(seed),
        "contacts": str(contacts),
        "data checksum": _data_checksum(data),
        "torch": torch.__version__,
        "python": platform.python_version(),
        "last run took": f"{(time.monotonic() - began) / 60:.0f} min",
        "size": f"{_bytes(out) / 1e6:.1f} MB",
    }
    if (out / "encoder" / PRETRAINED).exists():
        about = json.loads((out / "encoder" / PRETRAINED).read_text(encoding="utf-8"))
        learned = " and ".join(about[key] for key in ("data", "also") if key in about)
        facts["encoder and clip"] = (
            f"`{about['command']}`: {about['preset']}, {about['steps']} steps of "
            f"{about['batch_size']}, data checksum {learned}"
        )
    write_card(out, facts, {})


def take_pretrained(methods: Path, out: Path) -> None:
    """Begin a folder of weights with CLTP and its CLIP from a folder of methods.

    Args:
        methods: What ``tacgrasp train clip`` and ``tacgrasp train cltp`` wrote with a budget.
        out: Folder of weights; nothing is taken where an encoder of the same training is there.

    Raises:
        UsageError: CLTP was not trained there, or ``out`` holds another encoder.
        TouchError: The encoder can't be read, or takes points that sensors don't give.
    """
    found = stored("cltp", methods)
    about = (found.folder / ABOUT).read_text(encoding="utf-8")
    kept = out / "encoder" / PRETRAINED
    if kept.exists() and kept.read_text(encoding="utf-8") == about:
        return
    beside = out / "encoder.part"  # there while this is under way, or was interrupted
    if (out / "encoder").exists() or ((out / "clip").exists() and not beside.exists()):
        raise UsageError(f"{out} holds another encoder; choose another folder with --out")
    load_touching_encoder(found.folder / "encoder")
    load_clip(methods / "clip")
    for part in (beside, out / "clip"):
        shutil.rmtree(part, ignore_errors=True)
    shutil.copytree(found.folder / "encoder", beside)
    shutil.copytree(methods / "clip", out / "clip")
    write_atomically(beside / PRETRAINED, about)
    beside.rename(out / "encoder")


def take_encoder(source: Path, out: Path) -> None:
    """Begin a folder for an instruction-blind copy behind the encoder of other weights.

    Raises:
        UsageError: ``out`` holds weights that are no blind copy.
        TouchError: The encoder can't be read.
    """
    if (out / "clip").exists() or ((out / "lm").exists() and not (out / BLIND_MARK).exists()):
        raise UsageError(f"{out} holds weights that see; give the blind copy a folder of its own")
    load_encoder(source / "encoder")
    (out / BLIND_MARK).parent.mkdir(parents=True, exist_ok=True)
    (out / BLIND_MARK).touch()
    if not (out / "encoder").exists():
        shutil.copytree(source / "encoder", out / "encoder")


def _words(data: Path, seed: int) -> Words:
    """The tokenizer, learnt anew in seconds: the same data and seed give the same one."""
    return train_words(data, TouchLessons(), seed=seed)


def _data_checksum(data: Path) -> str:
    return ContactDataset(data).checksum()


def _bytes(out: Path) -> int:
    """Bytes of the weights, without checkpoints."""
    return sum(size_bytes(out / name) for name in PARTS)


def _digest(out: Path) -> str:
    """Changes when any file of the weights does."""
    total = hashlib.sha256()
    for path in sorted(path for name in PARTS for path in (out / name).rglob("*")):
        if path.is_file():
            total.update(str(path.relative_to(out)).encode() + path.read_bytes())
    return total.hexdigest()
