"""Test cases whose right action depends on the goal: drawn bands, pairs of wordings, wordings.

Wordings are those that were kept out of the contract reader's rules
(``tacgrasp.lessons.instruction_scores``), read for one of the tasks. What is right is the teacher's
advice on the true state for the contract that a wording becomes.

A pair is one contact of the test split under two wordings with different answers: a model that
ignores the goal is right on at most one of the two. Contacts are visited in an order drawn from the
seed. For each, wordings and tasks are drawn until two of them disagree in a way of ``QUOTAS`` that
is not yet full. Goals differ in the firmness of the grip, not in the position of the contact. So
``reset`` is never one of the two answers, and a move can disagree with ``decrease_force`` alone,
which comes before it. The quotas therefore balance four kinds of answer, a fifth to 30 % each:
moves (equally in the four directions), ``increase_force``, ``decrease_force`` and none.

The answers of *clear* contacts stay the same when the contact changes a little (``MARGIN``), so
that sensor noise does not decide them. *Any* contacts are scored too, beside direct measurement.
"""

from __future__ import annotations

import dataclasses
import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from cltp.data.dataset import ContactDataset
from cltp.tactile.states import ContactState
from policies.contract import read_contract
from policies.contract_steps import target_of
from policies.goal import Goal
from policies.teacher import LESSON_MOVE_STEP_MM, Advice, teacher
from primitives import Primitive
from primitives.contract import Contract, TaskTerms
from tacgrasp.config.layers import load
from tacgrasp.config.terms import task_terms
from tacgrasp.lessons.instruction_scores import Wording, read_wordings
from tacgrasp.lessons.question_draws import draw_contract

NONE = "none"
MOVES = tuple(p.value for p in Primitive if p.value.startswith("move_"))
INCREASE, DECREASE = Primitive.INCREASE_FORCE.value, Primitive.DECREASE_FORCE.value

TASKS = ("cherry_tomato", "strawberry", "egg", "peg")
"""Tasks of the wordings, from gentle to firm."""

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
"""Number of wordings drawn for one contact, and of contacts tried for one wording."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """One contact under one contract.

    Attributes:
        index: Index of the contact in its data set.
        contract: The contract; its text is the wording, where it is of one.
        answer: The right answer: a primitive's name, or ``NONE`` for success.
        expect: What the wording should become, of ``instruction_scores``; ''.
    """

    index: int
    contract: Contract
    answer: str
    expect: str = ""


class Wordings:
    """Wordings with the contracts that they become for each task; read when they are needed."""

    def __init__(self, wordings: Sequence[Wording]) -> None:
        self.wordings = [each for each in wordings if each.expect != "refuse"]
        self._contracts: dict[tuple[str, str], Contract] = {}

    @cached_property
    def _terms(self) -> Mapping[str, TaskTerms]:
        return {task: task_terms(load(task)[0]) for task in TASKS}

    def contract(self, wording: Wording, task: str) -> Contract:
        """The contract of a wording; it may be refused."""
        key = (wording.text, task)
        if key not in self._contracts:
            self._contracts[key] = read_contract(wording.text, self._terms[task], {})
        return self._contracts[key]

    def draw(self, rng: np.random.Generator) -> tuple[Wording, Contract]:
        """A wording and its contract for a task, both drawn; none that is refused."""
        while True:
            wording = self.wordings[int(rng.integers(len(self.wordings)))]
            contract = self.contract(wording, TASKS[int(rng.integers(len(TASKS)))])
            if not contract.refused:
                return wording, contract


@lru_cache(maxsize=1)
def kept_out() -> Wordings:
    """The wordings that come along."""
    return Wordings(read_wordings(None))


def answer_of(advice: Advice) -> str | None:
    """A primitive's name, ``NONE`` for success, None without either."""
    if advice.action is not None:
        return advice.action.value
    return NONE if advice.success else None


def choose_goals(data: ContactDataset, num: int, *, clear: bool, seed: int = 0) -> list[Case]:
    """Choose up to ``num`` contacts, each under a force band drawn near its force.

    Args:
        data: The test split.
        num: Number of cases.
        clear: Whether to take clear contacts alone.
        seed: Random seed of the contacts and bands.
    """
    rng = np.random.default_rng([seed, 2027])
    cases: list[Case] = []
    for index in rng.permutation(len(data)).tolist():
        if len(cases) == num:
            break
        contract = draw_contract(data.state(index), rng)
        answer = answer_for(data.state(index), target_of(contract), clear=clear)
        if answer is not None:
            cases.append(Case(index=index, contract=contract, answer=answer))
    return cases


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
        wording, contract = kept_out().draw(rng)
        answer = answer_for(state, target_of(contract), clear=clear)
        if answer is None or answer in cases:
            continue
        case = Case(index=index, contract=contract, answer=answer, expect=wording.expect)
        for other in cases.values():
            if quotas.get(frozenset({answer, other.answer}), 0) > 0:
                return (case, other) if rng.random() < 0.5 else (other, case)
        cases[answer] = case
    return None


def choose_wordings(
    data: ContactDataset, per_wording: int, *, clear: bool, seed: int = 0
) -> list[Case]:
    """Every wording on ``per_wording`` contacts; tasks and kinds of answers take turns.

    A contact with the kind of answer whose turn it is is looked for among ``DRAWS`` contacts; of a
    wording that is refused for its task, or has no answer on any of them, there is no case.

    Args:
        data: The test split.
        per_wording: Number of contacts for each wording.
        clear: Whether to take clear contacts alone.
        seed: Random seed of the contacts.
    """
    rng = np.random.default_rng([seed, 2026])
    turns: tuple[tuple[str, ...], ...] = ((NONE,), (INCREASE,), MOVES, (DECREASE,))
    cases: list[Case] = []
    for number, wording in enumerate(
        each for each in kept_out().wordings for _ in range(per_wording)
    ):
        contract = kept_out().contract(wording, TASKS[number % len(TASKS)])
        if contract.refused:
            continue
        found: Case | None = None
        for index in rng.integers(len(data), size=DRAWS).tolist():
            answer = answer_for(data.state(index), target_of(contract), clear=clear)
            if answer is None:
                continue
            found = Case(index=index, contract=contract, answer=answer, expect=wording.expect)
            if answer in turns[number // len(TASKS) % len(turns)]:
                break
        if found is not None:
            cases.append(found)
    return cases


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
