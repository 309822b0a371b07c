"""Kill the generation of a data set at random moments: ``tacgrasp bench generate --kills 10``.

One data set is made undisturbed by a single process; the same one is then made by two workers that
are killed with SIGKILL again and again, and a third time in three parts, in folders of their own,
that are put together. All files must have the same bytes.

Not here: kills of recordings (``tacgrasp.benchmarks.loop.crash``).
"""

from __future__ import annotations

import hashlib
import json
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import asdict, dataclass
from pathlib import Path

from rich.console import Console

from cltp.data.dataset import ContactDataset
from tacgrasp.base.errors import UsageError
from tacgrasp.datasets.generate import is_complete

PARTS = 3
START_S = 8.0
"""Kills come at most this long, or a third of the undisturbed time, after a start [s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class GenerateFigures:
    """What the benchmark found.

    Attributes:
        contacts: In the data set.
        seconds: That one process took undisturbed [s].
        kills: Processes that were killed before they had ended.
        complete_when_killed: Folders that claimed to be whole right after a kill that was not.
        shards_at_kill: How many shards were safe at each kill.
        same_after_kills: Whether all files have the bytes of the undisturbed run.
        same_in_parts: Whether those of the parts that were put together have.
        checksum: Of the undisturbed data set.
    """

    contacts: int
    seconds: float
    kills: int
    complete_when_killed: int
    shards_at_kill: list[int]
    same_after_kills: bool
    same_in_parts: bool
    checksum: str


def run(
    kills: int,
    contacts: int,
    json_path: Path | None = None,
    *,
    seed: int = 0,
    console: Console | None = None,
) -> bool:
    """Make, kill, compare, print; whether all bytes were the same.

    Raises:
        UsageError: Numbers that make no sense.
    """
    if kills < 1 or contacts < 1:
        raise UsageError(f"expected at least 1 kill and 1 contact, got {kills} and {contacts}")
    console = console or Console(stderr=True)
    with tempfile.TemporaryDirectory(prefix="tacgrasp-generate-") as folder:
        figures = _measure(Path(folder), kills, contacts, seed, console)
    for name, value in asdict(figures).items():
        console.print(f"{name.replace('_', ' '):>22}  {value}")
    if json_path is not None:
        json_path.write_text(json.dumps(asdict(figures), indent=2) + "\n")
    return figures.same_after_kills and figures.same_in_parts and not figures.complete_when_killed


def _measure(
    folder: Path, kills: int, contacts: int, seed: int, console: Console
) -> GenerateFigures:
    whole, killed, joined = folder / "whole", folder / "killed", folder / "joined"
    began = time.monotonic()
    subprocess.run(_command(whole, contacts, seed, "--workers", "1"), check=True)
    seconds = time.monotonic() - began
    draw = random.Random(seed)
    struck, lied = 0, 0
    safe: list[int] = []
    for _ in range(10 * kills):
        if struck == kills:
            break
        if killed.exists() and is_complete(killed):
            shutil.rmtree(killed)  # made in spite of the kills so far: the next begin anew
        console.print(f"kill {struck + 1} of {kills}, {len(safe) and safe[-1]} shards safe")
        moment = draw.uniform(0.3, max(START_S, seconds / 3))
        if _kill_after(_command(killed, contacts, seed, "--workers", "2"), moment):
            struck += 1
            safe.append(len(list(killed.glob("shard-*.parquet"))))
            lied += _claims_too_much(killed, contacts)
    subprocess.run(_command(killed, contacts, seed, "--workers", "2"), check=True)
    joined.mkdir()
    for part in range(1, PARTS + 1):
        place = folder / f"part{part}"
        which = f"{part}/{PARTS}"
        subprocess.run(_command(place, contacts, seed, "--shard", which), check=True)
        shutil.copytree(place, joined, dirs_exist_ok=True)
    subprocess.run(_command(joined, contacts, seed, "--workers", "1"), check=True)
    return GenerateFigures(
        contacts=contacts,
        seconds=round(seconds, 1),
        kills=struck,
        complete_when_killed=lied,
        shards_at_kill=safe,
        same_after_kills=_bytes(killed) == _bytes(whole),
        same_in_parts=_bytes(joined) == _bytes(whole),
        checksum=ContactDataset(whole).checksum(),
    )


def _command(out: Path, contacts: int, seed: int, *more: str) -> list[str]:
    flags = ["--out", str(out), "--contacts", str(contacts), "--seed", str(seed), *more]
    return [sys.executable, "-m", "tacgrasp", "data", "generate", *flags]


def _kill_after(command: list[str], seconds: float) -> bool:
    """Kill a command; False if it had ended before. Its workers end with it."""
    with subprocess.Popen(command, stderr=subprocess.DEVNULL) as process:
        try:
            process.wait(seconds)
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            return True
    return False


def _claims_too_much(folder: Path, contacts: int) -> bool:
    """Whether an interrupted folder calls itself whole without being so."""
    if not (folder / "dataset.json").exists() or not any(folder.glob("shard-*.parquet")):
        return False
    stored = len(ContactDataset(folder, partial=True))
    return is_complete(folder) and stored != contacts


def _bytes(folder: Path) -> dict[str, str]:
    """SHA-256 of every file by its name."""
    return {
        path.name: hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(folder.iterdir())
    }
