"""Instructions as a person may word them, each with the goal it stands for; for training.

Four levels of firmness are the four tasks (their goals are read from the task files). Between them
lie goals that an instruction names in newtons; a named force counts more than any word beside it.
The words are in ``tacgrasp.lessons.instruction_words``, the sentences here. Wordings that are kept
out of training are in ``tacgrasp.lessons.heldout_instructions``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources

import numpy as np
import yaml

from cltp.tactile.states import ContactState
from policies.goal import Band, Goal
from tacgrasp.config.schema import GoalConfig
from tacgrasp.lessons import instruction_words as wordings
from tacgrasp.lessons.instruction_words import Firmness

LEVELS = tuple(wordings.LEVELS)
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
        area_fraction=band("area_fraction"),
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
    """A wording of a level; every one says at least one thing that tells the level."""
    words = wordings.LEVELS[level]
    form = _FORMS[int(rng.choice(len(_FORMS), p=_FORM_SHARES))]
    return Instruction(text=_dressed(form(words, rng), rng), goal=task_goals()[level])


def _asked(words: Firmness, rng: np.random.Generator) -> str:
    """'Pick up the egg securely, it must not crack'."""
    named = rng.random() < 0.5
    thing = _thing(words, rng, named=named)
    manner = _one(words.manners, rng) if rng.random() < 0.7 else ""
    because = _because(words, rng) if rng.random() < 0.55 else ""
    if not (named or manner or because):
        manner = _one(words.manners, rng)
    verb = _one(wordings.VERBS, rng)
    if manner and rng.random() < 0.25:
        text = f"{manner}, {verb} {thing}"
    else:
        text = f"{verb} {thing} {manner}".rstrip()
    return text + (_joint(rng) + because if because else "")


def _of_the_grip(words: Firmness, rng: np.random.Generator) -> str:
    """'A firm grip on the bolt', 'Use little force', 'Be gentle with this'."""
    thing = _thing(words, rng, named=rng.random() < 0.4)
    grip = f"{_one(words.grips, rng)} {_one(wordings.GRIPS, rng)}"
    force = f"{_one(words.forces, rng)} {_one(('force', 'pressure'), rng)}"
    text = _one(
        (
            grip,
            f"{grip} on {thing}",
            f"{grip} is what {thing} needs",
            f"use {grip}",
            f"take {thing} with {grip}",
            f"{_one(wordings.VERBS, rng)} {thing} with {grip}",
            f"use {force}",
            f"{force} on {thing}",
            f"apply {force} to {thing}",
            f"be {_one(words.be, rng)}",
            f"be {_one(words.be, rng)} with {thing}",
            f"{_one(words.manners, rng)}",
            f"{_one(words.manners, rng)} now: {_one(wordings.VERBS, rng)} {thing}",
        ),
        rng,
    )
    return text + (_joint(rng) + _because(words, rng) if rng.random() < 0.45 else "")


def _of_the_object(words: Firmness, rng: np.random.Generator) -> str:
    """'The egg cracks, so hold it securely', 'It must not slip'."""
    thing = _thing(words, rng, named=rng.random() < 0.5)
    about = _one(
        (
            f"{thing} {_one(words.fates, rng)}",
            f"{thing} is {_one(words.likes, rng)}",
            f"{thing} must not {_one(words.nots, rng)}",
            f"{thing} mustn't {_one(words.nots, rng)}",
            f"do not {_one(words.bans, rng)}",
            f"don't {_one(words.bans, rng)}",
            _one(words.ends, rng),
        ),
        rng,
    )
    if rng.random() < 0.25:
        return about
    then = _one(
        (
            f"{_one(wordings.VERBS, rng)} it {_one(words.manners, rng)}",
            f"use {_one(words.grips, rng)} {_one(wordings.GRIPS, rng)}",
            f"use {_one(words.forces, rng)} force",
            f"be {_one(words.be, rng)}",
        ),
        rng,
    )
    return about + _one((", so ", "; ", ": ", ". ", ", "), rng) + then


_FORMS = (_asked, _of_the_grip, _of_the_object)
_FORM_SHARES = (0.5, 0.27, 0.23)


def _because(words: Firmness, rng: np.random.Generator) -> str:
    """A reason, as a clause that stands behind another."""
    it = _one(("it", "it", "this", "this one"), rng)
    return _one(
        (
            f"{it} {_one(words.fates, rng)}",
            f"{it} is {_one(words.likes, rng)}",
            f"{it} must not {_one(words.nots, rng)}",
            f"it should not {_one(words.nots, rng)}",
            f"do not {_one(words.bans, rng)}",
            f"but do not {_one(words.bans, rng)}",
            f"and don't {_one(words.bans, rng)}",
            f"without {_one(words.withouts, rng)}",
            _one(words.ends, rng),
        ),
        rng,
    )


def _thing(words: Firmness, rng: np.random.Generator, *, named: bool) -> str:
    if not named:
        return _one(wordings.THINGS, rng)
    return f"{_one(('the', 'the', 'the', 'this', 'that'), rng)} {_one(words.objects, rng)}"


def _joint(rng: np.random.Generator) -> str:
    return _one((", ", ", ", "; ", ": ", ". ", " - "), rng)


def in_newtons(force_n: float, rng: np.random.Generator) -> Instruction:
    """A wording with numbers, for a goal around ``force_n``; any object may be named with it."""
    words = wordings.LEVELS[LEVELS[rng.integers(len(LEVELS))]]
    thing = _thing(words, rng, named=rng.random() < 0.5)
    low, high = round(force_n / FORCE_RATIO, 1), round(force_n * FORCE_RATIO, 1)
    about = round(math.sqrt(low * high), 1)
    wording = _one(
        (
            f"with {low:.1f} to {high:.1f} N",
            f"using {low:.1f} - {high:.1f} N of force",
            f"with no less than {low:.1f} and no more than {high:.1f} N",
            f"with a force between {low:.1f} and {high:.1f} N",
            f"with {low:.1f}-{high:.1f} newtons",
            f"with about {about:.1f} N",
            f"with a grip of about {about:.1f} N",
            f"at about {about:.1f} N of force",
            f"at around {about:.1f} newtons",
            f"so that the force is about {about:.1f} N",
        ),
        rng,
    )
    if "about" in wording or "around" in wording:
        low, high = round(about / FORCE_RATIO, 1), round(about * FORCE_RATIO, 1)
    text = f"{_one(wordings.VERBS, rng)} {thing} {wording}"
    if rng.random() < 0.3:
        text = f"{wording}, {_one(wordings.VERBS, rng)} {thing}"
    return Instruction(text=_dressed(text, rng), goal=goal_of_force(low, high))


def _dressed(text: str, rng: np.random.Generator) -> str:
    """A sentence: first letters large, or nothing large; with a polite word, a stop, or not."""
    if rng.random() < 0.2:
        text = f"{_one(wordings.POLITE, rng)} {text}"
    elif rng.random() < 0.1:
        text = f"{text}, please"
    parts = text.split(". ")
    text = ". ".join(f"{part[0].upper()}{part[1:]}" for part in parts)
    if rng.random() < 0.15:
        text = text.lower()
    return text + _one((".", ".", ".", "", "!"), rng)


def _one(choices: Sequence[str], rng: np.random.Generator) -> str:
    return choices[int(rng.integers(len(choices)))]
