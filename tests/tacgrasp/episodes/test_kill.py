"""A recording that is killed at a random moment loses no step that was acknowledged.

Of the long tests one strikes whole ``tacgrasp run``s. The other strikes a process that records back
to back, so that most kills hit the middle of a write.
"""

import os
import random
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import pytest
from mcap.reader import make_reader

from tacgrasp.episodes.reader import read_episode
from tacgrasp.episodes.record import Topic
from tacgrasp.episodes.recover import recover
from tests.fakes.killed_recording import WORD, checksum
from tests.paths import ROOT


def words_before_the_kill(folder: Path, kind: str, after_s: float) -> list[int]:
    """What a recording acknowledged that was killed ``after_s`` [s] after its first step."""
    theirs, ours = os.pipe()
    command = [sys.executable, "-m", "tests.fakes.killed_recording", kind, str(folder), str(ours)]
    with (folder / "output.txt").open("wb") as output:
        process = subprocess.Popen(command, stdout=output, stderr=output, pass_fds=[ours], cwd=ROOT)
    os.close(ours)
    try:
        received = b""
        while len(received) < 2 * WORD.size:  # that it is ready, and its first step
            more = os.read(theirs, WORD.size)
            assert more, (folder / "output.txt").read_text(errors="replace")
            received += more
        deadline = time.monotonic() + after_s
        os.set_blocking(theirs, False)
        while (remaining_s := deadline - time.monotonic()) > 0 and process.poll() is None:
            with suppress(BlockingIOError):
                received += os.read(theirs, 65536)
            time.sleep(min(remaining_s, 0.01))
        process.kill()
        process.wait()
        os.set_blocking(theirs, True)
        while more := os.read(theirs, 65536):
            received += more
    finally:
        process.kill()
        process.wait()
        os.close(theirs)
    return [word for (word,) in WORD.iter_unpack(received)][1:]  # the first is ready


def lost_or_changed(path: Path, acknowledged: list[int]) -> str:
    """What is wrong with a recovered recording; nothing when every acknowledged step is in it."""
    episode = read_episode(path)
    clouds = [checksum(step.cloud) for step in episode.steps]
    if not episode.complete:
        return "it is not complete after its recovery"
    if clouds[: len(acknowledged)] != acknowledged:
        return f"{len(acknowledged)} acknowledged steps, {len(clouds)} recovered, not the same"
    if [step.index for step in episode.steps] != list(range(len(clouds))):
        return "an index is missing"
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        count = sum(1 for _ in reader.iter_messages(topics=[Topic.STATE]))
    return "" if count == len(clouds) else f"the stock reader counts {count} of {len(clouds)}"


def kill(folder: Path, kind: str, after_s: float) -> None:
    folder.mkdir()
    acknowledged = words_before_the_kill(folder, kind, after_s)
    (path,) = folder.glob("*.mcap")
    recover(path)
    assert acknowledged
    assert lost_or_changed(path, acknowledged) == ""
    # the same check sees a step that is gone, and one that changed
    assert lost_or_changed(path, [*acknowledged, 0, 0])
    assert lost_or_changed(path, [acknowledged[0] ^ 1, *acknowledged[1:]])


def test_a_killed_recording_loses_no_acknowledged_step(tmp_path: Path) -> None:
    for number, after_s in enumerate([0.05, 0.15, 0.3]):
        kill(tmp_path / str(number), "record", after_s)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "kills", "longest_s"), [("record", 40, 0.6), ("run", 20, 1.2)], ids=["record", "run"]
)
def test_many_kills_lose_no_acknowledged_step(
    kind: str, kills: int, longest_s: float, tmp_path: Path
) -> None:
    draw = random.Random(0)
    for number in range(kills):
        kill(tmp_path / str(number), kind, draw.uniform(0, longest_s))
