"""How right the encoder and the language model are about contacts that they have not seen."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import torch

from cltp.captions import Slots, parse_caption, slots_of
from cltp.clip import Towers
from cltp.cloud import TactileCloud
from cltp.dataset import ContactDataset
from cltp.encoder import TactileEncoder
from cltp.errors import TouchError
from cltp.heads import NUMBERS, StateHeads, restored
from cltp.measure import contact_state
from cltp.samples import CLASSES, NOISY, Augmentation, Batch, Sampler
from cltp.sensors import sensor_named
from cltp.states import Area, ContactState, Depth, Position, Shape, Texture
from cltp.talk import Talker

ZERO_SHOT: Mapping[str, str] = {
    "shape": "This is a {}.",
    "texture": "The texture is {}.",
    "depth": "Contact is {}.",
    "position": "Contact at {}.",
    "area": "The contact area is {}.",
}
"""Prompts of zero-shot classification. Source: paper, section 5.1, for shape, depth, position."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Scores:
    """Share of right classes in each of the five slots.

    Attributes:
        right: By slot, 0 to 1; NaN where nothing could be judged.
        count: Contacts judged.
        errors: Median absolute error by quantity, in its unit; empty for words alone.
    """

    right: Mapping[str, float]
    count: int
    errors: Mapping[str, float]


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
            sensor = sensor_named(data.column("sensor")[index])
            half = sensor.width_mm / 2
            scale = np.array([half, half, sensor.max_depth_mm], np.float32)
            state = contact_state(TactileCloud(points_mm=points * scale, sensor=sensor))
            said.append(slots_of(state))
            values.append([getattr(state, name) for name in NUMBERS])
    return _scored(said, [s for batch in samples for s in batch.states], np.array(values))


def caption_scores(
    talker: Talker, samples: Sequence[Batch], request: str = "Describe the contact."
) -> Scores:
    """What the language model says, slot by slot; a reply that is no caption is wrong in all."""
    said = []
    for batch in samples:
        for points in batch.points:
            text = talker.reply(points, request).text
            try:
                said.append(parse_caption(text.split(".")[0]))
            except TouchError:
                said.append(Slots())
    return _scored(said, [state for batch in samples for state in batch.states])


def answer_scores(
    talker: Talker,
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
        errors["force_share"] = float(np.median(off[:, 4] / np.maximum(truth[felt, 4], 0.05)))
    return Scores(right=right, count=len(states), errors=errors)
