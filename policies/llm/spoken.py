"""A contact as the model says it: words from its caption and of the heads, numbers of the heads.

Not here: reading such words back from a text (``policies.llm.parse``).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cltp.encoder.reader import most_probable_state, numbers_of, state_in_words
from cltp.llm.constrained.decode import DOUBT_BELOW, SlotDecision
from cltp.llm.generation import Felt, Reply, Talker
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import CLASSES, NO_CONTACT_STATE, ContactState
from policies.llm.grammar import NOTHING_TOUCHES, SURE, caption_grammar
from policies.llm.pooled_words import penalties, pooled
from policies.llm.text import CAPTION_REQUEST, caption_numbers, caption_text


class SpokenContact(NamedTuple):
    """What the model says of a contact.

    Attributes:
        state: The words that it says, and the numbers [mm, N, fraction].
        confidence: Probability of each word, by dimension; empty where nothing touches.
        ends: Ends of the interval of each number, by name; empty where nothing touches.
    """

    state: ContactState
    confidence: Mapping[str, float]
    ends: Mapping[str, tuple[float, float]]


def caption_reply(
    talker: Talker,
    felt: Felt,
    sensor: SensorSpec | None = None,
    *,
    doubt: bool = False,
    ranges: bool = False,
) -> Reply:
    """The model's caption of a contact, pooled with the heads' words, with their numbers and cuts.

    Args:
        talker: The model.
        felt: The contact as it feels it.
        sensor: The sensor; None for any.
        doubt: Whether a word that is in doubt is said with its rival.
        ranges: Whether a number that is not well known is said as its interval.
    """

    def say(state: ContactState, penalties: Mapping[str, float] | None = None) -> Reply:
        ends = _ends(felt, state) if ranges else {}
        numbers = caption_numbers(state, ends) if state.in_contact else {}
        cut = state.cut if state.in_contact else None
        return talker.reply_to(
            felt.touch,
            CAPTION_REQUEST,
            grammar=caption_grammar(sensor, numbers=numbers, cut=cut),
            draft=caption_text(state, ends=ends),
            doubt_below=None if doubt else SURE,
            penalties=penalties,
        )

    state = most_probable_state(felt.readings, sensor)
    reply = say(state)
    agreed = pooled(reply.slots, felt.readings)
    is_said = not any(
        _is_said_otherwise(reply.slots[name], one, doubt) for name, one in agreed.items()
    )
    words = {name: one.chosen for name, one in agreed.items()}
    if state.in_contact and words.keys() == CLASSES.keys():
        in_words = state_in_words(felt.readings, words, sensor)
        is_said, state = is_said and in_words == state, in_words
    if not is_said:
        reply = say(state, penalties(reply.slots, agreed))
    said = {
        name: replace(agreed[name], rival=own.rival)
        for name, own in reply.slots.items()
        if name in agreed and own.chosen == agreed[name].chosen
    }
    return replace(reply, slots={**reply.slots, **said})


def _ends(felt: Felt, state: ContactState) -> dict[str, tuple[float, float]]:
    """Ends of the interval of each number of a state, by name."""
    return {name: (low, high) for name, (_, low, high) in numbers_of(felt.readings, state).items()}


def _is_said_otherwise(own: SlotDecision, agreed: SlotDecision, doubt: bool) -> bool:
    """Whether a word that was said is not the pooled one, or its doubt is another."""
    is_doubtful = doubt and agreed.probability < DOUBT_BELOW
    return own.chosen != agreed.chosen or bool(own.rival) != is_doubtful


class CaptionSpeaker:
    """Captions without doubt, as evaluation reads them (``cltp.evaluation.llm_scores.Speaker``).

    Args:
        talker: The model.
    """

    def __init__(self, talker: Talker) -> None:
        self._talker = talker

    def caption(self, points: NDArray[np.float32]) -> str:
        """Describe one contact, points of shape (N, 3) scaled."""
        return caption_reply(self._talker, self._talker.feel(points)).text


def spoken_contact(talker: Talker, felt: Felt, sensor: SensorSpec | None = None) -> SpokenContact:
    """Have the model say what it feels.

    Args:
        talker: The model.
        felt: The contact as it feels it.
        sensor: The sensor; None for any.
    """
    reply = caption_reply(talker, felt, sensor)
    said = {name: slot for name, slot in reply.slots.items() if name in CLASSES}
    if any(slot.chosen == NOTHING_TOUCHES for slot in said.values()):
        return SpokenContact(NO_CONTACT_STATE, {}, {})
    words = {name: slot.chosen for name, slot in said.items()}
    state = state_in_words(felt.readings, words, sensor)
    confidence = {name: slot.probability for name, slot in said.items()}
    return SpokenContact(state, confidence, _ends(felt, state))
