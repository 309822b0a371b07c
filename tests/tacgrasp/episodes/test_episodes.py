import errno
import json
import os
import resource
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from io import BufferedWriter
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

from policies.policy import Decision
from primitives.devices import GripperState, Pose
from primitives.execution import Executed
from primitives.primitive import Primitive
from tacgrasp.episodes import (
    EpisodeEnd,
    EpisodeError,
    EpisodeHeader,
    EpisodeWriter,
    StepPhase,
    episode_path,
    make_record_directory,
    read_episode,
)
from tacgrasp.episodes import writer as writer_module
from tacgrasp.episodes.codec import field_descriptions, from_json, json_schema, to_json
from tacgrasp.episodes.paths import check_record_directory, refusal
from tacgrasp.episodes.record import ActionMessage, DecisionMessage, StepState
from tacgrasp.episodes.touch_message import decode_cloud, encode_cloud
from tests.fakes.episode_samples import (
    SENSOR,
    end,
    executed,
    header,
    press,
    record,
    same,
    stamp,
    step_record,
)

Patch = pytest.MonkeyPatch

finite = st.floats(allow_nan=False, allow_infinity=False)


def test_what_is_recorded_is_read_again_to_the_last_bit(tmp_path: Path) -> None:
    steps = [
        step_record(0),
        step_record(1, action=None),
        step_record(2, phase=StepPhase.VERIFY_BEFORE),
        step_record(3, phase=StepPhase.VERIFY_AFTER),
    ]
    record(tmp_path / "e.mcap", steps)
    episode = read_episode(tmp_path / "e.mcap")
    assert episode.complete and episode.problem == ""
    assert same(episode.header, header())
    assert same(episode.end, end())
    assert len(episode.steps) == 4
    assert same(episode.steps[0].executed, executed(Primitive.MOVE_DOWN))
    for read, written in zip(episode.steps, steps, strict=True):
        assert same(read, written)
        assert read.cloud.points_mm.dtype == np.float32
        assert read.cloud.points_mm.tobytes() == written.cloud.points_mm.tobytes()


@given(
    text=st.text(st.characters(exclude_categories=["Cs"])),
    action=st.none() | st.sampled_from(Primitive),
    success=st.booleans(),
    confidence=finite,
    stage_ms=st.dictionaries(st.text(st.characters(exclude_categories=["Cs"])), finite),
)
def test_any_decision_survives_json(
    text: str,
    action: Primitive | None,
    success: bool,
    confidence: float,
    stage_ms: dict[str, float],
) -> None:
    decision = Decision(
        text=text,
        action=action,
        success=success,
        reason=text[::-1],
        confidence=confidence,
        stage_ms=stage_ms,
    )
    assert from_json(Decision, json.loads(json.dumps(to_json(decision)))) == decision


@given(st.lists(finite, min_size=6, max_size=6))
def test_any_pose_survives_json(numbers: list[float]) -> None:
    pose = Pose(position_m=np.array(numbers[:3]), rotvec_rad=np.array(numbers[3:]))
    read = from_json(Pose, json.loads(json.dumps(to_json(pose))))
    assert read.position_m.tobytes() == pose.position_m.tobytes()
    assert read.rotvec_rad.tobytes() == pose.rotvec_rad.tobytes()


@given(st.integers(0, 2**32 - 1), st.integers(64, 300))
def test_any_cloud_survives_its_message(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    points = rng.uniform(-1, 1, (count, 3)) * (SENSOR.width_mm / 2, SENSOR.height_mm / 2, 1.0)
    cloud = type(press(0, 0, 0))(points_mm=points.astype(np.float32), sensor=SENSOR)
    read = decode_cloud(encode_cloud(cloud, stamp(0)), SENSOR, None)
    assert read.points_mm.tobytes() == cloud.points_mm.tobytes()


def test_every_size_of_number_survives_the_metres_of_a_message() -> None:
    rng = np.random.default_rng(0)
    z = np.concatenate(
        [rng.uniform(0.5, 1, 4000) * 2.0 ** rng.integers(-100, 1, 4000), [0.0, -0.0, 1e-40, -1e-44]]
    )
    for part in (z[:4002], z):  # the last two have no metres in float32
        signs = rng.choice([-1, 1], len(part))
        x, y = (half * rng.uniform(-1, 1, len(part)) for half in (SENSOR.width_mm / 2, 7.0))
        points = np.stack([x, y, part * signs], axis=1).astype(np.float32)
        cloud = type(press(0, 0, 0))(points_mm=points, sensor=SENSOR)
        read = decode_cloud(encode_cloud(cloud, stamp(0)), SENSOR, None)
        assert read.points_mm.tobytes() == cloud.points_mm.tobytes()


@pytest.mark.parametrize("primitive", [None, *Primitive])
def test_any_executed_action_survives_json(primitive: Primitive | None) -> None:
    read = from_json(Executed, json.loads(json.dumps(to_json(executed(primitive)))))
    assert same(read, executed(primitive)) and type(read.primitive) is type(primitive)
    assert read.clamped == ("a step of 3 mm was cut to 2.5 mm",)


def test_truth_keeps_the_types_of_its_facts() -> None:
    truth = {"held": True, "count": 3, "slip_mm": 3.0, "why": None, "name": "x"}
    read = from_json(EpisodeEnd, json.loads(json.dumps(to_json(end())))).truth
    assert read is not None and read["held"] is True and type(read["count"]) is int
    whole = EpisodeEnd(
        reason="fault",
        declared_success=False,
        verified_success=None,
        message="",
        stamp=stamp(0),
        truth=truth,
    )
    kept = from_json(EpisodeEnd, json.loads(json.dumps(to_json(whole)))).truth
    assert kept is not None
    assert [(k, type(v), v) for k, v in kept.items()] == [(k, type(v), v) for k, v in truth.items()]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"width_m": "wide"}, r"GripperState\.width_m: expected number, got 'wide'"),
        ({"width": 0.1}, r"unknown field 'width'; known: width_m, force_n, closed"),
        ({"closed": 1}, r"GripperState\.closed: expected boolean, got 1"),
    ],
)
def test_a_field_of_the_wrong_kind_is_named(change: dict[str, object], message: str) -> None:
    data = {"width_m": 0.1, "force_n": 1.0, "closed": True, **change}
    with pytest.raises(ValueError, match=message):
        from_json(GripperState, data)


def test_a_missing_field_is_named() -> None:
    with pytest.raises(ValueError, match=r"GripperState: field 'closed' is missing"):
        from_json(GripperState, {"width_m": 0.1, "force_n": 1.0})


@pytest.mark.parametrize(
    "kind", [EpisodeHeader, EpisodeEnd, StepState, DecisionMessage, ActionMessage]
)
def test_every_field_of_a_message_is_documented(kind: type) -> None:
    schema = json_schema(kind)
    assert set(field_descriptions(kind)) == set(schema["properties"])
    assert all(part["description"] for part in schema["properties"].values())


def test_a_description_goes_on_over_lines_and_serves_several_names() -> None:
    class Example:
        """Sum.

        Attributes:
            a, b: Both
                of them.
            c: One.

        Raises:
            d: Not a field.
        """

    assert field_descriptions(Example) == {"a": "Both of them.", "b": "Both of them.", "c": "One."}


def test_the_stock_reader_sees_clouds_and_json_that_fits_its_schema(tmp_path: Path) -> None:
    jsonschema = pytest.importorskip("jsonschema")
    record(tmp_path / "e.mcap", [step_record(0), step_record(1)])
    clouds = checked = 0
    with (tmp_path / "e.mcap").open("rb") as file:
        reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
        for schema, channel, message in reader.iter_messages():
            assert schema is not None
            if channel.message_encoding == "json":
                validator = jsonschema.Draft202012Validator(json.loads(schema.data))
                validator.validate(json.loads(message.data))
                checked += 1
        for schema, _, message, cloud in reader.iter_decoded_messages(topics=["/touch/cloud"]):
            assert schema is not None and schema.name == "foxglove.PointCloud"
            assert cloud.frame_id == "gel" and cloud.point_stride == 15
            assert [f.name for f in cloud.fields] == ["x", "y", "z", "rx", "ry", "rz"]
            assert cloud.timestamp.ToNanoseconds() == pytest.approx(message.log_time, abs=1e9)
            packed = np.frombuffer(cloud.data, "<f4,<f4,<f4,V3")
            expected_m = step_record(clouds).cloud.points_mm.astype(float) / 1000
            for axis in range(3):
                np.testing.assert_allclose(packed[f"f{axis}"], expected_m[:, axis], rtol=1e-7)
            clouds += 1
    assert (clouds, checked) == (2, 1 + 2 * 3 + 1)  # header, two of decision, action, state; end


def test_a_loop_that_raises_leaves_a_finished_file_without_an_end(tmp_path: Path) -> None:
    path = tmp_path / "e.mcap"
    with pytest.raises(RuntimeError, match="bug"), EpisodeWriter(path, header()) as writer:
        writer.write_step(step_record(0))
        raise RuntimeError("bug")
    episode = read_episode(path)
    assert episode.complete and len(episode.steps) == 1 and episode.end is None


def test_a_number_that_is_not_finite_is_refused_and_the_file_stays_whole(tmp_path: Path) -> None:
    path = tmp_path / "e.mcap"
    with EpisodeWriter(path, header()) as writer:
        with pytest.raises(
            EpisodeError, match=r"StepState\.tick_ms is nan; expected a finite number"
        ):
            writer.write_step(step_record(0, step_ms=float("nan")))
        writer.write_step(step_record(1))
    episode = read_episode(path)
    assert episode.complete and [t.index for t in episode.steps] == [1]


def test_a_step_beyond_what_is_read_again_is_refused_and_the_episode_still_ends(
    tmp_path: Path, monkeypatch: Patch
) -> None:
    path = tmp_path / "e.mcap"
    largest = writer_module.SPARE_BYTES + 150_000
    monkeypatch.setattr(writer_module, "MAX_BYTES", largest)
    monkeypatch.setattr("tacgrasp.episodes.scan.MAX_BYTES", largest)
    num_steps = 0
    with EpisodeWriter(path, header()) as writer:
        with pytest.raises(EpisodeError, match=r"is full: step \d .*allow fewer steps"):
            while num_steps < 100:
                writer.write_step(step_record(num_steps))
                num_steps += 1
        writer.finish(end())
    episode = read_episode(path)
    assert len(episode.steps) == num_steps > 0
    assert episode.complete
    assert episode.end is not None


def test_a_message_longer_than_one_that_is_read_again_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "e.mcap"
    with EpisodeWriter(path, header()) as writer:
        with pytest.raises(EpisodeError, match=r"StepState has .* at most 2000000 can be read"):
            writer.write_step(replace(step_record(0), note="x" * 2_000_000))
        writer.write_step(step_record(0))
        writer.finish(end())
    assert read_episode(path).complete


def test_an_episode_ends_once(tmp_path: Path) -> None:
    with EpisodeWriter(tmp_path / "e.mcap", header()) as writer:
        writer.finish(end())
        with pytest.raises(EpisodeError, match="an episode ends once"):
            writer.finish(end())


def test_ctrl_c_in_mid_write_waits_until_the_step_is_whole(
    tmp_path: Path, monkeypatch: Patch
) -> None:
    path = tmp_path / "e.mcap"
    with EpisodeWriter(path, header()) as writer:
        with monkeypatch.context() as patch:
            patch.setattr(os, "fsync", lambda _fd: signal.raise_signal(signal.SIGINT))
            with pytest.raises(KeyboardInterrupt):
                writer.write_step(step_record(0))
        writer.write_step(step_record(1))
        writer.finish(end())
    episode = read_episode(path)
    assert episode.complete and len(episode.steps) == 2 and episode.end is not None
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_the_name_tells_task_time_and_seed() -> None:
    at = type(stamp(0))(monotonic_s=0.0, wall_s=0.25)
    directory = Path("d")
    assert episode_path(directory, "egg", at, 5).name == "egg-19700101T000000.250Z-5.mcap"
    assert episode_path(directory, "my tasks/a", at, 5).name.startswith("my-tasks-a-1970")
    assert episode_path(directory, "egg", at, None).name.endswith(f"-p{os.getpid()}.mcap")


def test_an_episode_is_never_overwritten(tmp_path: Path) -> None:
    path = tmp_path / "e.mcap"
    path.write_bytes(b"mine")
    with pytest.raises(EpisodeError, match="never overwritten"), EpisodeWriter(path, header()):
        pass
    assert path.read_bytes() == b"mine"


@pytest.mark.parametrize(
    ("where", "message"),
    [("missing/e.mcap", "directory does not exist"), ("file/e.mcap", "not a directory")],
)
def test_a_directory_that_is_none_is_named(tmp_path: Path, where: str, message: str) -> None:
    (tmp_path / "file").write_text("")
    writer = EpisodeWriter(tmp_path / where, header())
    with pytest.raises(EpisodeError, match=f"can't create .*{message}.*--record"), writer:
        pass


def test_a_folder_in_the_place_of_a_picture_is_told_with_the_flag_that_names_another() -> None:
    error = IsADirectoryError(errno.EISDIR, "it is a folder")
    told = refusal(Path("here"), "write", error, flag="--out")
    assert told == "can't write here: it is a folder; name a file with --out"


def test_a_record_directory_is_made_when_it_is_missing(tmp_path: Path) -> None:
    assert make_record_directory(tmp_path / "a" / "b").is_dir()


def test_a_record_directory_that_is_a_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(EpisodeError, match=r"file is not a directory.*--record"):
        make_record_directory(tmp_path / "file")
    with pytest.raises(EpisodeError, match=r"not a directory.*--record"):
        make_record_directory(tmp_path / "file" / "below")


def test_a_read_only_directory_is_refused(tmp_path: Path, monkeypatch: Patch) -> None:
    def refuse(_path: Path) -> BufferedWriter:
        raise OSError(errno.EROFS, "Read-only file system")

    monkeypatch.setattr(writer_module, "_create", refuse)
    with pytest.raises(EpisodeError, match=r"read-only.*--record"):
        EpisodeWriter(tmp_path / "e.mcap", header()).__enter__()
    monkeypatch.setattr(os, "access", lambda *_: False)
    with pytest.raises(EpisodeError, match=r"is read-only.*--record"):
        make_record_directory(tmp_path)


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="needs Linux's /proc")
@pytest.mark.parametrize("place", ["/proc/x", "/proc/x/y"])
def test_a_file_system_that_takes_no_directory_is_quoted(place: str, monkeypatch: Patch) -> None:
    monkeypatch.setattr(os, "access", lambda *_: True)  # as for root
    with pytest.raises(EpisodeError, match=r"can't create /proc/x: .*; give another") as caught:
        check_record_directory(Path(place))
    assert "does not exist" not in str(caught.value)


def test_checking_a_record_directory_leaves_nothing(tmp_path: Path) -> None:
    check_record_directory(tmp_path / "a" / "b")
    check_record_directory(tmp_path)
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write to read-only directories")
def test_a_directory_without_permission_is_refused(tmp_path: Path) -> None:
    tmp_path.chmod(0o500)
    with pytest.raises(EpisodeError, match="read-only"):
        make_record_directory(tmp_path)
    with pytest.raises(EpisodeError, match="permission denied"):
        EpisodeWriter(tmp_path / "e.mcap", header()).__enter__()


def test_a_disk_full_from_the_start_leaves_no_file(tmp_path: Path, monkeypatch: Patch) -> None:
    path = tmp_path / "e.mcap"

    def full(made: Path) -> BufferedWriter:
        made.touch()
        return Path("/dev/full").open("wb")

    monkeypatch.setattr(writer_module, "_create", full)
    with pytest.raises(EpisodeError, match=r"its header.*the disk is full; free space") as caught:
        EpisodeWriter(path, header()).__enter__()
    assert "recover" not in str(caught.value)
    assert not path.exists()


@contextmanager
def largest_file(size_bytes: int) -> Iterator[None]:
    """Let the system refuse to write beyond ``size_bytes``, in the middle of a record."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size_bytes, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


@pytest.mark.parametrize("room", [1, 5000, 9000])
def test_a_disk_full_in_mid_episode_surfaces_at_that_step_and_keeps_the_others(
    tmp_path: Path, room: int
) -> None:
    path = tmp_path / "e.mcap"
    with EpisodeWriter(path, header()) as writer:
        for index in range(3):
            writer.write_step(step_record(index))
        with largest_file(path.stat().st_size + room):
            with pytest.raises(EpisodeError, match=r"step 3 .*size limit.*episodes recover"):
                writer.write_step(step_record(3))
            with pytest.raises(EpisodeError, match="its end can't be written; see the error"):
                writer.finish(end())
    episode = read_episode(path)
    assert not episode.complete and episode.end is None
    assert [t.index for t in episode.steps] == [0, 1, 2]


def test_a_disk_that_fails_to_sync_is_an_error(tmp_path: Path, monkeypatch: Patch) -> None:
    def fail(_fd: int) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    with EpisodeWriter(tmp_path / "e.mcap", header()) as writer:
        monkeypatch.setattr(os, "fsync", fail)
        with pytest.raises(EpisodeError, match=r"can't write step 0 to .*the disk is full"):
            writer.write_step(step_record(0))
        monkeypatch.undo()


@pytest.mark.parametrize(
    ("bug", "expected"), [(None, EpisodeError), (RuntimeError("not its summary"), RuntimeError)]
)
def test_a_summary_that_does_not_fit_is_an_error_unless_another_is_on_its_way(
    tmp_path: Path, bug: Exception | None, expected: type[Exception]
) -> None:
    path = tmp_path / "e.mcap"
    with (
        pytest.raises(expected, match="its summary"),
        largest_file(1 << 30),
        EpisodeWriter(path, header()) as writer,
    ):
        writer.write_step(step_record(0))
        _, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (path.stat().st_size, hard))
        if bug is not None:
            raise bug
    assert len(read_episode(path).steps) == 1
