"""Train the weights of the language model: an encoder, CLIP, the projector and the model itself.

Composes ``sim``'s contacts, the encoder of ``tacgrasp.pretraining`` and ``cltp``'s training. Every
stage continues where it was stopped and is skipped when it is done, so that the same command can be
given again after any interruption.
"""

from __future__ import annotations

import hashlib
import json
import os
import platform
import time
from dataclasses import replace
from pathlib import Path

import torch
from rich.console import Console
from transformers.utils.logging import disable_progress_bar

from cltp.atomic_write import copy_files, copy_folder, new_folder, write_atomically
from cltp.checkpoints.base_lm import is_stock
from cltp.checkpoints.card import PARTS, facts_of, write_card
from cltp.checkpoints.manifest import manifest_digest, write_manifest
from cltp.checkpoints.tac3d_llm import load_clip, load_encoder, load_tac3d_llm, size_bytes
from cltp.data.dataset import ContactDataset
from cltp.evaluation.splits import LEARNING_NOISE
from cltp.texts.tokenizer import Words
from cltp.train.distributed import joined_workers
from cltp.train.llm import (
    FINE_TUNING,
    OWN_QUESTIONS,
    OWN_STEPS,
    QUESTIONS,
    train_llm,
    train_words,
)
from cltp.train.progress import Bar
from cltp.train.recipes import Schedule
from cltp.train.stage import TrainingRun
from cltp.train.stock.llm import load_base, train_stock_llm
from tacgrasp.base.errors import UsageError
from tacgrasp.datasets.generate import generate, is_complete
from tacgrasp.datasets.requests import GenerateRequest
from tacgrasp.datasets.trainable import check_trainable
from tacgrasp.lessons.exchanges import TouchLessons, known_words
from tacgrasp.policy_factory import named_weights
from tacgrasp.pretraining.checkpoints import find_method
from tacgrasp.pretraining.methods import ABOUT, pretrain, pretrain_clip, pretraining_run
from tacgrasp.training.other_encoder import take_other_encoder
from tacgrasp.training.requests import TrainAllRequest, TrainLlmRequest, also_fraction

PRETRAINED = "pretraining.json"
"""File beside the encoder: how it was pre-trained."""

DEFAULT_CONTACTS = 120_000
"""Contacts that are generated where no number is given: those of the set full."""

BLIND_MARK = Path(".training") / "blind"
"""File in the folder of an instruction-blind copy, so that nobody trains on in it by mistake."""


def train_all(request: TrainAllRequest, command: str) -> None:
    """Run the stages clip, cltp and llm one after another, as their own commands do.

    CLIP and CLTP are pre-trained in ``request.out / ".training" / "methods"``. ``command`` is the
    command line, for the model card.

    Raises:
        UsageError: ``request.out`` holds other weights.
        TouchError: Data, weights or a checkpoint can't be used.
    """
    out, data, seed, threads = request.out, request.data, request.seed, request.threads
    _require_mark(out, blind=False)
    contacts = _contacts(request)
    methods = out / ".training" / "methods"
    # Tells encoders apart (``take_pretrained``): folders and threads may change when it goes on.
    identity = f"tacgrasp train all --contacts {contacts} --seed {seed}"
    with pretraining_run(
        methods,
        data,
        seed=seed,
        command=identity,
        threads=threads,
        precision=request.precision,
    ) as run:
        pretrain_clip(run)
        pretrain("cltp", run)
    train_language_model(TrainLlmRequest(**vars(request), methods=methods), command)


def train_language_model(request: TrainLlmRequest, command: str) -> None:
    """Train the language model behind the encoder and CLIP in a folder, and write its card.

    Of an instruction-blind copy (the control of ``tacgrasp eval``), every instruction is hidden
    from the language model. ``command`` is the command line, for the model card.

    Raises:
        UsageError: ``request.out`` holds other weights.
        TouchError: Data, weights or a checkpoint can't be used.
    """
    out, data, seed = request.out, request.data, request.seed
    methods, blind_of = request.methods, request.blind_of
    start, encoder = named_weights(request.start), named_weights(request.encoder)
    language = named_weights(request.language)
    disable_progress_bar()  # of reading and writing weights, over in milliseconds
    began_s = time.monotonic()
    _check_parts(request)
    base = None if request.lm is None else load_base(request.lm, request.recipe, request.precision)
    before = _digest(out)
    if methods is not None:
        take_pretrained(methods, out)
    if blind_of is not None:
        take_encoder(blind_of, out)
    _require_mark(out, blind=blind_of is not None)
    Console(soft_wrap=True).print(f"llm: writing {out}", markup=False, highlight=False)
    contacts = _contacts(request)
    for learned in filter(None, (data, request.also)):
        check_trainable(ContactDataset(learned))
    torch.set_num_threads(request.threads or os.cpu_count() or 1)
    lessons = TouchLessons(blind=blind_of is not None)
    noise = replace(LEARNING_NOISE, coarse=request.coarse)
    with Bar() as report:
        workers = joined_workers(request.precision)
        run = TrainingRun(
            data=data,
            out=out,
            seed=seed,
            report=report,
            workers=workers,
            also=() if request.also is None else (request.also,),
            also_fraction=also_fraction(request.also, request.also_fraction, start),
        )
        if encoder is not None:
            take_other_encoder(encoder, run, request.heads_steps)
        if base is not None:
            train_stock_llm(run, *base, lessons, request.recipe, augmentation=noise)
        else:
            words = _words(request, start or language)
            train_llm(
                run,
                words,
                lessons,
                None if start is None else _tuning(request),
                augmentation=noise,
                start=start,
                language=language,
                questions=QUESTIONS if request.also is None else OWN_QUESTIONS,
            )
    if _digest(out) == before or not workers.is_first:
        return  # nothing was left to do: the card with its scores still holds
    facts = {
        "command": f"`{command}`",
        "seed": str(seed),
        "contacts": str(contacts),
        "data checksum": ContactDataset(data).checksum(),
        **_about_also(request),
        **_about_begun(start or language),
        "torch": torch.__version__,
        "python": platform.python_version(),
        "last run took": f"{(time.monotonic() - began_s) / 60:.0f} min",
        "size": f"{sum(size_bytes(out / name) for name in PARTS) / 1e6:.1f} MB",
    }
    if (out / "encoder" / PRETRAINED).exists():
        about = json.loads((out / "encoder" / PRETRAINED).read_text(encoding="utf-8"))
        checksums = " and ".join(about[key] for key in ("data", "also") if key in about)
        facts["encoder and clip"] = (
            f"`{about['command']}`: {about['preset']}, {about['steps']} steps of "
            f"{about['batch_size']}, data checksum {checksums}"
        )
    write_card(out, facts)


def _check_parts(request: TrainLlmRequest) -> None:
    """Look at what the training begins with, before missing data are generated for it.

    Raises:
        UsageError: There is no encoder to train behind, or ``start`` is named in the wrong way.
        TouchError: Weights to begin with are missing or damaged.
    """
    start = named_weights(request.start)
    if start is not None and is_stock(start / "lm"):
        raise UsageError(
            f"--start {start} was trained behind a language model of others; name that one "
            "with --lm instead"
        )
    sources = (request.methods, request.encoder, request.blind_of)
    if not any(sources) and not (request.out / "encoder").exists():
        raise UsageError(
            f"{request.out} has no encoder to train behind; take one by --encoder shipped"
        )
    if (begun := start or named_weights(request.language)) is not None:
        load_tac3d_llm(begun)


def _tuning(request: TrainLlmRequest) -> dict[str, Schedule]:
    """The stages of a training that starts from other weights."""
    joint, steps = FINE_TUNING["joint"], request.joint_steps
    if steps is None:
        steps = joint.steps if request.also is None else OWN_STEPS
    return {"joint": replace(joint, steps=steps)}


def _contacts(request: TrainAllRequest) -> int:
    """Make the data where they are missing; the number of their contacts.

    A complete data set is taken as it is where no number was asked for.

    Raises:
        UsageError: The folder holds the data of another command.
        TouchError: It is no data set of this version, or can't be written.
    """
    data, contacts = request.data, request.contacts
    if contacts is None and (data / "dataset.json").exists() and is_complete(data):
        return len(ContactDataset(data))
    contacts = DEFAULT_CONTACTS if contacts is None else contacts
    generate(GenerateRequest(out=data, set="full", contacts=contacts, seed=request.seed))
    return contacts


def _about_also(request: TrainLlmRequest) -> dict[str, str]:
    """What the model card says of a further data set."""
    if request.also is None:
        return {}
    data = ContactDataset(request.also)
    return {"also learned from": f"{len(data)} contacts, data checksum {data.checksum()}"}


def _about_begun(begun: Path | None) -> dict[str, str]:
    """What the model card says of the weights that the training began with."""
    if begun is None:
        return {}
    facts = facts_of(begun)
    parts = [facts[name] for name in ("command", "encoder and clip", "began with") if name in facts]
    return {"began with": "; ".join(parts) or begun.name}


def _words(request: TrainLlmRequest, begun: Path | None) -> Words:
    """The tokenizer of our own model, which may have begun elsewhere."""
    if begun is not None:
        return Words.load(begun / "lm")
    # the same data and seed give the same words
    return train_words(request.data, TouchLessons(), seed=request.seed, whole=known_words())


def _require_mark(out: Path, *, blind: bool) -> None:
    if (out / BLIND_MARK).exists() != blind:
        raise UsageError(
            f"{out} holds {'no ' if blind else 'an '}instruction-blind copy; "
            "choose another folder with --out"
        )


def take_pretrained(methods: Path, out: Path) -> None:
    """Begin a folder of weights with CLTP and its CLIP from a folder of methods.

    Args:
        methods: Folder that ``tacgrasp train clip`` and ``tacgrasp train cltp`` wrote.
        out: Folder of weights; nothing is copied over an encoder of the same training.

    Raises:
        UsageError: CLTP was not trained there, or ``out`` holds another encoder.
        TouchError: The encoder can't be read, or takes points that sensors don't give.
        OSError: A file can't be written.
    """
    trained = find_method("cltp", methods)
    about = (trained.folder / ABOUT).read_text(encoding="utf-8")
    stored = out / "encoder" / PRETRAINED
    if stored.exists() and stored.read_text(encoding="utf-8") == about:
        return
    clip = methods / "clip"
    load_encoder(trained.folder / "encoder")
    load_clip(clip)
    has_clip = (out / "clip").exists()  # where the copying was stopped after it
    if (out / "encoder").exists() or (
        has_clip and manifest_digest(out / "clip") != manifest_digest(clip)
    ):
        raise UsageError(f"{out} holds another encoder; choose another folder with --out")
    if not has_clip:
        copy_folder(clip, out / "clip")
    with new_folder(out / "encoder") as part:
        copy_files(trained.folder / "encoder", part)
        write_atomically(part / PRETRAINED, about)
        write_manifest(part)


def take_encoder(source: Path, out: Path) -> None:
    """Begin a folder for an instruction-blind copy behind the encoder of other weights.

    Raises:
        UsageError: ``out`` holds weights that are no blind copy.
        TouchError: The encoder can't be read.
        OSError: A file can't be written.
    """
    if (out / "clip").exists() or ((out / "lm").exists() and not (out / BLIND_MARK).exists()):
        raise UsageError(f"{out} holds weights that see; give the blind copy a folder of its own")
    load_encoder(source / "encoder")
    (out / BLIND_MARK).parent.mkdir(parents=True, exist_ok=True)
    (out / BLIND_MARK).touch()
    if not (out / "encoder").exists():
        copy_folder(source / "encoder", out / "encoder")


def _digest(out: Path) -> str:
    """Changes when any file of the weights does."""
    total = hashlib.sha256()
    for path in sorted(path for name in PARTS for path in (out / name).rglob("*")):
        if path.is_file():
            total.update(str(path.relative_to(out)).encode() + path.read_bytes())
    return total.hexdigest()
