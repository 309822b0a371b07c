"""How many instructions of a file become the contract that they should.

A file has the columns text, kind and expect. ``expect`` is one of:

    band V       V [N] lies in the band, and both of its ends are within 15 % of V
    range A B    the ends of the band are within 15 % of A and B [N]
    max V        the limit lies in 0.95 V to V [N]
    min V        the low end of the band lies in V to 1.1 V [N]
    softer       the band's middle is at least 15 % below the task's
    firmer       the band's middle is at least 15 % above the task's
    refuse       the instruction is refused
    task         it is not refused, and the band is the task's

A kind that is one of these words may stand with the number alone in ``expect``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

from policies.contract import read_contract
from primitives.contract import Contract, TaskTerms
from tacgrasp.base.csv_rows import csv_rows
from tacgrasp.base.errors import UsageError

KEPT_OUT = "kept_out_instructions.csv"
"""Wordings beside this file, written by someone who did not know the rules.

Their first score is in docs/contract.md. What it showed has been mended since, so that a new score
of them is no measure of unseen wordings."""

WIDTH = 0.15
MARGIN = 1e-6


@dataclass(frozen=True, slots=True, kw_only=True)
class Wording:
    """One instruction of a file.

    Attributes:
        text: The instruction.
        kind: Its family, for the table.
        expect: What it should become: a word of the module's table.
        values: Numbers of that [N].
    """

    text: str
    kind: str
    expect: str
    values: tuple[float, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Score:
    """One instruction, its contract, and whether that is right."""

    wording: Wording
    contract: Contract
    right: bool


def read_wordings(path: Path | None) -> list[Wording]:
    """Instructions of a CSV file; None takes those that come along.

    Raises:
        UsageError: The file can't be read, or a row is not of the module's table.
    """
    source = path or Path(str(resources.files("tacgrasp.lessons") / KEPT_OUT))
    rows = csv_rows(source)
    if not rows or not {"text", "expect"} <= set(rows[0]):
        raise UsageError(f"{source} needs the columns text, kind and expect, and a row")
    return [_wording(source, number, row) for number, row in enumerate(rows, start=2)]


def _wording(source: Path, line: int, row: dict[str, str]) -> Wording:
    kind = (row.get("kind") or "").strip()
    parts = (row.get("expect") or "").split()
    if parts and _is_number(parts[0]):
        parts = [kind, *parts]  # the kind says what the number is
    counts = {"band": 1, "max": 1, "min": 1, "range": 2}
    word = parts[0] if parts else kind
    values = parts[1:]
    known = word in _CHECKS and len(values) == counts.get(word, 0) and all(map(_is_number, values))
    if not known:
        raise UsageError(
            f"{source}, line {line}: expect must be one of band V, range A B, max V, min V, "
            f"softer, firmer, refuse, task; got {row.get('expect')!r}"
        )
    return Wording(
        text=row["text"] or "", kind=kind or word, expect=word, values=tuple(map(float, values))
    )


def _is_number(text: str) -> bool:
    try:
        return 0 < float(text) < float("inf")
    except ValueError:
        return False


def score(wordings: Sequence[Wording], task: TaskTerms) -> list[Score]:
    """Make the contract of every instruction and compare it."""
    scores = []
    for wording in wordings:
        contract = read_contract(wording.text, task, {})
        scores.append(
            Score(wording=wording, contract=contract, right=_is_right(wording, contract, task))
        )
    return scores


def _is_right(wording: Wording, contract: Contract, task: TaskTerms) -> bool:
    if contract.refused:
        return wording.expect == "refuse"
    return _CHECKS[wording.expect](wording.values, contract, task)


def _near(value: float, wanted: float) -> bool:
    return abs(value / wanted - 1) <= WIDTH + MARGIN


def _band(values: Sequence[float], contract: Contract, _: TaskTerms) -> bool:
    band = contract.terms.force_n
    return values[0] in band and _near(band.low, values[0]) and _near(band.high, values[0])


def _range(values: Sequence[float], contract: Contract, _: TaskTerms) -> bool:
    band = contract.terms.force_n
    return _near(band.low, values[0]) and _near(band.high, values[1])


def _max(values: Sequence[float], contract: Contract, _: TaskTerms) -> bool:
    return (0.95 - MARGIN) * values[0] <= contract.terms.limit_n <= (1 + MARGIN) * values[0]


def _min(values: Sequence[float], contract: Contract, _: TaskTerms) -> bool:
    return (1 - MARGIN) * values[0] <= contract.terms.force_n.low <= (1.1 + MARGIN) * values[0]


_CHECKS: dict[str, Callable[[Sequence[float], Contract, TaskTerms], bool]] = {
    "band": _band,
    "range": _range,
    "max": _max,
    "min": _min,
    "softer": lambda _, contract, task: (
        contract.terms.force_n.middle <= (1 - WIDTH + MARGIN) * task.force.force_n.middle
    ),
    "firmer": lambda _, contract, task: (
        contract.terms.force_n.middle >= (1 + WIDTH - MARGIN) * task.force.force_n.middle
    ),
    "refuse": lambda *_: False,
    "task": lambda _, contract, task: contract.terms.force_n == task.force.force_n,
}
