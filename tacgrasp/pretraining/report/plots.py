"""Plots of a report: methods beside each other, confusion matrices, curves of trainings."""

from __future__ import annotations

import io
from collections.abc import Iterator
from itertools import product
from pathlib import Path

from matplotlib.figure import Figure

from cltp.tactile.states import CLASSES
from tacgrasp.pretraining.report.pages import PagePlot
from tacgrasp.pretraining.report.paper_numbers import PAPER
from tacgrasp.pretraining.report.store import Groups, means
from tacgrasp.pretraining.report.tables import COLUMNS

_TABLES = {"zero_shot": "zero-shot", "probe": "frozen encoder and MLP"}


def bars(groups: Groups) -> Iterator[PagePlot]:
    """Every method, dimension by dimension, with the paper's figures as lines."""
    for table, split in product(_TABLES, COLUMNS):
        rows = {k[1:3]: same for k, same in groups.items() if (k[0], k[3]) == (table, split)}
        if not rows:
            continue
        figure = Figure(figsize=(11, 3.6), layout="constrained")
        axes = figure.subplots()
        width = 0.8 / len(rows)
        for number, ((method, variant), same) in enumerate(rows.items()):
            offset = (number - len(rows) / 2 + 0.5) * width
            centres = [column + offset for column in range(len(CLASSES))]
            heights = [means(same).get(dimension) or 0.0 for dimension in CLASSES]
            axes.bar(centres, heights, width, label=f"{same[0].name} ({variant})")
            for x, value in zip(centres, PAPER.get((table, method, split), ()), strict=False):
                axes.plot([x - width / 2, x + width / 2], [value, value], color="black", lw=1.5)
        axes.set_xticks(range(len(CLASSES)), list(CLASSES))
        axes.set_ylabel("right, %")
        title = f"{_TABLES[table]}, {split}"
        axes.set_title(f"{title}; black: the paper's")
        figure.legend(fontsize=7, ncols=4, loc="outside lower center")
        yield _plot(figure, f"{table}-{split}", f"{title}, every method")


def confusions(groups: Groups) -> Iterator[PagePlot]:
    """Confusion matrices of CLTP by prompts and by probes, of the first seed."""
    for (table, method, variant, split), rows in groups.items():
        result = rows[0]
        if method != "cltp" or table not in _TABLES or split not in COLUMNS or not result.confusion:
            continue
        figure = Figure(figsize=(15, 3.8), layout="constrained")
        all_axes = figure.subplots(1, len(CLASSES))
        for axes, (dimension, names) in zip(all_axes, CLASSES.items(), strict=True):
            counts = result.confusion.get(dimension)
            if counts is None:
                continue
            fractions = [[count / max(1, sum(row)) for count in row] for row in counts]
            axes.imshow(fractions, vmin=0, vmax=1, cmap="Blues")
            axes.set_xticks(range(len(names)), names, rotation=90, fontsize=6)
            axes.set_yticks(range(len(names)), names, fontsize=6)
            axes.set_title(dimension, fontsize=8)
        name = f"{result.name} ({variant}), {table.replace('_', '-')}, {split}"
        axes_meaning = f"truth by row, prediction by column, seed {result.seed}"
        figure.suptitle(f"{name}: {axes_meaning}", fontsize=9)
        yield _plot(figure, f"confusion-{table}-{variant}-{split}", f"{name}, confusion matrices")


def curves(weights: Path) -> list[PagePlot]:
    """Losses and temperatures, as trainings drew them into ``METHOD/.training``."""
    images = [*weights.glob(".training/*.png"), *weights.glob("*/.training/*.png")]
    return [
        PagePlot(
            name=f"curve-{path.parents[1].name}-{path.stem}",
            about=f"{path.parents[1].name}, {path.stem}: losses and temperature",
            png=path.read_bytes(),
        )
        for path in sorted(images)
    ]


def _plot(figure: Figure, name: str, about: str) -> PagePlot:
    png = io.BytesIO()
    figure.savefig(png, format="png", dpi=90)
    return PagePlot(name=name.replace("/", "_").replace("+", "-"), about=about, png=png.getvalue())
