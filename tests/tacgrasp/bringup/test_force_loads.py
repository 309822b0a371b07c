"""Known loads on a pad: readings, prompts, refusals, and what an interruption leaves."""

import datetime
from dataclasses import replace
from itertools import pairwise

import pytest

from cltp import TouchError
from cltp.sensing.force_calibration import ForceLoad, check_load_values, fit_force
from sim.gel.layer import gel_of
from sim.grasp.devices import SimGripper
from sim.grasp.rig import build
from tacgrasp.base.errors import UsageError
from tacgrasp.bringup.force_loads import (
    LOADS_N,
    PersonLoads,
    UnfinishedLoads,
    WorldLoads,
    check_within,
    default_loads,
    measure_loads,
)

LOADS = (0.5, 1.0, 2.0)
NOMINAL = gel_of("gelsight_mini")


def egg(offset_mm=(0.0, 0.0), **changes):
    return build("egg", 5, start_offset_mm=offset_mm, **changes)


def measured(rig, source=None, loads_n=LOADS, **changes):
    kept = []
    options = {"report": lambda line: None, "keep": lambda r: kept.append(list(r))} | changes
    readings = measure_loads(rig.sensor, source or WorldLoads(rig), loads_n, **options)
    return readings, kept


def test_the_world_puts_each_load_and_the_pad_is_free_afterwards():
    rig = egg()
    readings, kept = measured(rig)
    assert [each.load_n for each in readings] == pytest.approx(LOADS)
    assert [len(each) for each in kept] == [1, 2, 3]
    assert rig.truth().force_n == 0.0


@pytest.mark.parametrize("stiffness", [0.6, 1.7])
def test_the_measured_factor_of_another_gel_is_near_the_one_that_its_rig_carries(stiffness):
    def factor(rig):
        readings, _ = measured(rig)
        day = datetime.date(2026, 3, 1)
        return fit_force(readings, sensor="gelsight_mini", unit="x", date=day).factor

    gel = replace(NOMINAL, young_mpa=stiffness * NOMINAL.young_mpa)
    other, nominal = egg(gel=gel), egg()
    carried = other.force_calibration.factor / nominal.force_calibration.factor
    assert factor(other) / factor(nominal) == pytest.approx(carried, rel=0.15)


def test_readings_are_nominal_newtons_whatever_calibration_the_sensor_has():
    one, other = egg(), egg()
    other.sensor._force_scale = replace(one.force_calibration.scale, factor=3.0)
    for nominal, scaled in zip(measured(one)[0], measured(other)[0], strict=True):
        assert nominal.read_n == pytest.approx(scaled.read_n)


def test_a_person_is_asked_for_each_weight_in_newtons_and_grams():
    rig, asked = egg(), []

    def ask(prompt):
        asked.append(prompt)
        if prompt.startswith("put "):
            rig.grasp.close(float(prompt.split()[1]))
        else:
            rig.grasp.open()

    readings, _ = measured(rig, PersonLoads(ask))
    assert [each.load_n for each in readings] == list(LOADS)
    assert all(b.read_n > 1.5 * a.read_n for a, b in pairwise(readings))
    assert [x.split(" ")[0] for x in asked] == ["take", "put"] * 3 + ["take"]
    assert "put 1 N (102 g, its holder included) on the middle of the pad" in asked[3]


def test_a_load_that_does_not_touch_is_refused_with_what_to_do():
    rig = egg()
    with pytest.raises(TouchError, match=r"nothing touches the gel under 0\.5 N; put the load"):
        measured(rig, PersonLoads(lambda prompt: None))


def test_a_contact_that_the_edge_cuts_is_refused_with_what_to_do():
    with pytest.raises(TouchError, match=r"edge cuts the contact under 2 N \(right\); put"):
        measured(egg((9.5, 0.0)), loads_n=(2.0, 4.0, 8.0))


def test_a_resumed_measurement_takes_the_readings_that_it_has_and_measures_the_others():
    rig, first = egg(), ForceLoad(load_n=0.5, read_n=0.123)
    readings, kept = measured(rig, measured=[first])
    assert readings[0] == first
    assert [each.load_n for each in readings[1:]] == pytest.approx(LOADS[1:])
    assert [len(each) for each in kept] == [2, 3]


@pytest.mark.parametrize("num_grips", [1, 2])
def test_an_interrupted_measurement_leaves_the_pad_free(num_grips, monkeypatch):
    rig, grip, grips = egg(), SimGripper.grip, []

    def interrupted(self, force_n):
        grips.append(grip(self, force_n))
        if len(grips) == num_grips:
            raise KeyboardInterrupt
        return grips[-1]

    monkeypatch.setattr(SimGripper, "grip", interrupted)
    with pytest.raises(KeyboardInterrupt):
        measured(rig)
    assert rig.truth().force_n == 0.0


def test_a_person_who_stops_is_asked_nothing_more():
    asked = []

    def ask(prompt):
        asked.append(prompt)
        if prompt.startswith("put"):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        measured(egg(), PersonLoads(ask))
    assert len(asked) == 2


@pytest.mark.parametrize(
    ("most_n", "expected"),
    [
        (12.0, LOADS_N),
        (5.0, LOADS_N),
        (4.0, (0.5, 1.0, 2.0, 4.0)),
        (2.0, (0.5, 1.0, 2.0)),
        (1.5, (0.5, 1.0, 1.5)),
        (1.2, (0.3, 0.6, 1.2)),
        (0.4, (0.1, 0.2, 0.4)),
    ],
)
def test_default_loads_end_at_a_limit_and_still_make_a_calibration(most_n, expected):
    assert default_loads(most_n) == pytest.approx(expected)
    check_load_values(default_loads(most_n))


def test_loads_are_refused_on_either_side_of_the_limits():
    check_within((0.1, 1, 1.5), 0.1, 1.5, "the limits")
    with pytest.raises(UsageError, match=r"0\.1 to 1\.5 N \(at 0\.05\); give loads within, like"):
        check_within((0.05, 1, 1.5), 0.1, 1.5, "the limits")
    with pytest.raises(
        UsageError, match=r"0\.8 to 1\.5 N \(at 2\); give loads within; nothing mov"
    ):
        check_within((0.8, 1, 2), 0.8, 1.5, "the limits")


def unfinished(folder, **changes):
    values = {"sensor": "gelsight_mini", "unit": "mini-1", "loads_n": LOADS}
    return UnfinishedLoads(out=folder / "force.json", **(values | changes))


READINGS = [ForceLoad(load_n=0.5, read_n=0.4), ForceLoad(load_n=1.0, read_n=0.9)]


def test_kept_readings_are_those_that_are_read_and_are_dropped_at_the_end(tmp_path):
    unfinished(tmp_path).keep(READINGS)
    assert unfinished(tmp_path).read() == READINGS
    unfinished(tmp_path).drop()
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "changes", [{"unit": "mini-2"}, {"sensor": "digit"}, {"loads_n": (0.5, 1.0, 5.0)}]
)
def test_readings_of_another_measurement_are_not_continued(tmp_path, changes):
    unfinished(tmp_path).keep(READINGS)
    with pytest.raises(UsageError, match=r"of another sensor, unit or other loads.*without --res"):
        unfinished(tmp_path, **changes).read()


@pytest.mark.parametrize(
    "text", ["", "[]", "{}", '{"readings": 3}', '{"readings": [{}]}', "[" * 9**5]
)
def test_damaged_readings_are_not_continued(tmp_path, text):
    unfinished(tmp_path).path.write_text(text)
    with pytest.raises(UsageError, match="is damaged; measure anew"):
        unfinished(tmp_path).read()


def test_without_readings_there_is_nothing_to_continue(tmp_path):
    with pytest.raises(UsageError, match="there are no readings in"):
        unfinished(tmp_path).read()


def test_readings_that_can_not_be_kept_are_a_line(tmp_path):
    unfinished(tmp_path).path.mkdir()
    with pytest.raises(UsageError, match=r"readings can't be kept in .*; give --out"):
        unfinished(tmp_path).keep(READINGS)
