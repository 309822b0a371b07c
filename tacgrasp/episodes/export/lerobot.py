"""Episodes as a LeRobotDataset v3.0, written with pyarrow alone.

Format: data/chunk-000/file-000.parquet, meta/info.json, meta/stats.json, meta/tasks.parquet,
meta/episodes/chunk-000/file-000.parquet. Source: huggingface/lerobot, ``src/lerobot/datasets``.

A frame is a step of the loop. LeRobot's own ``timestamp`` is the frame's number over ``FPS``, as
its readers check; the measured times stand beside it. D_t stands in ``language_events``, the column
of LeRobot 0.6, and as a string in ``observation.text`` for versions that don't know that column.
"""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from cltp.atomic_write import new_folder
from primitives import Primitive
from tacgrasp.episodes.errors import EpisodeError
from tacgrasp.episodes.export.parquet import points_column
from tacgrasp.episodes.paths import refusal
from tacgrasp.episodes.record import Episode, StepPhase, StepRecord

FPS = 1
"""Nominal frames a second; a step takes as long as it takes, and its measured time is a feature."""

MAX_FILE_MB, MAX_VIDEO_MB, MAX_FILES = 100, 200, 1000
"""LeRobot's own sizes of files and folders, stated in info.json."""

STATE = ("x_m", "y_m", "z_m", "rx_rad", "ry_rad", "rz_rad", "opening_m", "commanded_n")
ACTION = ("dx_m", "dy_m", "dz_m", "commanded_n", "primitive")
FORCE = ("felt_low_n", "felt_n", "felt_high_n")
PRIMITIVES = tuple(Primitive)
"""Numbers of the primitives in ``action``, from 0; -1 stands for none."""

_EVENT = pa.struct(
    [
        pa.field("role", pa.string(), nullable=False),
        pa.field("content", pa.string()),
        pa.field("style", pa.string()),
        pa.field("camera", pa.string()),
        pa.field("tool_calls", pa.list_(pa.string())),
    ]
)
_PATHS = {
    "data": "data/chunk-{:03d}/file-{:03d}.parquet",
    "episodes": "meta/episodes/chunk-{:03d}/file-{:03d}.parquet",
}


def write_lerobot(episodes: Sequence[Episode], folder: Path, *, language: bool = True) -> int:
    """Write episodes as one data set into a new folder; returns the number of frames.

    Args:
        episodes: The episodes; all of one sensor, with clouds of one size.
        folder: The folder; it must not exist. It appears when it is whole.
        language: Whether the column ``language_events`` is written; LeRobot knows it from 0.6 on.

    Raises:
        EpisodeError: The folder exists or can't be written, or the episodes don't fit together.
    """
    steps = [[s for s in each.steps if s.phase is StepPhase.LOOP] for each in episodes]
    num_points = _check(episodes, steps, folder)
    tasks = list(dict.fromkeys(each.header.instruction for each in episodes))
    try:
        with new_folder(folder) as part:
            table = _frames(episodes, steps, tasks, language=language)
            _write(part / _PATHS["data"].format(0, 0), table)
            _write(part / _PATHS["episodes"].format(0, 0), _episodes(episodes, steps))
            _write(part / "meta/tasks.parquet", _tasks(tasks))
            features, rig = _features(num_points, language=language), episodes[0].header.rig
            info = _info(features, len(episodes), table.num_rows, len(tasks), rig)
            (part / "meta/info.json").write_text(json.dumps(info, indent=1))
            (part / "meta/stats.json").write_text(json.dumps(_stats(table, features), indent=1))
    except OSError as error:
        raise EpisodeError(refusal(folder, "write", error, flag="--out")) from None
    return int(table.num_rows)


def _check(episodes: Sequence[Episode], steps: Sequence[Sequence[StepRecord]], folder: Path) -> int:
    """Refuse what makes no data set; returns the number of points of every cloud."""
    if folder.exists():
        raise EpisodeError(f"{folder} exists; exports are never overwritten, give another --out")
    if not all(steps):
        raise EpisodeError("an episode has no step of the loop, so no frame; leave it out")
    sensors = {each.header.sensor.name for each in episodes}
    sizes = {len(step.cloud.points_mm) for each in steps for step in each}
    if len(sensors) > 1 or len(sizes) > 1:
        raise EpisodeError(
            f"a data set has clouds of one sensor and one size, got {', '.join(sorted(sensors))} "
            f"and {', '.join(map(str, sorted(sizes)))} points; export them apart"
        )
    return sizes.pop()


def _frames(
    episodes: Sequence[Episode],
    steps: Sequence[Sequence[StepRecord]],
    tasks: Sequence[str],
    *,
    language: bool,
) -> Any:
    """The table of all frames, with LeRobot's own columns last."""
    flat = [step for each in steps for step in each]
    starts = [each.header.stamp.monotonic_s for each in episodes]
    elapsed = [s.stamp.monotonic_s - starts[e] for e, each in enumerate(steps) for s in each]
    number = [i for each in steps for i in range(len(each))]
    task = [tasks.index(episodes[e].header.instruction) for e, s in enumerate(steps) for _ in s]
    last = [i == len(each) - 1 for each in steps for i in range(len(each))]
    verified = [bool(each.end is not None and each.end.verified_success) for each in episodes]
    success = [verified[e] and i == len(s) - 1 for e, s in enumerate(steps) for i in range(len(s))]
    columns = {
        "observation.state": _vectors([_state(step) for step in flat], len(STATE)),
        "observation.force": _vectors([_force(step) for step in flat], len(FORCE)),
        "observation.tactile": points_column([step.cloud.points_mm for step in flat]).cast(
            pa.list_(pa.list_(pa.float32()))
        ),
        "observation.in_contact": pa.array([_contact(step) for step in flat], pa.int64()),
        "observation.measured_s": pa.array(elapsed, pa.float64()),
        "observation.wall_s": pa.array([step.stamp.wall_s for step in flat], pa.float64()),
        "observation.text": pa.array([_text(step) for step in flat], pa.string()),
        "action": _vectors([_action(step) for step in flat], len(ACTION)),
        "next.done": pa.array(last, pa.bool_()),
        "next.success": pa.array(success, pa.bool_()),
    }
    if language:
        events = [_events(step) for step in flat]
        columns["language_events"] = pa.array(events, pa.list_(_EVENT))
    episode = [e for e, each in enumerate(steps) for _ in each]
    columns |= {
        "timestamp": pa.array([i / FPS for i in number], pa.float32()),
        "frame_index": pa.array(number, pa.int64()),
        "episode_index": pa.array(episode, pa.int64()),
        "index": pa.array(range(len(flat)), pa.int64()),
        "task_index": pa.array(task, pa.int64()),
    }
    return pa.table(columns)


def _features(num_points: int, *, language: bool) -> dict[str, dict[str, Any]]:
    """The section ``features`` of info.json."""

    def vector(dtype: str, names: Sequence[str] | None, *shape: int) -> dict[str, Any]:
        return {"dtype": dtype, "shape": list(shape or (1,)), "names": names and list(names)}

    features = {
        "observation.state": vector("float32", STATE, len(STATE)),
        "observation.force": vector("float32", FORCE, len(FORCE)),
        "observation.tactile": vector("float32", ("point", "xyz_mm"), num_points, 3),
        "observation.in_contact": vector("int64", None),
        "observation.measured_s": vector("float64", None),
        "observation.wall_s": vector("float64", None),
        "observation.text": vector("string", None),
        "action": vector("float32", ACTION, len(ACTION)),
        "next.done": vector("bool", None),
        "next.success": vector("bool", None),
    }
    if language:
        features["language_events"] = vector("language", None)
    features["timestamp"] = vector("float32", None)
    for name in ("frame_index", "episode_index", "index", "task_index"):
        features[name] = vector("int64", None)
    return features


def _info(
    features: dict[str, Any], num_episodes: int, num_frames: int, num_tasks: int, rig: str
) -> dict[str, Any]:
    return {
        "codebase_version": "v3.0",
        "robot_type": rig,
        "total_episodes": num_episodes,
        "total_frames": num_frames,
        "total_tasks": num_tasks,
        "chunks_size": MAX_FILES,
        "data_files_size_in_mb": MAX_FILE_MB,
        "video_files_size_in_mb": MAX_VIDEO_MB,
        "fps": FPS,
        "splits": {"train": f"0:{num_episodes}"},
        "data_path": "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet",
        "video_path": None,
        "features": features,
    }


def _stats(table: Any, features: dict[str, dict[str, Any]]) -> dict[str, dict[str, list[float]]]:
    """min, max, mean, std and count of every number; of a cloud by coordinate."""
    stats = {}
    for name, feature in features.items():
        if feature["dtype"] in ("string", "language"):
            continue
        column = table[name].combine_chunks()
        while pa.types.is_list(column.type) or pa.types.is_fixed_size_list(column.type):
            column = column.flatten()
        width = feature["shape"][-1]
        values = column.to_numpy(zero_copy_only=False).astype(np.float64).reshape(-1, width)
        parts: dict[str, Any] = {
            "min": np.nanmin,
            "max": np.nanmax,
            "mean": np.nanmean,
            "std": np.nanstd,
        }
        known = np.where(np.isfinite(values).any(axis=0), values, 0.0)
        stats[name] = {part: call(known, axis=0).tolist() for part, call in parts.items()}
        stats[name]["count"] = [table.num_rows]
    return stats


def _episodes(episodes: Sequence[Episode], steps: Sequence[Sequence[StepRecord]]) -> Any:
    ends = np.cumsum([len(each) for each in steps])
    zeros = pa.array([0] * len(steps), pa.int64())
    return pa.table(
        {
            "episode_index": pa.array(range(len(steps)), pa.int64()),
            "tasks": pa.array([[e.header.instruction] for e in episodes], pa.list_(pa.string())),
            "length": pa.array([len(each) for each in steps], pa.int64()),
            "data/chunk_index": zeros,
            "data/file_index": zeros,
            "dataset_from_index": pa.array([0, *ends[:-1]], pa.int64()),
            "dataset_to_index": pa.array(ends, pa.int64()),
            "meta/episodes/chunk_index": zeros,
            "meta/episodes/file_index": zeros,
        }
    )


def _tasks(tasks: Sequence[str]) -> Any:
    """The table of tasks, whose index in pandas is the text."""
    text = {"pandas_type": "unicode", "numpy_type": "object", "metadata": None}
    whole = {"pandas_type": "int64", "numpy_type": "int64", "metadata": None}
    pandas = {
        "index_columns": ["task"],
        "column_indexes": [],
        "columns": [
            {"name": "task_index", "field_name": "task_index", **whole},
            {"name": "task", "field_name": "task", **text},
        ],
    }
    table = pa.table(
        {
            "task_index": pa.array(range(len(tasks)), pa.int64()),
            "task": pa.array(tasks, pa.string()),
        }
    )
    return table.replace_schema_metadata({"pandas": json.dumps(pandas)})


def _write(path: Path, table: Any) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    pq.write_table(table, path, compression="snappy")


def _vectors(rows: Sequence[Sequence[float]], size: int) -> Any:
    flat = pa.array(np.array(rows, dtype=np.float32).reshape(-1))
    return pa.FixedSizeListArray.from_arrays(flat, size)


def _state(step: StepRecord) -> list[float]:
    pose, gripper = step.tcp_pose, step.gripper
    return [*pose.position_m, *pose.rotvec_rad, gripper.width_m, gripper.force_n]


def _force(step: StepRecord) -> list[float]:
    """Felt force and its interval [N]; 0 without contact, NaN where it is not known."""
    felt = step.felt_force_n
    if felt is not None:
        return [felt.low, felt.value, felt.high]
    return [0.0 if step.in_contact is False else math.nan] * 3


def _action(step: StepRecord) -> list[float]:
    """Measured displacement [m, base frame], commanded force [N] and primitive of a step."""
    executed = step.executed
    if executed is None or executed.primitive is None:
        return [0.0, 0.0, 0.0, step.gripper.force_n, -1]
    moved_m = executed.reached.position_m - step.tcp_pose.position_m
    return [*moved_m, executed.force_n, PRIMITIVES.index(executed.primitive)]


def _contact(step: StepRecord) -> int:
    """1 in contact, 0 without, -1 where no test was possible."""
    return -1 if step.in_contact is None else int(step.in_contact)


def _text(step: StepRecord) -> str:
    return "" if step.decision is None else step.decision.text


def _events(step: StepRecord) -> list[dict[str, Any]]:
    """D_t as what the assistant said at this frame."""
    if step.decision is None:
        return []
    row = {"role": "assistant", "content": step.decision.text}
    return [{**row, "style": None, "camera": None, "tool_calls": None}]
