"""The strawberry benchmark with another task, object or instruction than the strawberry's."""

import json

import pytest

from tacgrasp.__main__ import main
from tests.fakes.contracts import STRAWBERRY

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
    assert episode["truth"]["peak_force_n"] <= STRAWBERRY.limit_n


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
