"""Write an episode so that no crash can lose a step that was acknowledged.

Every step is one MCAP chunk. ``write_step`` returns when the chunk has been handed to the operating
system and synced to the disk; a process killed at any moment loses at most the step in flight, and
``tacgrasp.episodes.recover`` finishes the file that it left. There is no temporary name: an
unfinished episode lies where a finished one would.

Not here: the contents of a record (``tacgrasp.episodes.record``).
"""

from __future__ import annotations

import fcntl
import json
import logging
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from io import BufferedWriter
from pathlib import Path
from typing import Any, Self

from foxglove_schemas_protobuf.PointCloud_pb2 import PointCloud
from mcap.writer import CompressionType, Writer
from mcap_protobuf.schema import build_file_descriptor_set

from cltp.tactile.cloud import Stamp
from tacgrasp.episodes.codec import json_schema, to_json
from tacgrasp.episodes.errors import EpisodeError
from tacgrasp.episodes.interrupts import delayed_interrupts
from tacgrasp.episodes.paths import refusal, sync_directory
from tacgrasp.episodes.record import (
    FORMAT,
    JSON_MESSAGES,
    METADATA_NAME,
    ActionMessage,
    DecisionMessage,
    EpisodeEnd,
    EpisodeHeader,
    StepRecord,
    StepState,
    Topic,
    most_json_bytes,
)
from tacgrasp.episodes.scan import MAX_BYTES
from tacgrasp.episodes.touch_message import ShearMessage, encode_cloud, wall_ns
from tacgrasp.episodes.view_messages import SCHEMAS, end_messages, step_messages

log = logging.getLogger(__name__)

CHUNK_BYTES = 1 << 30
"""Larger than any step (40 kB with 1024 points): a chunk ends only where the writer is flushed."""

SPARE_BYTES = 4_000_000
"""Bytes of a file that no step may take, for its end, schemas, indexes and summary. Our choice:
twice the longest end."""

_MESSAGE_BYTES = 31  # of a message's own head in a chunk


class EpisodeWriter:
    """Records one episode; a context manager that creates the file on entry and closes it on exit.

    After an exception the file is closed as a valid MCAP file that holds every acknowledged step,
    and has no ``/end`` unless ``finish`` was called.

    Args:
        path: File to create; it must not exist.
        header: First record of the episode.
    """

    def __init__(self, path: Path, header: EpisodeHeader) -> None:
        self.path = path
        self._header = header
        self._sequence = self._num_bytes = 0
        self._channels: dict[str, int] = {}
        self._file: BufferedWriter | None = None
        self._finished = False
        self._has_content = False
        self._contract = header.contract

    def __enter__(self) -> Self:
        """Create the file and write the header durably.

        Raises:
            EpisodeError: The directory is missing, read-only or full, or the file exists.
        """
        header = self._header
        message = self._json(Topic.EPISODE, header)
        metadata = {
            "format": FORMAT,
            "task": header.task,
            "policy": header.policy,
            "sensor": header.sensor.name,
            "seed": "" if header.seed is None else str(header.seed),
        }
        try:
            self._file = _create(self.path)
        except OSError as error:
            raise EpisodeError(refusal(self.path, "create", error)) from None
        with suppress(OSError):  # so that recover leaves it alone; some network disks have no locks
            fcntl.flock(self._file.fileno(), fcntl.LOCK_EX | fcntl.LOCK_NB)
        try:
            with self._durably("its header"):
                self._mcap = start_mcap(self._file)
                self._mcap.add_metadata(METADATA_NAME, metadata)
                self._register()
                self._add(header.stamp, {Topic.EPISODE: message})
            sync_directory(self.path.parent)
        except BaseException:
            self._drop()
            self.path.unlink(missing_ok=True)  # it was created just now and holds nothing
            raise
        return self

    def write_step(self, record: StepRecord) -> None:
        """Write one step; it is durable when this returns.

        Raises:
            EpisodeError: The disk refused it (full, gone); earlier steps are safe in the file, and
                nothing more can be written. Or a number in it is not finite, a message too long, or
                the file full; then nothing was written, and another step or the end can be.
        """
        common: dict[str, Any] = {"index": record.index, "stamp": record.stamp}
        messages: dict[str, bytes] = {Topic.CLOUD: encode_cloud(record.cloud, record.stamp)}
        if record.shear is not None:
            messages[Topic.SHEAR] = self._json(Topic.SHEAR, ShearMessage.of(record.shear, **common))
        if record.decision is not None:
            decision = DecisionMessage(**common, decision=record.decision)
            messages[Topic.DECISION] = self._json(Topic.DECISION, decision)
        if record.executed is not None:
            action = ActionMessage(**common, executed=record.executed)
            messages[Topic.ACTION] = self._json(Topic.ACTION, action)
        messages[Topic.STATE] = self._json(
            Topic.STATE,
            StepState(
                **record.shared(),
                cloud_stamp=record.cloud.stamp,
                tick_ms=record.step_ms,
                force_scale=record.cloud.force_scale,
            ),
        )
        self._contract = record.contract or self._contract
        messages |= step_messages(record, self._contract, self._header.pad)
        self._refuse_beyond(f"step {record.index}", messages)
        with self._durably(f"step {record.index}"):
            self._add(record.stamp, messages)

    def finish(self, end: EpisodeEnd) -> None:
        """Write the end of the episode. The file is closed when the context is left.

        Raises:
            EpisodeError: As for ``write_step``; or the episode was finished before.
        """
        if self._finished:
            raise EpisodeError(f"{self.path} has been finished already; an episode ends once")
        message = self._json(Topic.END, end)
        with self._durably("its end"):
            self._add(end.stamp, {Topic.END: message, **end_messages(end)})
            self._finished = True

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        """Write the summary and close the file.

        Raises:
            EpisodeError: The summary could not be written; not raised while another error, which
                explains more, is being raised.
        """
        if self._file is None:
            return
        try:
            with self._durably("its summary"):
                self._mcap.finish()
        except EpisodeError:
            if kind is None:
                raise
        finally:
            self._drop()

    @contextmanager
    def _durably(self, part: str) -> Iterator[None]:
        """Write the messages that the block adds as one chunk and sync it; interrupts wait."""
        if self._file is None:
            raise EpisodeError(
                f"{self.path} is closed, {part} can't be written; see the error before"
            )
        with delayed_interrupts():
            try:
                yield
                self._mcap.flush()
                os.fsync(self._file.fileno())
                self._has_content = True
            except BaseException as error:
                # Part of a chunk may be in the file, and the MCAP writer no longer knows its
                # position: no reader would find anything added after that damage.
                self._drop()
                if isinstance(error, OSError):
                    message = self._write_error(part, error)
                    log.error("%s", message)  # on standard error, however the run ends
                    raise EpisodeError(message) from None
                raise

    def _register(self) -> None:
        units = {"units": "m", "frame": "gel: +x right, +y palm, z indentation into the gel"}
        schemas: dict[str, int] = {}
        kinds: dict[str, Any] = {Topic.CLOUD: PointCloud, **SCHEMAS}
        for channel, kind in kinds.items():
            name = kind.DESCRIPTOR.full_name
            if name not in schemas:
                data = build_file_descriptor_set(kind).SerializeToString()
                schemas[name] = self._mcap.register_schema(name, "protobuf", data)
            metadata = units if channel == Topic.CLOUD else {}
            self._channels[channel] = self._mcap.register_channel(
                channel, "protobuf", schemas[name], metadata
            )
        for topic, (name, kind) in JSON_MESSAGES.items():
            text = json.dumps(json_schema(kind)).encode()
            schema = self._mcap.register_schema(f"tacgrasp.{name}", "jsonschema", text)
            self._channels[topic] = self._mcap.register_channel(topic, "json", schema)

    def _json(self, topic: Topic, message: Any) -> bytes:
        """Encode a message before anything is added; one that can't be stored changes no file."""
        kind = type(message).__name__
        try:
            text = json.dumps(to_json(message, kind), ensure_ascii=False, allow_nan=False)
        except TypeError as error:
            raise EpisodeError(f"{self.path}: {kind} can't be recorded: {error}") from error
        except ValueError as error:
            raise EpisodeError(f"{self.path}: {error}") from None
        data, most = text.encode(), most_json_bytes(topic)
        if len(data) > most:
            raise EpisodeError(
                f"{self.path}: {kind} has {len(data)} bytes; at most {most} can be read again"
            )
        return data

    def _refuse_beyond(self, part: str, messages: Mapping[str, bytes]) -> None:
        """Refuse a step after which no reader would take the file, or its end would not fit."""
        num_bytes = _num_bytes(messages)
        in_file = 0 if self._file is None else self._file.tell()
        if max(self._num_bytes, in_file) + num_bytes + SPARE_BYTES > MAX_BYTES:
            raise EpisodeError(
                f"{self.path} is full: {part} would make it larger than the {MAX_BYTES} bytes that "
                "are read again; allow fewer steps (loop.max_steps), or use a coarser sensor"
            )

    def _add(self, stamp: Stamp, messages: Mapping[str, bytes]) -> None:
        """Add the messages of one record, which share its sequence number."""
        time_ns = wall_ns(stamp)
        for topic, data in messages.items():
            self._mcap.add_message(self._channels[topic], time_ns, data, time_ns, self._sequence)
        self._sequence += 1
        self._num_bytes += _num_bytes(messages)

    def _write_error(self, part: str, error: OSError) -> str:
        line = refusal(self.path, f"write {part} to", error)
        if not self._has_content:
            return line
        return (
            f"{line}. Earlier records are safe: `tacgrasp episodes recover {self.path}` "
            "makes a finished file of it"
        )

    def _drop(self) -> None:
        """Close the file descriptor; what a failed write left in the buffer is not written."""
        file, self._file = self._file, None
        if file is not None:
            file.raw.close()


def start_mcap(file: BufferedWriter) -> Writer:
    """An MCAP writer whose chunks end only where it is flushed."""
    writer = Writer(file, chunk_size=CHUNK_BYTES, compression=CompressionType.LZ4)
    writer.start(profile="", library="tacgrasp")
    return writer


def _num_bytes(messages: Mapping[str, bytes]) -> int:
    return sum(_MESSAGE_BYTES + len(data) for data in messages.values())


def _create(path: Path) -> BufferedWriter:
    return path.open("xb")
