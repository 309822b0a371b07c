"""Figures of the robustness benchmark so far: one result for each subject under each condition.

The file holds them twice: ``results``, from which a later call goes on, and ``cells``, the table.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from tacgrasp.benchmarks.figures import write_figures
from tacgrasp.benchmarks.results_file import read_results
from tacgrasp.benchmarks.robustness.conditions import GEL_NUISANCES, NUISANCES, Condition

CONTACT_SUBJECTS = ("heads", "captions")
POLICY_SUBJECTS = ("rules", "llm")
CONSTANT = "constant"
"""The most frequent class of each dimension: one row is enough, since it reads nothing."""

FIXED_FORCE = "fixed_force"
"""The best single force: one row is enough, since it feels nothing."""

ORACLE = "oracle"
VERIFIED = "verified_percent"


@dataclass(frozen=True, slots=True, kw_only=True)
class CellResult:
    """A subject under a condition.

    Attributes:
        n: Number of contacts or episodes.
        seconds: Time that each of them took [s]; with several processes, their number times less.
        values: By metric; NaN where there is none.
        limits: By metric, of an observer with exact heights; those of episodes are the oracle's.
        verified: Verified success of each episode, in the order of the seeds.
    """

    n: int
    seconds: float
    values: Mapping[str, float]
    limits: Mapping[str, float] = field(default_factory=dict)
    verified: str = ""


def job_name(subject: str, nuisance: str, condition: Condition) -> str:
    """Name of a result: conditions that are the same for a subject share one."""
    if subject in CONTACT_SUBJECTS or subject == CONSTANT:
        source = "pressed" if nuisance in GEL_NUISANCES else "data"
        return f"{subject} | {source} | {condition}"
    return f"{subject} | {condition.in_the_loop}"


@dataclass(slots=True, kw_only=True)
class Store:
    """All results, and the file that they are written to.

    Attributes:
        path: File; None keeps them in memory alone.
        about: What was measured, by which a file is recognised.
        results: By ``job_name``.
    """

    path: Path | None
    about: Mapping[str, Any]
    results: dict[str, CellResult] = field(default_factory=dict)

    def read(self, *, resume: bool) -> None:
        """Read earlier results.

        Raises:
            UsageError: The file holds figures and ``resume`` is not set, or those of something
                else.
        """
        self.results = read_results(self.path, "robustness", self.about, _read, resume=resume)

    def add(self, name: str, result: CellResult) -> None:
        """Add a result, and write the file."""
        self.results[name] = result
        write_figures(self.path, self.report())

    def report(self) -> dict[str, Any]:
        """The content of the file."""
        return {
            "about": dict(self.about),
            "cells": list(self.cells()),
            "results": {name: _plain(result) for name, result in self.results.items()},
        }

    def limits_of(self, subject: str, nuisance: str, condition: Condition) -> Mapping[str, float]:
        """Limits of a subject's figures by metric; a policy's are what the oracle achieves."""
        is_policy = subject in POLICY_SUBJECTS
        result = self.results.get(job_name(ORACLE if is_policy else subject, nuisance, condition))
        if result is None:
            return {}
        return result.values if is_policy else result.limits

    def cells(self) -> Iterator[dict[str, Any]]:
        """The table, cell by cell: each metric of each subject at each level of each nuisance."""
        subjects = (*CONTACT_SUBJECTS, *POLICY_SUBJECTS, ORACLE, CONSTANT, FIXED_FORCE)
        for nuisance, levels in NUISANCES.items():
            for level, condition in levels.items():
                for subject in subjects:
                    result = self.results.get(job_name(subject, nuisance, condition))
                    if result is None:
                        continue
                    limits = self.limits_of(subject, nuisance, condition)
                    for metric, value in result.values.items():
                        yield {
                            "nuisance": nuisance,
                            "level": level,
                            "subject": subject,
                            "metric": metric,
                            "value": _finite(value),
                            "limit": _finite(limits.get(metric, math.nan)),
                            "n": result.n,
                        }


def _finite(value: float) -> float | None:
    return round(value, 2) if math.isfinite(value) else None


def _plain(result: CellResult) -> dict[str, Any]:
    return {
        "n": result.n,
        "seconds": round(result.seconds, 4),
        "values": {name: _finite(value) for name, value in result.values.items()},
        "limits": {name: _finite(value) for name, value in result.limits.items()},
        "verified": result.verified,
    }


def _read(stored: Mapping[str, Any]) -> CellResult:
    values, limits = (
        {name: math.nan if value is None else float(value) for name, value in stored[key].items()}
        for key in ("values", "limits")
    )
    return CellResult(
        n=int(stored["n"]),
        seconds=float(stored["seconds"]),
        values=values,
        limits=limits,
        verified=str(stored["verified"]),
    )
