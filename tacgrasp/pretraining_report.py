"""One HTML and one Markdown page from stored results: our tables beside the paper's, and plots.

Reads results alone, trains and measures nothing, and refuses results of different data.
"""

from __future__ import annotations

import base64
import html
import io
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from matplotlib.figure import Figure

from cltp.samples import CLASSES
from cltp.trials import TRIALS
from tacgrasp.errors import UsageError
from tacgrasp.results import METHODS, Budget, Result, grouped, load, mean, spread

PAPER: Mapping[tuple[str, str, str], tuple[float, ...]] = {
    ("zero_shot", "cltp_no_image", "contact"): (52.6, 65.7, 96.5, 91.9, 67.1),
    ("zero_shot", "cltp", "contact"): (70.1, 68.9, 98.3, 94.4, 81.8),
    ("probe", "point_bert", "contact"): (28.7, 89.5, 64.4, 80.8, 91.3),
    ("probe", "point_mae", "contact"): (31.6, 90.2, 68.1, 82.9, 92.6),
    ("probe", "cltp_no_image", "contact"): (61.2, 94.5, 94.7, 91.4, 94.8),
    ("probe", "cltp", "contact"): (84.8, 96.1, 99.2, 95.9, 97.1),
    ("probe", "unitouch", "contact"): (65.8, 94.7, 59.3, 85.2, 92.3),
    ("probe", "tvl", "contact"): (63.4, 95.3, 65.6, 88.9, 94.4),
    ("probe", "point_bert", "physics"): (21.9, 91.1, 52.1, 51.2, 73.4),
    ("probe", "point_mae", "physics"): (23.9, 89.2, 52.1, 55.3, 56.2),
    ("probe", "cltp_no_image", "physics"): (55.3, 90.3, 77.3, 73.8, 64.4),
    ("probe", "cltp", "physics"): (71.2, 92.7, 83.6, 81.4, 77.2),
}
"""Percent right: shape, texture, depth, position, area. ``physics`` stands beside the paper's real
set. Source: paper, tables 1, 2 and that of appendix A."""

TITLES = {
    "zero_shot": "Zero-shot, the paper's prompt (table 1)",
    "zero_shot_ensemble": "Zero-shot, an ensemble of prompts",
    "probe": "Frozen encoder and MLP (table 2; image encoders: appendix A)",
    "numbers": "Numbers: median errors, and shares held by 90 % intervals",
    "retrieval": "Retrieval: captions and contacts of a whole split, % found",
}

_UNITS = {
    "depth_mm": "depth mm",
    "position_mm": "position mm",
    "area_percent": "area %",
    "force_percent": "force %",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Table:
    """What a page shows of one table and one trial.

    Attributes:
        title: Above it.
        head: Names of columns.
        rows: Cells.
        note: Below it.
    """

    title: str
    head: list[str]
    rows: list[list[str]]
    note: str


def report(results: Path, out: Path, name: str = "pretraining") -> list[Path]:
    """Write ``out/name.md`` and ``out/name.html``.

    Raises:
        UsageError: No results, or the pages can't be written.
        TouchError: Results are damaged or of different data.
    """
    found = load(results)
    tables = [*_tables(found), *_failures(found)]
    plots = [*_bars(found), *_confusions(found)]
    pages = {f"{name}.md": _markdown(found, tables), f"{name}.html": _html(found, tables, plots)}
    try:
        out.mkdir(parents=True, exist_ok=True)
        for file, text in pages.items():
            beside = out / f"{file}.part"
            beside.write_text(text, encoding="utf-8")
            beside.replace(out / file)
    except OSError as error:
        raise UsageError(f"the report can't be written to {out}: {error.strerror}") from None
    return [out / file for file in pages]


def _tables(found: Sequence[Result]) -> Iterator[Table]:
    about = {trial.name: trial.about for trial in TRIALS}
    for table in TITLES:
        of_table = [result for result in found if result.table == table]
        known = [trial.name for trial in TRIALS] + ["real"]
        for trial in known:
            rows = [result for result in of_table if result.trial == trial]
            if rows:
                yield _table(table, trial, about.get(trial, "real touches"), rows)


def _table(table: str, trial: str, about: str, rows: Sequence[Result]) -> Table:
    columns = list(rows[0].values)
    has_paper = any((table, method, trial) in PAPER for method in METHODS)
    head = ["", *(_UNITS.get(c, c.replace("_", " ")) for c in columns)]
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
        lines.append([*cells, variant, _budget(same[0].budget), str(len(same))])
    note = f"{trial}: {about}; {rows[0].contacts} contacts."
    if has_paper and trial == "physics":
        note += " The paper's columns are its real-world ones."
    return Table(title=f"{TITLES[table]} – {trial}", head=head, rows=lines, note=note)


NAMED_FAILURES = (("triangle", "peak"), ("sphere", "ellipsoid"))
"""Shapes that the paper's section 5.2 says are taken for each other."""


def _failures(found: Sequence[Result]) -> Iterator[Table]:
    """The paper's failure cases by name, and the shapes most often taken for another one."""
    names = CLASSES["shape"]
    rows = []
    for result in found:
        counts = result.confusion.get("shape")
        if (result.table, result.method) != ("probe", "cltp") or result.seed or counts is None:
            continue
        cells = [result.trial]
        for one, other in NAMED_FAILURES:
            there = _said_as(counts, names.index(one), names.index(other))
            back = _said_as(counts, names.index(other), names.index(one))
            cells.append(f"{there} / {back}")
        wrong = [
            (count, truth, said)
            for truth, row in enumerate(counts)
            for said, count in enumerate(row)
            if said != truth and count
        ]
        named = [
            f"{names[truth]} as {names[said]} ({n})" for n, truth, said in sorted(wrong)[:-6:-1]
        ]
        rows.append([*cells, ", ".join(named) or "none"])
    if rows:
        pairs = [f"{one} as {other} / back, %" for one, other in NAMED_FAILURES]
        yield Table(
            title="Failures of CLTP's shape probe",
            head=["", *pairs, "most frequent (contacts)"],
            rows=rows,
            note="The paper names triangle and peak, sphere and ellipsoid.",
        )


def _said_as(counts: Sequence[Sequence[int]], truth: int, said: int) -> str:
    total = sum(counts[truth])
    return f"{100 * counts[truth][said] / total:.0f}" if total else "–"


def _cell(values: Sequence[float | None]) -> str:
    """Mean over seeds, with half of the range where there are several."""
    middle, range_ = mean(values), spread(values)
    if middle is None:
        return "–"
    digits = 1 if abs(middle) >= 10 else 2
    half = f" ± {range_ / 2:.{digits}f}" if range_ is not None else ""
    return f"{middle:.{digits}f}{half}"


def _budget(budget: Budget | None) -> str:
    return "–" if budget is None else f"{budget.steps} × {budget.batch_size}"


def _facts(found: Sequence[Result]) -> list[str]:
    budgets = {_budget(r.budget) for r in found if r.budget is not None}
    shared = "one budget for all methods" if len(budgets) == 1 else "budgets differ between rows"
    return [
        f"Data {found[0].data[:16]}; {shared}: {', '.join(sorted(budgets)) or 'none'} "
        "(optimiser steps × contacts).",
        "Ceiling: computed directly from the same 1024 points; shape and texture are not.",
        "± is half of the range over seeds.",
    ]


def _commands(found: Sequence[Result]) -> list[str]:
    return sorted({result.command for result in found if result.command})


def _markdown(found: Sequence[Result], tables: Sequence[Table]) -> str:
    lines = ["# Pre-training: our results beside the paper's", "", *_spaced(_facts(found))]
    for table in tables:
        lines += ["", f"## {table.title}", "", f"| {' | '.join(table.head)} |"]
        lines += [f"|{'---|' * len(table.head)}"]
        lines += [f"| {' | '.join(row)} |" for row in table.rows]
        lines += ["", table.note]
    lines += ["", "## Commands", "", *(f"- `{command}`" for command in _commands(found))]
    return "\n".join(lines) + "\n"


def _spaced(lines: Sequence[str]) -> list[str]:
    return [part for line in lines for part in (line, "")]


_STYLE = (
    "body{font:15px sans-serif;max-width:75em;margin:2em auto;padding:0 1em}"
    "table{border-collapse:collapse;margin:.5em 0}"
    "td,th{padding:.25em .6em;border-bottom:1px solid #ccc;text-align:right}"
    "td:first-child,th:first-child{text-align:left}img{max-width:100%}"
)


def _html(found: Sequence[Result], tables: Sequence[Table], plots: Sequence[str]) -> str:
    parts = ["<!doctype html><meta charset=utf-8><title>Pre-training</title>"]
    parts += [f"<style>{_STYLE}</style><h1>Pre-training: our results beside the paper's</h1>"]
    parts += [f"<p>{html.escape(fact)}</p>" for fact in _facts(found)]
    for table in tables:
        parts.append(f"<h2>{html.escape(table.title)}</h2><table>{_row('th', table.head)}")
        parts += [_row("td", row) for row in table.rows]
        parts.append(f"</table><p>{html.escape(table.note)}</p>")
    parts += ["<h2>Plots</h2>", *plots, "<h2>Commands</h2><ul>"]
    parts += [f"<li><code>{html.escape(command)}</code></li>" for command in _commands(found)]
    return "\n".join([*parts, "</ul>"]) + "\n"


def _row(kind: str, cells: Sequence[str]) -> str:
    return "<tr>" + "".join(f"<{kind}>{html.escape(c)}</{kind}>" for c in cells) + "</tr>"


def _bars(found: Sequence[Result]) -> Iterator[str]:
    """Probes of every method, dimension by dimension, with the paper's as lines."""
    for trial in ("contact", "object", "physics"):
        rows = {
            (method, variant): same
            for (table, method, variant, where), same in grouped(found).items()
            if table == "probe" and where == trial
        }
        if not rows:
            continue
        figure = Figure(figsize=(11, 3.6), layout="constrained")
        axes = figure.subplots()
        width = 0.8 / len(rows)
        for place, ((method, variant), same) in enumerate(rows.items()):
            at = [n + (place - len(rows) / 2 + 0.5) * width for n in range(len(CLASSES))]
            heights = [mean([row.values.get(slot) for row in same]) or 0.0 for slot in CLASSES]
            axes.bar(at, heights, width, label=f"{METHODS[method]} ({variant})")
            for x, value in zip(at, PAPER.get(("probe", method, trial), ()), strict=False):
                axes.plot([x - width / 2, x + width / 2], [value, value], color="black", lw=1.5)
        axes.set_xticks(range(len(CLASSES)), list(CLASSES))
        axes.set_ylabel("right, %")
        axes.set_title(f"frozen encoder and MLP, {trial}; black: the paper's")
        axes.legend(fontsize=7, ncols=4)
        yield _picture(figure)


def _confusions(found: Sequence[Result]) -> Iterator[str]:
    """Truth against what was said, for CLTP's probes."""
    for result in found:
        if (result.table, result.method, result.trial) != ("probe", "cltp", "contact"):
            continue
        figure = Figure(figsize=(15, 3.6), layout="constrained")
        for axes, (slot, names) in zip(
            figure.subplots(1, len(CLASSES)), CLASSES.items(), strict=True
        ):
            counts = result.confusion.get(slot)
            if counts is None:
                continue
            shares = [[c / max(1, sum(row)) for c in row] for row in counts]
            axes.imshow(shares, vmin=0, vmax=1, cmap="Blues")
            axes.set_xticks(range(len(names)), names, rotation=90, fontsize=5)
            axes.set_yticks(range(len(names)), names, fontsize=5)
            axes.set_title(slot, fontsize=8)
        figure.suptitle(
            f"CLTP ({result.variant}), probe, contact: truth by row, seed {result.seed}"
        )
        yield _picture(figure)


def _picture(figure: Figure) -> str:
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png", dpi=90)
    return f'<img alt="" src="data:image/png;base64,{base64.b64encode(drawn.getvalue()).decode()}">'
