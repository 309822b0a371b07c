"""Rays that go in tubes first meet what each of them meets alone."""

import math

import numpy as np
import pytest
import torch

from sim.objects import object as objects
from sim.objects import ray_tubes as tubes
from sim.objects.catalogue import object_named
from sim.objects.faces import Dome, Flat, Flats
from sim.objects.ray_casting import ALONGSIDE_MM, BACK_MM, BEYOND_MM, cast_pad_rays, frame_at, march
from sim.objects.ray_tubes import march_over
from sim.objects.solids import Cut, Oval, Rods

ROWS, COLUMNS = 90, 130  # no multiples of a tube's rays
FAR_MM = BACK_MM + 2 * BEYOND_MM


def grid(turn=0.1, height=20.0, rows=ROWS, columns=COLUMNS):
    """Rays that come down on the origin, a little askew."""
    x, y = np.meshgrid(np.linspace(-8, 8, columns), np.linspace(6, -6, rows))
    frame = frame_at(np.array([math.sin(turn), 0.3 * turn, math.cos(turn)]) / 1.0045)
    frame[:, 2] /= np.linalg.norm(frame[:, 2])
    origins = height * frame[:, 2] + x[..., None] * frame[:, 0] + y[..., None] * frame[:, 1]
    as_float = [torch.from_numpy(v.astype(np.float32)) for v in (origins, -frame[:, 2])]
    return as_float[0], as_float[1]


class Counted:
    """A solid that counts how often it is asked."""

    def __init__(self, solid):
        self.solid, self.max_slope, self.points = solid, solid.max_slope, 0

    def distance(self, points):
        self.points += len(points)
        return self.solid.distance(points)


@pytest.mark.parametrize(
    "name", ["ball_9", "dots_12", "bars_2", "peg_hexagon_12", "egg_tip_26x16", "cup_9", "waves_5"]
)
def test_tubes_find_what_every_ray_finds_alone(name):
    obj = object_named(name)
    origins, along = grid()
    tubes, single = Counted(obj), Counted(obj)
    reached_mm = march_over(tubes, origins, along, FAR_MM)
    expected_mm = march(single, origins.view(-1, 3), along, FAR_MM).view(ROWS, COLUMNS)
    assert torch.isfinite(expected_mm).any()
    assert float(reached_mm.amin()) == pytest.approx(float(expected_mm.amin()), abs=5e-4)
    view = expected_mm < expected_mm.amin() + BEYOND_MM - 0.05
    # Along steep walls and at their rims the two end in different places.
    same = ((reached_mm - expected_mm).abs() < 2e-3) == view
    assert same[view].float().mean() > 0.985
    missed = torch.isinf(expected_mm)
    late = ~(reached_mm[missed] < reached_mm.amin() + BEYOND_MM)
    assert (~late).sum() <= 0.015 * missed.sum()
    assert tubes.points < 0.8 * single.points


def test_a_needle_between_the_middles_of_tubes_is_not_missed():
    origins, along = grid(turn=0.0)
    at = origins[41, 70]
    needle = Rods((((float(at[0]), float(at[1]), -9.0), (float(at[0]), float(at[1]), 2.0)),), 0.03)
    reached_mm = march_over(needle, origins, along, FAR_MM)
    assert torch.nonzero(torch.isfinite(reached_mm)).tolist() == [[41, 70]]
    assert reached_mm[41, 70].item() == pytest.approx(20 - 2.03, abs=1e-3)


def test_a_solid_whose_distance_is_too_steep_is_approached_with_care():
    oval = Oval(8.0, 3.0, 2.0)
    origins, along = grid()
    reached_mm = march_over(oval, origins, along, FAR_MM)
    expected_mm = march(oval, origins.view(-1, 3), along, FAR_MM).view(ROWS, COLUMNS)
    both = torch.isfinite(reached_mm) & torch.isfinite(expected_mm)
    assert both.float().mean() > 0.1
    assert (
        (reached_mm - expected_mm)[both].abs() < 2e-3
    ).float().mean() > 0.97  # all but the silhouette
    points = origins + reached_mm[..., None] * along
    assert oval.distance(points[torch.isfinite(reached_mm)]).abs().max() < ALONGSIDE_MM


def test_a_ray_that_starts_inside_is_said():
    ball = Cut((Dome(3.0),), 0.01, 3.0)
    origins, along = grid(height=2.0)
    reached_mm = march_over(ball, origins, along, FAR_MM)
    expected_mm = march(ball, origins.view(-1, 3), along, FAR_MM).view(ROWS, COLUMNS)
    assert torch.isnan(expected_mm).any()
    assert torch.equal(torch.isnan(reached_mm), torch.isnan(expected_mm))


def test_nothing_in_the_way_is_nothing_met():
    origins, along = grid()
    assert torch.isinf(march_over(object_named("ball_9"), origins + 60, along, FAR_MM)).all()


def test_a_finger_feels_the_same_through_tubes(monkeypatch):
    obj = object_named("pyramid_6_52")
    mount = obj.mounts[0]
    x, y = np.meshgrid(np.linspace(-8, 8, COLUMNS), np.linspace(6, -6, ROWS))
    pose = frame_at(np.array(mount.direction)), np.array(mount.point)
    plain = cast_pad_rays(obj, *pose, x, y)
    monkeypatch.setattr(objects, "MANY_RAYS", 1)
    quick = cast_pad_rays(obj, *pose, x, y)
    assert plain is not None
    assert quick is not None
    off = np.abs(plain.gap_mm - quick.gap_mm)
    assert off.max() > 0  # another way
    assert (off < 1e-3).mean() > 0.995


@pytest.mark.parametrize("height", [20.0, 4.0])  # the second begins inside
def test_rays_that_take_steps_together_end_where_they_would_one_step_at_a_time(monkeypatch, height):
    obj = object_named("peg_hexagon_12")
    origins, along = grid(turn=0.02, height=height)
    origins = origins - torch.tensor([0.0, 0.0, obj.reach_mm]) if height < 5 else origins
    reached_mm, queried = [], []
    for few in (0, 100_000):
        monkeypatch.setattr(tubes, "_FEW_RAYS", few)
        counted = Counted(obj)
        reached_mm.append(march_over(counted, origins, along, FAR_MM))
        queried.append(counted.points)
    assert queried[0] < queried[1]
    assert torch.isnan(reached_mm[0]).any() == (height < 5)
    assert torch.equal(reached_mm[0].nan_to_num(nan=-1.0), reached_mm[1].nan_to_num(nan=-1.0))


def test_what_a_finger_feels_lies_on_the_object_and_is_0_where_nothing_is():
    obj = object_named("ball_9")
    x, y = np.meshgrid(np.linspace(-8, 8, COLUMNS), np.linspace(6, -6, ROWS))
    frame = frame_at(np.array([0.6, 0.0, 0.8]))
    view = cast_pad_rays(obj, frame, np.zeros(3), x, y)
    assert view is not None
    covered = view.gap_mm < BEYOND_MM
    assert covered.any()
    assert not covered.all()
    away = obj.distance(torch.from_numpy(view.points[covered]))
    assert away.abs().max() < ALONGSIDE_MM
    across = (view.points @ frame)[covered][:, :2]
    assert np.abs(across - np.stack([x, y], axis=-1)[covered]).max() < 1e-9
    assert (view.points[~covered] == 0).all()


def test_planes_at_once_are_planes_one_by_one_to_the_last_bit():
    flats = [Flat((0.6, 0.8, 0.0), 1.3), Flat((0.0, 0.1, 0.995), -2.0), Flat((-1.0, 0.0, 0.0), 0.7)]
    together = Flats(tuple(zip(*((*flat.normal, flat.offset) for flat in flats), strict=True)))
    for points in (torch.randn(50, 3), torch.randn(3, 50).T, torch.randn(4, 5, 3).double()):
        for own, joined in zip(flats, together.behind(points), strict=True):
            assert torch.equal(own.behind(points), joined)
