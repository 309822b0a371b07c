"""The example plugin as other people get it: wheels in a clean environment."""

import os
import shutil
import subprocess
import sys
import sysconfig
import venv

import pytest

from tests.paths import ROOT

PACKAGES = ("cltp", "policies", "primitives", "sim", "tacgrasp")


def run(*argv, cwd, code=0):
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
    done = subprocess.run(
        list(map(str, argv)), cwd=cwd, env=environment, capture_output=True, text=True
    )
    assert done.returncode == code, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def clean(tmp_path_factory):
    """A new environment with both wheels; only packages of others are those of this one."""
    folder = tmp_path_factory.mktemp("wheels")
    source = folder / "source"
    source.mkdir()
    for name in (*PACKAGES, "pyproject.toml", "README.md", "LICENSE"):
        copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy
        copy(ROOT / name, source / name)
    plugin = shutil.copytree(ROOT / "examples" / "plugin", folder / "plugin")
    wheels = folder / "wheels"
    for each in (source, plugin):
        options = ["--no-deps", "--no-build-isolation", "--quiet", "--wheel-dir", wheels]
        run(sys.executable, "-m", "pip", "wheel", *options, each, cwd=folder)
    venv.create(folder / "clean", with_pip=True)
    python = folder / "clean" / "bin" / "python"
    site = next((folder / "clean" / "lib").glob("python*/site-packages"))
    (site / "others.pth").write_text(sysconfig.get_path("purelib") + "\n")
    install = ["-m", "pip", "install", "--quiet", "--no-deps", "--no-index", "--force-reinstall"]
    run(python, *install, *wheels.glob("*.whl"), cwd=folder)
    return folder


@pytest.mark.slow
def test_the_wheels_alone_run_the_plugins_task_policy_and_rig(clean):
    tacgrasp, work = clean / "clean" / "bin" / "tacgrasp", clean / "work"
    work.mkdir()
    code = "import tacgrasp, tacgrasp_raspberry as t; print(tacgrasp.__file__, t.__file__)"
    for place in run(clean / "clean" / "bin" / "python", "-c", code, cwd=work).split():
        assert place.startswith(str(clean / "clean")), place
    common = ["run", "--policy", "patient", "--seed", "1"]
    assert "success" in run(tacgrasp, *common, "--task", "raspberry", cwd=work)
    rig = clean / "plugin" / "rig.yaml"
    assert "success" in run(tacgrasp, *common, "--rig", rig, cwd=work)
    listed = run(tacgrasp, "doctor", cwd=work)
    assert listed.count("of tacgrasp-raspberry 0.1.0") == 6


@pytest.mark.slow
def test_the_contract_suites_that_are_shipped_run_on_the_plugin(clean):
    python = clean / "clean" / "bin" / "python"
    said = run(python, "-m", "pytest", "-q", "-rs", "tests", cwd=clean / "plugin")
    assert " passed" in said
