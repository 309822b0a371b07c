"""Build the policy that a name stands for; to add one, write a function and a line in the table."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import policies
from policies import Policy, PolicyError
from tacgrasp.base.errors import UsageError
from tacgrasp.config.schema import RunConfig

if TYPE_CHECKING:
    from policies.llm import LlmPolicy

WEIGHTS_VARIABLE = "TACGRASP_WEIGHTS"

LLM_THREADS = 1
"""Threads of torch beside the language model. Its products are too small to gain from a second
one, and with a number that is always the same a decision can be repeated to the bit."""


def default_weights() -> Path:
    """Folder of weights where no flag names one: ``TACGRASP_WEIGHTS``, else what is shipped."""
    named = os.environ.get(WEIGHTS_VARIABLE)
    return Path(named) if named else shipped_weights()


def shipped_weights() -> Path:
    """Folder of the weights that come with the program, in the ``policies`` package."""
    return Path(policies.__file__).parent / "weights"


def load_llm(weights: Path | None = None) -> LlmPolicy:
    """The language model of a folder, with torch's threads set for this process.

    Args:
        weights: Folder; None takes ``default_weights``.

    Raises:
        TouchError: Weights are missing, damaged, or don't fit together.
    """
    import torch

    from policies.llm import LlmPolicy

    torch.set_num_threads(LLM_THREADS)
    return LlmPolicy(weights or default_weights())


def _llm(config: RunConfig) -> Policy:
    policy = load_llm(config.weights)
    try:
        policy.check(config.instruction)  # now, not when the object is between the fingers
    except PolicyError as error:
        raise UsageError(str(error)) from None
    return policy


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
    "llm": _llm,
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
        UsageError: There is none, or it is not one that a run can use, or it can't understand the
            instruction.
        TouchError: The language model's weights can't be used.
    """
    if name not in POLICIES:
        why = f"; {_ELSEWHERE[name]}" if name in _ELSEWHERE else ""
        raise UsageError(f"unknown policy {name!r}; known: {', '.join(POLICIES)}{why}")
    return POLICIES[name](config)
