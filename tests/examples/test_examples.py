"""Every numbered example is short and does what it shows."""

import importlib.util
import json
import runpy
import sys

import pytest

from tests.paths import ROOT, SHARED_DATA

EXAMPLES = ROOT / "examples"
BALLS = SHARED_DATA / "gelsight_mini_balls"
FILES = sorted(path.name for path in EXAMPLES.glob("[0-9]*.py"))

SHOWN = {
    "01_run_an_episode.py": ((), "end: success"),
    "02_own_task.py": ((), "0.50-0.90 N, never above 1.1 N"),
    "03_own_sensor.py": ((), "pressed 0.00 mm: nothing touches the gel\npressed 0.05 mm: at (+3"),
    "04_describe_a_scan.py": ((), "position  top-left"),
    "05_calibrate.py": ((), "N for each nominal newton"),
    "06_decide_again.py": ((), "rules decides 0 steps otherwise"),
    "07_export.py": ((), " clouds, "),
    "08_serve.py": ((), "and without points: the key observation/tactile_points is missing"),
    "09_gym.py": (("2",), "2 of 2 held"),
    "12_qwen_from_disk.py": ((), "Qwen2ForCausalLM of width 32"),
}
"""Arguments of each example, and what it must print; the others have tests of their own."""


@pytest.fixture
def here(tmp_path, monkeypatch):
    """Examples write into the folder that they are run in."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(name, *argv, monkeypatch):
    monkeypatch.setattr(sys, "argv", [name, *argv])
    runpy.run_path(str(EXAMPLES / name), run_name="__main__")


def test_there_are_eight_to_twelve_numbered_from_one():
    assert 8 <= len(FILES) <= 12
    assert [int(name[:2]) for name in FILES] == list(range(1, len(FILES) + 1))


@pytest.mark.parametrize("name", FILES)
def test_an_example_has_at_most_80_lines_and_says_how_to_run_it(name):
    text = (EXAMPLES / name).read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 80
    assert f"python examples/{name}" in text


@pytest.mark.parametrize("name", SHOWN)
def test_an_example_does_what_it_shows(name, here, monkeypatch, capsys):
    argv, shown = SHOWN[name]
    run(name, *argv, monkeypatch=monkeypatch)
    assert shown in capsys.readouterr().out


def test_the_own_task_replaces_no_task_of_its_name(here, monkeypatch):
    tasks = [here / name for name in ("own_task.yaml", "salad_tomato.yaml")]
    for task in tasks:
        task.write_text("mine")
    with pytest.raises(SystemExit, match=r"own_task\.yaml exists and is kept"):
        run("02_own_task.py", monkeypatch=monkeypatch)
    assert [task.read_text() for task in tasks] == ["mine", "mine"]


@pytest.mark.parametrize(
    ("name", "argv", "expected"),
    [
        ("08_serve.py", ["rule"], "expected rules or llm, got rule"),
        ("11_train_on_your_own.py", [], "measured exists, of an earlier run; delete measured"),
        ("12_qwen_from_disk.py", ["measured"], "no language model could be read from measured"),
        ("12_qwen_from_disk.py", ["nowhere"], "nowhere: it is not a directory"),
    ],
)
def test_a_likely_mistake_is_told_in_one_line(name, argv, expected, here, monkeypatch):
    (here / "measured").mkdir()
    with pytest.raises(SystemExit, match=expected) as caught:
        run(name, *argv, monkeypatch=monkeypatch)
    assert "\n" not in str(caught.value)


def test_the_exported_table_has_a_row_for_each_step(here, monkeypatch):
    run("07_export.py", monkeypatch=monkeypatch)
    (table,) = here.glob("*.csv")
    lines = table.read_text(encoding="utf-8").splitlines()
    assert lines[0] == "step,t_s,phase,in_contact,felt_n,commanded_n,width_mm,action,text"
    assert len(lines) > 5
    assert any("increase_force" in line for line in lines)


@pytest.mark.slow
@pytest.mark.skipif(not BALLS.is_dir(), reason=f"no real frames in {BALLS}")
def test_the_shipped_weights_are_trained_on_own_contacts(here, monkeypatch, capsys):
    few = ["--contacts", "24", "--ours", "40", "--steps", "2", "--joint-steps", "2"]
    run("11_train_on_your_own.py", "--frames", str(BALLS), *few, monkeypatch=monkeypatch)
    assert "your own, held out" in capsys.readouterr().out
    assert (here / "weights" / "projector" / "manifest.json").is_file()
    rows = json.loads((here / "own.json").read_text())["rows"]
    assert {row["reader"] for row in rows} == {"heads", "zero_shot", "captions"}
    own = next(row for row in rows if row["contacts"] == "own")
    assert own["count"]["shape"] >= own["count"]["depth"] > 0


@pytest.mark.skipif(
    importlib.util.find_spec("stable_baselines3") is None,
    reason="stable-baselines3 is not installed: pip install stable-baselines3",
)
def test_a_policy_is_trained_in_gymnasium_for_200_steps(here, monkeypatch, capsys):
    flags = ["--steps", "200", "--episodes", "1", "--json", "gym.json"]
    run("10_train_in_gym.py", *flags, monkeypatch=monkeypatch)
    assert "of 1 unseen berries" in capsys.readouterr().out
    assert (here / "gym.json").is_file()


def test_every_example_is_run_by_a_test():
    assert set(FILES) == {*SHOWN, "10_train_in_gym.py", "11_train_on_your_own.py"}
