"""Write an episode so that no crash can take back a tick that was acknowledged.

Every tick is one MCAP chunk. ``write_tick`` returns when the chunk has been handed to the operating
system and synced to the disk; a process killed at any moment loses at most the tick in flight, and
``tacgrasp.episodes.recover`` finishes the file that it left. There is no temporary name: an
unfinished episode is found where a finished one would be.

Not here: what is in a record (``tacgrasp.episodes.record``), exports.
"""

from __future__ import annotations

import fcntl
import json
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from io import BufferedWriter
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from foxglove_schemas_protobuf.PointCloud_pb2 import PointCloud
from mcap.writer import CompressionType, Writer
from mcap_protobuf.schema import build_file_descriptor_set

from cltp.tactile.cloud import Stamp
from tacgrasp.episodes.codec import json_schema, not_finite, to_json
from tacgrasp.episodes.errors import EpisodeError
from tacgrasp.episodes.interrupts import interrupts_held
from tacgrasp.episodes.paths import refused, sync_directory
from tacgrasp.episodes.record import (
    FORMAT,
    METADATA_NAME,
    TOPIC_ACTION,
    TOPIC_CLOUD,
    TOPIC_DECISION,
    TOPIC_END,
    TOPIC_EPISODE,
    TOPIC_STATE,
    ActionMessage,
    DecisionMessage,
    EpisodeEnd,
    EpisodeHeader,
    TickRecord,
    TickState,
)
from tacgrasp.episodes.touch_message import encode_cloud, wall_ns

_JSON_TOPICS: dict[str, type] = {
    TOPIC_EPISODE: EpisodeHeader,
    TOPIC_DECISION: DecisionMessage,
    TOPIC_ACTION: ActionMessage,
    TOPIC_STATE: TickState,
    TOPIC_END: EpisodeEnd,
}

# Larger than any tick (about 20 kB): the writer never closes a chunk by itself, only at our flush.
_NEVER_BY_SIZE = 1 << 30


class EpisodeWriter:
    """Records one episode; a context manager that creates the file on entry and closes it on exit.

    Left by an exception, the file is closed as a valid MCAP file that holds every acknowledged tick
    and has no ``/end`` unless ``finish`` was called.

    Args:
        path: File to create; it must not exist.
        header: First record of the episode.
    """

    def __init__(self, path: Path, header: EpisodeHeader) -> None:
        self.path = path
        self._header = header
        self._sequence = 0
        self._channels: dict[str, int] = {}
        self._file: BufferedWriter | None = None
        self._finished = False
        self._holds_something = False

    def __enter__(self) -> Self:
        """Create the file and write the header durably.

        Raises:
            EpisodeError: The directory is missing, read-only or full, or the file exists.
        """
        header = self._json(self._header)
        try:
            self._file = _create(self.path)
        except OSError as error:
            raise EpisodeError(refused(self.path, "create", error)) from None
        _lock(self._file)
        self._mcap = Writer(self._file, chunk_size=_NEVER_BY_SIZE, compression=CompressionType.LZ4)
        try:
            with self._durably("its header"):
                self._mcap.start(profile="", library="tacgrasp")
                self._mcap.add_metadata(METADATA_NAME, _metadata(self._header))
                self._register()
                self._add(self._header.stamp, {TOPIC_EPISODE: header})
            sync_directory(self.path.parent)
        except BaseException:
            self._drop()
            self.path.unlink(missing_ok=True)  # it was created just now and holds nothing
            raise
        return self

    def write_tick(self, record: TickRecord) -> None:
        """Write one tick; it is durable when this returns.

        Raises:
            EpisodeError: The disk refused it (full, gone); the ticks before are safe in the file,
                and nothing more can be written. Or a number in it is not finite; then nothing was
                written, and the next tick can be.
        """
        state = TickState(
            index=record.index,
            phase=record.phase,
            stamp=record.stamp,
            cloud_stamp=record.cloud.stamp,
            tick_ms=record.tick_ms,
            tcp_pose=record.tcp_pose,
            gripper=record.gripper,
            note=record.note,
            commands=record.commands,
        )
        messages = {TOPIC_CLOUD: encode_cloud(record.cloud, record.stamp)}
        if record.decision is not None:
            messages[TOPIC_DECISION] = self._json(
                DecisionMessage(index=record.index, stamp=record.stamp, decision=record.decision)
            )
        if record.executed is not None:
            messages[TOPIC_ACTION] = self._json(
                ActionMessage(index=record.index, stamp=record.stamp, executed=record.executed)
            )
        messages[TOPIC_STATE] = self._json(state)
        with self._durably(f"tick {record.index}"):
            self._add(record.stamp, messages)

    def finish(self, end: EpisodeEnd) -> None:
        """Write how the episode ended. The file is closed when the context is left.

        Raises:
            EpisodeError: As for ``write_tick``; or it was finished before.
        """
        if self._finished:
            raise EpisodeError(f"{self.path} has been finished already; an episode ends once")
        message = self._json(end)
        with self._durably("its end"):
            self._add(end.stamp, {TOPIC_END: message})
            self._finished = True

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Write the summary and close the file.

        Raises:
            EpisodeError: The summary could not be written; raised only when no other error is on
                its way out, which says more.
        """
        if self._file is None:
            return
        try:
            with self._durably("its summary"):
                self._mcap.finish()
        except EpisodeError:
            if error is None:
                raise
        finally:
            self._drop()

    @contextmanager
    def _durably(self, what: str) -> Iterator[None]:
        """Write what the block adds as one chunk, flush and sync it; interrupts wait that long."""
        if self._file is None:
            raise EpisodeError(
                f"{self.path} is closed, {what} can't be written; see the error before"
            )
        with interrupts_held():
            try:
                yield
                self._mcap.flush()
                os.fsync(self._file.fileno())
                self._holds_something = True
            except BaseException as error:
                # Part of a chunk may be in the file and the MCAP writer no longer knows where it
                # is: anything added now would hide behind the damage.
                self._drop()
                if isinstance(error, OSError):
                    raise EpisodeError(self._lost(what, error)) from None
                raise

    def _register(self) -> None:
        cloud_schema = self._mcap.register_schema(
            name=PointCloud.DESCRIPTOR.full_name,
            encoding="protobuf",
            data=build_file_descriptor_set(PointCloud).SerializeToString(),
        )
        units = {"units": "mm", "frame": "gel: +x right, +y palm, z indentation into the gel"}
        self._channels[TOPIC_CLOUD] = self._mcap.register_channel(
            TOPIC_CLOUD, "protobuf", cloud_schema, units
        )
        for topic, kind in _JSON_TOPICS.items():
            text = json.dumps(json_schema(kind)).encode()
            schema = self._mcap.register_schema(f"tacgrasp.{kind.__name__}", "jsonschema", text)
            self._channels[topic] = self._mcap.register_channel(topic, "json", schema)

    def _json(self, message: Any) -> bytes:
        """Encode before anything is added: a record that can't be stored leaves the file whole."""
        kind = type(message).__name__
        try:
            data = to_json(message)
        except TypeError as error:
            raise EpisodeError(f"{self.path}: {kind} can't be recorded: {error}") from error
        if found := not_finite(data, kind):
            raise EpisodeError(f"{self.path}: {found}; expected a finite number")
        return json.dumps(data, ensure_ascii=False, allow_nan=False).encode()

    def _add(self, stamp: Stamp, messages: Mapping[str, bytes]) -> None:
        """Add the messages of one record, which share its sequence number."""
        when = wall_ns(stamp)
        for topic, data in messages.items():
            self._mcap.add_message(self._channels[topic], when, data, when, self._sequence)
        self._sequence += 1

    def _lost(self, what: str, error: OSError) -> str:
        line = refused(self.path, f"write {what} to", error)
        if not self._holds_something:
            return line
        return (
            f"{line}. What was recorded before is safe: `tacgrasp episodes recover {self.path}` "
            "makes a finished file of it"
        )

    def _drop(self) -> None:
        """Close the descriptor without writing what a failed write left in the buffer."""
        file, self._file = self._file, None
        if file is not None:
            file.raw.close()


def _create(path: Path) -> BufferedWriter:
    return path.open("xb")


def _lock(file: BufferedWriter) -> None:
    """Tell ``recover`` that this file is alive; some network disks can't, and do without."""
    with suppress(OSError):
        fcntl.flock(file.fileno(), fcntl.LOCK_EX | fcntl.LOCK_NB)


def _metadata(header: EpisodeHeader) -> dict[str, str]:
    return {
        "format": FORMAT,
        "task": header.task,
        "policy": header.policy,
        "sensor": header.sensor.name,
        "seed": "" if header.seed is None else str(header.seed),
    }
