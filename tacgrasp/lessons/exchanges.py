"""Exchanges that teach the language model: captions, advice, and the queries of questions.

Advice is D_t (``policies.llm``): a target stands in the request, ``policies.teacher`` advises on
the contact for it, and the reply is what the model learns. ``cltp.train`` receives texts and knows
no targets. The paper's caption is the reply to a request for a description.

Words are learned from the truth, numbers as the encoder's heads read them (the reason is in
``cltp.train.llm``). Advice follows from the numbers that are said, so that a reply does not
contradict itself.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cltp.texts.exchange_packing import Exchange
from cltp.texts.told import ToldContact
from policies.llm.text import (
    advice_text,
    caption_text,
    contact_text,
    goal_text,
    said_numbers,
    step_request,
)
from policies.teacher import LESSON_MOVE_STEP_MM, force_goal, teacher
from primitives.contract import Band
from tacgrasp.lessons.captions import CAPTION_REQUESTS
from tacgrasp.lessons.dialogue.patterns.family import word_lists
from tacgrasp.lessons.question_draws import query_exchange

CAPTIONS = 0.3
"""Fraction of contacts that are also captioned."""

TARGETS_N = (0.1, 10.0)
"""Range of the middles of targets [N]."""

RATIOS = (1.03, 4.0)
"""Range of the ends of targets over their middles. Source: a step's target has 1.1, the tasks'
bands 1.4, the band of all berries 4."""

BLIND = "Do what is needed."
"""What the instruction-blind control is asked instead of a target."""


def caption_exchange(felt: ToldContact, rng: np.random.Generator) -> Exchange:
    """A request for a description, and the caption with its numbers."""
    request = CAPTION_REQUESTS[rng.integers(len(CAPTION_REQUESTS))]
    return Exchange(prompt=request, reply=caption_text(felt.state, felt.rivals))


def draw_target(force_n: float, rng: np.random.Generator) -> tuple[Band, float]:
    """A target, mostly near a force so that the two must be compared, and the limit above it."""
    low, high = np.log(TARGETS_N)
    middle = float(np.exp(rng.uniform(low, high)))
    if force_n > 0 and rng.random() < 0.75:
        middle = float(np.clip(force_n * np.exp(rng.normal(scale=0.6)), *TARGETS_N))
    ratio = float(np.exp(rng.beta(1.0, 3.0) * np.log(RATIOS[1] / RATIOS[0]))) * RATIOS[0]
    band = Band(low=round(middle / ratio, 2), high=round(middle * ratio, 2))
    return band, round(band.high * float(rng.uniform(1.0, 1.6)), 2)


def advice_reply(felt: ToldContact, force_n: Band) -> str:
    """D_t for a contact and a target; ``policies.extraction`` reads the advice back from it."""
    advice = teacher(felt.state, force_goal(force_n), move_step_mm=LESSON_MOVE_STEP_MM)
    said = said_numbers(felt.state, felt.ends)
    contact = contact_text(felt.state, said, felt.rivals)
    return f"{contact} {goal_text(force_n)} {advice_text(advice)}"


def advice_exchange(felt: ToldContact, rng: np.random.Generator, *, blind: bool) -> Exchange:
    """A step: the request for a drawn target, and D_t."""
    band, limit_n = draw_target(felt.state.force_n, rng)
    prompt = BLIND if blind else step_request(band, limit_n)
    return Exchange(prompt=prompt, reply=advice_reply(felt, band))


def known_words() -> list[str]:
    """Words that become one token each: those that a person's question may be about."""
    entries = (entry for entries in word_lists().values() for entry in entries)
    words = {word for entry in entries for word in entry.split()}
    return sorted(word for word in words if word.isalpha())


class TouchLessons:
    """All exchanges about a contact, as ``cltp.train.llm.Lessons``; deterministic in the generator.

    Args:
        blind: Whether every target is replaced by ``BLIND``: the control, whose model can't know
            it.
        num_advice: Targets, and so pieces of advice, for each contact. The touch tokens, which they
            share, cost the most.
    """

    def __init__(self, *, blind: bool = False, num_advice: int = 4) -> None:
        self._blind, self._num_advice = blind, num_advice

    def captions(self, felt: ToldContact, rng: np.random.Generator) -> Sequence[Exchange]:
        return [caption_exchange(felt, rng)]

    def mixed(self, felt: ToldContact, rng: np.random.Generator) -> Sequence[Exchange]:
        """A caption for some, and advice for several targets."""
        captions = [caption_exchange(felt, rng)] if rng.random() < CAPTIONS else []
        advice = [advice_exchange(felt, rng, blind=self._blind) for _ in range(self._num_advice)]
        return [*captions, *advice]

    def questions(self, num: int, rng: np.random.Generator) -> Sequence[Exchange]:
        """Questions in plain words, and their queries."""
        return [query_exchange(rng) for _ in range(num)]
