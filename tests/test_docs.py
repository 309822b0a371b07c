"""What the documents say must be so."""

import re

from tacgrasp.__main__ import COMMANDS
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
