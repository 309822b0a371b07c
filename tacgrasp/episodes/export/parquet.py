"""An episode as one Parquet file: a row for each step, nothing rounded.

Numbers are those of the episode to the bit; header and end stand in the file's metadata as JSON.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from tacgrasp.episodes.codec import to_json
from tacgrasp.episodes.record import Episode, StepRecord
from tacgrasp.episodes.view_messages import numbers

_TEXT, _REAL, _INT, _FLAG = pa.string(), pa.float64(), pa.int64(), pa.bool_()
POINTS = pa.list_(pa.list_(pa.float32(), 3))
"""A cloud: N points of three float32 [mm]."""

SCHEMA = pa.schema(
    {
        "index": _INT,
        "phase": _TEXT,
        "monotonic_s": _REAL,
        "wall_s": _REAL,
        "text": _TEXT,
        "action": _TEXT,
        "success": _FLAG,
        "reason": _TEXT,
        "asked": _TEXT,
        "sent": _TEXT,
        "clamped": pa.list_(_TEXT),
        "in_contact": _FLAG,
        "numbers": pa.map_(_TEXT, _REAL),
        "position_m": pa.list_(_REAL, 3),
        "rotvec_rad": pa.list_(_REAL, 3),
        "width_m": _REAL,
        "commanded_n": _REAL,
        "points_mm": POINTS,
        "camera_jpeg": pa.binary(),
        "commands": _TEXT,
        "note": _TEXT,
    }
)


def write_parquet(episode: Episode, path: Path) -> None:
    """Write an episode to ``path``.

    Raises:
        OSError: The file can't be written.
    """
    contract, rows = episode.header.contract, []
    for step in episode.steps:
        contract = step.contract or contract
        rows.append({**_row(step), "numbers": list(numbers(step, contract).items())})
    columns = {
        name: points_column([step.cloud.points_mm for step in episode.steps])
        if name == "points_mm"
        else pa.array([row[name] for row in rows], type=SCHEMA.field(name).type)
        for name in SCHEMA.names
    }
    metadata = {"tacgrasp_header": json.dumps(to_json(episode.header))}
    if episode.end is not None:
        metadata["tacgrasp_end"] = json.dumps(to_json(episode.end))
    table = pa.table(columns, schema=SCHEMA.with_metadata(metadata))
    pq.write_table(table, path, compression="zstd")


def points_column(clouds_mm: Sequence[NDArray[np.float32]]) -> Any:
    """Clouds, each (N, 3), as a column of lists of points; their memory is not copied twice."""
    offsets = np.cumsum([0, *(len(points) for points in clouds_mm)])
    flat = np.concatenate(clouds_mm).ravel() if clouds_mm else np.empty(0, np.float32)
    points = pa.FixedSizeListArray.from_arrays(pa.array(flat, type=pa.float32()), 3)
    return pa.ListArray.from_arrays(pa.array(offsets, type=pa.int32()), points)


def _row(step: StepRecord) -> dict[str, Any]:
    decision, executed = step.decision, step.executed
    return {
        "index": step.index,
        "phase": step.phase.value,
        "monotonic_s": step.stamp.monotonic_s,
        "wall_s": step.stamp.wall_s,
        "text": None if decision is None else decision.text,
        "action": None if decision is None or decision.action is None else decision.action.value,
        "success": None if decision is None else decision.success,
        "reason": None if decision is None else decision.reason,
        "asked": None if executed is None else executed.asked,
        "sent": None if executed is None else executed.sent,
        "clamped": [] if executed is None else list(executed.clamped),
        "in_contact": step.in_contact,
        "position_m": step.tcp_pose.position_m.tolist(),
        "rotvec_rad": step.tcp_pose.rotvec_rad.tolist(),
        "width_m": step.gripper.width_m,
        "commanded_n": step.gripper.force_n,
        "camera_jpeg": step.camera_jpeg,
        "commands": json.dumps(to_json(step.commands)) if step.commands else None,
        "note": step.note,
    }
