"""Errors in a person's use of the program."""


class UsageError(Exception):
    """A wrong flag, file or value; one line that says what was expected, what came, what to do."""
