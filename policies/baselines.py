"""Policies that ignore the sensor or a part of it: baselines that feeling all must beat."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cltp.tactile.measure import contact_state
from cltp.tactile.states import ContactState
from policies.contract_steps import target_of
from policies.observation import Observation
from policies.policy import Decision, decision_of
from policies.speech import ACTION_WORDINGS, SUCCESS_WORDINGS, speak
from policies.teacher import teacher
from primitives import Primitive
from primitives.contract import DEFAULT_AREA, DEFAULT_DEPTH_MM, Band, Contract


class FixedForcePolicy:
    """Declares every grasp secure, so that the force of the first grasp is kept."""

    @property
    def name(self) -> str:
        return "fixed_force"

    def start(self) -> None:
        pass

    def decide(self, observation: Observation, contract: Contract) -> Decision:
        return decision_of("The grasp is secure.")


class RandomPolicy:
    """Draws one of the seven primitives or success with equal probability.

    Args:
        seed: Seed of one stream of draws, which continues over episodes.
    """

    def __init__(self, seed: int) -> None:
        self._rng = np.random.default_rng([seed, 10])  # apart from the streams that draw a world

    @property
    def name(self) -> str:
        return "random"

    def start(self) -> None:
        pass  # the stream of draws continues over episodes

    def decide(self, observation: Observation, contract: Contract) -> Decision:
        choices = list(Primitive)
        index = int(self._rng.integers(len(choices) + 1))
        text = ACTION_WORDINGS[choices[index]][-1] if index < len(choices) else SUCCESS_WORDINGS[0]
        return decision_of(text, confidence=1 / (len(choices) + 1))


_ANY_FORCE = Band(low=0.0, high=1e3)


class CenterOnlyPolicy:
    """The rules without force: it moves until the contact is centred, and never changes the force.

    Args:
        move_step_mm: Length of a move that the rig carries out [mm].
    """

    def __init__(self, *, move_step_mm: float) -> None:
        self._move_step_mm = move_step_mm

    @property
    def name(self) -> str:
        return "center_only"

    def start(self) -> None:
        pass

    def decide(self, observation: Observation, contract: Contract) -> Decision:
        goal = replace(
            target_of(contract),
            force_n=_ANY_FORCE,
            depth_mm=DEFAULT_DEPTH_MM,
            area_fraction=DEFAULT_AREA,
        )
        state = _state(observation)
        return decision_of(speak(state, teacher(state, goal, move_step_mm=self._move_step_mm)))


class ForceOnlyPolicy:
    """The rules without place: it changes the force as they do, and never moves.

    Args:
        move_step_mm: Length of a move that the rig would carry out [mm].
    """

    def __init__(self, *, move_step_mm: float) -> None:
        self._move_step_mm = move_step_mm

    @property
    def name(self) -> str:
        return "force_only"

    def start(self) -> None:
        pass

    def decide(self, observation: Observation, contract: Contract) -> Decision:
        state = replace(_state(observation), x_mm=0.0, y_mm=0.0, cut=frozenset())
        advice = teacher(state, target_of(contract), move_step_mm=self._move_step_mm)
        return decision_of(speak(state, advice))


def _state(observation: Observation) -> ContactState:
    return contact_state(observation.cloud, in_contact=observation.in_contact)
