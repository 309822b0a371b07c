"""Exports hold what the episode holds, to the bit, in the layout that other programs read."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest

from primitives.primitive import Primitive
from primitives.sense import Interval
from tacgrasp.__main__ import main
from tacgrasp.episodes import EpisodeWriter, StepPhase, read_episode
from tacgrasp.episodes.codec import from_json
from tacgrasp.episodes.export.lerobot import ACTION, FPS, PRIMITIVES, STATE, write_lerobot
from tacgrasp.episodes.record import EpisodeEnd, EpisodeHeader
from tests.fakes.contracts import contract
from tests.fakes.episode_samples import end, header, press, record, same, step_record

STEPS = [
    replace(step_record(0), in_contact=True, felt_force_n=Interval(value=1.2, low=1 / 3, high=1.6)),
    replace(step_record(1, action=Primitive.RESET), in_contact=False),
    step_record(2, action=None),
    step_record(3, phase=StepPhase.VERIFY_AFTER),
]


@pytest.fixture
def episode(tmp_path: Path) -> Path:
    path = tmp_path / "e.mcap"
    write(path)
    return path


def write(path: Path, seed: int = 7) -> list[int]:
    """Record ``STEPS``; returns the size of the file before each step [bytes]."""
    sizes = []
    with EpisodeWriter(path, replace(header(seed), contract=contract(0.95, 1.9, 2.4))) as writer:
        for step in STEPS:
            sizes.append(path.stat().st_size)
            writer.write_step(step)
        writer.finish(end())
    return sizes


def exported(argv: list[str], out: Path) -> Path:
    assert main(["episodes", "export", *argv, "--out", str(out)]) == 0
    return out


def test_a_parquet_table_has_a_row_a_step_with_nothing_rounded(
    episode: Path, tmp_path: Path
) -> None:
    table = pq.read_table(exported([str(episode), "--to", "parquet"], tmp_path / "e.parquet"))
    assert table.num_rows == len(STEPS)
    for row, step in zip(table.to_pylist(), STEPS, strict=True):
        points = np.array(row["points_mm"], dtype=np.float32)
        assert points.tobytes() == step.cloud.points_mm.tobytes()
        assert np.array(row["position_m"]).tobytes() == step.tcp_pose.position_m.tobytes()
        assert (row["monotonic_s"], row["wall_s"]) == (step.stamp.monotonic_s, step.stamp.wall_s)
        assert (row["width_m"], row["commanded_n"]) == (step.gripper.width_m, step.gripper.force_n)
        assert row["text"] == (None if step.decision is None else step.decision.text)
    first = dict(table.to_pylist()[0]["numbers"])
    assert (first["felt_low_n"], first["limit_n"]) == (1 / 3, 2.4)
    assert table["sent"].to_pylist()[0] == STEPS[0].executed.sent  # type: ignore[union-attr]


def test_header_and_end_are_in_the_table_s_metadata(episode: Path, tmp_path: Path) -> None:
    out = exported([str(episode), "--to", "parquet"], tmp_path / "e.parquet")
    metadata = pq.read_schema(out).metadata
    read = read_episode(episode)
    assert same(from_json(EpisodeHeader, json.loads(metadata[b"tacgrasp_header"])), read.header)
    assert same(from_json(EpisodeEnd, json.loads(metadata[b"tacgrasp_end"])), read.end)


def test_a_lerobot_data_set_has_the_files_and_counts_of_version_3(
    episode: Path, tmp_path: Path
) -> None:
    other = tmp_path / "other.mcap"
    write(other, seed=8)
    out = exported([str(episode), str(other), "--to", "lerobot"], tmp_path / "set")
    info = json.loads((out / "meta/info.json").read_text())
    assert info["codebase_version"] == "v3.0"
    assert (info["total_episodes"], info["total_frames"], info["total_tasks"]) == (2, 6, 1)
    assert info["splits"] == {"train": "0:2"}
    data = pq.read_table(out / info["data_path"].format(chunk_index=0, file_index=0))
    assert data.num_rows == 6
    assert set(data.column_names) == set(info["features"])
    for name, values in {
        "index": [0, 1, 2, 3, 4, 5],
        "frame_index": [0, 1, 2, 0, 1, 2],
        "episode_index": [0, 0, 0, 1, 1, 1],
        "task_index": [0] * 6,
        "timestamp": [0.0, 1 / FPS, 2 / FPS] * 2,
        "next.done": [False, False, True] * 2,
        "next.success": [False, False, True] * 2,
    }.items():
        assert data[name].to_pylist() == values
    episodes = pq.read_table(out / "meta/episodes/chunk-000/file-000.parquet").to_pylist()
    spans = [(e["dataset_from_index"], e["dataset_to_index"], e["length"]) for e in episodes]
    assert spans == [(0, 3, 3), (3, 6, 3)]
    assert episodes[0]["tasks"] == [header().instruction]


def test_values_of_a_lerobot_data_set_are_those_of_the_episode(
    episode: Path, tmp_path: Path
) -> None:
    out = exported([str(episode), "--to", "lerobot"], tmp_path / "set")
    frames = pq.read_table(out / "data/chunk-000/file-000.parquet").to_pylist()
    start_s = header().stamp.monotonic_s
    for frame, step in zip(frames, STEPS[:3], strict=True):
        points = np.array(frame["observation.tactile"], dtype=np.float32)
        assert points.tobytes() == step.cloud.points_mm.tobytes()
        assert frame["observation.measured_s"] == step.stamp.monotonic_s - start_s
        assert frame["observation.wall_s"] == step.stamp.wall_s
        pose, gripper = step.tcp_pose, step.gripper
        state = [*pose.position_m, *pose.rotvec_rad, gripper.width_m, gripper.force_n]
        assert frame["observation.state"] == np.array(state, np.float32).tolist()
        assert step.decision is not None
        assert frame["observation.text"] == step.decision.text
        (event,) = frame["language_events"]
        assert (event["role"], event["content"]) == ("assistant", step.decision.text)
    assert frames[0]["observation.force"] == np.float32([1 / 3, 1.2, 1.6]).tolist()
    assert frames[1]["observation.force"] == [0, 0, 0]  # nothing was touched
    assert np.isnan(frames[2]["observation.force"]).all()  # not known
    assert [frame["observation.in_contact"] for frame in frames] == [1, 0, -1]
    numbers = [frame["action"][ACTION.index("primitive")] for frame in frames]
    assert [PRIMITIVES[int(n)] for n in numbers[:2]] == [Primitive.MOVE_DOWN, Primitive.RESET]
    assert numbers[2] == -1
    moved_z = np.float32(1 / 7 - 0.2)
    assert frames[0]["action"][ACTION.index("dz_m")] == moved_z


def test_the_statistics_are_those_of_the_values(episode: Path, tmp_path: Path) -> None:
    out = exported([str(episode), "--to", "lerobot"], tmp_path / "set")
    stats = json.loads((out / "meta/stats.json").read_text())
    clouds = np.stack([step.cloud.points_mm for step in STEPS[:3]]).astype(float).reshape(-1, 3)
    np.testing.assert_allclose(stats["observation.tactile"]["mean"], clouds.mean(axis=0))
    np.testing.assert_allclose(stats["observation.tactile"]["max"], clouds.max(axis=0))
    assert len(stats["observation.state"]["std"]) == len(STATE)
    assert stats["observation.state"]["count"] == [3]
    assert all(np.isfinite(stats["observation.force"]["mean"]))
    assert "observation.text" not in stats


def test_a_data_set_is_never_overwritten_and_its_episodes_have_to_fit_together(
    tmp_path: Path,
) -> None:
    record(tmp_path / "a.mcap", STEPS[:2])
    one = read_episode(tmp_path / "a.mcap")
    (tmp_path / "set.part").mkdir()  # somebody's own
    write_lerobot([one], tmp_path / "set")
    (tmp_path / "set.part").rmdir()
    few = replace(one.steps[0].cloud, points_mm=press(0, 0, 0.3).points_mm[:500])
    other = replace(one, steps=(replace(one.steps[0], cloud=few),))
    for episodes, out, message in (
        ([one], "set", "never overwritten"),
        ([one, other], "b", "500, 1024 points; export them apart"),
        ([replace(one, steps=())], "c", "no step of the loop"),
    ):
        with pytest.raises(Exception, match=message):
            write_lerobot(episodes, tmp_path / out)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.mcap", "set"]


def test_a_data_set_that_can_not_be_written_leaves_nothing(tmp_path: Path) -> None:
    record(tmp_path / "a.mcap", STEPS[:1])
    (tmp_path / "file").write_text("")
    out = tmp_path / "file" / "set"
    assert (
        main(["episodes", "export", str(tmp_path / "a.mcap"), "--to", "lerobot", "--out", str(out)])
        == 2
    )


@pytest.mark.parametrize("kind", ["parquet", "lerobot"])
def test_an_export_tells_which_step_is_missing_and_writes_the_rest(
    kind: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "e.mcap"
    sizes = write(path)
    assert main(["episodes", "export", str(path), "--to", kind, "--out", f"{path}.{kind}"]) == 0
    assert capsys.readouterr().err == ""
    data = bytearray(path.read_bytes())
    data[(sizes[1] + sizes[2]) // 2] ^= 0xFF
    path.write_bytes(data)
    damaged = ["episodes", "export", str(path), "--to", kind, "--out", f"{path}.2.{kind}"]
    assert main(damaged) == 0
    error = capsys.readouterr().err
    assert error.startswith(f"tacgrasp: {path} is incomplete: step 1 is missing; ")
    assert "makes a finished file of the rest" in error and error.count("\n") == 1
    assert main(["episodes", "recover", str(path)]) == 0
    assert main([*damaged[:-1], f"{path}.3.{kind}"]) == 0
    error = capsys.readouterr().err
    assert "step 1 is missing; recovered from a damaged file: " in error
    assert error.endswith("what is lost can't be recovered\n")


@pytest.mark.parametrize("copied", [False, True], ids=["named twice", "a copy"])
def test_a_data_set_holds_a_run_once(
    copied: bool, episode: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    again, other = episode, tmp_path / "other.mcap"
    write(other, seed=8)
    if copied:
        again = tmp_path / "copy.mcap"
        again.write_bytes(episode.read_bytes())
    named = [str(other), str(episode), str(again)]
    out = tmp_path / "set"
    assert main(["episodes", "export", *named, "--to", "lerobot", "--out", str(out)]) == 2
    error = capsys.readouterr().err
    expected = f"{episode} and {again} are of the same run" if copied else f"{again} is named twice"
    assert f"{expected}; a data set holds a run once" in error
    assert not out.exists()


@pytest.mark.parametrize("kind", ["parquet", "lerobot", "rrd"])
def test_an_export_never_replaces_another(
    kind: str, episode: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / f"mine.{kind}"
    out.write_text("mine")
    assert main(["episodes", "export", str(episode), "--to", kind, "--out", str(out)]) == 2
    expected = f"{out} exists; exports are never overwritten, give another --out"
    assert expected in capsys.readouterr().err
    assert out.read_text() == "mine"


@pytest.mark.parametrize(
    ("argv", "expected"),
    [
        ([], "missing"),
        (["no.mcap", "--to", "parquet"], "no.mcap does not exist"),
        (["a.mcap", "--to", "csv"], "must be one of lerobot, parquet, rrd"),
        (["a.mcap", "b.mcap", "--to", "parquet"], "--to parquet takes one episode, got 2"),
        (["a.mcap", "--to", "parquet", "--no-language"], "belongs to --to lerobot; leave it out"),
        (["a.mcap", "--to", "rrd", "--no-language"], "belongs to --to lerobot; leave it out"),
    ],
)
def test_wrong_use_of_export_is_one_line(
    argv: list[str], expected: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["episodes", "export", *argv]) == 2
    error = capsys.readouterr().err
    assert expected in error
    assert error.count("\n") == 1
