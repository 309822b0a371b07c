"""Tables of a report: the paper's three with our rows, then each evaluation split by itself."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import product

from cltp.evaluation.splits import EVALUATION_SPLITS
from cltp.tactile.states import CLASSES
from tacgrasp.pretraining.report.pages import PageSection, PageTable
from tacgrasp.pretraining.report.paper_numbers import PAPER, PAPER_TABLES
from tacgrasp.pretraining.report.store import TITLES, Groups, Result, mean, spread

COLUMNS = ("contact", "object", "physics", "real")

TABLE_TITLES = {
    "zero_shot": "Zero-shot, the paper's prompt (table 1)",
    "zero_shot_ensemble": "Zero-shot, an ensemble of prompts",
    "probe": "Frozen encoder and MLP (table 2; image encoders: appendix A)",
    "numbers": "Numbers: median errors, and % of the true values inside 90 % intervals",
    "retrieval": "Retrieval: captions and contacts of a whole split, % found",
}

_DIMENSIONS = " / ".join(CLASSES)


def paper_tables(groups: Groups) -> Iterator[PageSection]:
    """The paper's three tables: our rows, and the paper's below each."""
    for title, (table, methods, further) in PAPER_TABLES.items():
        rows, results = [], []
        for method in (*methods, *further):
            of_method = {k[2:]: same for k, same in groups.items() if k[:2] == (table, method)}
            results += [result for same in of_method.values() for result in same]
            rows += _our_rows(of_method, TITLES[method])
            if any((table, method, split) in PAPER for split in COLUMNS):
                cells = [_joined(PAPER.get((table, method, split), ())) for split in COLUMNS]
                rows.append([f"– the paper's {TITLES[method]}", *cells, ""])
        yield PageSection(
            title=title,
            text=[f"{_DIMENSIONS}, % right; – where nothing was measured. {budgets(results)}"],
            table=PageTable(head=["", *COLUMNS, "encoder"], rows=rows),
            note="The paper's real-world row stands in the column physics. Geometric baseline: "
            "computed directly from the same 1024 points, which gives no shape and texture; "
            "'heights alone': probes on their heights in falling order, without positions.",
        )


def _our_rows(groups: dict[tuple[str, str], Sequence[Result]], title: str) -> list[list[str]]:
    """A row for each variant of a method, from its results by variant and split."""
    rows = []
    for variant in dict.fromkeys(variant for variant, _ in groups):
        cells = []
        for split in COLUMNS:
            same = groups.get((variant, split), ())
            cells.append(_joined([mean([r.values.get(slot) for r in same]) for slot in CLASSES]))
        rows.append([title, *cells, variant])
    return rows or [[title, *["–"] * len(COLUMNS), "not measured"]]


def _joined(values: Sequence[float | None]) -> str:
    if all(value is None for value in values):
        return "–"
    return " / ".join("–" if value is None else f"{value:.1f}" for value in values)


def budgets(results: Iterable[Result]) -> str:
    """One sentence on the budgets of pre-training."""
    encoders: dict[str, set[str]] = {}
    for result in results:
        if result.budget is not None:
            name = f"{TITLES[result.method]} ({result.variant})"
            encoders.setdefault(str(result.budget), set()).add(name)
    if not encoders:
        return "No budget of pre-training is known."
    if len(encoders) == 1:
        (budget,) = encoders
        return f"Pre-training: one budget for all methods: {budget} (optimiser steps × contacts)."
    parts = [f"{budget}: {', '.join(sorted(names))}" for budget, names in sorted(encoders.items())]
    return f"Budgets differ between rows (optimiser steps × contacts): {'; '.join(parts)}."


def detail_tables(groups: Groups) -> Iterator[PageSection]:
    """Every table and evaluation split by itself, with the spread over seeds."""
    about = {split.name: split.about for split in EVALUATION_SPLITS} | {"real": "real touches"}
    for table, (split, contents) in product(TABLE_TITLES, about.items()):
        of_split = {k[1:3]: same for k, same in groups.items() if (k[0], k[3]) == (table, split)}
        if not of_split:
            continue
        first = next(iter(of_split.values()))[0]
        columns = list(first.values)
        has_paper = any((table, method, split) in PAPER for method in TITLES)
        names = (name.replace("coverage_", "inside: ").replace("percent", "%") for name in columns)
        head = ["", *(name.replace("_", " ") for name in names)]
        if has_paper:
            head += [f"paper: {slot}" for slot in CLASSES]
        head += ["encoder", "steps × batch", "seeds"]
        rows = []
        for (method, variant), same in of_split.items():
            cells = [_cell([row.values.get(column) for row in same]) for column in columns]
            if has_paper:
                paper = PAPER.get((table, method, split))
                cells += [f"{v:.1f}" for v in paper] if paper else ["–"] * len(CLASSES)
            budget = str(same[0].budget or "–")
            rows.append([TITLES[method], *cells, variant, budget, str(len(same))])
        note = f"{split}: {contents}; {first.contacts} contacts. ± is half of the range over seeds."
        if has_paper and split == "physics":
            note += " The paper's columns are its real-world ones."
        yield PageSection(
            title=f"{TABLE_TITLES[table]} – {split}",
            table=PageTable(head=head, rows=rows),
            note=note,
        )


def _cell(values: Sequence[float | None]) -> str:
    """Mean over seeds, with half of the range where there are several."""
    middle, range_ = mean(values), spread(values)
    if middle is None:
        return "–"
    digits = 1 if abs(middle) >= 10 else 2 if abs(middle) >= 1 else 3  # depths are 0.02 mm off
    half = f" ± {range_ / 2:.{digits}f}" if range_ is not None else ""
    return f"{middle:.{digits}f}{half}"
