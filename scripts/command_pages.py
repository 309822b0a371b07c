"""Write a page for each command of ``tacgrasp`` from the help that it prints itself.

Run it as ``python scripts/command_pages.py docs/commands``; ``make docs`` does. The pages are not
stored in the repository, so that none can differ from the help.
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Sequence
from contextlib import redirect_stdout, suppress
from io import StringIO
from pathlib import Path

from tacgrasp.__main__ import COMMANDS, main, usage
from tacgrasp.cli.eval_methods import COMMANDS as EVALUATIONS

WIDTH = "88"
"""Columns of a help text: what a page shows on a screen of 1280 pixels without scrolling."""


def help_text(*words: str) -> str:
    """What ``tacgrasp WORDS --help`` prints."""
    text = StringIO()
    with redirect_stdout(text), suppress(SystemExit):  # how tyro ends a help text
        main([*words, "--help"])
    return "\n".join(line.rstrip() for line in text.getvalue().splitlines()).strip()


def subcommands(command: str, text: str) -> Sequence[str]:
    """Names of a command's subcommands, as its help lists them."""
    if command == "eval":  # works without a subcommand too, and its help is of that
        return list(EVALUATIONS)
    listed = re.match(rf"usage: tacgrasp {command} {{([\w,-]+)}} \[OPTIONS\]", text)
    return listed[1].split(",") if listed else []


def page(command: str) -> str:
    """The page of one command: its help, and that of each of its subcommands."""
    own = help_text(command)
    parts = [
        f"# tacgrasp {command}\n\n{COMMANDS[command][0].upper()}{COMMANDS[command][1:]}.\n",
        f"```text\n{own}\n```\n",
    ]
    for name in subcommands(command, own):
        parts.append(f"## {command} {name}\n\n```text\n{help_text(command, name)}\n```\n")
    return "\n".join(parts)


def write_pages(folder: Path) -> None:
    """Write one page for each command, and a first one that lists them."""
    os.environ["COLUMNS"] = WIDTH
    os.environ["NO_COLOR"] = "1"
    folder.mkdir(parents=True, exist_ok=True)
    rows = "\n".join(f"| [{name}]({name}.md) | {text} |" for name, text in COMMANDS.items())
    table = f"# Commands\n\n| command | what it does |\n|---|---|\n{rows}\n"
    first = f"{table}\n```text\n{usage()}\n```\n"
    (folder / "index.md").write_text(first, encoding="utf-8")
    for name in COMMANDS:
        (folder / f"{name}.md").write_text(page(name), encoding="utf-8")


if __name__ == "__main__":
    write_pages(Path(sys.argv[1]))
