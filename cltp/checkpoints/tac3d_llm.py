"""The weights of Tac3D-LLM on disk: a folder for each part, in the ``save_pretrained`` layout.

    weights/
      README.md         model card (``cltp.checkpoints.card``)
      encoder/          config.json, model.safetensors        E_T with its state heads
      clip/             transformers' CLIP with its tokenizer
      projector/        config.json, model.safetensors
      lm/               transformers' Seed-OSS, which is a Qwen2, with its tokenizer; or what
                        was trained of one that others made (``cltp.checkpoints.base_lm``)

and in each of the four a manifest.json (``cltp.checkpoints.manifest``), checked before it is read.
Every config.json names its ``model_type`` and ``architectures``. A tokenizer is the three files of
``cltp.texts.tokenizer``. Numbers are stored in 16 bits and computed in 32. Loading is strict: every
weight must be there, of the right shape, and no other; the projector names the tokenizer that it
was trained with.

Not here: the types of encoder and projector (``cltp.checkpoints.parts``).
"""

from __future__ import annotations

import errno
import os
import shutil
from pathlib import Path
from typing import Any

import torch
from safetensors import SafetensorError

from cltp.checkpoints.base_lm import PARTNERS, BaseLm, is_stock, write_stock_lm
from cltp.checkpoints.manifest import (
    WeightsError,
    check_manifest,
    check_partners,
    write_manifest,
)
from cltp.checkpoints.parts import ProjectorConfig, StoredEncoder, StoredProjector
from cltp.checkpoints.weight_files import check_sizes, require_files
from cltp.encoder.clip_towers import Towers, load_towers
from cltp.encoder.encoder import TactileEncoder
from cltp.encoder.heads import StateHeads
from cltp.llm.adapter import merged
from cltp.llm.causal_lm import Language, load_language
from cltp.llm.stored_lm import SMALL_LM_SETTINGS, load_stored_lm, write_seed_oss_config
from cltp.llm.tac3d_llm import Tac3dLlm
from cltp.texts.tokenizer import Words


def save_encoder(folder: Path, encoder: TactileEncoder, heads: StateHeads) -> None:
    """Write E_T with the heads that read states from it."""
    StoredEncoder(encoder, heads).save_pretrained(folder)


def load_encoder(folder: Path) -> tuple[TactileEncoder, StateHeads]:
    """Read what ``save_encoder`` wrote.

    Raises:
        WeightsError: Missing, damaged, of another kind or shape.
    """
    stored = StoredEncoder.from_pretrained(folder)
    return stored.encoder, stored.heads


def load_clip(folder: Path) -> Towers:
    """Read towers, frozen.

    Raises:
        TouchError: As ``cltp.encoder.clip_towers.load_towers``; or it is one of ours, by its
            tokenizer, without a manifest.
    """
    require_files(folder, command=f"tacgrasp train clip --out {folder.parent}")
    check_manifest(folder, required=False)
    check_sizes(folder)
    towers = load_towers(folder)
    if isinstance(towers.words, Words):
        check_manifest(folder)
    return towers


def save_tac3d_llm(folder: Path, model: Tac3dLlm) -> None:
    """Write projector and language model into ``folder``, beside their encoder.

    Raises:
        WeightsError: ``save_encoder`` has not written the encoder, or the language model is another
            program's.
    """
    words = model.language.words
    if words is None:
        raise WeightsError("a stock checkpoint is written with its base; use save_stock_llm")
    save_pretrained(folder / "lm", model.lm, words)
    stored = StoredProjector(model.projector, words.fingerprint())
    stored.save_pretrained(folder / "projector", trained_with=PARTNERS)


def save_stock_llm(folder: Path, model: Tac3dLlm, base: BaseLm, adapter: Any = None) -> None:
    """Write projector and what was trained of a stock language model, beside their encoder.

    Args:
        folder: Folder of the weights.
        model: The model.
        base: The language model that it was trained behind.
        adapter: peft's model around it, where an adapter was trained.

    Raises:
        WeightsError: ``save_encoder`` has not written the encoder.
    """
    language = model.language
    write_stock_lm(folder / "lm", base, language.lm, language.tokens, adapter)
    stored = StoredProjector(model.projector, language.tokens.fingerprint())
    stored.save_pretrained(folder / "projector", trained_with=PARTNERS)


def load_stock_llm(weights: Path) -> Language:
    """Read the language model of weights that were trained behind one that others made.

    It is read for decoding, onto an accelerator in bfloat16 where there is one, else in 32 bits.

    Raises:
        TouchError: Base, adapter or weights are missing, damaged, or of another training; or peft
            is not installed.
    """
    folder = weights / "lm"
    check_manifest(folder)
    base = BaseLm.read(folder)
    if base.tune != "all":
        base.check(weights)
    source = folder if base.tune == "all" else Path(base.path)
    check_sizes(source)
    has_gpu = torch.cuda.is_available()
    language = load_language(source, torch.bfloat16 if has_gpu else torch.float32)
    if base.tune == "lora":
        language.lm = merged(language.lm, folder).eval()
    language.lm = language.lm.requires_grad_(False).to("cuda" if has_gpu else "cpu")
    return language


def load_tac3d_llm(folder: Path, *, lm_folder: Path | None = None) -> Tac3dLlm:
    """Read a whole Tac3D-LLM.

    Args:
        folder: Folder with ``encoder``, ``projector`` and ``lm``, which is read for decoding alone.
        lm_folder: Another language model in transformers' layout, behind the same projector.

    Raises:
        WeightsError: A part is missing, damaged, or belongs to other weights.
        TouchError: The language model can't be read.
    """
    encoder, heads = load_encoder(folder / "encoder")
    config = ProjectorConfig.read(folder / "projector")
    if lm_folder is None and is_stock(folder / "lm"):
        language = load_stock_llm(folder)
    elif lm_folder is None:
        require_files(folder / "lm")
        check_manifest(folder / "lm")
        language = Language(load_stored_lm(folder / "lm"), words=Words.load(folder / "lm"))
    else:
        check_manifest(lm_folder, required=False)
        check_sizes(lm_folder)
        language = load_language(lm_folder)
    if language.tokens.fingerprint() != config.tokenizer_sha256:
        raise WeightsError(
            f"the tokenizer in {folder / 'lm'} is not the one that {folder / 'projector'} was "
            "trained with; take both from one training"
        )
    sizes = (config.encoder_dim, config.lm_dim)
    if sizes != (encoder.config.dim, language.dim):
        raise WeightsError(
            f"the projector in {folder} joins widths {sizes}, encoder and language model have "
            f"{(encoder.config.dim, language.dim)}"
        )
    if lm_folder is None:
        check_partners(folder / "projector")
    projector = StoredProjector.from_pretrained(folder / "projector").projector
    return Tac3dLlm(encoder, heads, projector, language).eval()


def size_bytes(folder: Path) -> int:
    """Bytes of everything in a folder of weights."""
    return sum(path.stat().st_size for path in Path(folder).rglob("*") if path.is_file())


def save_pretrained(folder: Path, model: Any, words: Words) -> None:
    """Write a CLIP or a language model in transformers' layout, beside its tokenizer."""
    part = folder.with_name(f"{folder.name}.{os.getpid()}.part")
    state = {name: value.clone() for name, value in model.state_dict().items()}
    try:
        model.half().save_pretrained(part)
        if model.config.model_type in SMALL_LM_SETTINGS:
            write_seed_oss_config(part)
        words.save(part)
        write_manifest(part)
    except SafetensorError as error:  # how its writer tells of a full disk
        raise OSError(errno.EIO, f"weights can't be written ({error})", str(part)) from None
    finally:
        model.float().load_state_dict(state)
    shutil.rmtree(folder, ignore_errors=True)
    part.replace(folder)
