"""Read a command's flags with tyro over a model or dataclass; an error is one line of text.

Not here: the flags of each command (the other modules of ``tacgrasp.cli``).
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields, is_dataclass
from difflib import get_close_matches
from itertools import pairwise
from pathlib import Path
from typing import Any, NoReturn, TypeVar

import tyro
from pydantic import ValidationError
from tyro import _errors as tyro_errors  # tyro's only structured errors; see pyproject's version

from tacgrasp.base.errors import UsageError
from tacgrasp.base.result_file import check_ending, check_replaceable
from tacgrasp.base.settings import SettingsBase
from tacgrasp.config.errors import explain_flag, flag_of
from tacgrasp.config.layers import leaves

T = TypeVar("T")


def parse(kind: type[T], argv: Sequence[str], *, prog: str, default: T | None = None) -> T:
    """Parse ``argv`` into ``kind``; ``--help`` prints and exits with 0.

    Raises:
        UsageError: A flag or value that doesn't fit, in one line.
    """

    def refuse(event: tyro_errors.ParseErrorEvent) -> NoReturn:
        message = " ".join(_problem(event, default or kind, argv).split())
        raise UsageError(f"{message} (see {prog} --help)") from None

    with tyro_errors.on_parse_error(refuse):
        if default is None:
            flags = tyro.cli(kind, args=argv, prog=prog)
        else:
            flags = tyro.cli(kind, args=argv, prog=prog, default=default)
    seed = getattr(flags, "seed", None)
    if isinstance(seed, int) and seed < 0:
        raise UsageError(f"--seed must be at least 0, got {seed} (see {prog} --help)")
    return flags


def parse_some(kind: type[T], argv: Sequence[str]) -> T:
    """Parse the flags of the dataclass ``kind`` alone; all others are left to ``parse``.

    Raises:
        UsageError: One of its flags stands without a value.
    """

    def refuse(event: tyro_errors.ParseErrorEvent) -> NoReturn:
        raise UsageError(_problem(event, kind, argv)) from None

    with tyro_errors.on_parse_error(refuse):
        return tyro.cli(kind, args=argv, return_unknown_args=True, add_help=False)[0]


_NO_NUMBER = re.compile(
    r"^(?:invalid literal for int\(\) with base 10|could not convert string to float): "
)
"""How Python says that a text is no number."""


_NO_TYPE = re.compile(r"no type matching .* could be instantiated from (.*)$", re.S)
"""How tyro says that none of several types fits."""


def _problem(event: tyro_errors.ParseErrorEvent, flags: object, argv: Sequence[str]) -> str:
    """Error message of a refused command line; ``flags`` is the model or dataclass to be filled."""
    match event:
        case tyro_errors.UnrecognizedArgs(tokens=tokens):
            names = [field.name for field in fields(flags)] if is_dataclass(flags) else []
            paths = leaves(flags) if isinstance(flags, SettingsBase) else names
            matches = get_close_matches(tokens[0].split("=")[0], map(flag_of, paths), n=1)
            hint = f"; did you mean {matches[0]}?" if matches else ""
            if not matches and "task" in paths and not tokens[0].startswith("-"):
                hint = f"; did you mean --task {tokens[0]}?"
            if flag := _flag_before(tokens[0], argv):
                hint = f"; {flag} takes no value"
            return f"unknown arguments: {' '.join(tokens)}{hint}"
        case tyro_errors.MissingArgs(missing_arguments=missing):
            return f"missing: {', '.join(_name(one.arg) for one in missing)}"
        case tyro_errors.BadValue(argument=argument):
            if argument.is_positional():
                return f"missing: {_name(argument)}, which stands without a flag"
            count = argument.lowered.nargs
            return f"{_name(argument)} needs {'a value' if count == 1 else f'{count} values'}"
        case tyro_errors.InvalidChoice(argument=argument, value=value, choices=choices):
            return f"{_name(argument)} must be one of {', '.join(choices)}, got {value!r}"
        case tyro_errors.InstantiationFailure(argument=argument, message=message):
            if argument is not None:
                reason = message.splitlines()[0].partition(" into tuple type")[0]
                reason = _NO_NUMBER.sub("got ", reason)
                metavar = str(argument.lowered.metavar)
                if given := _NO_TYPE.match(reason):
                    given_text = " ".join(re.findall(r"'([^']*)'", given[1]))
                    wanted = metavar.removeprefix("{None}|").strip("{}")
                    is_more = len(given_text.split()) > len(wanted.split())
                    hint = "; what stands without a flag goes before it" if is_more else ""
                    return f"{_name(argument)} needs {wanted}, got {given_text or 'nothing'}{hint}"
                return f"{_name(argument)} must be {metavar}: {reason}"
            error = sys.exception()
            while error is not None and not isinstance(error, ValidationError):
                error = error.__context__  # tyro passes on the text of pydantic's error alone
            return message if error is None else explain_flag(error)
    return "the arguments can't be understood"


def _flag_before(token: str, argv: Sequence[str]) -> str:
    """The flag that an unknown argument stands behind, as if it were its value; '' for none."""
    if token.startswith("-"):
        return ""
    before = next((one for one, two in pairwise(argv) if two == token), "")
    return before if before.startswith("--") and "=" not in before else ""


def _name(argument: Any) -> str:
    """A flag, or the name of a positional argument in capitals."""
    if argument.is_positional():
        return str(argument.field.extern_name).upper()
    return "/".join(argument.lowered.name_or_flags)


def subcommand(
    command: str, argv: Sequence[str], summaries: Mapping[str, str]
) -> tuple[str | None, Sequence[str]]:
    """Name and arguments of the subcommand; None when only help was asked for (it is printed).

    Raises:
        UsageError: None was given, or it is not known.
    """
    if argv[:1] in (["-h"], ["--help"]):
        width = max(map(len, summaries)) + 2
        lines = [f"  {name:{width}}{text.splitlines()[0]}" for name, text in summaries.items()]
        usage = f"usage: tacgrasp {command} {{{','.join(summaries)}}} [OPTIONS]\n\n"
        sys.stdout.write(usage + "\n".join(lines) + "\n")
        return None, []
    if not argv or argv[0] not in summaries:
        got = repr(argv[0]) if argv else "nothing"
        raise UsageError(f"tacgrasp {command} expects one of {', '.join(summaries)}, got {got}")
    return argv[0], argv[1:]


def run_subcommand(
    command: str, argv: Sequence[str], commands: Mapping[str, tuple[type[Any], Callable[[Any], T]]]
) -> T | None:
    """Parse and run one of ``commands``; None when only help was asked for (it is printed).

    Args:
        command: Name of the command.
        argv: Its arguments.
        commands: Flags and function of each subcommand; the docstring of the flags is its summary.

    Raises:
        UsageError: An unknown subcommand, or a flag or value that doesn't fit.
    """
    summaries = {name: flags.__doc__ or "" for name, (flags, _) in commands.items()}
    name, rest = subcommand(command, argv, summaries)
    if name is None:
        return None
    flags, run = commands[name]
    return run(parse(flags, rest, prog=f"tacgrasp {command} {name}"))


def contacts_in(folder: Path, *, command: str) -> Path:
    """Check that a folder holds contacts, before anything heavy is loaded.

    Args:
        folder: The folder of ``--data``.
        command: The command that makes such a folder, without its ``--out``.

    Raises:
        UsageError: It holds none; the message names the command that makes them.
    """
    if not (folder / "dataset.json").is_file():
        lacks = (
            "holds no contacts (dataset.json is missing)" if folder.exists() else "does not exist"
        )
        raise UsageError(
            f"--data {folder} {lacks}; make them: {command} --out {folder}, or name another folder"
        )
    return folder


def writable(path: Path | None, *endings: str, flag: str = "--json") -> Path | None:
    """Check that a result file can be written, before minutes are spent on measuring.

    Nothing is left behind where there was no file. A pipe or device is not opened: that would wait
    for a reader, and end what it reads.

    Args:
        path: The file; None for none.
        *endings: Endings that its name may have; ``.json`` when none are given.
        flag: Flag that named it, for the message.

    Raises:
        UsageError: It can't be written, is a file of another kind, or a file of JSON or Markdown
            stands there that is no earlier result.
    """
    if path is None:
        return None
    check_ending(path, *(endings or (".json",)), flag=flag)
    target = path.resolve()
    is_new = not target.exists()
    try:
        if is_new or target.is_file() or target.is_dir():
            with target.open("a", encoding="utf-8"):
                pass
        if is_new:
            target.unlink()
    except OSError as error:
        raise UsageError(f"{flag} {path} can't be written: {error.strerror}") from None
    check_replaceable(path, flag=flag)
    return path
