"""A contact as the model says it: words from its caption, numbers as the heads read them.

Not here: reading such words back from a text (``policies.llm.parse``).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from cltp.encoder.reader import state_in_words
from cltp.llm.generation import Felt, Talker
from cltp.tactile.sensors import SensorSpec
from cltp.tactile.states import CLASSES, NO_CONTACT_STATE, ContactState
from policies.llm.grammar import NOTHING_TOUCHES, SURE, caption_grammar
from policies.llm.text import CAPTION_REQUEST


class SpokenContact(NamedTuple):
    """What the model says of a contact.

    Attributes:
        state: The words that it says, and the numbers [mm, N, fraction].
        confidence: Probability of each word, by dimension; empty where nothing touches.
    """

    state: ContactState
    confidence: Mapping[str, float]


def spoken_contact(talker: Talker, felt: Felt, sensor: SensorSpec | None = None) -> SpokenContact:
    """Have the model say what it feels.

    Args:
        talker: The model.
        felt: The contact as it feels it.
        sensor: The sensor; None for any.
    """
    grammar = caption_grammar(sensor)
    reply = talker.reply_to(felt.touch, CAPTION_REQUEST, grammar=grammar, doubt_below=SURE)
    said = {name: slot for name, slot in reply.slots.items() if name in CLASSES}
    if any(slot.chosen == NOTHING_TOUCHES for slot in said.values()):
        return SpokenContact(NO_CONTACT_STATE, {})
    words = {name: slot.chosen for name, slot in said.items()}
    state = state_in_words(felt.readings, words)
    return SpokenContact(state, {name: slot.probability for name, slot in said.items()})
