"""What is said of each contact in a step of contrastive learning, and what else that is true of.

``caption``: the paper's template, all five dimensions at once.
``mixed``: half of the contacts so, the others by a prompt for one dimension
    (``cltp.texts.paraphrases``). A text that names one dimension alone is then nothing new in
    zero-shot classification; it is true of many contacts of a batch, so that ``fits`` has to be
    given to the loss.
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

CAPTION_SHARE = 0.5
"""Of the texts of ``mixed``. Our choice: as many whole captions as prompts."""

NOTHING = -1


@dataclass(frozen=True, slots=True, kw_only=True)
class Sayings:
    """One text for each contact of a batch.

    Attributes:
        texts: What is said, one text a contact.
        classes: Shape (B, 5): the contacts' classes, in the order of ``CLASSES``; ``NOTHING``
            where nobody named one, and in all dimensions without contact.
        named: Shape (B, 5), bool: the dimensions that each text names.
    """

    texts: list[str]
    classes: Tensor
    named: Tensor


def say(states: Sequence[ContactState], kind: str, rng: np.random.Generator) -> Sayings:
    """Word contacts.

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
        known = [n for n in range(len(slots)) if classes[row, n] != NOTHING]
        if kind == "caption" or not known or rng.random() < CAPTION_SHARE:
            texts.append(caption(state))
            continue
        column = known[rng.integers(len(known))]
        slot = slots[column]
        wordings = prompts(slot, CLASSES[slot][int(classes[row, column])])
        texts.append(wordings[rng.integers(len(wordings))])
        named[row] = False
        named[row, column] = True
    return Sayings(texts=texts, classes=classes, named=named)


def class_numbers(states: Sequence[ContactState]) -> Tensor:
    """Classes of contacts, shape (B, 5), ``NOTHING`` where a slot says nothing."""
    found = []
    for state in states:
        slots = slots_of(state)
        words = [(names, getattr(slots, slot)) for slot, names in CLASSES.items()]
        found.append([NOTHING if w is None else names.index(w) for names, w in words])
    return torch.tensor(found)


def fits(contacts: Tensor, told: Tensor, named: Tensor) -> Tensor:
    """Which contacts each text is true of, shape (contacts, texts).

    Args:
        contacts: Classes, shape (contacts, 5).
        told: Classes of the contact behind each text, shape (texts, 5).
        named: The dimensions that each text names, shape (texts, 5).
    """
    same = contacts[:, None] == told[None]
    return (same | ~named[None]).all(dim=-1)


def true_of(said: Sayings, device: torch.device) -> Tensor:
    """Which contacts each text is true of, over the rows of all processes; see ``fits``."""
    classes = gathered(said.classes.to(device))
    return fits(classes, classes, gathered(said.named.to(device).long()).bool())


def drawn_prompts(rng: np.random.Generator) -> list[list[str]]:
    """For each dimension a prompt for every class, one of its wordings."""
    wordings = [[prompts(slot, name) for name in names] for slot, names in CLASSES.items()]
    return [[of[rng.integers(len(of))] for of in of_slot] for of_slot in wordings]
