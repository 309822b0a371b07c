"""Policies that ignore the sensor: baselines that a policy with touch must beat."""

from __future__ import annotations

import numpy as np

from policies.extraction import extract
from policies.observation import Observation
from policies.policy import Decision
from policies.speech import ACTION_WORDINGS, SUCCESS_WORDINGS
from primitives import Primitive
from primitives.contract import Contract


def _decision(text: str, confidence: float = 1.0) -> Decision:
    extraction = extract(text)
    return Decision(
        text=text,
        action=extraction.action,
        success=extraction.success,
        reason=extraction.reason,
        confidence=confidence,
    )


class FixedForcePolicy:
    """Declares every grasp secure, so that the force of the first grasp is kept."""

    @property
    def name(self) -> str:
        return "fixed_force"

    def start(self) -> None:
        pass

    def decide(self, observation: Observation, contract: Contract) -> Decision:
        return _decision("The grasp is secure.")


class RandomPolicy:
    """Draws one of the seven primitives or success with equal probability.

    Args:
        seed: Seed of one stream of draws, which continues over episodes.
    """

    def __init__(self, seed: int) -> None:
        self._rng = np.random.default_rng(seed)

    @property
    def name(self) -> str:
        return "random"

    def start(self) -> None:
        pass  # the stream of draws continues over episodes

    def decide(self, observation: Observation, contract: Contract) -> Decision:
        choices = list(Primitive)
        index = int(self._rng.integers(len(choices) + 1))
        text = ACTION_WORDINGS[choices[index]][-1] if index < len(choices) else SUCCESS_WORDINGS[0]
        return _decision(text, confidence=1 / (len(choices) + 1))
