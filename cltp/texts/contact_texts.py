"""All texts of a stored contact, derived from its labels and reproducible."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from cltp.data.dataset import ContactDataset
from cltp.tactile.sensors import sensor_named
from cltp.texts.captions import caption
from cltp.texts.paraphrases import PROMPTS, paraphrase, prompts, text_seed
from cltp.texts.question_answers import QuestionAnswer, question_answers
from cltp.texts.tolerances import toleranced_caption


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactTexts:
    """The texts of one contact.

    Attributes:
        caption: Caption in the paper's template.
        numbers: Caption in mm, mm² and N, with tolerances.
        paraphrase: Caption in other words.
        prompts: Prompts of the contact's own class, by dimension; only of named dimensions.
        questions: Questions with their answers.
    """

    caption: str
    numbers: str
    paraphrase: str
    prompts: Mapping[str, list[str]]
    questions: list[QuestionAnswer]


def texts_of(data: ContactDataset, index: int) -> ContactTexts:
    """The texts of a contact; they depend on its labels alone, not on its index in the data.

    Raises:
        TouchError: Its labels can't be worded: a depth without position or area.
    """
    state = data.state(index)
    sensor = sensor_named(data.column("sensor")[index])
    numbers = {name: int(data.column(name)[index]) for name in ("seed", "series")}
    seed = text_seed(**numbers, depth_mm=float(np.float32(state.depth_mm)))
    words = {slot: getattr(state, slot) for slot in PROMPTS}
    return ContactTexts(
        caption=caption(state),
        numbers=toleranced_caption(state, sensor),
        paraphrase=paraphrase(state, seed),
        prompts={slot: prompts(slot, word) for slot, word in words.items() if word is not None},
        questions=question_answers(state, sensor, seed),
    )
