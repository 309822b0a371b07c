"""``tacgrasp bench soak``: thousands of recorded episodes in one process, what they leave.

Each episode is run, printed and recorded as ``tacgrasp run`` does it, in simulated time; its file
is deleted afterwards. Memory and open files after the last episode are compared with those after
the first ``WARM_UP`` ones, by when everything is imported.
"""

from __future__ import annotations

import gc
import json
import os
import tempfile
import time
from collections import Counter
from dataclasses import asdict, dataclass, field
from pathlib import Path

from rich.console import Console

from policies import Policy
from tacgrasp.base.errors import UsageError
from tacgrasp.base.result_file import WRITTEN_BY
from tacgrasp.benchmarks.figures import write_figures
from tacgrasp.benchmarks.settings import SoakSettings
from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tacgrasp.config.terms import contract_of
from tacgrasp.console import SafeConsole, StepPrinter
from tacgrasp.policy_factory import make_policy
from tacgrasp.rig.factory import make_rig
from tacgrasp.run import run_recorded

WARM_UP = 100
"""Episodes before the first measurement of memory: by then its high-water mark has been met."""

WRITE_EVERY = 50
"""Episodes between two writings of the figures."""

MAX_GROWTH_MIB = 30.0
"""Most memory that a soak may gain. Our choice: 6 kB an episode over 5,000; numerical libraries
alone let it swing by 10 MiB."""


@dataclass(slots=True, kw_only=True)
class SoakFigures:
    """Figures of a soak so far, over all its processes.

    Attributes:
        episodes: Number of episodes.
        rss_mib_first: Memory of the first process after its warm-up [MiB].
        rss_mib_last: Memory of the last process after its last episode [MiB].
        rss_mib_growth: Memory gained after the warm-up, summed over the processes [MiB].
        fds_first, fds_last: Open files at the same moments.
        per_s: Episodes in a second.
        duration_s: Time of all episodes [s].
        processes: Number of processes; each resumption is one more.
        ends: Number of episodes by their named end.
        policy, task, first_seed: What was run.
    """

    episodes: int = 0
    rss_mib_first: float = 0.0
    rss_mib_last: float = 0.0
    rss_mib_growth: float = 0.0
    fds_first: int = 0
    fds_last: int = 0
    per_s: float = 0.0
    duration_s: float = 0.0
    processes: int = 0
    ends: dict[str, int] = field(default_factory=dict)
    policy: str
    task: str
    first_seed: int


def run(settings: SoakSettings) -> bool:
    """Run the episodes that are missing; False if memory or the number of open files grew.

    Raises:
        UsageError: An unknown policy or task, or figures of another soak in the file.
    """
    figures = _so_far(settings)
    config = load(settings.task)[0].model_copy(update={"policy": settings.policy})
    policy = make_policy(settings.policy, config)
    with tempfile.TemporaryDirectory() as folder:
        _soak(figures, settings, config.model_copy(update={"record": Path(folder)}), policy)
    console = Console(soft_wrap=True, highlight=False)
    console.print(
        f"{figures.episodes} episodes, {figures.per_s:.2f} a second, in {figures.processes} "
        f"process(es); memory {figures.rss_mib_first:.1f} to {figures.rss_mib_last:.1f} MiB, "
        f"grown by {figures.rss_mib_growth:.1f}; open files {figures.fds_first} to "
        f"{figures.fds_last}"
    )
    ends = ", ".join(f"{reason} {count}" for reason, count in sorted(figures.ends.items()))
    console.print(f"ends: {ends}")
    grown = figures.rss_mib_growth > MAX_GROWTH_MIB or figures.fds_last > figures.fds_first
    return not grown


def _soak(figures: SoakFigures, settings: SoakSettings, config: RunConfig, policy: Policy) -> None:
    """Run episodes up to the number that is asked for, and write the figures again and again."""
    first_mib, grown_mib = 0.0, figures.rss_mib_growth
    done, contract = figures.episodes, contract_of(config)
    figures.processes += done < settings.episodes
    with Path(os.devnull).open("w", encoding="utf-8") as nowhere:
        observers = [StepPrinter(SafeConsole(file=nowhere))]
        for number in range(done, settings.episodes):
            began = time.monotonic()
            seeded = config.model_copy(update={"seed": settings.first_seed + number})
            rig = make_rig(seeded)
            try:
                outcome, path = run_recorded(rig, policy, seeded, contract, observers)
            finally:
                rig.disconnect()
            path.unlink()
            figures.duration_s += time.monotonic() - began
            figures.episodes = number + 1
            figures.ends = dict(Counter(figures.ends) + Counter([outcome.reason.value]))
            if number - done == min(WARM_UP, settings.episodes - done) - 1:
                gc.collect()
                first_mib = _rss_mib()
                if figures.processes == 1:
                    figures.rss_mib_first, figures.fds_first = first_mib, _num_open_files()
            if (number + 1) % WRITE_EVERY == 0 or number + 1 == settings.episodes:
                _measure(figures, grown_mib, first_mib)
                write_figures(settings.json, asdict(figures))


def _measure(figures: SoakFigures, grown_mib: float, first_mib: float) -> None:
    gc.collect()  # what waits for the collector is not lost: up to 40 MiB of clouds and records
    figures.rss_mib_last, figures.fds_last = _rss_mib(), _num_open_files()
    if first_mib:
        figures.rss_mib_growth = round(grown_mib + figures.rss_mib_last - first_mib, 1)
    figures.per_s = round(figures.episodes / figures.duration_s, 2)


def _so_far(settings: SoakSettings) -> SoakFigures:
    asked = {
        "policy": settings.policy,
        "task": settings.task,
        "first_seed": settings.first_seed,
    }
    path = settings.json
    if path is None or not path.is_file() or path.stat().st_size == 0:
        return SoakFigures(**asked)  # type: ignore[arg-type]
    try:
        stored = json.loads(path.read_text(encoding="utf-8"))
        stored.pop(WRITTEN_BY, None)
        figures = SoakFigures(**stored)
        same = all(getattr(figures, name) == value for name, value in asked.items())
    except (OSError, ValueError, TypeError, AttributeError):
        same = False
    if not same:
        raise UsageError(
            f"--json {path} does not hold figures of a soak with policy {settings.policy}, task "
            f"{settings.task}, first seed {settings.first_seed}; name another file"
        )
    return figures


def _rss_mib() -> float:
    """Resident memory of this process [MiB]."""
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return round(pages * os.sysconf("SC_PAGE_SIZE") / 2**20, 1)


def _num_open_files() -> int:
    return len(list(Path("/proc/self/fd").iterdir()))
