"""Curves of a training: a CSV file with a row for each step, and a plot of it.

The file survives ``kill -9`` together with its checkpoint: rows are on disk before the checkpoint
that follows them, and rows after it are dropped when the training continues. The file of an
interrupted training therefore ends up equal to that of an undisturbed one.
"""

from __future__ import annotations

import csv
import os
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from cltp.atomic_write import replacing, write_atomically
from cltp.errors import TouchError

STEP, RATE = "step", "learning_rate"


class CurveFile:
    """Appends rows to a CSV file.

    Args:
        path: The CSV file.
        step: Steps that are done; later rows of an existing file are dropped.
    """

    def __init__(self, path: Path, step: int) -> None:
        self._path = Path(path)
        self._rows: list[str] = []
        self._names: list[str] | None = None
        if step == 0 or not self._path.exists():
            self._path.unlink(missing_ok=True)
            return
        lines = self._path.read_text(encoding="utf-8").splitlines()
        numbered = [(line.split(",")[0], line) for line in lines[1:]]
        columns = lines[0].count(",") if lines else 0  # a full disk may have cut a line
        rows = [
            line
            for number, line in numbered
            if number.isdigit() and int(number) <= step and line.count(",") == columns
        ]
        self._names = lines[0].split(",")[2:] if lines else None
        write_atomically(self._path, "".join(f"{line}\n" for line in [*lines[:1], *rows]))

    def add(self, step: int, rate: float, terms: Mapping[str, float]) -> None:
        """Add the terms of a step that is done; they are on disk after ``flush``."""
        if self._names is None:
            self._names = list(terms)
            self._rows.append(",".join([STEP, RATE, *self._names]))
        values = [terms.get(name, float("nan")) for name in self._names]
        self._rows.append(",".join([str(step), f"{rate:.6g}", *(f"{v:.7g}" for v in values)]))

    def flush(self) -> None:
        if not self._rows:
            return
        self._path.parent.mkdir(parents=True, exist_ok=True)
        with self._path.open("a", encoding="utf-8") as file:
            file.write("".join(f"{row}\n" for row in self._rows))
            file.flush()
            os.fsync(file.fileno())
        self._rows.clear()


LEAST_LOSS = 1e-4
"""Lowest loss that is drawn, over the highest: a term that nothing is left of hides the others."""


def read_curves(path: Path) -> dict[str, NDArray[np.float64]]:
    """Columns of a file that ``CurveFile`` wrote.

    Raises:
        TouchError: It can't be read.
    """
    try:
        with Path(path).open(encoding="utf-8", newline="") as file:
            rows = list(csv.reader(file))
        values = np.array([[float(value) for value in row] for row in rows[1:]])
        return {name: values[:, column] for column, name in enumerate(rows[0])}
    except (OSError, ValueError, IndexError) as error:
        raise TouchError(f"no curves could be read from {path}: {error}") from error


def plot_curves(path: Path, picture: Path) -> None:
    """Draw losses above and the temperature, where there is one, below; PNG.

    Raises:
        TouchError: There are no curves.
    """
    from matplotlib import colormaps
    from matplotlib.figure import Figure

    curves = read_curves(path)
    steps = curves.pop(STEP)
    curves.pop(RATE)
    temperature = curves.pop("temperature", None)
    figure = Figure(figsize=(8, 6 if temperature is not None else 4), layout="constrained")
    axes = figure.subplots(2 if temperature is not None else 1, 1, sharex=True, squeeze=False)
    axes[0, 0].set_prop_cycle(color=list(colormaps["tab20"](np.arange(20))))
    for name, values in curves.items():
        axes[0, 0].plot(steps, smoothed(values), label=name, linewidth=1)
    axes[0, 0].set_ylabel("loss, mean over 50 steps")
    axes[0, 0].set_yscale("log")
    highest = max(float(values.max()) for values in curves.values())
    lowest = min(float(smoothed(values).min()) for values in curves.values())
    if highest > 0:
        axes[0, 0].set_ylim(bottom=max(0.8 * lowest, highest * LEAST_LOSS))
    axes[0, 0].legend(fontsize=8, ncols=3)
    if temperature is not None:
        axes[1, 0].plot(steps, temperature, color="black", linewidth=1)
        axes[1, 0].set_ylabel("temperature")
    axes[-1, 0].set_xlabel("step")
    with replacing(picture) as part:
        figure.savefig(part, format="png", dpi=100)


def smoothed(values: NDArray[np.float64], window: int = 50) -> NDArray[np.float64]:
    """Mean over the last ``window`` values, fewer where there are no more."""
    total = np.cumsum(np.insert(values, 0, 0.0))
    last = np.arange(1, len(values) + 1)
    first = np.maximum(last - window, 0)
    return (total[last] - total[first]) / (last - first)
