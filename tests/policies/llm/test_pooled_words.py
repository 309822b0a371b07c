"""Words pooled out of the model's and the heads', and captions that say them."""

import math

import pytest
import torch

from cltp.encoder.readings import HeadReadings
from cltp.llm.constrained.decode import SlotDecision
from cltp.tactile.states import CLASSES
from policies.llm.pooled_words import penalties, pooled

AREAS = CLASSES["area"]


def decision(name, probabilities):
    chosen = max(probabilities, key=probabilities.get)
    return SlotDecision(
        name=name,
        chosen=chosen,
        probability=probabilities[chosen],
        rival="",
        probabilities=probabilities,
    )


def readings(area):
    """Readings that are even but for the area's probabilities."""
    words = [torch.full((1, len(names)), 1 / len(names)) for names in CLASSES.values()]
    words[list(CLASSES).index("area")] = torch.tensor([[area[word] for word in AREAS]])
    one = torch.ones(1)
    numbers = torch.zeros(1, 5)
    return HeadReadings(tuple(words), one, torch.zeros(1, 4), numbers, numbers, numbers)


def spread(**chances):
    rest = (1 - sum(chances.values())) / (len(AREAS) - len(chances))
    return {word: chances.get(word, rest) for word in AREAS}


def test_a_word_that_the_heads_read_surely_wins_over_a_near_call():
    own = decision("area", spread(small=0.5, medium=0.45))
    agreed = pooled({"area": own}, readings(spread(small=0.2, medium=0.78)))["area"]
    assert agreed.chosen == "medium"
    assert sum(agreed.probabilities.values()) == pytest.approx(1)
    assert agreed.probability == agreed.probabilities["medium"]
    ratio = agreed.probabilities["medium"] / agreed.probabilities["small"]
    assert ratio == pytest.approx(math.sqrt(0.45 * 0.78 / (0.5 * 0.2)))


def test_a_word_that_the_model_all_but_denies_is_not_taken_over():
    own = decision("area", spread(small=0.7, large=0.2))
    agreed = pooled({"area": own}, readings(spread(large=0.99)))["area"]
    assert (agreed.chosen, agreed.probability) == ("small", 0.7)


def test_words_that_were_left_aside_together_share_their_probability():
    own = decision("area", {"small": 0.6, "large|very large": 0.4})
    agreed = pooled({"area": own}, readings(spread(small=0.9)))["area"]
    assert agreed.probabilities["large"] == pytest.approx(agreed.probabilities["very large"])


def test_what_is_no_word_of_a_contact_is_left_alone():
    slots = {
        "texture": decision("texture", {"nothing": 0.9, "smooth": 0.1}),
        "depth_mm": decision("depth_mm", {"0.31": 1.0}),
    }
    assert pooled(slots, readings(spread())) == {}


def test_penalties_make_the_pooled_word_the_likeliest_and_cost_it_nothing():
    own = decision("area", spread(small=0.5, medium=0.45))
    slots = {"area": own}
    agreed = pooled(slots, readings(spread(small=0.2, medium=0.78)))
    taken = penalties(slots, agreed)
    assert taken["medium"] == 0
    logits = {word: math.log(chance) - taken[word] for word, chance in own.probabilities.items()}
    total = sum(math.exp(logit) for logit in logits.values())
    for word, chance in agreed["area"].probabilities.items():
        assert math.exp(logits[word]) / total == pytest.approx(chance)
