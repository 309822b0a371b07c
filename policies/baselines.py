"""Policies that don't feel: what touch has to be better than."""

from __future__ import annotations

import numpy as np

from policies.extraction import extract
from policies.observation import Observation
from policies.policy import Decision
from policies.speech import ACTION_WORDINGS, SUCCESS_WORDINGS
from primitives import Primitive


def _said(text: str, confidence: float = 1.0) -> Decision:
    found = extract(text)
    return Decision(
        text=text,
        action=found.action,
        success=found.success,
        reason=found.reason,
        confidence=confidence,
    )


class FixedForcePolicy:
    """Calls any grasp secure; the force is the first grasp's, which the caller sets."""

    @property
    def name(self) -> str:
        """'fixed_force'."""
        return "fixed_force"

    def start(self) -> None:
        """Nothing to forget."""

    def decide(self, observation: Observation, instruction: str) -> Decision:
        """Declare success, whatever was felt."""
        return _said("The grasp is secure.")


class RandomPolicy:
    """Draws one of the seven primitives or success, each with the same probability."""

    def __init__(self, seed: int) -> None:
        """Seed the draws; episodes continue one stream, so that they differ."""
        self._rng = np.random.default_rng(seed)

    @property
    def name(self) -> str:
        """'random'."""
        return "random"

    def start(self) -> None:
        """The draws go on: the seed was given once."""

    def decide(self, observation: Observation, instruction: str) -> Decision:
        """Draw, whatever was felt."""
        choices = list(Primitive)
        drawn = int(self._rng.integers(len(choices) + 1))
        text = ACTION_WORDINGS[choices[drawn]][-1] if drawn < len(choices) else SUCCESS_WORDINGS[0]
        return _said(text, confidence=1 / (len(choices) + 1))
