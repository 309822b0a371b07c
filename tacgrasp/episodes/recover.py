"""Finish the episode that a killed run left, so that any MCAP reader opens it.

Every whole record is copied, chunk by chunk, into a new file that gets the summary, index and
footer that were never written. Nothing is invented: a run that was killed before its end has no
``/end`` after recovery either. A metadata record ``tacgrasp_recovered`` names the damage; what it
names as lost keeps the episode incomplete for every reader.

Not here: reading an unfinished episode, which needs no recovery (``tacgrasp.episodes.reader``).
"""

from __future__ import annotations

import fcntl
import os
import shutil
from pathlib import Path

from mcap.records import Channel, McapRecord, Message, Metadata, Schema
from mcap.writer import Writer

from cltp.atomic_write import replacing
from tacgrasp.episodes.errors import EpisodeError
from tacgrasp.episodes.paths import refusal, sync_directory
from tacgrasp.episodes.reader import check_format, read_episode
from tacgrasp.episodes.record import METADATA_RECOVERED, Topic
from tacgrasp.episodes.scan import Scan, scan_file
from tacgrasp.episodes.writer import start_mcap


def recover(path: Path, out: Path | None = None) -> str:
    """Make a finished file of an unfinished one; returns a summary for people.

    Without ``out`` the new file replaces the unfinished one atomically, which is kept beside it as
    ``<name>.broken``. With ``out`` the original stays unchanged. A finished file is left alone.

    Raises:
        EpisodeError: As for ``read_episode``; or the run is still writing; or ``out`` exists or
            can't be written.
    """
    scan = scan_file(path)
    check_format(path, scan)
    records = list(scan.records)
    states = {r.id for r in records if isinstance(r, Channel) and r.topic == Topic.STATE}
    num_steps = sum(isinstance(r, Message) and r.channel_id in states for r in records)
    missing = _missing(path)
    if scan.finished:
        steps = "; ".join(filter(None, [f"{num_steps} steps", missing]))
        return f"{path} is finished already ({steps}); left as it is"
    _refuse_while_recording(path)
    target = path if out is None else out
    if out is not None and out.exists():
        raise EpisodeError(f"{out} exists; episodes are never overwritten, give another name")
    try:
        with replacing(target) as part:
            _write(part, scan, path.name, missing)
            shutil.copymode(path, part)
            original = path if out is not None else _set_aside(path)
        sync_directory(target.parent)
    except OSError as error:
        raise EpisodeError(refusal(target, "write", error, flag="--out")) from None
    found = [f"{num_steps} steps recovered"]
    if missing or scan.lost:
        found.append(f"{missing or 'records are lost'}, so that it stays marked as incomplete")
    return f"{target}: {'; '.join(found)}; {path.name}: {scan.problem}; kept as {original}"


def _missing(path: Path) -> str:
    """Steps that are missing; none is named of records that this version can't understand."""
    try:
        return read_episode(path).missing
    except EpisodeError:  # they are copied as they are, and reading the copy says the same
        return ""


def _refuse_while_recording(path: Path) -> None:
    with path.open("rb") as file:
        try:
            fcntl.flock(file.fileno(), fcntl.LOCK_SH | fcntl.LOCK_NB)
        except BlockingIOError:
            raise EpisodeError(
                f"{path} is still being recorded; end that run first (Ctrl-C), then recover"
            ) from None
        except OSError:
            return  # a disk without locks: a running recording can't be detected


def _write(path: Path, scan: Scan, name: str, missing: str) -> None:
    with path.open("wb") as file:
        writer = start_mcap(file)
        schemas: dict[int, int] = {0: 0}  # 0 means 'no schema' in MCAP
        channels: dict[int, int] = {}
        for group in scan.groups:
            for record in group:
                _copy(writer, record, schemas, channels)
            writer.flush()
        damage = {"from": name, "problem": scan.problem, "lost": scan.lost, "missing": missing}
        writer.add_metadata(METADATA_RECOVERED, damage)
        writer.finish()


def _copy(
    writer: Writer, record: McapRecord, schemas: dict[int, int], channels: dict[int, int]
) -> None:
    """Copy a record; ``schemas`` and ``channels`` map old numbers to those of the new file.

    A message whose channel was in a damaged part has no topic any more and is left out, as the
    reader does.
    """
    if isinstance(record, Schema) and record.id not in schemas:
        schemas[record.id] = writer.register_schema(record.name, record.encoding, record.data)
    elif isinstance(record, Channel) and record.id not in channels:
        channels[record.id] = writer.register_channel(
            record.topic, record.message_encoding, schemas.get(record.schema_id, 0), record.metadata
        )
    elif isinstance(record, Message) and record.channel_id in channels:
        writer.add_message(**vars(record) | {"channel_id": channels[record.channel_id]})
    elif isinstance(record, Metadata):
        writer.add_metadata(record.name, record.metadata)


def _set_aside(path: Path) -> Path:
    """Give the unfinished file a second name, so that its own name is never without a file."""
    number = 1
    while (backup := path.with_name(f"{path.name}.broken{'' if number == 1 else number}")).exists():
        number += 1
    try:
        os.link(path, backup)
    except OSError:  # a disk without hard links: the name has no file until the new one is there
        path.rename(backup)
    return backup
