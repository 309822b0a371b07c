"""A generation that is killed again and again, or made in parts, gives the undisturbed bytes."""

import hashlib
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from cltp.data.dataset import ContactDataset
from tacgrasp.datasets.generate import is_complete
from tests.paths import ROOT

CONTACTS, SEED, KILLS, PARTS = 600, 0, 20, 3


def command(out: Path, *more: str) -> list[str]:
    flags = ["--out", str(out), "--contacts", str(CONTACTS), "--seed", str(SEED), *more]
    return [sys.executable, "-m", "tacgrasp", "data", "generate", *flags]


def make(out: Path, *more: str) -> None:
    subprocess.run(command(out, *more), check=True, cwd=ROOT, stderr=subprocess.DEVNULL)


def killed_after(out: Path, seconds: float) -> bool:
    """Kill a generation; False if it had ended before. Its workers end with it."""
    with subprocess.Popen(
        command(out, "--workers", "2"), stderr=subprocess.DEVNULL, cwd=ROOT
    ) as process:
        try:
            process.wait(seconds)
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            return True
    return False


def digests(folder: Path) -> dict[str, str]:
    return {
        path.name: hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(folder.iterdir())
    }


def claims_too_much(folder: Path) -> bool:
    """Whether an interrupted folder calls itself whole without being so."""
    if not (folder / "dataset.json").exists() or not any(folder.glob("shard-*.parquet")):
        return False
    return is_complete(folder) and len(ContactDataset(folder, partial=True)) != CONTACTS


@pytest.mark.slow
def test_killed_at_random_and_in_parts_the_bytes_are_the_same(tmp_path: Path) -> None:
    whole, killed, joined = tmp_path / "whole", tmp_path / "killed", tmp_path / "joined"
    began = time.monotonic()
    make(whole, "--workers", "1")
    longest_s = max(8.0, (time.monotonic() - began) / 3)
    draw, kills = random.Random(SEED), 0
    for _ in range(10 * KILLS):
        if kills == KILLS:
            break
        if killed.exists() and is_complete(killed):
            shutil.rmtree(killed)  # complete in spite of the kills so far: begin anew
        if killed_after(killed, draw.uniform(0.3, longest_s)):
            kills += 1
            assert not claims_too_much(killed)
    assert kills == KILLS
    make(killed, "--workers", "2")
    joined.mkdir()
    for part in range(1, PARTS + 1):
        make(tmp_path / f"part{part}", "--shard", f"{part}/{PARTS}")
        shutil.copytree(tmp_path / f"part{part}", joined, dirs_exist_ok=True)
    make(joined, "--workers", "1")
    assert digests(killed) == digests(whole)
    assert digests(joined) == digests(whole)
