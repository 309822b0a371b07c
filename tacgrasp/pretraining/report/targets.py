"""What is asked of the results, and by how much they miss it: computed, never left out.

CLTP: at or above the paper on ``contact``, within three points of that on ``object``; its probes on
``physics`` above the paper's real-world row, or at the ceiling where noise makes that impossible.
Its numbers: median errors and shares held by intervals. The other methods: the paper's own figures.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from cltp.tactile.states import CLASSES, MEASURABLE
from tacgrasp.pretraining.report.paper_numbers import (
    COVERED,
    LARGEST,
    OBJECT_MARGIN,
    PAPER,
    PAPER_TABLES,
)
from tacgrasp.pretraining.report.store import Result, grouped, mean, usual_variant


@dataclass(frozen=True, slots=True, kw_only=True)
class Goal:
    """One figure, and what it is asked to be.

    Attributes:
        table, method, trial, quantity: Which figure.
        low, high: It is asked to lie between them.
        why: Where these come from.
        ours: What was measured, the mean over seeds; None when it was not.
        ceiling: What direct computation gives; None where it gives nothing.
    """

    table: str
    method: str
    trial: str
    quantity: str
    low: float
    high: float
    why: str
    ours: float | None
    ceiling: float | None

    @property
    def missed_by(self) -> float:
        """How far ours lies outside; 0 when it is reached, NaN when nothing was measured."""
        if self.ours is None:
            return math.nan
        return max(self.low - self.ours, self.ours - self.high, 0.0)


Figures = Mapping[tuple[str, str, str], Mapping[str, float | None]]


def figures(found: Sequence[Result]) -> Figures:
    """Means over seeds by table, method and trial, of each method's usual encoder."""
    told: dict[tuple[str, str, str], dict[str, float | None]] = {}
    for (table, method, variant, trial), rows in grouped(found).items():
        if variant == usual_variant(method, found):
            told[table, method, trial] = {
                name: mean([row.values.get(name) for row in rows]) for name in rows[0].values
            }
    return told


def best_of_others(found: Sequence[Result], goal: Goal) -> tuple[float, str] | None:
    """What the best of a method's other encoders gives, and which that is."""
    usual = usual_variant(goal.method, found)
    there: list[tuple[float, str]] = []
    for (table, method, variant, trial), rows in grouped(found).items():
        value = mean([row.values.get(goal.quantity) for row in rows])
        same = (table, method, trial) == (goal.table, goal.method, goal.trial)
        if same and variant != usual and value is not None:
            there.append((value, variant))

    def worse(one: tuple[float, str]) -> tuple[float, float]:
        more = -one[0] if goal.high == math.inf else one[0] if goal.low == -math.inf else 0.0
        return replace(goal, ours=one[0]).missed_by, more

    return min(there, key=worse, default=None)


def goals(found: Sequence[Result]) -> list[Goal]:
    """Everything that is asked, in the order of tables and methods."""
    told = figures(found)
    return [*_of_cltp(told), *_of_numbers(told), *_of_others(told)]


def _of_cltp(told: Figures) -> Iterator[Goal]:
    for table in ("zero_shot", "probe"):
        paper = PAPER[table, "cltp", "contact"]
        lower = tuple(value - OBJECT_MARGIN for value in paper)
        yield from _goals(told, table, "cltp", "contact", paper, "the paper's")
        yield from _goals(told, table, "cltp", "object", lower, "3 below the paper's")
    ceiling = told.get(("probe", "ceiling", "physics"), {})
    asked, why = [], []
    for slot, value in zip(CLASSES, PAPER["probe", "cltp", "physics"], strict=True):
        highest = ceiling.get(slot)
        is_lower = highest is not None and highest < value
        asked.append(highest if is_lower and highest is not None else value)
        why.append("the ceiling" if is_lower else "the paper's, real")
    yield from _goals(told, "probe", "cltp", "physics", asked, *why)


def _of_others(told: Figures) -> Iterator[Goal]:
    for (table, method, trial), paper in PAPER.items():
        if method != "cltp":
            why = "the paper's, real" if trial == "physics" else "the paper's"
            yield from _goals(told, table, method, trial, paper, why)


def _goals(
    told: Figures, table: str, method: str, trial: str, asked: Sequence[float], *why: str
) -> Iterator[Goal]:
    """At least these; ``why`` once for all dimensions, or for each."""
    reasons = why if len(why) == len(CLASSES) else why * len(CLASSES)
    for slot, low, reason in zip(CLASSES, asked, reasons, strict=True):
        yield Goal(
            table=table,
            method=method,
            trial=trial,
            quantity=slot,
            low=low,
            high=math.inf,
            why=reason,
            ours=told.get((table, method, trial), {}).get(slot),
            ceiling=told.get((table, "ceiling", trial), {}).get(slot),
        )


def _of_numbers(told: Figures) -> Iterator[Goal]:
    limits = {key: (-math.inf, high, "at most") for key, high in LARGEST.items()}
    for trial, (low, high) in COVERED.items():
        for quantity in (*MEASURABLE, "force"):
            limits[trial, f"coverage_{quantity}"] = (low, high, "90 % intervals")
    for (trial, quantity), (low, high, why) in limits.items():
        yield Goal(
            table="numbers",
            method="cltp",
            trial=trial,
            quantity=quantity,
            low=low,
            high=high,
            why=why,
            ours=told.get(("numbers", "cltp", trial), {}).get(quantity),
            ceiling=None,
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Order:
    """Methods of one of the paper's tables, best first.

    Attributes:
        title: Of the table.
        trial, quantity: Which column.
        paper: The paper's order.
        ours: Ours.
    """

    title: str
    trial: str
    quantity: str
    paper: list[str]
    ours: list[str]


def orders(found: Sequence[Result]) -> Iterator[Order]:
    """The order of methods in the paper and here, where all of them were measured."""
    told = figures(found)
    for title, (table, names, _) in PAPER_TABLES.items():
        methods = names.split()
        for trial in ("contact", "physics"):
            for column, slot in enumerate(CLASSES):
                paper = {m: PAPER[table, m, trial][column] for m in methods
                         if (table, m, trial) in PAPER}  # fmt: skip
                ours = {m: told.get((table, m, trial), {}).get(slot) for m in methods}
                there = {m: v for m, v in ours.items() if v is not None}
                if len(paper) == len(there) == len(methods):
                    yield Order(
                        title=title,
                        trial=trial,
                        quantity=slot,
                        paper=sorted(paper, key=lambda m: -paper[m]),
                        ours=sorted(there, key=lambda m: -there[m]),
                    )
