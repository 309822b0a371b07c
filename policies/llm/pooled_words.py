"""Words of a contact out of what the model says and what the heads read, where both agree.

The model is shown the heads' readings, and yet forgets a part of them: its areas are right three
points less often than theirs, and its textures one. The mean of both logarithms is right as often
as the better of the two, and better calibrated. Where the model all but denies the word that the
heads read, it has its reasons in the touch tokens, and its own word stays.

Source: logarithmic opinion pools, Genest and Zidek, 'Combining Probability Distributions', 1986.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from cltp.encoder.readings import HeadReadings
from cltp.llm.constrained.decode import SlotDecision
from cltp.tactile.states import CLASSES

AGREED = 0.25
"""Probability that the model must give to the heads' word. Chosen on 880 contacts: with less, a
head that misreads is followed in more than three of ten contacts."""

LEAST = 1e-6
"""Probability that no word goes below."""


def pooled(slots: Mapping[str, SlotDecision], readings: HeadReadings) -> dict[str, SlotDecision]:
    """The decisions about words, pooled with the readings; those that were not made are left out.

    Args:
        slots: What the model decided, by the names of ``CLASSES`` among others.
        readings: What the heads read of the same contact, a batch of one.
    """
    return {
        name: _pooled(slots[name], dict(zip(names, chances[0].tolist(), strict=True)))
        for (name, names), chances in zip(CLASSES.items(), readings.words, strict=True)
        if name in slots and slots[name].chosen in names
    }


def penalties(
    slots: Mapping[str, SlotDecision], agreed: Mapping[str, SlotDecision]
) -> dict[str, float]:
    """What turns the model's probabilities into the pooled ones, by word; 0 for their best [nats].

    So a word loses nothing against what is no word, that nothing touches.
    """
    taken = {}
    for name, decision in agreed.items():
        own = _chances(slots[name], decision.probabilities)
        best = math.log(own[decision.chosen] / decision.probability)
        for word, chance in decision.probabilities.items():
            taken[word] = math.log(own[word] / chance) - best
    return taken


def _pooled(own: SlotDecision, read: Mapping[str, float]) -> SlotDecision:
    chances = _chances(own, read)
    if chances[max(read, key=lambda word: read[word])] < AGREED:
        return replace(own, probabilities=chances)
    weights = {word: math.sqrt(chances[word] * max(read[word], LEAST)) for word in read}
    total = sum(weights.values())
    chances = {word: weight / total for word, weight in weights.items()}
    chosen = max(chances, key=lambda word: chances[word])
    return replace(own, chosen=chosen, probability=chances[chosen], probabilities=chances)


def _chances(own: SlotDecision, words: Mapping[str, float]) -> dict[str, float]:
    """The model's probability of each word; those that it left aside together share theirs."""
    chances = dict.fromkeys(words, LEAST)
    for key, chance in own.probabilities.items():
        together = [word for word in key.split("|") if word in chances]
        for word in together:
            chances[word] = max(chance / len(together), LEAST)
    return chances
