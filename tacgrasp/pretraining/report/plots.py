"""Plots of a report: methods beside each other, confusion matrices, curves of trainings."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from pathlib import Path

from matplotlib.figure import Figure

from cltp.tactile.states import CLASSES
from tacgrasp.pretraining.report.pages import PagePlot
from tacgrasp.pretraining.report.paper_numbers import PAPER
from tacgrasp.pretraining.report.store import METHODS, Result, grouped, mean

TRIALS = ("contact", "object", "physics", "real")


def bars(found: Sequence[Result]) -> Iterator[PagePlot]:
    """Every method, dimension by dimension, with the paper's as lines."""
    for table, title in (("zero_shot", "zero-shot"), ("probe", "frozen encoder and MLP")):
        for trial in TRIALS:
            rows = {
                (method, variant): same
                for (of, method, variant, where), same in grouped(found).items()
                if of == table and where == trial
            }
            if rows:
                yield _bars(rows, table, trial, title)


def _bars(
    rows: dict[tuple[str, str], list[Result]], table: str, trial: str, title: str
) -> PagePlot:
    figure = Figure(figsize=(11, 3.6), layout="constrained")
    axes = figure.subplots()
    width = 0.8 / len(rows)
    for place, ((method, variant), same) in enumerate(rows.items()):
        at = [n + (place - len(rows) / 2 + 0.5) * width for n in range(len(CLASSES))]
        heights = [mean([row.values.get(slot) for row in same]) or 0.0 for slot in CLASSES]
        axes.bar(at, heights, width, label=f"{METHODS[method]} ({variant})")
        for x, value in zip(at, PAPER.get((table, method, trial), ()), strict=False):
            axes.plot([x - width / 2, x + width / 2], [value, value], color="black", lw=1.5)
    axes.set_xticks(range(len(CLASSES)), list(CLASSES))
    axes.set_ylabel("right, %")
    axes.set_title(f"{title}, {trial}; black: the paper's")
    axes.legend(fontsize=7, ncols=4)
    return _plot(figure, f"{table}-{trial}", f"{title}, {trial}, every method")


def confusions(found: Sequence[Result]) -> Iterator[PagePlot]:
    """Truth against what was said, for CLTP by prompts and by probes, of the first seed."""
    for (table, method, variant, trial), rows in grouped(found).items():
        if method != "cltp" or table not in ("zero_shot", "probe") or trial not in TRIALS:
            continue
        result = rows[0]
        if not result.confusion:
            continue
        figure = Figure(figsize=(15, 3.8), layout="constrained")
        for axes, (slot, names) in zip(
            figure.subplots(1, len(CLASSES)), CLASSES.items(), strict=True
        ):
            counts = result.confusion.get(slot)
            if counts is None:
                continue
            shares = [[c / max(1, sum(row)) for c in row] for row in counts]
            axes.imshow(shares, vmin=0, vmax=1, cmap="Blues")
            axes.set_xticks(range(len(names)), names, rotation=90, fontsize=6)
            axes.set_yticks(range(len(names)), names, fontsize=6)
            axes.set_title(slot, fontsize=8)
        named = f"CLTP ({variant}), {table.replace('_', '-')}, {trial}"
        figure.suptitle(f"{named}: truth by row, said by column, seed {result.seed}", fontsize=9)
        yield _plot(figure, f"confusion-{table}-{variant}-{trial}", f"{named}, confusion matrices")


def curves(weights: Path) -> list[PagePlot]:
    """Losses and temperatures, as trainings drew them into ``METHOD/.training``."""
    found = [*weights.glob(".training/*.png"), *weights.glob("*/.training/*.png")]
    return [
        PagePlot(
            name=f"curve-{path.parents[1].name}-{path.stem}",
            about=f"{path.parents[1].name}, {path.stem}: losses and temperature",
            png=path.read_bytes(),
        )
        for path in sorted(found)
    ]


def _plot(figure: Figure, name: str, about: str) -> PagePlot:
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png", dpi=90)
    return PagePlot(
        name=name.replace("/", "_").replace("+", "-"), about=about, png=drawn.getvalue()
    )
