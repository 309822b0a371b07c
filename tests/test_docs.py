"""What the documents say must be so."""

import importlib.util
import re

import pytest

from tacgrasp.__main__ import COMMANDS
from tacgrasp.cli.bench import BENCHMARKS
from tacgrasp.config.layers import load
from tests.paths import ROOT

DOCS = ROOT / "docs"
NAVIGATION = (ROOT / "mkdocs.yml").read_text()


def script(name):
    """A script of the repository, as a module."""
    spec = importlib.util.spec_from_file_location(name, ROOT / "scripts" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


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


def test_links_of_the_readme_and_its_neighbours_lead_somewhere():
    for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md"):
        for target in re.findall(r"\]\(([\w./-]+)(?:#[\w-]+)?\)", (ROOT / name).read_text()):
            assert (ROOT / target).exists(), f"{name}: {target}"


def test_the_pages_and_the_readme_name_commands_that_exist():
    texts = [page.read_text() for page in (ROOT / "README.md", *DOCS.glob("*.md"))]
    blocks = [block for text in texts for block in re.findall(r"```.*?```", text, re.S)]
    words = set(re.findall(r"`tacgrasp ([a-z]+)", " ".join(texts)))
    words |= set(re.findall(r"^(?:\$ |\.venv/bin/)?tacgrasp ([a-z]+)", "\n".join(blocks), re.M))
    assert len(words) > 15
    assert words <= COMMANDS.keys()


def test_every_page_stands_in_the_list_of_pages_and_no_other():
    listed = set(re.findall(r": ([\w/-]+\.md)$|- (commands/index\.md)$", NAVIGATION, re.M))
    listed = {page for pair in listed for page in pair if page}
    of_root = {"index.md", "contributing.md", "changelog.md"}
    commands = {f"commands/{name}.md" for name in (*COMMANDS, "index")}
    written = {page.name for page in DOCS.glob("*.md")}
    assert listed >= of_root | commands
    assert listed - of_root - commands <= written


def test_links_that_leave_the_pages_become_paths_and_others_stay():
    relinked = script("docs_hooks").relinked
    assert relinked("[plugins](docs/plugins.md#x)", "index.md") == "[plugins](plugins.md#x)"
    assert relinked("![a](docs/figures/a.png)", "index.md") == "![a](figures/a.png)"
    assert relinked("[world](world.md)", "hardware.md") == "[world](world.md)"
    assert relinked("[rules](../CONTRIBUTING.md)", "api.md") == "[rules](contributing.md)"
    assert relinked("[examples](../examples)", "api.md") == "`examples`"
    assert relinked("[one](../examples/plugin)", "api.md") == "one (`examples/plugin`)"
    assert relinked("[gone](../nowhere.md)", "api.md") == "[gone](../nowhere.md)"


def test_every_command_has_a_page_with_its_own_help(tmp_path, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setenv("NO_COLOR", "1")
    pages = script("command_pages")
    pages.write_pages(tmp_path)
    assert {path.stem for path in tmp_path.iterdir()} == {"index", *COMMANDS}
    for name, words in (
        ("run", "--policy STR"),
        ("eval", "## eval questions"),
        ("why", "usage: tacgrasp why "),
    ):
        text = (tmp_path / f"{name}.md").read_text()
        assert words in text
        assert "\x1b" not in text
    for name in BENCHMARKS:
        assert f"usage: tacgrasp bench {name} " in (tmp_path / "bench.md").read_text()


def test_the_results_are_those_of_the_weights_that_come_along():
    card = (ROOT / "policies/weights/README.md").read_text().split("## Scores")[1]
    scores = {
        name: float(value) for name, value in re.findall(r"^\| (.+?) \| ([\d.]+) \|$", card, re.M)
    }
    shown = (DOCS / "results.md").read_text()
    rows = {
        "captions of the language model": "captions, llm",
        "heads of the encoder": "captions, heads",
        "zero-shot, by the nearest prompt": "zero-shot",
    }
    for row, name in rows.items():
        cells = re.search(rf"^\| {row} \|(.+)\|$", shown, re.M)[1].split("|")
        parts = ("shape", "texture", "depth", "position", "area")
        expected = [100 * scores[f"{name}, {part}"] for part in parts]
        assert [float(cell) for cell in cells] == pytest.approx(expected, abs=0.051), row
    errors = re.search(r"depth ([\d.]+) mm, position ([\d.]+) mm,\s+force ([\d.]+) %", shown)
    names = ("depth_mm", "position_mm", "force_percent")
    expected = [scores[f"median error, llm, {name}"] for name in names]
    assert [float(value) for value in errors.groups()] == pytest.approx(expected, rel=0.05)
    answers = float(re.search(r"never saw (\d+) % of the answers are right", shown)[1])
    assert answers == pytest.approx(100 * scores["answers to held-out wordings, mean"], abs=0.51)


@pytest.mark.slow
def test_the_pages_quote_the_run_that_the_readme_shows():
    readme = script("readme_run")
    text = (ROOT / "README.md").read_text()
    _, begin, end = readme.shown(text)
    rows = re.findall(r"^\| `(.*?)` \|", (DOCS / "quick-start.md").read_text(), re.M)
    gain = re.findall(r"^(gripper: presses .*)$", (DOCS / "contract.md").read_text(), re.M)
    assert len(rows) > 5 and gain
    quoted = [part for row in [*rows, *gain] for part in row.split("…")]
    assert [part for part in quoted if part.strip(" “") not in text[begin:end]] == []


def test_the_readme_shows_a_run_as_it_prints_now(tmp_path):
    readme = script("readme_run")
    text = (ROOT / "README.md").read_text()
    command, begin, end = readme.shown(text)
    printed = readme.printed(command, tmp_path)
    shown = readme.without_episode(text[begin:end])
    assert "success" in shown
    assert readme.without_episode(printed) == shown, "python scripts/readme_run.py writes it anew"
