"""Tables and picture of the robustness benchmark."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from rich.console import Console

from cltp.atomic_write import replacing
from cltp.tactile.states import MEASURABLE
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.figures import number_table
from tacgrasp.benchmarks.robustness.conditions import NUISANCES
from tacgrasp.benchmarks.robustness.readers import FORCE_METRIC
from tacgrasp.benchmarks.robustness.store import (
    CONSTANT,
    CONTACT_SUBJECTS,
    FIXED_FORCE,
    ORACLE,
    POLICY_SUBJECTS,
    VERIFIED,
    CellResult,
    Store,
    job_name,
)

_PANELS = {"shape": ("shape",), "texture": ("texture",), "depth, position, area": MEASURABLE}


def print_tables(console: Console, store: Store) -> None:
    """A table a subject: each figure with its limit in brackets."""
    for subject in (*CONTACT_SUBJECTS, CONSTANT, *POLICY_SUBJECTS, ORACLE, FIXED_FORCE):
        rows = _rows(store, subject)
        if not rows:
            continue
        metrics = list(rows[0][2].values)
        table = number_table(
            f"{subject}: percent right, limit in brackets",
            ("nuisance", "level", *metrics, "n"),
            ("nuisance",),
        )
        for nuisance, level, result, limits in rows:
            figures = (_with_limit(result.values[m], limits.get(m, math.nan)) for m in metrics)
            table.add_row(nuisance, f"{level:g}", *figures, str(result.n))
        console.print(table)


def _rows(store: Store, subject: str) -> list[tuple[str, float, CellResult, Mapping[str, float]]]:
    rows = []
    for nuisance, levels in NUISANCES.items():
        for level, condition in levels.items():
            result = store.results.get(job_name(subject, nuisance, condition))
            if result is not None:
                limits = store.limits_of(subject, nuisance, condition)
                rows.append((nuisance, level, result, limits))
    return rows


def _with_limit(value: float, limit: float) -> str:
    return f"{value:.1f}" + ("" if math.isnan(limit) else f" [{limit:.1f}]")


def draw(store: Store, path: Path) -> None:
    """Draw value against level, a line a nuisance; the limit is dashed.

    What was not measured has no panel, and a nuisance of one level no line.

    Raises:
        UsageError: The picture can't be written.
    """
    on_contacts = [subject for subject in CONTACT_SUBJECTS if _rows(store, subject)]
    last = len(on_contacts)
    figure = Figure(figsize=(15, 3.7 * (last + 1)), layout="constrained")
    axes = figure.subplots(last + 1, 4, sharex=True, squeeze=False)
    for row, subject in enumerate(on_contacts):
        for column, (title, metrics) in enumerate(_PANELS.items()):
            _panel(axes[row, column], store, subject, metrics, f"{subject}: {title} [% right]")
        panel = axes[row, len(_PANELS)]
        _panel(panel, store, subject, (FORCE_METRIC,), f"{subject}: median force error [%]")
        panel.set_ylim(0, 60)
    for column, subject in enumerate(POLICY_SUBJECTS):
        title = f"{subject}: verified grasps [%]"
        _panel(axes[last, column], store, subject, (VERIFIED,), title)
    shown: dict[Any, Any] = {}
    for panel in axes.flat:
        handles, labels = panel.get_legend_handles_labels()
        shown |= dict(zip(labels, handles, strict=True))
    for unused in axes[last, 2:]:
        unused.set_axis_off()
    axes[last, 2].legend(
        shown.values(), shown.keys(), loc="upper left", title="nuisance: its levels"
    )
    axes[last, 3].text(0, 0.9, "solid: measured\ndashed: limit", va="top")
    try:
        with replacing(path) as part:
            figure.savefig(part, format="png", dpi=90, facecolor="white")
    except OSError as error:
        raise UsageError(f"--plot {path} can't be written: {error.strerror or error}") from None


def _panel(axes: Axes, store: Store, subject: str, metrics: Sequence[str], title: str) -> None:
    colours = colormaps["tab10"]
    for number, (nuisance, levels) in enumerate(NUISANCES.items()):
        steps, values, limits = [], [], []
        for step, condition in enumerate(levels.values()):
            result = store.results.get(job_name(subject, nuisance, condition))
            if result is None:
                continue
            limit = store.limits_of(subject, nuisance, condition)
            steps.append(step)
            values.append(_mean([result.values[m] for m in metrics]))
            limits.append(_mean([limit.get(m, math.nan) for m in metrics]))
        if len(steps) < 2:
            continue
        label = f"{nuisance}: {', '.join(f'{level:g}' for level in levels)}"
        axes.plot(steps, values, "o-", color=colours(number), label=label, markersize=4)
        axes.plot(steps, limits, "--", color=colours(number), linewidth=1)
    if not axes.lines:
        axes.set_axis_off()
        return
    axes.set_title(title, fontsize=10)
    axes.set_xticks(range(4))
    axes.tick_params(labelbottom=True)
    axes.set_xlabel("step of the level")
    axes.set_ylim(0, 102)
    axes.grid(alpha=0.3)


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values)
