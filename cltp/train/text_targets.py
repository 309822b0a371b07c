"""One text for each contact of a step of contrastive learning, and the contacts it is true of.

``caption``: the paper's template, all five dimensions at once.
``mixed``: that template for half of the contacts, for the others a prompt for one dimension
    (``cltp.texts.paraphrases``). A text that names one dimension alone is then nothing new in
    zero-shot classification. It is true of many contacts of a batch, which the loss has to know
    (``matches``).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from cltp.encoder.all_gather import gathered
from cltp.encoder.heads import IGNORED, targets
from cltp.encoder.losses import CltpLoss
from cltp.tactile.states import CLASSES, ContactState
from cltp.texts.captions import caption
from cltp.texts.paraphrases import prompts

KINDS = ("caption", "mixed")

CAPTION_FRACTION = 0.5
"""Fraction of captions among the texts of ``mixed``. Our choice: as many captions as prompts."""

UNNAMED = IGNORED


@dataclass(frozen=True, slots=True, kw_only=True)
class TextTargets:
    """One text for each contact of a batch.

    Attributes:
        texts: The texts, one for each contact.
        classes: Shape (B, 5): the contacts' classes, in the order of ``CLASSES``; ``UNNAMED`` for a
            dimension without a label, and for all dimensions without contact.
        named: Shape (B, 5), bool: the dimensions that each text names.
    """

    texts: list[str]
    classes: Tensor
    named: Tensor


def draw_texts(states: Sequence[ContactState], kind: str, rng: np.random.Generator) -> TextTargets:
    """Draw a text for each contact.

    Args:
        states: The contacts.
        kind: Out of ``KINDS``.
        rng: Draws dimensions and prompts.

    Raises:
        ValueError: Another kind.
    """
    if kind not in KINDS:
        raise ValueError(f"unknown kind of texts {kind!r}; known: {', '.join(KINDS)}")
    classes = class_numbers(states)
    texts, named = [], torch.ones_like(classes, dtype=torch.bool)
    slots = list(CLASSES)
    for row, state in enumerate(states):
        labelled = [n for n in range(len(slots)) if classes[row, n] != UNNAMED]
        if kind == "caption" or not labelled or rng.random() < CAPTION_FRACTION:
            texts.append(caption(state))
            continue
        column = labelled[rng.integers(len(labelled))]
        slot = slots[column]
        wordings = prompts(slot, CLASSES[slot][int(classes[row, column])])
        texts.append(wordings[rng.integers(len(wordings))])
        named[row] = False
        named[row, column] = True
    return TextTargets(texts=texts, classes=classes, named=named)


def class_numbers(states: Sequence[ContactState]) -> Tensor:
    """Classes of contacts, shape (B, 5); ``UNNAMED`` for a slot that the caption leaves out."""
    labels = targets(states)
    return torch.where(labels.touching[:, None] > 0, labels.classes, UNNAMED)


def matches(contacts: Tensor, texts: Tensor, named: Tensor) -> Tensor:
    """Whether each text is true of each contact, shape (contacts, texts), bool.

    Args:
        contacts: Classes of the contacts, shape (contacts, 5).
        texts: Classes of the contact behind each text, shape (texts, 5).
        named: The dimensions that each text names, shape (texts, 5), bool.
    """
    same = contacts[:, None] == texts[None]
    return (same | ~named[None]).all(dim=-1)


def matches_of_all(texts: TextTargets, device: torch.device) -> Tensor:
    """``matches`` over the rows of all processes."""
    classes = gathered(texts.classes.to(device))
    return matches(classes, classes, gathered(texts.named.to(device).long()).bool())


def prompt_terms(
    loss: CltpLoss,
    features: Tensor,
    classes: Tensor,
    encode: Callable[[list[str]], Tensor],
    rng: np.random.Generator,
) -> dict[str, Tensor]:
    """Contrast of contacts with one prompt for every class, its wording drawn: by dimension.

    Args:
        loss: The loss, with its temperature.
        features: Features of the contacts, shape (B, F).
        classes: As ``TextTargets.classes``.
        encode: From texts to their features.
        rng: Draws wordings.
    """
    wordings = [prompts(slot, name) for slot, names in CLASSES.items() for name in names]
    drawn = encode([texts[rng.integers(len(texts))] for texts in wordings])
    parts = drawn.float().to(features.device).split([len(names) for names in CLASSES.values()])
    return {
        f"prompt_{slot}": loss.against_prompts(features, part, classes[:, column])
        for column, (slot, part) in enumerate(zip(CLASSES, parts, strict=True))
    }
