"""Build the policy that a name stands for; to add one, write a function and a line in the table."""

from __future__ import annotations

from collections.abc import Callable

from policies import Policy
from tacgrasp.config import RunConfig
from tacgrasp.errors import UsageError


def _rules(config: RunConfig) -> Policy:
    from policies.rules import RulesPolicy

    return RulesPolicy(config.goal.goal())


def _fixed_force(config: RunConfig) -> Policy:
    from policies.baselines import FixedForcePolicy

    return FixedForcePolicy()


def _random(config: RunConfig) -> Policy:
    from policies.baselines import RandomPolicy

    return RandomPolicy(config.seed)


POLICIES: dict[str, Callable[[RunConfig], Policy]] = {
    "rules": _rules,
    "fixed_force": _fixed_force,
    "random": _random,
}

_ELSEWHERE = {
    "oracle": "it sees the simulator's truth: only `tacgrasp bench strawberry` has it",
    "recorded": "it repeats an episode: use `tacgrasp replay EPISODE`",
}


def make_policy(name: str, config: RunConfig) -> Policy:
    """The policy called ``name``.

    Raises:
        UsageError: There is none, or it is not one that a run can use.
    """
    if name not in POLICIES:
        why = f"; {_ELSEWHERE[name]}" if name in _ELSEWHERE else ""
        raise UsageError(f"unknown policy {name!r}; known: {', '.join(POLICIES)}{why}")
    return POLICIES[name](config)
