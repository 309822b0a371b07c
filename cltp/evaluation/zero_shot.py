"""Classes and texts of contacts by nearness in the shared space, without training on labels.

A prompt for each class of a dimension: the paper's one, or the mean of all wordings of
``cltp.texts.paraphrases`` (an ensemble). Retrieval: the contacts nearest to a text, the texts
nearest to a contact.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import torch
import torch.nn.functional as F
from torch import Tensor

from cltp.data.dataset import ContactDataset
from cltp.data.sampler import Augmentation, Sampler
from cltp.encoder.clip_towers import Towers
from cltp.evaluation.evaluate import unscaled
from cltp.evaluation.features import BLOCK, Observed, chosen_rows, read_block
from cltp.tactile.measure import contact_state
from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import CLASSES
from cltp.texts.paraphrases import prompts
from cltp.train.text_targets import class_numbers

PROMPTINGS = ("single", "ensemble")


class Prompts:
    """Features of the prompts of every class.

    Args:
        towers: Whose space it is.
        prompting: ``single``, the paper's prompt, or ``ensemble``.
    """

    def __init__(self, towers: Towers, prompting: str = "single") -> None:
        self._features = []
        for slot, names in CLASSES.items():
            rows = []
            for name in names:
                wordings = prompts(slot, name)
                chosen = wordings[:1] if prompting == "single" else wordings
                rows.append(F.normalize(towers.texts(chosen).mean(dim=0), dim=0))
            self._features.append(torch.stack(rows).cpu())

    def cosines(self, feature: Tensor) -> list[Tensor]:
        """Cosines of contacts with aligned features (N, F) and every prompt: (N, classes) each."""
        unit = F.normalize(feature, dim=1)
        return [unit @ rows.T for rows in self._features]

    def said(self, feature: Tensor) -> Tensor:
        """Classes (N, 5) of contacts with aligned features (N, F)."""
        return torch.stack([(feature @ rows.T).argmax(1) for rows in self._features], dim=1)

    def surety(self, feature: Tensor) -> Tensor:
        """Cosine of each contact with the prompt that was chosen, shape (N, 5)."""
        return torch.stack([found.amax(1) for found in self.cosines(feature)], dim=1)


def measured(
    data: ContactDataset, noise: Augmentation, *, limit: int | None = None, seed: int = 0
) -> tuple[Tensor, Tensor]:
    """Classes (N, 5) by direct computation from the points that encoders see, and the truth.

    The contacts and their noise are those of ``cltp.evaluation.features.observe`` with one view.
    Shape and texture are not computed: -1.
    """
    order = chosen_rows(len(data), limit=limit, seed=seed)
    sampler = Sampler(data, noise, seed=seed)
    said, truth = [], []
    for number, first in enumerate(range(0, len(order), BLOCK)):
        for batch, _ in read_block(sampler, order[first : first + BLOCK], number):
            truth.append(class_numbers(batch.states))
            clouds = (
                unscaled(points, sensor_named(data.column("sensor")[index]))
                for index, points in zip(batch.index, batch.points, strict=True)
            )
            said.append(class_numbers([contact_state(cloud) for cloud in clouds]))
    return torch.cat(said), torch.cat(truth)


@dataclass(frozen=True, slots=True)
class Found:
    """How often the right text and the right contact are found.

    Attributes:
        contact_to_text: By rank k, the share of contacts with their own caption among the k nearest
            of all captions of the set.
        text_to_contact: By rank k, the share of captions with one of their contacts among the k
            nearest.
        chance: Of the first rank, contact to text.
        contacts: How many.
        captions: How many different ones.
    """

    contact_to_text: dict[int, float]
    text_to_contact: dict[int, float]
    chance: float
    contacts: int
    captions: int


def retrieve(
    towers: Towers, seen: Observed, captions: Sequence[str], ranks: Sequence[int] = (1, 5, 10)
) -> Found:
    """Contacts and captions that find each other, all against all.

    Args:
        towers: Whose space it is.
        seen: Contacts.
        captions: Theirs, one each; contacts with the same words share one.
        ranks: Which k to count.
    """
    texts = sorted(set(captions))
    own = torch.tensor([texts.index(text) for text in captions])
    spoken = torch.cat([towers.texts(texts[n : n + 64]).cpu() for n in range(0, len(texts), 64)])
    similar = F.normalize(seen.feature, dim=1) @ spoken.T
    to_text, to_contact = {}, {}
    for rank in ranks:
        near = similar.topk(min(rank, len(texts)), dim=1).indices
        to_text[rank] = float((near == own[:, None]).any(1).float().mean())
        near = similar.T.topk(min(rank, len(captions)), dim=1).indices
        right = own[near] == torch.arange(len(texts))[:, None]
        to_contact[rank] = float(right.any(1).float().mean())
    return Found(to_text, to_contact, 1 / len(texts), len(captions), len(texts))


def nearest_contacts(
    towers: Towers, seen: Observed, text: str, count: int
) -> list[tuple[int, float]]:
    """Rows of ``seen`` nearest to any text, with their cosines."""
    similar = F.normalize(seen.feature, dim=1) @ towers.texts([text])[0].cpu()
    best = similar.topk(min(count, len(seen)))
    return list(zip(best.indices.tolist(), best.values.tolist(), strict=True))


def nearest_texts(
    towers: Towers, feature: Tensor, texts: Sequence[str], count: int
) -> list[tuple[str, float]]:
    """Texts nearest to one contact's feature (F,), with their cosines."""
    similar = towers.texts(texts).cpu() @ F.normalize(feature, dim=0)
    best = similar.topk(min(count, len(texts)))
    return [
        (texts[n], value)
        for n, value in zip(best.indices.tolist(), best.values.tolist(), strict=True)
    ]
