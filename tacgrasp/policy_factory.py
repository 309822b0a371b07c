"""Build a policy by name. A new policy gets a function and a line in the table ``POLICIES``."""

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
"""Threads of torch for the language model. Its matrices are too small to gain from a second thread,
and with a fixed number a decision can be repeated to the bit."""


def default_weights() -> Path:
    """Folder of weights without a flag: ``TACGRASP_WEIGHTS``, else the shipped weights."""
    folder = os.environ.get(WEIGHTS_VARIABLE)
    return Path(folder) if folder else shipped_weights()


def shipped_weights() -> Path:
    """Folder of the shipped weights, in the ``policies`` package."""
    return Path(policies.__file__).parent / "weights"


def load_llm(weights: Path | None = None) -> LlmPolicy:
    """Load the language model of a folder, and set the number of torch's threads in this process.

    Args:
        weights: Folder; None takes ``default_weights``.

    Raises:
        TouchError: Weights are missing, damaged, or of different models.
    """
    import torch

    from policies.llm import LlmPolicy

    torch.set_num_threads(LLM_THREADS)
    return LlmPolicy(weights or default_weights())


def _llm(config: RunConfig) -> Policy:
    policy = load_llm(config.weights)
    try:
        policy.check_move_step(config.primitives.move_step_mm)
    except PolicyError as error:
        raise UsageError(str(error)) from None
    return policy


def _rules(config: RunConfig) -> Policy:
    from policies.rules import RulesPolicy

    return RulesPolicy(move_step_mm=config.primitives.move_step_mm)


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

_OTHER_COMMANDS = {
    "oracle": "it sees the simulator's truth: only `tacgrasp bench strawberry` has it",
    "recorded": "it repeats an episode: use `tacgrasp replay EPISODE`",
}


def check_policy(name: str, config: RunConfig) -> None:
    """Check the name of a policy and the folder of its weights, before anything heavy is loaded.

    Raises:
        UsageError: It is unknown, or a run can't use it; or it has no weights.
    """
    if name not in POLICIES:
        hint = f"; {_OTHER_COMMANDS[name]}" if name in _OTHER_COMMANDS else ""
        raise UsageError(f"unknown policy {name!r}; known: {', '.join(POLICIES)}{hint}")
    weights = config.weights or default_weights()
    if name == "llm" and not weights.is_dir():
        raise UsageError(
            f"weights are missing: {weights} is not a folder; train them with `tacgrasp train "
            "all`, name another folder with --weights, or decide with --policy rules"
        )


def make_policy(name: str, config: RunConfig) -> Policy:
    """Build the policy called ``name``.

    Raises:
        UsageError: It is unknown, or a run can't use it.
        TouchError: The language model's weights can't be used.
    """
    check_policy(name, config)
    return POLICIES[name](config)
