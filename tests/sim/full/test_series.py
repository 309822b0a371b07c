"""Series of the set: the same from the same seed, truly labelled, with nothing and held bodies."""

from dataclasses import replace

import numpy as np
import pytest

from cltp.data.contact import Contact
from cltp.tactile.measure import cut_sides
from cltp.tactile.sensors import sensor_named
from cltp.tactile.states import CUT_MM, Shape, area_word, depth_word, position_word
from sim.full.held_scene import FORCE_N
from sim.full.objects import Origin
from sim.full.requests import LOADS, full_request
from sim.full.series import make_series, num_series, press_on_gel
from sim.gel.layer import gel_of


def first(origin):
    return next(n for n in range(5000) if full_request(0, n).choice.origin is origin)


@pytest.fixture(scope="module")
def contacts():
    return [contact for number in range(24) for contact in make_series(0, number)]


@pytest.mark.parametrize("origin", Origin)
def test_a_series_is_the_same_whenever_it_is_made(origin):
    number = first(origin)
    once, again = make_series(0, number), make_series(0, number)
    assert len(once) == LOADS
    for one, other in zip(once, again, strict=True):
        np.testing.assert_array_equal(one.height_mm, other.height_mm)
        assert (one.state, one.unsure, one.object) == (other.state, other.unsure, other.object)


def test_another_seed_gives_other_contacts():
    number = first(Origin.PARAMETRIC)
    assert not np.array_equal(
        make_series(0, number)[1].height_mm, make_series(1, number)[1].height_mm
    )


def test_words_are_those_of_the_numbers(contacts):
    for contact in contacts:
        state = contact.state
        if not state.in_contact:
            continue
        assert state.depth is depth_word(state.depth_mm)
        assert state.area is area_word(state.area_fraction)
        assert state.position is position_word(state.x_mm, state.y_mm, contact.sensor)
        assert state.depth_mm == pytest.approx(float(contact.height_mm.max()), abs=1e-6)
        assert state.shape is not None
        assert state.texture is not None


def test_the_second_contact_of_a_series_is_the_harder_one(contacts):
    for light, hard in zip(contacts[::2], contacts[1::2], strict=True):
        assert light.series == hard.series
        assert light.state.force_n <= hard.state.force_n


def test_most_labels_are_certain_and_every_one_says_whether_it_is(contacts):
    assert all(isinstance(contact.unsure, frozenset) for contact in contacts)
    unsure = [contact for contact in contacts if "shape" in contact.unsure]
    assert len(unsure) < 0.3 * len(contacts)


def test_nothing_is_an_untouched_frame_without_words():
    contact: Contact = make_series(0, first(Origin.NOTHING))[0]
    assert not contact.height_mm.any()
    assert not contact.state.in_contact
    assert contact.state.shape is None


def test_a_held_body_is_pressed_with_the_forces_of_a_grasp():
    number = first(Origin.HELD)
    limits = FORCE_N[full_request(0, number).choice.kind]
    for contact in make_series(0, number):
        assert limits.low <= contact.state.force_n * 1.001
        assert contact.state.force_n <= limits.high * 1.001
        assert contact.state.shape in (Shape.SPHERE, Shape.ELLIPSOID, Shape.CYLINDER)


def test_a_cut_contact_names_the_side_that_cuts_it(contacts):
    cut = [contact for contact in contacts if contact.state.cut]
    assert cut
    for contact in cut:
        pitch_mm = contact.sensor.width_mm / contact.height_mm.shape[1]
        # the bumps of a texture stand out of what the side cuts
        near = contact.height_mm > 0.15 * contact.height_mm.max()
        assert contact.state.cut & cut_sides(near, least=round(CUT_MM / pitch_mm / 2))


def test_an_odd_number_of_contacts_needs_one_series_more():
    assert (num_series(4), num_series(5)) == (2, 3)


def test_another_gel_is_pressed_by_the_same_objects_as_deep_or_hard():
    mini, nominal = sensor_named("gelsight_mini"), gel_of("gelsight_mini")
    softer = replace(nominal, young_mpa=0.6 * nominal.young_mpa)
    pairs = list(
        zip(*(press_on_gel(gel, mini, seed=1, num=25) for gel in (nominal, softer)), strict=True)
    )
    assert len(pairs) == 25
    for firm, soft in pairs:
        assert firm.sensor == soft.sensor == mini
        assert (firm.gel.young_mpa, soft.gel.young_mpa) == (nominal.young_mpa, softer.young_mpa)
        assert (firm.object, firm.series) == (soft.object, soft.series)
        assert firm.state.in_contact
        if firm.object.startswith("held"):
            assert soft.state.force_n == pytest.approx(firm.state.force_n, rel=1e-3)
            assert soft.state.depth_mm > firm.state.depth_mm
        else:
            assert soft.approach_mm == firm.approach_mm
            assert soft.state.force_n < firm.state.force_n
    assert any(firm.object.startswith("held") for firm, _ in pairs)
    assert len({firm.object for firm, _ in pairs}) > 10
