"""Errors in a person's use of the program, and how any error is told."""

from __future__ import annotations

from cltp.errors import TouchError
from primitives.errors import RobotError


class UsageError(Exception):
    """A wrong flag, file or value; one line that says what was expected, what came, what to do."""


def error_text(error: Exception) -> str:
    """What an error says; one of foreign code, which may say anything, with its type."""
    if isinstance(error, (RobotError, TouchError, UsageError)):
        return str(error)
    return f"{type(error).__name__}: {error}"
