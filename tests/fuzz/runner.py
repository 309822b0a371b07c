"""Feed one parser mutated inputs, and keep those that it did not take as its documentation says.

A case follows from parser, seed and number alone, so that a run can go on where another ended and
any case can be made again.
"""

from __future__ import annotations

import json
import resource
import signal
import time
import traceback
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from random import Random

from cltp.atomic_write import write_atomically
from tests.fuzz.target import FuzzTarget

MAX_CASE_S = 1.0
"""Longest time of the processor for one case [s]."""

MAX_CASE_MIB = 500.0
"""Most memory that one case may add [MiB]."""

HANG_S = 20
"""After this a case is interrupted [s]."""

SAVE_EVERY = 5000
SHOWN_FINDINGS = 100


@dataclass(slots=True, kw_only=True)
class FuzzResult:
    """Figures of one parser.

    Attributes:
        parser: Name of the target.
        cases: Number of cases so far.
        undocumented: Number of cases with another error than the documented ones, too slow or with
            too much memory.
        slowest_s: Longest time of the processor for a case [s].
        peak_mib: Memory that the parser added to that of the process, at most [MiB].
    """

    parser: str
    cases: int = 0
    undocumented: int = 0
    slowest_s: float = 0.0
    peak_mib: float = 0.0


class _HangError(BaseException):
    """A case took longer than ``HANG_S``."""


def case_of(target: FuzzTarget, seed: int, number: int) -> bytes:
    """The input of one case."""
    return target.make_case(Random(f"{target.name}:{seed}:{number}"))


def fuzz(
    target: FuzzTarget, cases: int, seed: int, out: Path, *, budget_s: float | None = None
) -> FuzzResult:
    """Run a parser's cases up to number ``cases``, going on from the figures in ``out``, if any.

    Args:
        target: The parser.
        cases: Number of cases in total.
        seed: Random seed.
        out: Folder of figures and failing inputs.
        budget_s: End earlier, after this time of the processor [s].
    """
    out.mkdir(parents=True, exist_ok=True)
    figures = out / f"{target.name}-{seed}.json"
    result = FuzzResult(parser=target.name)
    if figures.exists():
        result = FuzzResult(**json.loads(figures.read_text()))
    _warm_up(target)
    before_mib, began_s = _peak_mib(), time.thread_time()
    with warnings.catch_warnings(), _hangs_interrupted():
        warnings.simplefilter("ignore")
        while result.cases < cases:
            if budget_s is not None and time.thread_time() - began_s > budget_s:
                break
            finding = _run_case(target, seed, result, before_mib)
            if finding:
                result.undocumented += 1
                if result.undocumented <= SHOWN_FINDINGS:
                    name = f"{target.name}-{seed}-{result.cases}"
                    (out / f"{name}.bin").write_bytes(case_of(target, seed, result.cases))
                    (out / f"{name}.txt").write_text(finding)
            result.cases += 1
            if result.cases % SAVE_EVERY == 0:
                write_atomically(figures, json.dumps(asdict(result)))
    write_atomically(figures, json.dumps(asdict(result)))
    return result


def _run_case(target: FuzzTarget, seed: int, result: FuzzResult, before_mib: float) -> str:
    """What is wrong with one case; nothing if it was read or refused as documented."""
    data = case_of(target, seed, result.cases)
    finding, before_s, peak_mib = "", time.thread_time(), _peak_mib()
    signal.alarm(HANG_S)
    try:
        target.read(data)
    except target.documented as error:
        if "\n" in str(error):
            finding = f"an error of several lines: {error}"
    except (Exception, _HangError):
        finding = traceback.format_exc()
    finally:
        signal.alarm(0)
    took_s, added_mib = time.thread_time() - before_s, _peak_mib() - peak_mib
    result.slowest_s = max(result.slowest_s, round(took_s, 3))
    result.peak_mib = max(result.peak_mib, round(_peak_mib() - before_mib, 1))
    if not finding and took_s > MAX_CASE_S:
        finding = f"took {took_s:.2f} s of the processor"
    if not finding and added_mib > MAX_CASE_MIB:
        finding = f"took {added_mib:.0f} MiB more"
    return finding


def _warm_up(target: FuzzTarget) -> None:
    """Import and allocate what every case shares, so that none is charged for it."""
    for number in range(3):
        try:
            target.read(case_of(target, 0, number))
        except Exception:
            continue


def _peak_mib() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


@contextmanager
def _hangs_interrupted() -> Iterator[None]:
    def interrupt(*_: object) -> None:
        raise _HangError

    before = signal.signal(signal.SIGALRM, interrupt)
    try:
        yield
    finally:
        signal.signal(signal.SIGALRM, before)
