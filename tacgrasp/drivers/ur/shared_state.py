"""The messages between the UR arm's worker and its owner, in fixed layouts without pickling.

Commands go down a pipe, one record of fixed size each; the end of the pipe tells the worker that
its owner is gone. The state comes back in a block of shared memory that only the worker writes; a
checksum detects a torn read. Times are CLOCK_MONOTONIC, which all processes of a machine share.
"""

from __future__ import annotations

import bisect
import itertools
import math
import mmap
import os
import struct
import tempfile
import zlib
from dataclasses import dataclass
from enum import IntEnum
from typing import NamedTuple

from primitives.errors import RobotError

TEXT_BYTES = 480


class ArmCommand(IntEnum):
    """Kind of a command to the worker."""

    MOVE = 1
    STOP = 2
    END = 3


class WorkerPhase(IntEnum):
    """Phase in the life of the worker."""

    STARTING = 1
    READY = 2
    FAULT = 3
    ENDED = 4


class CommandOutcome(IntEnum):
    """Outcome of the command ``WorkerState.done``."""

    NONE = 0
    DONE = 1
    REFUSED = 2


class CommandRecord(NamedTuple):
    """One command.

    Attributes:
        kind: Kind of the command.
        number: Rises by one from command to command.
        sent_s: Time of sending, monotonic [s].
        pose: Target of a move, six numbers [m, rad].
        speed_m_s, acceleration_m_s2: Speed and acceleration of a move.
    """

    kind: ArmCommand
    number: int
    sent_s: float
    pose: tuple[float, ...] = (0.0,) * 6
    speed_m_s: float = 0.0
    acceleration_m_s2: float = 0.0

    def packed(self) -> bytes:
        """Bytes for the pipe, so few that a write is never split."""
        kind, number, sent_s, pose, speed_m_s, acceleration_m_s2 = self
        return _COMMAND.pack(kind, number, sent_s, *pose, speed_m_s, acceleration_m_s2)

    @classmethod
    def unpacked(cls, data: bytes) -> CommandRecord:
        """The command in ``COMMAND_BYTES`` bytes.

        Raises:
            ValueError: The bytes are no command.
        """
        kind, number, sent_s, *pose, speed, acceleration = _COMMAND.unpack(data)
        return cls(ArmCommand(kind), number, sent_s, tuple(pose), speed, acceleration)


@dataclass(slots=True)
class WorkerState:
    """State of the worker, which alone changes it.

    Attributes:
        phase: Phase of the worker's life.
        done: Number of the last finished command.
        outcome: Outcome of that command.
        beat_s: Time of the last round of supervision, monotonic [s].
        data_s: Time of the last change of the controller's data, monotonic [s].
        pose, speed, force: Of the TCP, base frame [m, rad; m/s, rad/s; N, N m].
        speed_fraction: Position of the speed slider, 0 to 1.
        text: Present step of the start; later the latched fault, or the reason of a refusal.
    """

    phase: int = WorkerPhase.STARTING
    done: int = 0
    outcome: int = CommandOutcome.NONE
    beat_s: float = 0.0
    data_s: float = 0.0
    pose: tuple[float, ...] = (0.0,) * 6
    speed: tuple[float, ...] = (0.0,) * 6
    force: tuple[float, ...] = (0.0,) * 6
    speed_fraction: float = 1.0
    text: str = ""


_COMMAND = struct.Struct("<IQd6ddd")
COMMAND_BYTES = _COMMAND.size
_STATE = struct.Struct(f"<IQIdd6d6d6dd{TEXT_BYTES}s")
_SUM = struct.Struct("<I")
_COUNTS_AT = 1024
NUM_BINS = 2000
BIN_MS = 0.1
_COUNTS = struct.Struct(f"<{NUM_BINS}Id")
NUM_COUNTERS = 2
PERIOD, MOTION = 0, 1
"""Counters: time between two rounds of supervision, and from a command to its motion."""

BLOCK_BYTES = _COUNTS_AT + NUM_COUNTERS * _COUNTS.size


@dataclass(frozen=True, slots=True, kw_only=True)
class Distribution:
    """A distribution of times [ms], in steps of 0.1 ms; NaN without measurements.

    Attributes:
        count: Number of measurements.
        p50_ms, p99_ms, max_ms: Median, 99 % quantile and maximum.
    """

    count: int
    p50_ms: float
    p99_ms: float
    max_ms: float


class SharedStateBlock:
    """The shared memory of a worker and its owner.

    Attributes:
        fd: File descriptor for the worker.
    """

    def __init__(self, fd: int | None = None) -> None:
        """Create the block, or open the block of a file descriptor from the owner."""
        if fd is None:
            with tempfile.TemporaryFile() as file:
                file.truncate(BLOCK_BYTES)
                fd = os.dup(file.fileno())
        self.fd = fd
        self._memory = mmap.mmap(fd, BLOCK_BYTES)

    def write(self, state: WorkerState) -> None:
        """Publish a state (called by the worker)."""
        text = state.text.encode()[:TEXT_BYTES]
        body = _STATE.pack(
            state.phase, state.done, state.outcome, state.beat_s, state.data_s,
            *state.pose, *state.speed, *state.force, state.speed_fraction, text,
        )  # fmt: skip
        self._memory[: _STATE.size + _SUM.size] = body + _SUM.pack(zlib.crc32(body))

    def read(self) -> WorkerState:
        """Last published state (called by the owner).

        Raises:
            RobotError: No whole state can be read.
        """
        for _ in range(1000):
            data = self._memory[: _STATE.size + _SUM.size]
            body = data[: _STATE.size]
            if zlib.crc32(body) == _SUM.unpack_from(data, _STATE.size)[0]:
                phase, done, outcome, beat_s, data_s, *numbers, fraction, raw = _STATE.unpack(body)
                pose, speed, force = (tuple(numbers[at : at + 6]) for at in (0, 6, 12))
                text = raw.rstrip(b"\0").decode("utf-8", "ignore")
                return WorkerState(
                    phase, done, outcome, beat_s, data_s, pose, speed, force, fraction, text
                )
        raise RobotError("the UR arm's worker has left a torn state; reset the arm")

    def count(self, counter: int, seconds: float) -> None:
        """Add one time to a counter (called by the worker)."""
        start = _COUNTS_AT + counter * _COUNTS.size
        milliseconds = 1e3 * seconds
        bin_at = start + 4 * min(NUM_BINS - 1, max(0, int(milliseconds / BIN_MS)))
        (count,) = struct.unpack_from("<I", self._memory, bin_at)
        struct.pack_into("<I", self._memory, bin_at, count + 1)
        max_at = start + 4 * NUM_BINS
        if milliseconds > struct.unpack_from("<d", self._memory, max_at)[0]:
            struct.pack_into("<d", self._memory, max_at, milliseconds)

    def distribution(self, counter: int) -> Distribution:
        """Distribution of a counter (called by the owner)."""
        *bins, max_ms = _COUNTS.unpack_from(self._memory, _COUNTS_AT + counter * _COUNTS.size)
        cumulative = list(itertools.accumulate(bins))
        total = cumulative[-1]
        if total == 0:
            return Distribution(count=0, p50_ms=math.nan, p99_ms=math.nan, max_ms=math.nan)
        p50_ms, p99_ms = (
            min((bisect.bisect_left(cumulative, fraction * total) + 1) * BIN_MS, max_ms)
            for fraction in (0.5, 0.99)
        )
        return Distribution(count=total, p50_ms=p50_ms, p99_ms=p99_ms, max_ms=max_ms)

    def close(self) -> None:
        if self.fd >= 0:
            self._memory.close()
            os.close(self.fd)
            self.fd = -1
