"""Moving through an episode again keeps to the contract that was recorded."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from primitives import RobotError
from primitives.contract import Contract, default_limit_n
from sim.grasp.rig import SimRig, build
from tacgrasp.__main__ import main
from tacgrasp.config.layers import load
from tacgrasp.config.schema import RunConfig
from tacgrasp.config.terms import contract_of
from tacgrasp.episodes import Episode, read_episode
from tacgrasp.playback.replay import contract_in, repeat, times_from_s
from tacgrasp.policy_factory import make_policy
from tacgrasp.run import run_recorded
from tacgrasp.runtime.outcome import EndReason
from tests.fakes.contracts import STRAWBERRY, contract

SEED = 3
HARD = contract(3.6, 7.2, 9.0, soft=STRAWBERRY)


def rig_for(settings: RunConfig) -> SimRig:
    return build(settings.object, SEED, start_offset_mm=(0.0, 0.0), noise_level=0.0)


def recorded(task: str, folder: Path, held: Contract | None = None) -> tuple[Episode, RunConfig]:
    """One simulated episode of a task."""
    changes = {"policy": "rules", "seed": SEED, "record": folder}
    settings = load(task)[0].model_copy(update=changes)
    held = held or contract_of(settings)
    _, path = run_recorded(rig_for(settings), make_policy("rules", settings), settings, held)
    return read_episode(path), settings


def test_an_episode_of_a_hard_thing_is_repeated_with_its_forces(tmp_path: Path) -> None:
    episode, settings = recorded("egg", tmp_path)
    then = [s.executed.force_n for s in episode.steps if s.executed is not None]
    now = [r.executed.force_n for r in repeat(episode, rig_for(settings), settings)]
    assert now == pytest.approx(then)


def test_after_an_objection_the_softer_contract_bounds_the_repetition_too(tmp_path: Path) -> None:
    episode, settings = recorded("strawberry", tmp_path, HARD)
    assert contract_in(episode, settings) == HARD
    assert any(step.contract is not None for step in episode.steps)
    steps = [
        replace(step, executed=replace(step.executed, force_n=20.0))
        if step.executed is not None
        else step
        for step in episode.steps
    ]
    rig = rig_for(settings)
    most_n = STRAWBERRY.limit_n / settings.gripper.max_force_gain
    forces_n = [r.executed.force_n for r in repeat(replace(episode, steps=steps), rig, settings)]
    assert max(forces_n) == pytest.approx(most_n)
    assert rig.truth().peak_force_n <= STRAWBERRY.limit_n


def test_an_episode_with_another_contract_than_the_task_keeps_its_own(tmp_path: Path) -> None:
    light = contract(0.5, 0.8, 1.0)
    episode, settings = recorded("strawberry", tmp_path, light)
    assert light.limit_n == pytest.approx(default_limit_n(light.terms.force_n))
    assert contract_in(episode, settings) == light
    rig = rig_for(settings)
    list(repeat(episode, rig, settings))
    assert rig.truth().peak_force_n <= light.limit_n


def unverified(episode: Episode) -> Episode:
    assert episode.end is not None
    return replace(episode, end=replace(episode.end, reason=EndReason.UNVERIFIED))


def test_what_a_failed_episode_had_lifted_is_lowered_before_it_is_let_go(tmp_path: Path) -> None:
    episode, settings = recorded("strawberry", tmp_path)
    settings = settings.model_copy(update={"on_failure": "release"})
    rig = rig_for(settings)
    list(repeat(unverified(episode), rig, settings))
    lifted_m, stood_m = (episode.steps[k].tcp_pose.position_m[2] for k in (-1, -2))
    assert rig.arm.pose().position_m[2] == pytest.approx(stood_m, abs=1e-4)
    assert lifted_m > stood_m + 0.01
    assert not rig.gripper.state().closed


def test_what_hangs_in_the_air_after_an_error_is_held(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    episode, settings = recorded("strawberry", tmp_path)
    settings = settings.model_copy(update={"on_failure": "release"})
    rig, moves = rig_for(settings), type(rig_for(settings).arm).move_to
    lifted = episode.steps[-1].tcp_pose

    def fails_up_there(arm, pose, **how):  # type: ignore[no-untyped-def]
        moves(arm, pose, **how)
        if pose.position_m[2] >= lifted.position_m[2]:
            raise RobotError("protective stop")

    monkeypatch.setattr(type(rig.arm), "move_to", fails_up_there)
    with pytest.raises(RobotError, match="protective stop"):
        list(repeat(unverified(episode), rig, settings))
    assert rig.gripper.state().closed


def test_times_count_from_the_start_where_the_first_step_is_lost(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    whole, _ = recorded("strawberry", tmp_path)
    start_s = whole.header.stamp.monotonic_s
    assert times_from_s(whole) == whole.steps[0].stamp.monotonic_s > start_s
    damaged = replace(whole, steps=whole.steps[1:])
    assert times_from_s(damaged) == start_s
    monkeypatch.setattr("tacgrasp.episodes.read_episode", lambda _: damaged)
    assert main(["replay", "damaged.mcap"]) == 0
    printed = capsys.readouterr().out
    assert "its first step is missing" in printed
    assert f"{whole.steps[1].stamp.monotonic_s - start_s:6.1f} s  " in printed
