"""Read an episode, finished or not, exactly as it was recorded.

Not here: restoring a file for other tools (``tacgrasp.episodes.recover``).
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import TypeVar

from mcap.records import Channel, Message, Metadata

from cltp.errors import TouchError
from primitives.errors import RobotError
from tacgrasp.episodes.codec import from_json
from tacgrasp.episodes.errors import EpisodeError
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
    Episode,
    EpisodeEnd,
    EpisodeHeader,
    TickRecord,
    TickState,
)
from tacgrasp.episodes.scan import Scan, scan_file
from tacgrasp.episodes.touch_message import decode_cloud

T = TypeVar("T")


def read_episode(path: Path) -> Episode:
    """Read the episode in ``path``; clouds and numbers are bit for bit those that were recorded.

    A file that a killed run left is read as far as it goes: ``complete`` is then False, ``problem``
    says why, and ``tacgrasp episodes recover`` makes a finished file of it.

    Raises:
        EpisodeError: It does not exist, is empty, not MCAP, somebody else's MCAP, of another format
            version, ends before its header, or a record in it can't be understood.
    """
    scan = scan_file(path)
    check_format(path, scan)
    topics: dict[int, str] = {}
    messages: dict[int, dict[str, bytes]] = {}
    for record in scan.records:
        if isinstance(record, Channel):
            topics[record.id] = record.topic
        elif isinstance(record, Message) and record.channel_id in topics:
            messages.setdefault(record.sequence, {})[topics[record.channel_id]] = record.data
    try:
        return _episode(messages, scan)
    except (ValueError, TouchError, RobotError) as error:
        raise EpisodeError(
            f"{path}: a record can't be understood: {error}. It is of format {FORMAT}, but perhaps "
            "written by another version of tacgrasp; read it with that one"
        ) from error


def check_format(path: Path, scan: Scan) -> None:
    """Refuse a file that is no episode of ours.

    Raises:
        EpisodeError: Somebody else's MCAP file, another format version, or no header yet.
    """
    named = [r for r in scan.records if isinstance(r, Metadata) and r.name == METADATA_NAME]
    if not named:
        if not scan.finished and not scan.groups:
            raise EpisodeError(
                f"{path} ends before its header: the run was killed before the first touch; "
                "nothing can be recovered, delete it"
            )
        raise EpisodeError(
            f"{path} is an MCAP file but no episode of tacgrasp (it has no metadata record "
            f"{METADATA_NAME!r}); open it with the program that wrote it"
        )
    written = named[0].metadata.get("format", "nothing")
    if written != FORMAT:
        raise EpisodeError(
            f"{path} is of format {written}, this tacgrasp reads {FORMAT}; use the version that "
            "wrote it"
        )
    if not any(isinstance(record, Message) for record in scan.records):
        raise EpisodeError(
            f"{path} ends before its header: the run was killed before the first touch; nothing "
            "can be recovered, delete it"
        )


def _episode(messages: dict[int, dict[str, bytes]], scan: Scan) -> Episode:
    by_topic = {topic: data for group in messages.values() for topic, data in group.items()}
    if TOPIC_EPISODE not in by_topic:
        raise ValueError(f"no message on {TOPIC_EPISODE}")
    header = _parse(EpisodeHeader, by_topic[TOPIC_EPISODE])
    ticks = [_tick(group, header) for _, group in sorted(messages.items()) if TOPIC_STATE in group]
    end = by_topic.get(TOPIC_END)
    return Episode(
        header=header,
        ticks=tuple(ticks),
        end=None if end is None else _parse(EpisodeEnd, end),
        complete=scan.finished,
        problem=scan.problem,
    )


def _tick(group: dict[str, bytes], header: EpisodeHeader) -> TickRecord:
    state = _parse(TickState, group[TOPIC_STATE])
    decision, action = group.get(TOPIC_DECISION), group.get(TOPIC_ACTION)
    return TickRecord(
        index=state.index,
        phase=state.phase,
        cloud=decode_cloud(group.get(TOPIC_CLOUD, b""), header.sensor, state.cloud_stamp),
        decision=None if decision is None else _parse(DecisionMessage, decision).decision,
        executed=None if action is None else _parse(ActionMessage, action).executed,
        tcp_pose=state.tcp_pose,
        gripper=state.gripper,
        stamp=state.stamp,
        tick_ms=state.tick_ms,
        note=state.note,
        commands=state.commands,
    )


def _parse(kind: type[T], data: bytes) -> T:
    return from_json(kind, json.loads(data))
