"""Errors of touch: what was felt, or read from a file, can't be used."""


class TouchError(Exception):
    """A contact could not be read. The loop holds still and reads again, boundedly."""
