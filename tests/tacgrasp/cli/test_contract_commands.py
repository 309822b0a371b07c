"""The contract on the command line: understood, printed, refused, written for machines, scored."""

from __future__ import annotations

import io
import json
from pathlib import Path

import pytest

from tacgrasp.__main__ import main
from tests.fakes.contracts import BERRY

Capture = pytest.CaptureFixture[str]
Patch = pytest.MonkeyPatch

KEYS = {"force_n", "limit_n", "slip_mm", "place_mm", "depth_mm", "area", "assumed", "refused"}

OWN_TASK = """\
instruction: Hold the plum.
object: strawberry
goal: {force_n: [1.1, 1.3], limit_n: 1.4, x_mm: [-2, 2]}
verify: {max_shift_mm: 0.8}
"""


def printed_config(argv: list[str], capsys: Capture) -> dict[str, str]:
    """Lines of --print-config by their first word."""
    assert main(["run", "--print-config", *argv]) == 0
    lines = capsys.readouterr().out.splitlines()
    return {line.split()[0]: line for line in lines if line.strip()}


def events(path: Path) -> list[dict[str, object]]:
    return [json.loads(line) for line in path.read_text("utf-8").splitlines()]


def complaint(argv: list[str], capsys: Capture) -> str:
    assert main(argv) == 2
    printed = capsys.readouterr()
    assert printed.err.startswith("tacgrasp: ")
    assert printed.err.count("\n") == 1
    return printed.err


def test_understand_prints_what_was_understood_and_moves_nothing(
    tmp_path: Path, capsys: Capture, monkeypatch: Patch
) -> None:
    monkeypatch.setattr("tacgrasp.rig.factory.make_rig", lambda *_: pytest.fail("a rig was made"))
    path = tmp_path / "contract.json"
    assert main(["understand", "Hold the berry at 2 N.", "--json", str(path)]) == 0
    line = capsys.readouterr().out.splitlines()[0]
    assert line.startswith(
        "understood: hold the berry, 1.72-2.28 N, never above 2.85 N (your words"
    )
    written = json.loads(path.read_text())
    assert written.keys() >= KEYS
    assert written["force_n"] == pytest.approx([1.72, 2.28])
    assert written["limit_n"] == pytest.approx(2.85)
    assert written["refused"] is None
    assert written["place_mm"] == {"x": [-4.0, 4.0], "y": [-3.0, 3.0]}


def test_understand_says_why_it_refuses_and_what_it_understood(
    tmp_path: Path, capsys: Capture
) -> None:
    path = tmp_path / "contract.json"
    assert main(["understand", "Crush the berry.", "--json", str(path)]) == 2
    printed = capsys.readouterr().out
    assert "refused: it would destroy what is held: crush the" in printed
    assert "understood: " in printed
    written = json.loads(path.read_text())
    assert (written["force_n"], written["limit_n"]) == (None, None)
    assert written["refused"].startswith("it would destroy")


def test_understand_is_relative_to_the_task_that_it_is_asked_for(tmp_path: Path) -> None:
    bands = []
    for task in ("strawberry", "egg", "peg", "cherry_tomato"):
        path = tmp_path / f"{task}.json"
        assert main(["understand", "Hold it firmly.", "--task", task, "--json", str(path)]) == 0
        bands.append(json.loads(path.read_text())["force_n"])
    middles = [sum(band) for band in bands]
    assert middles == sorted(middles[:3]) + middles[3:]
    assert middles[3] == min(middles)


@pytest.mark.parametrize(
    ("argv", "expected"),
    [
        (["understand"], "instruction"),
        (["understand", "--instruction", "Hold it."], "instruction, which stands without a flag"),
        (["understand", "Hold it.", "--task", "banana"], "unknown task 'banana'"),
        (["understand", "Hold it.", "--json", "no/where.json"], "can't be written"),
    ],
)
def test_wrong_use_of_understand_gets_one_line(
    argv: list[str], expected: str, capsys: Capture
) -> None:
    assert expected in complaint(argv, capsys).lower()


def test_a_refused_run_moves_nothing_and_says_so_for_people_and_machines(
    tmp_path: Path, capsys: Capture, monkeypatch: Patch
) -> None:
    monkeypatch.setattr("tacgrasp.rig.factory.make_rig", lambda *_: pytest.fail("a rig was made"))
    path, record = tmp_path / "events.jsonl", tmp_path / "episodes"
    argv = ["run", "--instruction", "Let go of it.", "--record", str(record), "--json", str(path)]
    message = complaint(argv, capsys)
    assert "refused: it asks to let go" in message
    assert "nothing moved" in message
    assert not record.exists()
    contract, end = events(path)
    assert (contract["event"], contract["force_n"]) == ("contract", None)
    assert contract["refused"] == end["message"]
    assert (end["event"], end["reason"], end["steps"]) == ("end", "refused", 0)


def test_a_wrong_slip_calibration_begins_no_episode(tmp_path: Path, capsys: Capture) -> None:
    record = tmp_path / "episodes"
    argv = ["run", "--policy", "rules", "--slip-calibration", "nix.json", "--record", str(record)]
    assert "no slip calibration at nix.json" in complaint(argv, capsys)
    assert not record.exists()


def test_a_run_writes_contract_steps_and_end_as_they_come(tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "events.jsonl"
    argv = ["run", "--policy", "rules", "--seed", "1", "--record", str(tmp_path)]
    assert main([*argv, "--json", str(path)]) == 0
    assert "understood: pick the strawberry, 0.15-2.50 N" in capsys.readouterr().out
    contract, *steps, end = events(path)
    assert contract["event"] == "contract"
    assert contract["force_n"] == [BERRY.force_n.low, BERRY.force_n.high]
    assert {step["event"] for step in steps} == {"step"}
    assert [step["index"] for step in steps] == list(range(len(steps)))
    assert end["event"] == "end"
    assert (end["reason"], end["verified"]) == ("success", True)
    assert (end["bruised"], end["dropped"]) == (False, False)
    assert end["steps"] == len(steps)
    assert end["slip_minimum_n"] < end["peak_force_n"] <= contract["limit_n"]


def test_a_flag_for_the_force_is_used_and_every_band_names_its_origin(capsys: Capture) -> None:
    lines = printed_config(["--goal.force-n", "4", "6"], capsys)
    assert lines["goal.force_n"].endswith("[flag --goal.force-n]")
    assert lines["contract.force_n"].split(maxsplit=1)[1] == "[4, 6]  [the configuration]"
    assert "4.00-6.00 N, never above 7.5 N (the configuration)" in lines["understood:"]
    assert lines["contract.slip_mm"].endswith("[default]")
    assert lines["contract.depth_mm"].endswith("[default]")


def test_an_environment_variable_for_the_force_is_configuration_too(
    capsys: Capture, monkeypatch: Patch
) -> None:
    monkeypatch.setenv("TACGRASP_GOAL__LIMIT_N", "2.1")
    lines = printed_config([], capsys)
    assert lines["contract.limit_n"].split(maxsplit=1)[1] == "2.1  [the configuration]"


@pytest.mark.parametrize(
    ("flags", "name", "value"),
    [
        (["--goal.limit-n", "2.2"], "limit_n", "2.2"),
        (["--goal.x-mm", "-1", "1"], "x_mm", "[-1, 1]"),
        (["--goal.y-mm", "-2", "1"], "y_mm", "[-2, 1]"),
        (["--goal.depth-mm", "0.1", "0.4"], "depth_mm", "[0.1, 0.4]"),
        (["--goal.area-share", "0.1", "0.3"], "area_fraction", "[0.1, 0.3]"),
        (["--verify.max-shift-mm", "0.5"], "slip_mm", "0.5"),
    ],
)
def test_no_band_that_a_flag_sets_is_ignored(
    flags: list[str], name: str, value: str, capsys: Capture
) -> None:
    lines = printed_config(flags, capsys)
    expected = f"{value}  [the configuration]"
    assert lines[f"contract.{name}"].split(maxsplit=1)[1] == expected


def test_a_force_in_words_against_a_flag_is_refused_with_both_named(
    tmp_path: Path, capsys: Capture
) -> None:
    argv = ["run", "--instruction", "Hold it at 1 N.", "--goal.force-n", "4", "6"]
    message = complaint([*argv, "--record", str(tmp_path / "episodes")], capsys)
    assert "4-6 N" in message
    assert "'1 N'" in message
    assert not (tmp_path / "episodes").exists()


def test_a_task_file_of_ones_own_is_the_task_and_a_band_unset_has_its_default(
    tmp_path: Path, capsys: Capture
) -> None:
    path = tmp_path / "plum.yaml"
    path.write_text(OWN_TASK)
    lines = printed_config(["--task", str(path)], capsys)
    expected = {
        "force_n": "[1.1, 1.3]",
        "limit_n": "1.4",
        "x_mm": "[-2, 2]",
        "slip_mm": "0.8",
    }
    for name, value in expected.items():
        assert lines[f"contract.{name}"].split(maxsplit=1)[1] == f"{value}  [the task]"
    assert "1.10-1.30 N, never above 1.4 N (the task)" in lines["understood:"]
    for name in ("y_mm", "depth_mm", "area_fraction"):
        assert f"contract.{name}" in lines


def test_words_are_relative_to_a_task_file_of_ones_own(tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "plum.yaml"
    path.write_text(OWN_TASK)
    lines = printed_config(["--task", str(path), "--instruction", "Hold it gently."], capsys)
    low, high = json.loads(lines["contract.force_n"].split(maxsplit=1)[1].rpartition("  ")[0])
    assert (low + high) / 2 <= 0.85 * 1.2
    assert "(gentle: your words: gently)" in lines["understood:"]


WORDINGS = """\
text,kind,expect
Hold it at 2 N.,numbers,band 2
Hold it with at most 2 N.,limits,max 2
Hold it with at least 1.5 N.,limits,1.5
Hold it between 1 and 2 N.,limits,range 1 2
"Hold it gently, please.",softer,
Hold it firmly.,manner,firmer
Let go.,refuse,refuse
Hold it.,plain,task
Hold it at 3 N.,numbers,band 2
"""


def test_eval_instructions_scores_a_file_and_shows_what_is_wrong(
    tmp_path: Path, capsys: Capture
) -> None:
    path, figures = tmp_path / "wordings.csv", tmp_path / "figures.json"
    path.write_text(WORDINGS.replace("limits,1.5", "min,1.5"), "utf-8-sig")  # as spreadsheets do
    assert main(["eval", "instructions", "--file", str(path), "--json", str(figures)]) in (0, None)
    printed = capsys.readouterr().out
    assert "'Hold it at 3 N.' became: 2.58-3.42 N" in printed
    assert "'Let go.'" not in printed
    report = json.loads(figures.read_text())
    assert report["figures"]["all"] == {"right": 8, "n": 9, "rate": pytest.approx(8 / 9)}
    assert report["figures"]["band"]["right"] == 1
    wrong = [row["text"] for row in report["instructions"] if not row["right"]]
    assert wrong == ["Hold it at 3 N."]


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        ("", "needs the columns text, kind and expect"),
        ("text,kind\nHold it.,plain\n", "needs the columns text, kind and expect"),
        ("text,kind,expect\n", "and a row"),
        ("text,kind,expect\nHold it.,plain,sofft\n", "line 2: expect must be one of band V"),
        ("text,kind,expect\nHold it.,numbers,band\n", "line 2: expect must be one of"),
        ("text,kind,expect\nHold it.,numbers,band two\n", "got 'band two'"),
        ("text,kind,expect\nHold it.,numbers,range 1\n", "line 2"),
        ("text,kind,expect\nHold it.,numbers,band 0\n", "got 'band 0'"),
        ("text,kind,expect\nHold it.,numbers,range 0 0\n", "got 'range 0 0'"),
        ("text,kind,expect\nHold it.,numbers,max inf\n", "got 'max inf'"),
        ("text,kind,expect\nHold.,plain,task\nHold it.,plain\n", "line 3: expect must be one of"),
    ],
)
def test_a_file_of_wordings_that_is_none_is_refused_in_one_line(
    content: str, expected: str, tmp_path: Path, capsys: Capture
) -> None:
    path = tmp_path / "wordings.csv"
    path.write_text(content)
    message = complaint(["eval", "instructions", "--file", str(path)], capsys)
    assert expected in message
    assert "wordings.csv" in message


def test_a_missing_file_of_wordings_is_refused_in_one_line(capsys: Capture) -> None:
    assert "no.csv can't be read" in complaint(["eval", "instructions", "--file", "no.csv"], capsys)


def test_jog_keeps_to_the_tasks_limit_and_says_what_it_lowered(
    capsys: Capture, monkeypatch: Patch
) -> None:
    monkeypatch.setattr("sys.stdin", io.StringIO("g" + 12 * "+" + "gq"))
    assert main(["jog", "--seed", "3", "--force-n", "0.5"]) == 0
    closed = [line for line in capsys.readouterr().out.splitlines() if line.startswith("closed")]
    assert "lowered" not in closed[0]
    assert "contract's limit of 5 N" in closed[1]
