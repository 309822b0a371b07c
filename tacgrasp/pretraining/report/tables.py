"""Tables of a report: the paper's three beside ours, each trial by itself, and what stays below."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from cltp.evaluation.splits import EVALUATION_SPLITS
from cltp.tactile.states import CLASSES
from tacgrasp.pretraining.report.ablations import Try
from tacgrasp.pretraining.report.pages import PageSection, PageTable
from tacgrasp.pretraining.report.paper_numbers import PAPER, PAPER_TABLES
from tacgrasp.pretraining.report.store import METHODS, Budget, Result, grouped, mean, spread
from tacgrasp.pretraining.report.targets import Goal, best_of_others, goals, orders

COLUMNS = ("contact", "object", "physics", "real")

TITLES = {
    "zero_shot": "Zero-shot, the paper's prompt (table 1)",
    "zero_shot_ensemble": "Zero-shot, an ensemble of prompts",
    "probe": "Frozen encoder and MLP (table 2; image encoders: appendix A)",
    "numbers": "Numbers: median errors, and % of the truth inside 90 % intervals",
    "retrieval": "Retrieval: captions and contacts of a whole split, % found",
}

UNITS = {
    "depth_mm": "depth mm",
    "position_mm": "position mm",
    "area_percent": "area %",
    "force_percent": "force %",
    "coverage_depth": "inside: depth",
    "coverage_position": "inside: position",
    "coverage_area": "inside: area",
    "coverage_force": "inside: force",
}

_DIMENSIONS = " / ".join(CLASSES)


def paper_tables(found: Sequence[Result]) -> Iterator[PageSection]:
    """The paper's three tables: our rows, and the paper's below each."""
    for title, (table, _, methods) in PAPER_TABLES.items():
        rows, of_table = [], [r for r in found if r.table == table and r.method in methods]
        for method in methods:
            rows += _ours(of_table, method)
            if any((table, method, trial) in PAPER for trial in COLUMNS):
                cells = [_joined(PAPER.get((table, method, trial))) for trial in COLUMNS]
                rows.append([f"– the paper's {METHODS[method]}", *cells, ""])
        yield PageSection(
            title=title,
            text=[f"{_DIMENSIONS}, % right; – where nothing was measured. {budgets(of_table)}"],
            table=PageTable(head=["", *COLUMNS, "encoder"], rows=rows),
            note="The paper's real-world row stands in the column physics. Ceiling: computed "
            "directly from the same 1024 points, which gives no shape and texture; 'heights "
            "alone': what probes read off their heights in falling order, without places.",
        )


def _ours(of_table: Sequence[Result], method: str) -> list[list[str]]:
    by_variant: dict[str, dict[str, list[Result]]] = {}
    for (_, of, variant, trial), same in grouped(of_table).items():
        if of == method:
            by_variant.setdefault(variant, {})[trial] = same
    if not by_variant:
        return [[METHODS[method], *["–"] * len(COLUMNS), "not measured"]]
    lines = []
    for variant, trials in by_variant.items():
        cells = []
        for trial in COLUMNS:
            rows = trials.get(trial, [])
            cells.append(_joined([mean([r.values.get(slot) for r in rows]) for slot in CLASSES]))
        lines.append([METHODS[method], *cells, variant])
    return lines


def _joined(values: Sequence[float | None] | None) -> str:
    if values is None or all(value is None for value in values):
        return "–"
    return " / ".join("–" if value is None else f"{value:.1f}" for value in values)


def budgets(found: Sequence[Result]) -> str:
    """One sentence: what encoders could learn."""
    trained = [r for r in found if r.budget is not None]
    told = sorted({budget(r.budget) for r in trained})
    if not told:
        return "No budget of pre-training is known."
    if len(told) == 1:
        return f"Pre-training: one budget for all methods: {told[0]} (optimiser steps × contacts)."
    parts = []
    for each in told:
        who = {f"{METHODS[r.method]} ({r.variant})" for r in trained if budget(r.budget) == each}
        parts.append(f"{each}: {', '.join(sorted(who))}")
    return f"Budgets differ between rows (optimiser steps × contacts): {'; '.join(parts)}."


def budget(of: Budget | None) -> str:
    """As tables write it."""
    return "–" if of is None else f"{of.steps} × {of.batch_size}"


def detail_tables(found: Sequence[Result]) -> Iterator[PageSection]:
    """Every table and trial by itself, with the spread over seeds."""
    about = {trial.name: trial.about for trial in EVALUATION_SPLITS}
    for table in TITLES:
        for trial in [*about, "real"]:
            rows = [r for r in found if r.table == table and r.trial == trial]
            if rows:
                yield _detail(table, trial, about.get(trial, "real touches"), rows)


def _detail(table: str, trial: str, about: str, rows: Sequence[Result]) -> PageSection:
    columns = list(rows[0].values)
    has_paper = any((table, method, trial) in PAPER for method in METHODS)
    head = ["", *(UNITS.get(c, c.replace("_", " ")) for c in columns)]
    if has_paper:
        head += [f"paper: {slot}" for slot in CLASSES]
    head += ["encoder", "steps × batch", "seeds"]
    lines = []
    for (_, method, variant, _), same in grouped(rows).items():
        values = [[row.values.get(column) for row in same] for column in columns]
        cells = [METHODS[method], *(_cell(v) for v in values)]
        if has_paper:
            paper = PAPER.get((table, method, trial))
            cells += [f"{v:.1f}" for v in paper] if paper else ["–"] * len(CLASSES)
        lines.append([*cells, variant, budget(same[0].budget), str(len(same))])
    note = f"{trial}: {about}; {rows[0].contacts} contacts. ± is half of the range over seeds."
    if has_paper and trial == "physics":
        note += " The paper's columns are its real-world ones."
    return PageSection(
        title=f"{TITLES[table]} – {trial}", table=PageTable(head=head, rows=lines), note=note
    )


def _cell(values: Sequence[float | None]) -> str:
    """Mean over seeds, with half of the range where there are several."""
    middle, range_ = mean(values), spread(values)
    if middle is None:
        return "–"
    digits = 1 if abs(middle) >= 10 else 2 if abs(middle) >= 1 else 3  # 0.03 mm is asked
    half = f" ± {range_ / 2:.{digits}f}" if range_ is not None else ""
    return f"{middle:.{digits}f}{half}"


def shortfalls(found: Sequence[Result]) -> Iterator[PageSection]:
    """Every figure below what is asked of it, or below the paper's, and by how much."""
    every = goals(found)
    for title, chosen in (
        ("What stays below: CLTP", [g for g in every if g.method == "cltp"]),
        ("What stays below: other methods and the paper's", [
            g for g in every if g.method != "cltp"
        ]),
    ):  # fmt: skip
        missed = [goal for goal in chosen if goal.missed_by > 0]
        unknown = [goal for goal in chosen if goal.ours is None]
        text = (
            f"Of {len(chosen)} figures {len(chosen) - len(missed) - len(unknown)} are reached, "
            f"{len(missed)} are not, {len(unknown)} were not measured."
        )
        head = ["", "trial", "figure", "asked", "ours", "missed by", "ceiling"]
        head += ["best of other encoders", "asked because"]
        rows = [_missed(goal, best_of_others(found, goal)) for goal in missed]
        yield PageSection(
            title=title, text=[text], table=PageTable(head=head, rows=rows) if rows else None
        )


def _missed(goal: Goal, other: tuple[float, str] | None) -> list[str]:
    digits = 3 if goal.quantity.endswith("_mm") else 1
    asked = " to ".join(
        f"{value:.{digits}f}" for value in (goal.low, goal.high) if math.isfinite(value)
    )
    who = f"{METHODS[goal.method]}, {goal.table.replace('_', '-')}"
    ours = "–" if goal.ours is None else f"{goal.ours:.{digits}f}"
    ceiling = "–" if goal.ceiling is None else f"{goal.ceiling:.{digits}f}"
    quantity = UNITS.get(goal.quantity, goal.quantity)
    missed = f"{goal.missed_by:.{digits + 1}f}"
    best = "–" if other is None else f"{other[0]:.{digits}f} ({other[1]})"
    return [who, goal.trial, quantity, asked, ours, missed, ceiling, best, goal.why]


def order_of_methods(found: Sequence[Result]) -> PageSection:
    """Whether methods stand in the paper's order, dimension by dimension."""
    rows = []
    for order in orders(found):
        paper, ours = (" > ".join(METHODS[m] for m in row) for row in (order.paper, order.ours))
        same = "as in the paper" if order.paper == order.ours else "differs"
        table = order.title.split(":")[0]
        rows.append([f"{table}, {order.trial}", order.quantity, same, ours, paper])
    differing = sum(row[2] == "differs" for row in rows)
    text = f"{len(rows) - differing} of {len(rows)} columns have the paper's order."
    if not rows:
        text = "No column has all of the paper's methods yet."
    head = ["", "", "order", "ours", "the paper's"]
    return PageSection(
        title="Order of methods",
        text=[text],
        table=PageTable(head=head, rows=rows) if rows else None,
    )


def tries_section(tries: Sequence[Try]) -> PageSection | None:
    """What was tried, with a figure for each; nothing without tries."""
    if not tries:
        return None
    rows = []
    for each in tries:
        figures = ["–" if v is None else f"{v:.1f}" for v in each.right.values()]
        where = f"{each.table.replace('_', '-')}, {each.trial}"
        rows.append([each.tried, each.about, where, *figures, each.note])
    return PageSection(
        title="What was tried",
        table=PageTable(head=["", "about", "measured", *CLASSES, "what came of it"], rows=rows),
        note="% right.",
        code=sorted({each.command for each in tries if each.command}),
    )
