"""One text for each contact of a step of contrastive learning, and the contacts it is true of.

``caption``: the paper's template, all five dimensions at once.
``mixed``: that template for half of the contacts, for the others a prompt for one dimension
    (``cltp.texts.paraphrases``). A text that names one dimension alone is then nothing new in
    zero-shot classification. It is true of many contacts of a batch, which the loss has to know
    (``matches``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from cltp.encoder.all_gather import gathered
from cltp.tactile.states import CLASSES, ContactState
from cltp.texts.captions import caption, slots_of
from cltp.texts.paraphrases import prompts

KINDS = ("caption", "mixed")

CAPTION_FRACTION = 0.5
"""Fraction of captions among the texts of ``mixed``. Our choice: as many captions as prompts."""

UNNAMED = -1


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
    rows = []
    for state in states:
        slots = slots_of(state)
        words = [(names, getattr(slots, slot)) for slot, names in CLASSES.items()]
        rows.append([UNNAMED if w is None else names.index(w) for names, w in words])
    return torch.tensor(rows)


def matches(contacts: Tensor, texts: Tensor, named: Tensor) -> Tensor:
    """Whether each text is true of each contact, shape (contacts, texts), bool.

    Args:
        contacts: Classes of the contacts, shape (contacts, 5).
        texts: Classes of the contact behind each text, shape (texts, 5).
        named: The dimensions that each text names, shape (texts, 5), bool.
    """
    same = contacts[:, None] == texts[None]
    return (same | ~named[None]).all(dim=-1)


def matches_of_all(targets: TextTargets, device: torch.device) -> Tensor:
    """``matches`` over the rows of all processes."""
    classes = gathered(targets.classes.to(device))
    return matches(classes, classes, gathered(targets.named.to(device).long()).bool())


def draw_prompts(rng: np.random.Generator) -> list[list[str]]:
    """For each dimension one prompt for every class, its wording drawn."""
    wordings = [[prompts(slot, name) for name in names] for slot, names in CLASSES.items()]
    return [[texts[rng.integers(len(texts))] for texts in classes] for classes in wordings]
