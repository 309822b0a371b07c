"""Errors of policies."""


class PolicyError(Exception):
    """A policy could not decide. The loop moves nothing and asks again a few times."""
