"""How long a piece of work took, part by part, over all interruptions.

Not here: how far it is (``cltp.train.progress``).
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from cltp.atomic_write import write_atomically
from cltp.errors import TouchError
from cltp.train.stage import ProgressReport

_WRITE_S = 10.0
_FINISHED = "finished"


class WorkClock:
    """Seconds of work by part, kept in a file so that they add up over interruptions.

    After the work was finished nothing is added: what is done again takes less.

    Args:
        path: The JSON file.
        clock: Source of the time [s].
    """

    def __init__(self, path: Path, clock: Callable[[], float] = time.monotonic) -> None:
        self._path, self._clock = path, clock
        try:
            self.seconds: dict[str, float] = json.loads(path.read_text(encoding="utf-8"))
        except FileNotFoundError:
            self.seconds = {}
        except (OSError, ValueError) as error:
            raise TouchError(f"{path} can't be read; delete it: {error}") from error
        self._part, self._since_s, self._written_s = "", clock(), clock()

    @property
    def _is_finished(self) -> bool:
        return _FINISHED in self.seconds

    def finish(self) -> None:
        """Note that the work was done."""
        self.seconds.setdefault(_FINISHED, 0.0)
        self._write()

    @contextmanager
    def part(self, name: str) -> Iterator[None]:
        """Count what happens inside as part ``name``."""
        self._part, self._since_s = name, self._clock()
        try:
            yield
        finally:
            self._add()
            self._write()

    def watched(self, report: ProgressReport) -> ProgressReport:
        """A progress report that also counts, so that little is lost when the process is killed."""

        def counted(stage: str, step: int, steps: int, scores: Mapping[str, float]) -> None:
            self._add()
            if self._clock() - self._written_s > _WRITE_S:
                self._write()
            report(stage, step, steps, scores)

        return counted

    def minutes(self, name: str) -> float | None:
        """Minutes of a part; None where it was done elsewhere."""
        seconds = self.seconds.get(name)
        return None if seconds is None else round(seconds / 60, 2)

    def _add(self) -> None:
        now_s = self._clock()
        if self._is_finished:
            return
        self.seconds[self._part] = self.seconds.get(self._part, 0.0) + now_s - self._since_s
        self._since_s = now_s

    def _write(self) -> None:
        self._path.parent.mkdir(parents=True, exist_ok=True)
        write_atomically(self._path, json.dumps(self.seconds) + "\n")
        self._written_s = self._clock()
