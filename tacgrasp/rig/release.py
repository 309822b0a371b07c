"""A gripper that is opened again on every way out of a measurement that closes it.

Not here: the end of an episode, where the task decides (``tacgrasp.runtime.shutdown``).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from cltp.errors import TouchError
from primitives.devices import Gripper
from primitives.errors import RobotError, TorqueOffError
from tacgrasp.base.errors import UsageError, error_text
from tacgrasp.drivers.opening import BY_JOG
from tacgrasp.episodes.interrupts import delayed_interrupts

CLEAR_M = 0.01
"""Opening that frees what a measurement held [m]."""

FREE_BY_HAND = (
    "what it grips may still be held: support it, then switch the gripper's power off, or remove "
    f"the cause and open with {BY_JOG}"
)
"""Advice when a gripper that should release has failed: it takes no command any more."""


def unopened_text(error: Exception, told: str) -> str:
    """What a gripper that did not open means for what it gripped, for the operator.

    Args:
        error: Why it did not open.
        told: What the operator is told already.
    """
    reason = "" if str(error) and str(error) in told else f": {error_text(error)}"
    if isinstance(error, TorqueOffError):
        return f"the gripper has no torque and holds nothing{reason}"
    return f"the gripper could not be opened{reason}; {FREE_BY_HAND}"


def let_go(gripper: Gripper, clear_m: float) -> None:
    """Open a gripper by ``clear_m`` [m] if it is closed.

    Raises:
        RobotError: It does not open.
    """
    if gripper.state().closed:
        gripper.open_by(clear_m)


@contextmanager
def opened_afterwards(open_up: Callable[[], object]) -> Iterator[None]:
    """Open the gripper on every way out of the block; Ctrl-C and SIGTERM wait until it is open.

    Args:
        open_up: Opens it, or does nothing where it is open.

    Raises:
        RobotError: It could not be opened, whatever ended the block; the message says whether it
            may still hold, and what frees it.
    """
    try:
        yield
    except (RobotError, TouchError, UsageError, KeyboardInterrupt) as error:
        told = str(error) or "stopped by the operator"
        problem, _ = _opened(open_up, told)
        if problem:
            raise RobotError(f"{told}; {problem}") from error
        raise
    except BaseException as error:  # a bug, which is shown whole
        problem, _ = _opened(open_up, "")
        if problem:
            error.add_note(problem)
        raise
    problem, interrupt = _opened(open_up, "")
    if problem:
        raise RobotError(problem)
    if interrupt is not None:
        raise interrupt


def _opened(open_up: Callable[[], object], told: str) -> tuple[str, KeyboardInterrupt | None]:
    """Open; returns why it failed if it did, and an interrupt that came meanwhile.

    Args:
        open_up: Opens the gripper.
        told: What the operator is told already.
    """
    problem, interrupt = "", None
    try:
        with delayed_interrupts():
            try:
                open_up()
            except RobotError as error:
                problem = unopened_text(error, told)
    except KeyboardInterrupt as late:
        interrupt = late
    return problem, interrupt
