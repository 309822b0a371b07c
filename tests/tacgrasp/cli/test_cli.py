"""The command line: exit codes, one clear line for every wrong use, and what --help may load."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from contextlib import suppress
from operator import attrgetter
from pathlib import Path

import numpy as np
import pytest
from mcap.reader import make_reader

from tacgrasp.__main__ import COMMANDS, main, usage
from tacgrasp.base import package_check
from tacgrasp.base.errors import UsageError
from tacgrasp.base.worker_pool import THREADS
from tacgrasp.cli.run import configure
from tacgrasp.config.layers import leaves, load, names
from tacgrasp.console import COMPLETED
from tacgrasp.episodes.listing import table
from tests.paths import ROOT

Capture = pytest.CaptureFixture[str]
Patch = pytest.MonkeyPatch

SUCCEEDS = "1"
"""A seed whose grasp succeeds; checked by the tests themselves."""


@pytest.fixture(scope="module")
def episode(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A whole simulated run, recorded."""
    folder = tmp_path_factory.mktemp("episodes")
    assert main(["demo", "paper", "--record", str(folder)]) == 0
    return next(folder.glob("*.mcap"))


def complaint(argv: list[str], capsys: Capture, code: int = 2) -> str:
    assert main(argv) == code
    printed = capsys.readouterr()
    assert COMPLETED not in printed.out
    assert printed.err.startswith("tacgrasp: ")
    assert printed.err.count("\n") == 1
    return printed.err


def test_help_names_every_command_and_exit_code(capsys: Capture) -> None:
    assert main(["--help"]) == 0
    assert capsys.readouterr().out == usage() + "\n"
    for word in (*COMMANDS, "0 ", "1 ", "2 ", "3 ", "130 "):
        assert word in usage()


@pytest.mark.parametrize(
    "code",
    [
        "from tacgrasp.__main__ import main; main(['--help'])",
        "import tacgrasp, primitives, policies, cltp, sim",
        "import cltp.tactile.cloud, cltp.tactile.states, policies.rules, tacgrasp.loop",
    ],
)
def test_neither_torch_nor_open3d_nor_a_device_sdk_is_loaded(code: str) -> None:
    heavy = "torch open3d transformers rtde_control rtde_receive dynamixel_sdk serial"
    check = f"import sys; print([m for m in '{heavy}'.split() if m in sys.modules])"
    done = subprocess.run(
        [sys.executable, "-c", f"{code}\n{check}"], cwd=ROOT, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1] == "[]"


@pytest.mark.parametrize(
    ("command", "given", "expected"),
    [("run", None, "1"), ("run", "2", "2"), ("train", None, None)],
)
def test_commands_that_compute_step_by_step_keep_to_one_thread(
    command: str, given: str | None, expected: str | None
) -> None:
    code = f"""
from tacgrasp.__main__ import main
try:
    main(['{command}', '--help'])
except SystemExit:
    pass
import os; print([os.environ.get(name) for name in {THREADS!r}])
"""
    environment = {name: value for name, value in os.environ.items() if name not in THREADS}
    environment |= {} if given is None else dict.fromkeys(THREADS, given)
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, env=environment
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1] == str([expected] * len(THREADS))


def test_without_a_command_the_usage_is_printed_and_it_is_wrong_use() -> None:
    assert main([]) == 2


@pytest.mark.parametrize(
    ("argv", "expected"),
    [
        (["grasp"], "unknown command 'grasp'; known: run"),
        (["run", "--task", "banana"], "unknown task 'banana'"),
        (["run", "--policy", "gut"], "unknown policy 'gut'; known: rules"),
        (["run", "--policy", "oracle"], "only `tacgrasp bench strawberry` has it"),
        (["run", "--sensor", "finger"], "unknown sensor 'finger'"),
        (["run", "--object", "anvil"], "no object 'anvil'; known: strawberry"),
        (["run", "--object-mesh", "no.ply"], "no.ply does not exist"),
        (["run", "--object-bruise-n", "2"], "give object_mesh too"),
        (["run", "--object-mesh", "x.ply", "--object-young-mpa", "1e9"], "less than or equal"),
        (["demo", "nope"], "unknown demo 'nope'; known: paper"),
        (["replay"], "EPISODE|PATH"),
        (["replay", "no.mcap"], "no.mcap does not exist"),
        (["replay", "no.mcap", "--policy", "rules"], "--policy needs --decide"),
        (["replay", "no.mcap", "--policy-url", "ws://127.0.0.1:1"], "--policy-url needs --decide"),
        (["replay", "no.mcap", "--decide", "--execute"], "one after the other"),
        (["episodes"], "expects one of ls, info, recover, plot, export, got nothing"),
        (["episodes", "rm"], "got 'rm'"),
        (["episodes", "ls", "nowhere"], "nowhere is not a directory"),
        (["episodes", "info", "no.mcap"], "no.mcap does not exist"),
        (["episodes", "recover", "no.mcap"], "no.mcap does not exist"),
        (["episodes", "plot", "no.mcap"], "no.mcap does not exist"),
        (["describe", "no.ply"], "no.ply does not exist"),
        (["describe", "photo.tiff"], "expected a file ending in"),
        (["describe", "no.ply", "--sensor", "finger"], "unknown sensor 'finger'; known: digit"),
        (["bench"], "expects one of strawberry, missed, robustness, verifier, draws"),
        (["bench", "other-sim", "--data", "nowhere"], "--data nowhere is not a folder"),
        (["bench", "other-sim", "--contacts", "0"], "--contacts must be at least 1"),
        (["bench", "latency", "--ticks", "0"], "--ticks must be at least 1"),
        (["bench", "latency", "--json", "no/where.json"], "--json no/where.json can't be written"),
        (["bench", "strawberry", "--episodes", "0"], "--episodes must be at least 1"),
        (["bench", "gel", "--jsn", "x"], "did you mean --json"),
        (["run", "strawberry"], "did you mean --task strawberry?"),
        (["describe", "x.npz", "--json", "x.json"], "x.json; --json takes no value"),
        (["eval", "--data", "nowhere"], "make them: tacgrasp data generate --set full"),
        (["eval", "zero-shot", "--data", "nowhere"], "make them: tacgrasp data generate --out"),
        (["run", "--policy", "fixed_force"], "bench strawberry --policies fixed_force"),
        (["run", "--policy", "rules", "--weights", "nowhere"], "--weights nowhere is not a folder"),
        (["run", "--weights", "nowhere"], "train them with `tacgrasp train all`"),
        (["why", "no.mcap"], "no.mcap does not exist"),
    ],
)
def test_wrong_use_gets_one_line_and_exit_code_2(
    argv: list[str], expected: str, capsys: Capture
) -> None:
    message = complaint(argv, capsys)
    assert any(part in message for part in expected.split("|")), message


def test_a_record_folder_that_is_a_file_is_refused_before_anything_moves(
    tmp_path: Path, capsys: Capture
) -> None:
    (tmp_path / "taken").write_text("")
    message = complaint(["run", "--record", str(tmp_path / "taken")], capsys)
    assert "is not a directory" in message


def test_a_read_only_record_folder_is_refused(
    tmp_path: Path, capsys: Capture, monkeypatch: Patch
) -> None:
    monkeypatch.setattr(os, "access", lambda *_: False)  # root may write anywhere
    assert "read-only" in complaint(["run", "--record", str(tmp_path)], capsys)


def test_a_wrong_name_is_refused_before_anything_heavy_is_loaded() -> None:
    wrong = [["--object", "banana"], ["--policy", "gut"], ["--sensor", "finger"]]
    code = (
        "import sys; from tacgrasp.__main__ import main\n"
        f"codes = [main(['run', *argv]) for argv in {wrong!r}]\n"
        "print(codes, [m for m in ('torch', 'transformers', 'open3d') if m in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True)
    assert done.stdout.splitlines()[-1] == "[2, 2, 2] []", done.stderr
    refusals = done.stderr.splitlines()
    assert len(refusals) == 3
    assert all("known: " in line for line in refusals)


def test_a_full_disk_in_mid_episode_is_a_fault_in_one_line_and_nothing_is_called_successful(
    tmp_path: Path,
) -> None:
    command = f"ulimit -f 24; exec {sys.executable} -m tacgrasp demo paper --record {tmp_path}"
    done = subprocess.run(["bash", "-c", command], cwd=ROOT, capture_output=True, text=True)
    assert "end: fault - can't write" in done.stdout, done.stdout + done.stderr
    assert "Traceback" not in done.stderr
    assert COMPLETED not in done.stdout
    assert "the gripper has released" in done.stdout


@pytest.mark.parametrize(("content", "expected"), [(b"", "empty"), (b"hello", "not an MCAP")])
def test_an_episode_that_is_none_is_refused(
    content: bytes, expected: str, tmp_path: Path, capsys: Capture
) -> None:
    path = tmp_path / "x.mcap"
    path.write_bytes(content)
    for command in (["replay"], ["replay", "--decide"], ["episodes", "info"]):
        assert expected in complaint([*command, str(path)], capsys)


def test_a_truncated_episode_is_shown_as_incomplete(
    episode: Path, tmp_path: Path, capsys: Capture
) -> None:
    cut = tmp_path / "cut.mcap"
    whole = episode.read_bytes()
    cut.write_bytes(whole[: len(whole) // 2])
    assert main(["replay", str(cut)]) == 0
    assert "incomplete: " in capsys.readouterr().out


def test_a_damaged_episode_is_not_called_reproduced_exactly(
    tmp_path: Path, capsys: Capture
) -> None:
    assert main(["run", "--policy", "rules", "--seed", "1", "--record", str(tmp_path)]) == 0
    (whole,) = tmp_path.glob("*.mcap")
    data = bytearray(whole.read_bytes())
    middle = len(data) // 2
    data[middle : middle + 512] = bytes(512)  # longer than what lies between two chunks
    damaged = tmp_path / "flip.mcap"
    damaged.write_bytes(data)
    capsys.readouterr()
    assert main(["replay", str(damaged), "--decide"]) == 0
    printed = capsys.readouterr().out
    assert "0 differ; only those that could be read were decided again" in printed
    assert "exactly" not in printed


def test_a_step_that_damage_cost_is_told_after_recovery_and_the_motion_is_not_repeated(
    tmp_path: Path, capsys: Capture
) -> None:
    assert main(["run", "--policy", "rules", "--seed", "1", "--record", str(tmp_path)]) == 0
    (path,) = tmp_path.glob("*.mcap")
    with path.open("rb") as file:
        summary = make_reader(file).get_summary()
    assert summary is not None
    chunk = summary.chunk_indexes[3]  # the first is the header's
    data = bytearray(path.read_bytes())
    data[chunk.chunk_start_offset + chunk.chunk_length // 2] ^= 0xFF
    path.write_bytes(data)
    capsys.readouterr()
    for _ in range(2):
        assert main(["episodes", "info", str(path)]) == 0
        assert "no: step 2 is missing; " in capsys.readouterr().out
        assert main(["why", str(path)]) == 1
        printed = " ".join(capsys.readouterr().out.split())
        assert printed.startswith("incomplete step 2 is missing; ")
        assert "trouble none in what was read" in printed
        assert main(["replay", str(path), "--decide"]) == 0
        printed = capsys.readouterr().out
        assert printed.startswith("incomplete: step 2 is missing; ")
        assert "only those that could be read" in printed and "exactly" not in printed
        assert main(["replay", str(path), "--execute"]) == 2
        captured = capsys.readouterr()
        expected = "step 2 is missing, so that the motion has a hole; nothing was moved"
        assert expected in captured.err and "mm from the recorded pose" not in captured.out
        assert main(["episodes", "recover", str(path)]) == 0
        assert "step 2 is missing" in capsys.readouterr().out
    assert main(["episodes", "ls", str(tmp_path)]) == 0
    assert "success, incomplete" in capsys.readouterr().out


def test_the_paper_demo_prints_two_lines_a_step_the_end_and_the_truth(
    tmp_path: Path, capsys: Capture
) -> None:
    assert main(["demo", "paper", "--record", str(tmp_path)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert all(" s  felt " in line for line in lines[:8:2])
    assert lines[1].endswith("→ move_down: 3 mm")
    assert all("→ increase_force: commanded " in line for line in lines[3:7:2])
    assert "stable" in lines[7]
    assert max(len(line) for line in lines if str(tmp_path) not in line) <= 100
    assert any(line.startswith("end: success") for line in lines)
    assert any(line.startswith("truth: ") for line in lines)
    assert COMPLETED in lines


TASKS = ["strawberry", "cherry_tomato", "egg", "peg"]


@pytest.mark.parametrize("name", ["gentle", "missed", "missed-rules", "slips", *TASKS])
def test_a_demo_comes_out_as_scripted(name: str, tmp_path: Path, capsys: Capture) -> None:
    assert main(["demo", name, "--record", str(tmp_path)]) == 0
    assert (COMPLETED in capsys.readouterr().out) is (name in ("gentle", *TASKS))


def test_demos_are_listed_without_a_name(capsys: Capture) -> None:
    assert main(["demo"]) == 0
    assert capsys.readouterr().out.startswith("paper ")


def test_a_replay_shows_the_same_steps_as_the_run(episode: Path, capsys: Capture) -> None:
    assert main(["replay", str(episode)]) == 0
    printed = capsys.readouterr().out
    assert "move_down" in printed
    assert "end: success" in printed


def test_deciding_again_reproduces_the_episode_exactly(episode: Path, capsys: Capture) -> None:
    assert main(["replay", "--decide", str(episode)]) == 0
    assert "4 decisions, 0 differ" in capsys.readouterr().out


def test_a_target_that_the_limit_lowers_is_decided_again_alike(
    tmp_path: Path, capsys: Capture
) -> None:
    words = "Pick the strawberry, never above 0.9 N"
    run = ["run", "--task", "strawberry", "--policy", "rules", "--seed", "6"]
    assert main([*run, "--instruction", words, "--record", str(tmp_path)]) == 0
    assert main(["replay", "--decide", str(next(tmp_path.glob("*.mcap")))]) == 0
    assert " 0 differ" in capsys.readouterr().out


def test_another_policy_differs_and_says_where(episode: Path, capsys: Capture) -> None:
    assert main(["replay", "--decide", "--policy", "fixed_force", str(episode)]) == 1
    printed = capsys.readouterr().out
    assert "action: 'move_down' then, None now" in printed
    assert "4 decisions, 4 differ" in printed


def test_deciding_again_asks_the_server_that_is_named(episode: Path, capsys: Capture) -> None:
    argv = ["replay", "--decide", "--policy", "remote", str(episode)]
    assert "--policy remote needs --policy-url" in complaint(argv, capsys)
    argv += ["--policy-url", "ws://127.0.0.1:9"]
    assert "127.0.0.1:9" in complaint(argv, capsys, code=3)


def test_executing_again_reaches_the_recorded_poses(episode: Path, capsys: Capture) -> None:
    assert main(["replay", "--execute", str(episode)]) == 0
    assert "3 actions repeated; at most 0.00 mm" in capsys.readouterr().out


def test_a_run_records_an_episode_and_its_exit_code_agrees_with_what_it_prints(
    tmp_path: Path, capsys: Capture
) -> None:
    code = main(["run", "--seed", SUCCEEDS, "--record", str(tmp_path)])
    printed = capsys.readouterr().out
    assert code == 0
    assert printed.rstrip().endswith(COMPLETED)
    assert len(list(tmp_path.glob("strawberry-*.mcap"))) == 1


def test_a_bruised_grasp_that_touch_verified_is_not_called_a_success(
    tmp_path: Path, capsys: Capture
) -> None:
    crushing = ["--goal.force-n", "4", "5", "--goal.limit-n", "8"]
    argv = ["run", "--policy", "rules", "--seed", SUCCEEDS, *crushing, "--record", str(tmp_path)]
    assert main(argv) == 1
    end = capsys.readouterr().out.partition("\nepisode: ")[2]
    assert "end: verified by touch, but bruised - " in end
    assert "Bruised after the first touch." in end
    assert "success" not in end
    recorded = next(tmp_path.glob("*.mcap"))
    assert main(["replay", str(recorded)]) == 0
    assert "end: verified by touch, but bruised - " in capsys.readouterr().out
    cells = [str(cell) for column in table([recorded]).columns for cell in column.cells]
    assert any("verified by touch, but bruised" in cell for cell in cells)
    assert not any("success" in cell for cell in cells)


def test_a_dry_run_decides_and_does_not_call_anything_successful(
    tmp_path: Path, capsys: Capture
) -> None:
    events = tmp_path / "events.jsonl"
    argv = ["run", "--dry-run", "--record", str(tmp_path), "--json", str(events)]
    assert main(argv) == 0
    printed = capsys.readouterr().out
    assert "end: dry_run - " in printed
    assert "nothing was sent" in printed
    assert COMPLETED not in printed
    assert "truth: " not in printed
    assert "gripper: presses" not in printed
    end = json.loads(events.read_text().splitlines()[-1])
    assert (end["reason"], end["dropped"], end["peak_force_n"]) == ("dry_run", None, None)


def test_ctrl_c_ends_a_run_with_130_and_a_closed_episode(
    tmp_path: Path, capsys: Capture, monkeypatch: Patch
) -> None:
    from sim.grasp.rig import SimSensor

    def interrupt(_: SimSensor, frames: int = 1) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(SimSensor, "read", interrupt)
    assert main(["run", "--record", str(tmp_path)]) == 130
    assert "end: operator" in capsys.readouterr().out
    assert main(["episodes", "info", str(next(tmp_path.glob("*.mcap")))]) == 0
    assert "operator" in capsys.readouterr().out


def test_print_config_says_where_each_value_came_from(capsys: Capture) -> None:
    assert main(["run", "--task", "egg", "--arm.max-step-mm", "4", "--print-config"]) == 0
    lines = {line.split()[0]: line for line in capsys.readouterr().out.splitlines()}
    assert lines["arm.max_step_mm"].split(maxsplit=1)[1] == "4.0  [flag --arm.max-step-mm]"
    assert lines["goal.force_n"].endswith("[tasks/egg.yaml]")
    assert lines["loop.max_asks"].endswith("[default]")


@pytest.mark.parametrize("flags", [["--goal.limit_n", "0.6"], ["--goal.limit-n=0.6"]])
def test_a_limit_reaches_the_contract_however_its_flag_is_spelt(
    capsys: Capture, flags: list[str]
) -> None:
    assert main(["run", *flags, "--print-config"]) == 0
    lines = {line.split()[0]: line for line in capsys.readouterr().out.splitlines()}
    assert lines["goal.limit_n"].split(maxsplit=1)[1] == "0.6  [flag --goal.limit-n]"
    assert lines["contract.limit_n"].split()[1] == "0.6"


def test_every_setting_is_credited_to_its_flag_in_either_spelling() -> None:
    config, _ = load("fruit")
    for path in leaves(config):
        value = attrgetter(path)(config)
        section, _, name = path.rpartition(".")
        prefix = f"--{section}." if section else "--"
        if isinstance(value, bool):
            names = [f"no_{name}" if value else name]
            tokens: list[str] = []
        elif isinstance(value, (int, float, str)):
            names, tokens = [name], [str(value)]
        else:
            continue
        for spelt in (names[0], names[0].replace("_", "-")):
            _, sources, _ = configure(["--task", "fruit", f"{prefix}{spelt}", *tokens])
            assert sources[path].startswith("flag --"), (path, spelt)


def test_print_config_of_a_refused_instruction_ends_as_the_run_would(capsys: Capture) -> None:
    assert main(["run", "--instruction", "Hold it at 70 N.", "--print-config"]) == 2
    assert "refused: " in capsys.readouterr().out


@pytest.mark.parametrize(
    ("encoding", "argv", "expected"),
    [
        ("ascii", ["understand", "1 N"], b"?"),
        ("latin-1", ["run", "--policy", "rules", "--seed", "6"], b"Grasp completed successfully"),
    ],
)
def test_a_display_that_lacks_a_sign_ends_no_run(
    encoding: str, argv: list[str], expected: bytes, tmp_path: Path
) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "tacgrasp", *argv],
        cwd=tmp_path,
        env={**os.environ, "PYTHONIOENCODING": encoding, "PYTHONPATH": str(ROOT)},
        capture_output=True,
    )
    assert (done.returncode, done.stderr) == (0, b"")
    assert expected in done.stdout


RIGS = (*names("rig"), str(ROOT / "docs/example_rig.yaml"))


@pytest.mark.parametrize("rig", RIGS)
@pytest.mark.parametrize("task", names("task"))
def test_print_config_prints_every_value_of_every_rig_and_task(
    task: str, rig: str, capsys: Capture
) -> None:
    assert main(["run", "--task", task, "--rig", rig, "--print-config"]) == 0
    lines = {line.split()[0]: line for line in capsys.readouterr().out.splitlines()}
    if rig != "sim":
        servos = lines["hardware.gripper.servos"].split(maxsplit=1)[1]
        source = rig if rig.endswith(".yaml") else f"rigs/{rig}.yaml"
        assert servos == f"[{{id: 1, open_ticks: 2496, closed_ticks: 1600}}]  [{source}]"


@pytest.mark.parametrize(
    "options", [["--policy-url", "ws://127.0.0.1:1"], ["--policy-key-file", "nokey"]]
)
def test_a_server_is_named_for_a_remote_policy_alone(
    options: list[str], episode: Path, tmp_path: Path, capsys: Capture
) -> None:
    expected = f"{' '.join(options)} is for --policy remote; leave it out, since --policy rules"
    argv = ["run", "--policy", "rules", "--record", str(tmp_path / "new"), *options]
    assert expected in complaint(argv, capsys)
    assert not (tmp_path / "new").exists()
    argv = ["replay", "--decide", "--policy", "rules", str(episode), *options]
    assert expected in complaint(argv, capsys)


def test_a_height_map_is_described_in_words_and_numbers(tmp_path: Path, capsys: Capture) -> None:
    y, x = np.mgrid[7.6:-7.6:240j, -10.1:10.1:320j]
    np.save(tmp_path / "h.npy", 0.5 * np.exp(-((x - 2) ** 2 + (y + 4) ** 2) / 8))
    assert main(["describe", str(tmp_path / "h.npy")]) == 0
    printed = capsys.readouterr().out
    assert "bottom-center" in printed
    assert "moderate" in printed


def test_an_untouched_gel_is_described_as_such(tmp_path: Path, capsys: Capture) -> None:
    np.save(tmp_path / "h.npy", np.zeros((240, 320)))
    assert main(["describe", str(tmp_path / "h.npy")]) == 0
    assert "nothing touches" in capsys.readouterr().out


def test_latency_writes_quantiles_of_the_tick_and_of_every_stage(tmp_path: Path) -> None:
    path = tmp_path / "latency.json"
    assert main(["bench", "latency", "--ticks", "5", "--json", str(path)]) == 0
    report = json.loads(path.read_text())
    assert 0 < report["tick_ms"]["p50"] <= report["tick_ms"]["p99"]
    assert {"measure", "extract"} <= report["stages_ms"].keys()
    assert all({"p50", "p99"} == stage.keys() for stage in report["stages_ms"].values())


def test_a_package_from_elsewhere_is_named(tmp_path: Path, monkeypatch: Patch) -> None:
    intruder = tmp_path / "sim" / "__init__.py"
    intruder.parent.mkdir()
    intruder.write_text("")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, "sim", raising=False)
    with pytest.raises(UsageError, match=f"'sim' comes from {intruder.parent}"):
        package_check.check_packages()


def test_a_missing_package_is_named(monkeypatch: Patch) -> None:
    monkeypatch.setattr(package_check, "PACKAGES", ("cltp", "no_such_package"))
    with pytest.raises(UsageError, match="'no_such_package' is missing"):
        package_check.check_packages()


def test_a_bug_is_exit_code_3_with_its_traceback(capsys: Capture, monkeypatch: Patch) -> None:
    monkeypatch.setattr("tacgrasp.cli.describe.parse", lambda *_, **__: 1 / 0)
    assert main(["describe", "x.ply"]) == 3
    assert "ZeroDivisionError" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("argv", "expected"),
    [
        (["calibrate", "pad-axes", "--right", "+y", "--palm=-z"], "1"),
        (["calibrate", "gelsight-mini", "--frames"], None),
        (["bench", "latency", "--no-such-flag"], "1"),
        (["bench", "robustness", "--no-such-flag"], None),
    ],
)
def test_a_command_with_a_robot_or_that_times_the_loop_keeps_to_one_thread(
    argv: list[str], expected: str | None, monkeypatch: Patch
) -> None:
    for variable in THREADS:
        monkeypatch.setenv(variable, "9")  # so that what it was is there again afterwards
        monkeypatch.delenv(variable)
    with suppress(SystemExit):
        main(argv)
    assert {os.environ.get(variable) for variable in THREADS} == {expected}


@pytest.mark.parametrize(
    "argv",
    [
        ["calibrate", "gelsight-mini", "--balls", "none", "--diameter-mm", "6"],
        ["train", "cltp", "--data", "none", "--out", "none"],
        ["bench", "reflex", "--sensor", "taxels"],
    ],
)
def test_a_negative_seed_is_refused_before_anything_begins(argv, capsys):
    flag = "--first-seed" if argv[0] == "bench" else "--seed"
    assert main([*argv, f"{flag}=-1"]) == 2
    error = capsys.readouterr().err
    assert flag in error
    assert error.count("\n") == 1
