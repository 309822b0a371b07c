"""Kill recordings at random moments and count what was lost: ``tacgrasp bench crash --kills 50``.

Every fifth kill strikes a real ``tacgrasp run --task strawberry``; the others strike a process that
records ticks back to back, so that most of them hit the middle of a write (a real run is elsewhere
nearly all the time). Both acknowledge each tick on a pipe of their own, with a checksum of its
cloud, when ``write_tick`` has returned. Afterwards the file is recovered, opened with the stock
mcap reader, and its clouds compared with the checksums.

Not here: what a crash of the loop's own code leaves (``tacgrasp.episodes.writer`` closes the file).
"""

from __future__ import annotations

import itertools
import json
import os
import random
import struct
import subprocess
import sys
import tempfile
import time
import zlib
from contextlib import suppress
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from mcap.reader import make_reader
from rich.console import Console
from rich.progress import Progress

from cltp.tactile.cloud import Stamp, TactileCloud, cloud_from_heights, grid_axes_mm
from cltp.tactile.sensors import sensor_named
from policies.policy import Decision
from primitives.devices import GripperState, Pose
from primitives.primitive import Primitive
from tacgrasp.base.errors import UsageError
from tacgrasp.episodes.errors import EpisodeError
from tacgrasp.episodes.paths import refused
from tacgrasp.episodes.reader import read_episode
from tacgrasp.episodes.record import TOPIC_STATE, EpisodeHeader, Phase, TickRecord
from tacgrasp.episodes.recover import recover
from tacgrasp.episodes.writer import EpisodeWriter

LONGEST_S = 0.6
"""Kills come at a uniformly random moment this long from when the process is ready [s]."""

REAL_EVERY = 5
"""One kill in so many strikes a whole run, which takes seconds to start. Our choice."""

REAL_LONGEST_S = 1.2
"""The same for a whole run, from its first tick on; each takes a fraction of a second [s]."""

_READY = 0xFFFF_FFFF_FFFF_FFFF
_WORD = struct.Struct("<Q")  # on the pipe: ready, or the checksum of an acknowledged cloud


@dataclass(frozen=True, slots=True, kw_only=True)
class KillResult:
    """What one kill did.

    Attributes:
        real_run: It struck ``tacgrasp run``, not the process that only records.
        acknowledged: Ticks whose writing had returned when the process died.
        recovered: Ticks in the recovered file.
        mid_write: The kill struck while a tick was being written: it is in the file but was not
            acknowledged, or only a part of it is.
        intact: Every acknowledged cloud is there as it was written, and no index is missing.
        stock_reader: The stock mcap reader opens the recovered file and counts the same ticks.
    """

    real_run: bool
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
            folder = Path(directory) / str(number)
            folder.mkdir()
            real = number % REAL_EVERY == REAL_EVERY - 1
            after_s = draw.uniform(0, REAL_LONGEST_S if real else LONGEST_S)
            results.append(kill_once(folder, after_s, real_run=real))
            progress.advance(task)
    report = summarise(results)
    console.print(
        f"{kills} × SIGKILL ({report['real_runs']} to real runs): "
        f"{report['ticks_acknowledged']} ticks acknowledged, "
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
        "real_runs": sum(r.real_run for r in results),
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


def kill_once(folder: Path, after_s: float, *, real_run: bool = False) -> KillResult:
    """Record into an empty ``folder`` in another process, kill that after ``after_s`` [s], look.

    Raises:
        EpisodeError: The process did not start to record.
    """
    acknowledged = _record_and_kill(folder, after_s, real_run)
    (path,) = folder.glob("*.mcap")
    torn = "inside a record" in read_episode(path).problem
    recover(path)
    after = read_episode(path)
    clouds = [_checksum(tick.cloud) for tick in after.ticks]
    indexes = [tick.index for tick in after.ticks]
    return KillResult(
        real_run=real_run,
        acknowledged=len(acknowledged),
        recovered=len(clouds),
        mid_write=torn or len(clouds) > len(acknowledged),
        intact=after.complete
        and clouds[: len(acknowledged)] == acknowledged
        and indexes == list(range(len(indexes))),
        stock_reader=_count_with_stock_reader(path) == len(clouds),
    )


def _record_and_kill(folder: Path, after_s: float, real_run: bool) -> list[int]:
    """Checksums of the clouds that the process acknowledged before it died."""
    theirs, ours = os.pipe()
    code = "from tacgrasp.benchmarks.loop import crash; crash.child()"
    kind = "run" if real_run else "record"
    with (folder / "output.txt").open("wb") as output:
        process = subprocess.Popen(
            [sys.executable, "-c", code, kind, str(folder), str(ours)],
            stdout=output,
            stderr=output,
            pass_fds=[ours],
        )
    os.close(ours)
    try:
        said = _wait_for_words(theirs, 2 if real_run else 1, folder / "output.txt")
        deadline = time.monotonic() + after_s
        os.set_blocking(theirs, False)
        while (left_s := deadline - time.monotonic()) > 0 and process.poll() is None:
            with suppress(BlockingIOError):
                said += os.read(theirs, 65536)
            time.sleep(min(left_s, 0.01))
        process.kill()
        process.wait()
        os.set_blocking(theirs, True)
        while more := os.read(theirs, 65536):
            said += more
    finally:
        process.kill()
        process.wait()
        os.close(theirs)
    words = [word for (word,) in _WORD.iter_unpack(said)]
    return words[1:]  # the first is ready


def _wait_for_words(pipe: int, count: int, output: Path) -> bytes:
    """What came first on the pipe; a run is in mid-episode after its first tick, not before."""
    said = b""
    while len(said) < count * _WORD.size:
        if not (more := os.read(pipe, _WORD.size)):  # it ended already
            text = output.read_text(errors="replace").strip()
            raise EpisodeError(f"the recording to be killed did not start; it said: {text}")
        said += more
    return said


def _checksum(cloud: TactileCloud) -> int:
    return zlib.crc32(cloud.points_mm.tobytes())


def _count_with_stock_reader(path: Path) -> int:
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        return sum(1 for _ in reader.iter_messages(topics=[TOPIC_STATE]))


def child() -> None:
    """What the killed process does: ``run`` or ``record``, the folder, the pipe to acknowledge on.

    The writer is wrapped rather than given a hook, since nothing but this bench needs one.
    """
    kind, folder, pipe = sys.argv[1], Path(sys.argv[2]), int(sys.argv[3])
    enter, write_tick = EpisodeWriter.__enter__, EpisodeWriter.write_tick

    def enter_and_tell(self: EpisodeWriter) -> EpisodeWriter:
        entered = enter(self)
        os.write(pipe, _WORD.pack(_READY))
        return entered

    def write_and_tell(self: EpisodeWriter, record: TickRecord) -> None:
        write_tick(self, record)
        os.write(pipe, _WORD.pack(_checksum(record.cloud)))

    EpisodeWriter.__enter__ = enter_and_tell  # type: ignore
    EpisodeWriter.write_tick = write_and_tell  # type: ignore[method-assign]
    if kind == "run":
        from tacgrasp.__main__ import main

        sys.exit(main(["run", "--task", "strawberry", "--record", str(folder)]))
    _record_until_killed(folder / "crash.mcap")


def _record_until_killed(path: Path) -> None:
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
        for index in itertools.count():
            writer.write_tick(_tick(index))


def _cloud(index: int) -> TactileCloud:
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
        cloud=_cloud(index),
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
