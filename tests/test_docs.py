"""What the documents say must be so."""

import re

import pytest

from tacgrasp.__main__ import COMMANDS, main
from tacgrasp.config.layers import load
from tests.paths import ROOT

DOCS = ROOT / "docs"


def test_the_annotated_example_is_a_rig_file_that_loads():
    config, sources = load("strawberry", str(DOCS / "example_rig.yaml"))
    assert config.devices == "hardware"
    assert config.hardware.gripper.calibration == DOCS / "gripper_calibration.yaml"
    assert config.hardware.sensor.background == DOCS / "background.png"
    assert config.hardware.arm.workspace_low_m == config.arm.workspace_low_m
    assert sources["hardware.arm.host"].endswith("example_rig.yaml")


def test_the_commands_of_the_hardware_page_exist():
    named = re.findall(r"tacgrasp (\w+)", (DOCS / "hardware.md").read_text())
    assert named
    assert {name for name in named if name != "is"} <= COMMANDS.keys()


def test_links_between_the_pages_lead_somewhere():
    for page in DOCS.glob("*.md"):
        for target in re.findall(r"\]\(([\w./-]+)\)", page.read_text()):
            assert (page.parent / target).exists(), f"{page.name}: {target}"


def masked(lines):
    """Lines of the steps of a run without their numbers."""
    steps = [line for line in lines if " felt " in line or "→ " in line]
    return [" ".join(re.sub(r"[+-]?\d+(\.\d+)?", "#", line).split()) for line in steps]


@pytest.mark.slow
def test_the_readme_shows_a_run_as_it_prints_now(tmp_path, capsys):
    text = (ROOT / "README.md").read_text()
    command = re.search(r"^\$ tacgrasp (run .*--seed \d+)$", text, re.M)[1]
    shown = text[text.index(command) :].split("```")[0].splitlines()
    assert main([*command.split(), "--record", str(tmp_path)]) == 0
    printed = capsys.readouterr().out.splitlines()
    assert masked(printed) == masked(shown), "run the command and copy what it prints"
