"""Read an episode, finished or not, exactly as it was recorded.

Not here: restoring a file for other tools (``tacgrasp.episodes.recover``).
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from mcap.records import Channel, Message, Metadata

from cltp.errors import TouchError
from cltp.tactile.sensors import SensorSpec
from primitives.errors import RobotError
from tacgrasp.episodes.codec import from_json
from tacgrasp.episodes.errors import EpisodeError
from tacgrasp.episodes.record import (
    FORMATS,
    JSON_MESSAGES,
    METADATA_NAME,
    METADATA_RECOVERED,
    Episode,
    EpisodeHeader,
    StepRecord,
    StepState,
    Topic,
    most_json_bytes,
)
from tacgrasp.episodes.scan import Scan, scan_file
from tacgrasp.episodes.touch_message import decode_cloud
from tacgrasp.episodes.view_messages import ViewTopic, decode_image

MAX_LOST_CHARACTERS = 500
"""Most that is shown of what a recovered file says of its damage. Our choice."""

SHOWN_GAPS = 5
"""Most gaps that are named. Our choice."""

END_OF_TIME_S = 253_402_300_800.0
"""Start of the year 10000, in seconds since 1970: no calendar of Python's goes further."""


def read_episode(path: Path) -> Episode:
    """Read the episode in ``path``; clouds and numbers are bit for bit those that were recorded.

    A file that a killed run left is read as far as it goes: ``complete`` is then False, ``problem``
    says why, and ``tacgrasp episodes recover`` makes a finished file of it. A file that lost
    records stays incomplete when it was recovered.

    Raises:
        EpisodeError: It does not exist, is empty, not MCAP, another program's MCAP, of another
            format version, ends before its header, or a record in it can't be understood.
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
            f"{path}: a record can't be understood: {error}. The file is damaged, or "
            "written by another version of tacgrasp; read it with that one"
        ) from error


def check_format(path: Path, scan: Scan) -> None:
    """Refuse a file that is no episode of ours.

    Raises:
        EpisodeError: Another program's MCAP file, another format version, or no header yet.
    """
    metadata = [
        r.metadata for r in scan.records if isinstance(r, Metadata) and r.name == METADATA_NAME
    ]
    if not metadata and (scan.finished or scan.groups):
        raise EpisodeError(
            f"{path} is an MCAP file but no episode of tacgrasp (it has no metadata record "
            f"{METADATA_NAME!r}); open it with the program that wrote it"
        )
    if metadata and metadata[0].get("format") not in FORMATS:
        stated = " ".join(metadata[0].get("format", "nothing").split())
        raise EpisodeError(
            f"{path} is of format {stated:.60}, this tacgrasp reads "
            f"{' and '.join(FORMATS)}; use the version that wrote it"
        )
    if not any(isinstance(record, Message) for record in scan.records):
        raise EpisodeError(
            f"{path} ends before its header: the run was killed before the first step; nothing "
            "can be recovered, delete it"
        )


def _episode(messages: dict[int, dict[str, bytes]], scan: Scan) -> Episode:
    by_topic = {topic: data for group in messages.values() for topic, data in group.items()}
    if Topic.EPISODE not in by_topic:
        raise ValueError(f"no message on {Topic.EPISODE}")
    header: EpisodeHeader = _parse(Topic.EPISODE, by_topic)
    if not 0 <= header.stamp.wall_s < END_OF_TIME_S:
        raise ValueError(f"EpisodeHeader.stamp.wall_s: {header.stamp.wall_s} is no time of a start")
    groups = [group for _, group in sorted(messages.items()) if Topic.STATE in group]
    steps = tuple(_step(group, header.sensor) for group in groups)
    numbers = iter(steps)
    missing = missing_steps(
        (sequence, next(numbers).index if Topic.STATE in group else None)
        for sequence, group in sorted(messages.items())
    )
    problems = [text for text in (missing, scan.problem, *_lost_before(scan)) if text]
    return Episode(
        header=header,
        steps=steps,
        end=_parse(Topic.END, by_topic),
        complete=scan.finished and not problems,
        problem="; ".join(problems),
        finished=scan.finished,
        missing=missing,
    )


def _lost_before(scan: Scan) -> Iterator[str]:
    """What the files had lost that this one was recovered from, for people."""
    for record in scan.records:
        if isinstance(record, Metadata) and record.name == METADATA_RECOVERED:
            lost = " ".join(record.metadata.get("lost", "").split())
            if lost:
                yield f"recovered from a damaged file: {lost:.{MAX_LOST_CHARACTERS}}"


def missing_steps(records: Iterable[tuple[int, int | None]]) -> str:
    """Missing steps, for people ('steps 3 to 4 and step 7 are missing'); empty when none is.

    The records of a run are numbered without a gap, so that a gap is a record that was written and
    got lost. Steps that a killed run never wrote leave none.

    Args:
        records: Sequence number of every record that was read, in ascending order, and the number
            of its step; None for the header and the end.
    """
    names: list[str] = []
    num_missing, expected, step = 0, None, 0
    for sequence, index in records:
        if expected is not None and sequence > expected:
            num_lost = sequence - expected
            num_missing += num_lost
            names.append(_gap_text(num_lost, step, step + num_lost if index is None else index))
        expected, step = sequence + 1, step if index is None else index + 1
    if not names:
        return ""
    if len(names) > SHOWN_GAPS:
        names = [*names[:SHOWN_GAPS], "others"]
    text = " and ".join([", ".join(names[:-1]), names[-1]] if names[1:] else names)
    return f"{text} {'is' if num_missing == 1 else 'are'} missing"


def incomplete_text(episode: Episode, path: Path) -> str:
    """Why the episode in ``path`` is incomplete, and what to do; empty when it is complete."""
    if episode.complete:
        return ""
    advice = "what is lost can't be recovered"
    if not episode.finished:
        rest = "the rest" if episode.missing else "it"
        advice = f"`tacgrasp episodes recover {path}` makes a finished file of {rest}"
    return f"{episode.problem}; {advice}"


def _gap_text(num_lost: int, first: int, behind: int) -> str:
    """A gap of ``num_lost`` records, from step ``first`` to the one before step ``behind``."""
    if num_lost != behind - first:  # a step that could not be written has a number, but no record
        return f"{num_lost} {'record' if num_lost == 1 else 'records'} before step {behind}"
    return f"step {first}" if num_lost == 1 else f"steps {first} to {behind - 1}"


def _step(group: Mapping[str, bytes], sensor: SensorSpec) -> StepRecord:
    state: StepState = _parse(Topic.STATE, group)
    decision, action = _parse(Topic.DECISION, group), _parse(Topic.ACTION, group)
    shear = _parse(Topic.SHEAR, group)
    return StepRecord(
        **state.shared(),
        cloud=decode_cloud(
            group.get(Topic.CLOUD, b""), sensor, state.cloud_stamp, state.force_scale
        ),
        decision=None if decision is None else decision.decision,
        executed=None if action is None else action.executed,
        step_ms=state.tick_ms,
        camera_jpeg=decode_image(group[ViewTopic.CAMERA]) if ViewTopic.CAMERA in group else None,
        shear=None if shear is None else shear.field(sensor),
    )


def _parse(topic: Topic, group: Mapping[str, bytes]) -> Any:
    """The message on a JSON channel as its dataclass; None when the group has none."""
    if topic not in group:
        return None
    data = group[topic]
    if len(data) > (most := most_json_bytes(topic)):
        raise ValueError(f"{topic} has {len(data)} bytes; at most {most} are read")
    try:
        return from_json(JSON_MESSAGES[topic][1], json.loads(data))
    except RecursionError:
        raise ValueError(f"{topic} is nested too deep") from None
