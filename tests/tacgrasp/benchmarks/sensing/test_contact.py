"""The benchmark of the contact test: counts, the least force, and the ideal detector."""

import pytest

from cltp.tactile.contact.contact_test import UntouchedGel
from sim.grasp.rig import build
from tacgrasp.benchmarks.sensing import contact


def test_false_alarms_are_counted_by_closing_and_by_noise_level():
    figures = contact.false_alarms([0.5, 1.0, 0.7, 0.6, 0.9, 0.8], 0)
    assert figures["false_per_closing"] == pytest.approx(1 / 6)
    assert figures["false_per_closing_by_noise_level"] == {"1": 0.0, "2": 0.5, "3": 0.0}


def test_air_is_below_a_contact_and_depends_on_the_seed_alone():
    assert contact.largest_ratio(1) == contact.largest_ratio(1) < 1
    assert contact.largest_ratio(1) != contact.largest_ratio(4)


def test_the_least_force_is_the_lightest_from_which_on_nothing_is_missed():
    count = len(contact.FORCES_N)
    assert contact.least_force_n([0.0] * count) == contact.FORCES_N[0]
    assert contact.least_force_n([0.0, 0.5, *[0.01] * (count - 2)]) == contact.FORCES_N[2]
    assert contact.least_force_n([0.0] * (count - 1) + [0.02]) is None


def test_firm_contacts_are_felt_and_the_lightest_is_missed():
    (sample, _) = contact.grasp_samples("strawberry", 3)
    assert sample.missed[0]
    assert not sample.missed[-1]
    assert sample.ideal_missed[-1] < 1e-6
    assert all(a >= b for a, b in zip(sample.ideal_missed, sample.ideal_missed[1:], strict=False))


def test_an_ideal_detector_misses_all_but_its_false_alarms_without_signal():
    rig = build("strawberry", 0)
    patch = rig.grasp.fingers.press((0.0, 0.0), 1e-5)
    assert contact.ideal_missed(rig, patch) == pytest.approx(1 - 0.005 / 13, abs=2e-4)


def test_a_test_that_always_feels_fails_the_benchmark(monkeypatch):
    evidence = type("Evidence", (), {"ratio": 2.0, "in_contact": True})
    monkeypatch.setattr(UntouchedGel, "test", lambda *_: evidence)
    ratios = [contact.largest_ratio(seed) for seed in range(3)]
    assert contact.false_alarms(ratios, 0)["false_per_closing"] > contact.MAX_FALSE_PER_CLOSING
