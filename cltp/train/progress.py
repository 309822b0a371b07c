"""Progress of a training: bars on a terminal, a plain line every half minute elsewhere."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Mapping
from typing import TextIO

from rich import progress
from rich.console import Console


class Bar:
    """A ``ProgressReport`` that draws bars, one for each stage; a context manager.

    Args:
        stream: Output; standard error when not given. It gets plain lines when it is no terminal.
        line_s: Seconds between plain lines.
        clock: Source of the time between them [s].
    """

    def __init__(
        self,
        stream: TextIO | None = None,
        *,
        line_s: float = 30.0,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._stream = stream or sys.stderr
        self._line_s, self._clock = line_s, clock
        self._printed_s = -line_s
        self._tasks: dict[str, progress.TaskID] = {}
        self._bars: progress.Progress | None = None
        if self._stream.isatty():
            self._bars = progress.Progress(
                progress.TextColumn("{task.description}"),
                progress.BarColumn(),
                progress.MofNCompleteColumn(),
                progress.TimeElapsedColumn(),
                progress.TimeRemainingColumn(),
                progress.TextColumn("{task.fields[scores]}"),
                console=Console(file=self._stream),
            )

    def __enter__(self) -> Bar:
        if self._bars is not None:
            self._bars.start()
        return self

    def __exit__(self, *_: object) -> None:
        if self._bars is not None:
            self._bars.stop()

    def __call__(self, stage: str, step: int, steps: int, scores: Mapping[str, float]) -> None:
        text = " ".join(f"{name} {value:.3g}" for name, value in scores.items())
        if self._bars is not None:
            if stage not in self._tasks:
                self._tasks[stage] = self._bars.add_task(stage, total=steps, scores="")
            self._bars.update(self._tasks[stage], completed=step, scores=text)
        elif self._clock() - self._printed_s >= self._line_s or step == steps:
            self._printed_s = self._clock()
            self._stream.write(f"{stage} {step}/{steps} {text}\n")
            self._stream.flush()
