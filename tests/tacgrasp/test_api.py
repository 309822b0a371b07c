"""tacgrasp from Python, and the ten lines of its page."""

import re
import subprocess
import sys

import pytest

from primitives import LimitError
from tacgrasp import api
from tacgrasp.base.errors import UsageError
from tacgrasp.episodes import read_episode
from tests.paths import ROOT


def test_the_lines_of_the_page_run_an_episode_and_read_its_outcome(tmp_path, monkeypatch, capsys):
    text = (ROOT / "docs/api.md").read_text(encoding="utf-8")
    code = re.search(r"```python\n(.*?)```", text, re.S)[1]
    assert len(code.strip().splitlines()) <= 10
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    exec(compile(code, "docs/api.md", "exec"), names)
    assert "success" in capsys.readouterr().out
    (path,) = (tmp_path / "episodes").glob("*.mcap")
    assert read_episode(path).end.reason == "success"


def test_values_are_laid_over_task_and_rig_as_flags_are(tmp_path):
    run = api.configure("egg", seed=5, arm={"max_step_mm": 4.0}, goal={"force_n": [1.0, 1.2]})
    assert (run.config.seed, run.config.arm.max_step_mm) == (5, 4.0)
    assert run.config.arm.max_speed_m_s == api.configure("egg").config.arm.max_speed_m_s
    assert (run.contract.force_n.low, run.contract.force_n.high) == (1.0, 1.2)
    assert run.contract.insists  # a force that is named in the call stands against what is felt


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        ({"sed": 1}, "unknown field sed; did you mean seed"),
        ({"arm": {"max_step_mm": 400.0}}, "arm.max_step_mm must be"),
        ({"arm": {"max_travel_mm": 2000.0}}, "at most the rig's hard limit"),
        ({"hardware": {}}, "hardware is chosen by the names of task and rig"),
        ({"devices": "hardware"}, "devices is chosen by"),
    ],
)
def test_a_wrong_value_is_refused_in_one_line(values, expected):
    with pytest.raises(UsageError, match=expected) as caught:
        api.configure(**values)
    assert "\n" not in str(caught.value)


def test_a_refused_instruction_moves_nothing(tmp_path):
    run = api.configure(policy="rules", instruction="Drop it.", record=tmp_path)
    assert run.contract.refused
    with api.connect(run) as rig, pytest.raises(LimitError, match="refused"):
        api.run_episode(run, rig, api.make_policy(run))
    assert rig.truth().peak_force_n == 0


def test_the_rig_is_freed_at_the_end_of_the_block_and_after_an_error():
    run = api.configure(policy="rules")
    with pytest.raises(ZeroDivisionError), api.connect(run) as rig:
        raise ZeroDivisionError
    with pytest.raises(Exception, match="disconnected"):
        rig.arm.pose()


def test_a_sensor_that_plays_a_recording_grasps_nothing_from_python_either(tmp_path):
    text = (ROOT / "docs" / "example_rig.yaml").read_text(encoding="utf-8")
    begin, end = text.index("  sensor:\n"), text.index("  start:")
    path = tmp_path / "rig.yaml"
    path.write_text(f"{text[:begin]}  sensor: {{kind: recorded, path: frames}}\n{text[end:]}")
    with (
        pytest.raises(UsageError, match="plays a recording"),
        api.connect(api.configure(rig=str(path))),
    ):
        pass


def test_importing_the_api_loads_neither_torch_nor_open3d():
    code = "import sys; import tacgrasp.api; print({'torch', 'open3d'} & set(sys.modules))"
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "set()"


@pytest.mark.parametrize("package", ["cltp", "policies", "primitives", "sim", "tacgrasp"])
def test_every_package_tells_type_checkers_that_it_is_typed(package):
    assert (ROOT / package / "py.typed").is_file()
    listed = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    assert re.search(rf'^{package} = \[\s*"py.typed"', listed, re.M)
