"""Questions about a stored contact and answers from its labels: words, numbers, yes and no.

For data sets and benchmarks. Every pair is derived when asked for, from the contact and a seed.

Not here: the questions that the language model is taught (``tacgrasp.lessons.questions``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import DIMENSIONS, ContactState
from cltp.texts.paraphrases import drawn, with_article
from cltp.texts.tolerances import Tolerances, tolerances


@dataclass(frozen=True, slots=True, kw_only=True)
class QuestionAnswer:
    """A question and its answer.

    Attributes:
        about: What is asked for: a slot, ``force``, ``cut`` or ``contact``.
        question: As a person asks.
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


def question_answers(
    state: ContactState, sensor: SensorSpec, seed: int, *, level: float = 1.0
) -> list[QuestionAnswer]:
    """All questions that a contact's labels answer.

    What nobody named or measured is not asked for. Of the yes/no questions, half are drawn to be
    answered yes; a no says what is the case.

    Args:
        state: The labels.
        sensor: Whose field it is.
        seed: Draws wordings and yes/no questions, as ``cltp.texts.paraphrases.text_seed``.
        level: Of the noise whose tolerances answers in numbers carry.
    """
    touched = QuestionAnswer(
        about="contact",
        question="Does anything touch the pad?",
        answer="Yes." if state.in_contact else f"No. {UNTOUCHED}",
    )
    if not state.in_contact:
        return [touched]
    pairs = [touched]
    numbers = _in_numbers(state, sensor, tolerances(state, sensor, level))
    for slot in _OPEN:
        word = getattr(state, slot)
        if word is None:
            continue
        wording = _OPEN[slot][drawn(seed, slot, len(_OPEN[slot]))]
        pairs.append(QuestionAnswer(about=slot, question=wording, answer=numbers[slot]))
        pairs.append(_yes_or_no(slot, word, seed))
    if math.isfinite(state.force_n):
        pairs.append(
            QuestionAnswer(
                about="force", question="How hard is it pressed?", answer=numbers["force"]
            )
        )
    sides = " and ".join(sorted(state.cut))
    pairs.append(
        QuestionAnswer(
            about="cut",
            question="Does the contact run over the edge of the pad?",
            answer=f"Yes, at the {sides}." if sides else "No, all of it is on the pad.",
        )
    )
    return pairs


def _in_numbers(state: ContactState, sensor: SensorSpec, within: Tolerances) -> dict[str, str]:
    area_mm2 = state.area_fraction * sensor.area_mm2
    return {
        "shape": f"It is {with_article(str(state.shape))}.",
        "texture": f"It is {state.texture}.",
        "depth": f"The press is {state.depth}: {state.depth_mm:.2f} ± {within.depth_mm:.2f} mm.",
        "position": (
            f"It is {state.position}: x {state.x_mm:+.1f}, y {state.y_mm:+.1f} ± "
            f"{within.place_mm:.1f} mm."
        ),
        "area": f"The area is {state.area}: {area_mm2:.1f} ± {within.area_mm2:.1f} mm².",
        "force": f"With {state.force_n:.2f} ± {within.force_n:.2f} N.",
    }


def _yes_or_no(slot: str, word: str, seed: int) -> QuestionAnswer:
    asked = word
    if drawn(seed, f"{slot}?", 2):
        others = [other for other in DIMENSIONS[slot] if other != word]
        asked = others[drawn(seed, f"{slot} other", len(others))]
    said = with_article(word) if slot == "shape" else word
    return QuestionAnswer(
        about=slot,
        question=_CLOSED[slot].format(word=asked, a=with_article(asked)),
        answer="Yes." if asked == word else f"No, it is {said}.",
    )
