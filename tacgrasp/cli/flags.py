"""Read a command's flags with tyro over a model or dataclass; errors become one line.

Not here: what the flags mean.
"""

from __future__ import annotations

import io
import os
import re
import sys
from collections.abc import Mapping, Sequence
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from typing import TypeVar

import tyro

from tacgrasp.base.errors import UsageError
from tacgrasp.config.errors import unit_of

T = TypeVar("T")


def parse(kind: type[T], argv: Sequence[str], *, prog: str, default: T | None = None) -> T:
    """Parse ``argv`` into ``kind``; ``--help`` prints and exits with 0.

    Raises:
        UsageError: A flag or value that doesn't fit, in one line.
    """
    if any(flag in argv for flag in ("-h", "--help")):
        return _parse(kind, argv, prog, default)
    printed = io.StringIO()
    columns = os.environ.get("COLUMNS")
    os.environ["COLUMNS"] = "4000"  # tyro wraps its boxes to the terminal; we take the box off
    try:
        with redirect_stderr(printed), redirect_stdout(printed):
            return _parse(kind, argv, prog, default)
    except SystemExit:
        raise UsageError(f"{_unboxed(printed.getvalue())} (see {prog} --help)") from None
    finally:
        if columns is None:
            del os.environ["COLUMNS"]
        else:
            os.environ["COLUMNS"] = columns


def _parse(kind: type[T], argv: Sequence[str], prog: str, default: T | None) -> T:
    if default is None:
        return tyro.cli(kind, args=argv, prog=prog)
    return tyro.cli(kind, args=argv, prog=prog, default=default)


def _unboxed(text: str) -> str:
    """What tyro says (title, rule, message, rule, hints), on one line and without references."""
    blocks: list[list[str]] = [[]]
    for line in (raw.strip() for raw in text.splitlines()):
        if line and set(line) == {"-"}:
            blocks.append([])
        elif line:
            blocks[-1].append(line)
    message = " ".join(blocks[1] if len(blocks) > 1 else blocks[0])
    message = re.sub(r"For further information visit \S+", "", message)
    message = re.sub(r" \[type=value_error.*", "", message)
    message = re.sub(r"\[type=\w+, input_value=(.*?), input_type=\w+\]", r"(got \1)", message)
    guesses = [block[1] for block in blocks if len(block) > 1 and block[0].startswith("Perhaps")]
    message = _VALIDATION.sub(_plain, " ".join(message.split()))
    hint = f"; did you mean {guesses[0].split()[0]}?" if guesses else ""
    return message + hint


_VALIDATION = re.compile(
    r"Error parsing (?P<section>\S+): \d+ validation errors? for (?P<model>\w+) "
    r"((?P<field>[\w.]+) (?=Input|Value|String|Assert))?(Value error, |Input |Value |String )"
)
"""How tyro passes on what pydantic said."""


def _plain(found: re.Match[str]) -> str:
    """The flag that pydantic's message is about, with its unit."""
    section = "" if found["section"] == found["model"] else f"{found['section']}."
    if found["field"] is None:
        return f"--{section[:-1]}: " if section else ""
    unit = unit_of(found["field"])
    flag = f"--{section}{found['field']}".replace("_", "-")
    return f"{flag}{f' [{unit}]' if unit else ''} "


def flag_value(argv: Sequence[str], flag: str) -> str | None:
    """Value of one flag, needed before the others can be read; None when it is not given.

    Raises:
        UsageError: The flag stands without a value.
    """
    value = None
    for place, token in enumerate(argv):
        if token == flag:
            if place + 1 == len(argv) or argv[place + 1].startswith("--"):
                raise UsageError(f"{flag} needs a value")
            value = argv[place + 1]
        elif token.startswith(f"{flag}="):
            value = token.removeprefix(f"{flag}=")
    return value


def subcommand(
    command: str, argv: Sequence[str], known: Mapping[str, str]
) -> tuple[str | None, Sequence[str]]:
    """The subcommand and its own arguments; None when only help was asked for (it is printed).

    Raises:
        UsageError: None was given, or it is not known.
    """
    if argv[:1] in (["-h"], ["--help"]):
        width = max(map(len, known)) + 2
        lines = [f"  {name:{width}}{what.splitlines()[0]}" for name, what in known.items()]
        usage = f"usage: tacgrasp {command} {{{','.join(known)}}} [OPTIONS]\n\n"
        sys.stdout.write(usage + "\n".join(lines) + "\n")
        return None, []
    if not argv or argv[0] not in known:
        got = repr(argv[0]) if argv else "nothing"
        raise UsageError(f"tacgrasp {command} expects one of {', '.join(known)}, got {got}")
    return argv[0], argv[1:]


def writable(json_path: Path | None) -> Path | None:
    """Refuse a place that can't be written before minutes are spent on measuring."""
    if json_path is None:
        return None
    try:
        with json_path.open("a", encoding="utf-8"):
            return json_path
    except OSError as error:
        raise UsageError(f"--json {json_path} can't be written: {error.strerror}") from None
