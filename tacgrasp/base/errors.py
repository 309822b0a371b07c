"""Errors of the application: what a person asked for can't be done as asked."""


class UsageError(Exception):
    """A wrong flag, file or value; one line that says what was expected, what came, what to do."""
