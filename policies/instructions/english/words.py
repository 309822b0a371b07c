"""Words of instructions by what they mean, read from ``words.txt``."""

from __future__ import annotations

import re
from functools import lru_cache
from importlib import resources

_PLACEHOLDER = re.compile(r"\{([a-z_]+)\}")


@lru_cache(maxsize=1)
def _sections() -> dict[str, list[list[str]]]:
    """Groups of lines of each section, comments left out."""
    text = (resources.files("policies.instructions") / "words.txt").read_text("utf-8")
    sections: dict[str, list[list[str]]] = {}
    groups: list[list[str]] = []
    for line in text.splitlines():
        if re.fullmatch(r"\[[a-z_]+\]", line):
            groups = sections.setdefault(line[1:-1], [[]])
        elif not line:
            groups.append([])
        elif not line.startswith("# "):
            groups[-1].append(line)
    return {name: [group for group in groups if group] for name, groups in sections.items()}


def _filled(pattern: str) -> str:
    return _PLACEHOLDER.sub(lambda match: any_of(match[1]), pattern)


def any_of(section: str) -> str:
    """One pattern for any line of a section."""
    lines = [line for group in _sections()[section] for line in group]
    return f"(?:{_filled('|'.join(lines))})"


def groups(section: str) -> tuple[re.Pattern[str], ...]:
    """One pattern for each group of a section, in their order."""
    return tuple(re.compile(_filled("|".join(group))) for group in _sections()[section])


def word_list(section: str) -> frozenset[str]:
    """The words of a section of plain words."""
    return frozenset(" ".join(line for group in _sections()[section] for line in group).split(" "))


HOLD = re.compile(rf"\b{any_of('hold')}\b")
"""A word that asks to take hold of something."""
