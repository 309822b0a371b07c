"""How right the encoder and the language model are about contacts that they have not seen."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import torch
from numpy.typing import NDArray

from cltp.data.dataset import ContactDataset
from cltp.data.sampler import NOISY, Augmentation, Batch, Sampler
from cltp.encoder.clip_towers import Towers
from cltp.encoder.encoder import TactileEncoder
from cltp.encoder.heads import StateHeads, restored
from cltp.errors import TouchError
from cltp.llm.generation import Reply
from cltp.tactile.cloud import TactileCloud
from cltp.tactile.measure import contact_state
from cltp.tactile.render import render
from cltp.tactile.sensors import SensorSpec, sensor_named
from cltp.tactile.states import (
    CLASSES,
    NUMBERS,
    Area,
    ContactState,
    Depth,
    Position,
    Shape,
    Texture,
)
from cltp.texts.captions import Slots, caption, parse_caption, slots_of

ZERO_SHOT: Mapping[str, str] = {
    "shape": "This is a {}.",
    "texture": "The texture is {}.",
    "depth": "Contact is {}.",
    "position": "Contact at {}.",
    "area": "The contact area is {}.",
}
"""Prompts of zero-shot classification. Source: paper, section 5.1, for shape, depth, position."""


class Speaker(Protocol):
    """What ``cltp.llm.generation.Talker`` does for a person."""

    def reply(self, points: NDArray[np.float32], prompt: str) -> Reply:
        """Answer about one contact, points of shape (1024, 3) scaled."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class Scores:
    """Share of right classes in each of the five slots.

    Attributes:
        right: By slot, 0 to 1; NaN where nothing could be judged.
        count: Contacts judged.
        errors: Median absolute error by quantity, in its unit, of contacts that touch; also
            ``position_mm`` (distance) and ``force_share`` (of the true force); empty for words
            alone.
    """

    right: Mapping[str, float]
    count: int
    errors: Mapping[str, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class RetrievalScores:
    """How well two towers find each other's contacts.

    Attributes:
        image_to_text: Share of images whose nearest caption is their own.
        text_to_image: Share of captions whose nearest image is theirs.
        chance: What guessing gives.
        among: Contacts to choose from, on average.
    """

    image_to_text: float
    text_to_image: float
    chance: float
    among: float


def batches(
    data: ContactDataset, limit: int, augmentation: Augmentation = NOISY, *, seed: int = 0
) -> list[Batch]:
    """Noisy clouds of up to ``limit`` contacts spread over a split, the same at every call."""
    sampler = Sampler(data, augmentation, seed=seed)
    chosen = np.random.default_rng(seed).permutation(len(data))[:limit]
    parts = np.array_split(chosen, -(-len(chosen) // 64))
    return [sampler.batch(part, number) for number, part in enumerate(parts)]


@torch.inference_mode()
def heads_scores(encoder: TactileEncoder, heads: StateHeads, samples: Sequence[Batch]) -> Scores:
    """What the state heads read from the encoder (the paper's 'frozen + MLP')."""
    said: list[Slots] = []
    values: list[torch.Tensor] = []
    for batch in samples:
        logits, numbers, _, _ = heads(encoder(torch.from_numpy(batch.points)).pooled)
        picks = {slot: out.argmax(1).tolist() for slot, out in zip(CLASSES, logits, strict=True)}
        said += [
            _slots({slot: CLASSES[slot][picks[slot][row]] for slot in CLASSES})
            for row in range(len(batch.states))
        ]
        values.append(restored(numbers))
    states = [state for batch in samples for state in batch.states]
    return _scored(said, states, torch.cat(values).numpy())


@torch.inference_mode()
def zero_shot_scores(encoder: TactileEncoder, towers: Towers, samples: Sequence[Batch]) -> Scores:
    """Classes by the nearest prompt in the shared space, without training on labels."""
    texts = {
        slot: towers.texts([ZERO_SHOT[slot].format(word) for word in names])
        for slot, names in CLASSES.items()
    }
    said: list[Slots] = []
    for batch in samples:
        feature = encoder(torch.from_numpy(batch.points)).feature
        picks = {slot: (feature @ found.T).argmax(1).tolist() for slot, found in texts.items()}
        said += [
            _slots({slot: CLASSES[slot][picks[slot][row]] for slot in CLASSES})
            for row in range(len(batch.states))
        ]
    return _scored(said, [state for batch in samples for state in batch.states])


def ceiling_scores(data: ContactDataset, samples: Sequence[Batch]) -> Scores:
    """What is computed directly from the same points: depth, position and area alone."""
    said, values = [], []
    for batch in samples:
        for index, points in zip(batch.index, batch.points, strict=True):
            state = contact_state(unscaled(points, sensor_named(data.column("sensor")[index])))
            said.append(slots_of(state))
            values.append([getattr(state, name) for name in NUMBERS])
    return _scored(said, [s for batch in samples for s in batch.states], np.array(values))


def unscaled(points: NDArray[np.float32], sensor: SensorSpec) -> TactileCloud:
    """The cloud that scaled points, shape (1024, 3), came from."""
    half = sensor.width_mm / 2
    scale = np.array([half, half, sensor.max_depth_mm], np.float32)
    return TactileCloud(points_mm=points * scale, sensor=sensor)


def retrieval_scores(
    towers: Towers, data: ContactDataset, samples: Sequence[Batch]
) -> RetrievalScores:
    """How often an image of the clean gel finds its caption among all of a batch, and back.

    Contacts with the same caption count as one. Source: the usual measure of CLIP.
    """
    found = []
    for batch in samples:
        captions = [caption(state) for state in batch.states]
        sensors = [sensor_named(data.column("sensor")[index]) for index in batch.index]
        images = [render(h, s) for h, s in zip(batch.height_mm, sensors, strict=True)]
        similar = (towers.images(torch.stack(images)) @ towers.texts(captions).T).numpy()
        same = np.array([[a == b for b in captions] for a in captions])
        rows = np.arange(len(captions))
        found.append(
            [
                same[rows, similar.argmax(axis=1)].mean(),
                same[similar.argmax(axis=0), rows].mean(),
                same.mean(),
                len(captions),
            ]
        )
    to_text, to_image, chance, among = np.mean(found, axis=0)
    return RetrievalScores(
        image_to_text=float(to_text),
        text_to_image=float(to_image),
        chance=float(chance),
        among=float(among),
    )


def caption_scores(
    talker: Speaker,
    samples: Sequence[Batch],
    request: str = "Describe the contact.",
    read_numbers: Callable[[str], Sequence[float] | None] | None = None,
) -> Scores:
    """What the language model says, slot by slot; a reply that is no caption is wrong in all.

    Args:
        talker: The model.
        samples: Contacts.
        request: What is asked.
        read_numbers: Reads ``NUMBERS`` out of a reply, None where it has none: that counts as
            infinitely wrong.
    """
    said, values = [], []
    for batch in samples:
        for points in batch.points:
            text = talker.reply(points, request).text
            try:
                said.append(parse_caption(text.split(".")[0]))
            except TouchError:
                said.append(Slots())
            read = read_numbers(text) if read_numbers is not None else None
            values.append(read if read is not None else [np.inf] * len(NUMBERS))
    states = [state for batch in samples for state in batch.states]
    return _scored(said, states, np.array(values) if read_numbers is not None else None)


def answer_scores(
    talker: Speaker,
    samples: Sequence[Batch],
    wordings: Mapping[str, Sequence[str]],
    is_right: Callable[[str, str, ContactState], bool],
) -> Mapping[str, float]:
    """Share of right answers to questions about each slot, over all wordings in turn.

    Args:
        talker: The model.
        samples: Contacts.
        wordings: Questions by slot.
        is_right: Judges (slot, answer, state).
    """
    right: dict[str, list[bool]] = {slot: [] for slot in wordings}
    number = 0
    for batch in samples:
        for points, state in zip(batch.points, batch.states, strict=True):
            for slot, questions in wordings.items():
                text = talker.reply(points, questions[number % len(questions)]).text
                right[slot].append(is_right(slot, text, state))
            number += 1
    return {slot: float(np.mean(judged)) for slot, judged in right.items()}


def _slots(words: Mapping[str, str]) -> Slots:
    return Slots(
        texture=Texture(words["texture"]),
        shape=Shape(words["shape"]),
        depth=Depth(words["depth"]),
        position=Position(words["position"]),
        area=Area(words["area"]),
    )


def _scored(
    said: Sequence[Slots],
    states: Sequence[ContactState],
    values: np.ndarray | None = None,
) -> Scores:
    right = {}
    for slot in CLASSES:
        judged = [
            getattr(one, slot) == getattr(slots_of(state), slot)
            for one, state in zip(said, states, strict=True)
            if getattr(slots_of(state), slot) is not None
        ]
        right[slot] = float(np.mean(judged)) if judged else float("nan")
    errors = {}
    if values is not None:
        truth = np.array([[getattr(state, name) for name in NUMBERS] for state in states])
        felt = np.array([state.in_contact for state in states])
        off = np.abs(values - truth)[felt]
        errors = {name: float(np.median(off[:, n])) for n, name in enumerate(NUMBERS)}
        errors["position_mm"] = float(np.median(np.hypot(off[:, 1], off[:, 2])))
        errors["force_share"] = float(np.median(off[:, 4] / np.maximum(truth[felt, 4], 0.05)))
    return Scores(right=right, count=len(states), errors=errors)
