"""Bodies in a gripper: their curvature, how they lie, and how hard they may be pressed."""

import dataclasses

import numpy as np
import pytest

from sim.full import held_scene, series
from sim.full.held_scene import TURNED_FRACTION, curvature_ratio
from sim.full.objects import Origin
from sim.full.requests import full_request
from sim.full.series import DEEPEST_BY_FORCE_MM, make_series
from sim.grasp.bodies import draw_body


def held(kind, seed):
    request = full_request(seed, 0)
    choice = dataclasses.replace(request.choice, origin=Origin.HELD, kind=kind)
    return dataclasses.replace(request, choice=choice)


def test_curvature_of_a_body_is_found_through_its_achenes():
    # A peg is straight along its axis; an egg 1.22-1.38 times as long as wide has a ratio of
    # curvatures of about that squared.
    assert curvature_ratio(draw_body("peg", np.random.default_rng(0))) > 20
    egg = curvature_ratio(draw_body("egg", np.random.default_rng(0)))
    assert 1.3 < egg < 2.1
    for seed in range(3):
        berry = draw_body("strawberry", np.random.default_rng(seed))
        assert 1.0 <= curvature_ratio(berry) < 3.0


def test_some_bodies_lie_as_a_sensor_mounted_a_quarter_turn_meets_them(monkeypatch):
    lying = []
    monkeypatch.setattr(held_scene, "turned", lambda body: lying.append(body) or body)
    for number in range(80):
        held_scene.held_scene(held("egg", number), np.random.default_rng(number))
    assert len(lying) == pytest.approx(80 * TURNED_FRACTION, abs=12)


def test_a_deeper_press_is_made_lighter_until_the_gel_can_bear_it(monkeypatch):
    def harder(request, rng):
        scene = held_scene.held_scene(request, rng)
        return dataclasses.replace(scene, loads=tuple(30 * load for load in scene.loads))

    monkeypatch.setattr(series, "held_scene", harder)
    monkeypatch.setattr(series, "full_request", lambda seed, number: held("peg", seed))
    depths = [contact.state.depth_mm for seed in range(4) for contact in make_series(seed, 0)]
    assert 0.8 * DEEPEST_BY_FORCE_MM < max(depths) < 1.05 * DEEPEST_BY_FORCE_MM
