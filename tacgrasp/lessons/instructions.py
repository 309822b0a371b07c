"""Instructions in many wordings, each with its goal, for training.

The four levels of firmness are the four tasks, whose goals are read from the task files. Goals
between them are named in newtons; a named force outweighs every word beside it. The words are in
``tacgrasp.lessons.instruction_words``, and the wordings kept out of training in
``tacgrasp.lessons.heldout_instructions``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources

import numpy as np

from cltp.tactile.states import ContactState
from policies.goal import Goal
from primitives.contract import Band
from tacgrasp.base.strict_yaml import read_yaml
from tacgrasp.config.schema import GoalConfig
from tacgrasp.lessons import instruction_words as wordings
from tacgrasp.lessons.instruction_words import Firmness

LEVELS = tuple(wordings.LEVELS)
"""Names of the tasks, from gentle to firm."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Instruction:
    """An instruction and its meaning.

    Attributes:
        text: Words of the instruction.
        goal: Numeric goal.
    """

    text: str
    goal: Goal


FORCE_RATIO = 1.44
"""A named force stands for a band from the force over this to the force times this, as in the
tasks."""

FORCES_N = (0.5, 7.0)
"""Range of forces that instructions name [N]."""


TAUGHT: Mapping[str, Mapping[str, tuple[float, float]]] = {
    "strawberry": {"force_n": (0.95, 1.9), "depth_mm": (0.03, 0.3), "area_share": (0.02, 0.8)},
    "peg": {"force_n": (3.6, 7.2), "depth_mm": (0.1, 0.8)},
}
"""Bands of a level that its task no longer has; the shipped weights were taught these. Words alone,
without a contact, mean a berry of 25 g."""


@lru_cache(maxsize=1)
def task_goals() -> dict[str, Goal]:
    """Goals of the four levels, read from the task files but for those of ``TAUGHT``."""
    goals = {}
    for level in LEVELS:
        text = (resources.files("tacgrasp") / "tasks" / f"{level}.yaml").read_text()
        bands = dict(read_yaml(text)["goal"].items()) | dict(TAUGHT.get(level, {}))
        goals[level] = GoalConfig.model_validate(bands).goal()
    return goals


def goal_of_force(low_n: float, high_n: float) -> Goal:
    """Goal of a force band; the other bands are interpolated between those of the tasks."""
    goals = sorted(task_goals().values(), key=lambda goal: goal.force_n.low)
    task_middles = [math.log(math.sqrt(g.force_n.low * g.force_n.high)) for g in goals]
    middle = math.log(math.sqrt(low_n * high_n))

    def interpolate(values: Sequence[float]) -> float:
        return float(np.interp(middle, task_middles, values))

    def band(name: str) -> Band:
        bands: list[Band] = [getattr(goal, name) for goal in goals]
        return Band(
            low=interpolate([b.low for b in bands]), high=interpolate([b.high for b in bands])
        )

    others = {name: band(name) for name in ("depth_mm", "area_fraction", "x_mm", "y_mm")}
    return Goal(force_n=Band(low=low_n, high=high_n), **others)


def draw_instruction(rng: np.random.Generator) -> Instruction:
    """Draw an instruction in words of one of the four levels, or with a force in newtons."""
    if rng.random() < 0.3:
        force = float(np.exp(rng.uniform(np.log(FORCES_N[0]), np.log(FORCES_N[1]))))
        return in_newtons(force, rng)
    return in_words(LEVELS[rng.integers(len(LEVELS))], rng)


def draw_instruction_near(state: ContactState, rng: np.random.Generator) -> Instruction:
    """Draw an instruction with a goal near the contact's force, so that the words decide."""
    force = float(np.clip(state.force_n * np.exp(rng.uniform(-1.0, 1.0)), *FORCES_N))
    if rng.random() < 0.4:
        return in_newtons(force, rng)
    middles = {
        level: math.log(math.sqrt(goal.force_n.low * goal.force_n.high))
        for level, goal in task_goals().items()
    }
    nearest = min(LEVELS, key=lambda level: abs(middles[level] - math.log(force)))
    return in_words(nearest, rng)


def in_words(level: str, rng: np.random.Generator) -> Instruction:
    """Draw a wording of a level; at least one part of it tells the level."""
    words = wordings.LEVELS[level]
    form = _FORMS[int(rng.choice(len(_FORMS), p=_FORM_PROBABILITIES))]
    return Instruction(text=_punctuate(form(words, rng), rng), goal=task_goals()[level])


def _request(words: Firmness, rng: np.random.Generator) -> str:
    """'Pick up the egg securely, it must not crack'."""
    named = rng.random() < 0.5
    noun = _noun_phrase(words, rng, named=named)
    manner = _draw(rng, *words.manners) if rng.random() < 0.7 else ""
    reason = _reason(words, rng) if rng.random() < 0.55 else ""
    if not (named or manner or reason):
        manner = _draw(rng, *words.manners)
    verb = _draw(rng, *wordings.VERBS)
    if manner and rng.random() < 0.25:
        text = f"{manner}, {verb} {noun}"
    else:
        text = f"{verb} {noun} {manner}".rstrip()
    return text + (_joint(rng) + reason if reason else "")


def _grip_statement(words: Firmness, rng: np.random.Generator) -> str:
    """'A firm grip on the bolt', 'Use little force', 'Be gentle with this'."""
    noun = _noun_phrase(words, rng, named=rng.random() < 0.4)
    grip = f"{_draw(rng, *words.grips)} {_draw(rng, *wordings.GRIPS)}"
    force = f"{_draw(rng, *words.forces)} {_draw(rng, 'force', 'pressure')}"
    text = _draw(
        rng,
        grip,
        f"{grip} on {noun}",
        f"{grip} is what {noun} needs",
        f"use {grip}",
        f"take {noun} with {grip}",
        f"{_draw(rng, *wordings.VERBS)} {noun} with {grip}",
        f"use {force}",
        f"{force} on {noun}",
        f"apply {force} to {noun}",
        f"be {_draw(rng, *words.attitudes)}",
        f"be {_draw(rng, *words.attitudes)} with {noun}",
        f"{_draw(rng, *words.manners)}",
        f"{_draw(rng, *words.manners)} now: {_draw(rng, *wordings.VERBS)} {noun}",
    )
    return text + (_joint(rng) + _reason(words, rng) if rng.random() < 0.45 else "")


def _object_statement(words: Firmness, rng: np.random.Generator) -> str:
    """'The egg cracks, so hold it securely', 'It must not slip'."""
    noun = _noun_phrase(words, rng, named=rng.random() < 0.5)
    statement = _draw(
        rng,
        f"{noun} {_draw(rng, *words.fates)}",
        f"{noun} is {_draw(rng, *words.properties)}",
        f"{noun} must not {_draw(rng, *words.dangers)}",
        f"{noun} mustn't {_draw(rng, *words.dangers)}",
        f"do not {_draw(rng, *words.prohibitions)}",
        f"don't {_draw(rng, *words.prohibitions)}",
        _draw(rng, *words.clauses),
    )
    if rng.random() < 0.25:
        return statement
    request = _draw(
        rng,
        f"{_draw(rng, *wordings.VERBS)} it {_draw(rng, *words.manners)}",
        f"use {_draw(rng, *words.grips)} {_draw(rng, *wordings.GRIPS)}",
        f"use {_draw(rng, *words.forces)} force",
        f"be {_draw(rng, *words.attitudes)}",
    )
    return statement + _draw(rng, ", so ", "; ", ": ", ". ", ", ") + request


_FORMS = (_request, _grip_statement, _object_statement)
_FORM_PROBABILITIES = (0.5, 0.27, 0.23)


def _reason(words: Firmness, rng: np.random.Generator) -> str:
    """A reason, as a clause after another one."""
    it = _draw(rng, "it", "it", "this", "this one")
    return _draw(
        rng,
        f"{it} {_draw(rng, *words.fates)}",
        f"{it} is {_draw(rng, *words.properties)}",
        f"{it} must not {_draw(rng, *words.dangers)}",
        f"it should not {_draw(rng, *words.dangers)}",
        f"do not {_draw(rng, *words.prohibitions)}",
        f"but do not {_draw(rng, *words.prohibitions)}",
        f"and don't {_draw(rng, *words.prohibitions)}",
        f"without {_draw(rng, *words.harms)}",
        _draw(rng, *words.clauses),
    )


def _noun_phrase(words: Firmness, rng: np.random.Generator, *, named: bool) -> str:
    if not named:
        return _draw(rng, *wordings.THINGS)
    return f"{_draw(rng, 'the', 'the', 'the', 'this', 'that')} {_draw(rng, *words.objects)}"


def _joint(rng: np.random.Generator) -> str:
    return _draw(rng, ", ", ", ", "; ", ": ", ". ", " - ")


def in_newtons(force_n: float, rng: np.random.Generator) -> Instruction:
    """Draw a wording with numbers for a goal around ``force_n``; it may name any object."""
    words = wordings.LEVELS[LEVELS[rng.integers(len(LEVELS))]]
    noun = _noun_phrase(words, rng, named=rng.random() < 0.5)
    low, high = round(force_n / FORCE_RATIO, 1), round(force_n * FORCE_RATIO, 1)
    about = round(math.sqrt(low * high), 1)
    wording = _draw(
        rng,
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
    )
    if "about" in wording or "around" in wording:
        low, high = round(about / FORCE_RATIO, 1), round(about * FORCE_RATIO, 1)
    text = f"{_draw(rng, *wordings.VERBS)} {noun} {wording}"
    if rng.random() < 0.3:
        text = f"{wording}, {_draw(rng, *wordings.VERBS)} {noun}"
    return Instruction(text=_punctuate(text, rng), goal=goal_of_force(low, high))


def _punctuate(text: str, rng: np.random.Generator) -> str:
    """Make a sentence: capitals or none, perhaps a polite word, perhaps a full stop."""
    if rng.random() < 0.2:
        text = f"{_draw(rng, *wordings.POLITE)} {text}"
    elif rng.random() < 0.1:
        text = f"{text}, please"
    parts = text.split(". ")
    text = ". ".join(f"{part[0].upper()}{part[1:]}" for part in parts)
    if rng.random() < 0.15:
        text = text.lower()
    return text + _draw(rng, ".", ".", ".", "", "!")


def _draw(rng: np.random.Generator, *choices: str) -> str:
    return choices[int(rng.integers(len(choices)))]
