"""The arms of ``tacgrasp bench gentle``: who decides, by which words, with or without reflex.

Those without reflex follow no shear, so that their worlds cost less to simulate.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from cltp.tactile.cloud import TactileCloud
from policies import Decision, Observation, Policy
from primitives.contract import Contract

GENTLE_WORDS = (
    "Pick the fruit up gently.",
    "Be gentle with the fruit.",
    "Hold the fruit softly.",
    "Lift the fruit with a light touch.",
    "Take the fruit delicately.",
    "Handle the fruit with care, gently.",
)
FIRM_WORDS = (
    "Pick the fruit up firmly.",
    "Hold the fruit with a firm grip.",
    "Grip the fruit firmly.",
    "Take a firm hold of the fruit.",
    "Lift the fruit with a tight grip.",
    "Hold the fruit securely and firmly.",
)
"""Wordings that a seed draws from; each is read as its manner, without emphasis."""


@dataclass(frozen=True, slots=True, kw_only=True)
class GentleArm:
    """One arm.

    Attributes:
        policy: Name of the contestant (``tacgrasp.benchmarks.loop.contestants``).
        words: Wordings that each seed draws one of; empty for the task's own instruction.
        has_reflex: Whether the reflex keeps the contract.
        is_blanked: Whether the policy is shown an untouched gel in place of the felt one.
        is_swept: Whether it holds all fruit with one force, the best of a sweep.
        aim: What it should come to, for people.
    """

    policy: str
    words: tuple[str, ...] = ()
    has_reflex: bool = True
    is_blanked: bool = False
    is_swept: bool = False
    aim: str = ""

    def instruction(self, own: str, seed: int) -> str:
        """The wording of a seed; ``own`` is the task's."""
        if not self.words:
            return own
        return self.words[int(np.random.default_rng([seed, 20]).integers(len(self.words)))]


ARMS: Mapping[str, GentleArm] = {
    "llm": GentleArm(policy="llm", aim="98 % or more, peak 1.5 or less"),
    "gentle": GentleArm(policy="llm", words=GENTLE_WORDS, aim="97 % or more"),
    "firm": GentleArm(policy="llm", words=FIRM_WORDS, aim="97 % or more"),
    "reflex_off": GentleArm(policy="llm", has_reflex=False),
    "touch_blanked": GentleArm(policy="llm", is_blanked=True),
    "language_off": GentleArm(policy="rules"),
    "constant": GentleArm(policy="true_force", has_reflex=False, is_swept=True, aim="below 60 %"),
    "centring": GentleArm(policy="center_only", has_reflex=False, is_swept=True, aim="below 60 %"),
    "oracle": GentleArm(policy="oracle", has_reflex=False, aim="99 % or more"),
}
"""Arms by name, in the order of the table."""


class BlankedPolicy:
    """A policy whose observations carry a cloud of untouched gel, and no felt force.

    Contact by test and shear are taken away too; what the gripper says of itself stays.
    """

    def __init__(self, policy: Policy) -> None:
        self._policy = policy

    @property
    def name(self) -> str:
        return f"{self._policy.name}, blanked"

    def start(self) -> None:
        self._policy.start()

    def decide(self, observation: Observation, contract: Contract) -> Decision:
        return self._policy.decide(blanked(observation), contract)


def blanked(observation: Observation) -> Observation:
    """The observation as of an untouched gel."""
    cloud = untouched(observation.cloud)
    return replace(observation, cloud=cloud, in_contact=None, felt_force_n=None, shear=None)


def untouched(cloud: TactileCloud) -> TactileCloud:
    """The cloud with every height at 0."""
    points = cloud.points_mm.copy()
    points[:, 2] = 0.0
    return replace(cloud, points_mm=points)
