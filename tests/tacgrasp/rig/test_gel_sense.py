"""The interval of a felt force: the reading's, and the spread of the unit's scale."""

import math
from dataclasses import replace

import numpy as np
import pytest

from cltp.errors import TouchError
from cltp.tactile.contact import matched_filter
from cltp.tactile.force_scale import UNCALIBRATED, ForceScale
from cltp.tactile.measure import contact_state
from sim.gel.layer import gel_of
from sim.grasp.rig import build
from tacgrasp.rig.gel_sense import FELT_SPREAD, SPREADS, GelSense, prepare


class Scaled:
    """A sensor whose clouds carry another scale."""

    def __init__(self, sensor, scale):
        self._sensor, self._scale, self.spec = sensor, scale, sensor.spec

    def read(self, frames=1):
        return replace(self._sensor.read(frames), force_scale=self._scale)

    def take_reference(self):
        self._sensor.take_reference()


def felt(scale):
    rig = build("egg", 3, start_offset_mm=(0.0, 0.0))
    sensor = Scaled(rig.sensor, scale)
    sense = GelSense(sensor)
    sense.take_reference()
    rig.grasp.close(2.0)
    cloud = sensor.read()
    return contact_state(cloud).force_n, sense.felt_force(cloud)


@pytest.mark.parametrize("spread", [0.0, 0.05, UNCALIBRATED.spread])
def test_the_interval_of_a_clear_force_holds_the_reading_s_and_the_unit_s_spread(spread):
    read_n, interval = felt(ForceScale(factor=1.0, spread=spread, source="unit a"))
    half = math.hypot(FELT_SPREAD, SPREADS * spread)
    assert interval.value == pytest.approx(read_n)
    assert math.log(interval.high / interval.value) == pytest.approx(half)
    assert math.log(interval.value / interval.low) == pytest.approx(half)


def test_an_uncalibrated_force_has_nearly_twice_the_interval_of_a_calibrated_one():
    half = [
        math.log(felt(scale)[1].high / felt(scale)[1].value)
        for scale in (UNCALIBRATED, ForceScale(factor=1.0, spread=0.05, source="unit a"))
    ]
    assert half[0] / half[1] == pytest.approx(1.83, abs=0.02)


@pytest.mark.parametrize("factor", [0.6, 1.7])
def test_the_felt_force_is_in_newtons_of_the_unit(factor):
    nominal_n = felt(ForceScale(factor=1.0, spread=0.05, source="unit a"))[1].value
    assert felt(ForceScale(factor=factor, spread=0.05, source="unit a"))[1].value == pytest.approx(
        factor * nominal_n
    )


def first_felt_n(seed, *, steps):
    """Force at which a strawberry is felt first where it rises to that in so many steps [N]."""
    stiff = gel_of("gelsight_mini")
    stiff = replace(stiff, young_mpa=1.7 * stiff.young_mpa)
    for peak_n in 0.1 * 1.3 ** np.arange(10):
        rig = build("strawberry", seed, gel=stiff, start_offset_mm=(0.0, 0.0))
        sense = GelSense(rig.sensor)
        sense.take_reference()
        for force_n in np.geomspace(0.02, peak_n, steps) if steps > 1 else [peak_n]:
            rig.grasp.close(force_n)
            is_felt = sense.read_contact()
        if is_felt:
            return peak_n
    return math.inf


def test_a_contact_that_grows_slowly_while_fingers_close_is_felt_as_early_as_at_once():
    for seed in (1, 4):
        assert first_felt_n(seed, steps=12) <= 1.31 * first_felt_n(seed, steps=1)


@pytest.mark.parametrize("name", ["gelsight_mini", "gelsight_r15", "gelstereo", "taxels"])
def test_the_felt_force_is_the_true_one_whatever_the_sensors_gel(name):
    rig = build("egg", 3, sensor_name=name, start_offset_mm=(0.0, 0.0), noise_level=0)
    sense = GelSense(rig.sensor)
    sense.take_reference()
    rig.grasp.close(2.0)
    assert sense.felt_force(sense.read()).value == pytest.approx(2.0, rel=0.2)


def test_a_pad_that_is_pressed_all_over_is_no_reading_instead_of_no_contact():
    rig = build("egg", 3)
    sense = GelSense(rig.sensor)
    sense.take_reference()
    frame_mm = rig.sensor.frame_mm
    rig.sensor.frame_mm = lambda *given: frame_mm(*given) + np.float32(0.02)  # as much as drift
    assert sense.in_contact(sense.read()) is False
    rig.sensor.frame_mm = lambda *given: frame_mm(*given) + np.float32(0.5)
    for read in (sense.read, sense.read_contact):
        with pytest.raises(TouchError, match=r"the whole pad is raised by 0\.50 mm"):
            read()


def test_what_is_prepared_is_not_computed_again_under_a_watchdog():
    sensor = build("egg", 5).sensor
    matched_filter._modes.cache_clear()
    prepare(sensor)
    prepared = matched_filter._modes.cache_info().misses
    sense = GelSense(sensor)
    sense.take_reference()
    sense.in_contact(sense.read())
    assert matched_filter._modes.cache_info().misses == prepared == 3
