"""Cues of a held contact's shear, a unit's noise, and the model that judges them."""

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.tactile.cloud import grid_axes_mm
from cltp.tactile.sensors import sensor_named
from cltp.tactile.shear.contact_shear import LAG, NUM_VALUES, ShearWatch
from cltp.tactile.shear.field import ShearField
from cltp.tactile.shear.slip import (
    SlipJudge,
    SlipModel,
    noise_of,
    read_model,
    slip_model,
    write_model,
)

SENSORS = ("taxels", "gelsight_mini_markers")
SHIFT_CUE = -3
"""Place of the shift of the indentation among the cues [mm]."""


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


def model_of(width=NUM_VALUES, weight=1.0):
    return SlipModel(
        mean=np.zeros(width),
        spread=np.ones(width),
        layers=((np.full((2, width), weight), np.zeros(2)), (np.ones((1, 2)), np.array([0.5]))),
        threshold=1.0,
    )


def test_a_score_is_that_of_the_network_worked_by_hand():
    values = np.zeros(NUM_VALUES)
    values[0] = 0.3
    assert model_of().score(values) == pytest.approx(2 * np.tanh(0.3) + 0.5)


def test_a_judge_takes_the_mean_of_the_frames_of_twenty_milliseconds_over_the_threshold():
    low, high = np.zeros(NUM_VALUES), np.zeros(NUM_VALUES)
    high[0] = 0.3
    scores = model_of().score(low), model_of().score(high)
    fast, slow = SlipJudge(model_of(), 100.0), SlipJudge(model_of(), 25.0, threshold=0.25)
    assert [fast.see(each) for each in (low, high, high)] == pytest.approx(
        [scores[0] - 1, sum(scores) / 2 - 1, scores[1] - 1]
    )
    assert [slow.see(each) for each in (low, high)] == pytest.approx(
        [score - 0.25 for score in scores]
    )


def test_a_written_model_reads_back(tmp_path):
    path = tmp_path / "slip.npz"
    write_model(path, model_of())
    values = np.linspace(-1, 1, NUM_VALUES)
    assert read_model(path).score(values) == pytest.approx(model_of().score(values), abs=1e-5)
    assert read_model(path).threshold == 1.0


@pytest.mark.parametrize("content", [b"", b"no model"])
def test_another_file_is_no_model(tmp_path, content):
    path = tmp_path / "slip.npz"
    path.write_bytes(content)
    with pytest.raises(TouchError, match="no slip model"):
        read_model(path)


@pytest.mark.parametrize(("width", "weight"), [(NUM_VALUES - 1, 1.0), (NUM_VALUES, np.nan)])
def test_a_model_of_another_shape_or_not_finite_is_refused(width, weight):
    with pytest.raises(TouchError):
        model_of(width, weight)


@pytest.mark.parametrize("name", SENSORS)
def test_a_model_comes_along_for_each_sensor_of_shear(name):
    assert np.isfinite(slip_model(name).score(np.zeros(NUM_VALUES)))


def test_no_model_for_a_sensor_without_shear():
    with pytest.raises(TouchError, match="known: gelsight_mini_markers, taxels"):
        slip_model("gelsight_mini")
