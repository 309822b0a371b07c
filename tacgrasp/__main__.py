"""``tacgrasp`` on the command line: imports the one command asked for, turns errors into codes."""

from __future__ import annotations

import importlib
import os
import sys
from collections.abc import Sequence

COMMANDS = {
    "run": "close the loop on a task: touch, sentence, action, until the grasp is good",
    "demo": "scripted demos with a known outcome; without a name lists them",
    "replay": "show an episode tick by tick; --decide asks a policy again, --execute moves again",
    "episodes": "ls, info, recover, plot: what has been recorded",
    "describe": "say in words and numbers what a cloud or height map in a file, or a frame, is",
    "ask": 'answer a question about the touch in a file: ask FILE "How deep is it pressed?"',
    "train": "clip, cltp, llm, all, and the methods beside CLTP; goes on where it was stopped",
    "eval": "how right trained weights are on unseen contacts; zero-shot, probe, retrieval, report",
    "simulate": "press: one thing into one sensor's gel, to a depth: heights, pressure, force",
    "data": "generate, import, inspect, stats, verify, gallery, sheet: contacts to learn from",
    "calibrate": "gelsight-mini, background, gripper, pad-axes: what a unit's readings mean",
    "emulate": "ur, dynamixel, taxels, rig: emulators that speak the real protocols",
    "doctor": "look at every device of a rig, and say what to do; moves nothing",
    "jog": "move a rig by keyboard in small limited steps, and see what it feels",
    "bench": "strawberry, latency, gel, balls, crash, faults, ...: measure and print figures",
}

EXIT_CODES = """\
Exit codes:
  0    success (for run: a verified grasp)
  1    the episode ended otherwise, a decision differed, a demo or benchmark did not come out
  2    wrong use: unknown command, flag, field, file or value
  3    fault: robot, sensor, policy or recorder failed, or a bug
  130  stopped by the operator (Ctrl-C)"""


def usage() -> str:
    """The text of ``tacgrasp --help``."""
    commands = "\n".join(f"  {name:10}{what}" for name, what in COMMANDS.items())
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
    if not argv or argv[0] in ("-h", "--help", "help"):
        _say(usage())
        return 0 if argv else 2
    if argv[0] == "--version":
        from tacgrasp import __version__

        _say(f"tacgrasp {__version__}")
        return 0
    try:
        return _dispatch(argv[0], argv[1:])
    except KeyboardInterrupt:
        _complain("stopped by the operator")
        return 130
    except BrokenPipeError:  # whoever read our output has gone
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1


def _dispatch(command: str, argv: Sequence[str]) -> int:
    from tacgrasp.base.errors import UsageError
    from tacgrasp.base.package_check import check_siblings

    try:
        if command not in COMMANDS:
            raise UsageError(f"unknown command {command!r}; known: {', '.join(COMMANDS)}")
        check_siblings()
        module = importlib.import_module(f"tacgrasp.cli.{command}")
        return int(module.main(argv))
    except UsageError as error:
        _complain(str(error))
        return 2
    except BrokenPipeError:
        raise
    except Exception as error:
        code = _exit_code(error)
        if code is None:  # a bug: show where
            import traceback

            traceback.print_exc()
            return 3
        _complain(str(error))
        return code


def _exit_code(error: Exception) -> int | None:
    """What an error that a command did not deal with itself means; None for a bug."""
    from cltp import TouchError
    from policies import PolicyError
    from primitives import RobotError
    from tacgrasp.episodes.errors import EpisodeError

    if isinstance(error, (TouchError, EpisodeError)):
        return 2  # outside an episode these come from files that a person named
    return 3 if isinstance(error, (RobotError, PolicyError)) else None


def _say(text: str) -> None:
    sys.stdout.write(f"{text}\n")


def _complain(message: str) -> None:
    sys.stderr.write(f"tacgrasp: {' '.join(message.split())}\n")


if __name__ == "__main__":
    sys.exit(main())
