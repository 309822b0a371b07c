"""The language model that others trained, behind which a Tac3D-LLM was: where it lies, and which.

``lm/`` of such weights has a file ``base.json`` that names the folder of the base, its type and its
fingerprint, and how it was tuned:

    projector   nothing else: the base is used as it is
    lora        peft's adapter_config.json and adapter_model.safetensors, in peft's own layout
    all         the whole model with its tokenizer, in transformers' layout; no base is needed

and a manifest, as every part. A base has gigabytes, and its makers no manifest: its fingerprint is
taken of configuration, tokenizer and samples of the weights. It tells other models and other
trainings apart; it does not find every flipped byte.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, Literal, TypeAlias

from cltp.atomic_write import write_atomically
from cltp.checkpoints.manifest import (
    WeightsError,
    check_manifest,
    check_partners,
    write_manifest,
)
from cltp.checkpoints.weight_files import CONFIG, check_sizes, read_config
from cltp.errors import TouchError
from cltp.texts.stock_tokenizer import TOKENIZER_FILES

BASE_FILE = "base.json"
FORMAT = "tacgrasp_base_lm"
VERSION = 1

Tuning: TypeAlias = Literal["lora", "all", "projector"]
TUNINGS = ("lora", "all", "projector")

PARTNERS = ("encoder", "lm")
"""The parts that a projector is good for alone."""

_SAMPLES, _SAMPLE_BYTES = 64, 65_536
_ONE_FILE = "1TB"
"""Largest size of a file of weights: all of them in one, as everywhere in a folder of weights."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BaseLm:
    """The language model that a Tac3D-LLM was trained behind.

    Attributes:
        path: Its folder, absolute.
        model_type: Its type in transformers.
        fingerprint: SHA-256 of configuration, tokenizer and samples of the weights.
        tune: What of it was trained.
    """

    path: str
    model_type: str
    fingerprint: str
    tune: Tuning

    @classmethod
    def of(cls, folder: Path, tune: Tuning) -> BaseLm:
        """Describe a base.

        Raises:
            WeightsError: It is missing, or has no configuration or weights.
        """
        folder = folder.resolve()
        if not folder.is_dir():
            raise WeightsError(
                f"no language model in {folder}: it is not a directory; name one that "
                "transformers' save_pretrained wrote"
            )
        config = read_config(folder / CONFIG)
        check_sizes(folder)
        return cls(
            path=str(folder),
            model_type=str(config.get("model_type")),
            fingerprint=_fingerprint(folder),
            tune=tune,
        )

    @classmethod
    def read(cls, lm_folder: Path) -> BaseLm:
        """Read what ``lm/`` says of its base.

        Raises:
            WeightsError: It is damaged, or of another version.
        """
        path = lm_folder / BASE_FILE
        content = read_config(path)
        about = {name: content.get(name) for name in ("path", "model_type", "fingerprint", "tune")}
        is_known = (content.get("format"), content.get("version")) == (FORMAT, VERSION)
        texts = all(isinstance(value, str) for value in about.values())
        if not is_known or not texts or about["tune"] not in TUNINGS:
            raise WeightsError(
                f"{path} is damaged or of another version than {VERSION}; train again"
            )
        return cls(**about)  # type: ignore[arg-type]  # checked above

    def check(self, weights: Path) -> None:
        """Refuse a base that is not there any more, or another one.

        Args:
            weights: Folder of the weights that need it, for the error.

        Raises:
            WeightsError: It names the command that names another folder.
        """
        mend = f"tacgrasp train base --weights {weights} --lm DIR"
        if not Path(self.path).is_dir():
            raise WeightsError(
                f"the language model behind {weights} is not in {self.path} any more; if it was "
                f"moved, name its folder: {mend}"
            )
        if BaseLm.of(Path(self.path), self.tune).fingerprint != self.fingerprint:
            raise WeightsError(
                f"the language model in {self.path} is another one than {weights} was trained "
                f"behind; name that one's folder: {mend}"
            )

    def write(self, lm_folder: Path) -> None:
        """Write ``base.json``; the manifest must follow."""
        content = {"format": FORMAT, "version": VERSION, **asdict(self)}
        write_atomically(lm_folder / BASE_FILE, json.dumps(content, indent=2) + "\n")


def is_stock(lm_folder: Path) -> bool:
    """Whether a part ``lm`` is of a language model that others made."""
    return (lm_folder / BASE_FILE).is_file()


def move_base(weights: Path, folder: Path) -> BaseLm:
    """Name another folder of the same base in a folder of weights.

    Raises:
        WeightsError: The weights need no base, or the folder holds another one.
        OSError: It can't be written.
    """
    lm = weights / "lm"
    if not is_stock(lm):
        raise WeightsError(f"{weights} has no {lm / BASE_FILE}: its language model is all in it")
    check_manifest(lm)
    stored = BaseLm.read(lm)
    found = BaseLm.of(folder, stored.tune)
    if found.fingerprint != stored.fingerprint:
        raise WeightsError(
            f"{folder} holds another language model than {weights} was trained behind, which was "
            f"a {stored.model_type} in {stored.path}; name that one"
        )
    check_manifest(weights / "projector")
    check_partners(weights / "projector")
    moved = replace(stored, path=found.path)
    moved.write(lm)
    write_manifest(lm)
    write_manifest(weights / "projector", trained_with=PARTNERS)
    return moved


def write_stock_lm(folder: Path, base: BaseLm, lm: Any, tokenizer: Any, adapter: Any) -> None:
    """Write a part ``lm`` in the place of an earlier one.

    Args:
        folder: The part's folder.
        base: What it was trained behind, and how.
        lm: The whole model, which is written where all of it was trained.
        tokenizer: Its tokenizer (``cltp.texts.stock_tokenizer.StockTokenizer``), likewise.
        adapter: peft's model around it, where an adapter was trained.
    """
    part = folder.with_name(f"{folder.name}.{os.getpid()}.part")
    shutil.rmtree(part, ignore_errors=True)
    part.mkdir(parents=True)
    if base.tune == "lora":
        adapter.save_pretrained(part, save_embedding_layers=False)
        (part / "README.md").unlink(missing_ok=True)  # peft's, which says nothing
    elif base.tune == "all":
        lm.save_pretrained(part, max_shard_size=_ONE_FILE)
        tokenizer.save(part)
    base.write(part)
    write_manifest(part)
    shutil.rmtree(folder, ignore_errors=True)
    part.replace(folder)


def _fingerprint(folder: Path) -> str:
    names = {CONFIG, *TOKENIZER_FILES, "merges.txt", "tokenizer_config.json"}
    weights = sorted(folder.glob("*.safetensors"))
    if not weights:
        raise WeightsError(
            f"{folder} has no *.safetensors; save the model there by transformers' save_pretrained"
        )
    total = hashlib.sha256()
    try:
        for path in sorted(folder / name for name in names if (folder / name).is_file()):
            total.update(path.name.encode() + path.read_bytes())
        for path in weights:
            size = path.stat().st_size
            total.update(f"{path.name} {size}".encode())
            with path.open("rb") as file:
                for number in range(_SAMPLES):
                    file.seek(max(0, size - _SAMPLE_BYTES) * number // (_SAMPLES - 1))
                    total.update(file.read(_SAMPLE_BYTES))
    except OSError as error:
        raise TouchError(f"{folder} can't be read: {error.strerror or error}") from error
    return total.hexdigest()
