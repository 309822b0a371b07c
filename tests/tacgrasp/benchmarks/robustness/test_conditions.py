"""Conditions of the robustness benchmark: one thing differs, and the rest is paired."""

import dataclasses

import numpy as np
import pytest

from cltp.data.dataset import ContactDataset
from cltp.tactile.noise_levels import NoiseLevels
from cltp.tactile.states import Position
from sim.gel.layer import gel_of
from tacgrasp.benchmarks.robustness.conditions import NOMINAL, NUISANCES, SENSOR, Condition
from tacgrasp.benchmarks.robustness.contacts import ContactSource, force_factor, sample
from tests.fakes.tiny_weights import make_data


@pytest.fixture(scope="module")
def source(tmp_path_factory) -> ContactSource:
    folder = tmp_path_factory.mktemp("robustness")
    return ContactSource(
        data=make_data(folder / "data", 24),
        pressed=folder / "pressed",
        count=20,
        weights=folder,
    )


def fields_off_nominal(condition: Condition) -> set[str]:
    off = {
        field.name
        for field in dataclasses.fields(NoiseLevels)
        if getattr(condition.levels, field.name) != getattr(NOMINAL.levels, field.name)
    }
    others = ("turn_deg", "young_factor", "gel_mm")
    return off | {name for name in others if getattr(condition, name) != getattr(NOMINAL, name)}


def test_every_nuisance_has_one_nominal_level_and_differs_from_it_in_one_thing():
    for name, levels in NUISANCES.items():
        off = [fields_off_nominal(condition.in_the_loop) for condition in levels.values()]
        assert off.count(set()) == 1, name
        assert len(set().union(*off)) == 1, name


def test_gels_are_those_of_the_sensor_with_one_property_changed():
    nominal = gel_of(SENSOR)
    soft = NUISANCES["gel_young"][0.6].gel
    assert soft == dataclasses.replace(nominal, young_mpa=0.6 * nominal.young_mpa)
    assert NUISANCES["gel_mm"][4.2].gel == dataclasses.replace(nominal, thickness_mm=4.2)
    assert NOMINAL.gel is None


def test_the_force_calibration_of_a_gel_gives_its_stiffness():
    assert force_factor(NOMINAL) == 1.0
    assert force_factor(Condition(young_factor=0.6)) == pytest.approx(0.6, rel=0.1)
    assert force_factor(Condition(young_factor=1.7)) == pytest.approx(1.7, rel=0.1)


def test_contacts_have_the_same_draws_under_every_condition(source):
    once, twice, thrice = (
        source.sampled("drift", Condition(levels=NoiseLevels(drift=level))).batch
        for level in (1.0, 2.0, 3.0)
    )
    np.testing.assert_array_equal(once.index, thrice.index)
    np.testing.assert_array_equal(once.points[..., :2], thrice.points[..., :2])
    first, second = (
        (more.points - less.points)[..., 2] for more, less in ((twice, once), (thrice, twice))
    )
    for one, two in zip(first, second, strict=True):  # but for the lost zero, a constant
        np.testing.assert_allclose(one - one.mean(), two - two.mean(), atol=1e-4)


def test_blocks_of_contacts_are_parts_of_the_whole(source):
    whole = source.sampled("fine", NOMINAL)
    parts = [source.sampled("fine", NOMINAL, slice(first, first + 8)) for first in (0, 8, 16)]
    points = np.concatenate([part.batch.points for part in parts])
    np.testing.assert_array_equal(points, whole.batch.points)
    assert len(whole.exact) == len(whole.batch.states) == 20


def test_a_turned_sensor_sees_the_contact_and_its_labels_turned(source):
    before = source.sampled("rotation", Condition(turn_deg=0)).batch
    after = source.sampled("rotation", Condition(turn_deg=90)).batch
    np.testing.assert_array_equal(before.index, after.index)
    assert len(before.index) > 0
    pairs = list(zip(before.states, after.states, strict=True))
    whole = [(one, two) for one, two in pairs if one.area_fraction == two.area_fraction]
    assert whole
    for one, two in whole:
        assert (two.x_mm, two.y_mm) == pytest.approx((-one.y_mm, one.x_mm), abs=1e-6)
        assert (two.shape, two.texture) == (one.shape, one.texture)
    assert Position.CENTERED in {two.position for _, two in whole}
    none = sample(ContactDataset(source.data), [], Condition(turn_deg=90))
    assert none.batch.points.shape == (0, 1024, 3)


def test_pressed_contacts_of_another_gel_are_the_same_objects(source):
    conditions = [("gel_young", condition) for condition in NUISANCES["gel_young"].values()]
    source.press(conditions)
    soft, nominal, firm = (source.sampled(*job) for job in conditions)
    shapes = [[state.shape for state in each.batch.states] for each in (soft, nominal, firm)]
    assert shapes[0] == shapes[1] == shapes[2]
    depths, forces = (
        np.array([[getattr(state, name) for state in each.batch.states] for each in (soft, firm)])
        for name in ("depth_mm", "force_n")
    )
    bodies = np.abs(depths[0] - depths[1]) > 0.01  # pressed by force, not by depth
    assert (depths[0][bodies] > depths[1][bodies]).all()
    assert (forces[0][~bodies] < forces[1][~bodies]).all()
