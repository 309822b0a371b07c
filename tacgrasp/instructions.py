"""Instructions as a person may word them, each with the goal it stands for; for training.

Four levels of firmness are the four tasks (their goals are read from the task files). Between them
lie goals that an instruction names in newtons; a named force counts more than any word beside it.
Wordings that are kept out of training are in ``tacgrasp.paraphrases``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources

import numpy as np
import yaml

from cltp.states import ContactState
from policies.goal import Band, Goal
from tacgrasp.config import GoalConfig

LEVELS = ("cherry_tomato", "strawberry", "egg", "peg")
"""Gentle to firm."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Instruction:
    """What a person says, and what it means.

    Attributes:
        text: The words.
        goal: The goal in numbers.
    """

    text: str
    goal: Goal


OBJECTS: dict[str, tuple[str, ...]] = {
    "cherry_tomato": ("cherry tomato", "tomato", "raspberry", "blackberry", "grape", "blueberry"),
    "strawberry": ("strawberry", "berry", "ripe strawberry", "apricot", "fig", "ripe fruit"),
    "egg": ("egg", "raw egg", "hen's egg", "light bulb", "wine glass", "eggshell"),
    "peg": ("peg", "metal peg", "bolt", "steel rod", "screwdriver", "hammer"),
}
MANNERS: dict[str, tuple[str, ...]] = {
    "cherry_tomato": (
        "very gently",
        "extremely gently",
        "with the lightest touch",
        "as softly as you can",
        "very softly",
        "with hardly any force",
        "with very little force",
        "barely squeezing it",
        "very lightly",
        "ever so gently",
    ),
    "strawberry": (
        "gently",
        "softly",
        "with care",
        "with a soft grip",
        "delicately",
        "with a gentle grip",
        "tenderly",
        "with little force",
        "with a light hand",
        "without squeezing hard",
    ),
    "egg": (
        "securely",
        "safely",
        "with a secure but careful grip",
        "reliably, but not too hard",
        "with moderate force",
        "with a medium grip",
        "steadily and carefully",
        "not too hard and not too loosely",
        "with a safe hold",
        "fairly firmly, but with care",
    ),
    "peg": (
        "firmly",
        "tightly",
        "with a strong grip",
        "with plenty of force",
        "hard",
        "as firmly as you can",
        "with a tight grip",
        "very firmly",
        "strongly",
        "with high force",
    ),
}
REASONS: dict[str, tuple[str, ...]] = {
    "cherry_tomato": (
        "it splits easily",
        "it bursts at the slightest pressure",
        "its skin is very thin",
        "it is very fragile and light",
        "the least pressure will burst it",
    ),
    "strawberry": (
        "without bruising it",
        "it bruises easily",
        "do not leave marks on it",
        "it is soft and ripe",
        "do not bruise it",
        "it must not get bruised",
        "do not squash it",
    ),
    "egg": (
        "do not crack it",
        "but do not crack it",
        "it must neither crack nor fall",
        "it is heavy but brittle",
        "the shell must not break",
        "without breaking it",
        "do not drop it and do not break it",
    ),
    "peg": (
        "so that it does not turn when it is inserted",
        "it must not slip",
        "so that it can not turn",
        "it is hard and can not be damaged",
        "it must not rotate in the fingers",
        "nothing can break",
        "it has to withstand a push",
    ),
}
VERBS = ("Pick", "Pick up", "Grasp", "Grip", "Hold", "Lift", "Take", "Grab", "Seize", "Pick up")
THINGS = ("it", "the object", "this", "the thing", "what you feel", "this object", "the item")
POLITE = ("Please", "Now", "Could you", "I want you to", "Carefully:", "Next,", "Robot,", "Okay,")

FORCE_RATIO = 1.44
"""A goal between the tasks reaches from its force over this to its force times this, as theirs."""

FORCES_N = (0.5, 7.0)
"""Forces that instructions name [N]."""


@lru_cache(maxsize=1)
def task_goals() -> dict[str, Goal]:
    """Goals of the four levels, from the task files."""
    goals = {}
    for level in LEVELS:
        text = (resources.files("tacgrasp") / "tasks" / f"{level}.yaml").read_text()
        goals[level] = GoalConfig(**_pairs(yaml.safe_load(text)["goal"])).goal()
    return goals


def _pairs(section: dict[str, list[float]]) -> dict[str, tuple[float, float]]:
    return {name: (float(low), float(high)) for name, (low, high) in section.items()}


def goal_of_force(low_n: float, high_n: float) -> Goal:
    """The goal that a force band stands for; its other bands lie between those of the tasks."""
    goals = sorted(task_goals().values(), key=lambda goal: goal.force_n.low)
    middle = [math.log(math.sqrt(g.force_n.low * g.force_n.high)) for g in goals]
    at = math.log(math.sqrt(low_n * high_n))

    def between(values: Sequence[float]) -> float:
        return float(np.interp(at, middle, values))

    def band(name: str) -> Band:
        bands: list[Band] = [getattr(goal, name) for goal in goals]
        return Band(low=between([b.low for b in bands]), high=between([b.high for b in bands]))

    return Goal(
        force_n=Band(low=low_n, high=high_n),
        depth_mm=band("depth_mm"),
        area_share=band("area_share"),
        x_mm=band("x_mm"),
        y_mm=band("y_mm"),
    )


def draw_instruction(rng: np.random.Generator) -> Instruction:
    """An instruction in words of one of the four levels, or with a force in newtons."""
    if rng.random() < 0.3:
        force = float(np.exp(rng.uniform(np.log(FORCES_N[0]), np.log(FORCES_N[1]))))
        return in_newtons(force, rng)
    return in_words(LEVELS[rng.integers(len(LEVELS))], rng)


def draw_instruction_near(state: ContactState, rng: np.random.Generator) -> Instruction:
    """An instruction whose goal lies near the contact's force, so that its words decide."""
    force = float(np.clip(state.force_n * np.exp(rng.uniform(-1.0, 1.0)), *FORCES_N))
    if rng.random() < 0.4:
        return in_newtons(force, rng)
    middles = {
        level: math.log(math.sqrt(goal.force_n.low * goal.force_n.high))
        for level, goal in task_goals().items()
    }
    near = min(LEVELS, key=lambda level: abs(middles[level] - math.log(force)))
    return in_words(near, rng)


def in_words(level: str, rng: np.random.Generator) -> Instruction:
    """A wording of a level: an object, a manner, a reason; at least one that tells the level."""
    named = rng.random() < 0.5
    thing = f"the {_one(OBJECTS[level], rng)}" if named else _one(THINGS, rng)
    manner = _one(MANNERS[level], rng) if rng.random() < 0.75 else ""
    reason = _one(REASONS[level], rng) if rng.random() < 0.6 else ""
    if not (named or manner or reason):
        manner = _one(MANNERS[level], rng)
    if manner and rng.random() < 0.25:
        text = f"{manner[0].upper()}{manner[1:]}, {_one(VERBS, rng).lower()} {thing}"
    elif manner:
        text = f"{_one(VERBS, rng)} {thing} {manner}"
    else:
        text = f"{_one(VERBS, rng)} {thing}"
    if reason:
        text += _one((", ", "; ", ": ", ". ", " because "), rng) + reason
    return Instruction(text=_dressed(text, rng), goal=task_goals()[level])


def in_newtons(force_n: float, rng: np.random.Generator) -> Instruction:
    """A wording with numbers, for a goal around ``force_n``; any object may be named with it."""
    level = LEVELS[rng.integers(len(LEVELS))]
    thing = f"the {_one(OBJECTS[level], rng)}" if rng.random() < 0.5 else _one(THINGS, rng)
    low, high = round(force_n / FORCE_RATIO, 1), round(force_n * FORCE_RATIO, 1)
    about = round(math.sqrt(low * high), 1)
    wording = _one(
        (
            f"with {low:.1f} to {high:.1f} N",
            f"with a force between {low:.1f} and {high:.1f} N",
            f"with {low:.1f}-{high:.1f} newtons",
            f"with about {about:.1f} N",
            f"at around {about:.1f} newtons",
            f"so that the force is about {about:.1f} N",
        ),
        rng,
    )
    if "about" in wording or "around" in wording:
        low, high = round(about / FORCE_RATIO, 1), round(about * FORCE_RATIO, 1)
    text = f"{_one(VERBS, rng)} {thing} {wording}"
    return Instruction(text=_dressed(text, rng), goal=goal_of_force(low, high))


def _dressed(text: str, rng: np.random.Generator) -> str:
    if rng.random() < 0.2:
        text = f"{_one(POLITE, rng)} {text[0].lower()}{text[1:]}"
    if rng.random() < 0.15:
        text = text.lower()
    return text + _one((".", ".", ".", "", "!"), rng)


def _one(choices: Sequence[str], rng: np.random.Generator) -> str:
    return choices[int(rng.integers(len(choices)))]
