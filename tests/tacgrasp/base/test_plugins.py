"""What other packages add: found, used by name, and named when broken."""

import subprocess
import sys

import pytest

from cltp import TouchError
from tacgrasp import api
from tacgrasp.__main__ import main
from tacgrasp.base.errors import UsageError
from tacgrasp.base.plugins import GROUPS, plugins
from tacgrasp.config.layers import load
from tests.fakes.installed_plugin import EXAMPLE, install, install_example
from tests.paths import ROOT

RIG = EXAMPLE / "rig.yaml"


@pytest.fixture(autouse=True)
def fresh():
    """Plugins are looked for once a process; here before and after each test."""
    plugins.cache_clear()
    yield
    plugins.cache_clear()


@pytest.fixture
def example(tmp_path, monkeypatch):
    install_example(tmp_path / "installed", monkeypatch)


def broken(tmp_path, monkeypatch, group, code, name="theirs"):
    """A plugin whose module holds this code."""
    folder = tmp_path / "broken"
    install(folder, monkeypatch, {f"tacgrasp.{group}": {name: "their_module:thing"}})
    monkeypatch.delitem(sys.modules, "their_module", raising=False)
    (folder / "their_module.py").write_text(code)


def complaint(argv, capsys, code=2):
    assert main(argv) == code
    printed = capsys.readouterr()
    assert "Traceback" not in printed.err
    assert printed.err.count("\n") == 1, printed.err
    return printed.err


def test_the_example_adds_one_of_everything(example):
    assert [len(plugins(group)) for group in GROUPS] == [1] * len(GROUPS)
    assert plugins("policies")["patient"].package == "tacgrasp-raspberry 1.2"


def test_its_task_object_and_policy_run_on_the_simulated_rig(example, tmp_path, capsys):
    argv = ["run", "--task", "raspberry", "--policy", "patient", "--seed", "1"]
    assert main([*argv, "--record", str(tmp_path)]) == 0
    printed = capsys.readouterr().out
    assert "raspberry with patient" in printed
    assert "Grasp completed successfully" in printed


def test_its_arm_gripper_and_sensor_are_a_rig(example, tmp_path, capsys):
    argv = ["run", "--policy", "patient", "--rig", str(RIG), "--verify.hold-s", "0.1"]
    assert main([*argv, "--record", str(tmp_path)]) == 0
    assert "By touch: held" in capsys.readouterr().out
    (path,) = tmp_path.glob("*.mcap")
    assert main(["replay", "--decide", str(path)]) == 0  # its settings come back out of the record
    assert "0 differ" in capsys.readouterr().out


def test_doctor_lists_all_of_it_and_checks_its_devices(example, capsys):
    main(["doctor", "--rig", str(RIG)])
    lines = capsys.readouterr().out.splitlines()
    for group in GROUPS:
        (line,) = [line for line in lines if line.startswith("plugin") and f" {group} " in line]
        assert "ok" in line.split()
        assert "of tacgrasp-raspberry 1.2" in line
    assert any(line.startswith("gripper  bench") for line in lines)


def test_its_settings_are_checked_by_its_own_model(example, tmp_path, capsys):
    text = RIG.read_text().replace("max_force_n: 12}", "max_force_n: -1}")
    (tmp_path / "rig.yaml").write_text(text)
    message = complaint(["run", "--rig", str(tmp_path / "rig.yaml")], capsys)
    assert "gripper.max_force_n: Input should be greater than 0, got -1" in message
    text = RIG.read_text().replace("bench: left}", "bnch: left}", 1)
    (tmp_path / "rig.yaml").write_text(text)
    message = complaint(["run", "--rig", str(tmp_path / "rig.yaml")], capsys)
    assert "arm.bench is missing" in message or "unknown field arm.bnch" in message


def test_the_limits_of_a_task_are_held_against_a_plugins_arm(example, tmp_path, capsys):
    text = RIG.read_text().replace("bench: left}", "bench: left, max_speed_m_s: 0.1}", 1)
    (tmp_path / "rig.yaml").write_text(text)
    message = complaint(["run", "--rig", str(tmp_path / "rig.yaml")], capsys)
    assert "arm.max_speed_m_s 0.4 is above hardware.arm.max_speed_m_s 0.1" in message


def test_commands_for_our_own_devices_say_so(example, capsys):
    message = complaint(["calibrate", "gripper", "--rig", str(RIG), "--date", "2026-01-01"], capsys)
    assert "of kind dynamixel alone, the rig's is raspberry_gripper" in message


def test_the_source_of_a_plugins_task_is_its_package(example):
    config, sources = load("raspberry")
    assert config.object == "raspberry"
    assert sources["goal.force_n"] == "task raspberry of tacgrasp-raspberry 1.2"
    run = api.configure("raspberry")
    assert not run.contract.insists  # its own band is the task's, not a demand of the caller


def test_unknown_names_are_answered_with_those_of_plugins_too(example, capsys):
    assert "random, remote, patient" in complaint(["run", "--policy", "gut"], capsys)
    assert "strawberry, raspberry, or the path" in complaint(["run", "--task", "gut"], capsys)
    assert "peg, raspberry" in complaint(["run", "--object", "anvil"], capsys)


def test_an_unknown_kind_of_device_is_answered_with_those_of_plugins_too(example, tmp_path, capsys):
    (tmp_path / "rig.yaml").write_text(RIG.read_text().replace("raspberry_pad", "finger"))
    message = complaint(["run", "--rig", str(tmp_path / "rig.yaml")], capsys)
    assert "hardware.sensor.kind must be one of gelsight_mini, taxels, recorded" in message
    assert "raspberry_pad, got 'finger'" in message


BROKEN = {
    "import": ("import no_such_module", "ModuleNotFoundError: No module named 'no_such_module'"),
    "bug": ("1 / 0", "ZeroDivisionError"),
    "exit": ("raise SystemExit(3)", "SystemExit: 3"),
    "syntax": ("def", "SyntaxError"),
    "missing": ("", "has no attribute 'thing'"),
    "lines": ("raise ValueError('a\\nb')", "ValueError: a b"),
}


@pytest.mark.parametrize("name", BROKEN)
@pytest.mark.parametrize("group", ["policies", "tasks", "objects"])
def test_a_broken_plugin_is_named_when_it_is_asked_for(group, name, tmp_path, monkeypatch, capsys):
    code, expected = BROKEN[name]
    broken(tmp_path, monkeypatch, group, code)
    flag = {"policies": "--policy", "tasks": "--task", "objects": "--object"}[group]
    policy = [] if group == "policies" else ["--policy", "rules"]
    message = complaint(["run", flag, "theirs", *policy], capsys)
    assert f"theirs of their-package 1.2 (tacgrasp.{group}) is left out: " in message
    assert expected in message
    assert "uninstall their-package" in message


@pytest.mark.parametrize("group", GROUPS)
def test_a_plugin_that_gives_something_else_is_named_by_doctor(
    group, tmp_path, monkeypatch, capsys
):
    broken(tmp_path, monkeypatch, group, "thing = 5")
    assert main(["doctor"]) == 1
    (line,) = [line for line in capsys.readouterr().out.splitlines() if "theirs" in line]
    assert "NOT OK" in line
    assert "expected " in line
    assert "runs go on without it" in line


def test_runs_that_do_without_a_broken_plugin_do_not_notice_it(tmp_path, monkeypatch, capsys):
    broken(tmp_path, monkeypatch, "policies", "raise SystemExit(3)")
    argv = ["run", "--policy", "rules", "--seed", "6", "--record", str(tmp_path)]
    assert main(argv) == 0
    assert "their-package" not in "".join(capsys.readouterr())


def test_a_name_of_our_own_can_not_be_taken(tmp_path, monkeypatch, capsys):
    broken(tmp_path, monkeypatch, "policies", "raise SystemExit(3)", name="rules")
    argv = ["run", "--policy", "rules", "--seed", "6", "--record", str(tmp_path)]
    assert main(argv) == 0
    capsys.readouterr()
    assert main(["doctor"]) == 1
    assert "rules is a name of tacgrasp's own" in capsys.readouterr().out


def test_of_two_packages_with_one_name_the_first_is_taken_and_the_other_named(
    tmp_path, monkeypatch, capsys
):
    point = {"tacgrasp.policies": {"theirs": "their_module:thing"}}
    install(tmp_path / "b", monkeypatch, point, name="b-package")
    install(tmp_path / "a", monkeypatch, point, name="a-package")
    assert plugins("policies")["theirs"].package == "a-package 1.2"
    assert main(["doctor"]) == 1
    assert "of a-package 1.2 (tacgrasp.policies) is taken, and that of b-package 1.2" in (
        capsys.readouterr().out
    )


def test_a_policy_that_can_not_be_made_is_named(tmp_path, monkeypatch, capsys):
    broken(tmp_path, monkeypatch, "policies", "def thing(config): return config.no_such")
    assert "made no policy: AttributeError" in complaint(["run", "--policy", "theirs"], capsys)


def test_something_that_is_no_policy_is_named(tmp_path, monkeypatch, capsys):
    broken(tmp_path, monkeypatch, "policies", "thing = lambda config: 'a policy'")
    message = complaint(["run", "--policy", "theirs"], capsys)
    assert "made a policy without name, decide, start" in message


def test_a_driver_that_can_not_connect_is_a_fault_of_its_plugin(
    example, tmp_path, monkeypatch, capsys
):
    monkeypatch.setattr("tacgrasp_raspberry.sdk.join", lambda *_: 1 / 0)
    argv = ["run", "--policy", "rules", "--rig", str(RIG), "--record", str(tmp_path)]
    message = complaint(argv, capsys, code=3)
    assert "raspberry_pad (tacgrasp.sensors) failed to connect: ZeroDivisionError" in message


def test_an_object_of_a_plugin_is_refused_by_the_emulated_rig(example):
    run = api.configure("raspberry", "emulated", policy="rules")
    with pytest.raises(UsageError, match="emulators know no object of a plugin"), api.connect(run):
        pass


def test_help_and_import_look_for_no_plugin(tmp_path, monkeypatch):
    broken(tmp_path, monkeypatch, "policies", "raise SystemExit(3)")
    code = (
        "import sys, tacgrasp; from tacgrasp.__main__ import main; main(['--help']); "
        "print('importlib.metadata' in sys.modules, 'their_module' in sys.modules)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout.splitlines()[-1].endswith("False")


RAISES = """
class Theirs:
    name = "theirs"
    def start(self): {start}
    def decide(self, observation, contract): {decide}

def thing(config): return Theirs()
"""


@pytest.mark.parametrize(
    ("start", "decide", "expected"),
    [
        ("pass", "1 / 0", "its decide raised ZeroDivisionError: division by zero (their_module.py"),
        ("pass", "raise SystemExit(0)", "its decide raised SystemExit: 0 (their_module.py"),
        ("pass", "return None", "the policy replied None; expected a Decision"),
        ("{}['x']", "pass", "its start raised KeyError: 'x'"),
    ],
)
def test_a_policy_that_breaks_ends_the_run_as_a_fault_of_the_plugin(
    start, decide, expected, tmp_path, monkeypatch, capsys
):
    broken(tmp_path, monkeypatch, "policies", RAISES.format(start=start, decide=decide))
    record = tmp_path / "episodes"
    argv = ["run", "--policy", "theirs", "--record", str(record)]
    assert main(argv) == 3
    printed = capsys.readouterr()
    assert "Traceback" not in printed.out + printed.err
    said = " ".join(printed.out.split())
    assert "end: fault" in said
    assert "the plugin theirs of their-package 1.2 (tacgrasp.policies)" in said
    assert expected in said
    assert main(["why", str(next(record.glob("*.mcap")))]) == 1
    why = " ".join(capsys.readouterr().out.split())
    assert "the plugin theirs of their-package 1.2 (tacgrasp.policies)" in why
    assert expected in why


def test_a_policy_of_a_plugin_raises_what_a_policy_may_raise(tmp_path, monkeypatch):
    code = RAISES.format(start="pass", decide="raise TouchError('no cloud')")
    broken(tmp_path, monkeypatch, "policies", "from cltp import TouchError\n" + code)
    run = api.configure("strawberry", policy="theirs")
    with pytest.raises(TouchError, match=r"^no cloud$"):
        api.make_policy(run).decide(None, run.contract)
