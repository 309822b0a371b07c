"""Load an exported data set with the real ``lerobot`` and compare it with the episode, to the bit.

Runs in an environment with lerobot alone: ``python tests/lerobot/check.py PYTHON_OF_TACGRASP``.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from importlib import metadata
from pathlib import Path

import numpy as np


def check(folder: Path, name: str) -> None:
    """Compare every value of a set of two equal episodes."""
    from lerobot.datasets.lerobot_dataset import LeRobotDataset

    expected = np.load(folder / "expected.npz")
    num_steps = len(expected["text"])
    data = LeRobotDataset(f"tacgrasp/{name}", root=folder / name)
    assert (data.num_episodes, data.num_frames) == (2, 2 * num_steps)
    assert data.meta.tasks.index.tolist() == [str(expected["instruction"])]
    for number in range(len(data)):
        step, frame = number % num_steps, data[number]
        points = frame["observation.tactile"].numpy()
        assert points.dtype == np.float32
        assert points.tobytes() == expected["points_mm"][step].tobytes()
        state = frame["observation.state"].numpy()
        assert state[:3].tobytes() == expected["position_m"][step].astype(np.float32).tobytes()
        assert state[7] == np.float32(expected["commanded_n"][step])
        assert frame["observation.text"] == expected["text"][step]
        assert frame["task"] == str(expected["instruction"])
        assert int(frame["episode_index"]) == number // num_steps
    raw = data.hf_dataset.with_format(None)  # torch would make float32 of the times
    for number in range(len(data)):
        step = number % num_steps
        elapsed_s = expected["monotonic_s"][step] - expected["start_s"]
        assert raw[number]["observation.measured_s"] == elapsed_s
        assert raw[number]["observation.wall_s"] == expected["wall_s"][step]
        if "language_events" in raw.column_names:
            (event,) = raw[number]["language_events"]
            assert event["content"] == expected["text"][step]
    columns = ", ".join(data.hf_dataset.column_names)
    print(f"{name}: {data.num_episodes} episodes, {len(data)} frames equal to the bit: {columns}")


def main(python: str) -> None:
    """Write the sets with tacgrasp's Python, then check those that this lerobot can read."""
    version = metadata.version("lerobot")
    print(f"lerobot {version}, torch {metadata.version('torch')}")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        subprocess.run([python, "-m", "tests.lerobot.write", str(folder)], check=True)
        check(folder, "set")
        if tuple(int(part) for part in version.split(".")[:2]) >= (0, 6):
            check(folder, "set-language")
        else:
            print("set-language: not checked, lerobot knows language_events from 0.6 on")


if __name__ == "__main__":
    main(sys.argv[1])
