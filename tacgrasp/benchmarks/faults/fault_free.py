"""Episodes without an injected fault on the emulated rig: every fault among them is spurious.

The episodes are short: one grasp, at most ``MAX_ACTIONS`` actions, one lift. All drivers, the
recorder and the wires are those of a whole run. Counts are kept in the file of the figures, and a
later run with the same file goes on.
"""

from __future__ import annotations

import json
import logging
import tempfile
import time
from contextlib import ExitStack
from dataclasses import asdict, dataclass, field
from pathlib import Path

from rich.console import Console
from rich.progress import Progress

from cltp.errors import TouchError
from primitives.errors import RobotError
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.figures import write_figures
from tacgrasp.benchmarks.settings import FaultsSettings
from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tacgrasp.config.terms import contract_of
from tacgrasp.policy_factory import make_policy
from tacgrasp.rig import emulated
from tacgrasp.run import run_recorded
from tacgrasp.runtime.outcome import EndReason

FIRST_SEED = 5_000_000
MAX_ACTIONS = 2

log = logging.getLogger(__name__)


@dataclass(slots=True, kw_only=True)
class FaultFreeCounts:
    """Counts of fault-free episodes so far; the attributes are keys of the JSON file.

    Attributes:
        load: Whether all cores were kept busy.
        episodes: Number of episodes.
        spurious: Number of those that ended with a fault, or could not begin.
        holds: Number of times that the arm was held for stale readings.
        per_s: Episodes per second, those of earlier runs included.
        ends: Number of episodes by their end.
        faults: Message of every spurious fault.
    """

    load: bool
    episodes: int = 0
    spurious: int = 0
    holds: int = 0
    per_s: float = 0.0
    ends: dict[str, int] = field(default_factory=dict)
    faults: list[str] = field(default_factory=list)

    def add(self, end: str, message: str, holds: int, seconds: float) -> None:
        earlier_s = self.episodes / self.per_s if self.per_s else 0.0
        self.episodes += 1
        self.per_s = round(self.episodes / (earlier_s + seconds), 4)
        self.holds += holds
        self.ends[end] = self.ends.get(end, 0) + 1
        if end == EndReason.FAULT.value:
            self.spurious += 1
            self.faults.append(message)


def run(settings: FaultsSettings, console: Console) -> bool:
    """Run episodes until there are ``settings.fault_free`` of them; whether none had a fault.

    Raises:
        UsageError: The file of the figures is no earlier part of this run.
    """
    counts = _earlier(settings)
    config = _short(load("strawberry", "emulated")[0])
    with Progress(console=console, transient=True) as progress:
        task = progress.add_task(
            "fault-free episodes", total=settings.fault_free, completed=counts.episodes
        )
        while counts.episodes < settings.fault_free:
            began_s = time.monotonic()
            end, message, holds = _episode(config, FIRST_SEED + counts.episodes)
            counts.add(end, message, holds, time.monotonic() - began_s)
            write_figures(settings.json, {"fault_free": asdict(counts)})
            progress.advance(task)
    ends = ", ".join(f"{number} {end}" for end, number in sorted(counts.ends.items()))
    console.print(
        f"{counts.spurious} spurious faults in {counts.episodes} fault-free episodes "
        f"{'with all cores busy' if counts.load else 'without other load'} ({ends}); the arm was "
        f"held {counts.holds} times; {counts.per_s:.3f} episodes a second"
    )
    for message in counts.faults:
        console.print(f"  {message}")
    return counts.spurious == 0


def _earlier(settings: FaultsSettings) -> FaultFreeCounts:
    path = settings.json
    if path is None or not path.is_file() or not path.stat().st_size:
        return FaultFreeCounts(load=settings.load)
    try:
        counts = FaultFreeCounts(**json.loads(path.read_text(encoding="utf-8"))["fault_free"])
    except (ValueError, KeyError, TypeError) as error:
        raise UsageError(
            f"{path} holds no counts of fault-free episodes ({error!r}): name another --json file"
        ) from None
    if counts.load != settings.load:
        earlier = "with" if counts.load else "without"
        raise UsageError(f"{path} was counted {earlier} --load: name another --json file")
    return counts


def _short(config: RunConfig) -> RunConfig:
    """The configuration of a short episode."""
    return config.model_copy(
        update={
            "policy": "rules",
            "loop": config.loop.model_copy(update={"max_steps": MAX_ACTIONS}),
            "verify": config.verify.model_copy(update={"hold_s": 0.2, "shakes": 1}),
        }
    )


def _episode(config: RunConfig, seed: int) -> tuple[str, str, int]:
    """One episode on a rig of its own: its end, its message, and the number of holds."""
    hardware = config.hardware
    if hardware is None:
        raise UsageError("rigs/emulated.yaml names no hardware")
    with tempfile.TemporaryDirectory(prefix="tacgrasp-fault-free-") as folder:
        config = config.model_copy(update={"seed": seed, "record": Path(folder)})
        try:
            with ExitStack() as stack:
                rig = emulated.start(config, hardware)
                stack.callback(rig.disconnect)
                policy = make_policy("rules", config)
                outcome, _ = run_recorded(rig, policy, config, contract_of(config))
                holds = 0 if rig.guard is None else rig.guard.num_holds
                message = f"seed {seed}: {outcome.message}; {rig.fault_counts()}"
        except (RobotError, TouchError) as error:
            log.warning("no episode with seed %d: %s", seed, error)
            return EndReason.FAULT.value, f"seed {seed}: at the start: {error}", 0
    return outcome.reason.value, message, holds
