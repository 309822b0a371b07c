"""Kill recordings at random moments and count what was lost: ``tacgrasp bench crash --kills 50``.

Each kill is SIGKILL to a real process that records ticks back to back, so that many kills strike in
the middle of a write (a real run spends most of its time elsewhere). The process acknowledges each
tick on a pipe when ``write_tick`` has returned. Afterwards the file is recovered, opened with the
stock mcap reader, and every cloud in it compared with the one that was written.

Not here: what a loop does after a crash of its own code (``tacgrasp.episodes.writer`` closes the
file then).
"""

from __future__ import annotations

import json
import os
import random
import subprocess
import sys
import tempfile
import time
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from mcap.reader import make_reader
from rich.console import Console
from rich.progress import Progress

from cltp.cloud import Stamp, TactileCloud, cloud_from_heights, grid_axes_mm
from cltp.sensors import sensor_named
from policies.policy import Decision
from primitives.devices import GripperState, Pose
from primitives.primitive import Primitive
from tacgrasp.episodes.errors import EpisodeError
from tacgrasp.episodes.places import refused
from tacgrasp.episodes.reader import read_episode
from tacgrasp.episodes.record import TOPIC_STATE, EpisodeHeader, Phase, TickRecord
from tacgrasp.episodes.recover import recover
from tacgrasp.episodes.writer import EpisodeWriter
from tacgrasp.errors import UsageError

LONGEST_S = 0.6
"""Kills come at a uniformly random moment this long from when the process is ready [s]."""

_READY = b"r"
_TICK = b"t"
_START_TIMEOUT_S = 60.0


@dataclass(frozen=True, slots=True, kw_only=True)
class KillResult:
    """What one kill did.

    Attributes:
        acknowledged: Ticks whose writing had returned when the process died.
        recovered: Ticks in the recovered file.
        mid_write: The kill struck while a tick was being written: it is in the file but was not
            acknowledged, or only a part of it is.
        intact: Every recovered tick is the one that was written, without a gap.
        stock_reader: The stock mcap reader opens the recovered file and counts the same ticks.
    """

    acknowledged: int
    recovered: int
    mid_write: bool
    intact: bool
    stock_reader: bool

    @property
    def lost(self) -> int:
        """Acknowledged ticks that are gone."""
        return max(0, self.acknowledged - self.recovered)

    @property
    def passed(self) -> bool:
        """Nothing acknowledged was lost, and what is there is right."""
        return self.lost == 0 and self.intact and self.stock_reader


def run(kills: int, json_path: Path | None) -> None:
    """Kill ``kills`` recordings, print what was lost, and write it to ``json_path`` if given.

    Raises:
        EpisodeError: An acknowledged tick was lost or changed, or the JSON can't be written.
        UsageError: Fewer than one kill.
    """
    if kills < 1:
        raise UsageError(f"--kills must be at least 1, got {kills}")
    console = Console()
    draw = random.Random(0)
    results = []
    with tempfile.TemporaryDirectory() as directory, Progress(console=console) as progress:
        task = progress.add_task("killing recordings", total=kills)
        for number in range(kills):
            path = Path(directory) / f"crash-{number}.mcap"
            results.append(kill_once(path, draw.uniform(0, LONGEST_S)))
            progress.advance(task)
    report = summarise(results)
    console.print(
        f"{kills} × SIGKILL: {report['ticks_acknowledged']} ticks acknowledged, "
        f"{report['ticks_recovered']} recovered, {report['ticks_lost']} lost "
        f"(at most {report['most_lost_by_one_kill']} by one kill); "
        f"{report['struck_mid_write']} kills struck in mid-write; "
        f"{report['opened_by_stock_reader']} of {kills} files opened by the stock mcap reader"
    )
    if json_path is not None:
        try:
            json_path.write_text(json.dumps(report, indent=2) + "\n", encoding="utf-8")
        except OSError as error:
            raise EpisodeError(refused(json_path, "write", error)) from None
    if failed := [i for i, result in enumerate(results) if not result.passed]:
        raise EpisodeError(f"kills {failed} lost or changed acknowledged ticks; this is a bug")


def summarise(results: list[KillResult]) -> dict[str, object]:
    """The report of ``--json``; counts are of ticks unless the name says otherwise."""
    return {
        "kills": len(results),
        "ticks_acknowledged": sum(r.acknowledged for r in results),
        "ticks_recovered": sum(r.recovered for r in results),
        "ticks_lost": sum(r.lost for r in results),
        "most_lost_by_one_kill": max(r.lost for r in results),
        "struck_mid_write": sum(r.mid_write for r in results),
        "intact_files": sum(r.intact for r in results),
        "opened_by_stock_reader": sum(r.stock_reader for r in results),
        "passed": all(r.passed for r in results),
        "each": [asdict(r) for r in results],
    }


def kill_once(path: Path, after_s: float) -> KillResult:
    """Record to ``path`` in a process of its own, kill that after ``after_s`` [s], look at it.

    Raises:
        EpisodeError: The process did not start to record.
    """
    acknowledged = _record_and_kill(path, after_s)
    before = read_episode(path)
    torn = "inside a record" in before.problem
    recover(path)
    after = read_episode(path)
    intact = after.complete and all(
        tick.index == i and np.array_equal(tick.cloud.points_mm, cloud_of(i).points_mm)
        for i, tick in enumerate(after.ticks)
    )
    return KillResult(
        acknowledged=acknowledged,
        recovered=len(after.ticks),
        mid_write=torn or len(after.ticks) > acknowledged,
        intact=intact,
        stock_reader=_count_with_stock_reader(path) == len(after.ticks),
    )


def _record_and_kill(path: Path, after_s: float) -> int:
    """Returns how many ticks the process acknowledged before it died."""
    command = [sys.executable, "-c", "from tacgrasp import bench_crash; bench_crash.record()"]
    # Unbuffered, and its own pipe: what the process wrote before it died stays in it.
    process = subprocess.Popen(
        [*command, str(path)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, bufsize=0
    )
    assert process.stdout is not None and process.stderr is not None
    try:
        if process.stdout.read(1) != _READY:
            raise EpisodeError(f"the recording did not start: {process.stderr.read().decode()}")
        deadline = time.monotonic() + after_s
        acknowledged = 0
        os.set_blocking(process.stdout.fileno(), False)
        while (left_s := deadline - time.monotonic()) > 0:
            acknowledged += len(process.stdout.read(65536) or b"")
            time.sleep(min(left_s, 0.01))
    finally:
        process.kill()
        process.wait(_START_TIMEOUT_S)
    os.set_blocking(process.stdout.fileno(), True)
    acknowledged += len(process.stdout.read())
    process.stdout.close()
    process.stderr.close()
    return acknowledged


def _count_with_stock_reader(path: Path) -> int:
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        return sum(1 for _ in reader.iter_messages(topics=[TOPIC_STATE]))


def record() -> None:
    """What the process does: record to ``sys.argv[1]`` until killed, a byte on stdout a tick."""
    path = Path(sys.argv[1])
    header = EpisodeHeader(
        task="crash",
        instruction="record until killed",
        policy="none",
        seed=0,
        sensor=sensor_named("gelsight_mini"),
        config_yaml="",
        versions={},
        stamp=_now(),
    )
    with EpisodeWriter(path, header) as writer:
        os.write(sys.stdout.fileno(), _READY)
        index = 0
        while True:
            writer.write_tick(_tick(index))
            os.write(sys.stdout.fileno(), _TICK)
            index += 1


def cloud_of(index: int) -> TactileCloud:
    """The cloud of tick ``index``: a ball's cap that wanders over the pad, with fine noise."""
    sensor = sensor_named("gelsight_mini")
    rng = np.random.default_rng(index)
    x, y = np.meshgrid(*grid_axes_mm(sensor, 60, 80))
    centre = rng.uniform(-4.0, 4.0, 2)
    squared = (x - centre[0]) ** 2 + (y - centre[1]) ** 2
    heights = np.maximum(0.5 - squared / 25.0, 0.0) + rng.normal(0.0, 0.01, x.shape)
    return cloud_from_heights(heights, sensor, rng=rng)


def _tick(index: int) -> TickRecord:
    return TickRecord(
        index=index,
        phase=Phase.TICK,
        cloud=cloud_of(index),
        decision=Decision(
            text=f"This is touch {index}. The grasp is off centre; I will move_down.",
            action=Primitive.MOVE_DOWN,
            success=False,
            reason="names move_down",
        ),
        executed=None,
        tcp_pose=Pose(position_m=np.zeros(3), rotvec_rad=np.zeros(3)),
        gripper=GripperState(width_m=0.03, force_n=1.0, closed=True),
        stamp=_now(),
        tick_ms=1.0,
    )


def _now() -> Stamp:
    return Stamp(monotonic_s=time.monotonic(), wall_s=time.time())
