"""Questions about a stored contact and answers from its labels: words, numbers, yes and no.

For data sets and benchmarks. Every pair follows from the contact and a seed alone.

Not here: the questions in the language model's training (``tacgrasp.lessons.dialogue``).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import DIMENSIONS, ContactState
from cltp.texts.captions import with_article
from cltp.texts.paraphrases import draw_index
from cltp.texts.tolerances import Tolerances, tolerances


class QuestionAnswer(NamedTuple):
    """A question and its answer.

    Attributes:
        about: Subject: a dimension, ``force``, ``cut`` or ``contact``.
        question: Question in the words of a person.
        answer: A whole sentence.
    """

    about: str
    question: str
    answer: str


_OPEN = {
    "shape": ("What shape touches the pad?", "Which shape is it?"),
    "texture": ("What is its surface like?", "Which texture does it have?"),
    "depth": ("How deep is it pressed?", "How far does it sink into the gel?"),
    "position": ("Where does it touch?", "In which part of the pad is the contact?"),
    "area": ("How large is the contact?", "How much of the pad is in contact?"),
}
_CLOSED = {
    "shape": "Is it {a}?",
    "texture": "Is its surface {word}?",
    "depth": "Is the press {word}?",
    "position": "Is the contact {word}?",
    "area": "Is the contact area {word}?",
}
UNTOUCHED = "Nothing touches the pad."


def question_answers(state: ContactState, sensor: SensorSpec, seed: int) -> list[QuestionAnswer]:
    """All questions that a contact's labels answer.

    There are no questions about unknown labels. Half of the yes/no questions are drawn to be
    answered yes; a no gives the true class. ``seed`` (``cltp.texts.paraphrases.text_seed``) draws
    wordings and yes/no questions.
    """
    answer = "Yes." if state.in_contact else f"No. {UNTOUCHED}"
    pairs = [QuestionAnswer("contact", "Does anything touch the pad?", answer)]
    if not state.in_contact:
        return pairs
    numbers = _in_numbers(state, sensor, tolerances(state, sensor))
    for slot in _OPEN:
        word = getattr(state, slot)
        if word is None:
            continue
        question = _OPEN[slot][draw_index(seed, slot, len(_OPEN[slot]))]
        pairs.append(QuestionAnswer(slot, question, numbers[slot]))
        suggested = word
        if draw_index(seed, f"{slot}?", 2):
            others = [other for other in DIMENSIONS[slot] if other != word]
            suggested = others[draw_index(seed, f"{slot} other", len(others))]
        truth = with_article(word) if slot == "shape" else word
        question = _CLOSED[slot].format(word=suggested, a=with_article(suggested))
        answer = "Yes." if suggested == word else f"No, it is {truth}."
        pairs.append(QuestionAnswer(slot, question, answer))
    if math.isfinite(state.force_n):
        pairs.append(QuestionAnswer("force", "How hard is it pressed?", numbers["force"]))
    sides = " and ".join(sorted(state.cut))
    answer = f"Yes, at the {sides}." if sides else "No, all of it is on the pad."
    question = "Does the contact run over the edge of the pad?"
    return [*pairs, QuestionAnswer("cut", question, answer)]


def _in_numbers(state: ContactState, sensor: SensorSpec, within: Tolerances) -> dict[str, str]:
    area_mm2 = state.area_fraction * sensor.area_mm2
    return {
        "shape": f"It is {with_article(str(state.shape))}.",
        "texture": f"It is {state.texture}.",
        "depth": f"The press is {state.depth}: {state.depth_mm:.2f} ± {within.depth_mm:.2f} mm.",
        "position": (
            f"It is {state.position}: x {state.x_mm:+.1f}, y {state.y_mm:+.1f} ± "
            f"{within.position_mm:.1f} mm."
        ),
        "area": f"The area is {state.area}: {area_mm2:.1f} ± {within.area_mm2:.1f} mm².",
        "force": f"With {state.force_n:.2f} ± {within.force_n:.2f} N.",
    }
