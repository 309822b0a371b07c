"""openpi's own client, unmodified, in an environment of its own (it needs numpy below 2)."""

import json
import subprocess
import sys

import pytest

from policies.rules import RulesPolicy
from tests.fakes.policy_servers import served
from tests.paths import ROOT

PYTHON = ROOT / ".venv-openpi" / "bin" / "python"
"""Made by ``make test-openpi``."""


@pytest.mark.skipif(not PYTHON.exists(), reason="no .venv-openpi: run make test-openpi")
def test_openpis_client_is_answered():
    robot = ROOT / "tests" / "fakes" / "peers" / "openpi_robot.py"
    with served(lambda: RulesPolicy(move_step_mm=3.0)) as url:
        port = url.rpartition(":")[2]
        done = subprocess.run([PYTHON, robot, port], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    said = json.loads(done.stdout)
    sys.stdout.write(done.stdout)
    assert said["versions"]["numpy"].startswith("1.")
    assert said["metadata"]["server"] == "tacgrasp"
    assert [each["primitive"] for each in said["answers"]] == [
        "move_down",
        "increase_force",
        "decrease_force",
    ]
    expected = {"actions", "text", "primitive", "success", "confidence", "contract"}
    assert all(each.keys() >= expected for each in said["answers"])
    assert said["answers"][0]["actions"] == [[0.0, -1.0, 0.0, 0.0]]
    assert "the key observation/tactile_points is missing" in said["error"]
