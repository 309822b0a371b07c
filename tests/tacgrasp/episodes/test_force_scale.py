"""The force scale of a unit in episodes: recorded, restored, replayed, and shown where missing."""

import io
import json
from dataclasses import replace

import pytest
from rich.console import Console

from cltp.tactile.force_scale import UNCALIBRATED, ForceScale
from cltp.tactile.measure import contact_state
from policies.rules import RulesPolicy
from primitives.sense import Interval
from sim.grasp.rig import build
from tacgrasp.config.layers import load
from tacgrasp.config.terms import contract_of
from tacgrasp.console import StepPrinter
from tacgrasp.episodes import read_episode
from tacgrasp.episodes.codec import from_json, to_json
from tacgrasp.episodes.plot import draw_episode, force_label
from tacgrasp.episodes.record import StepState
from tacgrasp.playback.describe import describe
from tacgrasp.playback.replay import differences
from tacgrasp.run import run_recorded
from tacgrasp.runtime.events import EventFile
from tests.fakes.episode_samples import record, step_record

SCALE = ForceScale(factor=1.3, spread=0.04, source="mini-1, 2026-03-01")


def scaled_step(scale):
    step = step_record(0)
    felt = Interval(value=1.0, low=0.7, high=1.4)
    return replace(step, cloud=replace(step.cloud, force_scale=scale), felt_force_n=felt)


def state(step):
    return StepState(
        **step.shared(),
        cloud_stamp=step.cloud.stamp,
        tick_ms=step.step_ms,
        force_scale=step.cloud.force_scale,
    )


@pytest.mark.parametrize("scale", [SCALE, UNCALIBRATED])
def test_an_episode_keeps_the_scale_of_every_cloud(tmp_path, scale):
    record(tmp_path / "one.mcap", [scaled_step(scale)])
    (step,) = read_episode(tmp_path / "one.mcap").steps
    assert step.cloud.force_scale == scale


def test_a_step_of_an_older_version_reads_as_uncalibrated():
    old = to_json(state(scaled_step(SCALE)))
    del old["force_scale"]
    assert from_json(StepState, old).force_scale == UNCALIBRATED


def test_the_record_of_an_uncalibrated_unit_says_so_in_words():
    assert '"source": "uncalibrated"' in json.dumps(to_json(state(scaled_step(UNCALIBRATED))))


def printed(step):
    console = Console(file=io.StringIO(), width=400)
    StepPrinter(console)(step)
    return console.file.getvalue()


def test_the_lines_of_a_step_mark_an_uncalibrated_force():
    assert "felt 1.00 N (0.70-1.40, uncalibrated)" in printed(scaled_step(UNCALIBRATED))
    assert "uncalibrated" not in printed(scaled_step(SCALE))


def test_describe_marks_an_uncalibrated_force():
    def force_line(scale):
        return next(x for x in describe(scaled_step(scale).cloud) if x.startswith("force"))

    assert "uncalibrated, -26 to +35 %)" in force_line(UNCALIBRATED)
    assert force_line(SCALE).endswith(", calibrated)")


def test_the_plot_s_axis_of_forces_marks_an_uncalibrated_one(tmp_path):
    labels = {}
    for scale in (UNCALIBRATED, SCALE):
        path = tmp_path / f"{scale.factor}.mcap"
        record(path, [scaled_step(scale)])
        episode = read_episode(path)
        labels[scale] = force_label(episode)
        draw_episode(episode, path.stem)
    assert "uncalibrated, -26 to +35 %" in labels[UNCALIBRATED]
    assert "uncalibrated" not in labels[SCALE]


def test_every_event_of_a_step_has_the_scale(tmp_path):
    with EventFile(tmp_path / "events.json") as events:
        events.step(scaled_step(UNCALIBRATED))
    (event,) = json.loads((tmp_path / "events.json").read_text())
    assert event["force_scale"] == to_json(UNCALIBRATED)


def test_a_recorded_run_is_decided_again_by_the_scale_that_it_had(tmp_path):
    changes = {"policy": "rules", "seed": 3, "record": tmp_path}
    settings = load("strawberry")[0].model_copy(update=changes)
    rig = build(settings.object, 3, noise_level=0.5)
    policy = RulesPolicy(move_step_mm=settings.primitives.move_step_mm)
    contract = contract_of(settings)
    _, path = run_recorded(rig, policy, settings, contract)
    episode = read_episode(path)
    assert {step.cloud.force_scale for step in episode.steps} == {rig.force_calibration.scale}
    assert list(differences(episode, policy, contract)) == []
    stiff = replace(UNCALIBRATED, factor=3.0)
    steps = tuple(
        replace(step, cloud=replace(step.cloud, force_scale=stiff)) for step in episode.steps
    )
    assert list(differences(replace(episode, steps=steps), policy, contract)) != []


def test_a_state_keeps_the_factor_of_its_record(tmp_path):
    record(tmp_path / "one.mcap", [scaled_step(SCALE)])
    (step,) = read_episode(tmp_path / "one.mcap").steps
    nominal = contact_state(replace(step.cloud, force_scale=UNCALIBRATED))
    assert contact_state(step.cloud).force_n == pytest.approx(1.3 * nominal.force_n)
