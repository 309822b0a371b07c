"""Prohibitions in every voice are refused as not touching; those of a manner or a way are not."""

import pytest

from policies.contract import read_contract
from tests.fakes.contracts import terms

PASSIVE = (
    "The egg must not be gripped.",
    "Should never be gripped.",
    "The egg is not to be held.",
    "The berry cannot be held.",
    "It must not, under any circumstances, be picked up.",
    "The berry must by no means be touched.",
    "The berry must be neither held nor lifted.",
    "It is not supposed to be grasped.",
    "Make sure it is not gripped.",
    "Keep the berry from being touched.",
    "I do not want the berry held.",
    "We don't want the egg to be picked up.",
    "The gripper must not be closed.",
    "Nothing may be gripped.",
    "It may only be looked at, not gripped.",
    "It must not be held any more.",
)
OF_A_NOUN = (
    "Gripping is forbidden.",
    "Gripping it is not allowed.",
    "Holding the berry is prohibited.",
    "Any contact is forbidden.",
    "Picking it up is out of the question.",
    "Gripping must be avoided.",
    "Grasping: forbidden.",
    "The grasp must not be performed.",
    "The berry is off limits.",
    "The strawberry is off-limits today, sorry.",
    "It has been declared off limits.",
    "This one is out of bounds.",
)
ACTIVE = (
    "By no means grip it.",
    "In no case hold it.",
    "At no time hold it.",
    "It is forbidden to hold it.",
    "You are forbidden to grip the berry.",
    "I forbid you to hold it.",
    "It is against the rules to hold it.",
    "Nobody may grip it.",
    "Refuse to grip it.",
    "Keep from gripping it.",
    "Instead of gripping it, wait.",
    "Do everything except grip it.",
    "Hold nothing.",
    "Touch none of them.",
    "Do not grip it until I say so.",
    "No finger may touch it.",
    "Don't take hold of the berry.",
    "It is undesirable to hold it.",
    "Hold it? No.",
    "Hold it? Please don't.",
)


@pytest.mark.parametrize("text", [*PASSIVE, *OF_A_NOUN, *ACTIVE])
def test_a_prohibition_in_any_voice_is_refused_as_not_touching(text):
    contract = read_contract(text, terms(), {})
    assert "not to touch" in contract.refused
    assert contract.force_n is None


@pytest.mark.parametrize(
    "text",
    [
        "It must not be squeezed too hard.",
        "It must not be gripped hard.",
        "I do not want the berry held too hard.",
        "The berry cannot be gripped too gently.",
        "It must not be held with more than 1 N.",
        "Gripping it with more than 1 N is forbidden.",
        "Hold the egg, it must not be dropped.",
        "Hold it so that it cannot fall.",
        "Grip it such that it cannot be pulled out.",
        "Hold it so that nobody can take it.",
        "Grip it, it cannot be held by hand.",
        "Hold the berry, the leaves must not be touched.",
        "It must not be squeezed, just held.",
        "Hold nothing but the berry.",
        "Instead of gripping it hard, hold it gently.",
        "Do not close before you touch it, then hold it with 1 N.",
        "Never refuse to grip it.",
        "Pick the strawberry which is not yet picked.",
        "Not just touched, it must be held.",
        "There is no reason not to grip it.",
        "By no means drop it.",
    ],
)
def test_what_forbids_a_manner_a_way_or_a_loss_is_no_prohibition_to_hold(text):
    assert read_contract(text, terms(), {}).refused == ""


@pytest.mark.parametrize(
    ("text", "is_refused"),
    [
        ("Leave the leaf alone, pick the berry", False),
        ("Hands off the leaf, grab the berry", False),
        ("Hold the berry without touching the stem", False),
        ("Leave the green one alone, take the red one", False),
        ("Leave the leaf alone", True),
        ("Leave the leaf alone, don't pick the berry", True),
        ("Leave the berry alone, pick the egg", True),
        ("Pick the berry without touching the berry", True),
    ],
)
def test_what_is_left_alone_may_be_another_thing(text, is_refused):
    assert bool(read_contract(text, terms(), {}).refused) is is_refused


@pytest.mark.parametrize(
    ("text", "softer"),
    [
        ("Holding it too hard is forbidden.", True),
        ("It is forbidden to squeeze it hard.", True),
        ("A firm grip is not allowed.", True),
        ("A soft grip is not allowed.", False),
    ],
)
def test_a_forbidden_manner_asks_for_the_other_one(text, softer):
    contract = read_contract(text, terms(), {})
    assert contract.force_n is not None
    assert (contract.force_n.middle < terms().force.force_n.middle) is softer
