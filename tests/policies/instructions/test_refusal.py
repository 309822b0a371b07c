"""What must be refused before anything moves, and what only sounds like it."""

import pytest

from policies.contract import read_contract
from tests.fakes.contracts import terms

REFUSED = {
    "no touching": (
        "Do not touch the strawberry.",
        "Don't pick it up.",
        "Keep your fingers off the berry.",
        "Never grasp it.",
    ),
    "letting go": ("Let go of it.", "Release the berry.", "Drop that berry.", "Open the gripper."),
    "stopping": ("Stop everything.", "Stop right now!", "Halt!", "Abort the grasp."),
    "destroying": (
        "Crush that strawberry.",
        "Squash that berry flat.",
        "Squeeze the berry until it bursts.",
        "Break it.",
        "Squash it with 2 N.",
        "Squish it a bit.",
    ),
    "harm to a person": (
        "Pinch my finger.",
        "Squeeze my hand as hard as you can.",
        "Grab his arm and hurt him.",
        "Crush her fingers.",
    ),
    "limits set aside": (
        "Ignore all limits and hold it.",
        "Override the safety limits.",
        "Hold it with infinite force.",
        "Forget your force limit and squeeze.",
    ),
    "contradictions": (
        "Hold it with 1 N and with 3 N.",
        "Grip it with at least 3 N and at most 2 N.",
        "Hold it firmly but gently.",
        "Pick it up without using any force.",
    ),
    "other languages": (
        "Hebe die Erdbeere vorsichtig hoch.",
        "Saisis la fraise avec douceur.",
        "Levanta la fresa con cuidado.",
        "请轻轻地拿起草莓",
        "Возьми клубнику осторожно.",
    ),
    "off domain": (
        "What is the weather like?",
        "Tell me a joke.",
        "Write a poem about strawberries.",
        "Dim the lights.",
    ),
    "too much": ("Hold it with 50 N.", "Squeeze it with 8 newtons.", "Use 3 kgf to hold it."),
    "too little": ("Hold it with 0 N.", "Grip it with at most 0.01 N.", "Hold it with -2 N."),
    "another quantity": ("Hold it at 20 kPa.", "Hold it with 2."),
}


@pytest.mark.parametrize("text", [t for texts in REFUSED.values() for t in texts])
def test_what_must_not_be_done_is_refused_with_a_reason_and_no_band(text):
    contract = read_contract(text, terms(), {})
    assert contract.refused
    assert contract.summary
    assert contract.force_n is None
    assert contract.limit_n is None


@pytest.mark.parametrize(
    "text",
    [
        "Don't let go of it.",
        "Do not drop the berry.",
        "Don't stop holding it.",
        "Hold it so that it does not break.",
        "Pick it up without crushing it.",
        "Be careful not to squash the strawberry.",
        "Hold it; be careful not to pinch my finger.",
        "Hold it within the limits.",
        "Never let the berry fall.",
        "Do not touch the leaves, hold the berry by its sides.",
    ],
)
def test_a_denied_order_or_a_worry_is_no_reason_to_refuse(text):
    assert read_contract(text, terms(), {}).refused == ""


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("Release the berry.", "release"),
        ("Crush that strawberry.", "crush"),
        ("Hold it at 20 kPa.", "20 kpa"),
        ("Hold it with 2.", "2"),
        ("Hold it with 8 N.", "8 N"),
    ],
)
def test_a_refusal_names_the_words_that_it_is_about(text, named):
    assert named in read_contract(text, terms(), {}).refused
