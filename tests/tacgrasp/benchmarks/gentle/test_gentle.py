"""The benchmark of fruit: its arms, what a success is, its figures, and going on with them."""

import json
from dataclasses import replace

import numpy as np
import pytest

from policies import Observation
from policies.contract_steps import needed
from policies.needs import NEEDS, SURELY_UNBRUISED, FeltNeed
from primitives.contract import NEUTRAL_LEAN
from primitives.sense import Interval
from sim.grasp.devices import SimGripper
from sim.grasp.fruit import BRUISE_FACTOR
from sim.grasp.rig import build
from tacgrasp.__main__ import main
from tacgrasp.base.errors import UsageError
from tacgrasp.benchmarks import results_file
from tacgrasp.benchmarks.gentle.arms import ARMS, FIRM_WORDS, GENTLE_WORDS, BlankedPolicy
from tacgrasp.benchmarks.gentle.episode import GentleResult, TimedGripper
from tacgrasp.benchmarks.gentle.run import arm_figures, firm_over_gentle
from tacgrasp.benchmarks.loop.strawberry import wilson
from tacgrasp.benchmarks.settings import GentleSettings
from tacgrasp.config.layers import load
from tacgrasp.config.terms import contract_of
from tests.fakes.contracts import wide_contract
from tests.fakes.loop_fakes import touch

KEYS = {
    *("n", "success_rate", "bruised_rate", "dropped_rate", "peak_over_minimum_median"),
    *("commanded_mean_n", "measured_mean_n", "measured_max_n"),
    *("success_interval", "bruised_interval", "dropped_interval"),
}

GOOD = GentleResult(
    seed=1,
    instruction="Pick the fruit up gently.",
    force_n=None,
    reason="success",
    message="",
    declared=True,
    verified_by_touch=True,
    held=True,
    dropped=False,
    bruised=False,
    slip_mm=0.0,
    num_actions=2,
    peak_n=0.45,
    slip_minimum_n=0.3,
    commanded_mean_n=0.4,
    measured_mean_n=0.3,
    measured_max_n=0.5,
    simulated_s=5.0,
    seconds=1.0,
)


def contract_for(instruction: str):
    return contract_of(load("fruit")[0].model_copy(update={"instruction": instruction}))


@pytest.mark.parametrize("words", GENTLE_WORDS)
def test_gentle_wordings_are_read_as_gentle(words):
    assert contract_for(words).lean == 0.25


@pytest.mark.parametrize("words", FIRM_WORDS)
def test_firm_wordings_are_read_as_firm(words):
    assert contract_for(words).lean == 0.5


@pytest.mark.parametrize("size_mm", [22.0, 30.0, 44.0])
@pytest.mark.parametrize("young_mpa", [0.12, 0.18, 0.3])
def test_gently_lies_below_the_usual_target_and_firmly_above_but_not_where_it_may_bruise(
    size_mm, young_mpa
):
    law = NEEDS["fruit"]
    least_n, most_n = (float(each.at(size_mm, young_mpa)) for each in (law.least_n, law.most_n))
    need = FeltNeed(size_mm=size_mm, young_mpa=young_mpa, least_n=least_n, most_n=most_n)
    own = contract_for("Pick the fruit gently, without bruising it.")
    assert own.lean == NEUTRAL_LEAN
    targets = [
        needed(contract, need)
        for contract in (
            contract_for(GENTLE_WORDS[0]),
            own,
            contract_for(FIRM_WORDS[0]),
            contract_for("Hold the fruit very firmly."),
        )
    ]
    middles = [each.middle for each in targets]
    assert middles == sorted(middles)
    assert middles[0] < middles[1] < middles[2]
    assert targets[-1].high <= most_n * (1 + 1e-9)


def test_what_surely_does_not_bruise_is_the_foot_of_what_is_drawn():
    assert BRUISE_FACTOR[0] == SURELY_UNBRUISED


def test_a_success_is_declared_held_unbruised_and_not_dropped():
    assert GOOD.verified
    for change in ({"declared": False}, {"held": False}, {"bruised": True}, {"dropped": True}):
        assert not replace(GOOD, **change).verified
    assert replace(GOOD, verified_by_touch=False).verified  # the truth counts, not touch


def test_the_figures_of_an_arm():
    bruised = replace(GOOD, bruised=True, peak_n=0.9, commanded_mean_n=0.6, measured_mean_n=None)
    figures = arm_figures([GOOD, bruised])
    assert set(figures) == KEYS
    assert figures["n"] == 2
    assert figures["success_rate"] == figures["bruised_rate"] == 0.5
    assert figures["success_interval"] == wilson(1, 2)
    assert figures["peak_over_minimum_median"] == pytest.approx(2.25)  # of 1.5 and 3
    assert figures["commanded_mean_n"] == pytest.approx(0.5)
    assert figures["measured_mean_n"] == pytest.approx(0.3)  # of the one that felt anything


def test_firm_over_gentle_pairs_the_same_fruit():
    gentle = [GOOD, replace(GOOD, seed=2, measured_mean_n=0.1), replace(GOOD, seed=3)]
    firm = [
        replace(GOOD, seed=2, measured_mean_n=0.4),
        replace(GOOD, seed=1, measured_mean_n=0.6),
        replace(GOOD, seed=3, measured_mean_n=None),
    ]
    assert firm_over_gentle(gentle, firm) == pytest.approx(3.0)  # of 4 and 2
    assert firm_over_gentle(gentle, []) is None


def test_a_blanked_policy_is_given_nothing_that_is_felt():
    seen = []

    class Listener:
        name = "listener"

        def start(self):
            pass

        def decide(self, observation, contract):
            seen.append(observation)

    felt = Observation(
        cloud=touch(),
        in_contact=True,
        width_m=0.03,
        commanded_force_n=0.4,
        felt_force_n=Interval(value=0.4, low=0.3, high=0.5),
    )
    BlankedPolicy(Listener()).decide(felt, wide_contract())
    (blank,) = seen
    assert felt.cloud.points_mm[:, 2].max() > 0.1
    assert not blank.cloud.points_mm[:, 2].any()
    assert np.array_equal(blank.cloud.points_mm[:, :2], felt.cloud.points_mm[:, :2])
    assert blank.in_contact is blank.felt_force_n is blank.shear is None
    assert (blank.width_m, blank.commanded_force_n) == (0.03, 0.4)  # of the gripper, not of touch


def test_the_mean_command_is_that_over_time():
    rig = build("fruit", 1_000_000, start_offset_mm=(0.0, 0.0), gripper_force_gain=1.0)
    gripper = TimedGripper(rig.gripper, rig)
    assert isinstance(gripper, SimGripper)
    assert gripper.mean_n is None
    rig.clock.sleep(5.0)  # open: counts for nothing
    gripper.grip(0.2)
    rig.clock.sleep(3.0)
    gripper.adjust(0.6)  # takes 0.03 s
    rig.clock.sleep(0.97)
    assert gripper.mean_n == pytest.approx(0.3)
    gripper.open_by(0.002)
    rig.clock.sleep(2.0)
    assert gripper.closed_s == pytest.approx(4.0)


def test_an_instruction_is_drawn_by_the_seed_and_the_tasks_own_is_kept():
    drawn = {ARMS["firm"].instruction("own", seed) for seed in range(60)}
    assert drawn == set(FIRM_WORDS)
    assert ARMS["llm"].instruction("own", 3) == "own"


def test_sensors_without_shear_and_unknown_arms_are_refused(capsys):
    with pytest.raises(UsageError, match="--sensor must be taxels"):
        GentleSettings(sensor="gelsight_mini")
    assert main(["bench", "gentle", "--arms", "llm,hope"]) == 2
    assert "no arm is called 'hope'" in capsys.readouterr().err


def bench(path, *argv: str) -> dict:
    assert main(["bench", "gentle", "--json", str(path), *argv]) == 0
    return json.loads(path.read_text())


def without_times(report: dict) -> dict:
    def cut(part):
        if isinstance(part, dict):
            return {key: cut(each) for key, each in part.items() if key != "seconds"}
        return [cut(each) for each in part] if isinstance(part, list) else part

    return cut(report)


def in_this_process(console, name, function, seeds):
    return map(function, seeds)


def test_an_arm_that_knows_the_fruit_succeeds_and_its_figures_are_written(tmp_path, monkeypatch):
    monkeypatch.setattr(results_file, "each_result", in_this_process)  # a pool loads for seconds
    report = bench(tmp_path / "a.json", "--arms", "oracle", "--episodes", "1")
    (arm,) = report["arms"].values()
    assert set(arm) == KEYS
    assert (arm["n"], arm["success_rate"]) == (1, 1.0)
    assert report["redrawn_share"] == 0.0
    assert report["firm_over_gentle"] is None
    results = report["results"]
    ((seed, (result,)),) = results["oracle"].items()
    fruit = results["fruit"][seed]
    assert result["slip_minimum_n"] == pytest.approx(fruit["slip_minimum_n"])


@pytest.mark.slow
def test_a_run_that_goes_on_is_the_run_at_once_and_every_arm_has_the_same_fruit(
    tmp_path, monkeypatch
):
    monkeypatch.setattr(results_file, "each_result", in_this_process)  # a pool loads for seconds
    at_once = bench(tmp_path / "a.json", "--arms", "oracle,language_off", "--episodes", "2")
    bench(tmp_path / "b.json", "--arms", "oracle", "--episodes", "1")
    both = ("--arms", "oracle,language_off", "--episodes", "2", "--resume")
    assert without_times(bench(tmp_path / "b.json", *both)) == without_times(at_once)
    assert set(at_once["arms"]) == {"oracle", "language_off"}
    assert all(set(arm) == KEYS for arm in at_once["arms"].values())
    assert at_once["arms"]["oracle"]["success_rate"] == 1.0
    assert at_once["redrawn_share"] == 0.0
    assert at_once["firm_over_gentle"] is None
    fruit, results = at_once["results"]["fruit"], at_once["results"]
    for arm in ("oracle", "language_off"):
        for seed, (result,) in results[arm].items():
            assert result["slip_minimum_n"] == pytest.approx(fruit[seed]["slip_minimum_n"])
