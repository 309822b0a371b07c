"""A contact for programs: numbers with intervals, and why a reading is not to be acted on."""

import dataclasses
import json
from pathlib import Path

import numpy as np
import pytest
import torch

from cltp.encoder.encoder import PRESETS, TactileEncoder
from cltp.encoder.heads import StateHeads, transformed
from cltp.encoder.heads_output import HeadsOutput
from cltp.encoder.reader import Flag, Number, TouchReader, TouchReading, fine_noise_mm, reading_of
from cltp.encoder.readings import readings_of
from cltp.errors import TouchError
from cltp.tactile.cells import resampled
from cltp.tactile.cloud import TactileCloud, cloud_from_heights, cloud_of_pixels
from cltp.tactile.force_scale import ForceScale
from cltp.tactile.measure import contact_state
from cltp.tactile.point_layout import GRID
from cltp.tactile.sensors import SENSORS
from cltp.tactile.states import CLASSES, NUMBERS
from tacgrasp.__main__ import main
from tacgrasp.playback.describe import (
    FORCES_DIFFER,
    LOWERED,
    NO_INTERVALS,
    RAISED,
    UNCALIBRATED_FORCE,
    describe,
    describe_in_numbers,
    differing,
)
from tests.fakes.tiny_weights import bump

MINI = SENSORS["gelsight_mini"]


def cloud(noise_mm: float = 0.0, depth_mm: float = 0.5) -> TactileCloud:
    heights = resampled(bump(1.0, -2.0, depth_mm), GRID.rows, GRID.columns)
    rng = np.random.default_rng(0)
    return cloud_of_pixels(heights + noise_mm * rng.standard_normal(heights.shape), MINI)


@pytest.fixture(scope="module")
def reader() -> TouchReader:
    torch.manual_seed(0)
    encoder = TactileEncoder(PRESETS["tiny_grid"])
    heads = StateHeads.of(encoder.config)
    with torch.no_grad():
        heads.out.bias[sum(heads.sizes[:6])] = 5.0  # something touches
        heads.out.bias[sum(heads.sizes[:6]) - 1] = 1.0  # with some force
    return TouchReader(encoder, heads)


def test_every_number_has_an_interval_that_holds_it(reader: TouchReader) -> None:
    told = describe_in_numbers(cloud(), reader)
    assert json.loads(json.dumps(told)) == told
    assert told["contact"] is True
    assert list(told["numbers"]) == list(NUMBERS)
    for number in told["numbers"].values():
        assert number["lo"] <= number["value"] <= number["hi"]
    assert told["numbers"]["depth_mm"]["lo"] >= 0
    assert set(told["confidence"]) == {"shape", "texture", "depth", "position", "area"}
    # an untrained reader's force is another one than that of the gel's shape
    assert told["flags"] == [FORCES_DIFFER, UNCALIBRATED_FORCE]


def test_a_force_without_a_calibration_is_less_certain(reader: TouchReader) -> None:
    widths = []
    for spread in (0.02, 0.3):
        scale = ForceScale(factor=1.4, spread=spread, source="unit 7")
        number = reader.read(dataclasses.replace(cloud(), force_scale=scale)).numbers["force_n"]
        nominal = reader.read(cloud()).numbers["force_n"]
        assert number.value == pytest.approx(1.4 * nominal.value)
        widths.append(number.high - number.low)
    assert widths[1] > widths[0]


def test_more_noise_than_was_learned_from_is_flagged(reader: TouchReader) -> None:
    assert Flag.NOISE not in reader.read(cloud(0.03)).flags
    assert Flag.NOISE in reader.read(cloud(0.08)).flags
    assert fine_noise_mm(cloud(0.03)) == pytest.approx(0.03, rel=0.1)


@pytest.mark.parametrize("noise_mm", [0.03, 0.08])
@pytest.mark.parametrize("is_grid", [True, False])
def test_noise_of_few_points_is_read_as_large_as_it_is(noise_mm: float, *, is_grid: bool) -> None:
    rng = np.random.default_rng(0)
    even = cloud_from_heights(bump(1.0, -2.0, 0.5), MINI, rng=None if is_grid else rng)
    points = even.points_mm.copy()
    points[:, 2] += rng.normal(0, noise_mm, len(points))
    noisy = dataclasses.replace(even, points_mm=points)
    assert fine_noise_mm(noisy) == pytest.approx(noise_mm, rel=0.2)


@pytest.mark.parametrize(
    ("width_mm", "height_mm", "is_flagged"),
    [
        *[(20.3, 15.2, False), (24.0, 14.4, False), (14.4, 19.2, False), (12.0, 12.0, False)],
        *[(33.0, 24.0, False), (60.0, 45.0, True), (5.0, 3.0, True)],  # sizes
        *[(20.0, 6.0, True), (8.0, 15.0, True)],  # proportions
    ],
)
def test_a_pad_of_which_no_training_has_the_like_is_flagged(
    reader: TouchReader, width_mm: float, height_mm: float, is_flagged: bool
) -> None:
    rows, columns = round(10 * height_mm), round(10 * width_mm)
    sensor = dataclasses.replace(MINI, name="other", rows=rows, columns=columns, mm_per_px=0.1)
    reading = reader.read(cloud_of_pixels(np.zeros((rows, columns)), sensor))
    assert (Flag.PAD in reading.flags) is is_flagged


def test_every_sensor_of_ours_is_learned_from(reader: TouchReader) -> None:
    for sensor in SENSORS.values():
        flat = cloud_of_pixels(np.zeros((sensor.rows, sensor.columns)), sensor)
        assert Flag.PAD not in reader.read(flat).flags, sensor.name


def test_what_tells_nothing_is_flagged(reader: TouchReader) -> None:
    encoder, heads = TactileEncoder(PRESETS["tiny_grid"]), StateHeads.of(PRESETS["tiny_grid"])
    assert heads.widening is not None
    heads.widening.fill_(1e-3)
    assert Flag.UNSURE not in TouchReader(encoder, heads).read(cloud()).flags
    heads.widening.fill_(1e2)
    assert Flag.UNSURE in TouchReader(encoder, heads).read(cloud()).flags


@pytest.mark.parametrize(("commanded_n", "is_flagged"), [(None, False), (1.0, False), (0.05, True)])
def test_a_force_that_no_command_comes_to_is_flagged(
    commanded_n: float | None, is_flagged: bool
) -> None:
    heads = HeadsOutput(
        logits=tuple(torch.zeros(1, len(names)) for names in CLASSES.values()),
        numbers=transformed(torch.tensor([[0.4, 0.0, 0.0, 0.05, 1.3]])),
        touching=torch.full((1,), 5.0),
        cut=torch.full((1, 4), -5.0),
        margins=torch.full((1, 5, 2), 0.02),
    )
    reading = reading_of(readings_of(heads), cloud(), commanded_force_n=commanded_n)
    assert (Flag.FORCE in reading.flags) is is_flagged


def read_as(depth_mm: float, heights_mm: np.ndarray) -> TouchReading:
    """The reading of some heights by heads that read a depth, with an interval of 0.03 mm."""
    heads = HeadsOutput(
        logits=tuple(torch.zeros(1, len(names)) for names in CLASSES.values()),
        numbers=transformed(torch.tensor([[depth_mm, 0.0, 0.0, 0.1, 5.0]])),
        touching=torch.full((1,), 5.0),
        cut=torch.full((1, 4), -5.0),
        margins=torch.full((1, 5, 2), 0.1),
    )
    return reading_of(readings_of(heads), cloud_of_pixels(heights_mm, MINI))


@pytest.mark.parametrize(
    ("read_mm", "true_mm", "is_flagged"),
    [(1.3, 2.0, True), (1.3, 1.6, True), (1.98, 2.0, False), (1.0, 1.25, False)],
)
def test_a_depth_below_a_measured_one_that_was_not_learned_is_flagged(
    read_mm: float, true_mm: float, is_flagged: bool
) -> None:
    reading = read_as(read_mm, bump(0.0, 0.0, true_mm))
    assert (Flag.RANGE in reading.flags) is is_flagged


def test_numbers_that_are_not_finite_are_flagged() -> None:
    encoder, heads = TactileEncoder(PRESETS["tiny_grid"]), StateHeads.of(PRESETS["tiny_grid"])
    with torch.no_grad():
        heads.out.bias.fill_(float("inf"))
    assert Flag.RANGE in TouchReader(encoder, heads).read(cloud()).flags


def test_an_untouched_gel_has_no_numbers(reader: TouchReader) -> None:
    told = describe_in_numbers(cloud(depth_mm=0.0), reader)
    assert (told["contact"], told["numbers"], told["flags"]) == (False, {}, [])
    assert told["state"]["shape"] is None


@pytest.mark.parametrize(
    ("measured_n", "is_told"),
    [(0.22, True), (0.9, False), (4.0, False), (9.3, False), (9.6, True)],
)
def test_forces_that_exclude_each_other_are_told(measured_n: float, is_told: bool) -> None:
    measured = dataclasses.replace(contact_state(cloud()), force_n=measured_n)
    said = differing(measured, {"force_n": Number(3.4, 1.8, 5.95)})
    assert said == (f"{measured_n:.2f} N by the gel's shape, 1.80-5.95 N by the model" * is_told)


def test_a_wide_contact_that_is_not_measured_is_not_denied() -> None:
    face = np.full((60, 80), 0.1)
    face[:, :4] = face[:, -4:] = 0.013
    lines = describe(cloud_of_pixels(face, MINI))
    assert not any("nothing touches" in line for line in lines)


def test_without_intervals_the_measured_numbers_say_so() -> None:
    told = describe_in_numbers(cloud(), None)
    assert told["flags"] == [NO_INTERVALS, UNCALIBRATED_FORCE]
    assert told["numbers"]["depth_mm"]["value"] == pytest.approx(0.5, abs=0.06)
    assert told["numbers"]["depth_mm"]["lo"] is None
    with pytest.raises(TouchError, match="without intervals"):
        TouchReader(TactileEncoder(PRESETS["tiny"]), StateHeads(96, intervals=False))


def test_the_command_prints_one_object(tmp_path, capsys) -> None:
    np.save(tmp_path / "touch.npy", bump(1.0, -2.0, 0.5))
    assert main(["describe", str(tmp_path / "touch.npy"), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["contact"] is True and "force_n" in told["numbers"]


def test_a_pad_that_is_pressed_all_over_is_flagged_and_not_called_untouched(
    reader: TouchReader,
) -> None:
    pressed = cloud_of_pixels(np.full((60, 80), 0.5), MINI)
    told = describe_in_numbers(pressed, reader)
    assert json.loads(json.dumps(told)) == told
    assert (told["contact"], told["numbers"]) == (None, {})
    assert told["flags"] == [RAISED] == [Flag.RAISED]
    assert told["state"]["caption"].startswith("the whole pad is raised by 0.50 mm")
    assert "unreadable: the whole pad is raised" in describe(pressed)[-1]
    assert Flag.RAISED in reader.read(pressed).flags
    assert Flag.RAISED not in reader.read(cloud()).flags


def test_a_pad_that_is_lowered_as_a_whole_is_measured_and_flagged(reader: TouchReader) -> None:
    lowered = cloud_of_pixels(bump(1.0, -2.0, 0.5) - 0.3, MINI)
    told = describe_in_numbers(lowered, reader)
    assert told["contact"] is True
    assert LOWERED in told["flags"]
    assert LOWERED not in describe_in_numbers(cloud(), reader)["flags"]
    untouched = cloud_of_pixels(np.full((60, 80), -0.3), MINI)
    assert describe_in_numbers(untouched, reader)["flags"] == [LOWERED]
    said = "\n".join(describe(lowered))
    assert "zero      don't act on this: a tenth of the pad lies 0.30 mm below" in said
    assert "force     about" in said


@pytest.mark.parametrize("command", [["describe"], ["describe", "--json"], ["ask"]])
@pytest.mark.parametrize("option", ["--background", "--calibration"])
def test_what_a_frame_alone_needs_is_refused_with_a_height_map(
    command: list[str], option: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "ball.npy"
    np.save(path, bump(1.0, -2.0, 0.5))
    question = ["How deep is it?"] if command == ["ask"] else []
    assert main([*command, str(path), *question, option, "nofile"]) == 2
    said = capsys.readouterr()
    assert said.err.count("\n") == 1
    assert f"{option} nofile is for a camera's frame" in said.err
    assert "is a cloud or height map; leave it out" in said.err
    assert said.out == ""


@pytest.mark.parametrize("argv", [["describe"], ["describe", "--json"]])
def test_heights_of_the_wrong_sign_name_their_file(argv, tmp_path, capsys) -> None:
    np.save(tmp_path / "neg.npy", -bump(1.0, -2.0, 0.5))
    assert main([*argv, str(tmp_path / "neg.npy")]) == 2
    error = capsys.readouterr().err
    assert "neg.npy: the gel rises" in error
    assert error.count("\n") == 1
