"""The benchmark of limits: what counts as exceeded, what is drawn, and that it can fail."""

import math
from dataclasses import replace

import pytest

from cltp.tactile.sensors import sensor_named
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks.limits import episode, run
from tacgrasp.benchmarks.limits.draw import CORRUPTIONS, Fault, FaultKind, draw
from tacgrasp.benchmarks.limits.episode import Subject, limit_of, run_seed
from tacgrasp.benchmarks.limits.watch import MAX_CALLS, Bounds, ForceWatch, Hung, grace_s
from tacgrasp.benchmarks.settings import LimitsSettings
from tests.fakes.contracts import contract

WORDS = "Pick the strawberry."


def watch(*samples, grace=0.045):
    each = ForceWatch(1.0, grace)
    for now_s, force_n, is_change in samples:
        each.sample(now_s, force_n, is_change=is_change)
    return each


def test_a_command_above_the_limit_counts_at_once():
    assert not watch((1.0, 1.0, False)).exceeded
    assert "a command made 1.010 N" in watch((1.0, 1.01, False)).exceeded


def test_a_change_without_a_command_counts_once_it_has_lasted_too_long():
    kept = watch((1.0, 1.5, True), (1.044, 0.9, False))
    assert not kept.exceeded
    assert kept.longest_s == pytest.approx(0.044)
    assert "for 60 ms" in watch((1.0, 1.5, True), (1.06, 0.9, False)).exceeded


def test_a_command_soon_after_a_change_is_timed_from_the_change():
    assert not watch((1.0, 0.9, True), (1.03, 1.2, False), (1.04, 0.9, False)).exceeded
    assert watch((1.0, 0.9, True), (1.03, 1.2, False), (1.07, 0.9, False)).exceeded
    assert watch((1.0, 0.9, True), (1.06, 1.2, False)).exceeded


def test_a_grip_that_is_kept_above_the_limit_at_the_end_counts():
    held, released = watch((1.0, 1.5, True)), watch((1.0, 1.5, True))
    held.finish(1.01, is_kept=True)
    released.finish(1.01, is_kept=False)
    assert held.exceeded
    assert not released.exceeded


def test_taxels_are_given_45_ms_and_a_camera_two_periods_and_25():
    assert grace_s(sensor_named("taxels")) == 0.045
    assert grace_s(sensor_named("gelsight_mini_markers")) == pytest.approx(0.105)


def test_an_episode_that_does_not_end_is_ended():
    bounds = Bounds(180.0)
    for _ in range(MAX_CALLS):
        bounds.check(0.0)
    with pytest.raises(Hung, match="readings"):
        bounds.check(0.0)
    with pytest.raises(Hung, match="301 s"):
        Bounds(180.0).check(301.0, counts=False)


def test_each_kind_is_drawn_in_turn_and_the_same_for_the_same_seed():
    drawn = [draw(seed, 1.0, WORDS) for seed in range(1_000_000, 1_000_200)]
    assert drawn == [draw(seed, 1.0, WORDS) for seed in range(1_000_000, 1_000_200)]
    assert {each.kind for each in drawn[:10]} == set(FaultKind)
    assert {each.how for each in drawn if each.kind is FaultKind.CORRUPT} <= set(CORRUPTIONS)
    worded = [each for each in drawn if "with no more than" in each.words]
    assert 0.3 < len(worded) / len(drawn) < 0.6


@pytest.mark.parametrize(
    ("fault", "expected"),
    [
        (Fault(kind=FaultKind.STALL, size=0.3), True),
        (Fault(kind=FaultKind.STALL, size=0.6), False),
        (Fault(kind=FaultKind.DRIFT, size=-0.02), False),
        (Fault(kind=FaultKind.LATE, size=30.0, count=3), True),
        (Fault(kind=FaultKind.CORRUPT, count=3), False),
        (Fault(kind=FaultKind.GREEDY), False),
        (Fault(kind=FaultKind.HOSTILE), True),
        (Fault(kind=FaultKind.JERK, size=9.9), True),
        (Fault(kind=FaultKind.JERK, size=9.9, angle=math.pi / 2), False),
    ],
)
def test_a_fault_is_survivable_up_to_its_size(fault, expected):
    assert fault.is_survivable is expected


def test_words_raise_the_limit_no_further_than_words_may():
    task = contract(0.5, 1.0, 1.25)
    assert limit_of(contract(0.5, 1.0, 2.0), task) == 2.0
    assert limit_of(contract(0.5, 1.0, 50.0), task) == 3 * 1.25


@pytest.fixture
def subject(tmp_path):
    return Subject(
        task="strawberry", sensor="gelsight_mini", policy="rules", weights=None, keep=tmp_path / "k"
    )


def test_a_policy_that_asks_for_more_for_ever_is_held_and_its_rival_is_not(subject):
    result = run_seed(subject, 1_000_046)
    assert result.kind == FaultKind.GREEDY
    assert (result.exceeded, result.hung, result.broke) == ("", "", "")
    assert result.peak_n <= result.limit_n < result.rival_peak_n
    assert "a command made" in result.rival_exceeded
    assert not result.failed
    assert not result.path


def test_without_the_guard_the_benchmark_fails_and_keeps_the_episode(subject, monkeypatch):
    monkeypatch.setattr("primitives.force_guard.GuardedGripper.most_n", 100.0)
    result = run_seed(subject, 1_000_046)
    assert result.failed
    assert "a command made" in result.exceeded
    assert subject.keep.joinpath(result.path.rpartition("/")[2]).stat().st_size > 0


def test_an_unforeseen_error_is_a_finding(subject, monkeypatch):
    monkeypatch.setattr(episode.FaultyPolicy, "decide", lambda *_: 1 / 0)
    result = run_seed(subject, 1_000_006)
    assert "ZeroDivisionError" in result.broke
    assert result.failed


def test_figures_that_exceed_hang_or_verify_too_little_do_not_keep_the_limits(subject):
    good = run_seed(subject, 1_000_000)
    assert good.verified
    assert good.survivable
    assert run.keeps_limits(run.summary([good]))
    for bad in (
        replace(good, exceeded="by a command"),
        replace(good, hung="300 s"),
        replace(good, broke="ValueError"),
        replace(good, verified=False),
    ):
        assert not run.keeps_limits(run.summary([bad]))
        assert bad.failed


def test_a_policy_that_does_not_feel_is_refused():
    with pytest.raises(UsageError, match="out of rules, llm"):
        run.run(LimitsSettings(policy="fixed_force"))
