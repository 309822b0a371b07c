"""Files of results: whole or absent, never in the place of a file that is no earlier result.

Not here: episodes (``tacgrasp.episodes.writer``), weights (``cltp.checkpoints``).
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from cltp.atomic_write import write_atomically
from tacgrasp.base.errors import UsageError

WRITTEN_BY, WRITER = "written_by", "tacgrasp"
"""The key, and its value, that a result begins with."""

PAGE_WRITTEN_BY = "Written by `tacgrasp "
"""Words by which a page of Markdown is known as a result."""


def check_ending(path: Path, *endings: str, flag: str = "--out") -> None:
    """Check that a result goes to a file of its own kind, so that it replaces no other.

    Args:
        path: Where to; a link is followed. A pipe, a terminal or a folder passes.
        *endings: The endings of the kind, with their dot, in small letters.
        flag: Flag that named the path, for the message.

    Raises:
        UsageError: The path ends otherwise.
    """
    if path.exists() and not path.is_file():
        return
    if path.resolve().suffix.lower() not in endings:
        raise UsageError(f"{flag} expects a file ending in {' or '.join(endings)}, got {path}")


def check_kept(path: Path, *, overwrite: bool) -> None:
    """Refuse to write over a file that took somebody a measurement, before the next one begins.

    Raises:
        UsageError: The file exists, and may not be replaced.
    """
    if path.exists() and not overwrite:
        raise UsageError(
            f"{path} exists and is kept; give --overwrite to replace it, or another file by --out"
        )


def check_replaceable(path: Path, *, flag: str = "--json") -> None:
    """Check that a file in the place of a result is an earlier one, so that nothing else is lost.

    An empty file is replaced too. Pictures, tables and pages of HTML are known by their ending
    alone (``check_ending``).

    Args:
        path: Where to; a link is followed. A pipe, a terminal or a folder passes.
        flag: Flag that named the path, for the message.

    Raises:
        UsageError: A file of JSON or Markdown stands there that no command wrote as a result.
    """
    is_result = {".json": _is_figures, ".jsonl": _is_figures, ".md": _is_page}
    check = is_result.get(path.resolve().suffix.lower())
    if check is None or not path.is_file() or not path.stat().st_size:
        return
    try:
        is_earlier = check(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError):
        is_earlier = False
    if not is_earlier:
        raise UsageError(
            f"{flag} {path} exists and is no earlier result of tacgrasp, so it is not replaced; "
            "name another file"
        )


def _is_figures(text: str) -> bool:
    """Whether a text is what ``write_result`` wrote, or the events of ``tacgrasp run``."""
    try:
        content = json.loads(text)
    except ValueError:
        content = None
    if isinstance(content, dict) and content.get(WRITTEN_BY) == WRITER:
        return True
    if isinstance(content, dict) and content.keys() >= {"about", "results"}:
        return True  # a long benchmark's, of a version without the key: --resume goes on with it
    if isinstance(content, list) and content and isinstance(content[0], dict):
        return content[0].get("event") in ("contract", "end")
    try:
        first = json.loads(text.partition("\n")[0])
    except ValueError:
        return False
    return isinstance(first, dict) and first.get("event") in ("contract", "end")


def _is_page(text: str) -> bool:
    return PAGE_WRITTEN_BY in text


def write_result(path: Path, figures: Mapping[str, Any], *, flag: str = "--json") -> None:
    """Write figures as JSON, all at once, to a new file, over earlier ones, or into a pipe.

    The key ``written_by`` stands before them: by it a later call knows the file as a result.

    Args:
        path: Where to; a link is followed.
        figures: The figures, in types of JSON.
        flag: Flag that named the path, for the message.

    Raises:
        UsageError: It can't be written, has another ending, or something else stands there.
    """
    marked = {WRITTEN_BY: WRITER, **figures}
    _write(path, json.dumps(marked, indent=1, ensure_ascii=False) + "\n", ".json", flag)


def write_page(path: Path, text: str, *, flag: str) -> None:
    """Write a page of Markdown as ``write_result`` writes figures.

    Args:
        path: Where to; a link is followed.
        text: The page; it says that it was "Written by `tacgrasp ...`".
        flag: Flag that named the path, for the message.

    Raises:
        UsageError: As ``write_result``.
    """
    _write(path, text, ".md", flag)


def _write(path: Path, text: str, ending: str, flag: str) -> None:
    check_ending(path, ending, flag=flag)
    check_replaceable(path, flag=flag)
    try:
        if path.exists() and not path.is_file() and not path.is_dir():
            path.write_text(text, encoding="utf-8")
        else:
            write_atomically(path.resolve(), text)
    except BrokenPipeError:
        raise
    except OSError as error:
        raise UsageError(f"{flag} {path} can't be written: {error.strerror or error}") from None
