"""Run the fault benchmark on one emulated rig, with progress, and write its figures."""

from __future__ import annotations

import json
import logging
from collections.abc import Callable, Sequence
from contextlib import closing
from dataclasses import asdict
from pathlib import Path

from rich.progress import Progress

from sim.emulators.process.spawn import EmulatorProcess
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.faults.cases import FaultCase, InjectionPhase
from tacgrasp.benchmarks.faults.injection import FaultBench
from tacgrasp.benchmarks.faults.table import FaultRow, markdown_of, row_of, table_of
from tacgrasp.config.layers import load
from tacgrasp.console import make_console

log = logging.getLogger(__name__)


def run(
    cases: Sequence[FaultCase],
    *,
    repeats: int,
    json_path: Path | None,
    markdown_path: Path | None,
) -> bool:
    """Inject every fault ``repeats`` times, print and write the table.

    Returns:
        True when every fault met the requirements in every repeat.

    Raises:
        RobotError: The emulators did not start.
    """
    config, _ = load("strawberry", "emulated")
    if config.hardware is None:
        raise UsageError("rigs/emulated.yaml names no hardware")
    console, rows = make_console(), []
    logging.getLogger("tacgrasp.drivers").setLevel(logging.CRITICAL)  # faults are intended here
    with EmulatorProcess("rig") as emulators, Progress(console=console, transient=True) as progress:
        task = progress.add_task("faults", total=len(cases) * repeats)
        with closing(FaultBench(config, config.hardware, emulators)) as bench:
            for case in cases:
                rows.append(_row(bench, case, repeats, lambda: progress.advance(task)))
    console.print(table_of(rows))
    passed = sum(row.passed for row in rows)
    console.print(f"{passed} of {len(rows)} faults met the requirements in every repeat")
    if json_path is not None:
        json_path.write_text(json.dumps({"faults": [asdict(r) for r in rows]}, indent=1), "utf-8")
    if markdown_path is not None:
        command = f"tacgrasp bench faults --repeats {repeats}"
        markdown_path.write_text(markdown_of(rows, command), encoding="utf-8")
    return passed == len(rows)


def _row(bench: FaultBench, case: FaultCase, repeats: int, advance: Callable[[], None]) -> FaultRow:
    results = []
    for repeat in range(repeats):
        in_episode = repeat == repeats - 1 and case.phase is not InjectionPhase.START
        results.append(bench.inject(case, in_episode=in_episode))
        advance()
    return row_of(case, results)
