"""Run the fault benchmark on one emulated rig, with progress, and write its figures."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import asdict

from rich.progress import Progress

from sim.emulators.process.spawn import EmulatorProcess
from tacgrasp.base.errors import UsageError
from tacgrasp.base.result_file import write_page
from tacgrasp.benchmarks.faults import fault_free
from tacgrasp.benchmarks.faults.cases import CASES, InjectionPhase
from tacgrasp.benchmarks.faults.injection import FaultBench
from tacgrasp.benchmarks.faults.load import busy_cores
from tacgrasp.benchmarks.faults.table import markdown_of, row_of, table_of
from tacgrasp.benchmarks.figures import write_figures
from tacgrasp.benchmarks.settings import FaultsSettings
from tacgrasp.config.layers import load
from tacgrasp.console import make_console
from tacgrasp.drivers.scheduling import granted


@contextmanager
def _quiet_drivers() -> Iterator[None]:
    """Drivers that report no faults: here they are intended."""
    drivers = logging.getLogger("tacgrasp.drivers")
    before = drivers.level
    drivers.setLevel(logging.CRITICAL)
    try:
        yield
    finally:
        drivers.setLevel(before)


def run(settings: FaultsSettings) -> bool:
    """Inject every fault several times, print and write the table.

    Returns:
        True when every fault met the requirements in every repeat.

    Raises:
        RobotError: The emulators did not start.
    """
    repeats = settings.repeats
    cases = [case for case in CASES if settings.only.lower() in case.name.lower()]
    if repeats < 1 or not cases:
        raise UsageError(
            f"--repeats must be at least 1 and --only a part of a fault's name "
            f"({'; '.join(case.name for case in CASES)}), got {repeats} and {settings.only!r}"
        )
    config, _ = load("strawberry", "emulated")
    if config.hardware is None:
        raise UsageError("rigs/emulated.yaml names no hardware")
    console, rows = make_console(), []
    console.print(f"granted to the drivers: {granted()}")
    if settings.fault_free:
        with _quiet_drivers(), busy_cores(settings.load):
            return fault_free.run(settings, console)
    with (
        _quiet_drivers(),
        busy_cores(settings.load),
        EmulatorProcess("rig") as emulators,
        Progress(console=console, transient=True) as progress,
    ):
        task = progress.add_task("faults", total=len(cases) * repeats)
        bench = FaultBench(config, config.hardware, emulators, is_loaded=settings.load)
        with closing(bench):
            for case in cases:
                results = []
                for repeat in range(repeats):
                    in_episode = repeat == repeats - 1 and case.phase is not InjectionPhase.START
                    results.append(bench.inject(case, in_episode=in_episode))
                    progress.advance(task)
                rows.append(row_of(case, results, load=settings.load))
    console.print(table_of(rows))
    passed = sum(row.passed for row in rows)
    console.print(f"{passed} of {len(rows)} faults met the requirements in every repeat")
    write_figures(settings.json, {"faults": [asdict(row) for row in rows]})
    if settings.markdown is not None:
        command = f"tacgrasp bench faults --repeats {repeats}{' --load' * settings.load}"
        write_page(settings.markdown, markdown_of(rows, command), flag="--markdown")
    return passed == len(rows)
