"""Errors of policies."""


class PolicyError(Exception):
    """A policy could not decide. The loop holds still and asks again a bounded number of times."""
