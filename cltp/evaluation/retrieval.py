"""Retrieval in the shared space: contacts by text, texts by contact, and how often it succeeds."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import torch
import torch.nn.functional as F
from torch import Tensor

from cltp.data.sampler import Batch
from cltp.encoder.clip_towers import Towers
from cltp.evaluation.features import EncodedContacts
from cltp.texts.captions import caption
from cltp.train.clip_feature_cache import rendered

RANKS = (1, 5, 10)
"""Ranks k at which retrieval is counted."""


def score_retrieval(
    towers: Towers, encoded: EncodedContacts, captions: Sequence[str]
) -> dict[str, float]:
    """Retrieve among all contacts and captions of a set.

    Args:
        towers: The encoders that share the space.
        encoded: Contacts.
        captions: One caption a contact; contacts with the same words share one.

    Returns:
        For each rank k, ``contact_to_text_k``, % of contacts whose caption is among the k nearest
        of all captions of the set, then ``text_to_contact_k``, % of captions with one of their
        contacts among the k nearest; ``chance``, % that guessing gives at rank 1, contact to text;
        ``captions``, the number of different captions.
    """
    texts, own = _different(captions)
    features = torch.cat([towers.texts(texts[n : n + 64]).cpu() for n in range(0, len(texts), 64)])
    cosines = F.normalize(encoded.feature, dim=1) @ features.T
    hits = {rank: _hits(cosines, own, rank) for rank in RANKS}
    return {
        **{f"contact_to_text_{k}": 100 * float(items.mean()) for k, (items, _) in hits.items()},
        **{f"text_to_contact_{k}": 100 * float(words.mean()) for k, (_, words) in hits.items()},
        "chance": 100 * (1 / len(texts)),
        "captions": float(len(texts)),
    }


def score_image_retrieval(towers: Towers, batches: Sequence[Batch]) -> dict[str, float]:
    """Retrieve images of the clean gel and captions among those of a batch, as CLIP is measured.

    Returns:
        Means over batches: ``image_to_text``, the fraction of images whose nearest caption is their
        own; ``text_to_image``, the fraction of contacts whose caption is nearest to one of its
        images; ``chance`` of guessing; ``among``, the number of contacts to choose from.
    """
    rows = []
    for batch in batches:
        texts, own = _different([caption(state) for state in batch.states])
        cosines = towers.images(rendered(batch)) @ towers.texts(texts).T
        of_images, of_texts = _hits(cosines, own, 1)
        same = (own[:, None] == own).double()
        rows.append([float(x.mean()) for x in (of_images, of_texts[own], same)] + [len(own)])
    names = ("image_to_text", "text_to_image", "chance", "among")
    return dict(zip(names, np.mean(rows, axis=0).tolist(), strict=True))


def _different(captions: Sequence[str]) -> tuple[list[str], Tensor]:
    """Different captions, and for each contact the number of its own."""
    texts = sorted(set(captions))
    numbers = {text: number for number, text in enumerate(texts)}
    return texts, torch.tensor([numbers[text] for text in captions])


def _hits(cosines: Tensor, own: Tensor, rank: int) -> tuple[Tensor, Tensor]:
    """1 for each item (N,) and each text (T,) whose counterpart is among its ``rank`` nearest."""
    items, texts = cosines.shape
    near = cosines.topk(min(rank, texts), dim=1).indices
    of_items = (near == own[:, None]).any(1)
    near = cosines.T.topk(min(rank, items), dim=1).indices
    of_texts = (own[near] == torch.arange(texts)[:, None]).any(1)
    return of_items.double(), of_texts.double()


def nearest_contacts(
    towers: Towers, encoded: EncodedContacts, text: str, count: int
) -> list[tuple[int, float]]:
    """Rows of ``encoded`` nearest to a text, with their cosines."""
    return _nearest(F.normalize(encoded.feature, dim=1) @ towers.texts([text])[0].cpu(), count)


def nearest_texts(
    towers: Towers, feature: Tensor, texts: Sequence[str], count: int
) -> list[tuple[str, float]]:
    """Texts nearest to one contact's feature (F,), with their cosines."""
    nearest = _nearest(towers.texts(texts).cpu() @ F.normalize(feature, dim=0), count)
    return [(texts[row], cosine) for row, cosine in nearest]


def _nearest(cosines: Tensor, count: int) -> list[tuple[int, float]]:
    best = cosines.topk(min(count, len(cosines)))
    return list(zip(best.indices.tolist(), best.values.tolist(), strict=True))
