"""Viewers of MCAP find points in metres, transforms, pictures, text and numbers in an episode."""

from __future__ import annotations

import io
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory
from PIL import Image
from scipy.spatial.transform import Rotation

from cltp.sensing.frames import jpeg_of
from cltp.tactile.picture import DEPTH_PALETTE, depth_levels
from primitives.contract import Band, Contract
from primitives.execution import PadAxes
from primitives.sense import Interval
from tacgrasp.episodes import EpisodeWriter, StepPhase, read_episode
from tacgrasp.episodes.height_image import SCALE_PX, WIDTH_PX, height_image
from tacgrasp.episodes.view_messages import NUMBERS, numbers, quaternion, tcp_from_gel
from tests.fakes.contracts import contract
from tests.fakes.episode_samples import SENSOR, end, header, press, record, same, step_record

OLD = Path(__file__).parent / "data" / "format1.mcap"
"""An episode of format 1, written by the version before: step_record 0, 1 (no action), 2 (lift)."""

PAD = PadAxes(x_tcp=(1.0, 0.0, 0.0), y_tcp=(0.0, -1.0, 0.0))


def contracted() -> Contract:
    return contract(0.95, 1.9, 2.4)


def messages_of(path: Path) -> dict[str, list[Any]]:
    """Decoded protobuf messages by topic, read as any reader of MCAP does."""
    found: dict[str, list[Any]] = {}
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
        topics = [c.topic for c in reader.get_summary().channels.values()]  # type: ignore[union-attr]
        viewed = [t for t in topics if t in ("/tf", "/text", "/numbers") or "/touch" in t]
        for _, channel, _, message in reader.iter_decoded_messages(topics=viewed):
            found.setdefault(channel.topic, []).append(message)
    return found


def written(tmp_path: Path, **changes: Any) -> dict[str, list[Any]]:
    path = tmp_path / "e.mcap"
    with EpisodeWriter(path, replace(header(), pad=PAD, contract=contracted())) as writer:
        writer.write_step(replace(step_record(0), **changes))
        writer.finish(end())
    return messages_of(path)


def test_an_episode_of_the_format_before_is_read_as_it_was_recorded() -> None:
    episode = read_episode(OLD)
    expected = [
        step_record(0),
        step_record(1, action=None),
        step_record(2, phase=StepPhase.VERIFY_AFTER),
    ]
    assert episode.complete
    for read, wanted in zip(episode.steps, expected, strict=True):
        assert read.cloud.points_mm.tobytes() == wanted.cloud.points_mm.tobytes()
        assert same(read, wanted)
    assert same(episode.end, end())


def test_points_are_in_metres(tmp_path: Path) -> None:
    (cloud,) = written(tmp_path)["/touch/cloud"]
    assert [(f.name, f.type) for f in cloud.fields][:3] == [(axis, 7) for axis in "xyz"]
    packed = np.frombuffer(cloud.data, "<f4,<f4,<f4,V3")
    assert np.abs(packed["f0"]).max() < SENSOR.width_mm / 2000
    deepest = step_record(0).cloud.points_mm[:, 2].max() / 1000
    assert packed["f2"].max() == pytest.approx(deepest, rel=1e-6)


def test_the_transforms_lead_from_the_base_to_the_gel(tmp_path: Path) -> None:
    (message,) = written(tmp_path)["/tf"]
    arm, gel = message.transforms
    assert (arm.parent_frame_id, arm.child_frame_id) == ("base", "tcp")
    assert (gel.parent_frame_id, gel.child_frame_id) == ("tcp", "gel")
    assert (arm.translation.x, arm.translation.y, arm.translation.z) == (0.1, 1 / 3, 0.2)
    # the arm's rotation vector is (0, pi, 0): half a turn about y
    assert (arm.rotation.x, arm.rotation.y, arm.rotation.z) == (0.0, pytest.approx(1.0), 0.0)
    # x × y of the pad is (0, 0, -1); the opening of 30 mm puts the gel 15 mm along it
    assert (gel.translation.x, gel.translation.y, gel.translation.z) == (0.0, 0.0, -0.015)


def test_the_gel_s_turn_takes_its_axes_to_those_of_the_pad() -> None:
    position_m, turn = tcp_from_gel(PAD, 0.04)
    axes = Rotation.from_quat(turn).as_matrix()
    np.testing.assert_allclose(axes, [[1, 0, 0], [0, -1, 0], [0, 0, -1]], atol=1e-12)
    np.testing.assert_allclose(position_m, [0, 0, -0.02])


@pytest.mark.parametrize("rotvec", [(0, 0, 0), (0.3, -2.0, 1.1), (1e-13, 0, 0), (0, np.pi, 0)])
def test_a_rotation_vector_becomes_the_same_quaternion_as_scipy_s(
    rotvec: tuple[float, float, float],
) -> None:
    mine = quaternion(np.array(rotvec, dtype=float))
    np.testing.assert_allclose(mine, Rotation.from_rotvec(rotvec).as_quat(), atol=1e-12)


def test_numbers_have_names_and_what_is_not_known_is_left_out(tmp_path: Path) -> None:
    felt = Interval(value=1.2, low=0.9, high=1.6)
    (message,) = written(tmp_path, felt_force_n=felt, in_contact=True)["/numbers"]
    values = {field.name: value for field, value in message.ListFields()}
    assert set(values) == set(NUMBERS)
    assert (values["felt_n"], values["felt_low_n"], values["felt_high_n"]) == (1.2, 0.9, 1.6)
    assert (values["goal_low_n"], values["goal_high_n"], values["limit_n"]) == (0.95, 1.9, 2.4)
    assert values["commanded_n"] == 1 / 3
    untouched = replace(step_record(0), in_contact=False, decision=None)
    assert set(numbers(untouched, None)) == {"commanded_n", "opening_mm", "step_ms"}


def test_numbers_follow_a_contract_that_was_softened(tmp_path: Path) -> None:
    path = tmp_path / "e.mcap"
    softer = replace(contracted(), force_n=Band(low=0.2, high=0.4), limit_n=0.5)
    with EpisodeWriter(path, replace(header(), contract=contracted())) as writer:
        for index, new in enumerate((None, softer, None)):
            writer.write_step(replace(step_record(index), contract=new))
    limits = [message.limit_n for message in messages_of(path)["/numbers"]]
    assert limits == [2.4, 0.5, 0.5]


def test_the_picture_of_heights_is_in_the_colours_of_its_scale(tmp_path: Path) -> None:
    (message,) = written(tmp_path)["/touch/heights"]
    assert message.format == "png"
    pixels = np.asarray(Image.open(io.BytesIO(message.data)).convert("RGB"))
    assert pixels.shape == (150, WIDTH_PX + SCALE_PX, 3)
    corner = DEPTH_PALETTE[depth_levels(np.zeros(1))[0]].astype(int)
    assert np.abs(pixels[3, 3].astype(int) - corner).max() < 40  # untouched, with noise
    scale = pixels[:, WIDTH_PX + 14].astype(int).sum(axis=1)
    assert scale[26] > scale[80] > scale[120]  # deepest on top


def test_the_deepest_point_is_the_brightest_of_the_picture() -> None:
    levels = height_image(press(5.0, 4.0, 0.8))[:, :WIDTH_PX]
    row, column = np.unravel_index(levels.argmax(), levels.shape)
    assert abs(column / WIDTH_PX - (0.5 + 5.0 / SENSOR.width_mm)) < 0.04
    assert abs(row / 150 - (0.5 - 4.0 / SENSOR.height_mm)) < 0.06


def test_what_was_said_is_a_log_with_what_was_done_and_a_survived_failure_warns(
    tmp_path: Path,
) -> None:
    said, ended = written(tmp_path)["/text"]
    assert said.message.startswith("Touch 0: the contact is at the bottom-center")
    assert "[move_down: 2.5 mm" in said.message
    assert (said.level, ended.level) == (2, 2)  # INFO
    assert ended.message == "end: success - Grasp completed successfully"
    (tmp_path / "e.mcap").unlink()
    warned = written(tmp_path, note="TouchError: no frame")["/text"][0]
    assert warned.level == 3
    assert "(TouchError: no frame)" in warned.message


def test_the_camera_s_frame_is_recorded_and_read_again_as_it_was_stored(tmp_path: Path) -> None:
    frame = np.full((240, 320, 3), (120, 80, 40), dtype=np.uint8)
    jpeg = jpeg_of(frame)
    (message,) = written(tmp_path, camera_jpeg=jpeg)["/touch/camera"]
    assert message.format == "jpeg"
    stored = np.asarray(Image.open(io.BytesIO(message.data)))
    assert np.abs(stored.astype(int) - frame).max() <= 3
    assert read_episode(tmp_path / "e.mcap").steps[0].camera_jpeg == jpeg


def test_foxglove_s_schemas_are_stored_with_their_own_fields(tmp_path: Path) -> None:
    from foxglove_schemas_protobuf import CompressedImage_pb2, FrameTransforms_pb2, Log_pb2
    from foxglove_schemas_protobuf import PointCloud_pb2 as clouds
    from google.protobuf.descriptor_pb2 import FileDescriptorSet

    record(tmp_path / "e.mcap", [step_record(0)])
    wanted = {
        "foxglove.PointCloud": clouds.PointCloud,
        "foxglove.FrameTransforms": FrameTransforms_pb2.FrameTransforms,
        "foxglove.CompressedImage": CompressedImage_pb2.CompressedImage,
        "foxglove.Log": Log_pb2.Log,
    }
    with (tmp_path / "e.mcap").open("rb") as file:
        schemas = make_reader(file).get_summary().schemas.values()  # type: ignore[union-attr]
    stored = {s.name: s for s in schemas if s.encoding == "protobuf"}
    assert set(stored) == {*wanted, "tacgrasp.Numbers"}
    for name, kind in wanted.items():
        files = FileDescriptorSet.FromString(stored[name].data).file
        (message,) = [m for f in files for m in f.message_type if f"{f.package}.{m.name}" == name]
        fields = {(f.name, f.number, f.type) for f in message.field}
        assert fields == {(f.name, f.number, f.type) for f in kind.DESCRIPTOR.fields}


def test_an_episode_without_a_contract_or_pad_has_no_goal_and_no_place_of_the_gel(
    tmp_path: Path,
) -> None:
    record(tmp_path / "e.mcap", [step_record(0)])
    found = messages_of(tmp_path / "e.mcap")
    assert len(found["/tf"][0].transforms) == 1
    assert not found["/numbers"][0].HasField("limit_n")
