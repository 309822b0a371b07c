"""Cues of a held contact's shear, a unit's noise, and the model that judges them."""

import numpy as np
import pytest
import torch

from cltp.errors import TouchError
from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.sensors import sensor_named
from cltp.tactile.shear.contact_shear import (
    LAG,
    MIRROR_ORDER,
    MIRROR_SIGNS,
    NUM_VALUES,
    SPOTS,
    ShearWatch,
)
from cltp.tactile.shear.field import ShearField
from cltp.tactile.shear.slip import (
    LARGEST_CUE,
    SlipJudge,
    SlipModel,
    noise_of,
    read_model,
    slip_model,
    write_model,
)

SENSORS = ("taxels", "gelsight_mini_markers")
FIRST_SPOT = NUM_VALUES - 3 * len(SPOTS)
SHIFT_CUE = FIRST_SPOT - 3
"""Place of the shift of the indentation among the cues [mm]."""
SHIFT_SINCE_REST_CUE = FIRST_SPOT - 11
"""Place of that since the hold began [mm]."""


def positions_of(sensor):
    x, y = np.meshgrid(*grid_axes_mm(sensor, *sensor.shear_grid))
    return np.stack([x.ravel(), y.ravel()], axis=1).astype(np.float32)


def field_of(
    sensor, *, along_mm=(0.1, 0.0), at_mm=(0.0, 0.0), depth_mm=0.2, points=None, noise=None
):
    """A round contact of 3 mm, carried along alike."""
    positions = positions_of(sensor)
    square = ((positions - np.array(at_mm)) ** 2).sum(axis=1)
    bump = np.exp(-square / 18)
    moved = np.stack([along_mm[0] * bump, along_mm[1] * bump, depth_mm * bump], axis=1)
    if noise is not None:
        moved = moved + noise
    kept = slice(None) if points is None else points
    return ShearField(
        positions_mm=positions[kept], displacement_mm=moved[kept].astype(np.float32), sensor=sensor
    )


def watch_of(sensor, fields):
    watch = ShearWatch(sensor, 0.002, 0.002)
    for field in fields:
        cues = watch.see(field)
    return cues


@pytest.mark.parametrize("name", SENSORS)
def test_cues_are_finite_and_tell_where_the_gel_was_dragged(name):
    sensor = sensor_named(name)
    field = field_of(sensor, along_mm=(0.06, -0.08))
    cues = watch_of(sensor, [field] * 3)
    assert cues.values.shape == (NUM_VALUES,)
    assert np.isfinite(cues.values).all()
    assert cues.along_mm[0] / cues.along_mm[1] == pytest.approx(-0.75, rel=1e-4)
    assert 0.07 < np.hypot(*cues.along_mm) < 0.1
    deepest_mm = np.sort(field.displacement_mm[:, 2])[-3:].mean()
    assert cues.depth_mm == pytest.approx(deepest_mm, rel=1e-5)


def test_an_untouched_gel_has_no_cues():
    sensor = sensor_named("taxels")
    assert watch_of(sensor, [field_of(sensor, depth_mm=0.0, along_mm=(0.0, 0.0))]) is None


def test_the_volume_grows_with_the_indentation():
    sensor = sensor_named("taxels")
    light, firm = (watch_of(sensor, [field_of(sensor, depth_mm=d)]) for d in (0.1, 0.2))
    assert firm.volume_mm3 == pytest.approx(2 * light.volume_mm3, rel=1e-4)


def test_an_indentation_that_moves_along_the_drag_shows_as_a_shift():
    sensor = sensor_named("taxels")
    resting = [field_of(sensor)] * 8
    still = watch_of(sensor, resting).values[SHIFT_CUE]
    moved = watch_of(sensor, [*resting, field_of(sensor, at_mm=(0.4, 0.0))]).values[SHIFT_CUE]
    assert still == pytest.approx(0.0, abs=1e-6)
    assert moved == pytest.approx(0.36, abs=0.06)  # a tenth is in the mean already


def test_points_that_a_frame_misses_change_the_cues_little():
    sensor = sensor_named("gelsight_mini_markers")
    some = np.delete(np.arange(63), [5, 31, 40])
    whole = watch_of(sensor, [field_of(sensor)] * 4).values
    missing = watch_of(sensor, [*[field_of(sensor)] * 3, field_of(sensor, points=some)]).values
    assert np.abs(whole - missing).max() < 0.2


def test_frames_are_kept_for_the_changes_alone():
    sensor = sensor_named("taxels")
    watch = ShearWatch(sensor, 0.002, 0.002)
    for _ in range(30):
        watch.see(field_of(sensor))
    assert watch.num_frames == 2 * LAG + 1


def mirrored(field):
    """The field mirrored along x."""
    rows, columns = field.sensor.shear_grid
    moved = field.displacement_mm.reshape(rows, columns, 3)[::-1] * np.array([1, -1, 1])
    return ShearField(
        positions_mm=field.positions_mm,
        displacement_mm=moved.reshape(-1, 3).astype(np.float32),
        sensor=field.sensor,
    )


def test_a_mirror_changes_cues_as_it_is_said_to():
    sensor, rng = sensor_named("taxels"), np.random.default_rng(0)
    noise = 0.004 * rng.standard_normal((4, 144, 3))
    fields = [
        field_of(sensor, along_mm=(0.1, 0.02 * k), at_mm=(0.3 * k, 0.5), noise=noise[k])
        for k in range(4)
    ]
    before = watch_of(sensor, fields).values
    after = watch_of(sensor, [mirrored(each) for each in fields]).values
    np.testing.assert_allclose(after, before[MIRROR_ORDER] * MIRROR_SIGNS, atol=1e-4)
    assert np.abs(before[MIRROR_SIGNS < 0]).max() > 0.01
    assert np.abs(after - before).max() > 0.01


@pytest.mark.parametrize("angle", [0.0, 0.7, 2.0, -2.5])
def test_spots_show_the_drag_where_it_is_whatever_its_direction(angle):
    sensor = sensor_named("taxels")
    to = np.array([np.cos(angle), np.sin(angle)])
    values = watch_of(sensor, [field_of(sensor, along_mm=0.1 * to)] * 4).values[FIRST_SPOT:]
    along, across, height = values.reshape(3, len(SPOTS))
    assert along[0] == pytest.approx(1.0, abs=0.15)  # in the middle as there
    assert np.abs(across).max() < 0.02
    assert along[0] > along[9] > along[-1] > 0  # less outwards, as the round contact has it
    assert height[0] > height[9] > height[-1]


def test_spots_beside_the_pad_are_nought():
    sensor = sensor_named("taxels")
    edge_mm = (sensor.width_mm / 2 - 0.5, 0.0)
    fields = [field_of(sensor, at_mm=edge_mm, along_mm=(0.1, 0.0))] * 4
    values = watch_of(sensor, fields).values[FIRST_SPOT:].reshape(3, len(SPOTS))
    assert (values[:, -8] == 0).all()  # ahead of the contact, where no gel is
    assert (values[:, 0] != 0).any()


def test_a_slow_slide_adds_up_against_the_hold_at_rest():
    sensor = sensor_named("taxels")
    slow = [field_of(sensor, at_mm=(0.02 * k, 0.0)) for k in range(40)]
    values = watch_of(sensor, [*[field_of(sensor)] * 10, *slow]).values
    assert values[SHIFT_SINCE_REST_CUE] > 1.5 * values[SHIFT_CUE] > 0


@pytest.mark.parametrize("name", SENSORS)
def test_the_noise_of_a_hold_is_that_of_its_frames(name):
    sensor, rng = sensor_named(name), np.random.default_rng(0)
    count = len(positions_of(sensor))
    fields = []
    for _ in range(30):
        noise = rng.standard_normal((count, 3)) * (0.004, 0.004, 0.010)
        points = np.flatnonzero(rng.random(count) > 0.05)
        fields.append(field_of(sensor, noise=noise, points=points))
    along_mm, depth_mm = noise_of(fields)
    assert along_mm == pytest.approx(0.004, rel=0.1)
    assert depth_mm == pytest.approx(0.010, rel=0.1)


def test_too_few_frames_tell_no_noise():
    sensor = sensor_named("taxels")
    with pytest.raises(TouchError, match="needs 4 frames"):
        noise_of([field_of(sensor)] * 3)


def test_frames_without_a_common_point_tell_no_noise():
    sensor = sensor_named("taxels")
    parts = [field_of(sensor, points=slice(k * 20, k * 20 + 20)) for k in range(4)]
    with pytest.raises(TouchError, match="share a point"):
        noise_of(parts)


def model_of(cues=NUM_VALUES, weight=1.0, keep=0.0, frame_hz=100.0):
    """One number is kept: half of the tanh of the sum of cues, at first."""
    ones = np.full((3, 1), 1.0)
    return SlipModel(
        mean=np.zeros(cues),
        spread=np.ones(cues),
        enter=(np.full((1, cues), weight), np.zeros(1)),
        take=(ones * [[0.0], [0.0], [1.0]], np.zeros(3)),
        keep=(ones * [[0.0], [0.0], [keep]], np.zeros(3)),
        leave=(np.ones((1, 1)), np.array([0.5])),
        frame_hz=frame_hz,
        threshold=1.0,
    )


def test_a_score_is_that_of_the_network_worked_by_hand():
    values = np.zeros(NUM_VALUES)
    values[0] = 0.3
    score, kept = model_of(keep=0.8).step(values, np.array([0.4]))
    candidate = np.tanh(np.tanh(0.3) + 0.5 * 0.8 * 0.4)
    assert kept == pytest.approx([0.5 * candidate + 0.5 * 0.4])
    assert score == pytest.approx(float(kept[0]) + 0.5)


def test_the_network_is_the_recurrent_unit_of_torch():
    torch.manual_seed(0)
    unit, rng = torch.nn.GRU(3, 3), np.random.default_rng(0)
    enter = rng.standard_normal((3, NUM_VALUES)) / 5, rng.standard_normal(3)
    tensors = (
        (unit.weight_ih_l0, unit.bias_ih_l0),
        (unit.weight_hh_l0, unit.bias_hh_l0),
    )
    take, keep = (tuple(each.detach().double().numpy() for each in pair) for pair in tensors)
    model = SlipModel(
        mean=np.zeros(NUM_VALUES),
        spread=np.ones(NUM_VALUES),
        enter=enter,
        take=take,
        keep=keep,
        leave=(np.ones((1, 3)), np.zeros(1)),
        frame_hz=100.0,
        threshold=0.0,
    )
    values = rng.standard_normal((6, NUM_VALUES))
    entered = torch.from_numpy(np.tanh(values @ enter[0].T + enter[1])).float()
    expected = unit(entered)[0].sum(dim=1).detach().numpy()
    judge = SlipJudge(model, 100.0)
    assert [judge.see(each) for each in values] == pytest.approx(expected.tolist(), abs=1e-5)


def test_a_judge_adds_up_what_its_frames_tell_over_the_threshold():
    values = np.zeros(NUM_VALUES)
    values[0] = 0.3
    judge, calibrated = SlipJudge(model_of(), 100.0), SlipJudge(model_of(), 100.0, threshold=0.25)
    part = np.tanh(np.tanh(0.3))
    expected = [part / 2, 3 * part / 4, 7 * part / 8]
    for each in expected:
        assert judge.see(values) == pytest.approx(each + 0.5 - 1.0)
        assert calibrated.see(values) == pytest.approx(each + 0.5 - 0.25)


def test_one_wild_cue_is_cut():
    values, more = np.zeros(NUM_VALUES), np.zeros(NUM_VALUES)
    values[0], more[0] = LARGEST_CUE, 1e6
    model = model_of(weight=0.1)
    assert model.step(values, np.zeros(1)) == model.step(more, np.zeros(1))


def test_a_model_of_another_rate_is_refused():
    with pytest.raises(TouchError, match="trained at 100 frames a second, the sensor gives 25"):
        SlipJudge(model_of(), 25.0)


def test_a_written_model_reads_back(tmp_path):
    path = tmp_path / "slip.npz"
    write_model(path, model_of())
    values, found = np.linspace(-1, 1, NUM_VALUES), read_model(path)
    expected = model_of().step(values, np.ones(1))
    assert found.step(values, np.ones(1))[0] == pytest.approx(expected[0], abs=1e-5)
    assert (found.threshold, found.frame_hz) == (1.0, 100.0)


@pytest.mark.parametrize("content", [b"", b"no model"])
def test_another_file_is_no_model(tmp_path, content):
    path = tmp_path / "slip.npz"
    path.write_bytes(content)
    with pytest.raises(TouchError, match="no slip model"):
        read_model(path)


@pytest.mark.parametrize(("cues", "weight"), [(NUM_VALUES - 1, 1.0), (NUM_VALUES, np.nan)])
def test_a_model_of_another_shape_or_not_finite_is_refused(cues, weight):
    with pytest.raises(TouchError):
        model_of(cues, weight)


@pytest.mark.parametrize("name", SENSORS)
def test_a_model_comes_along_for_each_sensor_of_shear(name):
    judge = SlipJudge(slip_model(name), sensor_named(name).frame_hz)
    assert np.isfinite(judge.see(np.zeros(NUM_VALUES)))


def test_no_model_for_a_sensor_without_shear():
    with pytest.raises(TouchError, match="known: gelsight_mini_markers, taxels"):
        slip_model("gelsight_mini")
