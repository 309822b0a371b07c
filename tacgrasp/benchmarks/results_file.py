"""Results of a long benchmark, kept in the file of its figures while it runs, so that it can go on.

The file holds ``about`` (what is measured: settings and weights), ``results``, from which a later
call goes on, and the figures that the benchmark makes of them.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

from pydantic import TypeAdapter
from rich.console import Console

from cltp.tactile.shear.slip import MODELS
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.figures import write_figures
from tacgrasp.benchmarks.pool import each_result

T = TypeVar("T")

WRITE_EVERY = 5
"""Seeds between two writings."""


def read_results(
    path: Path | None,
    benchmark: str,
    about: Mapping[str, Any],
    read: Callable[[Any], T],
    *,
    resume: bool,
) -> dict[str, T]:
    """Earlier results by name; none without a file or in an empty one.

    Args:
        path: File of ``--json``.
        benchmark: Name of the benchmark.
        about: What is measured now.
        read: Reads one result from types of JSON.
        resume: Whether to go on with what the file holds.

    Raises:
        UsageError: The file holds figures and ``resume`` is not set, or those of something else.
    """
    if path is None or not path.is_file() or path.stat().st_size == 0:
        return {}
    if not resume:
        raise UsageError(
            f"--json {path} holds something already: --resume goes on with figures, or name "
            "another file"
        )
    try:
        stored = json.loads(path.read_text(encoding="utf-8"))
        was = dict(stored["about"])
        results = {name: read(each) for name, each in stored["results"].items()}
    except (OSError, ValueError, TypeError, KeyError, AttributeError):
        raise _foreign(path, benchmark) from None
    differing = [
        f"{name} {was.get(name)!r} instead of {value!r}"
        for name, value in about.items()
        if was.get(name) != value
    ]
    if differing:
        raise UsageError(
            f"--json {path} holds figures of {', '.join(differing)}; name another file"
        )
    return results


def _foreign(path: Path | None, benchmark: str) -> UsageError:
    """The error for a file that holds no results of a benchmark."""
    return UsageError(
        f"--json {path} does not hold figures of bench {benchmark} to go on with; name another file"
    )


def weights_sum(weights: Path) -> str:
    """What names weights: the checksum of their manifests, which hold those of their files."""
    return _checksum(weights.glob("*/manifest.json"))


def shear_models_sum() -> str:
    """What names the models that tell slips and reserves: the checksum of their files."""
    return _checksum(MODELS.glob("*.npz"))


def _checksum(files: Iterable[Path]) -> str:
    total = hashlib.sha256()
    for path in sorted(files):
        total.update(path.read_bytes())
    return total.hexdigest()[:16]


@dataclass(slots=True, kw_only=True)
class SeedResults:
    """Results of a benchmark by part and seed.

    Attributes:
        path: File of ``--json``; None keeps the results in memory alone.
        about: What is measured; its ``benchmark`` is the name of the benchmark.
        results: By part, then by seed, in types of JSON.
    """

    path: Path | None
    about: Mapping[str, Any]
    results: dict[str, dict[str, Any]] = field(default_factory=dict)

    def read(self, *, resume: bool) -> None:
        """Read earlier results.

        Raises:
            UsageError: As ``read_results``.
        """
        benchmark = self.about["benchmark"]
        self.results = read_results(self.path, benchmark, self.about, dict, resume=resume)

    def map_seeds(
        self,
        console: Console,
        part: str,
        kind: Any,
        function: Callable[[int], T],
        seeds: Sequence[int],
    ) -> list[T]:
        """Results of a function for each seed, in their order; only missing ones are computed.

        They are written after every few seeds and on every way out.

        Args:
            console: Shows the progress when it is a terminal.
            part: Name of these results, and words beside the progress bar.
            kind: Type of one result, as in an annotation.
            function: As for ``tacgrasp.benchmarks.pool.each_result``.
            seeds: Random seeds.

        Raises:
            UsageError: Earlier results are not of this kind, or the file can't be written.
        """
        adapter, known = TypeAdapter[T](kind), self.results.setdefault(part, {})
        missing = [seed for seed in seeds if str(seed) not in known]
        unwritten = 0
        try:
            each = each_result(console, part, function, missing)
            for seed, result in zip(missing, each, strict=True):
                known[str(seed)] = adapter.dump_python(result, mode="json")
                unwritten += 1
                if unwritten == WRITE_EVERY:
                    unwritten = 0
                    self._keep()
        finally:
            if unwritten:
                self._keep()
        try:
            return [adapter.validate_python(known[str(seed)]) for seed in seeds]
        except ValueError:
            raise _foreign(self.path, self.about["benchmark"]) from None

    def write(self, figures: Mapping[str, Any]) -> None:
        """Write the figures, with the results.

        Raises:
            UsageError: The file can't be written.
        """
        about = {"about": dict(self.about), "results": self.results}
        write_figures(self.path, {**figures, **about})

    def _keep(self) -> None:
        """Write the results alone; not into a pipe, whose reader expects one document."""
        if self.path is None or (self.path.exists() and not self.path.is_file()):
            return
        self.write({})
