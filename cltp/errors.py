"""The error of sensing: an observation, or a file of observations or weights, can't be used."""


class TouchError(Exception):
    """A contact could not be read. The loop holds still and reads again, boundedly."""
