"""The weights of Tac3D-LLM on disk: a folder for each part, in the ``save_pretrained`` layout.

    weights/
      README.md         model card: command, seed, checksum of the data, measured scores
      encoder/          config.json, model.safetensors        E_T with its state heads
      clip/             transformers' CLIP with tokenizer.json
      projector/        config.json, model.safetensors
      lm/               transformers' Qwen2 with tokenizer.json

and in each of the four a manifest.json (``cltp.checkpoints.manifest``), checked before it is read.
Numbers are stored in 16 bits and computed in 32. Loading is strict: every weight must be there, of
the right shape, and no other; the projector names the tokenizer that it was trained with.
"""

from __future__ import annotations

import dataclasses
import errno
import os
import shutil
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from safetensors import SafetensorError
from torch import nn

from cltp.atomic_write import write_atomically
from cltp.checkpoints.manifest import (
    WeightsError,
    check_manifest,
    check_partners,
    write_manifest,
)
from cltp.checkpoints.weight_files import (
    CONFIG,
    WEIGHTS,
    check_sizes,
    load_weights,
    read_config,
    save_weights,
)
from cltp.encoder.clip_towers import Towers, load_towers
from cltp.encoder.encoder import EncoderConfig, TactileEncoder
from cltp.encoder.heads import StateHeads
from cltp.errors import TouchError
from cltp.llm.causal_lm import Language, load_language
from cltp.llm.stored_lm import load_stored_lm
from cltp.llm.tac3d_llm import Projector, Tac3dLlm
from cltp.tactile.point_layout import EVEN
from cltp.texts.tokenizer import Words

VERSION = 1
PROJECTOR_VERSION = 2
"""2: the heads' readings follow the tokens."""


class _EncoderWithHeads(nn.Module):
    def __init__(self, encoder: TactileEncoder, heads: StateHeads) -> None:
        super().__init__()
        self.encoder, self.heads = encoder, heads


def save_encoder(folder: Path, encoder: TactileEncoder, heads: StateHeads) -> None:
    """Write E_T with the heads that read states from it."""
    config = {"version": VERSION, "encoder": dataclasses.asdict(encoder.config)}
    _save(folder, config, _EncoderWithHeads(encoder, heads))


def load_encoder(folder: Path) -> tuple[TactileEncoder, StateHeads]:
    """Read what ``save_encoder`` wrote.

    Raises:
        WeightsError: Missing, damaged, or of another shape.
    """
    config = _config(folder)
    check_room(folder, config)
    encoder = random_encoder(folder, config)
    heads = StateHeads(2 * encoder.config.dim)
    load_weights(folder, _EncoderWithHeads(encoder, heads))
    return encoder, heads


def random_encoder(folder: Path, config: Mapping[str, Any]) -> TactileEncoder:
    """The encoder that a folder's configuration describes, with random weights.

    Raises:
        WeightsError: It describes none.
    """
    try:
        return TactileEncoder(EncoderConfig(**config["encoder"]))
    except (KeyError, TypeError, ArithmeticError, RuntimeError, TouchError) as error:
        raise WeightsError(f"{folder}/{CONFIG} describes no encoder: {error}") from error


def check_room(folder: Path, config: Mapping[str, Any]) -> None:
    """Refuse a configuration of more weights than the file beside it can hold, before any is made.

    Raises:
        WeightsError: The layers alone need more bytes in 16 bits than the file has.
    """
    sizes = config.get("encoder")
    sizes = sizes if isinstance(sizes, dict) else {}
    dim, depth = sizes.get("dim", 0), sizes.get("depth", 0)
    if not all(isinstance(size, int) for size in (dim, depth)):
        return  # no sizes at all: the encoder's own check says so
    needed, held = 24 * dim * dim * depth, (folder / WEIGHTS).stat().st_size
    if needed > held:
        raise WeightsError(
            f"{folder}/{CONFIG} describes an encoder of {depth} layers of width {dim}, at least "
            f"{needed} bytes; {WEIGHTS} has {held}: they don't belong together"
        )


def load_touching_encoder(folder: Path) -> tuple[TactileEncoder, StateHeads]:
    """As ``load_encoder``, for an encoder that can take the clouds of sensors.

    Raises:
        WeightsError: As there, or the encoder takes points that lie otherwise.
    """
    encoder, heads = load_encoder(folder)
    if encoder.config.variant.sampling != EVEN:
        raise WeightsError(
            f"the encoder in {folder} takes points as {encoder.config.tokenizer!r} lays them out; "
            "clouds of sensors have 1024, evenly: train one with another preset"
        )
    return encoder, heads


def load_clip(folder: Path) -> Towers:
    """Read towers, frozen.

    Raises:
        TouchError: As ``cltp.encoder.clip_towers.load_towers``; or it is one of ours, by its
            tokenizer, without a manifest.
    """
    _require_files(folder)
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
        raise WeightsError("a stock checkpoint is used from its own directory and not written")
    config = {
        "version": PROJECTOR_VERSION,
        "encoder_dim": model.projector.encoder_dim,
        "lm_dim": model.projector.lm_dim,
        "tokenizer_sha256": words.fingerprint(),
    }
    save_pretrained(folder / "lm", model.lm, words)
    _save(folder / "projector", config, model.projector, trained_with=("encoder", "lm"))


def load_tac3d_llm(folder: Path, *, lm_folder: Path | None = None) -> Tac3dLlm:
    """Read a whole Tac3D-LLM.

    Args:
        folder: Folder with ``encoder``, ``projector`` and ``lm``, which is read for decoding alone.
        lm_folder: Another language model in transformers' layout, behind the same projector.

    Raises:
        WeightsError: A part is missing, damaged, or belongs to other weights, or the encoder takes
            points that sensors don't give.
        TouchError: The language model can't be read.
    """
    encoder, heads = load_touching_encoder(folder / "encoder")
    config = _config(folder / "projector", PROJECTOR_VERSION)
    if lm_folder is None:
        _require_files(folder / "lm")
        check_manifest(folder / "lm")
        language = Language(load_stored_lm(folder / "lm"), words=Words.load(folder / "lm"))
    else:
        check_manifest(lm_folder, required=False)
        check_sizes(lm_folder)
        language = load_language(lm_folder)
    words = language.words
    if words is not None and words.fingerprint() != config.get("tokenizer_sha256"):
        raise WeightsError(
            f"the tokenizer in {folder / 'lm'} is not the one that {folder / 'projector'} was "
            "trained with; take both from one training"
        )
    sizes = (config.get("encoder_dim"), config.get("lm_dim"))
    if sizes != (encoder.config.dim, language.dim):
        raise WeightsError(
            f"the projector in {folder} joins widths {sizes}, encoder and language model have "
            f"{(encoder.config.dim, language.dim)}"
        )
    if lm_folder is None:
        check_partners(folder / "projector")
    projector = Projector(encoder.config.dim, language.dim)
    load_weights(folder / "projector", projector)
    return Tac3dLlm(encoder, heads, projector, language).eval()


def size_bytes(folder: Path) -> int:
    """Bytes of everything in a folder of weights."""
    return sum(path.stat().st_size for path in Path(folder).rglob("*") if path.is_file())


def write_card(folder: Path, facts: Mapping[str, str]) -> None:
    """Write the model card, with an empty table of scores.

    Args:
        folder: Folder of the weights.
        facts: Command, seed, checksum of the data, versions, duration.
    """
    lines = ["# Tac3D-LLM, small", "", "| | |", "|---|---|"]
    lines += [f"| {name} | {value} |" for name, value in facts.items()]
    lines += ["", "## Scores", "", "| | |", "|---|---|"]
    Path(folder).mkdir(parents=True, exist_ok=True)
    write_atomically(Path(folder) / "README.md", "\n".join(lines) + "\n")


def _save(
    folder: Path, config: Mapping[str, Any], module: nn.Module, trained_with: Iterable[str] = ()
) -> None:
    state = module.state_dict()
    halved = {name: v.half() if v.is_floating_point() else v for name, v in state.items()}
    save_weights(folder, config, halved, trained_with=trained_with)


def save_pretrained(folder: Path, model: Any, words: Words) -> None:
    """Write a model in transformers' layout, beside its tokenizer."""
    part = folder.with_name(f"{folder.name}.{os.getpid()}.part")
    state = {name: value.clone() for name, value in model.state_dict().items()}
    try:
        model.half().save_pretrained(part)
        words.save(part)
        write_manifest(part)
    except SafetensorError as error:  # how its writer tells of a full disk
        raise OSError(errno.EIO, f"weights can't be written ({error})", str(part)) from None
    finally:
        model.float().load_state_dict(state)
    shutil.rmtree(folder, ignore_errors=True)
    part.replace(folder)


def _require_files(folder: Path) -> None:
    for name in (CONFIG, WEIGHTS):
        if not (Path(folder) / name).is_file():
            raise WeightsError(
                f"weights are missing: {Path(folder) / name} does not exist; "
                "train them with `tacgrasp train all` or name the right folder"
            )


def _config(folder: Path, version: int = VERSION) -> dict[str, Any]:
    _require_files(folder)
    check_manifest(folder)
    config = read_config(Path(folder) / CONFIG)
    if config.get("version") != version:
        raise WeightsError(f"{folder} holds weights of another version than {version}; train again")
    return config
