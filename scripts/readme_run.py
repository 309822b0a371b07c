"""Run what the README shows, and put its lines and its picture there anew.

``python scripts/readme_run.py`` writes both. A test compares the lines with those of a new run.
"""

from __future__ import annotations

import re
import tempfile
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path

from PIL import Image

from tacgrasp.__main__ import main

ROOT = Path(__file__).resolve().parents[1]
PICTURE = ROOT / "docs/figures/strawberry.png"
COMMAND = re.compile(r"^\$ tacgrasp (run .*--seed \d+)$", re.M)
"""The command of the README, whose lines follow up to the end of the block."""

EPISODE = re.compile(r"episode: \S+")
"""What differs from run to run: the episode's name, which holds its date."""


def shown(readme: str) -> tuple[str, int, int]:
    """The command of the README, and where the lines that it shows begin and end.

    Raises:
        ValueError: The text shows no run.
    """
    found = COMMAND.search(readme)
    if found is None:
        raise ValueError("the text shows no run: a line '$ tacgrasp run ... --seed N' is missing")
    begin = found.end() + 1
    return found[1], begin, readme.index("```", begin)


def printed(command: str, folder: Path) -> str:
    """What a run prints; its episode is recorded in ``folder``."""
    text = StringIO()
    with redirect_stdout(text):
        main([*command.split(), "--record", str(folder)])
    return text.getvalue().replace(f"{folder}/", "episodes/")


def without_episode(lines: str) -> str:
    """Lines of a run without the name of its episode."""
    return EPISODE.sub("episode: #", lines)


def write() -> None:
    """Run the command; write its lines into the README and its picture beside the pages."""
    readme = ROOT / "README.md"
    text = readme.read_text(encoding="utf-8")
    command, begin, end = shown(text)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        after = printed(command, folder)
        (episode,) = folder.glob("*.mcap")
        with redirect_stdout(StringIO()):
            main(["episodes", "plot", str(episode), "--out", str(folder / "plot.png")])
        picture = Image.open(folder / "plot.png").convert("RGB")
    picture.quantize(128).save(PICTURE, optimize=True)
    readme.write_text(text[:begin] + after + text[end:], encoding="utf-8")


if __name__ == "__main__":
    write()
