"""What a held contact could still carry, read from its mean shear field."""

import math
from dataclasses import replace

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.tactile.sensors import sensor_named
from cltp.tactile.shear import reserve as reserve_module
from cltp.tactile.shear.contact_shape import grid_of
from cltp.tactile.shear.field import ShearField
from cltp.tactile.shear.noise import ShearUnit
from cltp.tactile.shear.reserve import mean_field, num_frames, place_mm, reserve_model
from sim.grasp.drawn.grips import drawn_grips

TAXELS = sensor_named("taxels")


def bump(x_mm=0.0, y_mm=0.0, drag_mm=0.05, sensor=TAXELS):
    """A round indentation that is dragged along."""
    grid = grid_of(sensor)
    shape = np.exp(-((grid.x - x_mm) ** 2 + (grid.y - y_mm) ** 2) / 8)
    moved = np.stack([0 * shape, drag_mm * shape, 0.2 * shape], axis=1)
    return ShearField(
        sensor=sensor,
        positions_mm=np.stack([grid.x, grid.y], axis=1).astype(np.float32),
        displacement_mm=moved.astype(np.float32),
    )


def test_the_mean_of_frames_has_their_mean_at_every_point_that_any_of_them_found():
    first, second = bump(drag_mm=0.02), bump(drag_mm=0.04)
    part = replace(
        second,
        positions_mm=second.positions_mm[10:],
        displacement_mm=second.displacement_mm[10:],
    )
    mean = mean_field([first, part])
    assert mean.frames == 2
    assert mean.field.displacement_mm[:10] == pytest.approx(first.displacement_mm[:10])
    expected = (first.displacement_mm[10:] + second.displacement_mm[10:]) / 2
    assert mean.field.displacement_mm[10:] == pytest.approx(expected, abs=1e-6)


def test_the_place_of_an_indentation_is_its_middle_and_nothing_has_none():
    assert place_mm(mean_field([bump(2.0, -1.0)])) == pytest.approx((2.0, -1.0), abs=0.15)
    flat = replace(bump(), displacement_mm=0 * bump().displacement_mm)
    assert place_mm(mean_field([flat])) is None


def test_a_tenth_of_a_second_is_averaged_and_three_frames_at_least():
    assert num_frames(TAXELS) == 10
    assert num_frames(sensor_named("gelsight_mini_markers")) == 3


@pytest.fixture(scope="module")
def grips():
    """Grips of three bodies that nothing was trained on."""
    return [list(drawn_grips(seed)) for seed in range(1_000_000, 1_000_003)]


@pytest.mark.parametrize("name", ["taxels", "gelsight_mini_markers"])
def test_firmer_grips_of_unseen_bodies_are_read_as_a_larger_reserve(name, grips):
    sensor, rng, errors = sensor_named(name), np.random.default_rng(0), []
    unit = ShearUnit(along_mm=0.004, depth_mm=0.004)
    for of_body in grips:
        read, truth = [], []
        for grip in of_body:
            mean = mean_field([unit.apply(each, rng) for each in grip.fields(sensor, 0.1)])
            reserve = reserve_model(name).read(mean, (unit.along_mm, unit.depth_mm))
            assert reserve is not None and reserve.low <= reserve.middle
            read.append(reserve.middle)
            truth.append(math.log(grip.reserve) if grip.hangs else -0.1)
        assert np.corrcoef(read, truth)[0, 1] > 0.8
        errors.append(np.abs(np.subtract(read, np.clip(truth, -0.1, 1.3))).mean())
    assert np.mean(errors) < 0.25


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04 and no more", b"no archive at all"])
def test_a_damaged_model_is_refused_by_its_path(content, tmp_path, monkeypatch):
    (tmp_path / "reserve_taxels.npz").write_bytes(content)
    monkeypatch.setattr(reserve_module, "MODELS", tmp_path)
    with pytest.raises(TouchError, match=r"reserve_taxels\.npz"):
        reserve_model.__wrapped__("taxels")


def test_a_sensor_without_a_model_is_refused_by_name():
    with pytest.raises(TouchError, match="gelsight_mini'"):
        reserve_model("gelsight_mini")
