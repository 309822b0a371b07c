"""Errors in a person's use of the program, and how any error is told."""

from __future__ import annotations


class UsageError(Exception):
    """A wrong flag, file or value; one line that says what was expected, what came, what to do."""


def error_text(error: Exception) -> str:
    """What an error says; one of foreign code, which may say anything, with its type."""
    ours = any(kind.__module__.split(".")[0] in _PACKAGES for kind in type(error).__mro__)
    return str(error) if ours else f"{type(error).__name__}: {error}"


_PACKAGES = ("cltp", "policies", "primitives", "sim", "tacgrasp")
