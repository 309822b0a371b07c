"""Configuration: precedence, where values came from, and one clear line for every wrong one."""

from __future__ import annotations

import re
from importlib import resources
from pathlib import Path

import pytest

from tacgrasp.base.errors import UsageError
from tacgrasp.cli.run import configure
from tacgrasp.config.hard_limits import LIMITS
from tacgrasp.config.layers import load, names
from tacgrasp.config.schema import ArmConfig, GripperConfig
from tests.paths import ROOT

MINIMAL = """
instruction: hold it
object: strawberry
goal: {force_n: [1, 2], depth_mm: [0, 1], area_share: [0, 1], x_mm: [-1, 1], y_mm: [-1, 1]}
"""


@pytest.mark.parametrize("task", ["strawberry", "egg", "cherry_tomato", "peg"])
def test_every_task_loads_and_says_what_is_asked_for(task: str) -> None:
    config, sources = load(task)
    assert len(config.instruction) > 10
    assert sources["goal.force_n"] == f"tasks/{task}.yaml"
    assert config.goal.goal().force_n.low == config.goal.force_n[0]


def test_the_tasks_go_from_gentle_to_firm() -> None:
    middle = [
        sum(load(task)[0].goal.force_n) for task in ("cherry_tomato", "strawberry", "egg", "peg")
    ]
    assert middle == sorted(middle)


def test_a_band_that_no_grip_can_keep_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "t.yaml"
    path.write_text(MINIMAL.replace("force_n: [1, 2]", "force_n: [0.5, 0.5]"))
    with pytest.raises(UsageError, match=r"at least 1\.1 times its beginning"):
        load(str(path))


def test_flags_go_over_environment_over_rig_over_task_over_defaults(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    task, rig = tmp_path / "t.yaml", tmp_path / "r.yaml"
    task.write_text(MINIMAL + "arm: {max_step_mm: 1, max_travel_mm: 11}\nloop: {max_steps: 7}\n")
    rig.write_text(
        "devices: sim\npad: {x_axis: [1, 0, 0], y_axis: [0, 0, -1]}\n"
        "arm: {workspace_low_m: [0, 0, 0], workspace_high_m: [1, 1, 1], max_step_mm: 2,"
        " max_travel_mm: 22, max_speed_m_s: 0.5}\n"
    )
    monkeypatch.setenv("TACGRASP_ARM__MAX_STEP_MM", "1.5")
    monkeypatch.setenv("TACGRASP_GRIPPER__MAX_FORCE_N", "5")
    argv = ["--task", str(task), "--rig", str(rig), "--gripper.max-force-n", "6"]
    config, sources, _ = configure(argv)
    assert config.loop.max_steps == 7
    assert config.arm.max_travel_mm == 11  # a limit may be narrowed by the task too
    assert config.arm.max_step_mm == 1.5
    assert config.gripper.max_force_n == 6
    assert sources["loop.max_asks"] == "default"
    assert sources["loop.max_steps"] == str(task)
    assert sources["arm.max_speed_m_s"] == str(rig)
    assert sources["arm.max_travel_mm"] == str(task)
    assert sources["arm.max_step_mm"] == "environment variable TACGRASP_ARM__MAX_STEP_MM"
    assert sources["gripper.max_force_n"] == "flag --gripper.max-force-n"


def test_task_and_rig_can_come_from_the_environment_and_flags_go_over_them() -> None:
    environment = {"TACGRASP_TASK": "egg"}
    assert load(environment=environment)[0].task == "egg"
    assert load("peg", environment=environment)[0].task == "peg"


def usage_error(argv: list[str]) -> str:
    with pytest.raises(UsageError) as caught:
        configure(argv)
    message = str(caught.value)
    assert "\n" not in message
    return message


BAD_FILES = {
    "unknown field": (MINIMAL + "instuction: x\n", "unknown field instuction; did you mean"),
    "unknown field inside": (MINIMAL + "loop: {max_step: 3}\n", "loop.max_step; .*max_steps"),
    "wrong unit": (MINIMAL + "verify: {lift_m: 0.04}\n", "verify.lift_m; did you mean lift_mm"),
    "slow rise above the lift": (
        MINIMAL + "verify: {lift_mm: 5, lift_off_mm: 10}\n",
        "lift_off_mm 10 is above lift_mm 5",
    ),
    "metres": (MINIMAL + "verify: {lift_mm: 0.04}\n", r"verify.lift_mm .*\[mm\], got 0.04"),
    "text for a number": (MINIMAL + "loop: {timeout_s: soon}\n", r"timeout_s .*\[s\], got 'soon'"),
    "number in quotes": (MINIMAL + "loop: {timeout_s: '9'}\n", "timeout_s .*got '9'"),
    "truth for a number": (MINIMAL + "loop: {max_steps: yes}\n", "max_steps .*got True"),
    "not finite": (MINIMAL + "verify: {hold_s: .nan}\n", "finite"),
    "section expected": (MINIMAL + "arm: 3\n", "arm must be a section"),
    "reversed band": (MINIMAL.replace("[1, 2]", "[2, 1]"), r"goal: force_n must be \[low, high\]"),
    "half a band": (MINIMAL.replace("[1, 2]", "[2]"), "goal.force_n has too few values"),
    "wrong choice": (MINIMAL + "on_failure: drop\n", "on_failure must be 'hold' or 'release'"),
    "no goal": ("instruction: x\nobject: egg\n", "must set goal"),
    "empty": ("", "must hold fields"),
    "a list": ("- 1\n", "must hold fields"),
    "not YAML": ("a: [\n", "is not YAML"),
    "a section twice": (
        MINIMAL + "arm: {max_step_mm: 1}\nloop: {max_steps: 3}\narm: {max_step_mm: 5}\n",
        "line [0-9]: arm stands in line [0-9] already; keep one",
    ),
    "an impossible date": (MINIMAL + "on_failure: 2026-02-30\n", "no possible date"),
    "a long number": (MINIMAL + f"seed: {'9' * 5000}\n", "at most 40 are read"),
    "too long": (MINIMAL + "# long\n" * 40_000, "more than 200000 bytes"),
    "names itself": (MINIMAL + "task: egg\n", "task can't be set in a file"),
    "skewed pad": (MINIMAL + "pad: {x_axis: [1, 0, 0], y_axis: [1, 0, 0]}\n", "perpendicular"),
    "half a box": (MINIMAL + "arm: {workspace_low_m: [1, 1]}\n", "workspace_low_m has too few"),
    "reversed forces": (MINIMAL + "gripper: {min_force_n: 50}\n", "min_force_n 50.* above"),
}


@pytest.mark.parametrize("name", BAD_FILES)
def test_a_bad_task_file_is_refused_in_a_line_that_names_field_and_file(
    name: str, tmp_path: Path
) -> None:
    text, expected = BAD_FILES[name]
    path = tmp_path / "mine.yaml"
    path.write_text(text)
    message = usage_error(["--task", str(path)])
    assert re.search(expected, message), message
    if "above" not in expected and "below" not in expected:  # these join task and rig
        assert "mine.yaml" in message


BAD_FLAGS = {
    "unknown task": (["--task", "banana"], "unknown task 'banana'; known: cherry_tomato"),
    "missing file": (["--task", "no.yaml"], "no.yaml does not exist"),
    "unknown rig": (["--rig", "ur5"], "unknown rig 'ur5'; known: emulated, sim"),
    "unknown flag": (["--arm.max-step-m", "4"], "--arm.max-step-m.*did you mean --arm.max-step-mm"),
    "metres": (["--arm.max-step-mm", "0.004"], r"--arm.max-step-mm must be .* \[mm\], got 0.004"),
    "text for a number": (["--arm.max-step-mm", "4mm"], "--arm.max-step-mm.*'4mm'"),
    "no value": (["--policy"], "--policy"),
    "no task": (["--task"], "--task needs a value"),
    "half a band": (["--goal.force-n", "1"], "--goal.force-n"),
    "reversed band": (["--goal.force-n", "3", "1"], r"force_n must be \[low, high\]"),
    "negative seed": (["--seed", "-1"], "--seed .*got -1"),
    "wordless": (["--instruction", ""], "--instruction .*got ''"),
    "wrong choice": (["--on-failure", "drop"], "hold.*release"),
    "too fast": (
        ["--verify.speed-m-s", "0.3", "--arm.max-speed-m-s", "0.2"],
        "verify.speed_m_s 0.3 is above arm.max_speed_m_s 0.2",
    ),
    "a stray word": (["strawberry"], "strawberry"),
}


@pytest.mark.parametrize("name", BAD_FLAGS)
def test_a_bad_flag_is_refused_in_a_line_that_names_it(name: str) -> None:
    argv, expected = BAD_FLAGS[name]
    message = usage_error(argv)
    assert re.search(expected, message), message


@pytest.mark.parametrize(
    ("variable", "value", "expected"),
    [
        ("TACGRASP_ARM__MAX_STEP_M", "4", "unknown field arm.max_step_m"),
        ("TACGRASP_ARM__MAX_STEP_MM", "4 mm", r"\[mm\], got '4 mm'"),
        ("TACGRASP_SPEED", "4", "unknown field speed"),
        ("TACGRASP_ARM", "{max_step_mm: 1, max_step_mm: 5}", "max_step_mm stands in line 1"),
        ("TACGRASP_SEED", "9" * 5000, "at most 40 are read"),
    ],
)
def test_a_bad_environment_variable_is_named(
    variable: str, value: str, expected: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(variable, value)
    message = usage_error([])
    assert message.startswith(f"environment variable {variable}: ")
    assert re.search(expected, message), message


def test_the_tasks_that_come_with_it_are_listed() -> None:
    assert names("task") == ["cherry_tomato", "egg", "fruit", "peg", "strawberry"]


def test_a_rig_file_must_say_what_has_no_default(tmp_path: Path) -> None:
    path = tmp_path / "rig.yaml"
    path.write_text("devices: sim\narm: {workspace_low_m: [0, 0, 0]}\n")
    message = usage_error(["--rig", str(path)])
    assert "rig.yaml" in message
    assert "must set arm.workspace_high_m" in message


def test_an_empty_workspace_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "rig.yaml"
    path.write_text(
        "devices: sim\narm: {workspace_low_m: [0, 0, 0], workspace_high_m: [1, 1, 0]}\n"
    )
    assert "must be below workspace_high_m" in usage_error(["--rig", str(path)])


WIDENED = {
    "flag": (
        ["--arm.max-step-mm", "6"],
        {},
        "flag --arm.max-step-mm: arm.max_step_mm must be at most the rig's hard limit 5, got 6",
    ),
    "force": (
        ["--gripper.max-force-n", "13"],
        {},
        "gripper.max_force_n must be at most .* 12, got",
    ),
    "lower force": (["--gripper.min-force-n", "0.02"], {}, "min_force_n must be at least .* 0.03"),
    "box": (
        ["--arm.workspace-high-m", "0.5", "0.1", "0.3"],
        {},
        r"workspace_high_m must be at most .* \[0.55, 0, 0.4\], got \[0.5, 0.1, 0.3\]",
    ),
    "environment": (
        [],
        {"TACGRASP_ARM__MAX_SPEED_M_S": "0.45"},
        "environment variable TACGRASP_ARM__MAX_SPEED_M_S: arm.max_speed_m_s must be at most",
    ),
    "environment, narrowed again by a flag": (
        ["--arm.max-speed-m-s", "0.4"],
        {"TACGRASP_ARM__MAX_SPEED_M_S": "0.45"},
        "environment variable TACGRASP_ARM__MAX_SPEED_M_S",
    ),
}


@pytest.mark.parametrize("name", WIDENED)
def test_flags_and_environment_can_not_widen_a_limit_of_the_rigs_file(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    argv, environment, expected = WIDENED[name]
    for variable, value in environment.items():
        monkeypatch.setenv(variable, value)
    message = usage_error(argv)
    assert re.search(expected, message), message
    assert "widened only in the rig's file (sim)" in message


def test_a_task_may_narrow_the_limits_of_the_rigs_file_and_not_widen_them(tmp_path: Path) -> None:
    task = tmp_path / "t.yaml"
    task.write_text(MINIMAL + "arm: {max_step_mm: 3}\ngripper: {max_force_n: 2}\n")
    config, sources, _ = configure(["--task", str(task)])
    assert (config.arm.max_step_mm, config.gripper.max_force_n) == (3.0, 2.0)
    assert sources["gripper.max_force_n"] == str(task)
    task.write_text(MINIMAL + "gripper: {max_force_n: 200}\n")
    message = usage_error(["--task", str(task)])
    assert "gripper.max_force_n must be at most the rig's hard limit 12, got 200" in message


def test_a_limit_that_the_rigs_file_leaves_to_its_default_can_not_be_widened_either(
    tmp_path: Path,
) -> None:
    rig = tmp_path / "r.yaml"
    rig.write_text(
        "devices: sim\npad: {x_axis: [1, 0, 0], y_axis: [0, 0, -1]}\n"
        "arm: {workspace_low_m: [0, 0, 0], workspace_high_m: [1, 1, 1]}\n"
    )
    message = usage_error(["--rig", str(rig), "--arm.max-travel-mm", "130"])
    assert "at most the rig's hard limit 120" in message


HARDWARE = ("--rig", str(ROOT / "docs/example_rig.yaml"))


@pytest.mark.parametrize(
    ("argv", "expected"),
    [
        (["--gripper.first-force-n", "0.6"], "first_force_n must be at most .* 0.5, got 0.6"),
        (["--gripper.first-force-n", "None"], "needs gripper.first_force_n"),
        (["--gripper.max-force-gain", "1.9"], "max_force_gain must be at least .* 2, got 1.9"),
    ],
)
def test_a_first_touch_can_be_made_lighter_by_flags_and_never_harder(
    argv: list[str], expected: str
) -> None:
    message = usage_error([*HARDWARE, *argv])
    assert re.search(expected, message), message
    config, _, _ = configure(
        [*HARDWARE, "--gripper.first-force-n", "0.4", "--gripper.max-force-gain", "3"]
    )
    assert (config.gripper.first_force_n, config.gripper.max_force_gain) == (0.4, 3.0)


def test_a_first_force_of_a_rigs_file_can_not_be_left_out_either(tmp_path: Path) -> None:
    rig = tmp_path / "rig.yaml"
    shipped = (ROOT / "tacgrasp/rigs/emulated.yaml").read_text()
    rig.write_text(shipped.replace("max_force_n: 12", "max_force_n: 12\n  first_force_n: 0.5"))
    message = usage_error(["--rig", str(rig), "--gripper.first-force-n", "None"])
    assert "first_force_n must be at most the rig's hard limit 0.5, got none" in message


def test_the_first_force_of_a_simulated_world_may_be_chosen() -> None:
    config, _, _ = configure(["--gripper.first-force-n", "2"])
    assert config.gripper.first_force_n == 2.0


def test_every_limit_of_force_in_a_rigs_file_is_a_hard_one() -> None:
    """docs/example_rig.yaml says that flags may narrow all of them."""
    assert {path for path in LIMITS if path.startswith("gripper.")} == {
        f"gripper.{name}" for name in GripperConfig.model_fields
    }
    assert {path for path in LIMITS if path.startswith("arm.")} == {
        f"arm.{name}" for name in ArmConfig.model_fields
    }


def test_a_task_names_the_sensor_of_a_simulated_rig_alone() -> None:
    assert load("strawberry")[0].sensor == "gelsight_mini"
    assert load("fruit")[0].sensor == "gelsight_mini_markers"
    assert load("fruit", "emulated")[0].sensor == "gelsight_mini"


def test_an_emulated_array_has_the_sensor_of_the_run_unless_its_file_names_one(
    tmp_path: Path,
) -> None:
    config, _, _ = configure(["--rig", "emulated", "--sensor", "taxels"])
    assert config.sensor == "taxels"
    shipped = (ROOT / "tacgrasp/rigs/emulated.yaml").read_text()
    named = tmp_path / "named.yaml"
    named.write_text(shipped.replace("kind: taxels", "kind: taxels\n    sensor: gelsight_mini"))
    with pytest.raises(UsageError, match=r"sensor taxels is not what hardware\.sensor is"):
        configure(["--rig", str(named), "--sensor", "taxels"])


@pytest.mark.parametrize("kind", ["task", "rig"])
def test_an_empty_name_is_no_default(kind: str) -> None:
    with pytest.raises(UsageError, match=f"--{kind} is empty; name a {kind}"):
        load(**{kind: ""})
    with pytest.raises(UsageError, match=f"TACGRASP_{kind.upper()} is empty"):
        load(environment={f"TACGRASP_{kind.upper()}": ""})


def test_paths_in_a_file_are_relative_to_it(tmp_path: Path) -> None:
    text = Path(str(resources.files("tacgrasp") / "tasks/egg.yaml")).read_text()
    (tmp_path / "mine.yaml").write_text(
        f"{text}\nobject_mesh: scan.ply\nllm: {{dir: own}}\nslip_calibration: /abs/slip.json\n"
    )
    config, sources = load(str(tmp_path / "mine.yaml"), None, {"TACGRASP_RECORD": "here"})
    assert config.object_mesh == tmp_path / "scan.ply"
    assert config.llm.dir == tmp_path / "own"
    assert config.slip_calibration == Path("/abs/slip.json")
    assert config.record == Path("here")  # of a variable: to the current folder
    assert sources["object_mesh"] == str(tmp_path / "mine.yaml")
