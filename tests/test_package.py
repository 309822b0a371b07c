"""The distribution: its ranges, its version, and what lies in the wheel."""

import re
import shutil
import subprocess
import sys
import tomllib
import zipfile
from email import message_from_bytes
from pathlib import Path

import pytest
import yaml
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from tacgrasp import __version__
from tests.paths import ROOT

PACKAGES = ("cltp", "policies", "primitives", "sim", "tacgrasp")
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
EXTRAS = {"export", "gym", "hardware", "lora", "scale", "serve", "tensorboard", "view", "dev"}


def requirements():
    """Every requirement of the core and of the extras."""
    listed = [PROJECT["dependencies"], *PROJECT["optional-dependencies"].values()]
    return [Requirement(text) for group in listed for text in group]


def locked():
    """The version of each package in the locks of the core and of the viewer."""
    files = ("requirements.lock", "requirements-view.lock")
    lines = [line for name in files for line in (ROOT / name).read_text().splitlines()]
    pairs = [line.split("==") for line in lines if "==" in line]
    return {canonicalize_name(name): version for name, version in pairs}


def test_the_package_names_ranges_and_leaves_the_hubs_client_to_transformers():
    assert all(one.operator != "==" for each in requirements() for one in each.specifier)
    assert "huggingface-hub" not in {canonicalize_name(each.name) for each in requirements()}
    assert set(PROJECT["optional-dependencies"]) == EXTRAS


def test_what_was_tested_together_lies_within_the_ranges():
    versions = locked()
    unlocked = {
        each.name for each in requirements() if canonicalize_name(each.name) not in versions
    }
    assert unlocked == {"tensorboard"}
    for each in requirements():
        if each.name not in unlocked:
            version = versions[canonicalize_name(each.name)]
            assert each.specifier.contains(version, prereleases=True), f"{each}: {version}"


def test_the_version_stands_in_one_place_and_the_citation_agrees():
    assert "version" not in PROJECT
    assert yaml.safe_load((ROOT / "CITATION.cff").read_text())["version"] == __version__
    newest = re.search(r"^## (\S+)", (ROOT / "CHANGELOG.md").read_text(), re.M)[1]
    assert newest == __version__


def test_each_extra_that_a_message_names_exists():
    named = {
        extra
        for package in PACKAGES
        for path in (ROOT / package).rglob("*.py")
        for extra in re.findall(r"tacgrasp\[(\w+)\]", path.read_text(encoding="utf-8"))
    }
    assert named
    assert named <= PROJECT["optional-dependencies"].keys()


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """The wheel, made of copies of the packages."""
    folder = tmp_path_factory.mktemp("wheel")
    source = folder / "source"
    source.mkdir()
    for name in (*PACKAGES, "pyproject.toml", "README.md", "LICENSE"):
        copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy
        copy(ROOT / name, source / name)
    options = ["--no-deps", "--no-build-isolation", "--quiet", "--wheel-dir", folder]
    command = [sys.executable, "-m", "pip", "wheel", *map(str, options), str(source)]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    (path,) = folder.glob("*.whl")
    with zipfile.ZipFile(path) as archive:
        yield archive


@pytest.mark.slow
def test_every_file_of_the_packages_lies_in_the_wheel_and_nothing_else(wheel):
    written = {
        path.relative_to(ROOT).as_posix()
        for package in PACKAGES
        for path in (ROOT / package).rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    packed = {name for name in wheel.namelist() if ".dist-info/" not in name}
    assert packed == written


@pytest.mark.slow
def test_the_wheel_says_what_it_is_and_names_no_single_version(wheel):
    (name,) = [name for name in wheel.namelist() if name.endswith(".dist-info/METADATA")]
    facts = message_from_bytes(wheel.read(name))
    assert facts["Version"] == __version__
    assert set(facts.get_all("Provides-Extra")) == EXTRAS
    assert not [line for line in facts.get_all("Requires-Dist") if "==" in line.split(";")[0]]
    assert facts.get_payload().startswith("# tacgrasp")
    assert Path(name).parent.name == f"tacgrasp-{__version__}.dist-info"
