"""Test cases whose right action depends on the instruction: pairs of goals, and paraphrases.

A pair is one contact of the test split under two instructions with different answers: the teacher,
on the true state, advises differently for their goals. A model that ignores the instruction is
right on at most one of the two.

Contacts are visited in an order drawn from the seed. For each, instructions are drawn as in
training (words of a task's level, or newtons) near the contact's force, until two of them disagree
in a way of ``QUOTAS`` that is not yet full. Goals differ in the firmness of the grip, not in the
position of the contact. So ``reset`` is never one of the two answers, and a move can disagree with
``decrease_force`` alone, which comes before it. The quotas therefore balance four kinds of answer,
a fifth to 30 % each: moves (equally in the four directions), ``increase_force``,
``decrease_force`` and none.

The answers of *clear* contacts stay the same when the contact changes a little (``MARGIN``), so
that sensor noise does not decide them. *Any* contacts are scored too, beside direct measurement.
"""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cltp.data.dataset import ContactDataset
from cltp.tactile.states import ContactState
from policies.goal import Goal
from policies.teacher import LESSON_MOVE_STEP_MM, Advice, teacher
from primitives import Primitive
from tacgrasp.lessons.heldout_instructions import PARAPHRASES
from tacgrasp.lessons.instructions import LEVELS, Instruction, draw_instruction_near, task_goals

NONE = "none"
MOVES = tuple(p.value for p in Primitive if p.value.startswith("move_"))
INCREASE, DECREASE = Primitive.INCREASE_FORCE.value, Primitive.DECREASE_FORCE.value

QUOTAS: dict[frozenset[str], float] = {
    **{frozenset({DECREASE, move}): 0.1 for move in MOVES},
    frozenset({INCREASE, NONE}): 0.4,
    frozenset({DECREASE, NONE}): 0.1,
    frozenset({DECREASE, INCREASE}): 0.1,
}
"""Fraction of the pairs by their two answers."""

MARGIN = 1.25
"""Factor of the force by which the answer of a clear contact stays the same; its root for depth and
area."""

MARGIN_MM = 0.7
"""Shift along x or y [mm] by which the answer of a clear contact stays the same."""

DRAWS = 40
"""Number of instructions drawn for one contact."""

NUM_OBJECTS = 4
"""Number of paraphrases of each level that name an object; they come first."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """One contact under one instruction.

    Attributes:
        index: Index of the contact in its data set.
        instruction: The instruction with its goal.
        answer: The right answer: a primitive's name, or ``NONE`` for success.
    """

    index: int
    instruction: Instruction
    answer: str


def answer_of(advice: Advice) -> str | None:
    """A primitive's name, ``NONE`` for success, None without either."""
    if advice.action is not None:
        return advice.action.value
    return NONE if advice.success else None


def choose_pairs(
    data: ContactDataset, num: int, *, clear: bool, seed: int = 0
) -> list[tuple[Case, Case]]:
    """Choose up to ``num`` pairs; fewer only when the data set has no more.

    Args:
        data: The test split.
        num: Number of pairs.
        clear: Whether to take clear contacts alone.
        seed: Random seed of the contacts and wordings.
    """
    rng = np.random.default_rng([seed, 2025])
    quotas = {kind: round(fraction * num) for kind, fraction in QUOTAS.items()}
    pairs: list[tuple[Case, Case]] = []
    for index in rng.permutation(len(data)).tolist():
        if not any(quotas.values()):
            break
        pair = _pair(data.state(index), index, quotas, clear, rng)
        if pair is not None:
            quotas[frozenset({pair[0].answer, pair[1].answer})] -= 1
            pairs.append(pair)
    return pairs


def _pair(
    state: ContactState,
    index: int,
    quotas: dict[frozenset[str], int],
    clear: bool,
    rng: np.random.Generator,
) -> tuple[Case, Case] | None:
    if not state.in_contact:
        return None
    cases: dict[str, Case] = {}
    for _ in range(DRAWS):
        instruction = draw_instruction_near(state, rng)
        answer = answer_for(state, instruction.goal, clear=clear)
        if answer is None or answer in cases:
            continue
        case = Case(index=index, instruction=instruction, answer=answer)
        for other in cases.values():
            if quotas.get(frozenset({answer, other.answer}), 0) > 0:
                return (case, other) if rng.random() < 0.5 else (other, case)
        cases[answer] = case
    return None


def choose_paraphrases(
    data: ContactDataset, per_wording: int, *, clear: bool, seed: int = 0
) -> list[tuple[Case, bool]]:
    """Choose contacts for every paraphrase, whose right action depends on the level.

    The possible answers of a level take turns, so that no single answer is right often. A contact
    is used again, under another wording, only when there are no more.

    Returns:
        Cases, each with whether its wording names an object.
    """
    rng = np.random.default_rng([seed, 2026])
    goals = task_goals()
    by_answer: dict[str, dict[str, list[int]]] = {level: {} for level in LEVELS}
    for index in rng.permutation(len(data)).tolist():
        state = data.state(index)
        answers = {level: answer_for(state, goals[level], clear=clear) for level in LEVELS}
        if len({answer for answer in answers.values() if answer is not None}) < 2:
            continue
        for level, answer in answers.items():
            if answer is not None:
                by_answer[level].setdefault(answer, []).append(index)
    cases = []
    for level, wordings in PARAPHRASES.items():
        contacts = itertools.cycle(_interleave(by_answer[level]))
        for number, text in enumerate(wordings):
            for answer, index in itertools.islice(contacts, per_wording):
                instruction = Instruction(text=text, goal=goals[level])
                case = Case(index=index, instruction=instruction, answer=answer)
                cases.append((case, number < NUM_OBJECTS))
    return cases


def _interleave(by_answer: dict[str, list[int]]) -> list[tuple[str, int]]:
    """Contacts of each answer in turn, where all moves count as one answer; each contact once."""
    rows = {name: [(name, index) for index in indices] for name, indices in by_answer.items()}
    others = [row for name, row in sorted(rows.items()) if name not in MOVES]
    return _alternate([*others, _alternate([rows[name] for name in MOVES if name in rows])])


def _alternate(rows: Sequence[Sequence[tuple[str, int]]]) -> list[tuple[str, int]]:
    """One item of each row, then the next of each, until all are used up."""
    return [item for items in itertools.zip_longest(*rows) for item in items if item is not None]


def answer_for(state: ContactState, goal: Goal, *, clear: bool) -> str | None:
    """The teacher's answer; None without one or, if ``clear``, where noise could change it."""
    answer = answer_of(teacher(state, goal, move_step_mm=LESSON_MOVE_STEP_MM))
    if answer is None or not clear or not state.in_contact:
        return answer
    nearby = {
        answer_of(teacher(near, goal, move_step_mm=LESSON_MOVE_STEP_MM))
        for near in _neighbours(state)
    }
    return answer if nearby == {answer} else None


def _neighbours(state: ContactState) -> Iterator[ContactState]:
    for factor in (1 / MARGIN, MARGIN):
        yield dataclasses.replace(
            state,
            force_n=state.force_n * factor,
            depth_mm=state.depth_mm * math.sqrt(factor),
            area_fraction=min(1.0, state.area_fraction * math.sqrt(factor)),
        )
    for along in ("x_mm", "y_mm"):
        for step in (-MARGIN_MM, MARGIN_MM):
            yield dataclasses.replace(state, **{along: getattr(state, along) + step})


def counts(cases: Sequence[Case]) -> dict[str, int]:
    """Number of cases by their right answer."""
    return dict(sorted(Counter(case.answer for case in cases).items()))


def fraction(right: NDArray[np.bool_]) -> float:
    """Fraction of True; NaN of an empty array."""
    return float(np.mean(right)) if len(right) else math.nan
