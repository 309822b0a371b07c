"""What the UR arm's worker and its owner tell each other: fixed layouts, nothing pickled.

Orders go down a pipe, one fixed-size record each; the end of the pipe tells the worker that its
owner is gone. The state comes back in a block of shared memory that the worker alone writes: a
checksum tells a torn read. Clocks are CLOCK_MONOTONIC, which all processes of a machine share.
"""

from __future__ import annotations

import math
import mmap
import os
import struct
import tempfile
import zlib
from dataclasses import dataclass
from enum import IntEnum

from primitives.errors import RobotError

TEXT_BYTES = 480


class ArmCommand(IntEnum):
    """What the worker is told to do."""

    MOVE = 1
    STOP = 2
    END = 3


class WorkerPhase(IntEnum):
    """Where the worker is in its life."""

    STARTING = 1
    READY = 2
    FAULT = 3
    ENDED = 4


class CommandOutcome(IntEnum):
    """How the order of ``WorkerState.done`` ended."""

    NONE = 0
    DONE = 1
    REFUSED = 2
    STOPPED = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class CommandRecord:
    """One order.

    Attributes:
        order: What to do.
        number: Rises by one from order to order.
        sent_s: When it was given, monotonic [s].
        pose: Of a move, six numbers [m, rad].
        speed_m_s, acceleration_m_s2: Of a move.
    """

    order: ArmCommand
    number: int
    sent_s: float
    pose: tuple[float, ...] = (0.0,) * 6
    speed_m_s: float = 0.0
    acceleration_m_s2: float = 0.0

    def packed(self) -> bytes:
        """As it goes down the pipe; short enough that a write is never split."""
        return _COMMAND.pack(
            self.order, self.number, self.sent_s, *self.pose,
            self.speed_m_s, self.acceleration_m_s2,
        )  # fmt: skip

    @classmethod
    def unpacked(cls, data: bytes) -> CommandRecord:
        """The order in ``COMMAND_BYTES`` bytes.

        Raises:
            ValueError: It is none.
        """
        order, number, sent_s, *pose, speed, acceleration = _COMMAND.unpack(data)
        return cls(
            order=ArmCommand(order), number=number, sent_s=sent_s, pose=tuple(pose),
            speed_m_s=speed, acceleration_m_s2=acceleration,
        )  # fmt: skip


@dataclass(slots=True, kw_only=True)
class WorkerState:
    """What the worker knows; it alone changes it.

    Attributes:
        phase: Of its life.
        done: Number of the last order that ended; ``outcome``: how.
        beat_s: When its loop last came round, monotonic [s].
        data_s: When the controller's data last changed, monotonic [s].
        pose, speed, force: Of the TCP, base frame [m, rad; m/s, rad/s; N, N m].
        speed_fraction: The speed slider, 0 to 1.
        text: While starting what it does, then the latched fault, or why an order was refused.
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
    """A distribution of times [ms], in steps of 0.1 ms; NaN where nothing was measured.

    Attributes:
        count: How many were measured.
        p50_ms, p99_ms, max_ms: Median, 99 % quantile and maximum.
    """

    count: int
    p50_ms: float
    p99_ms: float
    max_ms: float


class SharedStateBlock:
    """The shared memory of a worker and its owner.

    Attributes:
        fd: File descriptor to hand to the worker.
    """

    def __init__(self, fd: int | None = None) -> None:
        """Create the block, or open the one that the owner has handed over."""
        if fd is None:
            with tempfile.TemporaryFile() as file:
                file.truncate(BLOCK_BYTES)
                fd = os.dup(file.fileno())
        self.fd = fd
        self._memory = mmap.mmap(fd, BLOCK_BYTES)

    def write(self, state: WorkerState) -> None:
        """Publish a state (the worker)."""
        text = state.text.encode()[:TEXT_BYTES]
        body = _STATE.pack(
            state.phase, state.done, state.outcome, state.beat_s, state.data_s,
            *state.pose, *state.speed, *state.force, state.speed_fraction, text,
        )  # fmt: skip
        self._memory[: _STATE.size + _SUM.size] = body + _SUM.pack(zlib.crc32(body))

    def read(self) -> WorkerState:
        """The state that was last published whole (the owner).

        Raises:
            RobotError: None can be read.
        """
        for _ in range(1000):
            data = self._memory[: _STATE.size + _SUM.size]
            body = data[: _STATE.size]
            if zlib.crc32(body) == _SUM.unpack_from(data, _STATE.size)[0]:
                phase, done, outcome, beat_s, data_s, *numbers, text = _STATE.unpack(body)
                return WorkerState(
                    phase=phase, done=done, outcome=outcome, beat_s=beat_s, data_s=data_s,
                    pose=tuple(numbers[:6]), speed=tuple(numbers[6:12]),
                    force=tuple(numbers[12:18]), speed_fraction=numbers[18],
                    text=text.rstrip(b"\0").decode("utf-8", "ignore"),
                )  # fmt: skip
        raise RobotError("the UR arm's worker has left a torn state; reset the arm")

    def count(self, counter: int, seconds: float) -> None:
        """Add one time to a counter (the worker)."""
        at = _COUNTS_AT + counter * _COUNTS.size
        milliseconds = 1e3 * seconds
        one = at + 4 * min(NUM_BINS - 1, max(0, int(milliseconds / BIN_MS)))
        (n,) = struct.unpack_from("<I", self._memory, one)
        struct.pack_into("<I", self._memory, one, n + 1)
        most = at + 4 * NUM_BINS
        if milliseconds > struct.unpack_from("<d", self._memory, most)[0]:
            struct.pack_into("<d", self._memory, most, milliseconds)

    def distribution(self, counter: int) -> Distribution:
        """What a counter has gathered (the owner)."""
        *bins, most_ms = _COUNTS.unpack_from(self._memory, _COUNTS_AT + counter * _COUNTS.size)
        total = sum(bins)
        if total == 0:
            return Distribution(count=0, p50_ms=math.nan, p99_ms=math.nan, max_ms=math.nan)
        quantiles = []
        for share in (0.5, 0.99):
            seen, at = 0, 0
            while seen < share * total:
                seen += bins[at]
                at += 1
            quantiles.append(min(at * BIN_MS, most_ms))
        return Distribution(count=total, p50_ms=quantiles[0], p99_ms=quantiles[1], max_ms=most_ms)

    def close(self) -> None:
        """Free the memory. Idempotent."""
        if self.fd >= 0:
            self._memory.close()
            os.close(self.fd)
            self.fd = -1
