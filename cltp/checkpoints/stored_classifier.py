"""A text classifier on disk: its table in 8 bits a number, the rest in 16."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import torch

from cltp.checkpoints.manifest import WeightsError, check_manifest
from cltp.checkpoints.parts import check_model_type, named
from cltp.checkpoints.weight_files import (
    CONFIG,
    load_weights,
    read_config,
    require_files,
    save_weights,
)
from cltp.texts.text_classifier import ClassifierConfig, TextClassifier

CLASSIFIER = "tacgrasp_text_classifier"
"""``model_type`` of a text classifier."""

_LARGEST = 1_000_000


def save_classifier(folder: Path, model: TextClassifier) -> None:
    """Write configuration, weights and manifest."""
    state = {name: value.detach().half() for name, value in model.state_dict().items()}
    table = model.table.weight.detach()
    step = (table.abs().amax(1, keepdim=True) / 127).clamp(min=1e-8)
    state |= {"table.weight": (table / step).round().to(torch.int8), "step": step}
    config = named(CLASSIFIER, TextClassifier) | dataclasses.asdict(model.config)
    save_weights(folder, config, state)


def load_classifier(folder: Path) -> TextClassifier:
    """Read a classifier for use.

    Raises:
        WeightsError: Missing, damaged, or of another kind.
    """
    require_files(folder, command=f"tacgrasp train queries --out {folder}")
    check_manifest(folder)
    stored = read_config(folder / CONFIG)
    check_model_type(folder, stored, CLASSIFIER)
    names = [field.name for field in dataclasses.fields(ClassifierConfig)]
    sizes = {name: stored.get(name) for name in names if name != "classes"}
    classes = stored.get("classes")
    is_whole = all(type(size) is int and 0 < size < _LARGEST for size in sizes.values())
    if not is_whole or not isinstance(classes, list) or not classes:
        raise WeightsError(f"{folder / CONFIG} describes no text classifier; train it again")
    try:
        model = TextClassifier(ClassifierConfig(classes=tuple(classes), **sizes))  # type: ignore[arg-type]
    except AssertionError as error:  # torch: the width must be divisible by the heads
        raise WeightsError(f"{folder / CONFIG} describes no text classifier: {error}") from error
    load_weights(folder, model)
    with torch.no_grad():
        model.table.weight.mul_(model.step)
        model.step.fill_(1.0)
    return model.eval()
