"""Bring a folder of weights of an earlier layout into today's, to the bit with the same answers.

Weights stay as they are, byte for byte. ``config.json`` gets ``model_type`` and ``architectures``,
a tokenizer its files for transformers, the model card its front matter; manifests follow. What the
layout is: ``cltp.checkpoints.tac3d_llm``.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from cltp.atomic_write import write_atomically
from cltp.checkpoints.base_lm import is_stock
from cltp.checkpoints.card import CARD, PARTS, renew_card
from cltp.checkpoints.frozen import FORMAT
from cltp.checkpoints.manifest import (
    WeightsError,
    check_manifest,
    check_partners,
    write_manifest,
)
from cltp.checkpoints.parts import ENCODER, PROJECTOR, check_model_type, named
from cltp.checkpoints.weight_files import CONFIG, read_config, require_files
from cltp.encoder.encoder import TactileEncoder
from cltp.encoder.heads import StateHeads
from cltp.llm.stored_lm import write_seed_oss_config
from cltp.llm.tac3d_llm import Projector
from cltp.texts.tokenizer import Words


def renew_layout(weights: Path) -> list[str]:
    """Write everything but the weights of each part anew; a second time changes nothing.

    Args:
        weights: Folder of weights, or of one method.

    Returns:
        Names of the parts.

    Raises:
        TouchError: There is no part, one is damaged, not ours, or of another set; nothing is
            written then.
    """
    parts = [name for name in PARTS if (weights / name).is_dir()]
    if not parts:
        raise WeightsError(f"{weights} has none of {', '.join(PARTS)}; name a folder of weights")
    whole = {"encoder", "projector", "lm"} <= set(parts)
    words = {}
    if is_stock(weights / "lm"):  # in the layout of others
        check_manifest(weights / "lm")
        parts.remove("lm")
    for name in parts:
        require_files(weights / name)
        check_manifest(weights / name)
        if name in ("clip", "lm"):
            words[name] = Words.load(weights / name)
        else:
            _renewed(weights / name, name)
    if whole:
        check_partners(weights / "projector")
    for name in sorted(parts, key=lambda name: name == "projector"):  # it names the others
        folder = weights / name
        if name in words:
            words[name].save(folder)
            if name == "lm":
                write_seed_oss_config(folder)
        else:
            content = json.dumps(_renewed(folder, name), indent=2) + "\n"
            write_atomically(folder / CONFIG, content)
        trained_with = ("encoder", "lm") if whole and name == "projector" else ()
        write_manifest(folder, trained_with=trained_with)
    if (weights / CARD).exists():
        renew_card(weights)
    return parts


def _renewed(folder: Path, name: str) -> dict[str, Any]:
    """The configuration of an encoder or projector, with the entries that name it."""
    config = read_config(folder / CONFIG)
    if name == "projector":
        entries = named(PROJECTOR, Projector)
    elif config.get("format") == FORMAT:
        entries = named(ENCODER, TactileEncoder)
    else:
        entries = named(ENCODER, TactileEncoder, StateHeads)
    check_model_type(folder, config, entries["model_type"])
    return {**entries, **config}
