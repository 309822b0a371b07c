"""The two parts that only this program knows, under the Hub's verbs: encoder with heads, projector.

    stored = StoredEncoder.from_pretrained(Path("policies/weights/encoder"))
    encoded = stored.encoder(points)
    stored.save_pretrained(Path("elsewhere/encoder"))

Folders are local, and nothing is downloaded. These are plain methods and not transformers'
``PreTrainedModel`` or huggingface_hub's mixin: both read weights past the manifest, and the import
of transformers takes seconds. ``config.json`` has ``model_type`` and ``architectures`` as every
model on the Hub. A folder that was written before it had them is read too
(``cltp.checkpoints.layout`` adds them).

Not here: clip and lm, which are transformers' own models (``cltp.checkpoints.tac3d_llm``).
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from torch import nn

from cltp.checkpoints.manifest import WeightsError, check_manifest
from cltp.checkpoints.weight_files import (
    CONFIG,
    WEIGHTS,
    load_weights,
    read_config,
    require_files,
    save_weights,
)
from cltp.encoder.encoder import EncoderConfig, TactileEncoder
from cltp.encoder.force_head import ForceHead
from cltp.encoder.heads import StateHeads
from cltp.errors import TouchError
from cltp.llm.tac3d_llm import Projector

ENCODER, PROJECTOR = "tacgrasp_encoder", "tacgrasp_projector"
"""``model_type`` of the two."""

ENCODER_VERSION = 2
"""2: grids have cells of one size, whose edge ends the pooled tokens, whatever the pad."""

PROJECTOR_VERSION = 3
"""3: pooled tokens and the heads' readings with intervals follow the tokens."""

_LARGEST_DIM = 16_384


class _EncoderWithHeads(nn.Module):
    def __init__(self, encoder: TactileEncoder, heads: StateHeads) -> None:
        super().__init__()
        self.encoder, self.heads = encoder, heads


@dataclass(frozen=True, slots=True)
class StoredEncoder:
    """What a folder ``encoder`` holds.

    Attributes:
        encoder: E_T.
        heads: The heads that read states from it.
    """

    encoder: TactileEncoder
    heads: StateHeads

    @classmethod
    def from_pretrained(cls, folder: Path | str) -> StoredEncoder:
        """Read an encoder with its heads, strictly, from a local folder.

        Raises:
            WeightsError: Missing, damaged, of another kind or shape.
        """
        folder = Path(folder)
        config = _part_config(folder, ENCODER, ENCODER_VERSION)
        check_room(folder, config)
        encoder = random_encoder(folder, config)
        has_intervals = config.get("intervals") is True  # weights of before have none
        heads = StateHeads.of(encoder.config, intervals=has_intervals)
        heads.force = ForceHead() if config.get("force") is True else None
        stored = cls(encoder, heads)
        load_weights(folder, _EncoderWithHeads(stored.encoder, stored.heads))
        return stored

    def save_pretrained(self, folder: Path | str) -> None:
        """Write configuration, weights in 16 bits and manifest into a folder."""
        config = {
            **named(ENCODER, TactileEncoder, StateHeads),
            "version": ENCODER_VERSION,
            "encoder": dataclasses.asdict(self.encoder.config),
            **({"intervals": True} if self.heads.has_intervals else {}),
            **({"force": True} if self.heads.force is not None else {}),
        }
        _save_halved(Path(folder), config, _EncoderWithHeads(self.encoder, self.heads))


@dataclass(frozen=True, slots=True, kw_only=True)
class ProjectorConfig:
    """What a projector joins.

    Attributes:
        encoder_dim: Width of the encoder's tokens.
        lm_dim: Width of the language model's inputs.
        tokenizer_sha256: Fingerprint of the tokenizer that it was trained with.
    """

    encoder_dim: int
    lm_dim: int
    tokenizer_sha256: str

    @classmethod
    def read(cls, folder: Path) -> ProjectorConfig:
        """Read and check a projector's configuration.

        Raises:
            WeightsError: Missing, damaged, of another kind or version, or of no possible size.
        """
        stored = _part_config(folder, PROJECTOR, PROJECTOR_VERSION)
        values = {part.name: stored.get(part.name) for part in dataclasses.fields(cls)}
        for name in ("encoder_dim", "lm_dim"):
            dim = values[name]
            if type(dim) is not int or not 1 <= dim <= _LARGEST_DIM:
                raise WeightsError(
                    f"{folder / CONFIG}: {name} must be a whole number of 1 to {_LARGEST_DIM}, got "
                    f"{dim!r:.40}; copy the whole folder again, or train again"
                )
        return cls(**values)  # type: ignore[arg-type]  # checked above; a fingerprint is compared


@dataclass(frozen=True, slots=True)
class StoredProjector:
    """What a folder ``projector`` holds.

    Attributes:
        projector: The MLP between encoder and language model.
        tokenizer_sha256: Fingerprint of the tokenizer that it was trained with.
    """

    projector: Projector
    tokenizer_sha256: str

    @classmethod
    def from_pretrained(cls, folder: Path | str) -> StoredProjector:
        """Read a projector, strictly, from a local folder.

        Whether the parts beside it are those of its training is for
        ``cltp.checkpoints.tac3d_llm.load_tac3d_llm``, which reads them all.

        Raises:
            WeightsError: Missing, damaged, of another kind or shape.
        """
        folder = Path(folder)
        config = ProjectorConfig.read(folder)
        needed = 2 * config.lm_dim * (config.encoder_dim + config.lm_dim)
        held = (folder / WEIGHTS).stat().st_size
        if needed > held:
            raise WeightsError(
                f"{folder}/{CONFIG} describes a projector from width {config.encoder_dim} to "
                f"{config.lm_dim}, at least {needed} bytes; {WEIGHTS} has {held}: they don't "
                "belong together"
            )
        projector = Projector(config.encoder_dim, config.lm_dim)
        load_weights(folder, projector)
        return cls(projector, config.tokenizer_sha256)

    def save_pretrained(self, folder: Path | str, *, trained_with: Iterable[str] = ()) -> None:
        """Write configuration, weights in 16 bits and manifest into a folder.

        Args:
            folder: The folder.
            trained_with: Names of the parts beside the folder that it is good for alone.
        """
        config = {
            **named(PROJECTOR, Projector),
            "version": PROJECTOR_VERSION,
            "encoder_dim": self.projector.encoder_dim,
            "lm_dim": self.projector.lm_dim,
            "tokenizer_sha256": self.tokenizer_sha256,
        }
        _save_halved(Path(folder), config, self.projector, trained_with=trained_with)


def named(model_type: str, *classes: type[nn.Module]) -> dict[str, Any]:
    """The entries by which the Hub and a reader know what a configuration is of."""
    return {"model_type": model_type, "architectures": [kind.__name__ for kind in classes]}


def check_model_type(folder: Path, config: Mapping[str, Any], expected: str) -> None:
    """Refuse the configuration of another kind of part; older ones do not tell their kind.

    Raises:
        WeightsError: It is another kind.
    """
    held = config.get("model_type", expected)
    if held != expected:
        raise WeightsError(
            f"{folder} holds a model of type {held!r:.40} where {expected!r} is expected; name the "
            "folder of that part, or copy the whole folder of weights again"
        )


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


def _part_config(folder: Path, model_type: str, version: int) -> dict[str, Any]:
    require_files(folder)
    check_manifest(folder)
    config = read_config(folder / CONFIG)
    check_model_type(folder, config, model_type)
    if config.get("version") != version:
        raise WeightsError(f"{folder} holds weights of another version than {version}; train again")
    return config


def _save_halved(
    folder: Path, config: Mapping[str, Any], module: nn.Module, trained_with: Iterable[str] = ()
) -> None:
    state = module.state_dict()
    halved = {name: v.half() if v.is_floating_point() else v for name, v in state.items()}
    save_weights(folder, config, halved, trained_with=trained_with)
