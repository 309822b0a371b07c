"""The strawberry benchmark with another task, object or instruction than the strawberry's."""

import json
from itertools import pairwise
from types import SimpleNamespace

import pytest

from tacgrasp.__main__ import main
from tacgrasp.benchmarks.loop import strawberry
from tacgrasp.benchmarks.loop.contestants import SWEEP, swept_forces_n
from tacgrasp.benchmarks.loop.strawberry import still_running
from tacgrasp.benchmarks.settings import StrawberrySettings, VerifierSettings
from tacgrasp.config.layers import load
from tests.fakes.contracts import BERRY

SEED = 1_000_003


def figures(tmp_path, *argv: str) -> dict:
    path = tmp_path / "figures.json"
    common = ["--episodes", "1", "--first-seed", str(SEED), "--policies", "rules"]
    assert main(["bench", "strawberry", *common, *argv, "--json", str(path)]) in (0, None)
    return json.loads(path.read_text())


def test_a_strawberry_under_the_pegs_task_is_held_to_its_own_terms(tmp_path):
    report = figures(tmp_path, "--task", "peg", "--object", "strawberry")
    assert (report["task"], report["object"]) == ("peg", "strawberry")
    assert "Grip the peg firmly" in report["instruction"]
    (episode,) = report["episodes_by_policy"]["rules"]
    assert episode["objected"]
    assert not episode["bruised"]
    assert episode["truth"]["peak_force_n"] <= BERRY.limit_n


def test_the_figures_of_a_policy_have_their_names_and_agree_with_its_episodes(tmp_path, capsys):
    report = figures(tmp_path, "--quick")
    row, (episode,) = report["policies"]["rules"], report["episodes_by_policy"]["rules"]
    truth, least_n = episode["truth"], episode["slip_minimum_n"]
    assert row["verified_success_rate"] == episode["verified"]
    assert row["bruised_rate"] == episode["bruised"]
    assert row["bruised_at_start_rate"] == truth["bruised_at_start"]
    assert row["dropped_rate"] == truth["dropped"]
    assert row["median_actions"] == episode["actions"]
    assert row["median_final_force_over_slip_minimum"] == truth["force_n"] / least_n
    assert row["median_peak_force_over_slip_minimum"] == truth["peak_force_n"] / least_n
    assert row["seconds_per_episode"] == episode["seconds"] > 0
    assert f"one core: rules {episode['seconds']:.2f} s" in capsys.readouterr().out


def test_quick_takes_eight_seeds_and_never_more_than_were_asked_for():
    assert StrawberrySettings(quick=True).seeds == range(1_000_000, 1_000_008)
    assert StrawberrySettings(quick=True, episodes=3, first_seed=5).seeds == range(5, 8)
    assert len(StrawberrySettings().seeds) == 200
    assert len(VerifierSettings().seeds) == 400


@pytest.mark.parametrize(
    ("argv", "expected"),
    [
        (["--instruction", "Crush the berry."], "refused"),
        (["--task", "banana"], "unknown task 'banana'"),
        (["--object", "anvil"], "anvil"),
    ],
)
def test_wrong_use_is_told_in_one_line_before_any_episode(argv, expected, capsys):
    assert main(["bench", "strawberry", "--episodes", "1", *argv]) == 2
    printed = capsys.readouterr()
    assert expected in printed.err
    assert printed.err.count("\n") == 1


@pytest.mark.parametrize(
    ("task", "ends"), [("strawberry", (0.2, 3.0)), ("egg", (0.95, 7.6)), ("peg", (1.8, 14.4))]
)
def test_a_sweep_reaches_beyond_the_band_of_its_task(task, ends):
    forces = swept_forces_n(load(task)[0])
    assert len(forces) == SWEEP == 15
    assert (forces[0], forces[-1]) == ends
    ratios = [after / before for before, after in pairwise(forces)]
    assert max(ratios) / min(ratios) < 1.01


def test_only_a_force_that_is_clearly_worse_than_the_best_leaves_its_sweep():
    verified, failed = SimpleNamespace(verified=True), SimpleNamespace(verified=False)
    shares = {
        ("true_force", 0.3): 20,
        ("true_force", 0.6): 14,
        ("true_force", 0.9): 5,
        ("fixed_force", 0.9): 5,
        ("rules", None): 0,
    }
    results = {each: [verified] * n + [failed] * (40 - n) for each, n in shares.items()}
    assert still_running(results, list(results)) == [
        ("true_force", 0.3),
        ("true_force", 0.6),
        ("fixed_force", 0.9),
        ("rules", None),
    ]


@pytest.mark.slow
def test_a_sweep_says_how_many_episodes_each_force_ran(tmp_path, monkeypatch):
    monkeypatch.setattr(strawberry, "ROUND", 1)
    monkeypatch.setattr(strawberry, "swept_forces_n", lambda config: (0.3, 0.6, 3.0))
    monkeypatch.setattr(strawberry, "still_running", lambda results, running: running[:1])
    report = figures(tmp_path, "--policies", "true_force", "--episodes", "2")
    counts = report["policies"]["true_force"]["sweep_episodes"]
    assert counts == {"0.3": 2, "0.6": 1, "3": 1}
    assert report["policies"]["true_force"]["episodes"] == 2
    assert len(report["episodes_by_policy"]["true_force"]) == 2
