"""Contacts whose right action hangs on the instruction: pairs of goals, and paraphrases.

A pair is one unseen contact under two instructions whose goals disagree on it: the teacher's
answers, on the true state, differ. Whoever does not read the instruction is right on at most one
of the two.

How pairs are chosen: contacts of the test split are gone through in an order drawn from the seed.
For each, instructions are drawn as for training (words of a task's level, or newtons) near the
contact's force, until two of them disagree in a way of ``QUOTAS`` that has room. Goals differ in
how firm the grip may be, not in where the contact should be: so ``reset`` is never one of two
answers, and a move only ever disagrees with ``decrease_force``, which comes before it. The quotas
therefore balance four kinds of answer, a fifth to 30 % each: moves (the four directions alike),
``increase_force``, ``decrease_force`` and none.

*Clear* contacts have answers that hold when the contact is a little otherwise (``MARGIN``): there
the sensor's noise does not decide. All of them (*any*) are scored, too, beside direct measurement.
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
"""Share of the pairs by their two answers."""

MARGIN = 1.25
"""Answers of clear contacts hold when force, depth and area are this much larger or smaller."""

MARGIN_MM = 0.7
"""... and when the contact lies so much further along x or y [mm]."""

DRAWS = 40
"""Instructions drawn for a contact before the next one is tried."""

NUM_OBJECTS = 4
"""The first paraphrases of each level name an object, the others do not."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """One contact under one instruction.

    Attributes:
        index: The contact in its data set.
        instruction: What is asked, with its goal.
        answer: What is right: a primitive's name, or ``NONE`` for success.
    """

    index: int
    instruction: Instruction
    answer: str


def answer_of(advice: Advice) -> str | None:
    """A primitive's name, ``NONE`` for success, None where the teacher knows no way."""
    if advice.action is not None:
        return advice.action.value
    return NONE if advice.success else None


def choose_pairs(
    data: ContactDataset, num: int, *, clear: bool, seed: int = 0
) -> list[tuple[Case, Case]]:
    """Up to ``num`` pairs; fewer only when the data set has no more.

    Args:
        data: The test split.
        num: How many.
        clear: Only contacts whose answers hold within the margin.
        seed: Of contacts and wordings.
    """
    rng = np.random.default_rng([seed, 2025])
    room = {kind: round(share * num) for kind, share in QUOTAS.items()}
    pairs: list[tuple[Case, Case]] = []
    for index in rng.permutation(len(data)).tolist():
        if not any(room.values()):
            break
        pair = _pair(data.state(index), index, room, clear, rng)
        if pair is not None:
            room[frozenset({pair[0].answer, pair[1].answer})] -= 1
            pairs.append(pair)
    return pairs


def _pair(
    state: ContactState,
    index: int,
    room: dict[frozenset[str], int],
    clear: bool,
    rng: np.random.Generator,
) -> tuple[Case, Case] | None:
    if not state.in_contact:
        return None
    seen: dict[str, Case] = {}
    for _ in range(DRAWS):
        drawn = draw_instruction_near(state, rng)
        answer = answer_for(state, drawn.goal, clear=clear)
        if answer is None or answer in seen:
            continue
        case = Case(index=index, instruction=drawn, answer=answer)
        for other in seen.values():
            if room.get(frozenset({answer, other.answer}), 0) > 0:
                return (case, other) if rng.random() < 0.5 else (other, case)
        seen[answer] = case
    return None


def choose_paraphrases(
    data: ContactDataset, per_wording: int, *, clear: bool, seed: int = 0
) -> list[tuple[Case, bool]]:
    """Every paraphrase on contacts whose right action depends on the level.

    The answers that a level can have take turns, so that one answer to everything is not right
    often; contacts come again, under other wordings, only when there are no more.

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
        contacts = itertools.cycle(_in_turns(by_answer[level]))
        for number, text in enumerate(wordings):
            for answer, index in itertools.islice(contacts, per_wording):
                instruction = Instruction(text=text, goal=goals[level])
                case = Case(index=index, instruction=instruction, answer=answer)
                cases.append((case, number < NUM_OBJECTS))
    return cases


def _in_turns(by_answer: dict[str, list[int]]) -> Iterator[tuple[str, int]]:
    """Contacts of each answer in turn, moves taking turns of their own; each contact once."""
    moves = [by_answer[move] for move in MOVES if move in by_answer]
    kinds: list[list[tuple[str, int]]] = [
        [(answer, index) for index in found]
        for answer, found in sorted(by_answer.items())
        if answer not in MOVES
    ]
    names = [move for move in MOVES if move in by_answer]
    longest = max((len(found) for found in moves), default=0)
    kinds.append(
        [(n, f[k]) for k in range(longest) for n, f in zip(names, moves, strict=True) if k < len(f)]
    )
    for turn in range(max(map(len, kinds), default=0)):
        for kind in kinds:
            if turn < len(kind):
                yield kind[turn]


def answer_for(state: ContactState, goal: Goal, *, clear: bool) -> str | None:
    """The teacher's answer; None where it knows no way or, if ``clear``, where noise decides."""
    answer = answer_of(teacher(state, goal, move_step_mm=LESSON_MOVE_STEP_MM))
    if answer is None or not clear or not state.in_contact:
        return answer
    around = {
        answer_of(teacher(near, goal, move_step_mm=LESSON_MOVE_STEP_MM)) for near in _around(state)
    }
    return answer if around == {answer} else None


def _around(state: ContactState) -> Iterator[ContactState]:
    for factor in (1 / MARGIN, MARGIN):
        yield dataclasses.replace(
            state,
            force_n=state.force_n * factor,
            depth_mm=state.depth_mm * math.sqrt(factor),
            area_fraction=min(1.0, state.area_fraction * math.sqrt(factor)),
        )
    for along, step in (("x_mm", MARGIN_MM), ("y_mm", MARGIN_MM)):
        for sign in (-1, 1):
            moved = getattr(state, along) + sign * step
            yield dataclasses.replace(state, **{along: moved})


def counts(cases: Sequence[Case]) -> dict[str, int]:
    """How often each answer is right."""
    return dict(sorted(Counter(case.answer for case in cases).items()))


def share(right: NDArray[np.bool_]) -> float:
    """Share of True; NaN of nothing."""
    return float(np.mean(right)) if len(right) else math.nan
