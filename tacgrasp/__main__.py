"""``tacgrasp`` on the command line: import the named command alone, turn errors into exit codes."""

from __future__ import annotations

import errno
import importlib
import io
import os
import sys
from collections.abc import Sequence
from pathlib import Path

COMMANDS = {
    "run": "run the closed loop on a task: read the contact, decide, act, until the grasp is good",
    "understand": "show what an instruction becomes: force band, limit, or why it is refused",
    "serve": "let robots and programs ask a policy over the network (openpi's protocol)",
    "demo": "play a scripted demo with a known course; without a name list them",
    "replay": "show an episode step by step; --decide asks a policy again, --execute moves again",
    "episodes": "ls, info, plot, recover, export: look at recorded episodes, or write them anew",
    "why": "what went wrong first in an episode: the state before it, what was sent, how to replay",
    "view": "see an episode, a rig or a sensor in rerun's viewer (extra 'view')",
    "describe": "describe the contact in a cloud, height map or camera frame",
    "ask": 'answer questions about the contact in a file: ask FILE "How deep is it pressed?"',
    "train": "train clip, cltp, llm, all or a compared method; an interrupted training resumes",
    "eval": "evaluate weights on unseen contacts: scores, instructions, zero-shot, probe, ...",
    "simulate": "press one object into a sensor's gel: heights, pressure and force",
    "data": "generate, import, inspect, stats, verify, gallery, sheet: data sets of contacts",
    "calibrate": "calibrate a unit: gelsight-mini, background, gains, gripper, force, slip, ...",
    "emulate": "run emulators that speak the real protocols: ur, dynamixel, taxels, rig",
    "doctor": "check every device of a rig and advise on what is wrong; moves nothing",
    "jog": "move a rig by keyboard in small limited steps, and show the contact",
    "bench": "measure and print figures: strawberry, latency, gel, balls, faults, ...",
}

ON_ALL_CORES = ("train", "eval", "data", "bench", "calibrate gelsight-mini")
"""Commands with much to compute at once. The others compute in steps of milliseconds and keep to
one thread: on a busy machine, threads that wait for each other took up to fifteen times as long."""

TIME_THE_LOOP = ("bench drivers", "bench latency", "bench reflex", "bench serve", "bench soak")
"""Benchmarks that time what the commands with one thread do, and so keep to one themselves."""

HAVE_DEVICES = ("run", "replay", "calibrate", "doctor", "jog", "emulate", "view")
"""Commands with devices, which SIGTERM and SIGHUP end as Ctrl-C does, and which go on when nobody
reads their output any more. The others have nothing to make safe: workers of a pool end with the
process that started them, and a training is resumed from its last checkpoint."""

FILE_ERRORS = (
    *(errno.EACCES, errno.EDQUOT, errno.EFBIG, errno.EINVAL, errno.EIO, errno.EISDIR),
    *(errno.ENOENT, errno.ENOSPC, errno.ENOTDIR, errno.EPERM, errno.EROFS),
)
"""Errors of the operating system that are no bugs of ours: a disk or folder refused a file."""

FULL_DISK = (errno.EDQUOT, errno.ENOSPC)
"""Those of them that end where space is freed."""

STOPPED = 130
"""Exit code of a command that Ctrl-C ended."""

EXIT_CODES = """\
Exit codes:
  0    success (for run: a verified grasp, or a dry run that has decided)
  1    any other end of an episode, a differing decision, a demo or benchmark that failed
  2    wrong use: unknown command, flag, field, file or value, or a refused instruction
  3    fault: robot, sensor, policy or recorder failed, or a bug
  130  stopped by the operator (Ctrl-C)
  143  stopped by SIGTERM; 129 by SIGHUP, as of a closed terminal. What has real devices ends as by
       Ctrl-C before"""


def usage() -> str:
    """The text of ``tacgrasp --help``."""
    commands = "\n".join(f"  {name:11}{summary}" for name, summary in COMMANDS.items())
    return (
        "usage: tacgrasp COMMAND [OPTIONS]      tacgrasp COMMAND --help\n\n"
        "Touch becomes language becomes action: a gripper that feels what it holds.\n\n"
        f"Commands:\n{commands}\n\n"
        "Start with: tacgrasp run --task strawberry\n\n"
        f"{EXIT_CODES}"
    )


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return its exit code."""
    argv = list(sys.argv[1:] if argv is None else argv)
    for name in ("stdout", "stderr"):  # closed by whoever started us
        if getattr(sys, name) is None:
            setattr(sys, name, Path(os.devnull).open("w", encoding="utf-8"))  # noqa: SIM115
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):  # a display without '±' shows '?' for it
            stream.reconfigure(errors="replace")
    if not argv or argv[0] in ("-h", "--help", "help"):
        _print(usage())
        return 0 if argv else 2
    if argv[0] == "--version":
        from tacgrasp import __version__

        _print(f"tacgrasp {__version__}")
        return 0
    if argv[0] not in HAVE_DEVICES:
        return _run(argv)
    from tacgrasp.base.lasting_output import lasting_output
    from tacgrasp.base.stop_signals import stop_signals_as_ctrl_c

    with stop_signals_as_ctrl_c() as received, lasting_output():
        code = _run(argv)
    return 128 + received[0] if received and code == STOPPED else code


def _run(argv: Sequence[str]) -> int:
    try:
        return _dispatch(argv[0], argv[1:])
    except KeyboardInterrupt as stop:
        _print_error(str(stop) or "stopped by the operator")
        return STOPPED
    except BrokenPipeError:  # the reader of our output has gone
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1


def _dispatch(command: str, argv: Sequence[str]) -> int:
    from tacgrasp.base.errors import UsageError
    from tacgrasp.base.package_check import check_packages
    from tacgrasp.base.worker_pool import THREADS

    try:
        if command not in COMMANDS:
            raise UsageError(f"unknown command {command!r}; known: {', '.join(COMMANDS)}")
        check_packages()
        if not _on_all_cores(command, " ".join([command, *argv[:1]])):
            for variable in THREADS:  # read as numpy and torch are imported
                os.environ.setdefault(variable, "1")
        module = importlib.import_module(f"tacgrasp.cli.{command}")
        return int(module.main(argv))
    except UsageError as error:
        _print_error(str(error))
        return 2
    except BrokenPipeError:
        raise
    except Exception as error:
        code = _exit_code(error)
        if isinstance(error, OSError) and error.errno in FILE_ERRORS:
            place = f"{error.filename} can't be used: " if error.filename else ""
            remedy = "free space, or name" if error.errno in FULL_DISK else "name"
            _print_error(f"{place}{error.strerror}; {remedy} another file or folder")
            return 2
        if code is None:  # a bug: show where
            import traceback

            traceback.print_exc()
            return 3
        _print_error(str(error))
        return code


def _on_all_cores(command: str, with_its_name: str) -> bool:
    if with_its_name in TIME_THE_LOOP:
        return False
    return command in ON_ALL_CORES or with_its_name in ON_ALL_CORES


def _exit_code(error: Exception) -> int | None:
    """Exit code of an error that left a command; None for a bug."""
    from cltp import TouchError
    from policies import PolicyError
    from primitives import RobotError
    from tacgrasp.episodes.errors import EpisodeError

    if isinstance(error, (TouchError, EpisodeError)):
        return 2  # outside an episode these come from files named on the command line
    return 3 if isinstance(error, (RobotError, PolicyError)) else None


def _print(text: str) -> None:
    sys.stdout.write(f"{text}\n")


def _print_error(message: str) -> None:
    from tacgrasp.base.printable import printable

    sys.stderr.write(f"tacgrasp: {printable(' '.join(message.split()))}\n")


if __name__ == "__main__":
    sys.exit(main())
