"""The benchmark of missed grasps: what it calls missed, a false reset and added force."""

import pytest

from sim.grasp.rig import build
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.loop import missed
from tacgrasp.benchmarks.settings import MissedSettings
from tacgrasp.rig.gel_sense import GelSense

SEED = 1_000_003


def test_no_berry_is_reached_in_a_missed_episode():
    for seed in range(1_000_000, 1_000_010):
        offset_mm = missed.missed_offset_mm(seed)
        rig = build("strawberry", seed, start_offset_mm=offset_mm)
        assert not rig.grasp.fingers.reaches(offset_mm)


def test_a_missed_berry_is_reset_once_and_lost_and_a_touched_one_is_not_reset():
    (result,) = missed.run_seed(None, ["rules"], SEED)
    assert (result.reset_first, result.contact_lost) == (True, True)
    assert (result.force_added, result.false_reset) == (False, False)


def test_a_test_that_never_feels_is_a_false_reset(monkeypatch):
    monkeypatch.setattr(GelSense, "in_contact", lambda *_, **__: False)
    (result,) = missed.run_seed(None, ["rules"], SEED)
    assert result.contact_lost
    assert result.false_reset


def test_a_test_that_always_feels_adds_force_or_loses_no_contact(monkeypatch):
    monkeypatch.setattr(GelSense, "in_contact", lambda *_, **__: True)
    (result,) = missed.run_seed(None, ["rules"], SEED)
    assert not result.contact_lost
    assert not result.false_reset
    assert not missed.keeps_targets(missed.summary([result]))


def test_rates_beside_the_targets_are_off_them():
    kept = {"reset_first_rate": 0.99, "contact_lost_rate": 1.0}
    kept |= {"force_added_rate": 0.0, "false_reset_rate": 0.01}
    assert missed.keeps_targets(kept)
    for name, value in (("reset_first_rate", 0.98), ("force_added_rate", 0.005)):
        assert not missed.keeps_targets(kept | {name: value})


def test_a_policy_that_does_not_feel_is_refused():
    with pytest.raises(UsageError, match="policies out of llm, rules, got"):
        missed.run(MissedSettings(policies="fixed_force"))
